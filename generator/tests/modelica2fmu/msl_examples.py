"""Examples of the Modelica Standard Library: builds and simulates them and compares them with rumoca's own simulation.

    scripts/msl_examples                 tries all examples and writes the table of docs/fmu-builder.md
    scripts/msl_examples NAME ...        tries these and writes the table, other rows as they were tried last

The library is that of MODELICAPATH, OpenModelica or the cache. Outcomes are kept in build/msl_examples.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import rumoca
from contact_data import checkout
from contact_foundation.errors import CmbError
from fmpy import read_model_description, simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu
from modelica2fmu.frontend.errors import FrontEndError
from modelica2fmu.library.standard_library import find_standard_library

PROJECT: Final = checkout()
OUTCOMES: Final = PROJECT / "build" / "msl_examples"
DOCUMENTATION: Final = PROJECT / "docs" / "fmu-builder.md"
BEGIN, END = "<!-- msl_examples begin -->", "<!-- msl_examples end -->"
TIME_LIMIT: Final = 300.0  # seconds an example may take, build and both simulations
TOLERANCE: Final = 1e-8
ABSOLUTE: Final = 1e-9  # tolerance of both simulations; what is within ten of it is the same
COMPARED: Final = 1.0  # seconds over which trajectories are compared
COARSER: Final = (
    100.0  # times the tolerance, at which a trajectory must be the same to APART of its range to be compared
)
APART: Final = 1e-3

_EXAMPLES: Final = {
    "Mechanics.MultiBody.Examples.Elementary": "DoublePendulum DoublePendulumInitTip ForceAndTorque FreeBody HeatLosses"
    " InitSpringConstant LineForceWithTwoMasses Pendulum PendulumWithSpringDamper PointGravity"
    " PointGravityWithPointMasses PointGravityWithPointMasses2 RollingWheel RollingWheelSetDriving"
    " RollingWheelSetPulling SpringDamperSystem SpringMassSystem SpringWithMass Surfaces ThreeSprings"
    " UserDefinedGravityField",
    "Mechanics.MultiBody.Examples.Loops": "Engine1a Engine1b Engine1b_analytic EngineV6 EngineV6_analytic Fourbar1"
    " Fourbar2 Fourbar_analytic PlanarFourbar PlanarLoops_analytic",
    "Mechanics.MultiBody.Examples.Constraints": "PrismaticConstraint RevoluteConstraint SphericalConstraint"
    " UniversalConstraint",
    "Mechanics.MultiBody.Examples.Rotational3DEffects": "ActuatedDrive BevelGear1D GearConstraint GyroscopicEffects"
    " MovingActuatedDrive",
    "Mechanics.MultiBody.Examples.Systems.RobotR3": "OneAxis FullRobot",
    "Mechanics.Rotational.Examples": "Backlash CompareBrakingTorque CoupledClutches EddyCurrentBrake ElasticBearing"
    " First FirstGrounded Friction HeatLosses LossyGearDemo1 LossyGearDemo2 LossyGearDemo3 OneWayClutch"
    " OneWayClutchDisengaged RollingWheel SimpleGearShift",
    "Mechanics.Translational.Examples": "Accelerate Brake CompareBrakingForce Damper EddyCurrentBrake ElastoGap"
    " Friction HeatLosses InitialConditions Oscillator PreLoad Sensors SignConvention Vehicle WhyArrows",
    "Blocks.Examples": "PID_Controller Filter FilterWithDifferentiation FilterWithRiseTime SlewRateLimiter InverseModel"
    " ShowLogicalSources LogicalNetwork1 RealNetwork1 IntegerNetwork1 BooleanNetwork1 Interaction1 BusUsage Modulation"
    " SinCosEncoder CompareSincExpSine DemonstrateSignalExtrema DemonstrateContinuousSignalExtrema"
    " DemoSignalCharacteristic",
}
EXAMPLES: Final = tuple(f"Modelica.{package}.{name}" for package, names in _EXAMPLES.items() for name in names.split())


@dataclass(frozen=True)
class Outcome:
    """What became of an example.

    Attributes:
        model: full name.
        result: ``runs``, ``front end``, ``builder`` or ``simulation``: it runs, or who gave up.
        reason: why it does not run.
        states: number of states.
        deviation: largest difference of a state from rumoca's simulation, over the larger of its range and 1e-3 of the
            largest value of any state; ``None`` where rumoca cannot simulate it. As long as the motion can be foretold.
        remark: why there is no deviation, or until when it is compared.
    """

    model: str
    result: str
    reason: str = ""
    states: int = 0
    deviation: float | None = None
    remark: str = ""


def library_folder() -> Path | None:
    """The folder of a complete Standard Library, if there is one."""
    library = find_standard_library()
    return None if library.origin == "core subset" else library.folder


def attempt(model: str, library: Path, folder: Path, cache: Path | None = None) -> Outcome:
    """Builds and simulates an example; files go to ``folder``."""
    fmu = folder / "model.fmu"
    try:
        report = build_fmu(model, [library / "Modelica"], fmu, BuildOptions(msl=library, cache=cache))
    except CmbError as error:
        by = "front end" if isinstance(error.__cause__, FrontEndError) else "builder"
        return Outcome(model, by, f"{error.message.splitlines()[0]}")
    # What is integrated for a quaternion is the builder's own; the quaternion is the model's.
    states = [name.replace("_integrated", "") for name in report.states if not name.startswith("der(")]
    experiment = read_model_description(str(fmu)).defaultExperiment
    stop = float(experiment.stopTime) if experiment is not None and experiment.stopTime else 1.0
    compared = min(stop, COMPARED)
    try:
        result = _simulated(fmu, stop, stop / 100, [])
        if abs(result["time"][-1] - stop) > 1e-6 * stop:
            return Outcome(model, "simulation", f"ends at {result['time'][-1]:g} s of {stop:g} s", len(states))
        result = _simulated(fmu, compared, compared / 10, states)
        coarse = _simulated(fmu, compared, compared / 10, states, COARSER * TOLERANCE)
    except Exception as error:
        return Outcome(model, "simulation", str(error).splitlines()[0], len(states))
    deviation, remark = _deviation(model, library, states, result, coarse, compared)
    return Outcome(model, "runs", "", len(report.states), deviation, remark)


def _simulated(fmu: Path, stop: float, interval: float, names: Sequence[str], tolerance: float = TOLERANCE) -> Any:
    return simulate_fmu(
        str(fmu), fmi_type="CoSimulation", stop_time=stop, relative_tolerance=tolerance, output_interval=interval,
        output=list(names) or None,
    )  # fmt: skip


def _deviation(
    model: str, library: Path, states: Sequence[str], mine: Any, coarse: Any, stop: float
) -> tuple[float | None, str]:
    """Largest difference from rumoca's simulation as long as a coarser one moves the same, or why there is none."""
    if not states:
        return None, "no states"
    text = (
        "class 'cmb libraries'\n  import Modelica;\n  import ModelicaServices;\n  import Complex;\nend 'cmb libraries';"
    )
    config = rumoca.SimConfig(rtol=TOLERANCE, atol=ABSOLUTE, max_wall_seconds=60)
    try:
        compiled = rumoca.Session([str(library)]).loads(text, model=model, filename="libraries.mo")
        other = compiled.simulate(stop, dt=stop / 10, config=config)
    except Exception as error:
        return None, f"rumoca: {str(error).splitlines()[0][:60]}"
    theirs = other.to_dict()["data"]
    common = [name for name in states if name in theirs]
    if not common:
        return None, "no state in common"
    size = max(float(np.max(np.abs(mine[name]))) for name in common) or 1.0
    scale = {name: max(float(np.ptp(mine[name])), 1e-3 * size) for name in common}
    apart = [k for k in range(len(mine)) if any(abs(mine[n][k] - coarse[n][k]) > APART * scale[n] for n in common)]
    end = min(apart, default=len(mine))  # of what can be foretold: a chaotic motion's digits are used up then
    # rumoca's rows are at the grid and at events; compared is the grid, after an event there.
    on_grid = {round(float(time) / (stop / 10)): row for row, time in enumerate(other.time) if _is_on_grid(time, stop)}
    rows = {int(np.argmin(np.abs(mine["time"] - number * stop / 10))): row for number, row in on_grid.items()}
    worst = 0.0
    for name in common:
        gaps = [float(abs(mine[name][row] - theirs[name][peer])) for row, peer in rows.items() if row < end]
        worst = max(worst, (max(gaps, default=0.0) - 10 * ABSOLUTE) / scale[name])
    if apart:
        return worst, f"chaotic from {mine['time'][end]:g} s on"
    return worst, "" if len(common) == len(states) else f"{len(common)} of {len(states)} states compared"


