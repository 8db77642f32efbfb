"""How build and simulation of FMUs grow with the size of the model: chains of pendulums and bodies on a floor.

    make bench-fmu                                   all sizes; prints the table of docs/fmu-builder.md
    python regression/bench/fmu_size.py chain 1 2 4  these sizes of one kind

A chain has one degree of freedom a pendulum, all coupled; the bodies are free, each touches the floor.
"""

from __future__ import annotations

import math
import resource
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from contact_data import checkout, core_subset
from fmpy import extract, simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu

PROJECT: Final = checkout()
SIZES: Final = (1, 2, 4, 8, 16, 32, 64)
TOLERANCE: Final = 1e-6


@dataclass(frozen=True)
class Measurement:
    """What one model took.

    Attributes:
        size: number of pendulums or bodies.
        states: number of states.
        translate_seconds: CPU time from Modelica to C.
        compile_seconds: CPU time from C to the FMU.
        lines: of C that one evaluation executes.
        library_bytes: of the shared library.
        seconds_per_second: CPU time of one simulated second.
        steps: of the integrator in it.
    """

    size: int
    states: int
    translate_seconds: float
    compile_seconds: float
    lines: int
    library_bytes: int
    seconds_per_second: float
    steps: int


def chain(count: int) -> str:
    """Pendulums that hang on each other, released from the horizontal."""
    parts = ["  inner Modelica.Mechanics.MultiBody.World world(n={0,-1,0}, enableAnimation=false);"]
    connections = []
    before = "world.frame_b"
    for number in range(1, count + 1):
        parts.append(
            f"  Modelica.Mechanics.MultiBody.Joints.Revolute joint{number}(n={{0,0,1}}, phi(fixed=true),"
            " w(fixed=true));\n"
            f"  Modelica.Mechanics.MultiBody.Parts.BodyShape rod{number}(r={{0.2,0,0}}, r_CM={{0.1,0,0}}, m=0.5,"
            " I_11=1e-4, I_22=2e-3, I_33=2e-3, animation=false);"
        )
        connections.append(
            f"  connect({before}, joint{number}.frame_a);\n  connect(joint{number}.frame_b, rod{number}.frame_a);"
        )
        before = f"rod{number}.frame_b"
    return _model("Chain", parts, connections)


def bodies(count: int) -> str:
    """Balls that roll on a floor."""
    parts = ["  inner Modelica.Mechanics.MultiBody.World world(n={0,0,-1}, enableAnimation=false);"]
    connections = []
    names = [f"ball{number}" for number in range(1, count + 1)]
    for number, name in enumerate(names, start=1):
        parts.append(
            f"  ContactMultiBody.Parts.Body {name}(m=1, r_CM={{0,0,0}}, I_11=0.004, I_22=0.004, I_33=0.004,"
            f" geometry=ContactMultiBody.Shapes.sphere(0.1), r_0(start={{{number},0,0.1}}, each fixed=true),"
            " v_0(start={0,1,0}, each fixed=true), angles_fixed=true, w_0_fixed=true, sphereDiameter=0.2);"
        )
        connections.append(f"  connect({name}.frame_a, contacts.frame[{number}]);")
    everything = [*names, "floor"]
    parts.append("  ContactMultiBody.Parts.Ground floor;")
    parts.append(
        f"  ContactMultiBody.ContactManager contacts(n={count + 1},"
        f" geometry={{{','.join(f'{name}.geometry' for name in everything)}}},"
        f" material={{{','.join(f'{name}.material' for name in everything)}}},"
        f" pairs={{{','.join(f'{{{number},{count + 1}}}' for number in range(1, count + 1))}}}, pointCapacity=1,"
        f" stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, stiffness=fill(1e5, {count}));"
    )
    connections.append(f"  connect(floor.frame_a, contacts.frame[{count + 1}]);")
    return _model("Bodies", parts, connections)


def _model(name: str, parts: Sequence[str], connections: Sequence[str]) -> str:
    return "\n".join([f"model {name}", *parts, "equation", *connections, f"end {name};", ""])


KINDS: Final = {"chain": chain, "bodies": bodies}


def measure(kind: str, size: int, folder: Path) -> Measurement:
    """Builds and simulates one model."""
    text = KINDS[kind](size)
    name = text.split()[1]
    source = folder / f"{name}.mo"
    source.write_text(text, encoding="utf-8")
    options = BuildOptions(msl=core_subset())
    begin, children = time.process_time(), _children_time()
    report = build_fmu(name, [source, PROJECT / "ContactMultiBody"], folder / "model.fmu", options)
    translating, compiling = time.process_time() - begin, _children_time() - children
    directory = Path(extract(str(report.fmu), unzipdir=str(folder / f"{name}-{size}")))
    library = next((directory / "binaries").rglob(f"{name}.so"))
    begin = time.process_time()
    result = simulate_fmu(
        str(directory), fmi_type="CoSimulation", stop_time=1.0, relative_tolerance=TOLERANCE, output_interval=0.1,
        output=["cmbSolver.steps"],
    )  # fmt: skip
    return Measurement(
        size=size,
        states=len(report.states),
        translate_seconds=translating,
        compile_seconds=compiling,
        lines=report.operations,
        library_bytes=library.stat().st_size,
        seconds_per_second=time.process_time() - begin,
        steps=int(result["cmbSolver.steps"][-1]),
    )


def _children_time() -> float:
    """CPU time of the compilers and linkers up to now."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def row(kind: str, item: Measurement, before: Measurement | None) -> str:
    """A line of the table, with the exponents of growth since the line before."""

    def growth(now: float, then: float | None) -> str:
        if before is None or not then:
            return ""
        return f" ({math.log(now / then) / math.log(item.size / before.size):.1f})"

    then = before
    return (
        f"| {kind} | {item.size} | {item.states}"
        f" | {item.translate_seconds:.1f}{growth(item.translate_seconds, then and then.translate_seconds)}"
        f" | {item.compile_seconds:.1f}{growth(item.compile_seconds, then and then.compile_seconds)}"
        f" | {item.lines}{growth(item.lines, then and then.lines)}"
        f" | {item.library_bytes / 1e6:.2f}"
        f" | {item.seconds_per_second:.3f}{growth(item.seconds_per_second, then and then.seconds_per_second)}"
        f" | {item.steps} |"
    )


def main(arguments: Sequence[str]) -> int:
    """The command; see the module's text."""
    unknown = [item for item in arguments if item not in KINDS and not item.isdigit()]
    if unknown:
        sys.stdout.write(str(__doc__))
        return 0 if unknown[0] in ("-h", "--help") else 2
    kinds = [name for name in arguments if name in KINDS] or list(KINDS)
    sizes = [int(item) for item in arguments if item.isdigit()] or list(SIZES)
    sys.stdout.write(
        "| model | size | states | to C, s | compile, s | lines an evaluation | library, MB | CPU s a second"
        " | steps |\n|---|---|---|---|---|---|---|---|---|\n"
    )
    for kind in kinds:
        before = None
        for size in sizes:
            with tempfile.TemporaryDirectory() as folder:
                item = measure(kind, size, Path(folder))
            sys.stdout.write(row(kind, item, before) + "\n")
            sys.stdout.flush()
            before = item
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
