"""The report on a generation: what was found in the assembly, what was decided, and why."""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined, Template

from cad2modelica.actuators.placement import Actuator
from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.collision.start_overlaps import StartCheck
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.kinematics.planar_loops import Loop
from cad2modelica.mechanism.model import Assembly, Joint, JointType, Part
from cad2modelica.modelica.view import MechanismView

LISTED_OVERLAPS = 50


@dataclass(frozen=True)
class ReportInput:
    """What a report is made of.

    Attributes:
        drawing: the graph as SVG.
        pictures: PNG of the parts and of what they collide as; None if there is nothing to see.
        structure: signature of the mechanics' structure.
    """

    name: str
    assembly: Assembly
    tree: KinematicTree
    loops: LoopAnalysis
    geometries: Mapping[str, CollisionGeometry]
    view: MechanismView
    actuators: Sequence[Actuator]
    start: StartCheck
    notes: Sequence[str]
    drawing: str
    pictures: tuple[bytes, bytes] | None
    structure: str


@cache
def _template() -> Template:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        undefined=StrictUndefined,
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    return environment.get_template("report.html.jinja")


def report_html(given: ReportInput) -> str:
    """The report as one HTML page without anything outside of it; the same input gives the same bytes."""
    pairs = given.view.contacts.pairs if given.view.contacts is not None else ()
    bodies = {part.name for part in given.assembly.parts}
    return _template().render(
        name=given.name,
        label=given.assembly.name,
        file=given.assembly.file.name,
        source=given.assembly.source,
        drawing=given.drawing,
        pictures=[base64.b64encode(picture).decode() for picture in given.pictures or ()],
        structure=given.structure,
        freedoms=given.loops.freedoms,
        free=[branch.part.name for branch in given.tree.branches if branch.predecessor is None],
        pairs=len(pairs),
        parts=[_part(part, given) for part in given.assembly.parts],
        joints=[_joint(joint, given) for joint in given.assembly.joints if joint.type is not JointType.FREE],
        loops=[_loop(number, loop, given) for number, loop in enumerate(given.loops.loops, start=1)],
        actuators=given.actuators,
        start=given.start,
        overlaps=[
            {
                "pair": f"{item.first} and {item.second}",
                "depth": f"{1000 * item.depth:.4g} mm",
                "share": f"{100 * item.share:.2g} %",
                "deep": item.deep,
                "planes": item.first not in bodies or item.second not in bodies,
            }
            for item in given.start.overlaps[:LISTED_OVERLAPS]
        ],
        more_overlaps=max(0, len(given.start.overlaps) - LISTED_OVERLAPS),
        notes=given.notes,
    )


def _part(part: Part, given: ReportInput) -> dict[str, Any]:
    shapes = Counter(shape.kind for shape in given.geometries[part.name].shapes)
    return {
        "name": part.name,
        "modelica": given.view.part_names[part.name],
        "mass": f"{part.mass_properties.mass:.4g}",
        "shapes": ", ".join(f"{count} {kind}" if count > 1 else kind for kind, count in shapes.items()) or "none",
        "stands": "fixed" if part.name in given.tree.fixed else _reached(part, given),
    }


def _reached(part: Part, given: ReportInput) -> str:
    branch = given.tree.branch(part.name)
    if branch.predecessor is None:
        return "moves freely, or is the first of a free group"
    return f"by {branch.joint.name!r}" if branch.joint is not None else "on the ground"


def _joint(joint: Joint, given: ReportInput) -> dict[str, Any]:
    loops = [str(k) for k, loop in enumerate(given.loops.loops, start=1) if any(j is joint for j, _ in loop.steps)]
    cut = any(item is joint for item in given.tree.cut_joints)
    if joint.name in given.loops.planar_constraints:
        role = "closes a planar loop: planar loop constraint, no coordinate"
    elif joint.name in given.loops.closures:
        empty = given.loops.closures[joint.name].is_empty
        role = "left out: repeats what others hold" if empty else "closes a loop, with a loop closure behind it"
    elif cut:
        role = "closes a loop in space"
    else:
        role = "in the tree"
    role += "".join(f", follows {item.leader!r}" for item in given.assembly.couplings if item.follower == joint.name)
    return {
        "name": joint.name,
        "modelica": given.view.joint_names[joint.name],
        "type": joint.type.value,
        "way": f"{joint.parent} → {joint.child}",
        "role": role,
        "cut": cut,
        "loops": ", ".join(loops),
        "start": _start(joint, given),
    }


def _start(joint: Joint, given: ReportInput) -> str:
    flags = given.loops.independent[joint.name]
    if joint.name in given.loops.planar_constraints or not flags:
        return ""
    if all(flags):
        return "as given: state"
    if not any(flags):
        return "follows from the loops"
    return f"{sum(flags)} of {len(flags)} coordinates as given, the others follow from the loops"


def _loop(number: int, loop: Loop, given: ReportInput) -> dict[str, Any]:
    closure = given.loops.closures.get(loop.joint.name)
    if closure is not None:
        why = f"{closure.note[0].upper()}{closure.note[1:]}."
    elif loop.normal is not None:
        normal = ", ".join(f"{value:.6g}" for value in loop.normal + 0.0)
        why = (
            f"All its joints move across the direction ({normal}): three conditions close it. The revolute joint that "
            "is listed last, and has no stops or friction if there is such a one, becomes the planar loop constraint."
        )
    else:
        why = "Not planar: six conditions close it. The joint stays what it is and is connected to both its bodies."
    return {
        "number": number,
        "kind": "planar" if loop.normal is not None else "in space",
        "closing": loop.joint.name,
        "joints": ", ".join(joint.name for joint, _ in loop.steps),
        "why": why,
    }
