"""One run of a scene by one importer, and what is asked of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final

import fmpy
import numpy as np
from contact_foundation.errors import SimulationError
from contact_foundation.progress import silent
from fmu_regression.fmi.binding import Mode
from fmu_regression.results.result import FloatArray
from fmu_regression.simulate.limited_process import run_limited
from fmu_regression.simulate.simulation import simulate

from contact_promises.soak.scenes import STOP

IMPORTERS: Final = ("cmb", "fmpy")
MODES: Final[tuple[Mode, ...]] = ("me", "cs")
TOLERANCES: Final = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
SPREAD: Final = 100.0
"""How many tolerances a result may be off."""
TIME_LIMIT: Final = 60.0
"""Wall time in s that counts as without end."""
_INTERVAL = 1e-3
_AFTER_TOUCH = 0.01
"""How long after the first touch results are compared: chaos begins with the next ones."""
_SIGNALS = ("mechanical", "elastic", "work", "body1.r_0[1]", "body1.r_0[2]", "body1.r_0[3]")


@dataclass(frozen=True)
class Run:
    """Who simulates a scene, how, and at which relative tolerance."""

    importer: str
    mode: Mode
    tolerance: float


@dataclass(frozen=True)
class Trace:
    """What is looked at: time in s and energies in J, shape (n,); positions of the first body in m, shape (n, 3)."""

    time: FloatArray
    mechanical: FloatArray
    elastic: FloatArray
    work: FloatArray
    position: FloatArray


@dataclass(frozen=True)
class Verdict:
    """What a run showed; numbers in tolerances.

    Attributes:
        balance: the largest energy that the contacts' work did not account for.
        rise: the largest rise of all energy.
        deviation: from the reference shortly after the first touch.
        failure: what is wrong, empty if nothing.
        message: why the run stopped, empty if it did not.
    """

    balance: float
    rise: float
    deviation: float
    failure: str
    message: str = ""


def trace(fmu: Path, run: Run) -> Trace:
    """Simulates.

    Raises:
        SimulationError: the run stopped, crashed or took too long.
    """
    if run.importer == "cmb":
        result = simulate(
            fmu,
            signals=_SIGNALS,
            stop=STOP,
            interval=_INTERVAL,
            tolerance=run.tolerance,
            mode=run.mode,
            time_limit=TIME_LIMIT,
        )
        time, columns = result.time, {name: result[name] for name in _SIGNALS}
    else:
        time, columns = run_limited(lambda _: _by_fmpy(fmu, run), TIME_LIMIT, silent, fmu.stem)
    position = np.column_stack([columns[f"body1.r_0[{i}]"] for i in (1, 2, 3)])
    return Trace(time, columns["mechanical"], columns["elastic"], columns["work"], position)


def _by_fmpy(fmu: Path, run: Run) -> tuple[FloatArray, dict[str, FloatArray]]:
    try:
        table = fmpy.simulate_fmu(
            str(fmu),
            fmi_type="ModelExchange" if run.mode == "me" else "CoSimulation",
            stop_time=STOP,
            output_interval=_INTERVAL,
            relative_tolerance=run.tolerance,
            output=list(_SIGNALS),
        )
    except Exception as error:
        raise SimulationError(f"FMPy: {error}") from error
    return np.array(table["time"]), {name: np.array(table[name]) for name in _SIGNALS}


def judge(found: Trace, reference: Trace, tolerance: float) -> Verdict:
    """Compares a run with the promises.

    Args:
        found: the run.
        reference: the same scene at the tightest tolerance.
        tolerance: that of the run.
    """
    scale = tolerance * float(reference.mechanical[0])
    balance = float(np.max(np.abs(found.mechanical - found.mechanical[0] - found.work))) / scale
    total = found.mechanical + found.elastic
    rise = float(np.max(total - np.minimum.accumulate(total))) / scale
    moment = first_touch(reference) + _AFTER_TOUCH
    there, expected = (
        np.array([np.interp(moment, one.time, one.position[:, i]) for i in range(3)]) for one in (found, reference)
    )
    deviation = float(np.max(np.abs(there - expected))) / tolerance
    failures = [
        f"{name} {value:.3g} tolerances"
        for name, value in (("balance", balance), ("rise", rise), ("deviation", deviation))
        if not value <= SPREAD
    ]
    return Verdict(balance, rise, deviation, "; ".join(failures))


def stopped(error: SimulationError) -> Verdict:
    """The verdict on a run that did not come to its end: a message is right, no end or a crash is not."""
    text = " ".join(str(error).split())[:200]
    without_end = "given up after" in text or "crashed" in text
    return Verdict(np.nan, np.nan, np.nan, text if without_end else "", "" if without_end else text)


def first_touch(one: Trace) -> float:
    """When the contacts first stored energy, in s; the end of the run if never."""
    touching = np.nonzero(one.elastic > 0.0)[0]
    return float(one.time[touching[0]]) if touching.size else float(one.time[-1])
