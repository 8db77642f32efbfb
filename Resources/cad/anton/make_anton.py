"""Models the walking robot Anton with CadQuery and writes its CAD export: VRML 2.0 and the assembly XML.

Six equal legs of three driven joints each stand around a torso; a head with two cameras makes the front heavier.
Shapes, VRML text, masses, centres of mass and inertias come from the CAD kernel (Open CASCADE). The battery's length is
what brings the robot to its mass. Lengths are millimetres, angles degrees.

Run: ``python make_anton.py [FOLDER]`` (needs ``pip install cadquery``); the folder is that of this script if left out.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path

import cadquery as cq
from lxml import etree

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))  # cad_export lies beside the samples' folders

from cad_export import (
    MassProperties,
    Vector,
    add,
    add_mass_properties,
    new_assembly,
    number,
    numbers,
    solid_of,
    weigh,
    write_vrml,
    write_xml,
)

MASS = 7.8  # kg
CHORD_ERROR = 1.0  # mm
ANGLE_ERROR = 0.6  # rad

# Legs, in the leg's coordinates: origin on the hip's axis, x outward, z up.
COXA = 50.0
FEMUR = 90.0
TIBIA = 135.0  # from the knee to the foot's centre
FOOT_RADIUS = 12.0
REACH = 155.0  # of the foot's centre in the start configuration
HIP_HEIGHT = 110.0  # above the floor in the start configuration
FOOT_SINK = 0.12  # depth of the feet under the weight, so that the robot starts near its equilibrium

# Hips: name, x, y and direction of the leg in the torso's coordinates.
HIPS = (
    ("frontLeft", 170.0, 75.0, 60.0),
    ("middleLeft", 0.0, 95.0, 90.0),
    ("rearLeft", -170.0, 75.0, 120.0),
    ("frontRight", 170.0, -75.0, -60.0),
    ("middleRight", 0.0, -95.0, -90.0),
    ("rearRight", -170.0, -75.0, -120.0),
)

ALUMINIUM, SERVO, BATTERY, ELECTRONICS, RUBBER, GLASS = 2700.0, 1250.0, 2100.0, 1300.0, 1150.0, 2500.0  # kg/m3
SERVO_SIZE = (61.0, 40.0, 41.0)
PLATE = 2.5  # thickness
PLATE_GAP = 52.0  # between the torso's plates

Color = tuple[float, float, float]
SILVER, DARK, BLACK, ORANGE, BLUE = (
    (0.72, 0.74, 0.78),
    (0.22, 0.24, 0.28),
    (0.06, 0.06, 0.07),
    (0.90, 0.45, 0.10),
    (0.15, 0.35, 0.65),
)


@dataclass(frozen=True)
class Piece:
    """A solid of a part."""

    name: str
    solid: cq.Solid
    density: float
    color: Color


@dataclass(frozen=True)
class PartModel:
    """A part: its pieces in its own coordinates."""

    name: str
    material: str
    pieces: tuple[Piece, ...]

    def weigh(self) -> MassProperties:
        """The kernel's mass properties of all pieces."""
        return weigh((piece.solid, piece.density) for piece in self.pieces)


@dataclass(frozen=True)
class Posture:
    """Joint coordinates of a leg in degrees: ``lift`` raises the femur, ``knee`` the tibia against it."""

    lift: float
    knee: float


def leg_posture(reach: float, height: float) -> Posture:
    """The posture that puts the foot's centre at a distance from the hip's axis and a height against the hip."""
    radius = math.hypot(reach - COXA, height)
    inner = math.acos((FEMUR**2 + radius**2 - TIBIA**2) / (2 * FEMUR * radius))
    knee = math.acos((radius**2 - FEMUR**2 - TIBIA**2) / (2 * FEMUR * TIBIA))
    return Posture(math.degrees(math.atan2(height, reach - COXA) + inner), -math.degrees(knee))


def box(size: Vector, center: Vector) -> cq.Workplane:
    """A box with rounded vertical edges."""
    return cq.Workplane("XY").box(*size).edges("|Z").fillet(min(size[:2]) / 10).translate(center)


