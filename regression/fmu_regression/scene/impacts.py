"""Table of impacts: stretches of contact between two bodies with speeds before and after."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.scene_file import ContactPair, Scene
from fmu_regression.scene.signals import pair_signal

_REST_SPEED = 1e-3


@dataclass(frozen=True)
class Impact:
    """One stretch of contact of one pair.

    Attributes:
        pair: the pair.
        start: when it began, s.
        end: when it ended, s, or None if it lasts to the end of the result.
        speed_before: speed of approach when it began, m/s, or None if the result does not have it.
        speed_after: speed of separation when it ended, m/s, or None.
        peak_force: largest normal force, N, or None.
        peak_time: when, s.
        impulse: integral of the normal force, N s, or None.
        located: whether start and end are event rows; if not, they are interpolated between samples.
        rests: whether the bodies hardly move along the normal, below 1 mm/s, in more than half of the contact.
    """

    pair: ContactPair
    start: float
    end: float | None
    speed_before: float | None
    speed_after: float | None
    peak_force: float | None
    peak_time: float | None
    impulse: float | None
    located: bool
    rests: bool = False

    @property
    def meets(self) -> bool:
        """Whether the bodies really met: a contact that begins at rest, below 1 mm/s, is no impact."""
        return self.speed_before is not None and self.speed_before >= _REST_SPEED

    @property
    def restitution(self) -> float | None:
        """Coefficient of restitution delivered: speed after by speed before; None where there was no impact.

        Bodies that came to rest on each other, as feet do, are parted by something else than the impact.
        """
        if self.speed_before is None or self.speed_after is None or not self.meets or self.rests:
            return None
        return self.speed_after / self.speed_before


def find_impacts(scene: Scene, result: SimulationResult) -> tuple[Impact, ...]:
    """All stretches of contact of all pairs, ordered by time, then pair.

    Contact is ``touches``; where that is not recorded, a negative ``distance``; else a positive ``normalForce``.
    A pair with none of these has no rows.
    """
    impacts = [impact for pair in scene.pairs for impact in _PairReader(scene, pair, result).impacts()]
    return tuple(sorted(impacts, key=lambda impact: (impact.start, impact.pair.index)))


class _PairReader:
    """The signals of one pair."""

    def __init__(self, scene: Scene, pair: ContactPair, result: SimulationResult) -> None:
        def signal(quantity: str) -> FloatArray | None:
            name = pair_signal(scene, pair, quantity)
            return result.signals.get(name)

        self.pair = pair
        self.time = result.time
        self.distance = signal("distance")
        self.force = signal("normalForce")
        self.speed = signal("approachSpeed")
        self.touches = self._touching(signal("touches"))

    def impacts(self) -> list[Impact]:
        if self.touches is None or not self.touches.size:
            return []
        edges = np.flatnonzero(np.diff(self.touches.astype(np.int8)))
        first = [0] if self.touches[0] else []
        starts = first + [int(k) + 1 for k in edges if self.touches[k + 1]]
        ends = [int(k) for k in edges if self.touches[k]] + ([self.time.size - 1] if self.touches[-1] else [])
        return [self._impact(start, end) for start, end in zip(starts, ends, strict=True)]

    def _touching(self, touches: FloatArray | None) -> NDArray[np.bool_] | None:
        if touches is not None:
            return touches > 0.5
        if self.distance is not None:
            return self.distance < 0
        return self.force > 0 if self.force is not None else None

    def _impact(self, start: int, end: int) -> Impact:
        """The contact in rows start to end, both within it."""
        time = self.time
        begins_inside = start > 0
        lasts = end == time.size - 1
        start_time, start_located = self._edge(start - 1, start) if begins_inside else (float(time[0]), True)
        end_time, end_located = self._edge(end, end + 1) if not lasts else (float(time[-1]), True)
        before = self._speed_at(start_time, start, start - 1, start - 2, start_located) if begins_inside else None
        after = self._speed_at(end_time, end, end + 1, end + 2, end_located) if not lasts else None
        peak = peak_time = impulse = None
        if self.force is not None:
            rows = slice(start, end + 1)
            highest = int(np.argmax(self.force[rows])) + start
            peak, peak_time = float(self.force[highest]), float(time[highest])
            impulse = float(np.trapezoid(self.force[rows], time[rows]))
        return Impact(
            pair=self.pair,
            start=start_time,
            end=None if lasts else end_time,
            speed_before=before,
            speed_after=None if after is None else -after,
            peak_force=peak,
            peak_time=peak_time,
            impulse=impulse,
            located=start_located and end_located,
            rests=self._rests(slice(start, end + 1)),
        )

    def _rests(self, rows: slice) -> bool:
        time = self.time[rows]
        if self.speed is None or time[-1] <= time[0]:
            return False
        slow = (np.abs(self.speed[rows]) < _REST_SPEED).astype(float)
        return float(np.trapezoid(slow, time)) > float(time[-1] - time[0]) / 2

    def _edge(self, left: int, right: int) -> tuple[float, bool]:
        """When contact changed between two neighbouring rows, and whether an event row says so exactly."""
        t0, t1 = float(self.time[left]), float(self.time[right])
        if t0 == t1:
            return t0, True
        if self.distance is not None:
            d0, d1 = float(self.distance[left]), float(self.distance[right])
            if (d0 < 0) != (d1 < 0):
                return t0 + (t1 - t0) * d0 / (d0 - d1), False
        return (t0 + t1) / 2, False

    def _speed_at(self, when: float, inside: int, outside: int, farther: int, located: bool) -> float | None:
        """Speed of approach at an edge of the contact.

        Within the contact the speed changes quickly, so between samples it is extrapolated from outside.
        """
        if self.speed is None:
            return None
        if located:
            return float(self.speed[inside])
        value = float(self.speed[outside])
        if 0 <= farther < self.time.size and self.touches is not None and not self.touches[farther]:
            span = float(self.time[farther] - self.time[outside])
            if span != 0:
                slope = (float(self.speed[farther]) - value) / span
                value += slope * (when - float(self.time[outside]))
        return value
