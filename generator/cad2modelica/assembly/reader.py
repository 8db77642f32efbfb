"""Assembly XML to the model: units, poses, nested assemblies, references between names."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from contact_data import assembly_schema
from contact_foundation.errors import CmbError, InputError, Place
from contact_foundation.progress import Progress, silent
from lxml import etree

from cad2modelica.assembly.elements import NAMESPACE, ElementReader, child, numbers, optional, text
from cad2modelica.assembly.joints import read_joint
from cad2modelica.assembly.part_geometry import GeometryReader, GeometryReference
from cad2modelica.assembly.unfolding import PartDescription, Unfolded, Unfolder
from cad2modelica.geometry.mesh import Mesh
from cad2modelica.mechanism.angle_units import angle_notes
from cad2modelica.mechanism.description_defaults import GRAVITY, STOP_TIME, TOLERANCE
from cad2modelica.mechanism.mass_check import check_against_geometry, check_tensor
from cad2modelica.mechanism.model import (
    GROUND,
    Assembly,
    CollisionChoice,
    ContactSettings,
    Decomposer,
    DecompositionLimits,
    MassProperties,
    Material,
    Part,
    Plane,
)
from cad2modelica.source.problems import Problems
from cad2modelica.source.units import ANGLE, LENGTH, MASS, UnitSystem, to_si
from cad2modelica.source.xml_document import line_of, validate


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
            remedy=f"The root element must be 'assembly' in the namespace {NAMESPACE!r}, URDF's 'robot', MJCF's "
            "'mujoco', SDFormat's 'sdf', or 'SimscapeMultibodyImportXML'.",
        )
    validate(root, assembly_schema(), path)
    return _Reader(path, root, progress).read()


class _Reader:
    def __init__(self, file: Path, root: etree._Element, progress: Progress) -> None:
        self._file = file
        self._root = root
        self._progress = progress
        units = child(root, "units")
        self._units = UnitSystem(
            LENGTH[units.get("length", "")], MASS[units.get("mass", "")], ANGLE[units.get("angle", "")]
        )
        self._problems = Problems(str(file))
        self._read = ElementReader(file, self._units, self._problems)
        self._geometry = GeometryReader(file.parent)
        self._notes = [*angle_notes(root, units.get("angle", ""))]

    def read(self) -> Assembly:
        root = self._root
        materials = self._materials()
        planes = self._planes(materials)
        unfolded = Unfolder(root, self._read).unfold()
        self._problems.raise_if_any()
        self._check_names(unfolded)
        parts = tuple(self._part(item, materials, len(unfolded.parts), k) for k, item in enumerate(unfolded.parts))
        kept = {part.name: part for part in parts if part is not None}
        descriptions = {item.name: item for item in unfolded.parts}
        joints = [read_joint(self._read, item, descriptions) for item in unfolded.joints]
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
            gravity=numbers(gravity.text) if gravity is not None else np.array(GRAVITY),
            stop_time=float(simulation.get("stopTime", "")) if simulation is not None else STOP_TIME,
            tolerance=float(simulation.get("tolerance", TOLERANCE)) if simulation is not None else TOLERANCE,
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
                self._read.duplicate("material", name, element)
            materials[name] = Material(
                name,
                density=optional(element, "density"),
                youngs_modulus=optional(element, "youngsModulus"),
                poissons_ratio=optional(element, "poissonsRatio"),
                restitution=optional(element, "restitution"),
                static_friction=optional(element, "staticFriction"),
                dynamic_friction=optional(element, "dynamicFriction"),
            )
        return materials

    def _material_name(self, element: etree._Element, materials: dict[str, Material]) -> str | None:
        name = element.get("material")
        if name is not None and name not in materials:
            self._problems.add(
                f"uses the material {name!r}, which is not defined",
                self._read.place(element),
                f"Defined materials: {', '.join(sorted(materials)) or 'none'}.",
            )
        return name

    def _planes(self, materials: dict[str, Material]) -> list[Plane]:
        planes = []
        for element in self._root.iterfind(f"{{{NAMESPACE}}}ground/{{{NAMESPACE}}}plane"):
            normal = self._read.unit(numbers(element.get("normal", "0 0 1")), element, "the normal")
            planes.append(
                Plane(
                    name=element.get("name", ""),
                    material=self._material_name(element, materials),
                    position=to_si(numbers(element.get("position", "0 0 0")), self._units.length),
                    normal=normal,
                    place=self._read.place(element),
                )
            )
        return planes

    def _contacts(self, names: set[str]) -> ContactSettings:
        element = self._root.find(f"{{{NAMESPACE}}}contacts")
        if element is None:
            return ContactSettings()
        pairs: dict[str, list[tuple[str, str]]] = {"exclude": [], "include": []}
        for pair in element:
            first, second = pair.get("first", ""), pair.get("second", "")
            for name in (first, second):
                if name not in names:
                    self._read.unknown("the contact pair", name, names, pair)
            if first == second:
                self._problems.add(f"pairs {first!r} with itself", self._read.place(pair), "Name two different parts.")
            pairs[etree.QName(pair).localname].append((first, second))
        stiffness = element.get("stiffness")
        return ContactSettings(
            all_pairs=element.get("default", "all") == "all",
            excluded=tuple(pairs["exclude"]),
            included=tuple(pairs["include"]),
            stiffness=float(stiffness) if stiffness is not None else None,
            friction=element.get("friction"),
            decomposition=self._decomposition(element, "collisionError"),
        )

    def _check_names(self, unfolded: Unfolded) -> None:
        seen = {item.name for item in unfolded.parts}
        for element in self._root.iterfind(f"{{{NAMESPACE}}}ground/{{{NAMESPACE}}}plane"):
            name = element.get("name", "")
            if name == GROUND:
                self._read.problems.add(
                    f"a plane cannot be named {GROUND!r}", self._read.place(element), "Choose another name."
                )
            elif name in seen:
                self._read.duplicate("plane", name, element)
            seen.add(name)
        if not unfolded.parts:
            self._problems.add(
                "lists no part", self._read.place(self._root), "Export an assembly with at least one part."
            )
        self._problems.raise_if_any()

    # ----- parts -----

    def _part(self, item: PartDescription, materials: dict[str, Material], count: int, index: int) -> Part | None:
        self._progress("read geometry", index / count, item.name)
        element = item.element
        place = self._read.place(element)
        properties = self._mass_properties(child(element, "massProperties"), item)
        finding = check_tensor(properties)
        if finding is not None:
            self._problems.add(
                finding.message, self._read.place(child(element, "massProperties"), item.name), finding.remedy
            )
        collision = element.find(f"{{{NAMESPACE}}}collision")
        start = element.find(f"{{{NAMESPACE}}}start")
        velocity = numbers(start.get("velocity", "0 0 0") if start is not None else "0 0 0")
        angular_velocity = numbers(start.get("angularVelocity", "0 0 0") if start is not None else "0 0 0")
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
            grounded=element.get("grounded", "false").strip() in ("true", "1"),
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
        decomposer = element.get("decomposer")
        return DecompositionLimits(
            float(error) * self._units.length if error is not None else None,
            int(pieces) if pieces is not None else None,
            decomposer=Decomposer(decomposer) if decomposer is not None else None,
        )

    def _compare(self, properties: MassProperties, meshes: tuple[Mesh, ...], item: PartDescription) -> None:
        for finding in check_against_geometry(properties, meshes):
            place = self._read.place(child(item.element, "massProperties"), item.name)
            if finding.wrong:
                self._problems.add(finding.message, place, finding.remedy)
            else:
                self._notes.append(f"part {item.name!r}: {finding.message}")

    def _meshes(self, item: PartDescription) -> tuple[Mesh, ...]:
        meshes: list[Mesh] = []
        for element in item.element.iterfind(f"{{{NAMESPACE}}}geometry"):
            reference = GeometryReference(
                file=element.get("file", ""),
                node=element.get("node"),
                coordinates=element.get("coordinates", ""),
                length=LENGTH[element.get("length", "")],
                place=self._read.place(element, item.name),
            )
            if reference.coordinates == "node" and reference.node is None:
                raise InputError(
                    "geometry in the coordinates of a node names no node",
                    place=reference.place,
                    remedy="Add the attribute node, or use coordinates='file'.",
                )
            meshes += self._geometry.meshes(reference, item.local)
        return tuple(meshes)

    def _mass_properties(self, element: etree._Element, item: PartDescription) -> MassProperties:
        mass = to_si(float(text(child(element, "mass"))), self._units.mass)
        center = to_si(numbers(text(child(element, "centerOfMass"))), self._units.length)
        inertia = child(element, "inertia")
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
            rotation = item.local.rotation
            tensor = rotation.T @ tensor @ rotation
            tensor = (tensor + tensor.T) / 2
        if inertia.get("about") == "origin":
            tensor = tensor - mass * (center @ center * np.eye(3) - np.outer(center, center))
        return MassProperties(mass, center, tensor)
