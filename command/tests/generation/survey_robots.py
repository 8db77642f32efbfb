"""Takes robot descriptions the whole road, from the file to a second of motion, and tells what came of each.

Use ``python command/tests/generation/survey_robots.py PATH [PATH ...] [--seconds 60] [--stop 1] [--generate]
[--without NAME] [--package-path FOLDER] [--allow-missing] [--density KG/M3] [--decomposer vhacd] [--rows]
[--record FILE] [--advised]``. Paths are files, or folders whose URDF, MJCF and SDFormat descriptions are taken.
A Markdown table goes to the standard output (with ``--rows`` a row a robot too), every file with its outcome and what
is doubtful to the standard error. With ``--record`` outcomes are kept in a file of JSON lines: what is in it is not
tried again, and the table is of all in it, so that a survey can be made in pieces. With ``--advised`` a robot that is
refused is tried again with the options that the message names, as a user would, and the table says which.

Every robot has a process of its own, which is stopped when it, or a compiler that it starts, has used ``--seconds`` of
the processor. Times are of the processor, all processes together, so that other load does not count.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from advised_options import advised_options
from cad2modelica import Decomposer, GenerateOptions, SourceChoices, generate
from cad2modelica.generation import GeneratedPackage
from contact_data import modelica_library
from contact_foundation.errors import CmbError
from fmu_regression.fmi.description import read_description
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.energy import energy_balance
from fmu_regression.scene.scene_file import Scene, load_scene
from fmu_regression.scene.signals import pair_signal, position_names, rotation_names, signals_for
from fmu_regression.simulate.simulation import simulate
from modelica2fmu.build import BuildOptions, build_fmu

REFUSED = 2
WALL = 20  # times the limit of processor time: what waits for ever is stopped then
FORMATS = {"urdf": "robot", "xml": "mujoco", "sdf": "sdf"}
"""Root elements of descriptions by the endings of their files, in lower case."""
LINKS = re.compile(rb"<(?:link|body)\s")
PHASES = ("refused", "generated", "built", "ran")
"""How far a robot came. One that is not refused and did not run was stopped, or failed, in the phase after."""
START = 0.01  # s, in which nothing but an overlap can throw bodies apart
THROWN = 50.0  # force in that time, by the weight of all that moves
GAINED = 0.05  # energy gained in the run, by what the masses would have after a fall of its length


@dataclass(frozen=True)
class Outcome:
    """Of one robot.

    Attributes:
        file: the description.
        phase: how far it came, one of ``PHASES``; "" if it was not even refused.
        error: what stopped it, in one line; empty if it ran.
        options: those that messages advised.
        facts: what was counted and measured on the way, by name.
        doubts: what is suspicious though nothing failed.
    """

    file: Path
    phase: str
    error: str
    facts: dict[str, Any] = field(default_factory=dict)
    doubts: tuple[str, ...] = ()
    options: tuple[str, ...] = ()


def descriptions(paths: list[Path], without: str) -> list[Path]:
    """Files of robot descriptions with the root element of their format, except those below folders of a name."""
    return [file for path in paths for file in ([path] if path.is_file() else _below(path, without))]


def _below(folder: Path, without: str) -> Iterator[Path]:
    for file in sorted(folder.rglob("*")):
        root = FORMATS.get(file.suffix[1:].lower())
        if root is None or without in file.relative_to(folder).parts or not file.is_file():
            continue
        if re.search(rf"<{root}[\s>]".encode(), file.read_bytes()):
            yield file


def outcome(file: Path, options: list[str], seconds: float, *, advised: bool) -> Outcome:
    """Takes one robot as far as it goes; with ``advised`` as far as the options go that refusals name."""
    added: list[str] = []
    while True:
        found, refusal = attempt(file, options + added, seconds)
        more = advised_options(refusal, file, options + added) if advised and found.phase == "refused" else []
        if not more:
            return replace(found, options=tuple(added))
        added += more


def attempt(file: Path, options: list[str], seconds: float) -> tuple[Outcome, str]:
    """Takes one robot as far as it goes, in a process of its own; also tells all lines of what it was refused for."""
    with tempfile.TemporaryDirectory(prefix="cmb-survey-") as folder, (Path(folder) / "log").open("w+") as log:
        command = [sys.executable, __file__, str(file), "--into", str(Path(folder) / "out"), *options]
        process = subprocess.Popen(
            ["timeout", f"{WALL * seconds:g}", *command], stdout=subprocess.PIPE, stderr=log, text=True
        )
        told, _ = process.communicate()
        log.seek(0)
        last = (log.read().strip().splitlines() or ["no message"])[-1]
    facts: dict[str, Any] = {}
    for line in told.splitlines():
        facts |= json.loads(line)
    phase, doubts, refusal = facts.pop("phase", ""), tuple(facts.pop("doubts", ())), facts.pop("refusal", "")
    if process.returncode == 0:
        return Outcome(file, phase, "", facts, doubts), refusal
    stopped = process.returncode in (124, -signal.SIGXCPU, 128 + signal.SIGXCPU)
    error = f"stopped after {seconds:g} s" if stopped else last
    refused = process.returncode == REFUSED and not phase
    return Outcome(file, "refused" if refused else phase, error, facts, doubts), refusal


def tell(**facts: Any) -> None:
    """Hands facts to the process that surveys."""
    sys.stdout.write(json.dumps(facts) + "\n")
    sys.stdout.flush()


def used() -> float:
    """Seconds of the processor so far, of this process and the children that ended."""
    return sum(os.times()[:4])


def go(file: Path, arguments: argparse.Namespace) -> int:
    """The whole road of one robot; the first problem goes to the standard error."""
    source = SourceChoices(tuple(arguments.package_path), arguments.allow_missing, arguments.density)
    begin = used()
    try:
        package = generate(
            file, arguments.into / "package", GenerateOptions(decomposer=arguments.decomposer, source=source)
        )
        scene = load_scene(package.scene)
        moving = [body for body in scene.bodies if not body.fixed]
        generated = used()
        tell(phase="generated", generate=generated - begin, bodies=len(moving), joints=len(scene.joints))
        tell(pairs=len(scene.pairs), doubts=doubts_of_package(scene, package))
        if arguments.generate:
            return 0
        fmu = arguments.into / "robot.fmu"
        build_fmu(package.mechatronics, (package.root, modelica_library()), fmu, BuildOptions(cache=arguments.cache))
        tell(phase="built", build=used() - generated)
        description = read_description(fmu)
        built = used()
        result = simulate(fmu, signals=signals_for(scene, description), stop=arguments.stop)
    except CmbError as error:
        tell(refusal=str(error))
        problems = [line for line in str(error).splitlines() if line.startswith("- ")]
        sys.stderr.write(" ".join((problems[0] if problems else str(error)).split()) + "\n")
        return REFUSED
    counters = result.counters
    tell(
        phase="ran",
        run=used() - built,
        evaluations=counters.evaluations if counters else 0,
        events=counters.state_events if counters else 0,
        doubts=doubts_of_package(scene, package) + doubts_of_motion(scene, result),
    )
    return 0


def doubts_of_package(scene: Scene, package: GeneratedPackage) -> list[str]:
    """What a user would not expect of a robot: nothing that moves or touches, geometry left out."""
    found = []
    moving = [body for body in scene.bodies if not body.fixed]
    if not moving:
        found.append("nothing moves")
    if len([body for body in moving if body.meshes]) > 2 and not scene.pairs:
        found.append("nothing can touch")
    bare = [body.label for body in moving if body.mass > 0 and not body.meshes]
    if bare and 2 * len(bare) > len(moving):
        found.append(f"{len(bare)} of {len(moving)} bodies without geometry")
    lost = sum("left out" in note and "contacts" not in note for note in package.notes)
    if lost:
        found.append(f"{lost} notes on what is left out")
    still = sum("it was taken as fixed" in note for note in package.notes)
    if still:
        found.append(f"{still} joints taken as fixed, for they move no mass")
    return found


def doubts_of_motion(scene: Scene, result: SimulationResult) -> list[str]:
    """Whether bodies stand still, are thrown apart at the start, or gain energy."""
    found = []
    moving = [body for body in scene.bodies if not body.fixed]
    poses = [name for body in moving for name in position_names(body) + rotation_names(body)]
    if moving and all(np.ptp(result.signals[name]) < 1e-12 for name in poses):
        found.append("everything stands still")
    early = result.time <= START
    weight = float(np.linalg.norm(scene.gravity)) * sum(body.mass for body in moving)
    forces = [result.signals.get(pair_signal(scene, pair, "normalForce")) for pair in scene.pairs]
    strongest = max((float(np.max(force[early])) for force in forces if force is not None), default=0.0)
    if strongest > THROWN * weight > 0.0:
        found.append(
            f"thrown apart: {strongest:.3g} N in the first {START:g} s, {strongest / weight:.0f} times the weight"
        )
    duration = float(result.time[-1] - result.time[0])
    fall = 0.5 * sum(body.mass for body in moving) * (9.81 * duration) ** 2
    if moving and energy_balance(scene, result).change > GAINED * fall > 0.0:
        found.append("gains energy")
    return found


def row(found: Outcome, common: Path) -> str:
    """A robot as a row of the table."""
    facts = found.facts
    source, _, name = os.path.relpath(found.file, common).partition(os.sep)
    cells = [name or source, source if name else "", str(len(LINKS.findall(found.file.read_bytes())))]
    cells += [str(facts.get(key, "")) for key in ("bodies", "joints", "pairs")]
    cells += [f"{facts['generate'] + facts['build']:.0f}" if "build" in facts else ""]
    cells += [f"{facts['run']:.2g}" if "run" in facts else ""]
    told = _short(found.error) or "; ".join(found.doubts)
    options = "".join(f" {Path(word).name}" for word in found.options)
    given = f" with `{options.strip()}`" if options else ""
    return f"| {' | '.join(cells)} | {found.phase or 'crashed'}{given}{f': {told}' if told else ''} |"


def _short(error: str) -> str:
    """What went wrong without advice and without folders of this machine."""
    said = re.split(r" Copy the file| Name the folder|: no folder of that name", error.removeprefix("- "))[0]
    said = re.sub(r"( in)? /\S*", "", re.sub(r"/\S*/(?=[^/\s]+:\d)", "", said))
    return said.replace("|", "/")


def table(outcomes: list[Outcome], common: Path, *, rows: bool) -> str:
    """How many came how far, with times; with ``rows`` every robot."""
    counts = Counter(found.phase or "crashed" for found in outcomes)
    lines = []
    if rows:
        head = ("robot", "source", "links", "bodies", "joints", "pairs", "built, s", "a second, s", "result")
        lines += [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
        lines += [row(found, common) for found in outcomes] + [""]
    came = {phase: sum(counts[later] for later in PHASES[place:]) for place, phase in enumerate(PHASES) if place}
    lines += [
        "| robots | refused | generated | built | ran | ran in doubt | median / longest to build, s | to run, s |"
    ]
    lines += ["|---|---|---|---|---|---|---|---|"]
    doubted = sum(found.phase == "ran" and bool(found.doubts) for found in outcomes)
    build = [found.facts["generate"] + found.facts["build"] for found in outcomes if "build" in found.facts]
    run = [found.facts["run"] for found in outcomes if "run" in found.facts]
    numbers = [str(count) for count in (len(outcomes), counts["refused"], *came.values(), doubted)]
    return "\n".join([*lines, f"| {' | '.join([*numbers, _middle_and_most(build), _middle_and_most(run)])} |"]) + "\n"


def _middle_and_most(values: list[float]) -> str:
    return f"{np.median(values):.2g} / {max(values):.2g}" if values else ""


def recorded(kept: Path | None) -> list[Outcome]:
    """The outcomes of earlier pieces of a survey."""
    if kept is None or not kept.exists():
        return []
    facts = [json.loads(line) for line in kept.read_text("utf-8").splitlines()]
    tuples = ({key: tuple(fact.get(key, ())) for key in ("doubts", "options")} for fact in facts)
    return [Outcome(**(fact | {"file": Path(fact["file"])} | more)) for fact, more in zip(facts, tuples, strict=True)]


def record(found: Outcome, kept: Path | None) -> None:
    """Keeps an outcome for later pieces."""
    if kept is not None:
        with kept.open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(found) | {"file": str(found.file)}) + "\n")


def words(arguments: argparse.Namespace, cache: Path) -> list[str]:
    """The options that the process of one robot takes over."""
    given = ["--cache", str(cache), "--seconds", str(arguments.seconds), "--stop", str(arguments.stop)]
    given += [word for folder in arguments.package_path for word in ("--package-path", str(folder))]
    given += ["--decomposer", arguments.decomposer.value] if arguments.decomposer is not None else []
    given += ["--density", str(arguments.density)] if arguments.density is not None else []
    return given + [f"--{name}" for name in ("generate", "allow-missing") if getattr(arguments, name.replace("-", "_"))]


def main() -> int:
    """Surveys files and folders, or takes one robot into a folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paths", type=Path, nargs="*")
    parser.add_argument("--into", type=Path, help="take the single file into this folder")
    parser.add_argument("--cache", type=Path, help="folder of the builder's cache; an empty one if left out")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--stop", type=float, default=1.0)
    parser.add_argument("--generate", action="store_true", help="generate only")
    parser.add_argument("--without", default="", help="name of folders that are left out")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--rows", action="store_true")
    parser.add_argument("--record", type=Path, help="keep outcomes in this file, and go on with what it has")
    parser.add_argument("--decomposer", type=Decomposer, choices=list(Decomposer))
    parser.add_argument("--package-path", type=Path, action="append", default=[])
    parser.add_argument("--advised", action="store_true", help="add the options that refusals name")
    parser.add_argument("--allow-missing", action="store_true")
    parser.add_argument("--density", type=float)
    arguments = parser.parse_args()
    if arguments.into is not None:
        resource.setrlimit(resource.RLIMIT_CPU, (int(arguments.seconds), resource.RLIM_INFINITY))
        return go(arguments.paths[0], arguments)
    outcomes = recorded(arguments.record)
    done = {found.file for found in outcomes}
    files = [file for file in descriptions(arguments.paths, arguments.without) if file.absolute() not in done]
    with tempfile.TemporaryDirectory(prefix="cmb-survey-") as cache, ThreadPoolExecutor(arguments.processes) as pool:
        options = words(arguments, arguments.cache or Path(cache))
        take = partial(outcome, options=options, seconds=arguments.seconds, advised=arguments.advised)
        for found in pool.map(take, [file.absolute() for file in files]):
            outcomes.append(found)
            record(found, arguments.record)
            doubts = "; ".join((found.error, *found.doubts)).strip("; ")
            sys.stderr.write(f"{found.phase or 'crashed'}: {found.file} {json.dumps(found.facts)} {doubts}\n")
    files = [found.file for found in outcomes]
    common = Path(os.path.commonpath(files)) if files else Path()
    common = common.parent if common.is_file() else common
    sys.stdout.write(table(outcomes, common, rows=arguments.rows))
    return 1 if any(not found.phase for found in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
