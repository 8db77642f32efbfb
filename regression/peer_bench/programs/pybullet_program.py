"""Bullet, by pybullet: rigid contacts with fixed steps."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from importlib import metadata
from typing import Final

import numpy as np
import pybullet
from pybullet_utils.bullet_client import BulletClient

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
    servo_targets,
)
from peer_bench.programs.simulation import Settings, Simulation, whole_steps
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

VERSION: Final = metadata.version("pybullet")


def simulation(scene: Scene, settings: Settings) -> Simulation:
    """A scene with settings.

    Args:
        scene: which.
        settings: step (s), iterations, erp, coordinates (reduced or maximal), stiffness (N/m; rigid where left out).
    """
    return (
        _FreeBodies(scene, scene.world, settings)
        if scene.world is not None
        else _MECHANISMS[scene.name](scene, settings)
    )


class _Client:
    """A physics server in this process."""

    def __init__(self, scene: Scene, settings: Settings) -> None:
        self.scene, self.settings = scene, settings
        self.client = BulletClient(pybullet.DIRECT)
        interval = scene.stop / scene.intervals
        self._steps = whole_steps(interval, float(settings["step"]))
        self.client.setPhysicsEngineParameter(
            fixedTimeStep=interval / self._steps,
            numSolverIterations=int(settings.get("iterations", 50)),
            numSubSteps=0,
            contactERP=float(settings.get("erp", 0.2)),
            restitutionVelocityThreshold=0.0,
            solverResidualThreshold=0.0,
            contactBreakingThreshold=float(settings.get("breaking", 0.02)),
            deterministicOverlappingPairs=1,
        )
        self._count = 0

    def advance(self, until: float) -> None:
        """Takes the steps of an interval."""
        del until
        step = self.client.stepSimulation
        for _ in range(self._steps):
            step()
        self._count += self._steps

    def values(self) -> list[float]:
        """What is compared."""
        raise NotImplementedError

    def work(self) -> dict[str, float]:
        """Steps."""
        return {"steps": self._count}

    def close(self) -> None:
        """Ends the server."""
        self.client.disconnect()

    def surface(self, body: int, link: int, friction: float, restitution: float) -> None:
        """The surface of a link, without the damping that Bullet gives by default."""
        self.client.changeDynamics(
            body,
            link,
            lateralFriction=friction,
            spinningFriction=0.0,
            rollingFriction=0.0,
            restitution=restitution,
            linearDamping=0.0,
            angularDamping=0.0,
            jointDamping=0.0,
            maxJointVelocity=1e6,
        )


class _FreeBodies(_Client):
    def __init__(self, scene: Scene, world: World, settings: Settings) -> None:
        super().__init__(scene, settings)
        client = self.client
        client.setGravity(*world.gravity)
        # Bullet multiplies the coefficients of the two bodies.
        friction, restitution = math.sqrt(world.friction), math.sqrt(world.restitution)
        floor = client.createMultiBody(0.0, client.createCollisionShape(pybullet.GEOM_PLANE))
        self.surface(floor, -1, friction, restitution)
        self._bodies = []
        for body in world.bodies:
            turn = (0.0, math.sin(body.tilt / 2), 0.0, math.cos(body.tilt / 2))
            made = client.createMultiBody(
                body.mass,
                self._shape(body),
                -1,
                body.position,
                turn,
                useMaximalCoordinates=settings.get("coordinates") == "maximal",
            )
            self.surface(made, -1, friction, restitution)
            if settings.get("coordinates") != "maximal":  # those have the inertia of their shape, and take no other
                client.changeDynamics(made, -1, localInertiaDiagonal=body.inertia)
            client.resetBaseVelocity(made, body.velocity, body.spin)
            self._bodies.append(made)

    def _shape(self, body: Body) -> int:
        client = self.client
        if body.shape == "sphere":
            return int(client.createCollisionShape(pybullet.GEOM_SPHERE, radius=body.size[0]))
        if body.shape == "box":
            return int(client.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[edge / 2 for edge in body.size]))
        return int(client.createCollisionShape(pybullet.GEOM_CAPSULE, radius=body.size[0], height=body.size[1]))

    def values(self) -> list[float]:
        """The coordinates that are compared."""
        at = self.client.getBasePositionAndOrientation
        return self.scene.seen(np.array([at(body)[0] for body in self._bodies]))


class _Cradle(_Client):
    def __init__(self, scene: Scene, settings: Settings) -> None:
        super().__init__(scene, settings)
        client = self.client
        client.setGravity(0.0, 0.0, -9.81)
        place = [0.0, 0.0, -CRADLE_LENGTH]
        shape = client.createCollisionShape(pybullet.GEOM_SPHERE, radius=CRADLE_RADIUS, collisionFramePosition=place)
        inertia = 3 * (0.4 * CRADLE_MASS * CRADLE_RADIUS**2,)
        self._strings = []
        for k in range(CRADLE_BALLS):
            string = client.createMultiBody(
                0.0,
                -1,
                -1,
                [k * (2 * CRADLE_RADIUS + CRADLE_GAP), 0.0, 0.0],
                linkMasses=[CRADLE_MASS],
                linkCollisionShapeIndices=[shape],
                linkVisualShapeIndices=[-1],
                linkPositions=[[0.0, 0.0, 0.0]],
                linkOrientations=[[0.0, 0.0, 0.0, 1.0]],
                linkInertialFramePositions=[place],
                linkInertialFrameOrientations=[[0.0, 0.0, 0.0, 1.0]],
                linkParentIndices=[0],
                linkJointTypes=[pybullet.JOINT_REVOLUTE],
                linkJointAxis=[[0.0, 1.0, 0.0]],
            )
            self.surface(string, 0, 0.0, 1.0)
            client.changeDynamics(string, 0, localInertiaDiagonal=inertia)
            client.setJointMotorControl2(string, 0, pybullet.VELOCITY_CONTROL, force=0.0)
            client.resetJointState(string, 0, CRADLE_START if k == 0 else 0.0)
            self._strings.append(string)

    def values(self) -> list[float]:
        """The strings' angles."""
        return [float(self.client.getJointState(string, 0)[0]) for string in self._strings]


