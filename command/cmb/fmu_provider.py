"""FMUs for regression cases, built on demand."""

from __future__ import annotations

import hashlib
from pathlib import Path

from contact_data import modelica_library
from contact_foundation.progress import Progress
from fmu_regression.cases.case import Case
from fmu_regression.cases.runner import Skip
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.library.standard_library import CORE_SUBSET, find_standard_library


class FmuProvider:
    """Builds the FMU of a case's model, each model once; picklable if its progress is.

    Args:
        folder: where the FMUs go.
        options: of the builds.
        progress: told about the builds.
    """

    def __init__(self, folder: Path, options: BuildOptions, progress: Progress) -> None:
        self._folder = folder
        self._options = options
        self._progress = progress
        self._built: dict[tuple[str, Path], Path] = {}

    def __call__(self, case: Case) -> Path | Skip:
        """The FMU of a case, or why it cannot be had here."""
        if case.fmu is not None:
            return case.fmu
        if "msl" in case.requires and find_standard_library(self._options.msl).origin == CORE_SUBSET:
            return Skip("needs the whole Modelica Standard Library; name it with --msl or MODELICAPATH")
        assert case.package is not None, "a case without an FMU names a package"
        key = (case.model, case.package)
        if key not in self._built:
            mark = hashlib.sha256(str(case.package).encode()).hexdigest()[:8]
            output = self._folder / f"{case.model}-{mark}.fmu"
            sources = tuple(dict.fromkeys([case.package, *case.sources, modelica_library()]))
            build_fmu(case.model, sources, output, self._options, self._progress)
            self._built[key] = output
        return self._built[key]
