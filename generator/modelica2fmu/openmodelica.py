"""FMUs by OpenModelica instead of the built-in translator."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import time
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_foundation.errors import BuildError, CmbError, InputError, Place
from contact_foundation.output import whole_file
from contact_foundation.progress import Progress, silent
from contact_foundation.scratch import scratch_folder

from modelica2fmu.library.sources import locate
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.packaging import FmiVersion
from modelica2fmu.translation import check_model_name

_HOME: Final = "OPENMODELICAHOME"
_SCRIPT: Final = "build.mos"
_RESULT: Final = "exported"
_TIMEOUT: Final = 1800.0
_MESSAGE: Final = re.compile(
    r"^\"?\[(?P<file>[^\]\n]+?):(?P<line>\d+):\d+-\d+:\d+:\w+\] Error: (?P<text>.+)$", re.MULTILINE
)
_PLAIN_MESSAGE: Final = re.compile(r"^\s*\"?Error: (?P<text>.+)$", re.MULTILINE)


@dataclass(frozen=True)
class OpenModelicaReport:
    """What OpenModelica built.

    Attributes:
        fmu: the file.
        model: full Modelica name.
        version: OpenModelica's version.
        seconds: the build took.
        warnings: that it gave.
    """

    fmu: Path
    model: str
    version: str
    seconds: float
    warnings: tuple[str, ...]

    def summary(self) -> str:
        """The export in one line."""
        return f"{self.fmu}: by {self.version}"

    def text(self) -> str:
        """The report as readable lines."""
        lines = [f"model               {self.model}", f"tool                {self.version}"]
        lines.extend(f"warning: {warning}" for warning in self.warnings)
        lines.append(f"seconds             {self.seconds:.2f}")
        return "\n".join(lines)


def find_compiler(environment: Mapping[str, str] = os.environ) -> Path:
    """OpenModelica's compiler: that of OPENMODELICAHOME, else ``omc`` on PATH.

    Raises:
        BuildError: it is not installed.
    """
    home = environment.get(_HOME)
    found = shutil.which("omc", path=str(Path(home) / "bin") if home else environment.get("PATH"))
    if found is None:
        where = f"in {Path(home) / 'bin'} ({_HOME})" if home else "on PATH"
        raise BuildError(
            f"OpenModelica's compiler omc is not {where}",
            remedy=f"Install OpenModelica, point {_HOME} at it, or use the built-in translator: --tool builtin.",
        )
    return Path(found)


def export_fmu(
    model: str,
    sources: Sequence[Path],
    output: Path,
    library: StandardLibrary,
    version: FmiVersion = FmiVersion.FMI2,
    *,
    timeout: float = _TIMEOUT,
    progress: Progress = silent,
) -> OpenModelicaReport:
    """Builds an FMU by OpenModelica, with CVODE as the solver of co-simulation.

    Args:
        model: full Modelica name.
        sources: Modelica files, or folders of packages; one holds the model, the others what it uses.
        output: the FMU to write; an existing file stays as it is if anything fails.
        library: the Standard Library.
        version: of the FMI standard.
        timeout: seconds after which OpenModelica is ended.
        progress: told about the phase.

    Raises:
        InputError: the model is wrong: OpenModelica names a place in the sources, or a source is missing.
        BuildError: OpenModelica is not installed, fails or does not end.
    """
    check_model_name(model)
    program = find_compiler()
    file, _ = locate(model, sources)
    script = _script(model, _packages(file, sources, library), version)
    progress("OpenModelica", 0.0)
    began = time.perf_counter()
    with scratch_folder("omc") as folder:
        (folder / _SCRIPT).write_text(script, encoding="utf-8")
        tool = _run(program, ["--version"], folder, 60.0).strip()
        said = _run(program, [_SCRIPT], folder, timeout)
        exported = folder / f"{_RESULT}.fmu"
        if not _is_fmu(exported):
            raise _failure(model, said)
        with whole_file(output) as staging:
            shutil.copyfile(exported, staging)
    progress("OpenModelica", 1.0)
    warnings = tuple(dict.fromkeys(re.findall(r"Warning: (.+)", said)))
    return OpenModelicaReport(output, model, tool, time.perf_counter() - began, warnings)


def _packages(file: Path, sources: Sequence[Path], library: StandardLibrary) -> list[Path]:
    """The files to load: the Standard Library, then what the model uses, then the model's own."""
    found = [path / "package.mo" if path.is_dir() else path for path in reversed(library.parts().values())]
    for source in sources:
        found.append(source / "package.mo" if (source / "package.mo").is_file() else source)
    loaded = [path.resolve() for path in found if path.is_file()]
    return [path for path in dict.fromkeys(loaded) if path != file] + [file]


def _text(value: str) -> str:
    """A Modelica string literal."""
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _script(model: str, files: Sequence[Path], version: FmiVersion) -> str:
    loads = "".join(f"loadFile({_text(str(path))}, uses = false);\ngetErrorString();\n" for path in files)
    return (
        'setCommandLineOptions("--fmiFlags=s:cvode");\n'
        f"{loads}"
        f'buildModelFMU({model}, version = "{version.value}", fmuType = "me_cs", fileNamePrefix = "{_RESULT}", '
        'platforms = {"static"}, includeResources = true);\n'
        "getErrorString();\n"
    )


def _run(program: Path, words: Sequence[str], folder: Path, timeout: float) -> str:
    """What OpenModelica prints; its status says little, so the caller looks at what it wrote."""
    try:
        done = subprocess.run(
            [str(program), *words],
            cwd=folder,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=timeout,
            check=False,
            env={**os.environ, "LC_ALL": "C.UTF-8"},
        )
    except OSError as error:
        raise BuildError(f"{program} cannot be started: {error.strerror}") from error
    except subprocess.TimeoutExpired as error:
        raise BuildError(f"OpenModelica did not end within {timeout:g} s") from error
    return done.stdout + done.stderr


def _is_fmu(path: Path) -> bool:
    try:
        with zipfile.ZipFile(path) as archive:
            return "modelDescription.xml" in archive.namelist()
    except (OSError, zipfile.BadZipFile):
        return False


def _failure(model: str, said: str) -> CmbError:
    located = _MESSAGE.search(said)
    if located is not None:
        place = Place(file=Path(located["file"]), line=int(located["line"]), component=model)
        cause = located["text"].rstrip('"')
        return InputError(f"OpenModelica: {cause}", place=place)
    plain = _PLAIN_MESSAGE.search(said)
    lines = [line for line in said.splitlines() if line.strip() and line.strip() != '""']
    cause = plain["text"].rstrip('"') if plain is not None else "\n  ".join(lines[-5:]) or "it said nothing"
    return BuildError(f"OpenModelica wrote no FMU: {cause}", place=Place(component=model))
