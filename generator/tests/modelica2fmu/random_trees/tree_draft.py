"""A mechanism that is being written: its Modelica text, and beside it what its motion is computed from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation
from tree_joints import Chooser
from tree_motion import Look, Mechanism, Place, Pose


@dataclass(frozen=True)
class Frame:
    """A connector and where it is."""

    name: str
    place: Place


@dataclass
class Draft:
    """Declarations and connections, the frames that are there, and what variables are in the motion."""

    choose: Chooser
    lines: list[str] = field(default_factory=list)
    connections: list[str] = field(default_factory=list)
    frames: list[Frame] = field(default_factory=lambda: [Frame("world.frame_b", Place(None, np.zeros(3), np.eye(3)))])
    bodies: list[str] = field(default_factory=list)
    starts: list[Callable[[Sequence[Pose], float], Pose]] = field(default_factory=list)
    watched: dict[str, Callable[[Look], float]] = field(default_factory=dict)
    has_points: bool = False
    mechanism: Mechanism = field(default_factory=lambda: Mechanism(lambda _: np.zeros(3)))

    def declare(self, kind: str, name: str, text: str) -> None:
        self.lines.append(f"    {kind} {name}({text});" if text else f"    {kind} {name};")

    def connect(self, first: str, second: str) -> None:
        pair = (first, second) if self.choose.random() < 0.7 else (second, first)
        self.connections.append(f"    connect({pair[0]}, {pair[1]});")

    def poses(self, time: float) -> list[Pose]:
        """Of all bodies, near the start."""
        poses: list[Pose] = []
        for start in self.starts:
            poses.append(start(poses, time))
        return poses

    def at_start(self, poses: Sequence[Pose]) -> Look:
        """Frames at rest."""
        pose = np.concatenate([np.append(r, Rotation.from_matrix(axes).as_quat()) for r, axes in poses])
        return self.mechanism.look(pose, np.zeros(6 * len(poses)))
