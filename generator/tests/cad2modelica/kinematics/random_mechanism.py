"""Mechanisms drawn at random, known twice: as the assembly that they are, and as the XML that says so.

The assembly stands in SI units in the world; the file says the same in units, axes, frames and instances of its own,
so that reading, generating and simulating it can be compared with what was drawn.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
from assembly_text import numbers
from cad2modelica.geometry.spatial import IDENTITY, Pose
from cad2modelica.mechanism.model import (
    GROUND,
    Assembly,
    CollisionChoice,
    Joint,
    JointType,
    MassProperties,
    Part,
)
from contact_foundation.errors import Place
from scipy.spatial.transform import Rotation

HERE = Place(file=Path("drawn.xml"))
LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
MASSES = {"kg": 1.0, "g": 0.001, "t": 1000.0, "lb": 0.45359237}
INSTANCE = "inst/"
TREE = [kind for kind in JointType if kind is not JointType.FREE]
SCALARS = (JointType.REVOLUTE, JointType.PRISMATIC, JointType.SCREW)
NAMES = (
    "arm",
    "end",
    "Teil Nr. 7",
    "model",
    "x",
    "X",
    "größe",
    "world",
    "time",
    '1.5 <big> & "odd"',
    "der",
    "手",
    "ground 2",
)


@dataclass
class Drawn:
    """A mechanism.

    Attributes:
        assembly: what it is.
        text: the file.
        size: typical length, m.
        motion: by part, velocity of the centre of mass and angular velocity at the start, world axes.
    """

    assembly: Assembly
    text: str
    size: float
    motion: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)


def draw_mechanism(seed: int, loops: int | None = None) -> Drawn:
    """A mechanism of up to seven parts.

    Args:
        seed: of the random numbers.
        loops: how many loops it has; drawn if left out.
    """
    return _Draw(random.Random(f"mechanism {seed}"), loops).drawn()


class _Draw:
    def __init__(self, draw: random.Random, loops: int | None) -> None:
        self._draw = draw
        self._size = 10 ** draw.uniform(-2.5, 1.0)
        self._mass = 10 ** draw.uniform(-5.5, 3.5)
        self._loops = loops if loops is not None else draw.choice((0, 0, 1, 2))
        self._parts: list[Part] = []
        self._joints: list[Joint] = []
        self._names = list(NAMES)
        draw.shuffle(self._names)

    def drawn(self) -> Drawn:
        self._tree(self._draw.randint(1, 4))
        for _ in range(self._loops):
            self._loop()
        gravity = self._vector(9.81) if self._draw.random() < 0.5 else np.array([0.0, 0.0, -9.81])
        motion = self._motion()
        assembly = Assembly(
            name="Drawn", source="", file=HERE.file or Path(), parts=tuple(self._parts), joints=tuple(self._joints),
            gravity=gravity,
        )  # fmt: skip
        return Drawn(assembly, _Writer(self._draw, assembly).text(), self._size, motion)

    # ----- parts and joints -----

    def _vector(self, size: float) -> np.ndarray:
        return np.array([self._draw.uniform(-1, 1) for _ in range(3)]) * size

    def _direction(self) -> np.ndarray:
        if self._draw.random() < 0.4:
            axis = np.eye(3)[self._draw.randrange(3)] * self._draw.choice((1, -1))
            return np.asarray(axis)
        vector = np.array([self._draw.gauss(0, 1) for _ in range(3)])
        return np.asarray(vector / np.linalg.norm(vector))

    def _rotation(self) -> np.ndarray:
        if self._draw.random() < 0.2:
            return np.eye(3)
        if self._draw.random() < 0.3:
            turns = np.array([self._draw.randrange(4) for _ in range(3)]) * 90
            return np.round(Rotation.from_euler("XYZ", turns, degrees=True).as_matrix())
        return Rotation.from_quat([self._draw.gauss(0, 1) for _ in range(4)]).as_matrix()

    def _part(self) -> Part:
        mass = self._mass * 10 ** self._draw.uniform(-1, 1)
        gyration = self._size * np.array([self._draw.uniform(0.2, 0.5) for _ in range(3)])
        squares = gyration**2  # of the distribution along three axes: any of them is a body
        moments = mass * (squares.sum() - squares)
        turn = self._rotation()
        part = Part(
            name=self._names[len(self._parts)],
            material=None,
            pose=Pose(self._vector(self._size * self._draw.choice((0, 1, 1, 3))), self._rotation()),
            mass_properties=MassProperties(
                mass, self._vector(0.3 * self._size), turn @ np.diag(moments) @ turn.T
            ),
            meshes=(),
            collision=CollisionChoice.AUTO,
            grounded=False,
            place=HERE,
        )  # fmt: skip
        self._parts.append(part)
        return part

    def _joint(self, kind: JointType, parent: str, child: str) -> Joint:
        axis = self._direction() if kind.needs_axis else None
        second = None
        if kind is JointType.UNIVERSAL:
            assert axis is not None
            across = np.cross(axis, self._direction() + 0.3 * self._vector(1.0))
            second = across / np.linalg.norm(across)
        moves, turns = self._size, 1.5
        speed = self._draw.uniform(-1, 1) * (moves if kind is JointType.PRISMATIC else turns)
        velocity, spin = np.zeros(3), np.zeros(3)
        if self._loops or kind not in SCALARS:
            speed = 0.0
        if not self._loops and kind in (JointType.SPHERICAL,):
            spin = self._vector(turns)
        joint = Joint(
            name=self._draw.choice(("joint", "hinge", "Gelenk Ä", "end", "when")) + f" {len(self._joints)}",
            type=kind,
            parent=parent,
            child=child,
            origin=self._vector(self._size),
            axis=axis,
            place=HERE,
            second_axis=second,
            position=self._draw.choice((0.0, self._draw.uniform(-4, 4)))
            * (moves if kind is JointType.PRISMATIC else 1.0)
            if kind in SCALARS
            else 0.0,
            speed=speed,
            velocity=velocity,
            angular_velocity=spin,
            pitch=self._draw.choice((-1, 1)) * self._draw.uniform(0.2, 1.0) * self._size
            if kind is JointType.SCREW
            else 0.0,
        )
        self._joints.append(joint)
        return joint

    def _anywhere(self) -> str:
        return self._draw.choice([GROUND, *(part.name for part in self._parts)])

    def _tree(self, count: int) -> None:
        for _ in range(count):
            parent = self._anywhere() if self._draw.random() < 0.5 or not self._parts else self._parts[-1].name
            child = self._part().name
            kind = self._draw.choice(TREE)
            if parent != GROUND and self._draw.random() < 0.3:  # told from the other side
                parent, child = child, parent
            self._joint(kind, parent, child)

    def _loop(self) -> None:
        """A chain of two or three parts from one body to another; with so many freedoms that all stays mobile."""
        first = self._anywhere()
        last = self._anywhere()
        count = 2 if first == last else self._draw.choice((1, 2))
        while True:
            kinds = [
                self._draw.choice([kind for kind in TREE if kind is not JointType.FIXED]) for _ in range(count + 1)
            ]
            freedoms = sum(kind.freedoms for kind in kinds)
            if 7 <= freedoms <= 8 or (freedoms == 6 and first != last):
                break
        before = first
        chain = [self._part().name for _ in range(count)]
        for kind, after in zip(kinds, [*chain, last], strict=True):
            parent, child = (before, after) if self._draw.random() < 0.7 or before == GROUND else (after, before)
            if child == GROUND:
                parent, child = child, parent
            self._joint(kind, parent, child)
            before = after

    # ----- start -----

    def _motion(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Of trees, whose joints come from the ground outwards, with the parent on any side; loops start at rest."""
        motion = {part.name: (np.zeros(3), np.zeros(3)) for part in self._parts}
        if self._loops:
            return motion
        places = {part.name: part.pose.point(part.mass_properties.center_of_mass) for part in self._parts}
        reached = {GROUND}
        for joint in self._joints:
            known, new, sign = joint.parent, joint.child, 1.0
            if known not in reached:
                known, new, sign = new, known, -1.0
            reached.add(new)
            velocity, spin = motion.get(known, (np.zeros(3), np.zeros(3)))
            at_joint = velocity + np.cross(spin, joint.origin - places.get(known, joint.origin))
            turn, shift = joint.angular_velocity, joint.velocity
            if joint.axis is not None and joint.type is JointType.PRISMATIC:
                shift = joint.axis * joint.speed
            elif joint.axis is not None and joint.type in SCALARS:
                turn = joint.axis * joint.speed
                shift = turn * joint.pitch / (2 * np.pi)
            own = spin + sign * turn
            motion[new] = (at_joint + sign * shift + np.cross(own, places[new] - joint.origin), own)
        return motion


