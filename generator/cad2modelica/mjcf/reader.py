"""MJCF to the model: bodies, joints, masses, geometry, loops, contacts and actuators, at the joints' reference.

The format of MuJoCo as its XML reference documents it (mujoco.readthedocs.io, XMLreference): the compiler's defaults,
default classes, and the rules by which masses follow from geometry are those of MuJoCo 3 and 4.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from pathlib import Path, PurePosixPath

import numpy as np
from contact_foundation.progress import Progress, silent
from lxml import etree

from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.description_defaults import GRAVITY
from cad2modelica.mechanism.model import Assembly, Joint, JointFriction, JointSpring, Part
from cad2modelica.mechanism.moved_inertia import inertia_about
from cad2modelica.meshio.mesh_library import MeshLibrary
from cad2modelica.meshio.mesh_reference import MeshReferences
from cad2modelica.mjcf.assets import MjcfAssets
from cad2modelica.mjcf.bodies import BodyTree, read_bodies
from cad2modelica.mjcf.contacts import contact_settings, pair_geoms
from cad2modelica.mjcf.document import MAIN, MjcfDocument
from cad2modelica.mjcf.drives import read_drives
from cad2modelica.mjcf.effective_inertia import effective_inertias
from cad2modelica.mjcf.elements import Compiler, Item, MjcfElements
from cad2modelica.mjcf.equalities import held, read_equalities
from cad2modelica.mjcf.joints import MjcfJoints, read_joints
from cad2modelica.mjcf.parts import MjcfParts, PartReader
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.source.problems import Problems

_LOST_SECTIONS = {
    "tendon": "tendons",
    "deformable": "flexible bodies and skins",
    "extension": "plugins",
    "sensor": "sensors",
    "keyframe": "keyframes (the start is that of the joints' reference)",
}
_FLUID = ("density", "viscosity", "wind")


def read_mjcf(
    root: etree._Element, path: Path, progress: Progress = silent, choices: SourceChoices = DEFAULT_CHOICES
) -> Assembly:
    """Reads a model of MuJoCo.

    Args:
        root: the element ``mujoco``; it is changed.
        path: the file.
        progress: is told which body is being read.
        choices: where files may lie, and what becomes of meshes that cannot be read.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    problems = Problems(str(path))
    elements = MjcfElements(path, problems, [])
    references = MeshReferences(path, choices.package_paths)
    document = MjcfDocument(root, elements, references)
    problems.raise_if_any()
    elements.compiler = _compiler(document, elements)
    assets = MjcfAssets(document, elements, MeshLibrary(references))
    tree = read_bodies(document, elements)
    problems.raise_if_any()
    parts = PartReader(tree, elements, assets, pair_geoms(document), choices).read(progress)
    joints = read_joints(tree, parts.hosts, elements)
    problems.raise_if_any()
    return _assembly(root, path, document, elements, tree, parts, joints)


def _assembly(
    root: etree._Element,
    path: Path,
    document: MjcfDocument,
    elements: MjcfElements,
    tree: BodyTree,
    parts: MjcfParts,
    joints: MjcfJoints,
) -> Assembly:
    all_parts = {**parts.parts, **{part.name: part for part in joints.between}}
    inertias = {joint.name: _moved_inertia(joint, joints.joints, all_parts) for joint in joints.joints.values()}
    timed = _without(document.disabled, _with_time_springs(joints, all_parts))
    equalities = read_equalities(document, elements, tree, parts.hosts, timed)
    final = held(timed, equalities.held)
    drives = read_drives(document, elements, final, inertias)
    contacts = contact_settings(document, elements, parts, lossy=bool(tree.lost))
    _note_losses(document, elements, tree)
    elements.problems.raise_if_any()
    if not any(not part.grounded for part in all_parts.values()):
        left_out = ", ".join(sorted(tree.lost))
        reason = f" beside what is left out ({left_out})" if left_out else ""
        remedy = "Name the model itself, not one of the files it includes."
        elements.problems.add(f"holds no rigid body that moves{reason}", elements.place(root), remedy)
        elements.problems.raise_if_any()
    return Assembly(
        name=root.get("model", "") or path.stem,
        source="MJCF",
        file=path,
        gravity=_gravity(document, elements),
        materials=tuple(parts.materials.values()),
        planes=tuple(plane for plane, _ in parts.planes),
        parts=tuple(all_parts.values()),
        joints=(*final.values(), *equalities.closing),
        contacts=contacts,
        notes=tuple(elements.notes),
        limits_stop=True,
        couplings=tuple(item for item in equalities.couplings if not {item.follower, item.leader} & equalities.held),
        aliases={name: host for name, host in parts.hosts.items() if name not in all_parts},
        drives=drives,
    )