def plate_outline() -> list[tuple[float, float]]:
    """Corners of the torso's plates: narrow at both ends, wide in the middle."""
    right = [
        (205.0, -55.0),
        (170.0, -97.0),
        (60.0, -90.0),
        (0.0, -117.0),
        (-60.0, -90.0),
        (-170.0, -97.0),
        (-205.0, -55.0),
    ]
    return right + [(x, -y) for x, y in reversed(right)]


def make_torso(battery_length: float) -> PartModel:
    """Two plates, the hips' servos between them, a battery behind the middle, and the control electronics on top."""
    pieces = []
    for name, level in (("lower plate", -PLATE_GAP / 2 - PLATE), ("upper plate", PLATE_GAP / 2)):
        plate = cq.Workplane("XY", origin=(0, 0, level)).polyline(plate_outline()).close().extrude(PLATE)
        for x in (-95, 95):
            plate = plate.cut(cq.Workplane("XY", origin=(x, 0, level)).slot2D(90, 46).extrude(PLATE))
        pieces.append(Piece(name, solid_of(plate), ALUMINIUM, SILVER))
    for name, x, y, _ in HIPS:
        inward = math.copysign(SERVO_SIZE[1] / 2, y)
        servo = box((SERVO_SIZE[0], SERVO_SIZE[1], PLATE_GAP), (x, y - inward / 2, 0))
        pieces.append(Piece(f"{name} servo", solid_of(servo), SERVO, DARK))
    battery = box((battery_length, 84, 46), (0, 0, 0))
    pieces.append(Piece("battery", solid_of(battery), BATTERY, BLUE))
    board = box((150, 90, 26), (-10, 0, PLATE_GAP / 2 + PLATE + 13))
    pieces.append(Piece("electronics", solid_of(board), ELECTRONICS, DARK))
    return PartModel("torso", "aluminium", tuple(pieces))


def make_head() -> PartModel:
    """A hollow rounded housing on a neck, two cameras that look forward; the origin lies where the neck is fixed."""
    neck = box((70, 44, 14), (20, 0, 7)).union(box((24, 44, 40), (43, 0, 28)))
    shell = cq.Workplane("XY").box(84, 150, 62).edges().fillet(14)
    hollow = cq.Workplane("XY").box(78, 144, 56).edges().fillet(11)
    housing = shell.cut(hollow).translate((62, 0, 79))
    pieces = [
        Piece("neck", solid_of(neck), ALUMINIUM, SILVER),
        Piece("housing", solid_of(housing), ALUMINIUM, ORANGE),
    ]
    for side, y in (("left", 38.0), ("right", -38.0)):
        barrel = cq.Workplane("YZ", origin=(104, y, 79)).circle(21).extrude(30)
        lens = cq.Workplane("YZ", origin=(134, y, 79)).circle(16).extrude(5)
        pieces.append(Piece(f"{side} camera", solid_of(barrel), ALUMINIUM, DARK))
        pieces.append(Piece(f"{side} lens", solid_of(lens), GLASS, BLACK))
    return PartModel("head", "aluminium", tuple(pieces))


def make_coxa() -> PartModel:
    """From the hip's axis (origin, along z) to the lift axis (along y): a bracket that holds the lift's servo."""
    hub = cq.Workplane("XY", origin=(0, 0, -PLATE_GAP / 2 - PLATE - 8)).circle(9).extrude(PLATE_GAP + 2 * PLATE + 16)
    bracket = hub.union(box((COXA - 12, 30, 8), (COXA / 2 - 6, 0, -PLATE_GAP / 2 - PLATE - 4)))
    bracket = bracket.union(box((COXA - 12, 30, 8), (COXA / 2 - 6, 0, PLATE_GAP / 2 + PLATE + 4)))
    servo = box((SERVO_SIZE[1], SERVO_SIZE[2], SERVO_SIZE[0]), (COXA - 12, 0, 0))
    return PartModel(
        "coxa",
        "aluminium",
        (Piece("bracket", solid_of(bracket), ALUMINIUM, SILVER), Piece("servo", solid_of(servo), SERVO, DARK)),
    )