class _Writer:
    """Says an assembly in XML, each thing in one of the ways that the format has for it."""

    def __init__(self, draw: random.Random, assembly: Assembly) -> None:
        self._draw = draw
        self._assembly = assembly
        self._length = draw.choice(list(LENGTHS))
        self._mass = draw.choice(list(MASSES))
        self._angle = draw.choice(("rad", "deg"))
        self._m = LENGTHS[self._length]
        self._kg = MASSES[self._mass]
        self._rad = 1.0 if self._angle == "rad" else np.pi / 180
        inside = [part.name for part in assembly.parts if draw.random() < 0.5] if draw.random() < 0.6 else []
        self._inside = set(inside)
        self._outer = Pose(self._vector(), Rotation.from_quat([draw.gauss(0, 1) for _ in range(4)]).as_matrix())
        placed = [name for name in inside if draw.random() < 0.4]
        self._nominal = {
            name: self._outer
            @ Pose(self._vector(), Rotation.from_quat([draw.gauss(0, 1) for _ in range(4)]).as_matrix())
            for name in placed
        }

    def _vector(self) -> np.ndarray:
        return np.array([self._draw.uniform(-2, 2) for _ in range(3)])

    def text(self) -> str:
        parts = {True: "", False: ""}
        joints = {True: "", False: ""}
        for part in self._assembly.parts:
            parts[part.name in self._inside] += self._part(part)
        for joint in self._assembly.joints:
            inside = joint.child in self._inside and joint.parent in {*self._inside, GROUND}
            joints[inside] += self._joint(joint, inside)
        definition, instance = "", ""
        if self._inside:
            content = f"<parts>{parts[True]}</parts>" + (f"<joints>{joints[True]}</joints>" if joints[True] else "")
            definition = f'<definitions><definition name="unit">{content}</definition></definitions>'
            poses = {part.name: part.pose for part in self._assembly.parts}
            placements = "".join(
                f"<placement part={quoteattr(name)}>{self._pose(self._outer.inverse() @ poses[name])}</placement>"
                for name in self._nominal
            )
            content = f"{self._pose(self._outer)}{placements}"
            instance = f'<instances><instance name="inst" of="unit">{content}</instance></instances>'
        return (
            '<assembly xmlns="urn:contactmultibody:assembly:1" name="Drawn">'
            f'<units length="{self._length}" mass="{self._mass}" angle="{self._angle}"/>'
            f"<gravity>{numbers(self._assembly.gravity)}</gravity>{definition}"
            + (f"<parts>{parts[False]}</parts>" if parts[False] else "")
            + instance
            + (f"<joints>{joints[False]}</joints>" if joints[False] else "")
            + "</assembly>"
        )

    def _pose(self, pose: Pose) -> str:
        turn = Rotation.from_matrix(pose.rotation)
        way = self._draw.randrange(4)
        if way == 0:
            orientation = f"<rotation>{numbers(pose.rotation.ravel())}</rotation>"
        elif way == 1:
            x, y, z, w = turn.as_quat()
            orientation = f"<quaternion>{numbers([w, x, y, z])}</quaternion>"
        elif way == 2:
            vector = turn.as_rotvec()
            angle = float(np.linalg.norm(vector))
            axis = vector / angle if angle > 1e-9 else np.array([1.0, 0, 0])
            orientation = f'<axisAngle axis="{numbers(axis * 3)}" angle="{angle / self._rad!r}"/>'
        else:
            matrix = pose.rotation
            pitch = np.arctan2(-matrix[2, 0], np.hypot(matrix[0, 0], matrix[1, 0]))
            if abs(matrix[2, 0]) > 1 - 1e-9:
                return self._pose(pose)
            angles = np.array([np.arctan2(matrix[2, 1], matrix[2, 2]), pitch, np.arctan2(matrix[1, 0], matrix[0, 0])])
            orientation = f"<rollPitchYaw>{numbers(angles / self._rad)}</rollPitchYaw>"
        return f"<pose><position>{numbers(pose.position / self._m)}</position>{orientation}</pose>"

    def _part(self, part: Part) -> str:
        outer = self._outer if part.name in self._inside else IDENTITY
        local = outer.inverse() @ self._nominal.get(part.name, part.pose)
        axes = self._draw.choice(("part", "assembly"))
        about = self._draw.choice(("centerOfMass", "origin"))
        products = self._draw.choice(("tensor", "integral"))
        properties = part.mass_properties
        tensor, center = properties.inertia, properties.center_of_mass
        if about == "origin":
            tensor = tensor + properties.mass * (center @ center * np.eye(3) - np.outer(center, center))
        if axes == "assembly":
            turn = local.rotation
            tensor = turn @ tensor @ turn.T
        sign = 1 if products == "tensor" else -1
        tensor = tensor / self._kg / self._m**2
        xx, yy, zz = np.diag(tensor).tolist()
        xy, xz, yz = (float(sign * tensor[i, j]) for i, j in ((0, 1), (0, 2), (1, 2)))
        return (
            f"<part name={quoteattr(part.name)}>{self._pose(local)}<massProperties>"
            f"<mass>{properties.mass / self._kg!r}</mass><centerOfMass>{numbers(center / self._m)}</centerOfMass>"
            f'<inertia about="{about}" axes="{axes}" products="{products}" xx="{xx!r}" yy="{yy!r}" zz="{zz!r}" '
            f'xy="{xy!r}" xz="{xz!r}" yz="{yz!r}"/></massProperties></part>'
        )

    def _joint(self, joint: Joint, inside: bool) -> str:
        poses = {part.name: part.pose for part in self._assembly.parts} | {GROUND: IDENTITY}
        outer = self._outer if inside else IDENTITY
        own = outer
        if inside and joint.parent in self._nominal:
            own = poses[joint.parent] @ self._nominal[joint.parent].inverse() @ outer
        frames = {"assembly": own, "parent": poses[joint.parent], "child": poses[joint.child]}

        def framed(tag: str, vector: np.ndarray, point: bool) -> str:
            frame = self._draw.choice(("assembly", "parent", "child"))
            inverse = frames[frame].inverse()
            local = inverse.point(vector) / self._m if point else inverse.direction(vector) * self._draw.uniform(0.1, 9)
            said = "" if frame == "assembly" and self._draw.random() < 0.5 else f' frame="{frame}"'
            return f"<{tag}{said}>{numbers(local)}</{tag}>"

        content = framed("origin", joint.origin, True)
        if joint.axis is not None:
            content += framed("axis", joint.axis, False)
        if joint.second_axis is not None:
            content += framed("axis2", joint.second_axis, False)
        if joint.type in SCALARS and (joint.position or joint.speed):
            unit = self._m if joint.type is JointType.PRISMATIC else self._rad
            content += f'<start position="{joint.position / unit!r}" speed="{joint.speed / unit!r}"/>'
        elif joint.angular_velocity.any():
            spin = own.inverse().direction(joint.angular_velocity) / self._rad
            content += f'<start angularVelocity="{numbers(spin)}"/>'
        parent, child = (
            name if inside or name not in self._inside else f"{INSTANCE}{name}" for name in (joint.parent, joint.child)
        )
        pitch = f' pitch="{joint.pitch / self._m!r}"' if joint.type is JointType.SCREW else ""
        return (
            f'<joint name={quoteattr(joint.name)} type="{joint.type.value}" parent={quoteattr(parent)} '
            f"child={quoteattr(child)}{pitch}>{content}</joint>"
        )