def _compiler(document: MjcfDocument, elements: MjcfElements) -> Compiler:
    given: dict[str, str] = {}
    for section in document.sections("compiler"):
        given |= {str(key): str(value) for key, value in section.items()}
        last = section
    if not given:
        return Compiler()
    item = Item(last, given)
    sequence = item.text("eulerseq", "xyz")
    if len(sequence) != 3 or not set(sequence) <= set("xyzXYZ"):
        elements.problems.add(f"eulerseq={sequence!r} is no sequence", elements.place(last), "Three of x, y, z.")
        sequence = "xyz"
    if item.text("coordinate", "local") != "local":
        elements.problems.add(
            "global coordinates are not read", elements.place(last), "Save the model with a newer MuJoCo."
        )
    if item.text("inertiafromgeom", "auto") not in ("auto", "true", "false"):
        elements.problems.add("inertiafromgeom is auto, true or false", elements.place(last), "Correct the word.")
    low, high = elements.numbers(item, "inertiagrouprange", (0.0, 5.0))
    return Compiler(
        radians=item.text("angle", "degree") == "radian",
        euler_sequence=sequence,
        autolimits=item.text("autolimits", "true") == "true",
        mesh_folder=PurePosixPath(item.text("meshdir") or item.text("assetdir")).as_posix(),
        strip_path=item.text("strippath") == "true",
        from_geometry=item.text("inertiafromgeom", "auto"),
        groups=(int(low), int(high)),
        least_mass=elements.number(item, "boundmass"),
        least_inertia=elements.number(item, "boundinertia"),
        total_mass=elements.number(item, "settotalmass", -1.0),
        balance=item.text("balanceinertia") == "true",
    )


def _gravity(document: MjcfDocument, elements: MjcfElements) -> Array:
    gravity = np.array(GRAVITY)
    for section in document.sections("option"):
        gravity = elements.numbers(document.item(section, MAIN), "gravity", tuple(gravity))
    return np.zeros(3) if "gravity" in document.disabled else gravity


def _moved_inertia(joint: Joint, joints: dict[str, Joint], parts: dict[str, Part]) -> float:
    """Inertia in a joint's coordinate of all that it moves at the start, with its rotor; 0 for several freedoms."""
    if not joint.type.is_scalar:
        return 0.0
    children: dict[str, list[str]] = {}
    for other in joints.values():
        children.setdefault(other.parent, []).append(other.child)
    moved, queue = [], [joint.child]
    while queue:
        name = queue.pop()
        moved.append(parts[name])
        queue += children.get(name, [])
    return joint.rotor_inertia + sum(inertia_about(joint, part) for part in moved)


def _with_time_springs(joints: MjcfJoints, parts: dict[str, Part]) -> dict[str, Joint]:
    """Joints with springs and dampers that were given by time constant and damping ratio (``springdamper``)."""
    result = dict(joints.joints)
    inertias = effective_inertias(result, parts) if joints.time_springs else {}
    for name, (constant, ratio) in joints.time_springs.items():
        joint = result[name]
        rest = joint.spring.rest if joint.spring is not None else 0.0
        dry = joint.friction.dry if joint.friction is not None else 0.0
        result[name] = replace(
            joint,
            spring=JointSpring(inertias[name] / (constant * ratio) ** 2, rest),
            friction=JointFriction(2.0 * inertias[name] / constant, dry),
        )
    return result


def _without(disabled: Collection[str], joints: dict[str, Joint]) -> dict[str, Joint]:
    """The joints without what the model's options switch off."""

    def changed(joint: Joint) -> Joint:
        spring = joint.spring if "spring" not in disabled else None
        limits = joint.limits if "limit" not in disabled else None
        viscous, dry = (joint.friction.viscous, joint.friction.dry) if joint.friction is not None else (0.0, 0.0)
        friction = JointFriction(viscous * ("damper" not in disabled), dry * ("frictionloss" not in disabled))
        kept = friction if max(friction.viscous, friction.dry) > 0.0 else None
        return replace(joint, spring=spring, limits=limits, friction=kept)

    return {name: changed(joint) for name, joint in joints.items()} if disabled else joints


def _note_losses(document: MjcfDocument, elements: MjcfElements, tree: BodyTree) -> None:
    """Tells once for each kind what the model has and the mechanism does not."""
    for section, words in _LOST_SECTIONS.items():
        count = sum(len(element) for element in document.sections(section))
        if count:
            elements.notes.append(Lost(f"left out: {count} {words}"))
    for tag, count in tree.lost.items():
        elements.notes.append(Lost(f"left out: {count} elements {tag!r} of bodies"))
    for option in document.sections("option"):
        given = [key for key in _FLUID if option.get(key, "0").strip("0. ")]
        if given:
            elements.notes.append(Lost(f"left out: {', '.join(given)} of the medium around the bodies"))
