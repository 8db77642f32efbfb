"""What a build needs from outside the project: SUNDIALS and the FMI headers."""

from __future__ import annotations

import os
from dataclasses import dataclass
from importlib import util
from pathlib import Path

from contact_data import dependencies
from contact_foundation.errors import BuildError

from modelica2fmu.packaging.platforms import LINUX64, Platform

_ENVIRONMENT = "CMB_SUNDIALS"
_ARCHIVE = "libsundials_cvode.a"  # Debian's has vectors, matrices and dense solver inside


@dataclass(frozen=True)
class Sundials:
    """An installation of SUNDIALS.

    Attributes:
        include: folder with ``cvode/cvode.h``.
        archive: the static library of CVODE.
        licence: its licence text, if it came along.
    """

    include: Path
    archive: Path
    licence: Path | None


def find_sundials(platform: Platform = LINUX64) -> Sundials:
    """Finds CVODE: ``CMB_SUNDIALS``, what scripts/setup made, the system.

    For other platforms than this one the environment variable's name ends in the platform's (``CMB_SUNDIALS_WIN64``).

    Raises:
        BuildError: none of them has it.
    """
    made = dependencies()
    if platform.is_host:
        variable, setup, others = _ENVIRONMENT, "scripts/setup", [made / "sundials" / "usr", Path("/usr")]
    else:
        variable = f"{_ENVIRONMENT}_{platform.name.upper().replace('-', '_')}"
        setup, others = "scripts/setup cross", [made / "cross" / platform.name]
    named = os.environ.get(variable)
    prefixes = [Path(named)] if named else others
    for prefix in prefixes:
        include = prefix / "include"
        if not (include / "cvode" / "cvode.h").is_file():
            continue
        for archive in (*sorted(prefix.glob(f"lib/*/{_ARCHIVE}")), prefix / "lib" / _ARCHIVE):
            if archive.is_file():
                licence = prefix / "share" / "doc" / "libsundials-dev" / "copyright"
                return Sundials(include, archive, licence if licence.is_file() else None)
    raise BuildError(
        f"SUNDIALS (CVODE) for {platform.name} is not installed; looked in {', '.join(map(str, prefixes))}",
        remedy=f"Run {setup}, or point {variable} at an installation of SUNDIALS 6 with static libraries.",
    )


def find_fmi_headers() -> Path:
    """The folder with the FMI 2.0 and 3.0 headers, which FMPy brings along.

    Raises:
        BuildError: FMPy is not installed or has no headers.
    """
    specification = util.find_spec("fmpy")
    for location in (specification.submodule_search_locations or ()) if specification is not None else ():
        headers = Path(location) / "c-code"
        if (headers / "fmi2Functions.h").is_file() and (headers / "fmi3Functions.h").is_file():
            return headers
    raise BuildError("the FMI headers of FMPy are not installed", remedy="Install FMPy: pip install fmpy")
