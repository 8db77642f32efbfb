"""Drake: discrete, error-controlled and fixed-step continuous simulation of a ``MultibodyPlant``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import metadata
from itertools import product
from typing import Any, Final

import numpy as np
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddContactMaterial,
    AddRigidHydroelasticProperties,
    Box,
    Capsule,
    HalfSpace,
    ProximityProperties,
    Sphere,
)
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import (
    AddMultibodyPlantSceneGraph,
    ContactModel,
    CoulombFriction,
    DiscreteContactApproximation,
)
from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint, RotationalInertia, SpatialInertia, UnitInertia
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import Adder, MatrixGain, TrajectorySource
from pydrake.trajectories import PiecewisePolynomial

from peer_bench.programs.mechanisms import (
    FOOT_DISSIPATION,
    FOOT_FRICTION,
    FOOT_OFFSET,
    FOOT_RADIUS,
    FOOT_STIFFNESS,
    HEXAPOD_DAMPING,
    HEXAPOD_STIFFNESS,
    LEGS,
    TORSO_HEIGHT,
    TORSO_INERTIA,
    TORSO_MASS,
    servo_targets,
)
from peer_bench.programs.simulation import Settings, Simulation, whole_steps
from peer_bench.restitution import hunt_crossley_damping
from peer_bench.scenes import (
    CRADLE_BALLS,
    CRADLE_GAP,
    CRADLE_LENGTH,
    CRADLE_MASS,
    CRADLE_RADIUS,
    CRADLE_START,
    Body,
    Scene,
    Vector,
    World,
)

VERSION: Final = metadata.version("drake")
_CORNER: Final = 1e-6
"""Radius of the spheres that stand for the corners of a box, m."""
_TARGETS: Final = 1e-3
"""Between the points through which the servos' targets are splined, s."""
_WHOLLY_INELASTIC: Final = 50.0
"""Dissipation where no restitution is wanted, s/m."""
_APPROXIMATIONS: Final = {
    "sap": DiscreteContactApproximation.kSap,
    "lagged": DiscreteContactApproximation.kLagged,
    "similar": DiscreteContactApproximation.kSimilar,
    "tamsi": DiscreteContactApproximation.kTamsi,
}


def simulation(scene: Scene, settings: Settings) -> Simulation:
    """A scene with settings.

    Args:
        scene: which.
        settings: integrator (a scheme of Drake, or the approximation of a discrete contact solver), accuracy or step;
            contact (point, corners or hydroelastic), stiffness (N/m of a contact), stiction (m/s).
    """
    return (
        _FreeBodies(scene, scene.world, settings)
        if scene.world is not None
        else _MECHANISMS[scene.name](scene, settings)
    )


class _Diagram:
    """A plant in a diagram, and its simulator."""

    def __init__(self, scene: Scene, settings: Settings) -> None:
        self.scene, self.settings = scene, settings
        self.integrator = str(settings["integrator"])
        interval = scene.stop / scene.intervals
        self.step = interval / whole_steps(interval, float(settings["step"])) if "step" in settings else 0.0
        discrete = self.integrator in _APPROXIMATIONS
        self.builder = DiagramBuilder()
        self.plant, self.scene_graph = AddMultibodyPlantSceneGraph(self.builder, self.step if discrete else 0.0)
        if discrete:
            self.plant.set_discrete_contact_approximation(_APPROXIMATIONS[self.integrator])
        self.plant.set_stiction_tolerance(float(settings.get("stiction", 1e-4)))
        hydroelastic = settings.get("contact") == "hydroelastic"
        self.plant.set_contact_model(ContactModel.kHydroelasticWithFallback if hydroelastic else ContactModel.kPoint)

    def start(self) -> Any:
        """Finalizes the plant and makes the simulator; the plant's context, to be given its start."""
        self.plant.Finalize()
        self.finish_plant()
        self.diagram = self.builder.Build()
        self.simulator = Simulator(self.diagram)
        if self.integrator not in _APPROXIMATIONS:
            chosen = ResetIntegratorFromFlags(self.simulator, self.integrator, self.step or 0.1)
            if self.step:
                chosen.set_fixed_step_mode(True)
            else:
                chosen.set_fixed_step_mode(False)
                chosen.set_target_accuracy(float(self.settings["accuracy"]))
                chosen.set_throw_on_minimum_step_size_violation(False)
        return self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())

    def finish_plant(self) -> None:
        """What belongs to the diagram beside the plant."""

    def initialize(self) -> None:
        """Initializes the simulator; the context has its start."""
        self.simulator.Initialize()
        self._context = self.plant.GetMyContextFromRoot(self.simulator.get_context())

    def advance(self, until: float) -> None:
        """Simulates until a time."""
        self.simulator.AdvanceTo(until)

    def values(self) -> list[float]:
        """The positions of the joints."""
        return [float(value) for value in self.plant.GetPositions(self._context)]

    def work(self) -> dict[str, float]:
        """Steps, and of an integrator its evaluations."""
        if self.integrator in _APPROXIMATIONS:
            return {"steps": self.simulator.get_num_steps_taken()}
        chosen = self.simulator.get_integrator()
        return {"steps": chosen.get_num_steps_taken(), "evaluations": chosen.get_num_derivative_evaluations()}

    def close(self) -> None:
        """Nothing is held."""

    def material(self, restitution: float, speed: float, friction: float, body: Body | None = None) -> Any:
        """Properties of contacts, of the floor where no body is given."""
        properties = ProximityProperties()
        stiffness = float(self.settings.get("stiffness", 1e6))
        dissipation = hunt_crossley_damping(restitution, speed) if restitution > 0 else _WHOLLY_INELASTIC
        points = 4 if self.settings.get("contact") == "corners" and body is not None else 1
        AddContactMaterial(dissipation, 2 * stiffness / points, CoulombFriction(friction, friction), properties)
        if self.settings.get("contact") == "hydroelastic":
            if body is None:
                AddRigidHydroelasticProperties(1.0, properties)
            else:
                AddCompliantHydroelasticProperties(1.0, _modulus(body, stiffness), properties)
        return properties


