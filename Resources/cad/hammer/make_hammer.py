"""Models the hammer with CadQuery and writes its CAD export: STEP, VRML 2.0 and the assembly XML.

The shapes, the VRML text, masses, centres of mass and inertias all come from the CAD kernel
(Open CASCADE): ``VrmlAPI_Writer`` writes the VRML file, ``GProp_GProps`` weighs the solids.
Lengths are millimetres, angles degrees, as usual in CAD.

Run: ``python make_hammer.py [FOLDER]`` (needs ``pip install cadquery``); the folder is that of
this script if left out.
"""

from __future__ import annotations

import math
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import cadquery as cq
from cadquery.occ_impl.exporters.assembly import exportAssembly

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))  # cad_export lies beside the samples' folders

from cad_export import (
    add,
    add_mass_properties,
    new_assembly,
    number,
    numbers,
    solid_of,
    vrml_name,
    weigh,
    write_vrml,
    write_xml,
)

CHORD_ERROR = 0.25  # mm
ANGLE_ERROR = 0.30  # rad

SHOULDER = (0.0, 0.0, 155.0)
ARM_LENGTH = 180.0
ARM_START_ANGLE = -75.0  # about +y: the arm points up
HEAD_START_ANGLE = 20.0  # about +y, absolute
PIVOT_ABOVE_CENTRE = 4.0  # the head turns about an axis a little above its centre
BALL_RADIUS = 22.0
ANVIL_TOP = 120.0
ANVIL_EDGE = 295.0  # x of the far edge of the flat top
BALL_OVERHANG = 1.0  # the ball's centre stands so far beyond that edge: it will roll off

DENSITY = {"steel": 7850.0, "aluminium": 2700.0, "concrete": 2400.0}  # kg/m3


@dataclass(frozen=True)
class PartModel:
    """One part: its solids in the part's own coordinate system and where the part stands."""

    name: str
    material: str
    solids: tuple[cq.Solid, ...]
    color: tuple[float, float, float]
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    angle_about_y: float = 0.0
    grounded: bool = False

    @property
    def compound(self) -> cq.Compound:
        """All solids as one shape."""
        return cq.Compound.makeCompound(list(self.solids))

    @property
    def location(self) -> cq.Location:
        """The pose in the assembly."""
        return cq.Location(self.position, (0, 1, 0), self.angle_about_y)


def stadium(length: float, radius: float, half_width: float) -> cq.Workplane:
    """A bar with round ends about the y axes at x = 0 and x = ``length``."""
    return (
        cq.Workplane("XZ", origin=(length / 2, half_width, 0))
        .slot2D(length + 2 * radius, 2 * radius)
        .extrude(2 * half_width)
    )


def pin(x: float, radius: float, y_from: float, y_to: float) -> cq.Workplane:
    """A cylinder along y."""
    return cq.Workplane("XZ", origin=(x, y_to, 0)).circle(radius).extrude(y_to - y_from)


def make_frame() -> PartModel:
    """A column beside the arm's plane, and the shoulder's pin."""
    column = cq.Workplane("XY").box(60, 48, 190, centered=(True, True, False)).translate((0, -52, 0))
    shoulder_pin = pin(0, 10, -28, 20).translate(SHOULDER)
    return PartModel(
        "frame", "aluminium", (solid_of(column), solid_of(shoulder_pin)), (0.35, 0.40, 0.45), grounded=True
    )


def make_arm() -> PartModel:
    """A bar with bores at both axes and a fork for the head: not convex."""
    bar = stadium(ARM_LENGTH, 18, 20).cut(pin(0, 10.2, -30, 30)).cut(pin(ARM_LENGTH, 8.2, -30, 30))
    slot = cq.Workplane("XY").box(120, 28, 60).translate((ARM_LENGTH, 0, 0))
    return PartModel("arm", "aluminium", (solid_of(bar.cut(slot)),), (0.80, 0.45, 0.10), SHOULDER, ARM_START_ANGLE)


def make_head() -> PartModel:
    """A striking block with bevelled edges and two pins: three bodies that touch; the origin lies on the pins' axis."""
    block = (
        cq.Workplane("XY").box(70, 26, 70).faces(">Z or <Z").edges().chamfer(5).translate((0, 0, -PIVOT_ABOVE_CENTRE))
    )
    angle = math.radians(ARM_START_ANGLE)
    elbow = (SHOULDER[0] + ARM_LENGTH * math.cos(angle), SHOULDER[1], SHOULDER[2] - ARM_LENGTH * math.sin(angle))
    return PartModel(
        "hammer head",
        "steel",
        (solid_of(block), solid_of(pin(0, 8, -20, -13)), solid_of(pin(0, 8, 13, 20))),
        (0.55, 0.57, 0.60),
        elbow,
        HEAD_START_ANGLE,
    )


