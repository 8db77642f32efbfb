"""The animation's data: geometry, poses at frames and contact forces, as the viewer and playback.js read them.

Every frame is a row of the result, so what is shown was simulated; between frames playback.js interpolates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from fmu_regression.report.page import Animation, ColorKey
from fmu_regression.report.plots import encode_array
from fmu_regression.results.result import FloatArray, SimulationResult
from fmu_regression.scene.motion import BodyMotion, body_motions, center_of_mass
from fmu_regression.scene.scene_file import ContactPair, Scene, SceneBody, drawn_force_sign
from fmu_regression.scene.signals import body_force_names, force_names, pair_signal, point_force_names, point_names

_MAX_FRAMES = 3000
_FEATURE_SHARE = 2e-3
_FIXED_SHARE = 3.0
_MOTION_SHARE = 1.5
_SURROUNDINGS = 0.3
_UPRIGHT = 0.5
_FOLLOW_SHARE = 0.6
_MAX_CORNERS = 400
_MAX_PLANES = 400

IntArray = NDArray[np.intp]


def make_animation(scene: Scene, result: SimulationResult) -> Animation | None:
    """The animation of a result, or None if no body of the scene has geometry."""
    if not any(mesh.triangles.size for body in scene.bodies for mesh in body.meshes):
        return None
    motions = body_motions(scene, result)
    rows = frame_rows(scene, result)
    up = _up(scene)
    center, radius, floor = _extent(motions, rows, up)
    travel = _travel(motions, rows, up)
    forces = _forces(scene, result, motions, rows)
    largest = max((float(np.linalg.norm(track[:, 3:], axis=1).max(initial=0.0)) for track in forces), default=0.0)
    data = {
        "time": encode_array(result.time[rows], "f8"),
        "up": _numbers(up),
        "center": _numbers(center),
        "radius": _number(radius),
        "floor": _number(floor),
        "follow": bool(np.linalg.norm(travel, axis=1).max(initial=0.0) > _FOLLOW_SHARE * radius),
        "travel": encode_array(travel, "f4"),
        "largestForce": _number(largest) if largest > 0 else 1.0,
        "bodies": [_body(motion, rows) for motion in motions if motion.body.meshes],
        "forces": [{"track": encode_array(track, "f4")} for track in forces],
    }
    return Animation(
        data=data,
        key=_color_key([body for body in scene.bodies if body.meshes]),
        duration=float(result.time[-1] - result.time[0]),
    )


def frame_rows(scene: Scene, result: SimulationResult) -> IntArray:
    """Rows of the result that become frames: all distinct times, or evenly chosen ones and every peak of a force."""
    distinct = np.flatnonzero(np.diff(result.time, append=np.inf) > 0)
    if distinct.size <= _MAX_FRAMES:
        return distinct
    chosen = distinct[np.linspace(0, distinct.size - 1, _MAX_FRAMES - 200).round().astype(np.intp)]
    peaks: list[int] = []
    for pair in scene.pairs:
        name = pair_signal(scene, pair, "normalForce")
        if name in result:
            peaks += _highest_peaks(result[name], distinct, 200 // len(scene.pairs) + 1)
    return np.unique(np.concatenate([chosen, np.array(peaks, dtype=np.intp)]))[:_MAX_FRAMES]


def quaternions(rotation: FloatArray) -> FloatArray:
    """Quaternions x y z w of body-to-world rotations, of the same sign along the rows.

    Args:
        rotation: shape (n, 3, 3), T: v_body = T v_world.

    Returns:
        shape (n, 4), unit.
    """
    matrix = np.swapaxes(rotation, 1, 2)
    trace = np.trace(matrix, axis1=1, axis2=2)
    # Shepperd's method: the largest of the four squares keeps the division well conditioned.
    squares = np.stack([*(2 * matrix[:, i, i] - trace for i in range(3)), trace], axis=1)
    pick = np.argmax(squares, axis=1)
    result = np.empty((matrix.shape[0], 4))
    for case in range(4):
        at = np.flatnonzero(pick == case)
        if not at.size:
            continue
        m = matrix[at]
        if case == 3:
            q = np.stack(
                [m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1], 1 + trace[at]], axis=1
            )
        else:
            i, j, k = case, (case + 1) % 3, (case + 2) % 3
            q = np.empty((at.size, 4))
            q[:, i] = 1 + m[:, i, i] - m[:, j, j] - m[:, k, k]
            q[:, j] = m[:, j, i] + m[:, i, j]
            q[:, k] = m[:, k, i] + m[:, i, k]
            q[:, 3] = m[:, k, j] - m[:, j, k]
        result[at] = q
    result /= np.linalg.norm(result, axis=1, keepdims=True)
    flips = np.einsum("ni,ni->n", result[1:], result[:-1]) < 0
    result[1:][np.logical_xor.accumulate(flips)] *= -1
    return result


def _body(motion: BodyMotion, rows: IntArray) -> dict[str, Any]:
    body = motion.body
    frames = np.array([0], dtype=np.intp) if body.fixed else rows
    track = np.hstack([motion.position[frames], quaternions(motion.rotation[frames])])
    return {
        "label": body.label,
        "track": encode_array(track, "f4"),
        "meshes": [
            {
                "vertices": encode_array(mesh.vertices, "f4"),
                "triangles": encode_array(mesh.triangles, "u4"),
                "color": _numbers(np.array(mesh.color)),
            }
            for mesh in body.meshes
            if mesh.triangles.size
        ],
    }


def _color_key(bodies: Sequence[SceneBody]) -> tuple[ColorKey, ...]:
    """An entry for each body; parts of one name and colour in several instances ("left/foot") share theirs."""
    alike: dict[tuple[str, str], list[str]] = {}
    for body in bodies:
        red, green, blue = (round(255 * value) for value in body.meshes[0].color)
        name = body.label.rpartition("/")[2]
        alike.setdefault((name, f"rgb({red},{green},{blue})"), []).append(body.label)
    return tuple(
        ColorKey(labels[0] if len(labels) == 1 else f"{name} ({len(labels)})", color)
        for (name, color), labels in alike.items()
    )


def _up(scene: Scene) -> FloatArray:
    size = float(np.linalg.norm(scene.gravity))
    return -scene.gravity / size if size > 0 else np.array([0.0, 0.0, 1.0])


def _extent(motions: Sequence[BodyMotion], rows: IntArray, up: FloatArray) -> tuple[FloatArray, float, float]:
    """Centre and radius of what the camera should see, and the height of the lowest point along ``up``.

    Seen should be the whole motion, unless it leads far away: then the start and its surroundings.
    """
    some = rows[:: max(1, rows.size // 200)]
    moving: list[FloatArray] = []
    still: list[FloatArray] = []
    for motion in motions:
        points = _vertices(motion.body)
        if not points.size:
            continue
        if motion.body.fixed:
            still.append(motion.position[0] + points @ motion.rotation[0])
        else:
            corners = _box_corners(points)
            moving.append(motion.position[some, None, :] + np.einsum("ki,nij->nkj", corners, motion.rotation[some]))
    lowest = min(float((points @ up).min()) for points in moving + still)
    everywhere = _Box.around(moving or still)
    start = _Box.around([places[0] for places in moving] or still).with_near(still)
    seen = everywhere.with_near(still)
    if seen.size > _MOTION_SHARE * start.size:
        # Heights are all of interest: a ball that is dropped should be seen where it lands.
        level = np.abs(up) < _UPRIGHT
        margin = _SURROUNDINGS * start.size
        seen = _Box(
            np.where(level, np.maximum(seen.low, start.low - margin), seen.low),
            np.where(level, np.minimum(seen.high, start.high + margin), seen.high),
        )
    return (seen.low + seen.high) / 2, max(seen.size / 2, 1e-6), lowest


@dataclass(frozen=True)
class _Box:
    """An axis-parallel box, corners of shape (3,)."""

    low: FloatArray
    high: FloatArray

    @staticmethod
    def around(parts: Sequence[FloatArray]) -> _Box:
        """The box around points, arrays of shape (..., 3)."""
        points = np.vstack([part.reshape(-1, 3) for part in parts])
        return _Box(points.min(axis=0), points.max(axis=0))

    @property
    def size(self) -> float:
        """Length of the diagonal."""
        return float(np.linalg.norm(self.high - self.low))

    def with_near(self, parts: Sequence[FloatArray]) -> _Box:
        """The box around this and fixed parts; of a floor that reaches far only what is near is worth seeing."""
        low, high, size = self.low, self.high, self.size
        for part in parts:
            box = _Box.around([part])
            a, b = box.low, box.high
            if box.size > _FIXED_SHARE * size:
                a, b = np.maximum(a, self.low - 0.3 * size), np.minimum(b, self.high + 0.3 * size)
                if (a > b).any():
                    continue
            low, high = np.minimum(low, a), np.maximum(high, b)
        return _Box(low, high)


def _travel(motions: Sequence[BodyMotion], rows: IntArray, up: FloatArray) -> FloatArray:
    """How far the middle of the moving bodies went since the first frame, along the floor, shape (frames, 3)."""
    places = [motion.position[rows] for motion in motions if not motion.body.fixed and motion.body.meshes]
    if not places:
        return np.zeros((rows.size, 3))
    way = np.mean(places, axis=0)
    way = way - way[0]
    along: FloatArray = way - np.outer(way @ up, up)
    return along


def _vertices(body: SceneBody) -> FloatArray:
    parts = [mesh.vertices for mesh in body.meshes if mesh.vertices.size]
    return np.vstack(parts) if parts else np.empty((0, 3))


def _box_corners(points: FloatArray) -> FloatArray:
    low, high = points.min(axis=0), points.max(axis=0)
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])


def _forces(scene: Scene, result: SimulationResult, motions: Sequence[BodyMotion], rows: IntArray) -> list[FloatArray]:
    """Point and force, shape (frames, 6), for every contact point that the result shows; see ``drawn_force_sign``."""
    tracks: list[FloatArray] = []
    by_name = {motion.body.name: motion for motion in motions}
    for pair in scene.pairs:
        slots = _point_tracks(scene, pair, result, rows)
        if not slots and all(name in result for name in force_names(scene, pair)):
            force = result.vector(force_names(scene, pair))[rows]
            slots = [np.hstack([_likely_points(by_name, pair, force, rows), force])]
        sign = np.array([1.0, 1.0, 1.0, *[drawn_force_sign(scene, pair)] * 3])
        tracks += [sign * track for track in slots if np.abs(track[:, 3:]).max(initial=0.0) > 0]
    return tracks + _body_tracks(scene, result, by_name, rows)


def _body_tracks(
    scene: Scene, result: SimulationResult, motions: dict[str, BodyMotion], rows: IntArray
) -> list[FloatArray]:
    """Centre of mass and contact force of bodies that move, where the manager tells no pairs."""
    moving = [(k, motions[body]) for k, body in enumerate(scene.colliders, start=1) if not motions[body].body.fixed]
    tracks = [
        np.hstack([center_of_mass(motion)[rows], result.vector(body_force_names(scene, k))[rows]])
        for k, motion in moving
        if all(name in result for name in body_force_names(scene, k))
    ]
    return [track for track in tracks if track[:, 3:].any()]


def _point_tracks(scene: Scene, pair: ContactPair, result: SimulationResult, rows: IntArray) -> list[FloatArray]:
    tracks = []
    slot = 1
    while all(name in result for name in point_names(scene, pair, slot) + point_force_names(scene, pair, slot)):
        names = point_names(scene, pair, slot) + point_force_names(scene, pair, slot)
        tracks.append(result.vector(names)[rows])
        slot += 1
    return tracks


def _likely_points(motions: dict[str, BodyMotion], pair: ContactPair, force: FloatArray, rows: IntArray) -> FloatArray:
    """Where a force probably acts, shape (frames, 3): the middle of the corners that reach deepest into the other body.

    The result has the force of the pair but not its points. A body without geometry is taken as a plane across the
    force.
    """
    first, second = motions[pair.bodies[0]], motions[pair.bodies[1]]
    shapes = {motion.body.name: _convex_parts(motion.body) for motion in (first, second)}
    points = first.position[rows].copy()
    for k in np.flatnonzero(np.abs(force).max(axis=1) > 0):
        direction = force[k] / np.linalg.norm(force[k])
        placed = {
            motion.body.name: [part.placed(motion.position[rows[k]], motion.rotation[rows[k]]) for part in parts]
            for motion, parts in ((first, shapes[first.body.name]), (second, shapes[second.body.name]))
        }
        a, b = placed[first.body.name], placed[second.body.name]
        features = _deepest_corners(a, b, -direction) + _deepest_corners(b, a, direction)
        if features:
            points[k] = min(features, key=lambda feature: (feature[0], feature[1]))[2]
    return points


@dataclass(frozen=True)
class _ConvexPart:
    """Corners, shape (v, 3), and outward planes n x + d <= 0, shape (p, 4), of the hull of one mesh."""

    corners: FloatArray
    planes: FloatArray

    def placed(self, position: FloatArray, rotation: FloatArray) -> _ConvexPart:
        """The part in world axes."""
        normals = self.planes[:, :3] @ rotation
        offsets = self.planes[:, 3] - normals @ position
        return _ConvexPart(position + self.corners @ rotation, np.column_stack([normals, offsets]))


def _convex_parts(body: SceneBody) -> list[_ConvexPart]:
    parts = []
    for mesh in body.meshes:
        try:
            hull = ConvexHull(mesh.vertices)
        except (QhullError, ValueError):
            continue  # a flat or empty mesh has no inside
        corners = mesh.vertices[np.sort(hull.vertices)]
        planes = np.unique(np.round(hull.equations, 9), axis=0)
        # Fine tessellations are more than an arrow's foot needs.
        parts.append(
            _ConvexPart(corners[:: 1 + len(corners) // _MAX_CORNERS], planes[:: 1 + len(planes) // _MAX_PLANES])
        )
    return parts


def _deepest_corners(
    parts: list[_ConvexPart], others: list[_ConvexPart], towards: FloatArray
) -> list[tuple[float, float, FloatArray]]:
    """For each pair of parts: signed distance of the deepest corners, their spread and their middle."""
    features = []
    for part in parts:
        size = float(np.ptp(part.corners, axis=0).max())
        if others:
            distances = [(part.corners @ other.planes[:, :3].T + other.planes[:, 3]).max(axis=1) for other in others]
        else:
            distances = [-(part.corners @ towards)]
        for distance in distances:
            face = part.corners[distance <= distance.min() + _FEATURE_SHARE * size]
            middle = face.mean(axis=0)
            spread = float(np.linalg.norm(face - middle, axis=1).max())
            # Depths that differ by less than the feature's thickness count as equal; then the smaller feature decides.
            features.append(
                (round(float(distance.min()) / (_FEATURE_SHARE * size)) * _FEATURE_SHARE * size, spread, middle)
            )
    return features


def _highest_peaks(values: FloatArray, among: IntArray, count: int) -> list[int]:
    """The rows of the highest local maxima."""
    v = values[among]
    inner = np.flatnonzero((v[1:-1] > v[:-2]) & (v[1:-1] >= v[2:])) + 1
    highest = inner[np.argsort(-v[inner], kind="stable")[:count]]
    return [int(among[k]) for k in highest]


def _number(value: float) -> float:
    return float(f"{value:.9g}")


def _numbers(values: FloatArray) -> list[float]:
    return [_number(float(value)) + 0.0 for value in values]
