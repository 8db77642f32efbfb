"""``cmb drive --headless``: deadlines, latency from an input to the picture's message, jitter, bytes a second.

Server and page are in one process here, so that latency is measured with one clock; the simulation is in its own, as in
a drive. The page acknowledges frames and sends inputs as a browser does; it draws nothing.
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass
from socket import socket

import numpy as np
from contact_foundation.errors import SimulationError
from contact_foundation.progress import Progress
from numpy.typing import NDArray

from interactive_drive.benchmark.page_client import PageClient, ReceivedFrame, open_page
from interactive_drive.pacing.pacer import PacingRecord
from interactive_drive.process.messages import Measure, Mode
from interactive_drive.process.worker import Plan
from interactive_drive.server.drive_server import DriveServer
from interactive_drive.server.drive_session import DriveSession

_INPUT_PERIOD = 0.0537  # s; no multiple of a step, so that inputs come at all moments of one
_START_LIMIT = 120.0
_WARM_UP = 1.0
_PATIENCE = 10.0
_MILLI = 1e3


@dataclass(frozen=True)
class DriveFigures:
    """What was measured.

    Attributes:
        model: name of the model.
        step: of communication, s.
        wall: wall time measured, s.
        simulated: simulated time in it, s.
        pacing: of the simulation's process.
        latencies: from an input to the first frame in which it counts, s, shape (n,).
        gaps: between frames that arrive, s, shape (m,).
        ages: of frames when they arrive, since the server heard of them, s, shape (m + 1,).
        received: bytes of frames that arrived.
        poses: those among them that are poses, with the frames' headers.
        channel: that was simulated, "" if none was.
    """

    model: str
    step: float
    wall: float
    simulated: float
    pacing: PacingRecord
    latencies: NDArray[np.float64]
    gaps: NDArray[np.float64]
    ages: NDArray[np.float64]
    received: int
    poses: int
    channel: str


def measure_drive(plan: Plan, session: DriveSession, bound: socket, seconds: float, progress: Progress) -> DriveFigures:
    """Drives for some time and measures.

    Args:
        plan: what is simulated.
        session: what is driven.
        bound: socket that listens.
        seconds: wall time.
        progress: told about it.

    Raises:
        SimulationError: the simulation fails meanwhile.
    """
    server = DriveServer(plan, session, bound, lambda _address: None)
    thread = threading.Thread(target=server.serve, daemon=True)
    thread.start()
    try:
        with open_page(server.address) as page:
            return _measure(page, server, session, seconds, progress)
    finally:
        server.end()
        thread.join(_PATIENCE)


def _measure(
    page: PageClient, server: DriveServer, session: DriveSession, seconds: float, progress: Progress
) -> DriveFigures:
    _wait_for_frame(page, server)
    page.send({"type": "run"})
    _read(page, server, _WARM_UP)
    server.simulator.send(Measure(afresh=True))
    latencies: list[float] = []
    arrivals: list[float] = []
    ages: list[float] = []
    received = poses = 0
    waiting: list[float] = []
    began = now = last_input = time.perf_counter()
    first_time = last_time = np.nan
    while now - began < seconds:
        if now - last_input >= _INPUT_PERIOD:
            last_input = now
            waiting.append(now)
            page.send({"type": "values", "values": _wiggle(session, now), "stamp": now * _MILLI})
        message = page.receive(max(0.0, last_input + _INPUT_PERIOD - now))
        now = time.perf_counter()
        if isinstance(message, ReceivedFrame):
            arrivals.append(now)
            received += message.size
            poses += message.poses
            ages.append(message.age)
            first_time = message.time if np.isnan(first_time) else first_time
            last_time = message.time
            latencies += [now - stamp for stamp in waiting if stamp * _MILLI <= message.stamp]
            waiting = [stamp for stamp in waiting if stamp * _MILLI > message.stamp]
        _require_alive(server)
        progress("drive", min(1.0, (now - began) / seconds), f"t = {last_time:.1f} s")
    wall = arrivals[-1] - arrivals[0] if len(arrivals) > 1 else np.nan
    return DriveFigures(
        session.model,
        session.step,
        wall,
        last_time - first_time,
        _pacing(page, server),
        np.array(latencies),
        np.diff(arrivals),
        np.array(ages),
        received,
        poses,
        str(session.channel) if session.channel is not None else "",
    )


def _wiggle(session: DriveSession, now: float) -> dict[str, float]:
    """A small motion of every input that is a real number, so that inputs are really set."""
    share = 0.02 * np.sin(2 * np.pi * 0.2 * now)
    return {
        control.name: control.admitted(control.start + share * (control.high - control.low))
        for control in session.controls
        if control.is_input and control.kind == "Real"
    }


def _wait_for_frame(page: PageClient, server: DriveServer) -> None:
    until = time.monotonic() + _START_LIMIT
    while time.monotonic() < until:
        if isinstance(page.receive(1.0), ReceivedFrame):
            return
        _require_alive(server)
    raise SimulationError(f"the simulation does not start within {_START_LIMIT:g} s")


def _read(page: PageClient, server: DriveServer, seconds: float) -> None:
    until = time.monotonic() + seconds
    while (left := until - time.monotonic()) > 0:
        page.receive(left)
        _require_alive(server)


def _pacing(page: PageClient, server: DriveServer) -> PacingRecord:
    server.hub.measured = None
    server.simulator.send(Measure())
    until = time.monotonic() + _PATIENCE
    while time.monotonic() < until:
        page.receive(0.05)
        _require_alive(server)
        if server.hub.measured is not None:
            return server.hub.measured.record
    raise SimulationError("the simulation's process does not answer")


def _require_alive(server: DriveServer) -> None:
    status = server.hub.status
    if status.mode in (Mode.FAILED, Mode.ENDED):
        raise SimulationError(f"the drive stopped: {status.message}")


def table(figures: DriveFigures) -> str:
    """The figures in lines of a name, a value and a unit."""
    pacing, gaps = figures.pacing, figures.gaps
    share = pacing.missed / pacing.steps if pacing.steps else 0.0
    rows = [
        ("wall time", f"{figures.wall:.1f}", "s"),
        ("real-time factor", f"{figures.simulated / figures.wall:.3f}", ""),
        ("steps", f"{pacing.steps}", f"of {_MILLI * figures.step:g} ms"),
        ("deadlines missed", f"{pacing.missed}", f"({share:.2%})"),
        ("by, median / 99 % / most", _spread(pacing.overruns), "ms"),
        ("time given up", f"{_MILLI * pacing.lost:.0f}", "ms"),
        ("a step takes, median / 99 % / most", _spread(pacing.durations), "ms"),
        ("its processor time, median / 99 % / most", _spread(pacing.work), "ms"),
        ("jitter of its beginning, median / 99 % / most", _spread(pacing.delays), "ms"),
        ("input to frame, median / 99 % / most", _spread(figures.latencies), "ms"),
        ("between frames, median / 99 % / most", _spread(gaps), "ms"),
        ("age of a frame, median / 99 % / most", _spread(figures.ages), "ms"),
        ("frames a second", f"{gaps.size / figures.wall:.1f}", ""),
        ("bytes a second, all", f"{figures.received / figures.wall:.0f}", ""),
        ("bytes a second, poses alone", f"{figures.poses / figures.wall:.0f}", ""),
    ]
    if figures.channel:
        rows.insert(0, ("simulated channel", figures.channel, ""))
    width = max(len(name) for name, _, _ in rows)
    return "\n".join(
        [figures.model, *(f"  {name:<{width}}  {value:>20}  {unit}".rstrip() for name, value, unit in rows)]
    )


def _spread(values: NDArray[np.float64] | tuple[float, ...]) -> str:
    if not len(values):
        return "none"
    return " / ".join(f"{value:.1f}" for value in np.percentile(_MILLI * np.asarray(values), [50, 99, 100]))