def make_anvil() -> PartModel:
    """A block with a bevelled top; its origin lies in the middle of the underside."""
    block = cq.Workplane("XY").box(160, 80, ANVIL_TOP, centered=(True, True, False)).faces(">Z").edges().chamfer(15)
    return PartModel("anvil", "steel", (solid_of(block),), (0.25, 0.27, 0.30), (230.0, 0.0, 0.0), grounded=True)


def make_ball() -> PartModel:
    """A ball that touches the far edge of the anvil's flat top, its centre just beyond it."""
    height = ANVIL_TOP + math.sqrt(BALL_RADIUS**2 - BALL_OVERHANG**2)
    ball = cq.Workplane("XY").sphere(BALL_RADIUS)
    return PartModel("ball", "steel", (solid_of(ball),), (0.80, 0.10, 0.10), (ANVIL_EDGE + BALL_OVERHANG, 0.0, height))


def assembly_of(parts: list[PartModel], *, colored: bool) -> cq.Assembly:
    """The product structure: the swing's parts form an assembly of their own."""
    assembly = cq.Assembly(name="hammer")
    moving = cq.Assembly(name="swing")
    for part in parts:
        group = moving if part.name in ("arm", "hammer head") else assembly
        group.add(part.compound, name=part.name, loc=part.location, color=cq.Color(*part.color) if colored else None)
    assembly.add(moving, name="swing")
    return assembly


def write_step(assembly: cq.Assembly, file: Path) -> None:
    """Writes STEP; the time stamp is set to a fixed one so that the same model gives the same file."""
    exportAssembly(assembly, str(file))
    text = file.read_text(encoding="utf-8")
    file.write_text(re.sub(r"'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d'", "'2000-01-01T00:00:00'", text), encoding="utf-8")


def write_assembly(parts: list[PartModel], file: Path) -> None:
    """Writes the assembly's XML file."""
    root = new_assembly("Hammer")
    add(root, "description", "A hammer on a two-link swing falls on an anvil; a ball rolls off the anvil's edge")
    add(root, "source", system="CadQuery, Open CASCADE Technology", file="hammer.step")
    add(root, "units", length="mm", mass="kg", angle="deg")
    add(root, "gravity", "0 0 -9.81")
    add(root, "simulation", stopTime="2.5", tolerance="1e-6")
    materials = add(root, "materials")
    for name, modulus, ratio, friction in (
        ("steel", "2.1e11", "0.3", "0.3"),
        ("aluminium", "7.0e10", "0.33", "0.3"),
        ("concrete", "3.0e10", "0.2", "0.5"),
    ):
        add(
            materials,
            "material",
            name=name,
            density=number(DENSITY[name]),
            youngsModulus=modulus,
            poissonsRatio=ratio,
            restitution="0.4",
            staticFriction=friction,
            dynamicFriction=friction,
        )
    ground = add(root, "ground")
    add(ground, "plane", name="floor", material="concrete")
    section = add(root, "parts")
    for part in parts:
        element = add(section, "part", name=part.name, material=part.material)
        if part.grounded:
            element.set("grounded", "true")
        pose = add(element, "pose")
        add(pose, "position", numbers(*part.position))
        if part.angle_about_y:
            add(pose, "axisAngle", axis="0 1 0", angle=number(part.angle_about_y))
        add_mass_properties(element, weigh((solid, DENSITY[part.material]) for solid in part.solids))
        add(element, "geometry", file="hammer.wrl", node=vrml_name(part.name), coordinates="node", length="mm")
    joints = add(root, "joints")
    head = next(part for part in parts if part.name == "hammer head")
    for name, parent, child, origin, angle in (
        ("shoulder", "frame", "arm", SHOULDER, ARM_START_ANGLE),
        ("elbow", "arm", "hammer head", head.position, HEAD_START_ANGLE - ARM_START_ANGLE),
    ):
        joint = add(joints, "joint", name=name, type="revolute", parent=parent, child=child)
        add(joint, "origin", numbers(*origin), frame="assembly")
        add(joint, "axis", "0 1 0", frame="assembly")
        add(joint, "start", position=number(angle), speed="0")
    contacts = add(root, "contacts", default="all", stiffness="1e6")
    add(contacts, "exclude", first="frame", second="hammer head")
    write_xml(root, file)


def main() -> None:
    """Writes the three files."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    parts = [make_frame(), make_arm(), make_head(), make_anvil(), make_ball()]
    solids = [solid for part in parts for solid in part.solids]
    vrml = folder / "hammer.wrl"
    write_vrml(assembly_of(parts, colored=True), solids, vrml, chord_error=CHORD_ERROR, angle_error=ANGLE_ERROR)
    # Without colours: the kernel writes coloured products in an order that changes from run to run.
    write_step(assembly_of(parts, colored=False), folder / "hammer.step")
    write_assembly(parts, folder / "hammer.xml")


if __name__ == "__main__":
    main()
