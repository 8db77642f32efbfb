"""What `cmb drive` does before and around a drive: finds or builds the FMU, starts the server, opens the browser."""

from __future__ import annotations

import importlib.util
import shutil
import threading
import webbrowser
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from contact_foundation.errors import BuildError, InputError, Place
from contact_foundation.output import whole_folder
from fmu_regression.fmi.description import ModelDescription, check_signals, read_description
from fmu_regression.scene.scene_file import Scene, load_scene
from fmu_regression.scene.signals import pair_signal, require_signals, signals_for
from fmu_regression.simulate.simulation import default_signals
from scene_viewer.bundle import require_installed

from cmb.assembly_file import find_assembly
from cmb.assignments import parse_assignments
from cmb.experiment import find_experiment
from cmb.run_folder import PACKAGE_FOLDER
from cmb.terminal import progress_bars

if TYPE_CHECKING:
    from interactive_drive.process.worker import Plan
    from interactive_drive.server.drive_session import DriveSession
    from interactive_drive.server.listening import Listening

_PACKAGES = ("starlette", "uvicorn", "websockets")
_MOST_PLOTS = 6


def require_packages() -> None:
    """Raises BuildError if the packages of the server are not installed."""
    missing = [name for name in _PACKAGES if importlib.util.find_spec(name) is None]
    if missing:
        raise BuildError(
            f"cmb drive needs {', '.join(missing)}, not installed here",
            remedy="Install them: pip install 'contactmultibody[drive]'.",
        )


@dataclass(frozen=True)
class _Machine:
    fmu: Path
    description: ModelDescription
    scene: Scene | None
    scene_file: Path | None
    output: Path


def drive(arguments: Namespace) -> int:
    """Serves a drive until it is interrupted."""
    from interactive_drive.server.drive_server import DriveServer
    from interactive_drive.server.listening import DEFAULT_PORT

    require_installed()
    listening = _listening(arguments)
    socket = listening.bind(DEFAULT_PORT if arguments.port is None else arguments.port)
    with socket:
        plan, session = _prepare(arguments)
        server = DriveServer(
            plan, session, socket, lambda address: print(f"for a further operator: {address}", flush=True), listening
        )
        address = server.address
        print(f"{session.model}: {address}\nCtrl-C ends it.", flush=True)
        if not arguments.no_browser and listening.is_loopback:
            threading.Timer(0.5, webbrowser.open, [address]).start()
        try:
            server.serve()
        except KeyboardInterrupt as interruption:
            if type(interruption) is not KeyboardInterrupt:
                raise
    return 0


def measure(arguments: Namespace) -> int:
    """Measures a drive without a browser and prints the table."""
    from interactive_drive.benchmark.benchmark import measure_drive, table
    from interactive_drive.server.listening import Listening

    if arguments.listen is not None or arguments.certificate is not None:
        raise InputError("--headless measures on this machine alone", remedy="Leave --listen and --certificate out.")
    with Listening().bind(0 if arguments.port is None else arguments.port) as socket:
        plan, session = _prepare(arguments)
        with progress_bars() as progress:
            figures = measure_drive(plan, session, socket, 60 * arguments.minutes, progress)
    print(table(figures))
    return 0


def _listening(arguments: Namespace) -> Listening:
    """Where the page is served, as the user says it."""
    from interactive_drive.server.listening import LOOPBACK, Listening

    if arguments.key is not None and arguments.certificate is None:
        raise InputError("--key is that of a certificate", remedy="Give --certificate too.")
    if arguments.insecure and arguments.certificate is not None:
        raise InputError("--insecure and --certificate exclude each other", remedy="Leave one of them out.")
    listening = Listening(arguments.listen or LOOPBACK, arguments.certificate, arguments.key)
    listening.require_protection(arguments.insecure)
    return listening


