"""A mission driven by its scripted operator, as fast as the machine can be computed."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from contact_foundation.errors import InputError, Place
from contact_foundation.progress import Progress
from fmu_regression.fmi.fmu import open_fmu
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.scene_file import Scene
from fmu_regression.scene.signals import position_names

from interactive_drive.machine.controls import choose_controls
from interactive_drive.machine.machine import Machine
from interactive_drive.mission.mission_file import Mission
from interactive_drive.mission.score import watched_signals
from interactive_drive.mission.scripted_operator import ScriptedOperator

_AFTER = 1.0  # s that are driven on after the goal


def play(mission: Mission, fmu: Path, scene: Scene, signals: Sequence[str], progress: Progress) -> SimulationResult:
    """Drives a mission until a second after the goal, or the time limit.

    Args:
        mission: with a scripted operator.
        fmu: of its machine.
        scene: of it.
        signals: to record beside those that a score needs.
        progress: told about it.

    Raises:
        InputError: the mission has no operator, or names inputs or signals that the FMU has not.
        SimulationError: the FMU stops.
    """
    if not mission.phases:
        raise InputError("has no scripted operator", place=Place(file=mission.file), remedy="Add [[operator.phase]].")
    watched = watched_signals(mission, scene)
    seen = _seen(mission, scene)
    names = tuple(dict.fromkeys([*watched, *seen, *signals]))
    places = [names.index(name) for name in seen]
    operator = ScriptedOperator(mission)
    with open_fmu(fmu) as opened:
        controls = {control.name: control for control in choose_controls(opened.description) if control.is_input}
        _check_inputs(mission, list(controls))
        with Machine(opened, names, mission.step) as machine:
            times, rows = [machine.time], [machine.row()]
            end = machine.time + mission.time_limit
            while machine.time < end - 0.5 * mission.step:
                x, y, heading = (float(rows[-1][k]) for k in places) if places else (0.0, 0.0, 0.0)
                wanted = operator.inputs(machine.time, (x, y), heading)
                machine.set({name: controls[name].admitted(value) for name, value in wanted.items()})
                machine.step()
                times.append(machine.time)
                rows.append(machine.row())
                if end > machine.time + _AFTER and _is_there(mission, rows[-1]):
                    end = machine.time + _AFTER
                progress("drive", min(1.0, machine.time / mission.time_limit), f"t = {machine.time:.1f} s")
    values = np.array(rows)
    return SimulationResult(time=np.array(times), signals={name: values[:, k] for k, name in enumerate(names)})


def _seen(mission: Mission, scene: Scene) -> list[str]:
    """Signals that the operator steers by: x and y of the steered body, heading."""
    steering = mission.steering
    if steering is None:
        return []
    body = next((each for each in scene.bodies if each.name == steering.body), None)
    if body is None:
        raise InputError(
            f"the machine has no body {steering.body}", place=Place(file=mission.file, component="operator")
        )
    return [*position_names(body)[:2], steering.heading]


def _is_there(mission: Mission, row: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> bool:
    x, y = mission.goal.position
    return bool(np.hypot(row[0] - x, row[1] - y) <= mission.goal.radius and row[2] >= mission.goal.height)


def _check_inputs(mission: Mission, known: Sequence[str]) -> None:
    steered = [mission.steering.forward, mission.steering.turn] if mission.steering is not None else []
    for name in (*steered, *(name for phase in mission.phases for name in phase.inputs)):
        if name not in known:
            raise InputError(
                f"the machine has no input {name}",
                place=Place(file=mission.file),
                remedy=f"Its inputs are {', '.join(known)}." if known else "It has no inputs.",
            )
