"""FMUs of this project's builder, or any other, by co-simulation: the FMU's own solver."""

from __future__ import annotations

from contextlib import ExitStack
from importlib import metadata
from pathlib import Path
from typing import Final

import numpy as np
from fmu_regression.fmi.description import check_signals, check_start_values
from fmu_regression.fmi.fmu import Instance, open_fmu

from peer_bench.programs.simulation import Settings, Simulation
from peer_bench.scenes import Scene

VERSION: Final = metadata.version("contactmultibody")
_COUNTERS: Final = {
    "steps": "cmbSolver.steps",
    "evaluations": "cmbSolver.evaluations",
    "jacobians": "cmbSolver.jacobians",
    "rejected": "cmbSolver.errorTestFailures",
    "events": "cmbSolver.stateEvents",
}


def simulation(scene: Scene, settings: Settings) -> Simulation:
    """A scene with settings.

    Args:
        scene: which.
        settings: fmu (file), tolerance, and start values of the FMU, by ``start.`` and their names.
    """
    return _CoSimulation(scene, settings)


class _CoSimulation:
    def __init__(self, scene: Scene, settings: Settings) -> None:
        self.scene = scene
        self._stack = ExitStack()
        try:
            opened = self._stack.enter_context(open_fmu(Path(str(settings["fmu"]))))
            self._instance: Instance = self._stack.enter_context(opened.instantiate("cs"))
            description = opened.description
            starts = {key.removeprefix("start."): v for key, v in settings.items() if key.startswith("start.")}
            self._instance.set_start_values(check_start_values(description, starts))
            self._functions = self._instance.functions
            self._functions.enter_initialization(float(settings["tolerance"]), 0.0, scene.stop)
            self._functions.exit_initialization()
            variables = check_signals(description, _signals(scene))
            self._read = self._functions.reader(variables[0].data_type, [v.reference for v in variables])
            self._time = 0.0
        except BaseException:
            self._stack.close()
            raise

    def advance(self, until: float) -> None:
        """One communication step."""
        self._functions.do_step(self._time, until - self._time)
        self._time = until

    def values(self) -> list[float]:
        """What is compared."""
        found = self._read()
        if self.scene.centre_only:
            return [float(value) for value in np.asarray(found).reshape(-1, 3).mean(axis=0)]
        return [float(value) for value in found]

    def work(self) -> dict[str, float]:
        """What the FMU's solver counted."""
        variables = self._instance.description.variables
        names = {key: name for key, name in _COUNTERS.items() if name in variables}
        found: dict[str, float] = {}
        for key, name in names.items():
            variable = variables[name]
            found[key] = float(self._functions.reader(variable.data_type, [variable.reference])()[0])
        return found

    def close(self) -> None:
        """Frees the instance and removes the unpacked FMU."""
        self._stack.close()


def _signals(scene: Scene) -> list[str]:
    if scene.world is None:
        return _COORDINATES[scene.name]
    if scene.centre_only:
        count = len(scene.world.bodies)
        return [f"spheres.r[{k + 1},{axis + 1}]" for k in range(count) for axis in range(3)]
    single = len(scene.world.bodies) == 1
    name = "body" if single else "body[{}]"
    return [f"{name.format(k + 1)}.r_0[{axis + 1}]" for k, axis in scene.looked_at]


_COORDINATES: Final = {
    "Newton's cradle": [f"string[{k + 1}].phi" for k in range(5)],
    "hexapod": [f"torso.r_0[{k + 1}]" for k in range(3)],
}
