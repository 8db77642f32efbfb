"""The scenes: what is simulated, and by what programs are compared.

A worker imports this module with the interpreter of the peers: it needs numpy and nothing else.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Vector = tuple[float, float, float]
GRAVITY: Final = 9.81


@dataclass(frozen=True)
class Body:
    """A free rigid body; its frame lies in the centre of mass along the principal axes.

    Attributes:
        shape: sphere (radius), box (lengths of the edges), capsule (radius, length between the centres of its ends).
        size: of the shape, m.
        mass: kg.
        inertia: principal moments, kg.m2.
        position: m.
        velocity: m/s.
        tilt: angle about the y axis at the start, rad.
        spin: angular velocity in world axes at the start, rad/s.
    """

    shape: Literal["sphere", "box", "capsule"]
    size: tuple[float, ...]
    mass: float
    inertia: Vector
    position: Vector
    velocity: Vector = (0.0, 0.0, 0.0)
    tilt: float = 0.0
    spin: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class World:
    """Free bodies over the floor z = 0.

    Attributes:
        bodies: which.
        friction: coefficient of Coulomb's law.
        restitution: coefficient, of every pair.
        impact_speed: of the first impact, m/s, for laws whose restitution depends on it.
        gravity: m/s2.
    """

    bodies: tuple[Body, ...]
    friction: float
    restitution: float
    impact_speed: float
    gravity: Vector = (0.0, 0.0, -GRAVITY)


@dataclass(frozen=True)
class Scene:
    """A scene.

    Attributes:
        name: short, in lower case.
        text: what happens.
        reference: what errors are measured against, and where it comes from.
        own_reference: whether that is the program's own tightest run.
        error: what the error is, in words.
        stop: s.
        intervals: number of equal intervals between the times at which programs are looked at.
        since: times from here on are compared, s.
        scale: by which differences are divided.
        world: the free bodies, or None for a mechanism, which every program has its own model of.
        looked_at: (body, axis) of the coordinates that are compared; of a mechanism its coordinates in order.
        centre_only: whether the mean over all bodies is compared in place of each.
    """

    name: str
    text: str
    reference: str
    error: str
    stop: float
    intervals: int
    scale: float
    own_reference: bool = False
    since: float = 0.0
    world: World | None = None
    looked_at: tuple[tuple[int, int], ...] = field(default=())
    centre_only: bool = False

    @property
    def times(self) -> FloatArray:
        """The times at which programs are looked at, s, shape (intervals + 1,)."""
        return np.linspace(0.0, self.stop, self.intervals + 1)

    def seen(self, positions: FloatArray) -> list[float]:
        """What is compared of all positions, shape (bodies, 3)."""
        if self.centre_only:
            return [float(value) for value in positions.mean(axis=0)]
        return [float(positions[body, axis]) for body, axis in self.looked_at]


def sphere(radius: float, mass: float, position: Vector, velocity: Vector = (0.0, 0.0, 0.0)) -> Body:
    """A homogeneous sphere."""
    inertia = 0.4 * mass * radius**2
    return Body("sphere", (radius,), mass, (inertia, inertia, inertia), position, velocity)


def box(
    size: Vector, mass: float, position: Vector, velocity: Vector = (0.0, 0.0, 0.0), spin: Vector = (0, 0, 0)
) -> Body:
    """A homogeneous box."""
    a, b, c = (edge**2 for edge in size)
    inertia = (mass * (b + c) / 12, mass * (a + c) / 12, mass * (a + b) / 12)
    return Body("box", size, mass, inertia, position, velocity, 0.0, spin)


_BALL: Final = World((sphere(0.1, 1.0, (0.0, 0.0, 1.1)),), 0.0, 0.7, math.sqrt(2 * GRAVITY))
FIRST_APEX: Final = math.sqrt(2 / GRAVITY) * (1 + 0.7)
BLOCK_STOPS: Final = 2.0 / (0.3 * GRAVITY)
INCLINE: Final = math.radians(16)
BOX_EDGE: Final = 0.2
ROD_TILT: Final = 0.5
ROD_LENGTH: Final = 1.0
ROD_RADIUS: Final = 0.01
CRADLE_LENGTH: Final = 0.2
CRADLE_RADIUS: Final = 0.02
CRADLE_GAP: Final = 1e-3
CRADLE_START: Final = 0.5
CRADLE_MASS: Final = 4 / 3 * math.pi * CRADLE_RADIUS**3 * 7850
CRADLE_BALLS: Final = 5
_DOMINO: Final = (0.0075, 0.024, 0.048)


def _rod() -> Body:
    transverse = ROD_LENGTH**2 / 12
    height = ROD_RADIUS + ROD_LENGTH / 2 * math.cos(ROD_TILT)
    inertia = (transverse, transverse, 0.5 * ROD_RADIUS**2)
    return Body("capsule", (ROD_RADIUS, ROD_LENGTH), 1.0, inertia, (0.0, 0.0, height), tilt=ROD_TILT)


def _stack() -> World:
    shifts = ((0.0, 0.0), (0.01, 0.0), (0.0, 0.01), (-0.01, 0.0), (0.0, -0.01))
    boxes = (
        box((BOX_EDGE, BOX_EDGE, BOX_EDGE), 1.0, (x, y, BOX_EDGE * (k + 0.5) + 1e-3 * (k + 1)))
        for k, (x, y) in enumerate(shifts)
    )
    return World(tuple(boxes), 0.5, 0.0, math.sqrt(2 * GRAVITY * 1e-3))


def _dominoes() -> World:
    push = 6.0
    bodies = tuple(
        box(
            _DOMINO,
            0.01,
            (0.02 * k, 0.0, _DOMINO[2] / 2),
            (push * _DOMINO[2] / 2 if k == 0 else 0.0, 0.0, 0.0),
            (0.0, push if k == 0 else 0.0, 0.0),
        )
        for k in range(4)
    )
    return World(bodies, 0.3, 0.3, 0.3)


def _spheres() -> World:
    bodies = tuple(
        sphere(
            0.05,
            0.5,
            (0.12 * ((i - 1) % 10), 0.12 * ((i - 1) // 10), 0.06 + 0.03 * ((7 * i) % 11)),
            (math.sin(1.7 * i), math.cos(2.3 * i), 0.0),
        )
        for i in range(1, 101)
    )
    return World(bodies, 0.5, 0.3, 2.0)


SCENES: Final[tuple[Scene, ...]] = (
    Scene(
        name="ball, first apex",
        text="A ball of 1 kg falls from 1 m and rises again, e = 0.7.",
        reference="closed form: an impact without duration",
        error="of the height at the time of the apex, by 1 m",
        stop=FIRST_APEX,
        intervals=4,
        since=FIRST_APEX,
        scale=1.0,
        world=_BALL,
        looked_at=((0, 2),),
    ),
    Scene(
        name="ball, three impacts",
        text="The same ball until 1.8 s, after its third impact.",
        reference="closed form: impacts without duration",
        error="the largest of the height at 36 times, by 1 m",
        stop=1.8,
        intervals=36,
        scale=1.0,
        world=_BALL,
        looked_at=((0, 2),),
    ),
    Scene(
        name="block that stops",
        text="A block of 1 kg slides over a floor at 2 m/s until friction of 0.3 has used up its energy.",
        reference="closed form: Coulomb, v t - mu g t^2/2 until v = 0",
        error="the largest of the way at 20 times within 1 s, by the whole way of 0.68 m",
        stop=1.0,
        intervals=20,
        scale=2.0**2 / (2 * 0.3 * GRAVITY),
        world=World((box((0.2, 0.2, 0.05), 1.0, (0.0, 0.0, 0.025), (2.0, 0.0, 0.0)),), 0.3, 0.0, 0.1),
        looked_at=((0, 0),),
    ),
    Scene(
        name="creep on an incline",
        text="A box of 2 kg lies on an incline of 16 degrees whose friction, 0.3, holds up to 16.7 degrees.",
        reference="closed form: Coulomb, it stays where it is",
        error="the largest of the way from its place at 1 s, at 10 times until 2 s, by 1 m",
        stop=2.0,
        intervals=20,
        since=1.0,
        scale=1.0,
        world=World(
            (box((0.2, 0.2, 0.1), 2.0, (0.0, 0.0, 0.05)),),
            0.3,
            0.0,
            0.1,
            (GRAVITY * math.sin(INCLINE), 0.0, -GRAVITY * math.cos(INCLINE)),
        ),
        looked_at=((0, 0),),
    ),
    Scene(
        name="rolling sphere",
        text="A sphere slides at 2 m/s without turning until friction of 0.3 has made it roll.",
        reference="closed form: Coulomb, then rolling",
        error="the largest of the way at 20 times within 1 s, by the whole way of 1.48 m",
        stop=1.0,
        intervals=20,
        scale=1.484047238,
        world=World((sphere(0.1, 1.0, (0.0, 0.0, 0.1), (2.0, 0.0, 0.0)),), 0.3, 0.0, 0.1),
        looked_at=((0, 0),),
    ),
    Scene(
        name="stack of five boxes",
        text="Five boxes, each shifted by 10 mm against the next, fall 1 mm each onto each other and stand.",
        reference="closed form: rigid boxes that stand, without restitution",
        error="the largest of any coordinate of any box from 1 s to 2 s, by the edge of 0.2 m",
        stop=2.0,
        intervals=20,
        since=1.0,
        scale=BOX_EDGE,
        world=_stack(),
        looked_at=tuple((body, axis) for body in range(5) for axis in range(3)),
    ),
    Scene(
        name="Newton's cradle",
        text="The first of five steel balls on strings, 1 mm apart, is let go at 0.5 rad; e = 1.",
        reference="rigid impacts one after the other, the equations of the strings between them solved to 1e-12",
        error="the largest of any angle at 18 times within 0.9 s, by 0.5 rad",
        stop=0.9,
        intervals=18,
        scale=CRADLE_START,
    ),
    Scene(
        name="falling rod",
        text="A rod of 1 m leans by 0.5 rad with its end on a floor without friction, and falls.",
        reference="the equation of the rigid rod, its end on the floor, solved to 1e-12",
        error="the largest of the height of the rod's middle at 10 times within 0.3 s, by 0.5 m",
        stop=0.3,
        intervals=10,
        scale=0.5,
        world=World((_rod(),), 0.0, 0.0, 0.1),
        looked_at=((0, 2),),
    ),
    Scene(
        name="row of dominoes",
        text="The first of four dominoes falls against the next, 20 mm apart.",
        reference="each program's own tightest run",
        error="the largest of any position of any domino within 0.2 s, by the height of 48 mm",
        stop=0.2,
        intervals=20,
        scale=_DOMINO[2],
        own_reference=True,
        world=_dominoes(),
        looked_at=tuple((body, axis) for body in range(4) for axis in (0, 2)),
    ),
    Scene(
        name="hexapod",
        text="A robot of 19 bodies and 18 servo joints walks on six feet for 2 s.",
        reference="each program's own tightest run",
        error="the largest of any coordinate of the torso within 2 s, by 0.1 m",
        stop=2.0,
        intervals=40,
        scale=0.1,
        own_reference=True,
    ),
    Scene(
        name="hundred spheres",
        text="A hundred spheres are thrown on a floor and run into each other, e = 0.3.",
        reference="each program's own tightest run",
        error="the largest of the mean position within 1 s, by 0.3 m; single spheres are chaotic",
        stop=1.0,
        intervals=20,
        scale=0.3,
        own_reference=True,
        world=_spheres(),
        centre_only=True,
    ),
)


def scene(name: str) -> Scene:
    """The scene of a name; raises KeyError if there is none."""
    return {found.name: found for found in SCENES}[name]