def _prepare(arguments: Namespace) -> tuple[Plan, DriveSession]:
    from interactive_drive.channel.conditions import parse_conditions
    from interactive_drive.machine.controls import choose_controls
    from interactive_drive.operation.key_map import default_key_map, read_key_map
    from interactive_drive.process.worker import Plan
    from interactive_drive.server.drive_session import DriveSession

    channel = parse_conditions(arguments.channel) if arguments.channel is not None else None
    machine = _find(arguments)
    description, scene = machine.description, machine.scene
    if "cs" not in description.identifiers:
        raise InputError(
            "the FMU offers model exchange alone and cannot be driven",
            place=Place(file=machine.fmu),
            remedy="Build it with cmb fmu, whose FMUs offer co-simulation too.",
        )
    controls = choose_controls(description, arguments.tune)
    key_map = read_key_map(arguments.controls, controls) if arguments.controls else default_key_map(controls)
    recorded = signals_for(scene, description) if scene is not None else []
    plots = arguments.plot if arguments.plot is not None else _default_plots(description, scene, recorded)
    names = [*recorded, *default_signals(description), *(control.name for control in controls), *plots]
    signals = tuple(variable.name for variable in check_signals(description, names))
    units = {name: unit for name in signals if (unit := description.variables[name].unit)}
    plan = Plan(machine.fmu, signals, arguments.step, arguments.tolerance, parse_assignments(arguments.set))
    session = DriveSession(
        model=description.name,
        step=arguments.step,
        signals=signals,
        controls=controls,
        key_map=key_map,
        scene=scene,
        scene_file=machine.scene_file,
        output=machine.output,
        plots=tuple(plots),
        units=units,
        channel=channel,
    )
    return plan, session


def _default_plots(description: ModelDescription, scene: Scene | None, recorded: Sequence[str]) -> list[str]:
    """Outputs, joint coordinates and contact forces, as many as one can look at."""
    outputs = [v.name for v in description.variables.values() if v.causality == "output" and v.kind != "String"]
    joints = [joint.variable for joint in scene.joints] if scene is not None else []
    pairs = [pair_signal(scene, pair, "normalForce") for pair in scene.pairs] if scene is not None else []
    known = set(recorded)
    half = _MOST_PLOTS // 2
    own = [name for name in joints if name in known][:half] + [name for name in pairs if name in known][:half]
    return (own or outputs or list(description.states))[:_MOST_PLOTS]


def _find(arguments: Namespace) -> _Machine:
    given: Path = arguments.machine
    if given.is_file() and given.suffix.lower() == ".fmu":
        return _given_fmu(given, arguments)
    if given.suffix.lower() == ".toml":
        return _mission(given, arguments)
    assembly = find_assembly(given)
    if arguments.scene is not None:
        raise InputError(
            "--scene is for an FMU; an assembly has its own", place=Place(file=given), remedy="Leave --scene out."
        )
    from cmb.pipeline import build_machine

    output = arguments.output or Path("out") / f"{assembly.stem}-drive"
    folder = output / "machine"
    with progress_bars() as progress, whole_folder(folder) as staging:
        if (folder / PACKAGE_FOLDER).is_dir():
            shutil.copytree(folder / PACKAGE_FOLDER, staging / PACKAGE_FOLDER, symlinks=True)
        built = build_machine(arguments, assembly, find_experiment(assembly.parent), staging, progress)
    fmu, scene_file = (folder / path.relative_to(staging) for path in (built.fmu, built.scene_file))
    return _Machine(fmu, built.description, built.scene, scene_file, output)


def _mission(file: Path, arguments: Namespace) -> _Machine:
    from interactive_drive.mission.mission_file import read_mission
    from interactive_drive.mission.score import watched_signals

    from cmb.mission_machine import build_mission

    mission = read_mission(file)
    output = arguments.output or Path("out") / f"{file.stem}-drive"
    with progress_bars() as progress:
        built = build_mission(arguments, mission, output, progress)
    watched_signals(mission, built.scene)  # names in the mission are checked before it is driven
    return _Machine(built.fmu, built.description, built.scene, built.scene_file, output)


def _given_fmu(fmu: Path, arguments: Namespace) -> _Machine:
    description = read_description(fmu)
    beside = fmu.parent / PACKAGE_FOLDER / "scene.json"
    scene_file = arguments.scene or (beside if beside.is_file() else None)
    scene = load_scene(scene_file) if scene_file is not None else None
    if scene is not None:
        require_signals(
            scene, description.variables, Place(file=fmu), f"Is {scene_file} the scene of this FMU? See --scene."
        )
    return _Machine(fmu, description, scene, scene_file, arguments.output or Path("out") / f"{fmu.stem}-drive")
