"""`cmb run`: the whole pipeline from a CAD assembly to a report."""

from __future__ import annotations

import shutil
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from contact_foundation.errors import CmbError, InputError, Place
from contact_foundation.output import MARKER, whole_folder

from cmb.assembly_file import ASSEMBLY_HELP, find_assembly
from cmb.build_arguments import add_build_arguments
from cmb.generation_arguments import add_generation_arguments
from cmb.run_folder import PACKAGE_FOLDER, REPORT, RESULT
from cmb.simulation_arguments import add_simulation_arguments
from cmb.terminal import progress_bars

NAME = "run"
SUMMARY = "CAD assembly to Modelica package, FMU, result and report in one go"
DESCRIPTION = (
    "Reads an assembly, writes the Modelica package, builds the FMU with the contact engine inside, simulates it "
    "and writes result.csv and report.html. The output folder appears when everything is there. A file experiment.toml "
    "beside the assembly may name another model, of the modeller's own, and what the report shows beside the usual."
)
EXAMPLES = """examples:
  cmb run Resources/cad/hammer --output out/hammer
  cmb run Resources/cad/anton --output out/anton
  cmb run robot/robot.xml --output out/robot \\
    --stop 10 --tolerance 1e-5 --mode cs
"""


def add_arguments(parser: ArgumentParser) -> None:
    """Adds the command's arguments."""
    parser.add_argument("assembly", type=Path, metavar="ASSEMBLY", help=ASSEMBLY_HELP)
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="folder to write (out/NAME if left out)")
    add_simulation_arguments(parser, stop="the assembly's own")
    parser.add_argument("--mode", choices=("me", "cs"), default="me", help="model exchange or co-simulation")
    add_build_arguments(parser)
    add_generation_arguments(parser)


def run(arguments: Namespace) -> int:
    """Runs the whole pipeline and prints the summary."""
    assembly = find_assembly(arguments.assembly)
    output = arguments.output or Path("out") / assembly.stem
    _require_own(output, assembly.stem)
    from cmb.experiment import find_experiment
    from cmb.pipeline import carry_out

    experiment = find_experiment(assembly.parent)
    if experiment.model is None and arguments.stop is not None and arguments.stop <= 0.0:
        raise InputError(f"the stop time {arguments.stop:g} s must be greater than the start time 0")
    with progress_bars() as progress, whole_folder(output) as staging, _errors_in(staging, output):
        _keep_package(output / PACKAGE_FOLDER, staging / PACKAGE_FOLDER)
        summary = carry_out(arguments, assembly, experiment, staging, progress)
    print(summary)
    print(f"\nresults in {output}: the Modelica package, the FMU, result.csv, report.html")
    return 0


def _require_own(output: Path, stem: str) -> None:
    """Raises InputError if the folder of an earlier run holds what no run wrote: the next one would lose it."""
    known = {PACKAGE_FOLDER, f"{stem}.fmu", RESULT, REPORT, MARKER}
    others = sorted(path.name for path in output.glob("*") if path.name not in known)
    if others and (output / MARKER).exists():
        raise InputError(
            f"holds {others[0]!r}, which no run of {stem!r} wrote and the next one would lose",
            place=Place(file=output),
            remedy=f"Move it away, or into the package in {PACKAGE_FOLDER}, whose files are kept.",
        )


@contextmanager
def _errors_in(staging: Path, output: Path) -> Iterator[None]:
    """Names the output where an error names the folder that holds it until it is whole."""
    try:
        yield
    except CmbError as error:
        file = error.place.file if error.place is not None else None
        if error.place is not None and file is not None and file.is_relative_to(staging):
            error.place = replace(error.place, file=output / file.relative_to(staging))
        raise


def _keep_package(earlier: Path, now: Path) -> None:
    """Hands an earlier package on, because the generator keeps the modeller's own part of it."""
    if earlier.is_dir():
        shutil.copytree(earlier, now, symlinks=True)
