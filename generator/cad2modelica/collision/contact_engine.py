"""The contact engine, asked through its C interface (``contact_multibody.h``, whose structures are mirrored here)."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from pathlib import Path
from typing import ClassVar

import numpy as np
from contact_foundation.errors import BuildError, Place

from cad2modelica.geometry.spatial import Array, Pose

_OWN_BACKEND = 1  # CMB_BACKEND_ANALYTIC
_POINTS = 1


class _Scene(ctypes.Structure):
    _fields_: ClassVar = [("number", ctypes.c_int)]


class _SceneSource(ctypes.Structure):
    _fields_: ClassVar = [
        ("geometry", ctypes.POINTER(ctypes.c_char_p)),
        ("body_count", ctypes.c_size_t),
        ("pairs", ctypes.c_void_p),
        ("pair_count", ctypes.c_size_t),
        ("backend", ctypes.c_int),
        ("folder", ctypes.c_char_p),
    ]


class _Poses(ctypes.Structure):
    _fields_: ClassVar = [
        ("body_count", ctypes.c_size_t),
        ("position", ctypes.c_void_p),
        ("rotation", ctypes.c_void_p),
    ]


class _ContactPoints(ctypes.Structure):
    _fields_: ClassVar = [
        ("pair_count", ctypes.c_size_t),
        ("point_capacity", ctypes.c_size_t),
        ("distance", ctypes.c_void_p),
        ("depth", ctypes.c_void_p),
        ("weight", ctypes.c_void_p),
        ("normal", ctypes.c_void_p),
        ("point", ctypes.c_void_p),
    ]


class ContactEngine:
    """The engine's shared library, which stays loaded.

    Args:
        library: its file.

    Raises:
        BuildError: it cannot be loaded.
    """

    def __init__(self, library: Path) -> None:
        try:
            self._library = ctypes.CDLL(str(library))
        except OSError as error:
            raise BuildError(
                f"the contact engine cannot be loaded: {error}", place=Place(file=library), remedy="run scripts/setup"
            ) from error
        self._library.cmb_last_error.restype = ctypes.c_char_p

    def signed_distances(
        self, descriptors: Sequence[str], poses: Sequence[Pose], pairs: Sequence[tuple[int, int]]
    ) -> Array:
        """Signed distances of pairs of bodies.

        Args:
            descriptors: geometry of each body, as the engine's descriptor strings.
            poses: of each body in the world.
            pairs: indices of two bodies each, from 0.

        Returns:
            One a pair, m; negative where the two overlap, 1e9 where they never touch.

        Raises:
            BuildError: the engine refuses a descriptor or a pose; with its own words.
        """
        numbers = np.ascontiguousarray(np.array(pairs, dtype=np.intc).reshape(-1, 2) + 1)
        texts = (ctypes.c_char_p * len(descriptors))(*(text.encode() for text in descriptors))
        source = _SceneSource(texts, len(descriptors), numbers.ctypes.data, len(pairs), _OWN_BACKEND, None)
        scene = _Scene()
        self._check(self._library.cmb_intern(ctypes.byref(source), ctypes.byref(scene)))
        try:
            return self._distances(scene, poses, len(pairs))
        finally:
            self._library.cmb_release_scene(scene)

    def _distances(self, scene: _Scene, poses: Sequence[Pose], count: int) -> Array:
        position = np.ascontiguousarray([pose.position for pose in poses], dtype=np.float64)
        rotation = np.ascontiguousarray([pose.rotation.T for pose in poses], dtype=np.float64)
        distance = np.zeros(count)
        outputs = [np.zeros((count, _POINTS, width)) for width in (1, 1, 3, 3)]
        where = _Poses(len(poses), position.ctypes.data, rotation.ctypes.data)
        addresses = (array.ctypes.data for array in (distance, *outputs))
        points = _ContactPoints(count, _POINTS, *addresses)
        exactly = ctypes.c_double(np.inf)
        self._check(self._library.cmb_query_scene(scene, ctypes.byref(where), exactly, ctypes.byref(points)))
        return distance

    def _check(self, status: int) -> None:
        if status != 0:
            raise BuildError(f"the contact engine says: {self._library.cmb_last_error().decode()}")
