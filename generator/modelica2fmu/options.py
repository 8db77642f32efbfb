"""What can be chosen about a build."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from modelica2fmu.packaging import FmiVersion, SolverOptions
from modelica2fmu.packaging.platforms import LINUX64
from modelica2fmu.scene.outputs import OutputGroup


@dataclass(frozen=True)
class BuildOptions:
    """What can be chosen about a build.

    Attributes:
        msl: folder of the Modelica Standard Library; ``None`` to look for it.
        fmi: version of the FMI standard.
        platforms: names of the platforms that the FMU holds binaries for (packaging/platforms.py).
        solver: defaults of the co-simulation integrator.
        outputs: what of the scene is an output, so that every tool records it.
        cache: folder where FMUs, and the objects that all of them have, are kept by what they are made from; ``None``
            to build afresh.
    """

    msl: Path | None = None
    fmi: FmiVersion = FmiVersion.FMI2
    platforms: tuple[str, ...] = (LINUX64.name,)
    solver: SolverOptions = field(default_factory=SolverOptions)
    outputs: tuple[OutputGroup, ...] = ()
    cache: Path | None = None
