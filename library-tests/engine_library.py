"""The installed contact engine, asked through its C interface."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from library_compiler import REPOSITORY

LIBRARY = REPOSITORY / "ContactMultiBody" / "Resources" / "Library" / "linux64" / "libcontactmultibody.so"
CAPACITY = 8

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Pose:
    """Where a body is: ``position[3]`` (m), ``rotation[3, 3]`` from the body's axes to the world's."""

    position: Array
    rotation: Array


class Engine:
    """Borrows the shared library, which stays loaded."""

    def __init__(self) -> None:
        self._library = ctypes.CDLL(str(LIBRARY))
        self._library.cmb_last_error.restype = ctypes.c_char_p

    def signed_distance(self, first: str, first_pose: Pose, second: str, second_pose: Pose) -> float:
        """Of two bodies given by descriptors, in m; negative where they overlap."""
        scene = ctypes.c_int(0)
        geometry = (ctypes.c_char_p * 2)(first.encode(), second.encode())
        pairs = (ctypes.c_int * 2)(1, 2)
        two, one, backend = ctypes.c_size_t(2), ctypes.c_size_t(1), 0
        self._check(self._library.cmb_intern(geometry, two, pairs, one, backend, ctypes.byref(scene)))
        position = np.concatenate([first_pose.position, second_pose.position])
        rotation = np.concatenate([first_pose.rotation.T.ravel(), second_pose.rotation.T.ravel()])
        distance = np.zeros(1)
        slots = [np.zeros(CAPACITY * width) for width in (1, 1, 3, 3)]
        arrays = [position, rotation, distance, *slots]
        at = [array.ctypes.data_as(ctypes.c_void_p) for array in arrays]
        self._check(self._library.cmb_query_scene(scene, at[0], at[1], two, one, ctypes.c_size_t(CAPACITY), *at[2:]))
        return float(distance[0])

    def _check(self, status: int) -> None:
        assert status == 0, self._library.cmb_last_error().decode()
