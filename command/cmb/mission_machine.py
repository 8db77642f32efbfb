"""The machine of a mission: its assembly with the course around it, or a model of its own, built as an FMU."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from contact_data import modelica_library
from contact_foundation.progress import Progress
from fmu_regression.fmi.description import read_description
from fmu_regression.scene.fmu_scene import scene_of_fmu

from cmb.assembly_file import find_assembly
from cmb.build_arguments import build_options
from cmb.experiment import find_experiment
from cmb.pipeline import BuiltMachine, build_machine

if TYPE_CHECKING:
    from interactive_drive.mission.mission_file import Mission

COURSE = "course"
MACHINE = "machine"


def build_mission(arguments: Namespace, mission: Mission, folder: Path, progress: Progress) -> BuiltMachine:
    """Builds what a mission drives; FMUs of unchanged files come from the cache.

    Args:
        arguments: of a parser with the arguments of builds and of generation.
        mission: to be driven.
        folder: to write to.
        progress: told about the steps.
    """
    from interactive_drive.mission.course import write_course
    from modelica2fmu.build import build_fmu

    machine = folder / MACHINE
    machine.mkdir(parents=True, exist_ok=True)
    if mission.assembly is not None:
        assembly = write_course(mission, find_assembly(mission.assembly), folder / COURSE)
        return build_machine(arguments, assembly, find_experiment(assembly.parent), machine, progress)
    fmu = machine / f"{mission.file.stem}.fmu"
    build_fmu(mission.model, (*mission.sources, modelica_library()), fmu, build_options(arguments), progress)
    return BuiltMachine(fmu, fmu, scene_of_fmu(fmu), read_description(fmu))