class _FreeBodies(_Diagram):
    def __init__(self, scene: Scene, world: World, settings: Settings) -> None:
        super().__init__(scene, settings)
        plant = self.plant
        plant.mutable_gravity_field().set_gravity_vector(world.gravity)
        law = (world.restitution, world.impact_speed, world.friction)
        plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(), HalfSpace(), "floor", self.material(*law))
        self._bodies = []
        for k, body in enumerate(world.bodies):
            inertia = SpatialInertia(
                body.mass, np.zeros(3), UnitInertia(*(value / body.mass for value in body.inertia))
            )
            added = plant.AddRigidBody(f"body{k}", inertia)
            for j, (place, shape) in enumerate(_shapes(body, str(settings.get("contact", "point")))):
                plant.RegisterCollisionGeometry(added, place, shape, f"shape{k}.{j}", self.material(*law, body))
            self._bodies.append(added)
        context = self.start()
        for added, body in zip(self._bodies, world.bodies, strict=True):
            pose = RigidTransform(RollPitchYaw(0.0, body.tilt, 0.0), body.position)
            plant.SetFreeBodyPose(context, added, pose)
            plant.SetFreeBodySpatialVelocity(context, added, SpatialVelocity(body.spin, body.velocity))
        self.initialize()

    def values(self) -> list[float]:
        """The coordinates that are compared."""
        found = np.asarray(self.plant.GetPositions(self._context)).reshape(-1, 7)[:, 4:]
        return self.scene.seen(found)


def _shapes(body: Body, contact: str) -> list[tuple[Any, Any]]:
    here = RigidTransform()
    if body.shape == "sphere":
        return [(here, Sphere(body.size[0]))]
    if body.shape == "capsule":
        return [(here, Capsule(body.size[0], body.size[1]))]
    if contact != "corners":
        return [(here, Box(*body.size))]
    half = np.array(body.size) / 2 - _CORNER
    return [(RigidTransform(half * np.array(signs)), Sphere(_CORNER)) for signs in product((-1, 1), repeat=3)]


def _modulus(body: Body, stiffness: float) -> float:
    """Of a body whose lower face is to carry with a stiffness, Pa: a box of edges a, b, c has E a b/(c/2)."""
    if body.shape != "box":
        return stiffness / body.size[0]
    depth = min(body.size) / 2
    return stiffness * depth / (body.size[0] * body.size[1])