class _Hexapod(_Client):
    """Servos by torques, set from Python before every step; their damping is the joints' own."""

    def __init__(self, scene: Scene, settings: Settings) -> None:
        super().__init__(scene, settings)
        client = self.client
        client.setGravity(0.0, 0.0, -9.81)
        friction = math.sqrt(FOOT_FRICTION)
        floor = client.createMultiBody(0.0, client.createCollisionShape(pybullet.GEOM_PLANE))
        self.surface(floor, -1, friction, 0.0)
        place = [0.0, 0.0, FOOT_RADIUS - FOOT_OFFSET]
        foot = client.createCollisionShape(pybullet.GEOM_SPHERE, radius=FOOT_RADIUS, collisionFramePosition=place)
        links = [(link, number) for leg in LEGS for number, link in enumerate(leg.links)]
        self._robot = client.createMultiBody(
            TORSO_MASS,
            -1,
            -1,
            [0.0, 0.0, TORSO_HEIGHT],
            linkMasses=[link.mass for link, _ in links],
            linkCollisionShapeIndices=[foot if number == 2 else -1 for _, number in links],
            linkVisualShapeIndices=[-1] * len(links),
            linkPositions=[link.origin for link, _ in links],
            linkOrientations=[[0.0, 0.0, 0.0, 1.0]] * len(links),
            linkInertialFramePositions=[link.centre for link, _ in links],
            linkInertialFrameOrientations=[[0.0, 0.0, 0.0, 1.0]] * len(links),
            linkParentIndices=[0 if number == 0 else k for k, (_, number) in enumerate(links)],
            linkJointTypes=[pybullet.JOINT_REVOLUTE] * len(links),
            linkJointAxis=[link.axis for link, _ in links],
        )
        self._joints = list(range(len(links)))
        client.changeDynamics(
            self._robot, -1, localInertiaDiagonal=TORSO_INERTIA, linearDamping=0.0, angularDamping=0.0
        )
        for k, (link, _) in enumerate(links):
            self.surface(self._robot, k, friction, 0.0)
            client.changeDynamics(self._robot, k, localInertiaDiagonal=link.inertia, jointDamping=HEXAPOD_DAMPING)
            client.setJointMotorControl2(self._robot, k, pybullet.VELOCITY_CONTROL, force=0.0)
        step = scene.stop / scene.intervals / self._steps
        times = step * np.arange(self._steps * scene.intervals)
        self._targets = np.array([servo_targets(time) for time in times.tolist()])

    def advance(self, until: float) -> None:
        """Takes the steps of an interval."""
        del until
        client, robot, joints = self.client, self._robot, self._joints
        for targets in self._targets[self._count : self._count + self._steps]:
            angles = np.array([state[0] for state in client.getJointStates(robot, joints)])
            torques = HEXAPOD_STIFFNESS * (targets - angles)
            client.setJointMotorControlArray(robot, joints, pybullet.TORQUE_CONTROL, forces=torques)
            client.stepSimulation()
        self._count += self._steps

    def values(self) -> list[float]:
        """The position of the torso."""
        return [float(value) for value in self.client.getBasePositionAndOrientation(self._robot)[0]]


_MECHANISMS: Final[Mapping[str, Callable[[Scene, Settings], Simulation]]] = {
    "Newton's cradle": _Cradle,
    "hexapod": _Hexapod,
}
