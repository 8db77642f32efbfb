"""The mechanism as the generator knows it, in SI units, whatever it was read from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from pathlib import Path

import numpy as np
from contact_foundation.errors import Place

from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.mechanism.description_defaults import GRAVITY, STOP_TIME, TOLERANCE

GROUND = "ground"


def _at_rest() -> Array:
    return np.zeros(3)


class JointType(Enum):
    """Kinds of joints; the value is the name in the XML format."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    SCREW = "screw"
    CYLINDRICAL = "cylindrical"
    PLANAR = "planar"
    UNIVERSAL = "universal"
    SPHERICAL = "spherical"
    FIXED = "fixed"
    FREE = "free"

    @property
    def freedoms(self) -> int:
        """Degrees of freedom."""
        return _FREEDOMS[self]

    @property
    def is_scalar(self) -> bool:
        """Whether one coordinate with an axis to drive describes it; a screw's is its angle."""
        return self in (JointType.REVOLUTE, JointType.PRISMATIC, JointType.SCREW)

    @property
    def needs_axis(self) -> bool:
        """Whether an axis defines the joint."""
        return self not in (JointType.SPHERICAL, JointType.FIXED, JointType.FREE)


_FREEDOMS = {
    JointType.REVOLUTE: 1,
    JointType.PRISMATIC: 1,
    JointType.SCREW: 1,
    JointType.CYLINDRICAL: 2,
    JointType.PLANAR: 3,
    JointType.UNIVERSAL: 2,
    JointType.SPHERICAL: 3,
    JointType.FIXED: 0,
    JointType.FREE: 6,
}


class CollisionChoice(Enum):
    """How the shapes that collide are chosen for a part."""

    AUTO = "auto"
    BOX = "box"
    SPHERE = "sphere"
    CYLINDER = "cylinder"
    CONE = "cone"
    CAPSULE = "capsule"
    HULL = "hull"
    DECOMPOSITION = "decomposition"
    NONE = "none"


class Decomposer(Enum):
    """What splits concave bodies into convex pieces."""

    COACD = "coacd"
    VHACD = "vhacd"


@dataclass(frozen=True)
class DecompositionLimits:
    """How concave bodies are decomposed; None where nothing is said.

    Attributes:
        error: concavity a piece may keep, m.
        pieces: largest number of pieces of a body; counts before the error.
        triangles: largest number of triangles of a part whose bodies are decomposed unless the user asks for it.
        decomposer: what decomposes.
    """

    error: float | None = None
    pieces: int | None = None
    triangles: int | None = None
    decomposer: Decomposer | None = None

    def or_else(self, other: DecompositionLimits) -> DecompositionLimits:
        """These limits, and the other's where these say nothing."""
        return DecompositionLimits(
            self.error if self.error is not None else other.error,
            self.pieces if self.pieces is not None else other.pieces,
            self.triangles if self.triangles is not None else other.triangles,
            self.decomposer if self.decomposer is not None else other.decomposer,
        )


NO_LIMITS = DecompositionLimits()


@dataclass(frozen=True)
class Material:
    """What a material brings into a contact; None where the source says nothing. SI units."""

    name: str
    density: float | None = None
    youngs_modulus: float | None = None
    poissons_ratio: float | None = None
    restitution: float | None = None
    static_friction: float | None = None
    dynamic_friction: float | None = None


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass (kg), centre of mass (m, shape (3,)) and inertia about it (kg.m2, shape (3, 3)), in the part's axes."""

    mass: float
    center_of_mass: Array
    inertia: Array


@dataclass(frozen=True, eq=False)
class Part:
    """A rigid body.

    Attributes:
        name: unique in the assembly; "instance/part" for a part of an instance.
        pose: of the part's coordinate system in the world, in the start configuration.
        meshes: geometry in the part's coordinate system; empty if the source has none.
        velocity: of the origin at the start, in world axes, m/s; used where no joint holds the part.
        angular_velocity: at the start, in world axes, rad/s; used where no joint holds the part.
        place: where the part is described.
        collision_meshes: geometry that collides, where it is another than ``meshes``.
        decomposition: limits for this part; count before those of the assembly.
    """

    name: str
    material: str | None
    pose: Pose
    mass_properties: MassProperties
    meshes: tuple[Mesh, ...]
    collision: CollisionChoice
    grounded: bool
    velocity: Array = field(default_factory=_at_rest, kw_only=True)
    angular_velocity: Array = field(default_factory=_at_rest, kw_only=True)
    place: Place
    collision_meshes: tuple[Mesh, ...] | None = None
    decomposition: DecompositionLimits = NO_LIMITS


@dataclass(frozen=True)
class JointLimits:
    """Ends of a joint's range (rad or m; None: no end), and the stops there; None: the generator chooses.

    Attributes:
        stiffness: N.m/rad or N/m.
        damping: part of the elastic force that is added at unit speed inwards, s/rad or s/m.
    """

    lower: float | None
    upper: float | None
    stiffness: float | None = None
    damping: float | None = None


@dataclass(frozen=True)
class JointRating:
    """Largest effort (N.m, N) and speed (rad/s, m/s) of what drives a joint; None: nothing is said."""

    effort: float | None
    speed: float | None


@dataclass(frozen=True)
class JointFriction:
    """Viscous (N.m.s/rad, N.s/m) and dry friction (N.m, N)."""

    viscous: float
    dry: float


