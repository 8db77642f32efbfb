"""The middle of the server: hears the simulation, knows the connected operators, lets one of them steer."""

from __future__ import annotations

import asyncio
import json
import math
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
from contact_foundation.errors import CmbError, InputError
from fmu_regression.report.animation import make_animation
from fmu_regression.results.result import SimulationResult

from interactive_drive.picture.frame_encoder import FrameEncoder, Picture
from interactive_drive.process.messages import (
    Command,
    EndReplay,
    Frame,
    Measured,
    Mode,
    Pause,
    Record,
    RecordedRow,
    Refusal,
    Replay,
    Report,
    Reset,
    Restore,
    Run,
    Save,
    SetSpeed,
    SetValues,
    SingleStep,
    Status,
)
from interactive_drive.recording.recording import Recording, find_records
from interactive_drive.server.drive_session import DriveSession, Simulation
from interactive_drive.server.operators import Operator

MOST_PLOTTED = 12
MOST_SAMPLES = 300  # frames that a slow page's plots are behind at most
_MILLI = 1e3
_SIMPLE: Mapping[str, Callable[[], Command]] = {
    "run": Run,
    "pause": Pause,
    "step": SingleStep,
    "reset": Reset,
    "save": Save,
    "leave": EndReplay,
}


class Hub:
    """Connects a simulation with operators.

    Args:
        session: what is driven.
        simulation: that is steered.
    """

    def __init__(self, session: DriveSession, simulation: Simulation) -> None:
        self.session, self._simulation = session, simulation
        self.encoder = FrameEncoder(session.scene, session.signals)
        self.frame: Frame | None = None
        self.status = Status(Mode.STARTING)
        self.operators: set[Operator] = set()
        self.steering: Operator | None = None
        self._samples: deque[Frame] = deque(maxlen=MOST_SAMPLES)
        self._picture: tuple[int, Picture] | None = None
        self._controls = {control.name: control for control in session.controls}
        self._loop: asyncio.AbstractEventLoop | None = None
        self._lock = threading.Lock()
        self._heard: list[Report] = []
        self._newest: Frame | None = None
        self._newest_heard_at = self._heard_at = 0.0
        self._woken = False
        self._recording: Recording | None = None
        self._first = asyncio.Event()
        self._tasks: set[asyncio.Task[None]] = set()
        self.measured: Measured | None = None

    # The simulation's thread.

    def hear(self, report: Report) -> None:
        """Takes a report of the simulation, in whatever thread; rows of a record are written in it."""
        if isinstance(report, RecordedRow):
            self._write(report)
            return
        with self._lock:
            if isinstance(report, Frame):
                self._newest, self._newest_heard_at = report, _MILLI * time.time()
            else:
                self._heard.append(report)
            if self._woken or self._loop is None:
                return
            self._woken = True
            loop = self._loop
        try:
            loop.call_soon_threadsafe(self._take)
        except RuntimeError:  # the server has ended
            return

    def _write(self, row: RecordedRow) -> None:
        recording = self._recording
        if recording is None:
            return
        try:
            recording.append(row.time, row.values)
        except CmbError as error:
            text = str(error)
            self._simulation.send(Record(on=False))
            if self._loop is not None:
                self._loop.call_soon_threadsafe(self._remark, text, True)

    # The server's loop.

    def begin(self) -> None:
        """To be called in the server's loop before anything else."""
        with self._lock:
            self._loop = asyncio.get_running_loop()
            self._woken = True
        self._take()

    def _take(self) -> None:
        with self._lock:
            reports, frame, heard_at = self._heard, self._newest, self._newest_heard_at
            self._heard, self._newest, self._woken = [], None, False
        for report in reports:
            if isinstance(report, Status):
                self._new_status(report)
            elif isinstance(report, Refusal):
                self._remark(report.text, bad=True)
            elif isinstance(report, Measured):
                self.measured = report
        if frame is not None:
            last = self.frame or frame
            if frame.time < last.time or frame.replayed or last.replayed:
                self._tell_all(self._values_of_controls(frame))
            if frame.time < last.time or frame.replayed != last.replayed:
                self._samples.clear()
            self.frame, self._heard_at = frame, heard_at
            self._samples.append(frame)
            self._first.set()
            for operator in self.operators:
                operator.changed.set()

    def _new_status(self, status: Status) -> None:
        ended = not status.recording and (self.status.recording or status.mode is Mode.ENDED)
        self.status = status
        self._tell_all(self._status_message())
        if ended:
            task = asyncio.create_task(self._finish_record())
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _finish_record(self) -> None:
        recording, self._recording = self._recording, None
        if recording is None:
            return
        self._remark("the report of the record is being written")
        session = self.session
        try:
            folder = await asyncio.to_thread(
                recording.finish, session.model, session.step, session.scene_file, session.units
            )
        except CmbError as error:
            self._remark(str(error), bad=True)
            return
        self._remark(f"recorded: {folder}, {recording.rows} rows, result.csv and report.html")
        self._tell_all(self._records_message())

    def _values_of_controls(self, frame: Frame) -> dict[str, Any]:
        """What the sliders should show where time went back, or in a replay."""
        names = [name for name in self._controls if name in self.session.signals]
        places = self.encoder.places(names)
        return {"type": "controls", "values": {n: float(frame.values[k]) for n, k in zip(names, places, strict=True)}}

    def _remark(self, text: str, bad: bool = False) -> None:
        self._tell_all({"type": "remark", "text": text, "bad": bad})

    def _tell_all(self, message: Mapping[str, Any]) -> None:
        for operator in self.operators:
            operator.tell(message)

    async def close(self) -> None:
        """Ends an unfinished record, with its report."""
        if self._recording is not None:
            self._simulation.send(Record(on=False))
            await self._finish_record()
        for task in list(self._tasks):
            await task

    async def scene_data(self) -> bytes:
        """What the viewer needs, as JSON; waits for the first frame."""
        await self._first.wait()
        return await asyncio.to_thread(self._scene_json)

    def _scene_json(self) -> bytes:
        scene, frame = self.session.scene, self.frame
        animation = None
        if scene is not None and frame is not None:
            row = SimulationResult(
                time=np.array([frame.time]),
                signals={name: frame.values[k : k + 1].copy() for k, name in enumerate(self.session.signals)},
            )
            animation = make_animation(scene, row)
        if animation is None or scene is None:
            return b"null"
        moved = sum(body.mass for body in scene.bodies if not body.fixed)
        weight = moved * float(np.linalg.norm(scene.gravity))
        data = {
            **animation.data,
            "forces": [],
            "largestForce": weight or 1.0,
            "moving": self.encoder.moving,
            "key": [asdict(entry) for entry in animation.key],
        }
        return json.dumps(data, allow_nan=False, separators=(",", ":")).encode()

    # Operators.

    def join(self) -> Operator:
        """A new operator; steers if nobody does."""
        operator = Operator()
        operator.places = self.encoder.places(self.session.plots)
        self.operators.add(operator)
        if self.steering is None:
            self.steering = operator
        session = self.session
        operator.tell(
            {
                "type": "hello",
                "model": session.model,
                "step": session.step,
                "controls": [asdict(control) for control in session.controls],
                "keyMap": session.key_map.as_data(),
                "signals": session.signals,
                "units": dict(session.units),
                "channel": str(session.channel) if session.channel is not None else "",
                "plots": [session.signals[place] for place in operator.places],
            }
        )
        operator.tell(self._status_message())
        operator.tell(self._records_message())
        self._tell_steering()
        return operator

    def leave(self, operator: Operator) -> None:
        """An operator is gone; inputs that it held go back to their start."""
        self.operators.discard(operator)
        if self.steering is operator:
            self.steering = None
            rest = {control.name: control.start for control in self.session.controls if control.is_input}
            if rest:
                self._simulation.send(SetValues(rest))
        self._tell_steering()

    def _tell_steering(self) -> None:
        for operator in self.operators:
            operator.tell(
                {
                    "type": "steering",
                    "you": operator is self.steering,
                    "free": self.steering is None,
                    "operators": len(self.operators),
                }
            )

    def _status_message(self) -> dict[str, Any]:
        status = self.status
        return {"type": "status", **asdict(status), "mode": status.mode.value}

    def _records_message(self) -> dict[str, Any]:
        return {"type": "records", "names": list(find_records(self.session.output))}

    def take(self, operator: Operator, text: str) -> None:
        """Carries a message of a page out.

        Raises:
            InputError: the message is none that the page sends.
        """
        message = _parsed(text)
        kind = message.get("type")
        if kind == "seen":
            operator.seen(_number(message, "number"))
        elif kind == "clock":
            operator.tell({"type": "clock", "page": _number(message, "page"), "server": _MILLI * time.time()})
        elif kind == "signals":
            names = message.get("names")
            names = names if isinstance(names, list) else []
            operator.places = self.encoder.places([n for n in names if isinstance(n, str)][:MOST_PLOTTED])
            operator.tell({"type": "plots", "names": [self.session.signals[place] for place in operator.places]})
        elif kind == "steer" and self.steering is None:
            self.steering = operator
            self._tell_steering()
        elif operator is not self.steering:
            operator.tell({"type": "remark", "text": "another operator steers; you are watching", "bad": True})
        else:
            self._steer(message)

    def _steer(self, message: Mapping[str, Any]) -> None:
        kind = message.get("type")
        if kind == "values":
            self._simulation.send(SetValues(self._admitted(message.get("values")), _number(message, "stamp")))
        elif kind == "speed":
            self._simulation.send(SetSpeed(_number(message, "value")))
        elif kind == "restore":
            self._simulation.send(Restore(int(_number(message, "number"))))
        elif kind == "record":
            self._record(message.get("on") is True)
        elif kind == "replay":
            self._replay(message.get("record"))
        elif kind == "restart":
            task = asyncio.create_task(asyncio.to_thread(self._simulation.restart))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)
        elif isinstance(kind, str) and kind in _SIMPLE:
            self._simulation.send(_SIMPLE[kind]())
        elif kind != "steer":
            raise InputError(f"a message of the unknown type {kind!r}")

    def _admitted(self, values: Any) -> dict[str, float]:
        if not isinstance(values, dict):
            raise InputError("values are no table")
        admitted: dict[str, float] = {}
        for name, value in values.items():
            control = self._controls.get(name)
            if control is None or isinstance(value, bool) or not isinstance(value, int | float):
                raise InputError(f"{name!r} cannot be set to {value!r}")
            admitted[name] = control.admitted(float(value))
        return admitted

    def _replay(self, name: Any) -> None:
        records = find_records(self.session.output)
        if not isinstance(name, str) or name not in records:
            raise InputError(f"there is no record {name!r}")
        if self.status.mode in (Mode.STARTING, Mode.ENDED):
            raise InputError("the simulation's process does not run")
        self._simulation.send(Replay(records[name]))

    def _record(self, on: bool) -> None:
        if on and self.status.replayed:
            self._remark("a replay is not recorded: its record is there", bad=True)
        elif on and self.status.mode not in (Mode.RUNNING, Mode.PAUSED):
            self._remark("a machine that does not run cannot be recorded", bad=True)
        elif on and self._recording is None:
            try:
                self._recording = Recording(self.session.output, self.session.signals)
            except CmbError as error:
                self._remark(str(error), bad=True)
                return
            self._remark(f"recording to {self._recording.folder}")
            self._simulation.send(Record(on=True))
        elif not on:
            self._simulation.send(Record(on=False))

    # Frames.

    def newest_message(self, operator: Operator) -> tuple[int, bytes] | None:
        """Number and bytes of the newest frame for an operator, None if it was chosen for it already."""
        frame = self.frame
        if frame is None or frame.number == operator.number:
            return None
        if self._picture is None or self._picture[0] != frame.number:
            self._picture = (frame.number, self.encoder.picture(frame.values))
        samples = [sample for sample in self._samples if sample.number > operator.number]
        operator.number = frame.number
        message = self.encoder.message(frame, self._picture[1], samples or [frame], operator.places, self._heard_at)
        return frame.number, message


def _parsed(text: str) -> Mapping[str, Any]:
    try:
        message = json.loads(text, parse_constant=_no_constant)
    except (ValueError, RecursionError) as error:
        raise InputError("a message that is no JSON") from error
    if not isinstance(message, dict):
        raise InputError("a message that is no table")
    return message


def _no_constant(text: str) -> float:
    raise ValueError(f"{text} is not a number of JSON")


def _number(message: Mapping[str, Any], name: str) -> float:
    value = message.get(name, 0.0)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise InputError(f"{name} is no number")
    return float(value)