def _is_on_grid(time: float, stop: float) -> bool:
    share = float(time) / (stop / 10)
    return abs(share - round(share)) < 1e-9


# --- the command ---


def _path(model: str) -> Path:
    return OUTCOMES / f"{model}.json"


def _attempt_apart(model: str) -> None:
    """Tries an example in a process of its own, which may crash or hang."""
    _path(model).unlink(missing_ok=True)
    try:
        done = subprocess.run(
            [sys.executable, __file__, "--one", model], capture_output=True, text=True, timeout=TIME_LIMIT, check=False
        )
        if not _path(model).exists():
            last = (done.stderr.strip().splitlines() or ["?"])[-1]
            _path(model).write_text(json.dumps(asdict(Outcome(model, "builder", f"crash: {last}"))))
    except subprocess.TimeoutExpired:
        outcome = Outcome(model, "builder", f"does not end within {TIME_LIMIT:.0f} s")
        _path(model).write_text(json.dumps(asdict(outcome)))
    sys.stdout.write(f"{model}: {json.loads(_path(model).read_text())}\n")
    sys.stdout.flush()


def table(outcomes: Sequence[Outcome]) -> str:
    """The table of the documentation."""
    running = sum(outcome.result == "runs" for outcome in outcomes)
    compared = [outcome.deviation for outcome in outcomes if outcome.deviation is not None]
    front_end = sum(outcome.result == "front end" for outcome in outcomes)
    close = sum(deviation < 1e-4 for deviation in compared)
    lines = [
        f"{running} of {len(outcomes)} run; {front_end} rumoca does not flatten. Of {len(compared)} that rumoca"
        f" simulates too, {close} agree to 1e-4.",
        "",
        "| example (Modelica.) | result | states | deviation from rumoca |",
        "|---|---|---|---|",
    ]
    for outcome in outcomes:
        name = outcome.model.removeprefix("Modelica.")
        if outcome.result == "runs":
            deviation = f"{outcome.deviation:.0e}" if outcome.deviation is not None else ""
            note = ", ".join(item for item in (deviation, outcome.remark) if item)
            lines.append(f"| {name} | runs | {outcome.states} | {note.replace('|', '/')} |")
        else:
            reason = outcome.reason.replace(outcome.model, "").replace("|", "/").replace("failed in ToDae: ", "")
            lines.append(f"| {name} | {outcome.result}: {reason.strip()[:160]} | | |")
    return "\n".join(lines)


def write_table() -> None:
    """Replaces the table of the documentation."""
    outcomes = [Outcome(**json.loads(_path(model).read_text())) for model in EXAMPLES if _path(model).exists()]
    text = DOCUMENTATION.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    _, tail = rest.split(END)
    DOCUMENTATION.write_text(f"{head}{BEGIN}\n{table(outcomes)}\n{END}{tail}", encoding="utf-8")


def main(arguments: Sequence[str]) -> int:
    """The command; see the module's text."""
    library = library_folder()
    if library is None:
        sys.stderr.write("msl_examples: no complete Modelica Standard Library: set MODELICAPATH\n")
        return 2
    OUTCOMES.mkdir(parents=True, exist_ok=True)
    if arguments[:1] == ["--one"]:
        with tempfile.TemporaryDirectory() as folder:
            outcome = attempt(arguments[1], library, Path(folder))
        _path(arguments[1]).write_text(json.dumps(asdict(outcome)))
        return 0
    unknown = [name for name in arguments if name not in EXAMPLES]
    if unknown:
        sys.stderr.write(f"msl_examples: not in the list: {', '.join(unknown)}\n")
        return 2
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(_attempt_apart, arguments or EXAMPLES))
    write_table()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