def make_femur() -> PartModel:
    """Two bars from the lift axis (origin) along x to the knee, whose servo they hold."""
    pieces = []
    for name, y in (("left bar", 24.5), ("right bar", -24.5)):
        bar = cq.Workplane("XZ", origin=(FEMUR / 2, y + 2.5, 0)).slot2D(FEMUR + 32, 32).extrude(5)
        pieces.append(Piece(name, solid_of(bar), ALUMINIUM, ORANGE))
    servo = box((SERVO_SIZE[0], 44, SERVO_SIZE[2]), (FEMUR - 22, 0, 0))
    pieces.append(Piece("servo", solid_of(servo), SERVO, DARK))
    return PartModel("femur", "aluminium", tuple(pieces))


def make_tibia() -> PartModel:
    """From the knee (origin) along x towards the foot: a fork around the femur and a tapered shank."""
    fork = box((8, 64, 26), (26, 0, 0))
    for y in (30.0, -30.0):
        fork = fork.union(cq.Workplane("XZ", origin=(8, y + 2, 0)).slot2D(42, 26).extrude(4))
    shank = cq.Workplane("YZ", origin=(29, 0, 0)).rect(24, 16)
    shank = shank.workplane(offset=TIBIA - 29 - FOOT_RADIUS / 2).rect(8, 8).loft()
    return PartModel("tibia", "aluminium", (Piece("shank", solid_of(fork.union(shank)), ALUMINIUM, SILVER),))


def make_foot() -> PartModel:
    """A ball; the origin is its centre."""
    return PartModel(
        "foot", "rubber", (Piece("ball", solid_of(cq.Workplane("XY").sphere(FOOT_RADIUS)), RUBBER, BLACK),)
    )


def make_parts() -> list[PartModel]:
    """All parts, a leg's once; the battery is as long as the robot's mass wants it."""
    others = [make_head(), make_coxa(), make_femur(), make_tibia(), make_foot()]
    head, *leg = (part.weigh().mass for part in others)
    rest = MASS - head - len(HIPS) * sum(leg)
    short, long = (make_torso(length).weigh().mass for length in (100.0, 200.0))
    length = 100.0 + 100.0 * (rest - short) / (long - short)
    # The rounding of the edges depends on the battery's width alone, so its mass is linear in its length.

    if not 100.0 < length < 240.0:
        raise ValueError(f"a battery of {length:.0f} mm does not fit")
    return [make_torso(length), *others]


def assembly_of(parts: list[PartModel]) -> cq.Assembly:
    """The product structure: each part an assembly of its pieces, coloured, in the part's own coordinates."""
    assembly = cq.Assembly(name="anton")
    for part in parts:
        product = cq.Assembly(name=part.name)
        for piece in part.pieces:
            product.add(piece.solid, name=f"{part.name} {piece.name}", color=cq.Color(*piece.color))
        assembly.add(product, name=part.name)
    return assembly


def add_part(owner: etree._Element, part: PartModel, position: Vector, angle_about_y: float = 0.0) -> None:
    """Adds a part's element."""
    element = add(owner, "part", name=part.name, material=part.material)
    pose = add(element, "pose")
    add(pose, "position", numbers(*position))
    if angle_about_y:
        add(pose, "axisAngle", axis="0 1 0", angle=number(angle_about_y))
    add_mass_properties(element, part.weigh())
    add(element, "geometry", file="anton.wrl", node=part.name, coordinates="node", length="mm")
    add(element, "collision", shape="sphere" if part.name == "foot" else "none")


def add_joint(
    owner: etree._Element,
    name: str,
    parent: str,
    child: str,
    origin: Vector,
    axis: Vector | None,
    position: float = 0.0,
) -> None:
    """Adds a revolute joint, or a fixed one if there is no axis."""
    joint = add(owner, "joint", name=name, type="fixed" if axis is None else "revolute", parent=parent, child=child)
    add(joint, "origin", numbers(*origin))
    if axis is not None:
        add(joint, "axis", numbers(*axis))
        add(joint, "start", position=number(position), speed="0")