class _Cradle(_Diagram):
    def __init__(self, scene: Scene, settings: Settings) -> None:
        super().__init__(scene, settings)
        inertia = SpatialInertia(
            CRADLE_MASS,
            np.array([0.0, 0.0, -CRADLE_LENGTH]),
            UnitInertia(*(3 * (0.4 * CRADLE_RADIUS**2,))).ShiftFromCenterOfMass(np.array([0.0, 0.0, -CRADLE_LENGTH])),
        )
        centre = RigidTransform([0.0, 0.0, -CRADLE_LENGTH])
        joints = []
        for k in range(CRADLE_BALLS):
            ball = self.plant.AddRigidBody(f"ball{k}", inertia)
            hook = RigidTransform([k * (2 * CRADLE_RADIUS + CRADLE_GAP), 0.0, 0.0])
            joints.append(
                self.plant.AddJoint(
                    RevoluteJoint(
                        f"string{k}",
                        self.plant.AddFrame(FixedOffsetFrame(f"hook{k}", self.plant.world_frame(), hook)),
                        ball.body_frame(),
                        [0, 1, 0],
                    )
                )
            )
            self.plant.RegisterCollisionGeometry(
                ball, centre, Sphere(CRADLE_RADIUS), f"ball{k}", self.material(1.0, 1.0, 0.0)
            )
        context = self.start()
        joints[0].set_angle(context, CRADLE_START)
        self.initialize()


class _Hexapod(_Diagram):
    """Servos of native blocks; their damping is the joints' own, which discrete solvers treat implicitly."""

    def __init__(self, scene: Scene, settings: Settings) -> None:
        super().__init__(scene, settings)
        plant = self.plant
        plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -9.81])
        properties = ProximityProperties()
        friction = CoulombFriction(FOOT_FRICTION, FOOT_FRICTION)
        AddContactMaterial(FOOT_DISSIPATION, 2 * FOOT_STIFFNESS, friction, properties)
        plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(), HalfSpace(), "floor", properties)
        torso = plant.AddRigidBody("torso", _inertia(TORSO_MASS, (0.0, 0.0, 0.0), TORSO_INERTIA))
        self._joints: list[Any] = []
        foot = RigidTransform([0.0, 0.0, FOOT_RADIUS - FOOT_OFFSET])
        for leg in LEGS:
            before = torso
            for link in leg.links:
                name = f"link{len(self._joints)}"
                body = plant.AddRigidBody(name, _inertia(link.mass, link.centre, link.inertia))
                place = plant.AddFrame(
                    FixedOffsetFrame(f"place{name}", before.body_frame(), RigidTransform(link.origin))
                )
                joint = RevoluteJoint(f"joint{name}", place, body.body_frame(), link.axis, damping=HEXAPOD_DAMPING)
                self._joints.append(plant.AddJoint(joint))
                plant.AddJointActuator(name, self._joints[-1])
                before = body
            plant.RegisterCollisionGeometry(before, foot, Sphere(FOOT_RADIUS), f"foot{name}", properties)
        context = self.start()
        plant.SetFreeBodyPose(context, torso, RigidTransform([0.0, 0.0, TORSO_HEIGHT]))
        self._torso = torso
        self.initialize()

    def finish_plant(self) -> None:
        """Torques of the servos: stiffness times what is left to the target."""
        plant, count = self.plant, len(self._joints)
        times = np.arange(0.0, self.scene.stop + 2 * _TARGETS, _TARGETS)
        targets = HEXAPOD_STIFFNESS * np.array([servo_targets(time) for time in times.tolist()]).T
        path = PiecewisePolynomial.CubicShapePreserving(times, targets)
        source = self.builder.AddSystem(TrajectorySource(path))
        pick = np.zeros((count, plant.num_multibody_states()))
        for k, joint in enumerate(self._joints):
            pick[k, joint.position_start()] = -HEXAPOD_STIFFNESS
        gain = self.builder.AddSystem(MatrixGain(pick))
        adder = self.builder.AddSystem(Adder(2, count))
        self.builder.Connect(source.get_output_port(), adder.get_input_port(0))
        self.builder.Connect(plant.get_state_output_port(), gain.get_input_port())
        self.builder.Connect(gain.get_output_port(), adder.get_input_port(1))
        self.builder.Connect(adder.get_output_port(), plant.get_actuation_input_port())

    def values(self) -> list[float]:
        """The position of the torso."""
        return [float(value) for value in self.plant.GetFreeBodyPose(self._context, self._torso).translation()]


def _inertia(mass: float, centre: Vector, moments: Vector) -> Any:
    """Of a body with moments about its centre."""
    return SpatialInertia.MakeFromCentralInertia(mass, np.array(centre), RotationalInertia(*moments))


_MECHANISMS: Final[Mapping[str, Callable[[Scene, Settings], Simulation]]] = {
    "Newton's cradle": _Cradle,
    "hexapod": _Hexapod,
}
