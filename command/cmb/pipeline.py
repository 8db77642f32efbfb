"""The whole way of `cmb run`: assembly, Modelica package, FMU, simulation, report."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path

from cad2modelica import generate
from contact_data import modelica_library
from contact_foundation.errors import Place
from contact_foundation.progress import Progress
from fmu_regression.fmi.description import ModelDescription, read_description
from fmu_regression.report.simulation_report import write_report
from fmu_regression.report.summarise import summarise
from fmu_regression.results.result import write_csv
from fmu_regression.scene.scene_file import Scene, load_scene
from fmu_regression.scene.signals import require_signals, signals_for
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import build_fmu

from cmb.build_arguments import build_options
from cmb.experiment import Experiment
from cmb.generation_arguments import generation_options
from cmb.notes import grouped
from cmb.run_folder import PACKAGE_FOLDER, REPORT, RESULT


@dataclass(frozen=True)
class BuiltMachine:
    """An assembly's FMU, which offers what its scene needs.

    Attributes:
        fmu: the file.
        scene_file: scene.json of its package.
        scene: what it says.
        description: of the FMU.
        notes: on what was chosen, changed or left out on the way from the assembly.
    """

    fmu: Path
    scene_file: Path
    scene: Scene
    description: ModelDescription
    notes: tuple[str, ...] = ()


def build_machine(
    arguments: Namespace, assembly: Path, experiment: Experiment, folder: Path, progress: Progress
) -> BuiltMachine:
    """Generates the package of an assembly and builds its FMU.

    Args:
        arguments: of the command.
        assembly: the assembly's file.
        experiment: which model is built in place of the generated one.
        folder: to write to; it may hold an earlier package.
        progress: told about the steps.
    """
    package = generate(assembly, folder / PACKAGE_FOLDER, generation_options(arguments), progress)
    fmu = folder / f"{assembly.stem}.fmu"
    model = experiment.model or package.mechatronics
    sources = (*experiment.sources, package.root, modelica_library())
    build_fmu(model, sources, fmu, build_options(arguments), progress)
    scene = load_scene(package.scene)
    description = read_description(fmu)
    require_signals(
        scene, description.variables, Place(file=fmu), "Does the experiment's model extend the generated one?"
    )
    experiment.figures.require(description.variables, Place(file=experiment.file))
    return BuiltMachine(fmu, package.scene, scene, description, tuple(package.notes))


def carry_out(arguments: Namespace, assembly: Path, experiment: Experiment, folder: Path, progress: Progress) -> str:
    """Carries out every step of ``cmb run``.

    Args:
        arguments: of the command.
        assembly: the assembly's file.
        experiment: what is simulated in place of the generated model, and what is reported.
        folder: to write to; it may hold an earlier package.
        progress: told about the steps.

    Returns:
        The notes of the generation and the result's summary, in lines.
    """
    machine = build_machine(arguments, assembly, experiment, folder, progress)
    scene, description = machine.scene, machine.description
    result = simulate(
        machine.fmu,
        signals=list(dict.fromkeys([*signals_for(scene, description), *experiment.figures.signals])),
        stop=arguments.stop,
        tolerance=arguments.tolerance,
        interval=arguments.interval,
        mode=arguments.mode,
        time_limit=arguments.time_limit,
        progress=progress,
    )
    write_csv(result, folder / RESULT)
    progress("report", 0.0)
    write_report(result, machine.scene_file, folder / REPORT, experiment.figures)
    progress("report", 1.0)
    notes = [f"- {note}" for note in grouped(machine.notes)]
    return "\n".join([*notes, summarise(result, scene), *experiment.figures.lines(result)])
