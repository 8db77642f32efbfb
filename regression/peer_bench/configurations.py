"""What is tried: every program's ways to simulate a scene, each swept over its own tolerance or step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from peer_bench.programs.simulation import Settings

OURS: Final = "ContactMultiBody"
PROGRAMS: Final[Mapping[str, str]] = {
    OURS: "fmu",
    "MuJoCo": "mujoco",
    "Drake": "drake",
    "Bullet": "pybullet",
}
"""Name to the beginning of the name of its module; the order of colours and tables."""
_TOLERANCES: Final = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
_ACCURACIES: Final = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
_STEPS: Final = (1e-2, 5e-3, 1e-3, 2e-4, 5e-5)
_FEW_STEPS: Final = (1e-2, 3e-3, 1e-3, 2e-4)


@dataclass(frozen=True)
class Configuration:
    """A way of a program to simulate, but for what is swept.

    Attributes:
        program: key of PROGRAMS.
        label: what is special about it.
        settings: of the program's module.
        swept: the setting that is swept.
        values: of it, from the coarsest.
        model: Modelica model of which an FMU is built; of this project's program alone.
    """

    program: str
    label: str
    settings: Settings = field(hash=False)
    swept: str
    values: Sequence[float]
    model: str = ""

    @property
    def name(self) -> str:
        """Program and label."""
        return f"{self.program}, {self.label}"


def _ours(model: str, stiffnesses: Sequence[float], label: str = "") -> Iterator[Configuration]:
    for stiffness in stiffnesses:
        words = ", ".join(
            word for word in (f"{stiffness:.0e} N/m".replace("e+0", "e").replace("e+", "e"), label) if word
        )
        yield Configuration(OURS, words, {"start.K": stiffness}, "tolerance", _TOLERANCES, f"PeerScenes.{model}")


def _mujoco(label: str, values: Sequence[float] = _STEPS, **settings: float | str) -> Configuration:
    return Configuration("MuJoCo", label, settings, "step", values)


def _drake(label: str, values: Sequence[float], **settings: float | str) -> Configuration:
    swept = "step" if settings["integrator"] in ("sap", "lagged", "similar", "tamsi") else "accuracy"
    return Configuration("Drake", label, settings, swept, values)


def _bullet(label: str, values: Sequence[float] = _STEPS, **settings: float | str) -> Configuration:
    return Configuration("Bullet", label, settings, "step", values)


def _balls() -> tuple[Configuration, ...]:
    return (
        *_ours("BouncingBall", (1e6, 1e8, 1e10), "events"),
        *_ours("BouncingBallWithoutEvents", (1e10,), "no events"),
        _mujoco("Euler, 20 steps an impact", integrator="Euler", steps=20),
        _mujoco("RK4, 10 steps an impact", integrator="RK4", steps=10),
        _mujoco("RK4, 40 steps an impact", integrator="RK4", steps=40),
        _mujoco("RK4, 1e6 N/m", integrator="RK4", stiffness=1e6),
        _mujoco("discrete, 40 steps an impact", integrator="discrete", steps=40),
        _drake("RK3, 1e6 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e6),
        _drake("RK3, 1e8 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e8),
        _drake("RK3, 1e10 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e10),
        _drake("Bogacki-Shampine, 1e10 N/m", _ACCURACIES, integrator="bogacki_shampine3", stiffness=1e10),
        _drake("RK5, 1e8 N/m", _ACCURACIES, integrator="runge_kutta5", stiffness=1e8),
        _drake("CENIC, 1e6 N/m", _ACCURACIES, integrator="cenic", stiffness=1e6),
        _drake("discrete, lagged, 1e6 N/m", _FEW_STEPS, integrator="lagged", stiffness=1e6),
        _bullet("rigid"),
        _bullet("rigid, contacts from 1e-6 m", breaking=1e-6),
    )


def _boxes(model: str) -> tuple[Configuration, ...]:
    return (
        *_ours(model, (1e6, 1e8), "anchored"),
        *_ours(f"{model}Regularised", (1e8,), "regularised"),
        *_mujoco_friction(),
        _drake("RK3, points at corners", _ACCURACIES[:3], integrator="runge_kutta3", contact="corners", stiffness=1e6),
        _drake("CENIC, points at corners", _ACCURACIES, integrator="cenic", contact="corners", stiffness=1e6),
        _drake(
            "CENIC, points at corners, stiction 1e-6 m/s",
            _ACCURACIES,
            integrator="cenic",
            contact="corners",
            stiffness=1e6,
            stiction=1e-6,
        ),
        _drake("CENIC, hydroelastic", _ACCURACIES, integrator="cenic", contact="hydroelastic", stiffness=1e6),
        _drake(
            "implicit Euler, points", _ACCURACIES[:3], integrator="implicit_euler", contact="corners", stiffness=1e6
        ),
        _drake("discrete, SAP, points", _FEW_STEPS, integrator="sap", contact="corners", stiffness=1e6),
        _drake("discrete, TAMSI, points", _FEW_STEPS, integrator="tamsi", contact="corners", stiffness=1e6),
        _bullet("rigid"),
        _bullet("rigid, maximal coordinates", coordinates="maximal"),
        _bullet("rigid, contacts from 1e-6 m", breaking=1e-6),
    )


def _mujoco_friction() -> tuple[Configuration, ...]:
    return (
        _mujoco("Euler, elliptic", integrator="Euler", cone="elliptic"),
        _mujoco("Euler, elliptic, impratio 100", integrator="Euler", cone="elliptic", impratio=100),
        _mujoco("Euler, pyramidal", integrator="Euler", cone="pyramidal"),
        _mujoco("RK4, elliptic", integrator="RK4", cone="elliptic"),
        _mujoco("RK4, elliptic, 1e6 N/m", integrator="RK4", cone="elliptic", stiffness=1e6),
        _mujoco("discrete, elliptic", integrator="discrete", cone="elliptic"),
    )


def _rolling() -> tuple[Configuration, ...]:
    return (
        *_ours("RollingSphere", (1e6, 1e8)),
        *_mujoco_friction(),
        _drake("RK3, 1e6 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e6),
        _drake("CENIC, 1e6 N/m", _ACCURACIES, integrator="cenic", stiffness=1e6),
        _drake("implicit Euler, 1e6 N/m", _ACCURACIES[:3], integrator="implicit_euler", stiffness=1e6),
        _drake("discrete, SAP", _FEW_STEPS, integrator="sap", stiffness=1e6),
        _drake("discrete, TAMSI", _FEW_STEPS, integrator="tamsi", stiffness=1e6),
        _bullet("rigid"),
        _bullet("rigid, contacts from 1e-6 m", breaking=1e-6),
    )


def _stack() -> tuple[Configuration, ...]:
    return (
        *_ours("StackOfFive", (1e5, 1e6, 1e8)),
        _mujoco("Euler, elliptic", integrator="Euler", cone="elliptic"),
        _mujoco("Euler, pyramidal", integrator="Euler", cone="pyramidal"),
        _mujoco("RK4, elliptic", integrator="RK4", cone="elliptic"),
        _mujoco("Euler, elliptic, 1e6 N/m", integrator="Euler", cone="elliptic", stiffness=1e6),
        _mujoco("discrete, elliptic", integrator="discrete", cone="elliptic"),
        _drake("CENIC, hydroelastic, 1e6 N/m", _ACCURACIES, integrator="cenic", contact="hydroelastic", stiffness=1e6),
        _drake("CENIC, hydroelastic, 1e8 N/m", _ACCURACIES, integrator="cenic", contact="hydroelastic", stiffness=1e8),
        _drake("discrete, SAP, hydroelastic", _FEW_STEPS[:3], integrator="sap", contact="hydroelastic", stiffness=1e8),
        _drake(
            "discrete, TAMSI, hydroelastic", _FEW_STEPS[:3], integrator="tamsi", contact="hydroelastic", stiffness=1e8
        ),
        _bullet("rigid", _FEW_STEPS),
        _bullet("rigid, 300 iterations", _FEW_STEPS, iterations=300),
        _bullet("rigid, maximal coordinates", _FEW_STEPS, coordinates="maximal"),
    )


def _cradle() -> tuple[Configuration, ...]:
    return (
        *_ours("NewtonCradle", (1e6, 1e8, 1e10)),
        _mujoco("Euler, 20 steps an impact", _STEPS[2:], integrator="Euler", steps=20),
        _mujoco("RK4, 10 steps an impact", _STEPS[2:], integrator="RK4", steps=10),
        _mujoco("RK4, 40 steps an impact", _STEPS[2:], integrator="RK4", steps=40),
        _drake("RK3, 1e6 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e6),
        _drake("RK3, 1e8 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e8),
        _drake("RK3, 1e10 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e10),
        _drake("Bogacki-Shampine, 1e10 N/m", _ACCURACIES, integrator="bogacki_shampine3", stiffness=1e10),
        _drake("CENIC, 1e6 N/m", _ACCURACIES[:3], integrator="cenic", stiffness=1e6),
        _bullet("rigid", _STEPS[2:]),
        _bullet("rigid, contacts from 1e-6 m", _STEPS[2:], breaking=1e-6),
    )


def _rod() -> tuple[Configuration, ...]:
    return (
        *_ours("FallingRod", (1e6, 1e8)),
        _mujoco("Euler, 20 steps an oscillation", integrator="Euler"),
        _mujoco("RK4, 20 steps an oscillation", integrator="RK4"),
        _mujoco("RK4, 1e6 N/m", integrator="RK4", stiffness=1e6),
        _mujoco("discrete, 20 steps an oscillation", integrator="discrete"),
        _drake("RK3, 1e6 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e6),
        _drake("RK3, 1e8 N/m", _ACCURACIES, integrator="runge_kutta3", stiffness=1e8),
        _drake("CENIC, 1e6 N/m", _ACCURACIES, integrator="cenic", stiffness=1e6),
        _drake("discrete, SAP", _FEW_STEPS, integrator="sap", stiffness=1e6),
        _drake("discrete, TAMSI", _FEW_STEPS, integrator="tamsi", stiffness=1e6),
        _bullet("rigid"),
    )


def _dominoes() -> tuple[Configuration, ...]:
    return (
        *_ours("DominoRow", (1e5, 1e6)),
        _mujoco("Euler, elliptic", integrator="Euler", cone="elliptic"),
        _mujoco("RK4, elliptic", integrator="RK4", cone="elliptic"),
        _mujoco("Euler, elliptic, 1e4 N/m", integrator="Euler", cone="elliptic", stiffness=1e6),
        _mujoco("discrete, elliptic", integrator="discrete", cone="elliptic"),
        _drake("CENIC, hydroelastic, 1e5 N/m", _ACCURACIES, integrator="cenic", contact="hydroelastic", stiffness=1e5),
        _drake("discrete, SAP, hydroelastic", _FEW_STEPS, integrator="sap", contact="hydroelastic", stiffness=1e5),
        _drake("discrete, TAMSI, hydroelastic", _FEW_STEPS, integrator="tamsi", contact="hydroelastic", stiffness=1e5),
        _bullet("rigid"),
        _bullet("rigid, maximal coordinates", coordinates="maximal"),
    )


def _hexapod() -> tuple[Configuration, ...]:
    small = (5e-3, 2e-3, 1e-3, 5e-4, 1e-4)
    return (
        Configuration(OURS, "2e4 N/m", {}, "tolerance", (*_TOLERANCES[:5], 1e-7), "ReferenceModels.Hexapod.Walk"),
        _mujoco("Euler, default compliance", small, integrator="Euler", cone="elliptic", stiffness=2500),
        _mujoco("implicitfast, default compliance", small, integrator="implicitfast", cone="elliptic", stiffness=2500),
        _mujoco("Euler, 2e4 N/m", small, integrator="Euler", cone="elliptic", stiffness=2e4 / 1.3, damping_ratio=0.03),
        _mujoco("RK4, default compliance", (5e-4, 2e-4, 1e-4), integrator="RK4", cone="elliptic", stiffness=2500),
        _mujoco("discrete, default compliance", small, integrator="discrete", cone="elliptic", stiffness=2500),
        _drake("RK3", (1e-2, 1e-3), integrator="runge_kutta3", stiction=1e-2),
        _drake("CENIC", _ACCURACIES, integrator="cenic", stiction=1e-2),
        _drake("discrete, TAMSI", (2e-3, 1e-3, 5e-4, 2e-4), integrator="tamsi", stiction=1e-2),
        _drake("discrete, SAP", (5e-3, 2e-3, 1e-3), integrator="sap", stiction=1e-2),
        _bullet("rigid, servos by torque", (5e-4, 2e-4, 1e-4)),
    )


def _spheres() -> tuple[Configuration, ...]:
    steps = (1e-2, 5e-3, 2e-3, 1e-3, 5e-4)
    return (
        Configuration(OURS, "2e4 N/m", {}, "tolerance", (1e-2, 1e-3, 1e-4, 1e-5, 1e-6), "PeerScenes.HundredSpheres"),
        _mujoco("Euler, elliptic, 2e4 N/m", steps, integrator="Euler", cone="elliptic", stiffness=4e4),
        _mujoco("Euler, pyramidal, 2e4 N/m", steps, integrator="Euler", cone="pyramidal", stiffness=4e4),
        _mujoco("Euler, elliptic, 20 steps an impact", steps, integrator="Euler", cone="elliptic"),
        _drake("CENIC", _ACCURACIES[:3], integrator="cenic", stiffness=2e4),
        _drake("discrete, SAP", (1e-2, 5e-3, 2e-3), integrator="sap", stiffness=2e4),
        _drake("discrete, lagged", (1e-2, 5e-3, 2e-3), integrator="lagged", stiffness=2e4),
        _bullet("rigid", steps),
        _bullet("rigid, maximal coordinates", steps, coordinates="maximal"),
    )


CONFIGURATIONS: Final[Mapping[str, tuple[Configuration, ...]]] = {
    "ball, first apex": _balls(),
    "ball, three impacts": _balls(),
    "block that stops": _boxes("SlidingBlock"),
    "creep on an incline": _boxes("BoxOnIncline"),
    "rolling sphere": _rolling(),
    "stack of five boxes": _stack(),
    "Newton's cradle": _cradle(),
    "falling rod": _rod(),
    "row of dominoes": _dominoes(),
    "hexapod": _hexapod(),
    "hundred spheres": _spheres(),
}
"""By the scene's name."""
