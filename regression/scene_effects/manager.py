"""What an FMU shows of its ContactManager: choices, bodies, pairs, parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from contact_foundation.errors import InputError, Place
from fmu_regression.fmi.description import ModelDescription
from fmu_regression.results.result import SimulationResult

from scene_effects.choices import Friction, Restitution

_FRICTIONS = (Friction.NONE, Friction.REGULARISED, Friction.ANCHORED)
_SPRING_DAMPER = 10
_MEMORYLESS = 2
PAIR_PARAMETERS = (
    "contactRadius",
    "stiffness",
    "damping",
    "restitution",
    "effectiveMass",
    "steadyRate",
    "muStatic",
    "muDynamic",
    "frictionStiffness",
    "spinRadius",
    "rollingLever",
)
"""Parameters of a ContactManager that have one number for each pair."""
_SCALARS = ("restSpeed", "regularisationSpeed", "turningRegularisationSpeed")


@dataclass(frozen=True)
class ContactBody:
    """A body of a manager.

    Attributes:
        name: of its component, or "body 3" where it cannot be told.
        shapes: kinds of its shapes, e.g. ("sphere",).
        mass_variable: name of its mass in the FMU, or None if it has none, as what is fixed in the world.
    """

    name: str
    shapes: tuple[str, ...]
    mass_variable: str | None


@dataclass(frozen=True)
class Manager:
    """A ContactManager as the model has it.

    Attributes:
        name: of the component.
        bodies: in the manager's order.
        pairs: bodies of each pair, numbers from 1.
        friction: the law chosen.
        restitution: how it is delivered; NONE for a law that does not regard it.
        regards_restitution: False for the law SpringDamper.
        turning: whether spin and rolling friction are on.
        point_capacity: largest number of points of a pair.
    """

    name: str
    bodies: tuple[ContactBody, ...]
    pairs: tuple[tuple[int, int], ...]
    friction: Friction
    restitution: Restitution
    regards_restitution: bool
    turning: bool
    point_capacity: int

    def pair_label(self, pair: int) -> str:
        """Names of the bodies of a pair, counted from 0."""
        a, b = self.pairs[pair]
        return f"{self.bodies[a - 1].name} – {self.bodies[b - 1].name}"

    def parameter_signals(self) -> list[str]:
        """Names of the parameters that ``read_parameters`` needs."""
        names = [f"{self.name}.{p}[{i + 1}]" for p in PAIR_PARAMETERS for i in range(len(self.pairs))]
        names += [f"{self.name}.{name}" for name in _SCALARS]
        return names + [body.mass_variable for body in self.bodies if body.mass_variable is not None]

    def motion_signals(self) -> list[str]:
        """Names of the positions and rotations of all bodies."""
        return [name for i in range(len(self.bodies)) for name in (*self.position(i), *self.rotation(i))]

    def position(self, body: int) -> list[str]:
        """Names of a body's position, world axes; bodies count from 0."""
        return [f"{self.name}.frame[{body + 1}].r_0[{k}]" for k in (1, 2, 3)]

    def rotation(self, body: int) -> list[str]:
        """Names of the elements of a body's T, row by row."""
        return [f"{self.name}.frame[{body + 1}].R.T[{j},{k}]" for j in (1, 2, 3) for k in (1, 2, 3)]


@dataclass(frozen=True)
class Parameters:
    """Values of a manager's parameters.

    Attributes:
        pair: name to a number for each pair, for each of PAIR_PARAMETERS.
        rest_speed, regularisation_speed: m/s.
        turning_regularisation_speed: rad/s.
        masses: kg of each body; infinite for what is fixed.
    """

    pair: Mapping[str, tuple[float, ...]]
    rest_speed: float
    regularisation_speed: float
    turning_regularisation_speed: float
    masses: tuple[float, ...]