def add_leg(definition: etree._Element, parts: dict[str, PartModel]) -> None:
    """Adds a leg's parts and joints in the start configuration."""
    posture = leg_posture(REACH, FOOT_RADIUS - FOOT_SINK - HIP_HEIGHT)
    lift, shank = math.radians(posture.lift), math.radians(posture.lift + posture.knee)
    knee = (COXA + FEMUR * math.cos(lift), 0.0, FEMUR * math.sin(lift))
    foot = (knee[0] + TIBIA * math.cos(shank), 0.0, knee[2] + TIBIA * math.sin(shank))
    section = add(definition, "parts")
    add_part(section, parts["coxa"], (0.0, 0.0, 0.0))
    add_part(section, parts["femur"], (COXA, 0.0, 0.0), -posture.lift)
    add_part(section, parts["tibia"], knee, -posture.lift - posture.knee)
    add_part(section, parts["foot"], foot, -posture.lift - posture.knee)
    joints = add(definition, "joints")
    sideways = (0.0, -1.0, 0.0)
    add_joint(joints, "lift", "coxa", "femur", (COXA, 0.0, 0.0), sideways, posture.lift)
    add_joint(joints, "knee", "femur", "tibia", knee, sideways, posture.knee)
    add_joint(joints, "ankle", "tibia", "foot", foot, None)


def write_assembly(models: list[PartModel], file: Path) -> None:
    """Writes the assembly's XML file."""
    parts = {part.name: part for part in models}
    root = new_assembly("Anton")
    add(
        root,
        "description",
        "A six-legged walking robot of 7.8 kg with eighteen driven joints and a head with two cameras",
    )
    add(root, "source", system="CadQuery, Open CASCADE Technology", file="make_anton.py")
    add(root, "units", length="mm", mass="kg", angle="deg")
    add(root, "gravity", "0 0 -9.81")
    add(root, "simulation", stopTime="25", tolerance="1e-4")
    materials = add(root, "materials")
    add(materials, "material", name="aluminium", density="2700", youngsModulus="7.0e10", poissonsRatio="0.33")
    add(
        materials,
        "material",
        name="rubber",
        density="1150",
        youngsModulus="1e7",
        poissonsRatio="0.48",
        restitution="0",
        staticFriction="0.8",
        dynamicFriction="0.8",
    )
    definitions = add(root, "definitions")
    add_leg(add(definitions, "definition", name="leg"), parts)
    ground = add(root, "ground")
    add(ground, "plane", name="floor", material="rubber")
    section = add(root, "parts")
    add_part(section, parts["torso"], (0.0, 0.0, HIP_HEIGHT))
    neck = (185.0, 0.0, PLATE_GAP / 2 + PLATE)
    add_part(section, parts["head"], (neck[0], neck[1], neck[2] + HIP_HEIGHT))
    instances = add(root, "instances")
    for name, x, y, direction in HIPS:
        pose = add(add(instances, "instance", name=name, of="leg"), "pose")
        add(pose, "position", numbers(x, y, HIP_HEIGHT))
        add(pose, "axisAngle", axis="0 0 1", angle=number(direction))
    joints = add(root, "joints")
    add_joint(joints, "neck", "torso", "head", (neck[0], neck[1], neck[2] + HIP_HEIGHT), None)
    for name, x, y, _ in HIPS:
        add_joint(joints, f"{name} hip", "torso", f"{name}/coxa", (x, y, HIP_HEIGHT), (0.0, 0.0, 1.0))
    contacts = add(root, "contacts", default="none", stiffness="1e5", friction="regularised")
    for name, *_ in HIPS:
        add(contacts, "include", first=f"{name}/foot", second="floor")
    write_xml(root, file)


def main() -> None:
    """Writes both files."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    parts = make_parts()
    solids = [piece.solid for part in parts for piece in part.pieces]
    write_vrml(assembly_of(parts), solids, folder / "anton.wrl", chord_error=CHORD_ERROR, angle_error=ANGLE_ERROR)
    write_assembly(parts, folder / "anton.xml")
    for part in parts:
        properties = part.weigh()
        print(f"{part.name:6} {properties.mass:.4f} kg, centre {numbers(*properties.center)} mm")


if __name__ == "__main__":
    main()
