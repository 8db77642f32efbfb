"""Assembly XML to the model: units, poses, nested assemblies, references between names."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from cmb_base.errors import CmbError, InputError, Place
from cmb_base.progress import Progress, silent
from lxml import etree

from cad2modelica.geometry_reader import GeometryReader, GeometryReference
from cad2modelica.mass_check import check_against_geometry, check_tensor
from cad2modelica.mesh import Mesh
from cad2modelica.model import (
    GROUND,
    Assembly,
    CollisionChoice,
    ContactSettings,
    DecompositionLimits,
    Joint,
    JointType,
    MassProperties,
    Material,
    Part,
    Plane,
)
from cad2modelica.problems import Problems
from cad2modelica.spatial import (
    IDENTITY,
    Array,
    Pose,
    nearest_rotation,
    rotation_about,
    rotation_of_quaternion,
    rotation_of_roll_pitch_yaw,
)
from cad2modelica.units import ANGLE, LENGTH, MASS, UnitSystem, to_si
from cad2modelica.xml_document import line_of, validate

NAMESPACE = "urn:contactmultibody:assembly:1"
SCHEMA = Path(__file__).resolve().parents[2] / "Resources" / "schema" / "assembly.xsd"

DEFAULT_GRAVITY = (0.0, 0.0, -9.81)
DEFAULT_STOP_TIME = 1.0
DEFAULT_TOLERANCE = 1e-6

ROTATION_TOLERANCE = 1e-4  # elements of a matrix in an export may be rounded that much
RIGHT_ANGLE_TOLERANCE = 1e-6
MAXIMUM_PARTS = 2000
MAXIMUM_NESTING = 100


def read_assembly_xml(root: etree._Element, path: Path, progress: Progress = silent) -> Assembly:
    """Reads an assembly in this project's own format and the geometry it names.

    Args:
        root: the document's root element.
        path: the XML file.
        progress: is told which part is being read.

    Returns:
        The assembly, nested assemblies unfolded, in SI units.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    if etree.QName(root).namespace != NAMESPACE or etree.QName(root).localname != "assembly":
        raise InputError(
            f"is not an assembly: the root element is {root.tag!r}",
            place=Place(file=path, line=line_of(root)),
            remedy=f"The root element must be 'assembly' in the namespace {NAMESPACE!r}, or URDF's 'robot'.",
        )
    validate(root, SCHEMA, path)
    return _Reader(path, root, progress).read()


@dataclass(frozen=True)
class _PartDescription:
    """A part before its geometry is read."""

    name: str
    element: etree._Element
    outer: Pose
    pose: Pose


@dataclass(frozen=True)
class _JointDescription:
    name: str
    element: etree._Element
    outer: Pose
    prefix: str


@dataclass
class _Unfolded:
    parts: list[_PartDescription] = field(default_factory=list)
    joints: list[_JointDescription] = field(default_factory=list)
    instances: int = 0


