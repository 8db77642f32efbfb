"""What `cmb effects` and `cmb advise` have in common: their arguments, and a bench that builds FMUs."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from contact_foundation.progress import Progress
from contact_foundation.scratch import scratch_folder

from cmb.build_arguments import add_build_arguments, build_options
from cmb.modelica_sources import find_sources
from cmb.simulation_arguments import add_simulation_arguments

if TYPE_CHECKING:
    from scene_effects.measurement import Bench, BuildFigures


def add_scene_arguments(parser: ArgumentParser) -> None:
    """Adds the arguments that say which scene is looked at and how it is simulated."""
    parser.add_argument(
        "model",
        nargs="?",
        default="ContactMultiBody.Examples.BoxOnIncline",
        metavar="MODEL",
        help="qualified name of a model with a ContactManager (an example of the library if left out)",
    )
    parser.add_argument(
        "--source", type=Path, action="append", default=[], metavar="PATH", help="Modelica file or package folder"
    )
    parser.add_argument("--manager", metavar="NAME", help="the ContactManager, needed where there are several")
    add_simulation_arguments(parser)
    add_build_arguments(parser)


@contextmanager
def effect_bench(arguments: Namespace, progress: Progress) -> Iterator[Bench]:
    """A bench for the scene of the arguments; what it builds lies in a temporary folder.

    Raises:
        CmbError: the model cannot be built or simulated, or has no manager.
    """
    found = find_sources(arguments.model, arguments.source)

    from modelica2fmu.build import build_fmu
    from scene_effects.measurement import Bench, BuildFigures, RunOptions

    chosen = build_options(arguments)

    def build(name: str, further: Sequence[Path], fmu: Path) -> BuildFigures:
        report = build_fmu(name, (*further, *found), fmu, chosen, progress)
        return BuildFigures(
            equations=report.equations,
            states=len(report.states),
            event_indicators=report.event_indicators,
            systems=tuple(block.size for block in report.simulation_blocks),
            lines=report.operations,
        )

    options = RunOptions(arguments.stop, arguments.tolerance, arguments.interval, arguments.time_limit)
    with scratch_folder("effects") as folder:
        yield Bench(arguments.model, build, folder, arguments.manager, options, progress)
