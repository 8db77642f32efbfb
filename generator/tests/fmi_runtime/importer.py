"""A small importer over FMPy's bindings that keeps what the FMU logs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fmpy import extract, read_model_description
from fmpy.fmi2 import (
    FMU2Model,
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2StepFinishedTYPE,
)

OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3


class Importer:
    """One FMU, unpacked, of which instances can be made."""

    def __init__(self, fmu: Path, folder: Path) -> None:
        self.folder = folder
        extract(str(fmu), str(folder))
        self.description = read_model_description(str(folder))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.messages: list[tuple[int, str, str]] = []
        self._logger = fmi2CallbackLoggerTYPE(self._log)
        self._callbacks = fmi2CallbackFunctions()
        self._callbacks.logger = self._logger
        self._callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE()
        self._callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE()
        self._callbacks.stepFinished = fmi2StepFinishedTYPE()

    def _log(self, _env: Any, _name: bytes, status: int, category: bytes, message: bytes, *_: Any) -> None:
        self.messages.append((status, category.decode(), message.decode()))

    def make(self, kind: type[FMU2Model] | type[FMU2Slave], name: str = "instance", logging: bool = False) -> Any:
        co_simulation = kind is FMU2Slave
        part = self.description.coSimulation if co_simulation else self.description.modelExchange
        instance = kind(
            guid=self.description.guid,
            modelIdentifier=part.modelIdentifier,
            unzipDirectory=str(self.folder),
            instanceName=name,
        )
        instance.instantiate(callbacks=self._callbacks, loggingOn=logging)
        return instance

    def errors(self) -> list[str]:
        """Messages with status error."""
        return [message for status, _, message in self.messages if status == ERROR]

    def reals(self, instance: Any, *names: str) -> list[float]:
        """Values of Real variables."""
        return list(instance.getReal([self.references[name] for name in names]))

    def set_real(self, instance: Any, name: str, value: float) -> None:
        instance.setReal([self.references[name]], [value])

    def initialize(self, instance: Any, *, start: float = 0.0, tolerance: float | None = None, **reals: float) -> None:
        """Set-up and initialization; ``reals`` are set before it."""
        instance.setupExperiment(startTime=start, tolerance=tolerance)
        for name, value in reals.items():
            self.set_real(instance, name, value)
        instance.enterInitializationMode()
        instance.exitInitializationMode()