def find_manager(description: ModelDescription, name: str | None = None) -> Manager:
    """The ContactManager of an FMU.

    Args:
        description: of the FMU.
        name: of the manager's component; needed only where there are several.

    Raises:
        InputError: there is none, or none of that name, or several and no name.
    """
    known = description.variables
    found = [v[: -len(".catchImpacts")] for v in known if v.endswith(".catchImpacts")]
    found = [manager for manager in found if f"{manager}.geometry[1]" in known]
    place = Place(component=description.name)
    if not found:
        raise InputError("the model has no ContactMultiBody.ContactManager", place=place)
    if name is not None and name not in found:
        raise InputError(f"{name} is no ContactManager", place=place, remedy=f"it has {', '.join(found)}")
    if name is None and len(found) > 1:
        raise InputError(
            f"the model has several managers: {', '.join(found)}", place=place, remedy="name one with --manager"
        )
    manager = name or found[0]

    def value(parameter: str) -> str:
        return known[f"{manager}.{parameter}"].start or ""

    regards = int(value("normalLaw")) != _SPRING_DAMPER
    if not regards or value("useRestitution") != "true":
        restitution = Restitution.NONE
    else:
        memoryless = int(value("restitutionMethod")) == _MEMORYLESS
        restitution = Restitution.MEMORYLESS if memoryless else Restitution.BY_EVENT
    return Manager(
        name=manager,
        bodies=tuple(_body(description, manager, i + 1) for i in range(int(value("n")))),
        pairs=tuple((int(value(f"pair[{i + 1},1]")), int(value(f"pair[{i + 1},2]"))) for i in range(int(value("m")))),
        friction=_FRICTIONS[int(value("friction")) - 1],
        restitution=restitution,
        regards_restitution=regards,
        turning=value("useTurningFriction") == "true",
        point_capacity=int(value("pointCapacity")),
    )


def read_parameters(manager: Manager, result: SimulationResult) -> Parameters:
    """The parameters' values from a simulation that recorded ``manager.parameter_signals()``."""

    def number(name: str) -> float:
        return float(result[name][0])

    pairs = range(1, len(manager.pairs) + 1)
    return Parameters(
        pair={p: tuple(number(f"{manager.name}.{p}[{i}]") for i in pairs) for p in PAIR_PARAMETERS},
        rest_speed=number(f"{manager.name}.restSpeed"),
        regularisation_speed=number(f"{manager.name}.regularisationSpeed"),
        turning_regularisation_speed=number(f"{manager.name}.turningRegularisationSpeed"),
        masses=tuple(
            float("inf") if body.mass_variable is None else number(body.mass_variable) for body in manager.bodies
        ),
    )


def _body(description: ModelDescription, manager: str, number: int) -> ContactBody:
    """A body, named after the one component with the same descriptor and, where several have it, the same frame."""
    known = description.variables
    descriptor = known[f"{manager}.geometry[{number}]"].start or ""
    kinds = tuple(part.split()[1] for part in descriptor.split(";") if len(part.split()) > 1)
    frame = [known[f"{manager}.frame[{number}].r_0[{k}]"].reference for k in (1, 2, 3)]
    owners = [
        name[: -len(".geometry")]
        for name, variable in known.items()
        if name.endswith(".geometry") and variable.start == descriptor
    ]
    if len(owners) > 1:
        owners = [owner for owner in owners if _frame_references(description, owner) == frame]
    if len(owners) != 1:
        return ContactBody(f"body {number}", kinds, None)
    mass = next((m for m in (f"{owners[0]}.m", f"{owners[0]}.body.m") if m in known), None)
    return ContactBody(owners[0], kinds, mass)


def _frame_references(description: ModelDescription, component: str) -> list[int]:
    """Value references of the position of a component's frame_a; variables that are always equal share theirs."""
    names = [f"{component}.frame_a.r_0[{k}]" for k in (1, 2, 3)]
    return [description.variables[name].reference for name in names if name in description.variables]
