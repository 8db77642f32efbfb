"""Builds the mechanical model: bodies, joints, ground and contacts as components and connections."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.emit.joint_placement import JointPlacement
from cad2modelica.emit.mechanism_draft import MechanismDraft
from cad2modelica.geometry.spatial import IDENTITY, Array, Pose, cardan_angles
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.kinematics.start_motion import start_motion
from cad2modelica.mechanism.mass_check import check_moments
from cad2modelica.mechanism.model import GROUND, Assembly, JointType, Part, Plane
from cad2modelica.modelica.text import number, tidy_length, vector
from cad2modelica.modelica.view import ContactView, MechanismView

EXACT_WITHIN = 0.02  # of the smallest colliding part's radius: distances are exact up to such a gap between bounds


def mechanism_view(
    assembly: Assembly,
    tree: KinematicTree,
    loops: LoopAnalysis,
    geometries: dict[str, CollisionGeometry],
    pairs: list[tuple[str, str]],
    *,
    clearances: bool = False,
    compiled: bool = False,
) -> MechanismView:
    """Builds the components and connections of the mechanical model.

    Args:
        assembly: the mechanism.
        tree: its spanning tree.
        loops: what its loops ask of the joints.
        geometries: collision shapes by part.
        pairs: pairs of part and plane names that may touch.
        clearances: whether distances of bodies apart are exact.
        compiled: whether contacts are those of a CompiledContactManager, which has no distances.
    """
    exact_within = None if clearances or compiled else _exact_within(geometries)
    return _Builder(assembly, tree, loops, geometries, pairs, exact_within, compiled).build()


class _Builder:
    def __init__(
        self,
        assembly: Assembly,
        tree: KinematicTree,
        loops: LoopAnalysis,
        geometries: dict[str, CollisionGeometry],
        pairs: list[tuple[str, str]],
        exact_within: float | None,
        compiled: bool,
    ) -> None:
        self._assembly = assembly
        self._tree = tree
        self._loops = loops
        self._geometries = geometries
        self._pairs = pairs
        self._exact_within = exact_within
        self._compiled = compiled
        strength = float(np.linalg.norm(assembly.gravity))
        view = MechanismView(
            gravity=strength,
            gravity_direction=assembly.gravity / strength if strength > 0 else np.array([0.0, 0.0, -1.0]),
        )
        self._draft = MechanismDraft(view)
        self._joints = JointPlacement(assembly, tree, loops, self._draft)

    def build(self) -> MechanismView:
        view = self._draft.view
        # Names first: parts and joints have priority over helpers, in the order of the source.
        view.part_names = {part.name: self._draft.names.instance(part.name) for part in self._assembly.parts}
        view.joint_names = {
            joint.name: self._draft.names.instance(joint.name, "joint")
            for joint in self._assembly.joints
            if joint.type is not JointType.FREE
        }
        view.plane_names = {
            plane.name: self._draft.names.instance(plane.name, "plane") for plane in self._assembly.planes
        }
        view.material_names = {
            material.name: self._draft.names.instance(material.name, "material")
            for material in self._assembly.materials
        }
        for branch in self._tree.branches:
            if branch.predecessor in (None, GROUND):
                self._add_tree(branch.part.name)
        for joint in self._tree.cut_joints:
            self._joints.add_cut_joint(joint)
        for plane in self._assembly.planes:
            self._add_plane(plane)
        self._add_contacts()
        return view

    def _add_tree(self, root: str) -> None:
        """Adds a root part and all that hangs on it, depth first.

        Bodies hang under their chain; the first child of a part continues its line, each other one begins a new line.
        """
        branch = self._tree.branch(root)
        connector: str | None = None
        column = 1
        if branch.joint is not None:
            connector, column = self._joints.add_joint(branch.joint, branch.part, "world.frame_b", IDENTITY, 0)
        elif branch.predecessor == GROUND:
            connector, column = self._joints.add_offset("world.frame_b", branch.part.pose, branch.part.name, 0)
        grounded = branch.joint is None and branch.predecessor == GROUND
        self._add_body(branch.part, column, connector, grounded=grounded)
        # A stack instead of recursion: chains may be longer than Python's recursion limit.
        stack = [(child, column, number) for number, child in reversed(list(enumerate(branch.children)))]
        while stack:
            name, column, number = stack.pop()
            following = self._tree.branch(name)
            if following.joint is None or following.predecessor is None:
                raise AssertionError("a child in the tree is reached by a joint")
            self._draft.row += 1 if number > 0 else 0
            before = self._assembly.part(following.predecessor)
            own = f"{self._draft.view.part_names[before.name]}.frame_a"
            connector, column = self._joints.add_joint(following.joint, following.part, own, before.pose, column)
            self._add_body(following.part, column, connector, grounded=False)
            stack += [(child, column, k) for k, child in reversed(list(enumerate(following.children)))]
        self._draft.row += 1

    def _add_body(self, part: Part, column: int, connector: str | None, *, grounded: bool) -> None:
        properties = part.mass_properties
        inertia = properties.inertia
        modifiers = [
            f"m={number(properties.mass)}",
            f"r_CM={vector(properties.center_of_mass)}",
            *(f"I_{i}{j}={number(inertia[i - 1, j - 1])}" for i, j in ((1, 1), (2, 2), (3, 3), (2, 1), (3, 1), (3, 2))),
            *(["checkInertia=false"] if check_moments(inertia) is not None else []),  # taken with a note
        ]
        name = self._draft.view.part_names[part.name]
        if self._geometries[part.name].shapes:
            modifiers.append(f"geometry=Geometry.{name}")
            if part.material is not None:
                modifiers.append(f"material={self._draft.view.material_names[part.material]}")
        free = connector is None and not grounded
        if free:
            motion = start_motion(self._assembly, self._tree, self._loops, part)
            modifiers += _free_start(motion, part.pose)
        # A FreeBody is the root of its mechanism's orientations, so that its coordinates are the states.
        kind = "ContactMultiBody.Parts.FreeBody" if free else "ContactMultiBody.Parts.Body"
        self._draft.place(kind, name, tuple(modifiers), part.name, column, -1)
        if connector is not None:
            self._draft.connect(connector, f"{name}.frame_a")

    def _add_plane(self, plane: Plane) -> None:
        modifiers = []
        if plane.position.any():
            modifiers.append(f"r={vector(plane.position)}")
        if (plane.normal != np.array([0.0, 0.0, 1.0])).any():
            modifiers.append(f"normal={vector(plane.normal)}")
        if plane.material is not None:
            modifiers.append(f"material={self._draft.view.material_names[plane.material]}")
        name = self._draft.view.plane_names[plane.name]
        self._draft.place("ContactMultiBody.Parts.Ground", name, tuple(modifiers), plane.name, 0)
        self._draft.row += 1

    def _add_contacts(self) -> None:
        if not self._pairs:
            return
        touching = {name for pair in self._pairs for name in pair}
        names = {**self._draft.view.part_names, **self._draft.view.plane_names}
        bodies = [name for name in names if name in touching]
        index = {name: number for number, name in enumerate(bodies, start=1)}
        self._draft.view.contacts = ContactView(
            bodies=tuple(names[name] for name in bodies),
            pairs=tuple((index[first], index[second]) for first, second in self._pairs),
            stiffness=self._assembly.contacts.stiffness,
            friction=self._assembly.contacts.friction,
            friction_rule=self._assembly.contacts.friction_rule,
            exact_within=self._exact_within,
            compiled=self._compiled,
            held=frozenset(names[name] for name in bodies if name in self._tree.fixed),
        )
        for name in bodies:
            self._draft.connect(f"{names[name]}.frame_a", f"contacts.frame[{index[name]}]")


def _exact_within(geometries: Mapping[str, CollisionGeometry]) -> float | None:
    """Gap up to which distances are exact, in m to one digit; None if nothing collides."""
    radii = [geometry.ball(IDENTITY).radius for geometry in geometries.values() if geometry.shapes]
    return float(f"{EXACT_WITHIN * min(radii):.0e}") if radii else None


def _free_start(motion: tuple[Array, Array], pose: Pose) -> list[str]:
    velocity, angular_velocity = motion
    angles = cardan_angles(pose.rotation)
    return [
        f"r_0(start={vector(pose.position)},each fixed=true)",
        f"v_0(start={vector(tidy_length(velocity))},each fixed=true)",
        "angles_fixed=true",
        f"angles_start={vector(angles)}",
        "w_0_fixed=true",
        f"w_0_start={vector(tidy_length(angular_velocity))}",
    ]
