"""What every command that builds FMUs lets its user choose."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from contact_foundation.cache import user_cache

if TYPE_CHECKING:
    from modelica2fmu.build import BuildOptions
    from modelica2fmu.packaging import FmiVersion, SolverOptions


def add_build_arguments(parser: ArgumentParser) -> None:
    """Adds the version of the standard, the Standard Library and the cache."""
    parser.add_argument(
        "--fmi", choices=("2", "3"), default="2", help="version of the FMI standard: 2.0 (if left out) or 3.0"
    )
    parser.add_argument(
        "--outputs",
        metavar="GROUPS",
        help="what of the scene is an output of the FMU, so that every tool records it: poses, speeds, forces, "
        "energies, separated by commas, or all",
    )
    parser.add_argument("--msl", type=Path, metavar="FOLDER", help="folder that holds the Modelica Standard Library")
    parser.add_argument(
        "--no-cache", action="store_true", help="build afresh, and keep nothing for builds of the same files"
    )


def fmi_version(arguments: Namespace) -> FmiVersion:
    """The version of the standard that was asked for."""
    from modelica2fmu.packaging import FmiVersion

    return FmiVersion(f"{arguments.fmi}.0")


def build_options(arguments: Namespace, solver: SolverOptions | None = None) -> BuildOptions:
    """The options of a build; FMUs of unchanged files come from the user's cache.

    Args:
        arguments: of a parser that ``add_build_arguments`` saw.
        solver: defaults of the co-simulation integrator.
    """
    from modelica2fmu.build import BuildOptions
    from modelica2fmu.packaging import SolverOptions
    from modelica2fmu.scene.outputs import output_groups

    return BuildOptions(
        msl=arguments.msl,
        fmi=fmi_version(arguments),
        solver=solver or SolverOptions(),
        outputs=output_groups(arguments.outputs) if arguments.outputs is not None else (),
        cache=None if arguments.no_cache else user_cache("fmu"),
    )
