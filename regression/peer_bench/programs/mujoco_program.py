"""MuJoCo: scenes as MJCF, stepped by ``mj_step``."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import mujoco
import numpy as np
from mujoco import rollout

from peer_bench.programs.mechanisms import (
    FOOT_FRICTION,
    FOOT_OFFSET,
    FOOT_RADIUS,
    HEXAPOD_DAMPING,
    HEXAPOD_STIFFNESS,
    LEGS,
    TORSO_HEIGHT,
    TORSO_INERTIA,
    TORSO_MASS,
    Link,
    servo_targets,
)
from peer_bench.programs.simulation import Settings, Simulation, whole_steps
from peer_bench.restitution import damping_ratio
from peer_bench.scenes import (
    CRADLE_BALLS,
    CRADLE_GAP,
    CRADLE_LENGTH,
    CRADLE_MASS,
    CRADLE_RADIUS,
    CRADLE_START,
    Body,
    Scene,
    World,
)

VERSION: Final = str(mujoco.__version__)
_UNSTABLE: Final = (
    mujoco.mjtWarning.mjWARN_BADQPOS,
    mujoco.mjtWarning.mjWARN_BADQVEL,
    mujoco.mjtWarning.mjWARN_BADQACC,
)
_GEOMS: Final = {"sphere": "sphere", "box": "box", "capsule": "capsule"}


def simulation(scene: Scene, settings: Settings) -> Simulation:
    """A scene with settings.

    Args:
        scene: which.
        settings: step (s); integrator, cone, iterations, tolerance, impratio, noslip_iterations as in MJCF; of the
            contacts steps (steps in half an oscillation) or stiffness (N/m on 1 kg), and impedance.
    """
    if scene.world is not None:
        return _FreeBodies(scene, scene.world, settings)
    return _MECHANISMS[scene.name](scene, settings)


class _Stepped:
    """A model that is stepped with a fixed step."""

    def __init__(self, scene: Scene, settings: Settings, model: str) -> None:
        self.scene = scene
        interval = scene.stop / scene.intervals
        self._steps = whole_steps(interval, float(settings["step"]))
        self.model = mujoco.MjModel.from_xml_string(model)
        self.model.opt.timestep = interval / self._steps
        self.data = mujoco.MjData(self.model)
        self._count = 0

    def advance(self, until: float) -> None:
        """Takes the steps of an interval."""
        del until
        mujoco.mj_step(self.model, self.data, nstep=self._steps)
        self._count += self._steps
        self.check()

    def values(self) -> list[float]:
        """The coordinates of a mechanism."""
        return [float(value) for value in self.data.qpos]

    def work(self) -> dict[str, float]:
        """Steps."""
        return {"steps": self._count}

    def close(self) -> None:
        """Nothing is held."""

    def check(self) -> None:
        """MuJoCo starts anew where a state is not finite, and goes on; that is a failure.

        Raises:
            ArithmeticError: it did.
        """
        if any(self.data.warning[kind].number for kind in _UNSTABLE):
            raise ArithmeticError("MuJoCo says: the simulation is unstable")


class _FreeBodies(_Stepped):
    def __init__(self, scene: Scene, world: World, settings: Settings) -> None:
        bodies = "".join(_body(body) for body in world.bodies)
        model = _model(scene, settings, world.restitution, world.friction, world.gravity, _FLOOR + bodies)
        super().__init__(scene, settings, model)
        for k, body in enumerate(world.bodies):
            self.data.qvel[6 * k : 6 * k + 3] = body.velocity
            self.data.qvel[6 * k + 3 : 6 * k + 6] = body.spin
        mujoco.mj_forward(self.model, self.data)

    def values(self) -> list[float]:
        """The coordinates that are compared."""
        return self.scene.seen(np.asarray(self.data.qpos).reshape(-1, 7)[:, :3])


class _Hexapod(_Stepped):
    """Targets of the servos are known at every step beforehand, so that many steps are taken a call (``rollout``)."""

    def __init__(self, scene: Scene, settings: Settings) -> None:
        servos = "".join(f'<position joint="joint{k}" kp="{HEXAPOD_STIFFNESS!r}"/>' for k in range(3 * len(LEGS)))
        model = _model(
            scene,
            settings,
            0.0,
            FOOT_FRICTION,
            (0.0, 0.0, -9.81),
            _FLOOR + _hexapod(),
            f"<actuator>{servos}</actuator>",
        )
        super().__init__(scene, settings, model)
        self.data.qpos[2] = TORSO_HEIGHT
        mujoco.mj_forward(self.model, self.data)
        step = float(self.model.opt.timestep)
        times = step * np.arange(self._steps * scene.intervals)
        self._targets = np.array([servo_targets(time) for time in times.tolist()])
        kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
        self._state = np.empty(mujoco.mj_stateSize(self.model, kind))
        mujoco.mj_getState(self.model, self.data, self._state, kind)

    def advance(self, until: float) -> None:
        """Takes the steps of an interval with the servos' targets of each."""
        del until
        targets = self._targets[self._count : self._count + self._steps]
        states, _ = rollout.rollout(self.model, [self.data], self._state, targets[None])
        self._state = states[0, -1]
        self._count += self._steps
        self.check()

    def values(self) -> list[float]:
        """The position of the torso; a state is time, positions and velocities."""
        return [float(value) for value in self._state[1:4]]


