"""What differs between the FMU files of FMI 2.0 and 3.0."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from modelica2fmu.description.icon import model_icon
from modelica2fmu.description.model_description import ModelDescription
from modelica2fmu.packaging.fmi2_description import fmi2_description
from modelica2fmu.packaging.fmi3_description import build_description, fmi3_description, terminals_and_icons
from modelica2fmu.packaging.platforms import Platform
from modelica2fmu.packaging.toolchain import COMPILE_OPTIONS


class FmiVersion(StrEnum):
    """Version of the standard."""

    FMI2 = "2.0"
    FMI3 = "3.0"


@dataclass(frozen=True)
class Layout:
    """Files of one version of the standard.

    Attributes:
        platform: the folder of a platform's binaries.
        prefix: that of the runtime's C files with this version's functions.
        describe: writes modelDescription.xml.
        complete: writes, into the FMU's folder with all its sources, the other files that the version has.
    """

    platform: Callable[[Platform], str]
    prefix: str
    describe: Callable[[ModelDescription], bytes]
    complete: Callable[[ModelDescription, Path], None]


def _complete_fmi2(description: ModelDescription, folder: Path) -> None:
    (folder / "model.png").write_bytes(description.icon or model_icon())


def _complete_fmi3(description: ModelDescription, folder: Path) -> None:
    icons = folder / "terminalsAndIcons"
    icons.mkdir()
    (icons / "icon.png").write_bytes(description.icon or model_icon())
    (icons / "terminalsAndIcons.xml").write_bytes(terminals_and_icons())
    sources = folder / "sources"
    names = sorted(path.name for path in sources.glob("*.c"))
    (sources / "buildDescription.xml").write_bytes(build_description(description, names, COMPILE_OPTIONS))


LAYOUTS = {
    FmiVersion.FMI2: Layout(lambda platform: platform.name, "fmi2_", fmi2_description, _complete_fmi2),
    FmiVersion.FMI3: Layout(lambda platform: platform.fmi3, "fmi3_", fmi3_description, _complete_fmi3),
}
