"""Collision shapes of all parts: each geometry once, several at a time."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from dataclasses import replace

from contact_foundation.progress import Progress

from cad2modelica.collision.collision_shapes import CollisionGeometry, collision_geometry
from cad2modelica.mechanism.model import DecompositionLimits, Part


def part_geometries(
    parts: Sequence[Part], limits: DecompositionLimits, progress: Progress
) -> dict[str, CollisionGeometry]:
    """Collision shapes by part, in the parts' order, whatever is ready first.

    Parts with the same meshes and settings, as those of instances are, share their shapes. Threads do: what takes long
    is decomposing, and runs in processes of its own.

    Args:
        parts: of an assembly.
        limits: of decompositions, where a part says nothing itself.
        progress: is told the part that was done last.

    Raises:
        InputError: a part asks for a shape that its geometry is not; of several, the first.
    """
    first: dict[bytes, Part] = {}
    keys = {part.name: _key(part) for part in parts}
    for part in parts:
        first.setdefault(keys[part.name], part)
    done: dict[bytes, Future[CollisionGeometry]] = {}
    workers = ThreadPoolExecutor(os.cpu_count() or 1)
    try:
        done = {key: workers.submit(collision_geometry, part, limits) for key, part in first.items()}
        names = {future: first[key].name for key, future in done.items()}
        for number, future in enumerate(as_completed(names), start=1):
            progress("collision shapes", number / len(names), names[future])
            if future.exception() is not None:
                break
        # In the parts' order: the first that is wrong is reported, whichever failed first.
        return {part.name: _named(done[keys[part.name]].result(), first[keys[part.name]], part) for part in parts}
    finally:
        workers.shutdown(wait=True, cancel_futures=True)


def _named(geometry: CollisionGeometry, computed: Part, part: Part) -> CollisionGeometry:
    """The shapes with notes that name another part than the one they were computed for."""
    if part is computed:
        return geometry
    begin = f"part {computed.name!r}"
    notes = tuple(type(note)(f"part {part.name!r}{note.removeprefix(begin)}") for note in geometry.notes)
    return replace(geometry, notes=notes)


def _key(part: Part) -> bytes:
    meshes = part.meshes if part.collision_meshes is None else part.collision_meshes
    digest = hashlib.sha256(repr((part.collision, part.decomposition)).encode())
    for mesh in meshes:
        for array in (mesh.vertices, mesh.triangles):
            digest.update(f"\n{array.dtype.str} {array.shape}\n".encode())
            digest.update(array.tobytes())
    return digest.digest()