_FLOOR: Final = '<geom type="plane" size="0 0 1"/>'


def _body(body: Body) -> str:
    half_edges = tuple(edge / 2 for edge in body.size)
    size = {"sphere": body.size, "box": half_edges, "capsule": (body.size[0], body.size[-1] / 2)}[body.shape]
    turn = (math.cos(body.tilt / 2), 0.0, math.sin(body.tilt / 2), 0.0)
    return (
        f'<body pos="{_row(body.position)}" quat="{_row(turn)}"><freejoint/>'
        f'<inertial pos="0 0 0" mass="{body.mass!r}" diaginertia="{_row(body.inertia)}"/>'
        f'<geom type="{_GEOMS[body.shape]}" size="{_row(size)}"/></body>'
    )


def _model(
    scene: Scene,
    settings: Settings,
    restitution: float,
    friction: float,
    gravity: tuple[float, float, float],
    world: str,
    more: str = "",
) -> str:
    interval = scene.stop / scene.intervals
    step = interval / whole_steps(interval, float(settings["step"]))
    rate = (
        math.sqrt(float(settings["stiffness"]))
        if "stiffness" in settings
        else math.pi / (float(settings.get("steps", 20)) * step)
    )
    ratio = damping_ratio(restitution) if restitution > 0 else float(settings.get("damping_ratio", 1.0))
    impedance = float(settings.get("impedance", 0.9999))
    options = {key: settings[key] for key in _OPTIONS if key in settings}
    text = " ".join(
        f'{key}="{value:g}"' if not isinstance(value, str) else f'{key}="{value}"' for key, value in options.items()
    )
    return (
        f'<mujoco><compiler angle="radian" boundmass="0" boundinertia="0"/>'
        f'<option gravity="{_row(gravity)}" {text}/><size memory="64M"/>'
        f'<default><geom condim="{3 if friction > 0 else 1}" friction="{friction!r} 0 0" '
        f'solref="{-(rate**2)!r} {-2 * ratio * rate!r}" solimp="{impedance!r} {impedance!r} 0.001 0.5 2"/></default>'
        f"<worldbody>{world}</worldbody>{more}</mujoco>"
    )


_OPTIONS: Final = ("integrator", "cone", "iterations", "tolerance", "impratio", "noslip_iterations", "solver")


def _cradle(scene: Scene, settings: Settings) -> Simulation:
    inertia = 0.4 * CRADLE_MASS * CRADLE_RADIUS**2
    balls = "".join(
        f'<body pos="{k * (2 * CRADLE_RADIUS + CRADLE_GAP)!r} 0 0"><joint type="hinge" axis="0 1 0"/>'
        f'<inertial pos="0 0 {-CRADLE_LENGTH!r}" mass="{CRADLE_MASS!r}" diaginertia="{_row(3 * (inertia,))}"/>'
        f'<geom type="sphere" size="{CRADLE_RADIUS!r}" pos="0 0 {-CRADLE_LENGTH!r}"/></body>'
        for k in range(CRADLE_BALLS)
    )
    # The damping ratio of e = 1 is 0, which the direct form of solref cannot say: it must be negative.
    found = _Stepped(scene, settings, _model(scene, settings, 0.999999, 0.0, (0.0, 0.0, -9.81), balls))
    found.data.qpos[0] = CRADLE_START
    return found


def _hexapod() -> str:
    legs = "".join(_leg(3 * k, leg.links) for k, leg in enumerate(LEGS))
    torso = f'<inertial pos="0 0 0" mass="{TORSO_MASS!r}" diaginertia="{_row(TORSO_INERTIA)}"/>'
    return f"<body><freejoint/>{torso}{legs}</body>"


def _leg(first: int, links: Sequence[Link]) -> str:
    """Nested bodies; only feet touch anything, and only the floor."""
    link = links[0]
    inner = (
        _leg(first + 1, links[1:])
        if len(links) > 1
        else f'<geom type="sphere" size="{FOOT_RADIUS!r}" pos="0 0 {FOOT_RADIUS - FOOT_OFFSET!r}" contype="0"/>'
    )
    return (
        f'<body pos="{_row(link.origin)}"><joint name="joint{first}" type="hinge" axis="{_row(link.axis)}" '
        f'damping="{HEXAPOD_DAMPING!r}"/><inertial pos="{_row(link.centre)}" mass="{link.mass!r}" '
        f'diaginertia="{_row(link.inertia)}"/>{inner}</body>'
    )


_MECHANISMS: Final[Mapping[str, Callable[[Scene, Settings], Simulation]]] = {
    "Newton's cradle": _cradle,
    "hexapod": _Hexapod,
}


def _row(values: Any) -> str:
    return " ".join(repr(float(value)) for value in values)
