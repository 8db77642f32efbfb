"""Which parts are one body, and what holds the bodies to each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import networkx as nx
import numpy as np

from cad2modelica.geometry.spatial import IDENTITY, Array, Pose
from cad2modelica.mates.allowed_motion import MatedPair, allowed_twists, mated_pair
from cad2modelica.mates.joint_chains import Chain, joint_chain
from cad2modelica.mates.mate_equation import PLANE, SHAPES, Feature, MateEquation, mate_equation
from cad2modelica.mechanism.model import GROUND
from cad2modelica.simscape.document import Document, FrameJoint, Mate, MateSide, Path
from cad2modelica.simscape.elements import Elements
from cad2modelica.source.lost import Lost

FIXED_KINDS = ("Weld", "Fixed", "Rigid")
POSITION_TOLERANCE = 1e-5  # of the size: exports round
ANGLE_TOLERANCE = 1e-4  # rad
ROOT: Path = ()
LIMITED = ("LimitDistance", "LimitAngle")
"""Beginnings of the names that SolidWorks gives to mates with a range; the export says neither that nor the range."""


@dataclass(frozen=True, eq=False)
class MatedBodies:
    """Two bodies, by a part of each, the mates between them, and the joints that move as they allow."""

    first: Path
    second: Path
    mates: tuple[str, ...]
    chain: Chain


@dataclass(eq=False)
class Bodies:
    """Groups of parts that do not move against each other.

    Attributes:
        groups: the part that stands for the group of each part, or the empty path for what stands in the world.
        joints: those of the file that are between bodies.
        mated: what mates hold together.
    """

    groups: dict[Path, Path]
    joints: list[FrameJoint] = field(default_factory=list)
    mated: list[MatedBodies] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class _Equation:
    """A mate between two parts."""

    mate: Mate
    first: Path
    second: Path
    equation: MateEquation


def find_bodies(document: Document, elements: Elements, notes: list[str], leave_out: bool) -> Bodies:
    """Puts parts together that are fixed to each other, and finds joints for the rest.

    Args:
        document: the file's content.
        elements: receives problems.
        notes: receives what is taken otherwise than it stands there.
        leave_out: whether mates that no joint stands for are left out with a note, instead of being problems.
    """
    return _BodyFinder(document, elements, notes, leave_out).find()


class _BodyFinder:
    def __init__(self, document: Document, elements: Elements, notes: list[str], leave_out: bool) -> None:
        self._document = document
        self._elements = elements
        self._notes = notes
        self._leave_out = leave_out
        self._poses: Mapping[Path, Pose] = {
            ROOT: IDENTITY,
            **{path: item.pose for path, item in document.instances.items()},
        }
        positions = np.array([item.pose.position for item in document.instances.values()])
        points = np.array([self._world(side) for mate in document.mates for side in mate.sides]).reshape(-1, 3)
        spread = np.concatenate([positions, points])
        self._size = max(float(np.linalg.norm(spread.max(axis=0) - spread.min(axis=0))), 1e-6)
        self._rank = {path: number for number, path in enumerate([ROOT, *document.instances])}
        self._union: nx.utils.UnionFind[Path] = nx.utils.UnionFind(list(self._rank))

    def find(self) -> Bodies:
        for first, second in self._document.rigid:
            self._union.union(first, second)
        joints = [self._of_parts(joint) for joint in self._document.joints]
        moving = [joint for joint in joints if joint is not None and not self._welded(joint)]
        equations = self._equations()
        self._join_rigidly_mated(equations)
        bodies = Bodies(self._groups())
        bodies.joints = [
            joint
            for joint in moving
            if bodies.groups[joint.base] != bodies.groups[joint.follower] or self._inside(joint)
        ]
        joined = {frozenset((bodies.groups[joint.base], bodies.groups[joint.follower])) for joint in bodies.joints}
        for (first, second), items in self._by_bodies(equations).items():
            if frozenset((first, second)) in joined:
                self._beside_joint(items)
                continue
            chain = joint_chain(self._pair(first, second, items))
            if chain is None:
                self._irreducible([item.mate for item in items], self._names(first, second))
            elif chain:
                bodies.mated.append(MatedBodies(first, second, tuple(item.mate.name for item in items), chain))
        return bodies

    # ----- joints of the file -----

    def _of_parts(self, joint: FrameJoint) -> FrameJoint | None:
        """The joint between parts: frames of assemblies are those of a part that stands still in them."""
        ends = []
        for path, frame in ((joint.base, joint.base_frame), (joint.follower, joint.follower_frame)):
            part = self._carrier(path)
            if part is None:
                self._elements.problems.add(
                    f"the joint {joint.name!r} holds an assembly in which no part stands still",
                    self._elements.place(joint.element),
                    "Fix a part of the assembly in it, or join the part itself.",
                )
                return None
            pose = self._document.assemblies.get(path)
            ends.append((part, frame if pose is None else self._poses[part].inverse() @ pose @ frame))
        (base, base_frame), (follower, follower_frame) = ends
        return FrameJoint(joint.name, joint.kind, base, follower, base_frame, follower_frame, joint.element)

    def _welded(self, joint: FrameJoint) -> bool:
        """Whether a joint makes one body of two parts; where its frames do not meet, it does not."""
        if joint.kind not in FIXED_KINDS:
            return False
        base = self._poses[joint.base] @ joint.base_frame
        follower = self._poses[joint.follower] @ joint.follower_frame
        gap = float(np.linalg.norm(base.position - follower.position))
        turn = float(np.linalg.norm(base.rotation - follower.rotation)) / np.sqrt(2)
        if gap > POSITION_TOLERANCE * self._size or turn > ANGLE_TOLERANCE:
            self._notes.append(
                f"joint {joint.name!r} fixes parts to each other whose frames are {1000 * gap:.4g} mm and "
                f"{np.degrees(turn):.4g} degrees apart: they are fixed as they stand"
            )
        self._union.union(joint.base, joint.follower)
        return True

    def _inside(self, joint: FrameJoint) -> bool:
        self._notes.append(Lost(f"joint {joint.name!r} is between parts that are fixed to each other: left out"))
        return False

    # ----- mates -----

    def _equations(self) -> list[_Equation]:
        found = []
        for mate in self._document.mates:
            if mate.name.rsplit("/", 1)[-1].startswith(LIMITED):
                self._notes.append(
                    Lost(f"mate {mate.name!r} is taken as one with a range, which the export does not tell: left out")
                )
                continue
            if len(mate.sides) != 2 or any(side.kind not in SHAPES for side in mate.sides):
                self._irreducible([mate], "its geometry")
                continue
            ends = [self._feature(side) for side in mate.sides]
            (first, one), (second, other) = ends
            if first is None or second is None:
                self._irreducible([mate], "an assembly in which no part stands still")
                continue
            if self._union[first] == self._union[second]:
                continue
            equation = mate_equation(mate.name, mate.kind, one, other, (self._poses[first], self._poses[second]))
            if equation is None:
                self._irreducible([mate], f"{mate.sides[0].kind} and {mate.sides[1].kind}")
                continue
            values = equation.values(self._poses[first], self._poses[second], self._size)
            gap = float(np.linalg.norm(values[: equation.lengths]))
            angle = float(np.linalg.norm(values[equation.lengths :]))
            if gap > POSITION_TOLERANCE or angle > ANGLE_TOLERANCE:
                self._elements.problems.add(
                    f"the mate {mate.name!r} is not fulfilled where the parts stand: {1000 * gap * self._size:.4g} mm "
                    f"and {np.degrees(angle):.4g} degrees are missing",
                    self._elements.place(mate.element),
                    "Rebuild the assembly in the CAD system, or suppress the mate, and export again.",
                )
                continue
            found.append(_Equation(mate, first, second, equation))
        return found

    def _feature(self, side: MateSide) -> tuple[Path | None, Feature]:
        """The part that carries a side's geometry, and the geometry in the part's axes."""
        part = self._carrier(side.path)
        feature = Feature(SHAPES.get(side.kind, PLANE), side.point, side.axis)
        pose = self._document.assemblies.get(side.path)
        if pose is None or part is None:
            return part, feature
        inner = self._poses[part].inverse() @ pose
        return part, Feature(feature.shape, inner.point(feature.point), inner.direction(feature.axis))

    def _carrier(self, path: Path) -> Path | None:
        """A part, or the part that stands still in an assembly, or the world."""
        if path in self._poses:
            return path
        return self._document.anchors.get(path)

    def _join_rigidly_mated(self, equations: Sequence[_Equation]) -> None:
        """Makes one body of bodies that mates leave no freedom, until no more are found."""
        changed = True
        while changed:
            changed = False
            for (first, second), items in self._by_bodies(equations).items():
                if self._union[first] == self._union[second]:
                    continue
                if not len(allowed_twists(self._pair(first, second, items)).twists):
                    self._union.union(first, second)
                    changed = True

    def _by_bodies(self, equations: Sequence[_Equation]) -> dict[tuple[Path, Path], list[_Equation]]:
        """Mates by the bodies that they hold, in the order of the file."""
        groups = self._groups()
        order = self._outwards([(groups[item.first], groups[item.second]) for item in equations])
        found: dict[tuple[Path, Path], list[_Equation]] = {}
        for item in equations:
            first, second = groups[item.first], groups[item.second]
            if first != second:
                key = (first, second) if order[first] < order[second] else (second, first)
                found.setdefault(key, []).append(item)
        return found

    def _outwards(self, pairs: Iterable[tuple[Path, Path]]) -> dict[Path, int]:
        """Bodies numbered from the ground outwards (from the first one where nothing stands), along mates."""
        graph: nx.Graph[Path] = nx.Graph()
        graph.add_nodes_from(self._rank)
        graph.add_edges_from(pairs)
        order: dict[Path, int] = {}
        for start in self._rank:
            if start not in order:
                for node in [start, *(child for _, child in nx.bfs_edges(graph, start))]:
                    order.setdefault(node, len(order))
        return order

    def _pair(self, first: Path, second: Path, items: Sequence[_Equation]) -> MatedPair:
        """The mates with features in the axes of the two bodies."""
        groups = self._groups()
        mates = []
        for item in items:
            straight = groups[item.first] == first
            ends = (item.first, item.second) if straight else (item.second, item.first)
            sides = (item.equation.first, item.equation.second)
            one, other = sides if straight else sides[::-1]
            mates.append(
                _placed(
                    item.equation,
                    _in_axes(one, self._poses[ends[0]], self._poses[first]),
                    _in_axes(other, self._poses[ends[1]], self._poses[second]),
                    straight,
                )
            )
        return mated_pair(mates, self._poses[first], self._poses[second], self._size)

    def _groups(self) -> dict[Path, Path]:
        """The first part of each group: the world where it is in it."""
        first: dict[Path, Path] = {}
        for path in self._rank:
            first.setdefault(self._union[path], path)
        return {path: first[self._union[path]] for path in self._rank}

    def _beside_joint(self, items: Sequence[_Equation]) -> None:
        for item in items:
            note = f"mate {item.mate.name!r} is between bodies that a joint of the file holds: left out"
            self._notes.append(Lost(note))

    def _irreducible(self, mates: Sequence[Mate], between: str) -> None:
        """Mates that no joint stands for."""
        listed = ", ".join(f"{mate.name!r} ({mate.kind})" for mate in mates)
        several = "mates" if len(mates) > 1 else "mate"
        message = f"the {several} {listed} between {between} cannot be reduced to joints"
        if self._leave_out:
            self._notes.append(Lost(f"{message}: left out, the parts move more freely than in the CAD system"))
            return
        self._elements.problems.add(
            message,
            self._elements.place(mates[0].element),
            "Replace it in the CAD system by coincident, concentric, parallel, distance or angle mates of points, "
            "lines and planes; or leave it out, which frees the parts: --allow-missing",
        )

    def _names(self, *paths: Path) -> str:
        return " and ".join(GROUND if path == ROOT else repr(self._document.instances[path].name) for path in paths)

    def _world(self, side: MateSide) -> Array:
        pose = self._document.assemblies.get(side.path)
        return (pose if pose is not None else self._poses[side.path]).point(side.point)


def _in_axes(feature: Feature, before: Pose, after: Pose) -> Feature:
    inner = after.inverse() @ before
    return Feature(feature.shape, inner.point(feature.point), inner.direction(feature.axis))


def _placed(equation: MateEquation, first: Feature, second: Feature, straight: bool) -> MateEquation:
    """The equation between features of bodies, the other way round if not straight."""
    if straight:
        return MateEquation(equation.name, first, second, equation.residual, equation.lengths)

    def residual(one: Feature, other: Feature) -> Array:
        return equation.residual(other, one)

    return MateEquation(equation.name, first, second, residual, equation.lengths)
