"""One small mechanism for every kind of kinematic loop, as parts, joints and the speeds it starts with."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from assembly_text import joint, part
from numpy.typing import ArrayLike

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
GROUND = "ground"


@dataclass(frozen=True)
class Mechanism:
    """Parts and joints of an assembly.

    Attributes:
        speeds: of joints at the start; empty: all at rest.
        free: parts that nothing holds, which start with a speed of their own.
    """

    parts: Sequence[str]
    joints: Sequence[str]
    speeds: Mapping[str, float] = field(default_factory=dict)
    free: Sequence[str] = ()


def body(name: str, position: ArrayLike, start: str = "") -> str:
    """A part with axes of its own, and its centre of mass beside its origin; each name has its numbers."""
    generator = np.random.default_rng(list(name.encode()))
    return part(
        name,
        position=list(np.asarray(position, dtype=float)),
        turn=(list(generator.standard_normal(3)), float(generator.uniform(0.1, 1.0))),
        mass=float(generator.uniform(0.5, 2.0)),
        center=list(generator.uniform(-0.05, 0.05, 3)),
        inertia=(0.01, 0.012, 0.015),
        start=start,
    )


def ring(
    name: str,
    kinds: Sequence[str],
    points: Sequence[ArrayLike],
    axes: Sequence[ArrayLike],
    *,
    speed: float = 0.0,
    across: ArrayLike = (0.3, 0.7, -0.2),
    base: str = GROUND,
    first_last: bool = False,
) -> Mechanism:
    """A closed chain from the base over bodies back to it; the first joint starts with the speed.

    Args:
        name: before the names of all bodies and joints.
        kinds, points, axes: of the joints; the second axis of universal ones lies across the first and ``across``.
        base: a body, or the ground.
        first_last: whether the first joint is listed last, so that it may close the loop.
    """
    count = len(kinds)
    bodies = [base, *(f"{name}{k}" for k in range(1, count))]
    parts = [body(bodies[k], (np.asarray(points[k - 1]) + np.asarray(points[k])) / 2) for k in range(1, count)]
    joints = []
    for k, kind in enumerate(kinds):
        ends = (bodies[k], bodies[k + 1]) if k + 1 < count else (base, bodies[k])
        joints.append(
            joint(
                f"{name} joint {k + 1}",
                kind,
                *ends,
                origin=list(np.asarray(points[k], dtype=float)),
                axis=None if kind == "spherical" else list(np.asarray(axes[k], dtype=float)),
                axis2=list(np.cross(axes[k], across)) if kind == "universal" else None,
                pitch=0.3 if kind == "screw" else None,
                start=f'speed="{speed!r}"' if k == 0 and speed else "",
            )
        )
    order = [*joints[1:], joints[0]] if first_last else joints
    return Mechanism(parts, order, {f"{name} joint 1": speed} if speed else {})


# A plane that no coordinate plane is parallel to.
NORMAL = np.array([0.2, 1.0, 0.3]) / np.linalg.norm([0.2, 1.0, 0.3])
FIRST = np.cross(NORMAL, Z) / np.linalg.norm(np.cross(NORMAL, Z))
SECOND = np.cross(NORMAL, FIRST)


def flat(x: float, y: float) -> np.ndarray:
    """A point or direction in the inclined plane."""
    return np.asarray(x * FIRST + y * SECOND)


CORNERS = (flat(0, 0), flat(0.2, 0.4), flat(1.2, 0.7), flat(1, -0.1))
HINGES = (NORMAL, -NORMAL, NORMAL, NORMAL)
THROUGH_ONE_POINT = ((1, 0, 0.2), (0.3, 1, 0), (-1, 0.4, 0.5), (0.1, -0.8, 1))
SPACE = ((0, 0, 0), (0.3, 0, 0.2), (0.6, 0.3, 0.2), (0.9, 0.1, 0))
DIRECTIONS = (Y, (0.6, 0, 0.8), (0, 0.6, 0.8), (0.8, 0.6, 0))


def four_bar(name: str, base: str = GROUND) -> Mechanism:
    return ring(name, ["revolute"] * 4, CORNERS, HINGES, speed=1.0, base=base)


def welded_four_bar() -> Mechanism:
    """The coupler carries two plates that are welded to it and to each other: a loop of welds in a loop."""
    inner = four_bar("welded")
    parts = [*inner.parts, body("plate", (0.3, 0.1, 0.2)), body("other plate", (0.3, 0.2, 0.2))]
    welds = [
        joint("weld 1", "fixed", "welded2", "plate"),
        joint("weld 2", "fixed", "plate", "other plate"),
        joint("weld 3", "fixed", "other plate", "welded2"),
    ]
    return Mechanism(parts, [welds[0], *inner.joints, *welds[1:]], inner.speeds)


def welded_arm() -> Mechanism:
    """Three parts of an arm, each welded to both others."""
    parts = [body("arm 1", (0.3, 0, 0)), body("arm 2", (0.5, 0, 0)), body("arm 3", (0.5, 0, 0.4))]
    joints = [joint("shoulder", "revolute", GROUND, "arm 1", axis=Y, start='speed="1"')]
    for k, (first, second) in enumerate((("arm 1", "arm 2"), ("arm 2", "arm 3"), ("arm 1", "arm 3"))):
        joints.append(joint(f"seam {k}", "fixed", first, second))
    return Mechanism(parts, joints, {"shoulder": 1.0})


def slide(left: str, right: str) -> Mechanism:
    """A slide on two parallel inclined rails."""
    name = f"{left} {right}"
    kinds = {"left": left, "right": right}
    joints = [
        joint(f"{name} {side}", kind, GROUND, f"slide {name}", origin=(0, y, 0), axis=(1, 0, 1))
        for y, (side, kind) in enumerate(kinds.items())
    ]
    return Mechanism([body(f"slide {name}", (0, 0.3, 0.1))], joints)


def gantry() -> Mechanism:
    """A beam welded to two carriages, each on a rail of its own."""
    parts = [body("beam", (0, 0.5, 0)), body("carriage 1", (0, 0, 0)), body("carriage 2", (0, 1, 0))]
    joints = []
    for k in (1, 2):
        joints.append(joint(f"rail {k}", "prismatic", GROUND, f"carriage {k}", origin=(0, k - 1, 0), axis=(1, 0, 1)))
        joints.append(joint(f"bolts {k}", "fixed", f"carriage {k}", "beam", origin=(0, k - 1, 0)))
    return Mechanism(parts, joints)


def cardan_shaft() -> Mechanism:
    """Two parallel shafts and an intermediate one with forks in one plane: a constant ratio of 1."""
    parts = [body("input", (-0.3, 0, 0)), body("intermediate", (0.5, 0, 0.25)), body("output", (1.3, 0, 0.5))]
    across = (-0.5, 0, 1)
    joints = [
        joint("input bearing", "revolute", GROUND, "input", origin=(-0.5, 0, 0), axis=X, start='speed="2"'),
        joint("input cross", "universal", "input", "intermediate", axis=Y, axis2=across),
        joint("output cross", "universal", "output", "intermediate", origin=(1, 0, 0.5), axis=Y, axis2=across),
        joint("output bearing", "revolute", GROUND, "output", origin=(1.5, 0, 0.5), axis=X),
    ]
    return Mechanism(parts, joints, {"input bearing": 2.0})


def two_planes() -> Mechanism:
    """Two four-bar linkages in planes at a right angle; a bar of the first is the frame of the second."""
    parts = [body(f"bar {k}", (0.1 * k, 0.05 * k, 0)) for k in range(1, 7)]
    joints = [
        joint("y1", "revolute", GROUND, "bar 1", axis=Y, start='speed="1"'),
        joint("y2", "revolute", "bar 1", "bar 2", origin=(1, 0, 1), axis=Y),
        joint("y3", "revolute", "bar 2", "bar 3", origin=(2, 0, 1.2), axis=Y),
        joint("y4", "revolute", GROUND, "bar 3", origin=(3, 0, 0), axis=Y),
        joint("x1", "revolute", "bar 3", "bar 4", origin=(0.5, 1, 0.4), axis=X, start='speed="0.5"'),
        joint("x2", "revolute", "bar 4", "bar 5", origin=(0.5, 2, 1), axis=X),
        joint("x3", "revolute", "bar 5", "bar 6", origin=(0.5, 3, 0.5), axis=X),
        joint("x4", "revolute", "bar 3", "bar 6", origin=(0.5, 2.5, -1), axis=X),
    ]
    return Mechanism(parts, joints, {"y1": 1.0, "x1": 0.5})


def peaucellier(angle: float = 0.6, circle: float = 0.2, long: float = 0.6, short: float = 0.35) -> Mechanism:
    """The inversor of Peaucellier and Lipkin: a point moves on a straight line; pins that hold three bars."""
    near = circle * np.array([1 + math.cos(angle), math.sin(angle)])
    away = float(np.hypot(*near))
    along = near / away
    # Half the rhombus' width, from sqrt(long^2 - h^2) - sqrt(short^2 - h^2) = away.
    middle = (long**2 - short**2 + away**2) / (2 * away)
    height = math.sqrt(long**2 - middle**2)
    across = height * np.array([-along[1], along[0]])
    pins = {
        "o": np.zeros(2),
        "q": np.array([circle, 0.0]),
        "a": middle * along + across,
        "b": middle * along - across,
        "c": near,
        "d": (2 * middle - away) * along,
    }
    places = {name: (float(x), 0.0, float(z)) for name, (x, z) in pins.items()}
    bars = ("oa", "ob", "ac", "bc", "ad", "bd", "qc")
    parts = [body(f"bar {bar}", (np.array(places[bar[0]]) + places[bar[1]]) / 2) for bar in bars]
    ends = [
        ("q", GROUND, "bar qc"),
        ("o", GROUND, "bar oa"),
        ("o", GROUND, "bar ob"),
        ("a", "bar oa", "bar ac"),
        ("a", "bar oa", "bar ad"),
        ("b", "bar ob", "bar bc"),
        ("b", "bar ob", "bar bd"),
        ("c", "bar qc", "bar ac"),
        ("c", "bar ac", "bar bc"),
        ("d", "bar ad", "bar bd"),
    ]
    joints = [
        joint(f"pin {k} {pin}", "revolute", *pair, origin=places[pin], axis=Y, start='speed="1"' if k == 0 else "")
        for k, (pin, *pair) in enumerate(ends)
    ]
    return Mechanism(parts, joints, {"pin 0 q": 1.0})


def flying(inner: Mechanism, base: str) -> Mechanism:
    """A loop on a body that nothing holds."""
    start = '<start velocity="1 0 2" angularVelocity="0.5 1 -0.3"/>'
    return Mechanism([body(base, (0, 0, 0), start), *inner.parts], inner.joints, inner.speeds, [base])


LONG, SHORT = (0.1, 0, 0.1), (0.03, 0, 0.04)


def reach(name: str, near: str, base: str = GROUND, crank: ArrayLike = LONG) -> Mechanism:
    """Crank, coupler with a ball at its far end, and rocker in space; a short crank can turn all the way."""
    return ring(
        name,
        ["revolute", near, "spherical", "revolute"],
        [(0, 0, 0), crank, (0.6, 0.3, 0.2), (0.6, 0.1, 0)],
        [Y, Z, Z, X],
        speed=1.0 if near == "universal" else 0.0,
        base=base,
    )


def in_space(name: str, *kinds: str, speed: float = 1.0, first_last: bool = False) -> Mechanism:
    return ring(name, kinds, SPACE, DIRECTIONS, speed=speed, first_last=first_last)


def concurrent(name: str, count: int, base: str = GROUND) -> Mechanism:
    """Revolute axes through one point."""
    axes = [*THROUGH_ONE_POINT, (0.2, 0.3, -1)][:count]
    return ring(name, ["revolute"] * count, [(0, 0, 0)] * count, axes, speed=1.0 if count == 4 else 0.0, base=base)


# In groups that make one model each, so that few need building.
GROUPS: dict[str, dict[str, Mechanism]] = {
    "planar": {
        "four-bar linkage in an inclined plane": four_bar("four"),
        "slider-crank": ring(
            "slider",
            ["revolute", "revolute", "revolute", "prismatic"],
            [flat(0, 0), flat(0.2, 0.3), flat(1, 0.1), flat(1, 0.1)],
            [NORMAL, NORMAL, NORMAL, flat(1, 0.2)],
            speed=1.0,
        ),
        "Oldham's coupling": ring(
            "oldham",
            ["revolute", "prismatic", "prismatic", "revolute"],
            [flat(0, 0), flat(0, 0), flat(0.1, 0.05), flat(0.1, 0.05)],
            [NORMAL, flat(1, 0), flat(0.3, 1), NORMAL],
            speed=1.0,
        ),
        "planar joint in a planar loop": ring(
            "puck",
            ["revolute", "revolute", "planar"],
            [flat(0, 0), flat(0.2, 0.4), flat(1, 0.3)],
            [NORMAL] * 3,
        ),
        "three wedges": ring(
            "wedge",
            ["prismatic"] * 3,
            [flat(0, 0), flat(0.5, 0), flat(0.5, 0.5)],
            [flat(1, 0), flat(1, 1), flat(0.2, 1)],
            speed=0.5,
        ),
        "Peaucellier's inversor": peaucellier(),
        "loops in two planes with a common body": two_planes(),
        "planar loop in free flight": flying(four_bar("flyer", "ship"), "ship"),
    },
    "redundant": {
        "two rails, prismatic": slide("prismatic", "prismatic"),
        "two rails, cylindrical": slide("cylindrical", "cylindrical"),
        "two rails, closed by a cylindrical joint": slide("prismatic", "cylindrical"),
        "two rails, closed by a prismatic joint": slide("cylindrical", "prismatic"),
        "gantry of welded carriages": gantry(),
        "welds around an arm": welded_arm(),
        "welds on a coupler": welded_four_bar(),
        "spherical four-bar linkage": concurrent("sphere", 4),
        "five axes through one point": concurrent("five", 5),
        "spherical linkage in free flight": flying(concurrent("globe", 4, "orbiter"), "orbiter"),
        "universal joint between two bearings": ring(
            "hooke",
            ["revolute", "universal", "revolute"],
            [(-0.5, 0, 0), (0, 0, 0), (0.4, 0, 0.3)],
            [X, Y, (0.8, 0, 0.6)],
            speed=1.0,
            across=(0.8, 0, 0.6),
        ),
        "cardan shaft": cardan_shaft(),
    },
    "spatial": {
        "closed by a spherical joint": reach("universal", "universal", crank=SHORT),
        "two spherical joints": reach("balls", "spherical"),
        "closed by a revolute joint": in_space("rccc", "revolute", "cylindrical", "cylindrical", "cylindrical"),
        "closed by a cylindrical joint": in_space(
            "pccc", "prismatic", "cylindrical", "cylindrical", "cylindrical", speed=0.6
        ),
        "closed by a prismatic joint": in_space(
            "cccp", "prismatic", "cylindrical", "cylindrical", "cylindrical", speed=0.6, first_last=True
        ),
        "screw in the tree": in_space("hccc", "screw", "cylindrical", "cylindrical", "cylindrical"),
        "closed by a screw": in_space("heuh", "screw", "planar", "universal", "screw"),
        "closed by a universal joint": in_space(
            "pcuu", "prismatic", "cylindrical", "universal", "universal", speed=0.3
        ),
        "closed by a planar joint": in_space("pupe", "prismatic", "universal", "prismatic", "planar", speed=0.3),
        "spatial loop in free flight": flying(reach("rocket", "universal", "hull"), "hull"),
    },
}