@dataclass(frozen=True)
class JointSpring:
    """A spring at a joint: stiffness (N.m/rad, N/m), and the coordinate where it is relaxed (rad, m)."""

    stiffness: float
    rest: float


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint, in the world's coordinates at the start.

    Attributes:
        parent: a part's name, or ``GROUND``.
        origin: a point on the axis, shape (3,), m.
        axis: unit vector; None where the type has no axis. A spherical joint in a loop has one, see ``spherical_axes``.
        second_axis: unit vector fixed in the child, universal joints, and spherical ones in loops.
        position: value of the coordinate in the start configuration, rad or m (revolute, screw, prismatic).
        speed: its rate, rad/s or m/s.
        velocity: of the child against the parent at the origin, world axes, m/s (other types).
        angular_velocity: of the child against the parent, world axes, rad/s (other types).
        pitch: way along the axis in one turn, m, screw joints only.
        limits, friction, rating, spring: None where nothing is said.
        rotor_inertia: of the drive's rotor, as the joint feels it through the gear: kg.m2, or kg.
        child_origin, child_axis: point and axis as the child has them, in the world's coordinates; None where the child
            says nothing.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Array
    axis: Array | None
    place: Place
    second_axis: Array | None = None
    position: float = 0.0
    speed: float = 0.0
    velocity: Array = field(default_factory=_at_rest)
    angular_velocity: Array = field(default_factory=_at_rest)
    pitch: float = 0.0
    limits: JointLimits | None = None
    friction: JointFriction | None = None
    child_origin: Array | None = None
    child_axis: Array | None = None
    rating: JointRating | None = None
    spring: JointSpring | None = None
    rotor_inertia: float = 0.0

    @property
    def has_resistance(self) -> bool:
        """Whether something acts along the joint's coordinate: stops, friction, a spring, or a rotor."""
        return (self.limits, self.friction, self.spring) != (None, None, None) or self.rotor_inertia > 0.0

    @property
    def is_turning(self) -> bool:
        """Whether the joint's coordinate is an angle."""
        return self.type in (JointType.REVOLUTE, JointType.SCREW)


@dataclass(frozen=True)
class Coupling:
    """A joint that follows another: its coordinate is ``ratio`` times the leader's plus ``offset`` (rad, m)."""

    follower: str
    leader: str
    ratio: float
    offset: float


@dataclass(frozen=True)
class Assignment:
    """One component of ContactMultiBody.Actuators at one joint.

    Attributes:
        joint: name in the assembly.
        component: name in the library, without its package.
        name: wanted name of the instance; None: made of joint and component.
        parameters: numbers and Booleans by name.
        inputs: start values of inputs by name.
    """

    joint: str
    component: str
    name: str | None = None
    parameters: dict[str, float | bool] = field(default_factory=dict)
    inputs: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane that bounds solid ground: a point of it and its unit normal out of the ground, world coordinates."""

    name: str
    material: str | None
    position: Array
    normal: Array
    place: Place


@dataclass(frozen=True)
class ContactSettings:
    """Which pairs may touch, by the names of parts and planes, and how.

    Attributes:
        stiffness: of every pair, N/m, linear law; None: by Hertz from the materials.
        friction: "none", "regularised" or "anchored"; None: the library's default.
        decomposition: limits for parts that have none of their own.
        friction_rule: how friction of two materials combines: "geometric mean", "minimum" or "maximum"; None: the
            library's default.
    """

    all_pairs: bool = True
    excluded: tuple[tuple[str, str], ...] = ()
    included: tuple[tuple[str, str], ...] = ()
    stiffness: float | None = None
    friction: str | None = None
    decomposition: DecompositionLimits = NO_LIMITS
    friction_rule: str | None = None


@dataclass(frozen=True, eq=False)
class Assembly:
    """A mechanism.

    Attributes:
        name: as the source has it.
        gravity: acceleration, world axes, m/s2.
        notes: what the user should know about how the source was read; each one line.
        length_unit: the source's unit of length, m.
        limits_stop: whether joints have stops at their limits unless the user says otherwise.
        couplings: joints with one coordinate that follow others, none of them in a loop.
        drives: components at joints that the source itself names; a file of actuators counts instead.
        aliases: names that the source has beside those of parts, and the part (or ``GROUND``) that each belongs to.
    """

    name: str
    source: str
    file: Path
    parts: tuple[Part, ...]
    joints: tuple[Joint, ...]
    description: str = ""
    gravity: Array = field(default_factory=lambda: np.array(GRAVITY))
    stop_time: float = STOP_TIME
    tolerance: float = TOLERANCE
    materials: tuple[Material, ...] = ()
    planes: tuple[Plane, ...] = ()
    contacts: ContactSettings = field(default_factory=ContactSettings)
    notes: tuple[str, ...] = ()
    length_unit: float = 1.0
    limits_stop: bool = True
    couplings: tuple[Coupling, ...] = ()
    aliases: Mapping[str, str] = field(default_factory=dict)
    drives: tuple[Assignment, ...] = ()

    @cached_property
    def _by_name(self) -> dict[str, Part]:
        return {part.name: part for part in self.parts}

    def part(self, name: str) -> Part:
        """The part of that name.

        Raises:
            KeyError: there is none.
        """
        return self._by_name[name]
