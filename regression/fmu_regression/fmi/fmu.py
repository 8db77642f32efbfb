"""Opening an FMU (FMI 2.0 or 3.0) through FMPy, and instances of it."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import fmpy
from contact_foundation.errors import NO_ROOM, InputError, Place, SimulationError
from contact_foundation.scratch import scratch_folder
from fmpy.fmi1 import FMICallException

from fmu_regression.fmi.binary_check import require_whole
from fmu_regression.fmi.binding import Binding, Identity, Mode
from fmu_regression.fmi.description import MOST_KINDS, ModelDescription, StartValue, read_description
from fmu_regression.fmi.fmi2_binding import Fmi2Binding
from fmu_regression.fmi.fmi3_binding import Fmi3Binding

_MAX_LOG_LINES = 200
_FOLDERS = re.compile(r"(?<![\w/])/(?:[^\s/:]+/)+(?=[^\s/:])")
_NUMBER = re.compile(r"[-+]?\d[\d.]*(?:[eE][-+]?\d+)?")
# Folders of an FMU that are for reading and compiling (FMI 2.0.4, section 2.3; FMI 3.0.2, section 2.5.1).
_NOT_FOR_RUNNING = ("sources/", "documentation/")
_STATUS_NAMES = ("ok", "warning", "discard", "error", "fatal", "pending")
_DISCARDED = "[discard]"

_BINDINGS: Mapping[str, type[Fmi2Binding] | type[Fmi3Binding]] = {"2.0": Fmi2Binding, "3.0": Fmi3Binding}


class Instance:
    """An instance of an FMU: its functions with the messages that it logged.

    Attributes:
        functions: the FMI functions of the instance.
        description: the FMU's description.
        messages: logged lines, "[status] category: text".
    """

    def __init__(self, functions: Binding, description: ModelDescription, messages: list[str]) -> None:
        self.functions = functions
        self.description = description
        self.messages = messages

    def told(self) -> list[str]:
        """What the FMU logged: the last messages of each kind, those that differ in numbers alone as one."""
        return _told_once(self.messages)

    def failure(self, what: str, cause: BaseException | None = None) -> SimulationError:
        """A SimulationError that carries what the FMU logged last."""
        text = what
        if isinstance(cause, FMICallException):
            text = f"{what}: {cause.function} returned {_status_name(cause.status)}"
        elif cause is not None:
            text = f"{what}: {cause}"
        lines = self.told()
        if lines:
            text += "\n" + "\n".join(f"  {line}" for line in lines)
        return SimulationError(text, place=Place(component=self.description.name))

    def forget_discards(self) -> None:
        """Forgets what was told of points that could not be evaluated and that a shorter step has avoided."""
        self.messages[:] = [message for message in self.messages if not message.startswith(_DISCARDED)]

    def set_start_values(self, values: Mapping[str, StartValue]) -> None:
        """Sets start values; names and types must have been checked by ``check_start_values``."""
        for name, value in values.items():
            variable = self.description.variables[name]
            self.functions.set(variable.data_type, variable.reference, value)


@dataclass(frozen=True)
class Fmu:
    """An unpacked FMU.

    Attributes:
        path: the FMU file.
        folder: where it lies unpacked; removed when the context that opened it ends.
        description: its description.
    """

    path: Path
    folder: Path
    description: ModelDescription = field(repr=False)

    def _binary(self, identifier: str) -> Path:
        return self.folder / "binaries" / _platform(self.description) / f"{identifier}{fmpy.sharedLibraryExtension}"

    @contextmanager
    def instantiate(self, mode: Mode, *, logging: bool = False) -> Iterator[Instance]:
        """Yields a fresh instance, freed afterwards.

        Args:
            mode: model exchange or co-simulation.
            logging: whether the FMU's debug messages are wanted too.

        Raises:
            InputError: the FMU does not offer the mode, or its binary is damaged, cannot be loaded or refuses to be
                instantiated.
        """
        description = self.description
        if mode not in description.identifiers:
            offered = ", ".join(sorted(description.identifiers)) or "nothing"
            raise InputError(f"the FMU offers {offered}, not {mode}", place=Place(file=self.path))
        messages: list[str] = []
        identity = Identity(self.folder, description.name, description.guid, description.identifiers[mode])
        working_folder = os.getcwd()
        require_whole(self._binary(identity.model_identifier), self.path)
        try:
            functions: Binding = _BINDINGS[description.fmi](identity, mode)
        except Exception as error:
            os.chdir(working_folder)  # FMPy loads in the binary's folder, and stays there where that fails
            said = _FOLDERS.sub("", " ".join(str(error).split()))
            raise InputError(f"cannot load the FMU's binary: {said}", place=Place(file=self.path)) from error
        instance = Instance(functions, description, messages)

        def log(status: int, category: str, text: str) -> None:
            if len(messages) >= _MAX_LOG_LINES:
                del messages[: _MAX_LOG_LINES // 2]
            kind = f" {category}:" if category else ""
            messages.append(f"[{_status_name(status)}]{kind} {text.rstrip()}")

        try:
            functions.instantiate(log, logging)
        except Exception as error:
            functions.unload()
            refusal = instance.failure("the FMU cannot be instantiated", error)
            raise InputError(refusal.message, place=Place(file=self.path)) from error
        try:
            yield instance
        finally:
            functions.free()


def _is_for_running(name: str) -> bool:
    """Whether a file of an FMU can matter to its binary."""
    return not name.startswith(_NOT_FOR_RUNNING)


def _platform(description: ModelDescription) -> str:
    """Name of this machine's folder of binaries."""
    return str(fmpy.platform if description.fmi == "2.0" else fmpy.platform_tuple)


def _told_once(messages: Sequence[str]) -> list[str]:
    """The last messages of each kind, those that differ in numbers alone as one, without folders of the builder."""
    kinds: dict[str, list[str]] = {}
    for message in messages:
        line = _FOLDERS.sub("", " ".join(message.split()))
        kinds.setdefault(_NUMBER.sub("#", line), []).append(line)
    return [
        lines[-1] + (f" (and {len(lines) - 1} more of this kind)" if len(lines) > 1 else "")
        for lines in list(kinds.values())[-MOST_KINDS:]
    ]


@contextmanager
def open_fmu(path: Path) -> Iterator[Fmu]:
    """Unpacks an FMU into a temporary folder and reads its description.

    Raises:
        InputError: the file is missing, no FMU, neither FMI 2.0 nor 3.0, or has no binary for this platform.
    """
    if not path.is_file():
        said = "is a folder, not an FMU" if path.is_dir() else "there is no such file"
        raise InputError(said, place=Place(file=path))
    description = read_description(path)
    with scratch_folder("unpacked") as folder:
        try:
            fmpy.extract(str(path), str(folder), _is_for_running)
        except Exception as error:
            if isinstance(error, OSError) and error.errno in NO_ROOM:
                raise
            raise InputError(f"the FMU cannot be unpacked: {error}", place=Place(file=path)) from error
        platform = _platform(description)
        if not (folder / "binaries" / platform).is_dir():
            raise InputError(f"the FMU has no binary for {platform}", place=Place(file=path))
        yield Fmu(path=path, folder=folder, description=description)


def _status_name(status: int) -> str:
    return _STATUS_NAMES[status] if 0 <= status < len(_STATUS_NAMES) else f"status {status}"
