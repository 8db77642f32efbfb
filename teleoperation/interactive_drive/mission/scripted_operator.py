"""An operator that follows a script: phases of held inputs, and points to head for."""

from __future__ import annotations

import math
from collections.abc import Mapping

from interactive_drive.mission.mission_file import Mission, Phase, Steering

_FULL = math.radians(20)


class ScriptedOperator:
    """Steers a machine by what it sees of it: place and heading.

    Args:
        mission: with the operator's phases.
    """

    def __init__(self, mission: Mission) -> None:
        self._steering = mission.steering
        self._phases = list(mission.phases)
        self._begun: float | None = None

    def inputs(self, time: float, place: tuple[float, float], heading: float) -> Mapping[str, float]:
        """Values of the inputs.

        Args:
            time: s.
            place: of the machine, x and y in m.
            heading: rad from the x axis.
        """
        while self._phases and self._is_over(self._phases[0], time, place):
            self._phases.pop(0)
            self._begun = time
        if not self._phases:
            return self._at_rest()
        if self._begun is None:
            self._begun = time
        phase = self._phases[0]
        if phase.towards is None or self._steering is None:
            return phase.inputs
        return {**phase.inputs, **_towards(self._steering, phase.towards, place, heading)}

    def _is_over(self, phase: Phase, time: float, place: tuple[float, float]) -> bool:
        if self._begun is not None and time - self._begun >= phase.until:
            return True
        near = phase.towards is not None and self._steering is not None
        return near and math.dist(place, phase.towards or place) < (self._steering.near if self._steering else 0.0)

    def _at_rest(self) -> Mapping[str, float]:
        return {self._steering.forward: 0.0, self._steering.turn: 0.0} if self._steering is not None else {}


def _towards(
    steering: Steering, point: tuple[float, float], place: tuple[float, float], heading: float
) -> dict[str, float]:
    """Turns to the point, and walks as far as the machine looks at it."""
    wanted = math.atan2(point[1] - place[1], point[0] - place[0])
    off = math.remainder(wanted - heading, 2 * math.pi)
    ahead = max(0.0, 1.0 - abs(off) / (2 * _FULL))
    return {steering.forward: steering.speed * ahead, steering.turn: steering.gain * off}
