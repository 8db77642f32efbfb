"""Power through the axes of joints: what drives put in, and what drives, stops, springs and friction take out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.scene_file import Scene
from fmu_regression.scene.signals import effort_name


@dataclass(frozen=True)
class JointPower:
    """Power at the axes of all joints together, each of shape (n,).

    Attributes:
        time: s.
        supplied: power that goes into the bodies at joints that push them on, W, not negative.
        taken: power that joints take from the bodies, W, not negative.
    """

    time: FloatArray
    supplied: FloatArray
    taken: FloatArray

    @property
    def work(self) -> FloatArray:
        """Energy that has come in through the joints less what has gone out, by the trapezoidal rule, J."""
        power = self.supplied - self.taken
        steps = (power[1:] + power[:-1]) / 2 * np.diff(self.time)
        work: FloatArray = np.concatenate([[0.0], np.cumsum(steps)])
        return work


def joint_power(scene: Scene, result: SimulationResult) -> JointPower | None:
    """The power at the axes of a scene's joints; None where the result has no torque or force of any joint."""
    supplied = np.zeros(result.time.size)
    taken = np.zeros(result.time.size)
    found = False
    for joint in scene.joints:
        effort = effort_name(joint)
        if effort not in result or joint.rate not in result:
            continue
        found = True
        power = result[effort] * result[joint.rate]
        supplied += np.maximum(power, 0.0)
        taken += np.maximum(-power, 0.0)
    return JointPower(result.time, supplied, taken) if found and (supplied.any() or taken.any()) else None
