"""What is known of a run beforehand: how long contacts last, how deep they get, how much energy there is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from hard_cases.bodies import GRAVITY, MOST_TILT, Motion, gap, has_gravity, motions, pairs, shapes
from hard_cases.knobs import HardCase

_CONTACTS: Final = 40.0
"""At least so many contact times are simulated, and so many of the times below."""
_MOST_CONTACT_TIMES = 1e5
_FALLS = 3.0
_FLIGHTS = 2.5
_FASTEST_FLIGHT = 3.0


@dataclass(frozen=True)
class Expectation:
    """What is known of a run beforehand.

    Attributes:
        stop: time that is simulated, s.
        contact_time: of the lightest body on its spring, s.
        depth: deepest penetration without damping, all bodies together on one spring, m.
        thickness: least extent of a body, m.
        energy: that errors of the energy are divided by: what there is at the start without the elastic one, and the
            weights by the scene's size, J.
        damping: of springs with dampers that gives the restitution of a linear oscillator, N.s/m.
        steady_rate: of the damping where restitution is not used: 1 by the speed, s/m.
    """

    stop: float
    contact_time: float
    depth: float
    thickness: float
    energy: float
    damping: float
    steady_rate: float

    @property
    def relative_depth(self) -> float:
        """Deepest penetration by the least extent of a body."""
        return self.depth / self.thickness

    @property
    def contact_times(self) -> float:
        """How many contact times are simulated."""
        return self.stop / self.contact_time


def expect(case: HardCase) -> Expectation:
    """What is known of a run beforehand."""
    structure = case.structure
    bodies = motions(case)
    lightest, total = min(body.mass for body in bodies), sum(body.mass for body in bodies)
    gravity = GRAVITY if has_gravity(structure) else 0.0
    thickness = min(shape.thickness for shape in shapes(structure))
    contact_time = math.pi * math.sqrt(lightest / case.stiffness)
    speed = 0.0 if structure.kind == "overlap" else case.speed
    kinetic = sum(body.mass * sum(x * x for x in body.velocity) / 2 for body in bodies)
    weight = total * gravity
    kinetic += weight * _drop(case)
    depth = (weight + math.sqrt(weight**2 + 2 * case.stiffness * kinetic)) / case.stiffness
    stop = _CONTACTS * math.pi * math.sqrt(total / case.stiffness)
    if gravity:
        stop = max(stop, _FALLS * math.sqrt(2 * structure.size / gravity))
        stop = max(stop, _FLIGHTS * min(speed, _FASTEST_FLIGHT) / gravity)
    else:
        stop = max(stop, _FLIGHTS * structure.size / speed)
    stop = max(min(stop, _MOST_CONTACT_TIMES * contact_time), _CONTACTS * math.pi * math.sqrt(total / case.stiffness))
    return Expectation(
        stop=stop,
        contact_time=contact_time,
        depth=depth + _overlap(case, bodies),
        thickness=thickness,
        energy=kinetic + weight * structure.size,
        damping=_damping(case, lightest),
        steady_rate=1.0 / case.speed,
    )


def _drop(case: HardCase) -> float:
    """How far a body falls at most before it lies, m."""
    if case.structure.kind in ("box", "rod"):
        return case.structure.size
    return gap(case) + (case.structure.size * MOST_TILT if case.structure.kind == "hulls" else 0.0)


def _overlap(case: HardCase, bodies: tuple[Motion, ...]) -> float:
    """Overlap at the start, m."""
    if case.structure.kind != "overlap":
        return 0.0
    box, ball = shapes(case.structure)
    in_floor = box.thickness / 2 - bodies[0].position[2]
    in_box = bodies[0].position[2] + box.thickness / 2 + ball.thickness / 2 - bodies[1].position[2]
    assert len(pairs(case.structure)) == len((in_floor, in_box))
    return max(in_floor, in_box)


def _damping(case: HardCase, mass: float) -> float:
    """Of an oscillator that passes its rest position with e times its speed, half a period later; critical at e = 0."""
    if case.restitution <= 0:
        ratio = 1.0
    else:
        logarithm = -math.log(case.restitution)
        ratio = logarithm / math.hypot(math.pi, logarithm)
    return 2 * ratio * math.sqrt(case.stiffness * mass)