class _Reader:
    def __init__(self, file: Path, root: etree._Element, progress: Progress) -> None:
        self._file = file
        self._root = root
        self._progress = progress
        units = _child(root, "units")
        self._units = UnitSystem(
            LENGTH[units.get("length", "")], MASS[units.get("mass", "")], ANGLE[units.get("angle", "")]
        )
        self._problems = Problems(str(file))
        self._geometry = GeometryReader(file.parent)
        self._notes: list[str] = []

    def read(self) -> Assembly:
        root = self._root
        materials = self._materials()
        planes = self._planes(materials)
        unfolded = _Unfolded()
        self._unfold(root, IDENTITY, "", self._definitions(), unfolded)
        self._problems.raise_if_any()
        self._check_names(unfolded)
        parts = tuple(self._part(item, materials, len(unfolded.parts), k) for k, item in enumerate(unfolded.parts))
        kept = {part.name: part for part in parts if part is not None}
        joints = [self._joint(item, {item.name: item for item in unfolded.parts}) for item in unfolded.joints]
        contacts = self._contacts({*(item.name for item in unfolded.parts), *(plane.name for plane in planes)})
        self._problems.raise_if_any()
        simulation = root.find(f"{{{NAMESPACE}}}simulation")
        gravity = root.find(f"{{{NAMESPACE}}}gravity")
        source = root.find(f"{{{NAMESPACE}}}source")
        description = root.findtext(f"{{{NAMESPACE}}}description") or ""
        return Assembly(
            name=root.get("name", ""),
            description=" ".join(description.split()),
            source=", ".join(source.get(key, "") for key in ("system", "version", "file") if source.get(key))
            if source is not None
            else "",
            file=self._file,
            gravity=_numbers(gravity.text) if gravity is not None else np.array(DEFAULT_GRAVITY),
            stop_time=float(simulation.get("stopTime", "")) if simulation is not None else DEFAULT_STOP_TIME,
            tolerance=float(simulation.get("tolerance", DEFAULT_TOLERANCE))
            if simulation is not None
            else DEFAULT_TOLERANCE,
            materials=tuple(materials.values()),
            planes=tuple(planes),
            parts=tuple(kept.values()),
            joints=tuple(joint for joint in joints if joint is not None),
            contacts=contacts,
            notes=(*self._notes, *self._geometry.notes()),
            length_unit=self._units.length,
        )

    # ----- materials, ground, contacts -----

    def _materials(self) -> dict[str, Material]:
        materials: dict[str, Material] = {}
        for element in self._root.iterfind(f"{{{NAMESPACE}}}materials/{{{NAMESPACE}}}material"):
            name = element.get("name", "")
            if name in materials:
                self._duplicate("material", name, element)
            materials[name] = Material(
                name,
                density=_optional(element, "density"),
                youngs_modulus=_optional(element, "youngsModulus"),
                poissons_ratio=_optional(element, "poissonsRatio"),
                restitution=_optional(element, "restitution"),
                static_friction=_optional(element, "staticFriction"),
                dynamic_friction=_optional(element, "dynamicFriction"),
            )
        return materials

    def _material_name(self, element: etree._Element, materials: dict[str, Material]) -> str | None:
        name = element.get("material")
        if name is not None and name not in materials:
            self._problems.add(
                f"uses the material {name!r}, which is not defined",
                self._place(element),
                f"Defined materials: {', '.join(sorted(materials)) or 'none'}.",
            )
        return name

    def _planes(self, materials: dict[str, Material]) -> list[Plane]:
        planes = []
        for element in self._root.iterfind(f"{{{NAMESPACE}}}ground/{{{NAMESPACE}}}plane"):
            normal = self._unit(_numbers(element.get("normal", "0 0 1")), element, "the normal")
            planes.append(
                Plane(
                    name=element.get("name", ""),
                    material=self._material_name(element, materials),
                    position=to_si(_numbers(element.get("position", "0 0 0")), self._units.length),
                    normal=normal,
                    place=self._place(element),
                )
            )
        return planes

    def _contacts(self, names: set[str]) -> ContactSettings:
        element = self._root.find(f"{{{NAMESPACE}}}contacts")
        if element is None:
            return ContactSettings()
        pairs: dict[str, list[tuple[str, str]]] = {"exclude": [], "include": []}
        for child in element:
            first, second = child.get("first", ""), child.get("second", "")
            for name in (first, second):
                if name not in names:
                    self._unknown("the contact pair", name, names, child)
            if first == second:
                self._problems.add(f"pairs {first!r} with itself", self._place(child), "Name two different parts.")
            pairs[etree.QName(child).localname].append((first, second))
        stiffness = element.get("stiffness")
        return ContactSettings(
            all_pairs=element.get("default", "all") == "all",
            excluded=tuple(pairs["exclude"]),
            included=tuple(pairs["include"]),
            stiffness=float(stiffness) if stiffness is not None else None,
            friction=element.get("friction"),
            decomposition=self._decomposition(element, "collisionError"),
        )

    # ----- nested assemblies -----

    def _definitions(self) -> dict[str, etree._Element]:
        definitions: dict[str, etree._Element] = {}
        for element in self._root.iterfind(f"{{{NAMESPACE}}}definitions/{{{NAMESPACE}}}definition"):
            name = element.get("name", "")
            if name in definitions:
                self._duplicate("definition", name, element)
            definitions[name] = element
        self._refuse_circles(definitions)
        return definitions

    def _refuse_circles(self, definitions: dict[str, etree._Element]) -> None:
        """Definitions must not contain themselves, whether they are used or not."""
        finished: set[str] = set()

        def visit(name: str, opened: tuple[str, ...]) -> None:
            if name in finished or name not in definitions:
                return
            for element in definitions[name].iterfind(f"{{{NAMESPACE}}}instances/{{{NAMESPACE}}}instance"):
                inner = element.get("of", "")
                if inner in (*opened, name):
                    circle = " in ".join(repr(item) for item in (inner, name, *reversed(opened)))
                    raise InputError(
                        f"the definition contains itself: {circle}",
                        place=self._place(element),
                        remedy="Break the circle: an assembly cannot be a part of itself.",
                    )
                if len(opened) >= MAXIMUM_NESTING:
                    raise InputError(
                        f"definitions are nested deeper than {MAXIMUM_NESTING}",
                        place=self._place(element),
                        remedy="Simplify the assembly.",
                    )
                visit(inner, (*opened, name))
            finished.add(name)

        for name in definitions:
            visit(name, ())

    def _unfold(
        self,
        content: etree._Element,
        outer: Pose,
        prefix: str,
        definitions: dict[str, etree._Element],
        result: _Unfolded,
    ) -> None:
        names: set[str] = set()
        for element in content.iterfind(f"{{{NAMESPACE}}}parts/{{{NAMESPACE}}}part"):
            name = self._own_name("part", element, names)
            if len(result.parts) >= MAXIMUM_PARTS:
                raise InputError(
                    f"unfolds to more than {MAXIMUM_PARTS} parts",
                    place=self._place(element),
                    remedy="Simplify the assembly.",
                )
            pose = outer @ self._pose(element.find(f"{{{NAMESPACE}}}pose"))
            result.parts.append(_PartDescription(prefix + name, element, outer, pose))
        for element in content.iterfind(f"{{{NAMESPACE}}}instances/{{{NAMESPACE}}}instance"):
            name = self._own_name("instance", element, names)
            definition = element.get("of", "")
            if definition not in definitions:
                self._unknown("the instance", definition, definitions, element)
            else:
                result.instances += 1
                if result.instances > MAXIMUM_PARTS:
                    raise InputError(
                        f"unfolds to more than {MAXIMUM_PARTS} instances",
                        place=self._place(element),
                        remedy="Simplify the assembly.",
                    )
                inner = outer @ self._pose(element.find(f"{{{NAMESPACE}}}pose"))
                self._unfold(definitions[definition], inner, f"{prefix}{name}/", definitions, result)
        joint_names: set[str] = set()
        for element in content.iterfind(f"{{{NAMESPACE}}}joints/{{{NAMESPACE}}}joint"):
            name = self._own_name("joint", element, joint_names)
            result.joints.append(_JointDescription(prefix + name, element, outer, prefix))

    def _own_name(self, kind: str, element: etree._Element, names: set[str]) -> str:
        name = element.get("name", "")
        if name in names:
            self._duplicate(kind, name, element)
        if kind == "part" and name == GROUND:
            self._problems.add(f"a part cannot be named {GROUND!r}", self._place(element), "Choose another name.")
        names.add(name)
        return name

    def _check_names(self, unfolded: _Unfolded) -> None:
        seen = {item.name for item in unfolded.parts}
        for element in self._root.iterfind(f"{{{NAMESPACE}}}ground/{{{NAMESPACE}}}plane"):
            name = element.get("name", "")
            if name in seen or name == GROUND:
                self._duplicate("plane", name, element)
            seen.add(name)
        if not unfolded.parts:
            self._problems.add("lists no part", self._place(self._root), "Export an assembly with at least one part.")
        self._problems.raise_if_any()

    # ----- parts -----

    def _part(self, item: _PartDescription, materials: dict[str, Material], count: int, index: int) -> Part | None:
        self._progress("read geometry", index / count, item.name)
        element = item.element
        place = self._place(element)
        properties = self._mass_properties(_child(element, "massProperties"), item)
        finding = check_tensor(properties)
        if finding is not None:
            self._problems.add(
                finding.message, self._place(_child(element, "massProperties"), item.name), finding.remedy
            )
        collision = element.find(f"{{{NAMESPACE}}}collision")
        start = element.find(f"{{{NAMESPACE}}}start")
        velocity = _numbers(start.get("velocity", "0 0 0") if start is not None else "0 0 0")
        angular_velocity = _numbers(start.get("angularVelocity", "0 0 0") if start is not None else "0 0 0")
        try:
            meshes = self._meshes(item)
        except CmbError as error:
            self._problems.record(error)
            return None
        if meshes and finding is None:
            self._compare(properties, meshes, item)
        if not meshes:
            self._notes.append(f"part {item.name!r} has no geometry: it moves, but does not collide and is not shown")
        return Part(
            name=item.name,
            material=self._material_name(element, materials),
            pose=item.pose,
            mass_properties=properties,
            meshes=meshes,
            collision=self._collision_choice(collision),
            grounded=element.get("grounded", "false") in ("true", "1"),
            velocity=to_si(velocity, self._units.length),
            angular_velocity=angular_velocity * self._units.angle,
            place=place,
            decomposition=self._decomposition(collision, "error"),
        )

    def _collision_choice(self, collision: etree._Element | None) -> CollisionChoice:
        """The part's own choice, else the assembly's."""
        contacts = self._root.find(f"{{{NAMESPACE}}}contacts")
        choice = collision.get("shape") if collision is not None else None
        if choice is None and contacts is not None:
            choice = contacts.get("collision")
        return CollisionChoice(choice or "auto")

    def _decomposition(self, element: etree._Element | None, error_name: str) -> DecompositionLimits:
        if element is None:
            return DecompositionLimits()
        error, pieces = element.get(error_name), element.get("maxPieces")
        return DecompositionLimits(
            float(error) * self._units.length if error is not None else None,
            int(pieces) if pieces is not None else None,
        )

    def _compare(self, properties: MassProperties, meshes: tuple[Mesh, ...], item: _PartDescription) -> None:
        for finding in check_against_geometry(properties, meshes):
            place = self._place(_child(item.element, "massProperties"), item.name)
            if finding.wrong:
                self._problems.add(finding.message, place, finding.remedy)
            else:
                self._notes.append(f"part {item.name!r}: {finding.message}")

    def _meshes(self, item: _PartDescription) -> tuple[Mesh, ...]:
        meshes: list[Mesh] = []
        inner = item.outer.inverse() @ item.pose
        for element in item.element.iterfind(f"{{{NAMESPACE}}}geometry"):
            reference = GeometryReference(
                file=element.get("file", ""),
                node=element.get("node"),
                coordinates=element.get("coordinates", ""),
                length=LENGTH[element.get("length", "")],
                place=self._place(element, item.name),
            )
            if reference.coordinates == "node" and reference.node is None:
                raise InputError(
                    "geometry in the coordinates of a node names no node",
                    place=reference.place,
                    remedy="Add the attribute node, or use coordinates='file'.",
                )
            meshes += self._geometry.meshes(reference, inner)
        return tuple(meshes)

    def _mass_properties(self, element: etree._Element, item: _PartDescription) -> MassProperties:
        mass = to_si(float(_text(_child(element, "mass"))), self._units.mass)
        center = to_si(_numbers(_text(_child(element, "centerOfMass"))), self._units.length)
        inertia = _child(element, "inertia")
        value = {key: float(inertia.get(key, "")) for key in ("xx", "yy", "zz", "xy", "xz", "yz")}
        sign = -1.0 if inertia.get("products") == "integral" else 1.0
        tensor = np.array(
            [
                [value["xx"], sign * value["xy"], sign * value["xz"]],
                [sign * value["xy"], value["yy"], sign * value["yz"]],
                [sign * value["xz"], sign * value["yz"], value["zz"]],
            ]
        )
        tensor = to_si(to_si(to_si(tensor, self._units.length), self._units.length), self._units.mass) + 0.0
        if inertia.get("axes") == "assembly":
            rotation = (item.outer.inverse() @ item.pose).rotation
            tensor = rotation.T @ tensor @ rotation
            tensor = (tensor + tensor.T) / 2
        if inertia.get("about") == "origin":
            tensor = tensor - mass * (center @ center * np.eye(3) - np.outer(center, center))
        return MassProperties(mass, center, tensor)

    def _pose(self, element: etree._Element | None) -> Pose:
        if element is None:
            return IDENTITY
        position = np.zeros(3)
        rotation = np.eye(3)
        for child in element:
            kind = etree.QName(child).localname
            if kind == "position":
                position = to_si(_numbers(child.text), self._units.length)
            elif kind == "rotation":
                rotation = self._rotation_matrix(child)
            elif kind == "axisAngle":
                axis = self._unit(_numbers(child.get("axis", "")), child, "the axis")
                rotation = rotation_about(axis, float(child.get("angle", "")) * self._units.angle)
            elif kind == "quaternion":
                quaternion = _numbers(child.text)
                self._unit(quaternion, child, "the quaternion")
                rotation = rotation_of_quaternion(quaternion if quaternion.any() else [1.0, 0.0, 0.0, 0.0])
            else:
                rotation = rotation_of_roll_pitch_yaw(_numbers(child.text) * self._units.angle)
        return Pose(position, rotation)

    def _rotation_matrix(self, element: etree._Element) -> Array:
        given = _numbers(element.text).reshape(3, 3)
        nearest, difference = nearest_rotation(given)
        if difference > ROTATION_TOLERANCE:
            self._problems.add(
                f"the matrix is not a rotation: its columns must be orthogonal unit vectors (off by {difference:.2g})",
                self._place(element),
                "Scaled or sheared coordinate systems are not poses; export the part at its true size.",
            )
            return np.eye(3)
        if np.linalg.det(nearest) < 0:
            self._problems.add(
                "the matrix mirrors (its determinant is -1)",
                self._place(element),
                "A mirrored part is another part: export it with geometry, centre of mass and inertia of its own.",
            )
            return np.eye(3)
        return nearest

    # ----- joints -----

    def _joint(self, item: _JointDescription, parts: dict[str, _PartDescription]) -> Joint | None:
        element = item.element
        place = self._place(element, item.name)
        kind = JointType(element.get("type", ""))
        parent = element.get("parent", "")
        parent = GROUND if parent == GROUND else item.prefix + parent
        child = item.prefix + element.get("child", "")
        unknown = [name for name in (parent, child) if name != GROUND and name not in parts]
        for name in unknown:
            self._unknown(f"the joint {item.name!r}", name, parts, element)
        if child == GROUND or element.get("child") == GROUND:
            self._problems.add(f"{GROUND!r} cannot be a child", place, "Exchange parent and child.")
        if unknown:
            return None
        if parent == child:
            self._problems.add(f"joins {parent!r} with itself", place, "Name two different parts.")
            return None
        frames = {
            "assembly": item.outer,
            "parent": IDENTITY if parent == GROUND else parts[parent].pose,
            "child": parts[child].pose,
        }
        origin_element = element.find(f"{{{NAMESPACE}}}origin")
        origin = parts[child].pose.position
        if origin_element is not None:
            origin = frames[origin_element.get("frame", "assembly")].point(
                to_si(_numbers(origin_element.text), self._units.length)
            )
        elif kind not in (JointType.FIXED, JointType.FREE):
            self._problems.add(f"a {kind.value} joint needs an origin", place, "Add the element origin.")
        axis = self._axis(element, "axis", frames, kind.needs_axis, kind)
        second = self._axis(element, "axis2", frames, kind is JointType.UNIVERSAL, kind)
        if axis is not None and second is not None and abs(float(axis @ second)) > RIGHT_ANGLE_TOLERANCE:
            self._problems.add("axis and axis2 are not at a right angle", place, "Correct the axes.")
        return self._with_start(item, kind, parent, child, (origin, axis, second), place)

    def _axis(
        self, element: etree._Element, tag: str, frames: dict[str, Pose], needed: bool, kind: JointType
    ) -> Array | None:
        child = element.find(f"{{{NAMESPACE}}}{tag}")
        if child is None:
            if needed:
                self._problems.add(
                    f"a {kind.value} joint needs an {tag}", self._place(element), f"Add the element {tag}."
                )
            return None
        if not needed:
            self._problems.add(f"a {kind.value} joint has no {tag}", self._place(child), f"Remove the element {tag}.")
            return None
        return frames[child.get("frame", "assembly")].direction(self._unit(_numbers(child.text), child, "the axis"))

    def _with_start(
        self,
        item: _JointDescription,
        kind: JointType,
        parent: str,
        child: str,
        geometry: tuple[Array, Array | None, Array | None],
        place: Place,
    ) -> Joint:
        start = item.element.find(f"{{{NAMESPACE}}}start")
        given = {str(key): str(value) for key, value in start.items()} if start is not None else {}
        scalar = kind in (JointType.REVOLUTE, JointType.PRISMATIC)
        allowed = ("position", "speed") if scalar else ("velocity", "angularVelocity")
        for key in given:
            if key not in allowed or kind is JointType.FIXED:
                self._problems.add(
                    f"the start of a {kind.value} joint has no {key}",
                    self._place(start),
                    f"Possible: {', '.join(allowed)}.",
                )
        unit = self._units.angle if kind is JointType.REVOLUTE else self._units.length
        velocity = item.outer.direction(_numbers(given.get("velocity", "0 0 0")))
        angular_velocity = item.outer.direction(_numbers(given.get("angularVelocity", "0 0 0")))
        return Joint(
            name=item.name,
            type=kind,
            parent=parent,
            child=child,
            origin=geometry[0],
            axis=geometry[1],
            second_axis=geometry[2],
            position=to_si(float(given.get("position", "0")), unit),
            speed=to_si(float(given.get("speed", "0")), unit),
            velocity=to_si(velocity, self._units.length),
            angular_velocity=angular_velocity * self._units.angle,
            place=place,
        )

    # ----- helpers -----

    def _place(self, element: etree._Element | None, component: str | None = None) -> Place:
        if element is None:
            return Place(file=self._file, component=component)
        return Place(file=self._file, line=line_of(element), component=component or _component(element))

    def _unit(self, vector: Array, element: etree._Element, what: str) -> Array:
        length = np.linalg.norm(vector)
        if length < 1e-9:
            self._problems.add(f"{what} is the zero vector", self._place(element), "Give a direction.")
            fallback: Array = np.eye(len(vector))[-1]
            return fallback
        unit: Array = vector / length
        return unit

    def _duplicate(self, kind: str, name: str, element: etree._Element) -> None:
        self._problems.add(
            f"there is another {kind} or part of the name {name!r}",
            self._place(element, name),
            "Names must be unique; rename one in the CAD system.",
        )

    def _unknown(self, what: str, name: str, known: Iterable[str], element: etree._Element) -> None:
        self._problems.add(
            f"{what} names {name!r}, which does not exist",
            self._place(element),
            f"There are: {', '.join(sorted(known)[:30]) or 'none'}.",
        )


def _component(element: etree._Element) -> str | None:
    return element.get("name")


def _child(element: etree._Element, tag: str) -> etree._Element:
    found = element.find(f"{{{NAMESPACE}}}{tag}")
    if found is None:
        raise AssertionError(f"the schema guarantees {tag}")
    return found


def _text(element: etree._Element) -> str:
    return element.text or ""


def _numbers(text: str | None) -> Array:
    return np.array((text or "").split(), dtype=np.float64)


def _optional(element: etree._Element, name: str) -> float | None:
    value = element.get(name)
    return None if value is None else float(value)
