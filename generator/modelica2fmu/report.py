"""What was built, and how: the readable log of a build."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from modelica2fmu.library.standard_library import StandardLibrary


@dataclass(frozen=True)
class SolvedBlock:
    """A block that is solved numerically: its unknowns before and after tearing."""

    kind: str
    size: int
    torn: tuple[str, ...]


@dataclass(frozen=True)
class BuildReport:
    """What was built, and how.

    Attributes:
        fmu: the file.
        model: full Modelica name.
        fmi: version of the FMI standard.
        library: the Standard Library that was used.
        states: chosen states, in order.
        derivatives: their derivatives.
        equations: scalar equations of the flat model.
        equations_left: those left without trivial ones.
        differentiations: differentiations of the index reduction.
        simulation_blocks: numerically solved blocks while simulating.
        initialization_blocks: the same at initialization.
        event_indicators: number of relations that generate events.
        operations: lines of C of one evaluation of the derivatives.
        warnings: assumptions the user should know of.
        timings: seconds by phase, of the build that made the FMU.
        files: geometry and tables that the model names by file, and that the FMU holds.
        cached: = true, if the FMU was taken from the cache.
    """

    fmu: Path
    model: str
    fmi: str
    library: StandardLibrary
    states: tuple[str, ...]
    derivatives: tuple[str, ...]
    equations: int
    equations_left: int
    differentiations: int
    simulation_blocks: tuple[SolvedBlock, ...]
    initialization_blocks: tuple[SolvedBlock, ...]
    event_indicators: int
    operations: int
    warnings: tuple[str, ...]
    timings: tuple[tuple[str, float], ...]
    files: tuple[Path, ...] = ()
    cached: bool = False

    def summary(self) -> str:
        """The build in one line."""
        origin = " (from the cache)" if self.cached else ""
        return f"{self.fmu}: {len(self.states)} states, {self.event_indicators} event indicators{origin}"

    def text(self) -> str:
        """The report as readable lines."""
        lines = [
            f"model               {self.model}",
            f"FMI                 {self.fmi}, model exchange and co-simulation",
            f"standard library    {self.library.version or 'unknown version'} ({self.library.origin}, "
            f"{self.library.folder})",
            f"scalar equations    {self.equations}, without trivial ones {self.equations_left}",
            f"index reduction     {self.differentiations} differentiations",
            f"states              {len(self.states)}: {', '.join(self.states)}",
            f"event indicators    {self.event_indicators}",
            f"generated code      {self.operations} lines an evaluation",
        ]
        for title, blocks in (
            ("solved blocks", self.simulation_blocks),
            ("at initialization", self.initialization_blocks),
        ):
            lines.append(f"{title:<19} {len(blocks)}")
            for block in blocks:
                names = ", ".join(block.torn[:4]) + (", ..." if len(block.torn) > 4 else "")
                lines.append(f"  {block.kind:<9} {block.size:4d} unknowns, torn to {len(block.torn):2d}: {names}")
        lines.extend(f"warning: {warning}" for warning in self.warnings)
        total = sum(value for _, value in self.timings)
        phases = ", ".join(f"{name} {value:.2f}" for name, value in self.timings)
        lines.append(f"seconds             {total:.2f}: {phases}" + (" (taken from the cache)" if self.cached else ""))
        return "\n".join(lines)

    def as_json(self) -> dict[str, Any]:
        """All but the files, as values that JSON knows."""
        values = asdict(self)
        del values["fmu"], values["cached"], values["files"]
        values["library"]["folder"] = str(self.library.folder)
        return values

    @classmethod
    def from_json(cls, values: dict[str, Any], fmu: Path) -> BuildReport:
        """The report of an FMU that was taken from the cache.

        Raises:
            KeyError, TypeError, ValueError: the values are not those of ``as_json``.
        """

        def blocks(name: str) -> tuple[SolvedBlock, ...]:
            return tuple(SolvedBlock(b["kind"], int(b["size"]), tuple(b["torn"])) for b in values[name])

        library = values["library"]
        return cls(
            **{
                **values,
                "fmu": fmu,
                "library": StandardLibrary(Path(library["folder"]), library["version"], library["origin"]),
                "states": tuple(values["states"]),
                "derivatives": tuple(values["derivatives"]),
                "simulation_blocks": blocks("simulation_blocks"),
                "initialization_blocks": blocks("initialization_blocks"),
                "warnings": tuple(values["warnings"]),
                "timings": tuple((name, float(seconds)) for name, seconds in values["timings"]),
                "cached": True,
            }
        )
