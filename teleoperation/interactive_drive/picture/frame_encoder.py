"""A row of values as the bytes that the page draws: poses of moving bodies, contact forces, chosen signals.

Little-endian: a header of 48 bytes, seven float32 a moving body (position, quaternion x y z w), six float32 a force
(point, force on the pair's first body), then a sample of the chosen signals for every frame since the last message,
oldest first: its time less that of the frame, and a float32 a signal. Lengths in m, forces in N, world axes.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from fmu_regression.report.animation import quaternions
from fmu_regression.results.result import FloatArray
from fmu_regression.scene.scene_file import Scene, SceneBody, drawn_force_sign
from fmu_regression.scene.signals import (
    force_names,
    point_force_names,
    point_names,
    position_names,
    rotation_names,
)
from numpy.typing import NDArray

from interactive_drive.process.messages import Frame

HEADER: Final = struct.Struct("<dddfIIIHHHH")
"""Time, stamp, when the server heard of it (ms), real-time factor, number, steps, missed; counts of bodies, forces,
signals, samples."""
POSE_BYTES: Final = 28
MOST_FORCES: Final = 500

_Places = NDArray[np.intp]


@dataclass(frozen=True)
class Picture:
    """The part of a frame that all pages get."""

    poses: bytes
    forces: bytes
    force_count: int


class FrameEncoder:
    """Knows where in a row a scene's poses and forces are.

    Args:
        scene: what is drawn; None: nothing is.
        signals: names of the row's values.
    """

    def __init__(self, scene: Scene | None, signals: Sequence[str]) -> None:
        self._index = {name: k for k, name in enumerate(signals)}
        drawn = [body for body in scene.bodies if body.meshes] if scene is not None else []
        moving = [(k, body) for k, body in enumerate(drawn) if not body.fixed and self._has_pose(body)]
        self.moving = tuple(k for k, _ in moving)
        """Places of the moving bodies among those with geometry."""
        self._positions = self._places([position_names(body) for _, body in moving], 3)
        self._rotations = self._places([rotation_names(body) for _, body in moving], 9)
        points, middles = self._force_names(scene) if scene is not None else ([], [])
        forces = points + middles
        self._forces = self._places([names for names, _ in forces], 6)
        self._signs = np.array([[1.0, 1.0, 1.0, sign, sign, sign] for _, sign in forces]).reshape(len(forces), 6)

    def picture(self, values: FloatArray) -> Picture:
        """Poses and forces of a row, shape (len(signals),)."""
        count = len(self.moving)
        poses = np.empty((count, 7), dtype="<f4")
        if count:
            poses[:, :3] = values[self._positions]
            poses[:, 3:] = quaternions(values[self._rotations].reshape(count, 3, 3))
        forces = self._signs * values[self._forces]
        acting = forces[np.abs(forces[:, 3:]).max(axis=1, initial=0.0) > 0][:MOST_FORCES]
        return Picture(poses.tobytes(), acting.astype("<f4").tobytes(), len(acting))

    def message(
        self, frame: Frame, picture: Picture, samples: Sequence[Frame], chosen: Sequence[int], heard: float
    ) -> bytes:
        """The bytes of a frame.

        Args:
            frame: the frame.
            picture: of its values.
            samples: frames whose signals are sent, with this one as the last.
            chosen: places of signals in the row, as ``places`` gives them.
            heard: wall time when the server heard of it, ms.
        """
        header = HEADER.pack(
            frame.time,
            frame.stamp,
            heard,
            frame.factor,
            frame.number & 0xFFFFFFFF,
            frame.steps & 0xFFFFFFFF,
            frame.missed & 0xFFFFFFFF,
            len(self.moving),
            picture.force_count,
            len(chosen),
            len(samples),
        )
        rows = np.empty((len(samples), 1 + len(chosen)), dtype="<f4")
        for row, sample in zip(rows, samples, strict=True):
            row[0] = sample.time - frame.time
            row[1:] = sample.values[list(chosen)]
        return header + picture.poses + picture.forces + rows.tobytes()

    def places(self, names: Sequence[str]) -> tuple[int, ...]:
        """Places of signals in the row; unknown names are left out."""
        return tuple(self._index[name] for name in names if name in self._index)

    def _force_names(self, scene: Scene) -> tuple[list[tuple[list[str], float]], list[tuple[list[str], float]]]:
        """Names of the contact points with their forces; of pairs without points, a body's position with the force.

        Each with the sign that the force is drawn with.
        """
        points: list[tuple[list[str], float]] = []
        middles: list[tuple[list[str], float]] = []
        for pair in scene.pairs:
            sign = drawn_force_sign(scene, pair)
            slot = 1
            while self._has(names := point_names(scene, pair, slot) + point_force_names(scene, pair, slot)):
                points.append((names, sign))
                slot += 1
            body = self._first_moving(scene, pair.bodies)
            if slot == 1 and body is not None and self._has(force_names(scene, pair)):
                middles.append((position_names(body) + force_names(scene, pair), sign))
        return points, middles

    def _has(self, names: Sequence[str]) -> bool:
        return all(name in self._index for name in names)

    def _has_pose(self, body: SceneBody) -> bool:
        return self._has(position_names(body) + rotation_names(body))

    def _first_moving(self, scene: Scene, names: Sequence[str]) -> SceneBody | None:
        bodies = {body.name: body for body in scene.bodies}
        return next((bodies[n] for n in names if not bodies[n].fixed and self._has(position_names(bodies[n]))), None)

    def _places(self, names: Sequence[Sequence[str]], width: int) -> _Places:
        return np.array([[self._index[n] for n in row] for row in names], dtype=np.intp).reshape(len(names), width)
