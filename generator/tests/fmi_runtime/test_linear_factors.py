"""Factors of linear systems, which pass over zeros, against the textbook's algorithm: the same to the last bit."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable

import numpy as np
import pytest
from modelica2fmu.packaging.runtime_sources import runtime_file, runtime_folders
from modelica2fmu.packaging.toolchain import COMPILE_OPTIONS
from numpy.typing import NDArray

Array = NDArray[np.float64]
Factors = tuple[int, Array, list[int]]
Factorize = Callable[[Array], Factors]


@pytest.fixture(scope="module")
def factorize(tmp_path_factory: pytest.TempPathFactory) -> Factorize:
    target = tmp_path_factory.mktemp("factors") / "factors.so"
    options = [option for option in COMPILE_OPTIONS if option != "-fvisibility=hidden"]
    includes = [f"-I{path}" for path in runtime_folders()]
    command = ["gcc", *options, *includes, "-shared", str(runtime_file("fmurt_lu.c")), "-lm", "-o", str(target)]
    subprocess.run(command, check=True)
    library = ctypes.CDLL(str(target))
    library.fmurt_lu_factorize.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_double]

    def run(matrix: Array) -> Factors:
        kept, pivot = np.array(matrix, order="F"), np.zeros(len(matrix), dtype=np.int32)
        flag = library.fmurt_lu_factorize(len(matrix), kept.ctypes.data, pivot.ctypes.data, 0.0)
        return flag, kept, [int(row) for row in pivot]

    return run


def textbook(matrix: Array) -> Factors:
    """Column after column with partial pivoting (Golub and Van Loan, Matrix Computations, section 3.4)."""
    a = np.array(matrix)
    pivot = []
    for k in range(len(a)):
        row = k + int(np.argmax(np.abs(a[k:, k])))
        pivot.append(row)
        if a[row, k] == 0.0:
            return k + 1, a, pivot
        a[[k, row], k:] = a[[row, k], k:]  # rows of finished columns stay, as LINPACK has it
        a[k + 1 :, k] /= a[k, k]
        a[k + 1 :, k + 1 :] -= np.outer(a[k + 1 :, k], a[k, k + 1 :])
    return 0, a, pivot


def legs(random: np.random.Generator, n: int, legs_of: int, trunk: int) -> Array:
    """Legs beside each other that share a trunk; rows in any order within a few."""
    filled = np.zeros((n, n), dtype=bool)
    for begin in range(0, n - trunk, legs_of):
        end = min(begin + legs_of, n - trunk)
        filled[begin:end, begin:end] = True
    filled[:, n - trunk :] = filled[n - trunk :, :] = True
    matrix = np.where(filled, random.standard_normal((n, n)), 0.0)
    return matrix[np.argsort(np.arange(n) + random.uniform(0, 4, n))]


def chain(random: np.random.Generator, n: int, width: int) -> Array:
    """Each body touches its neighbours alone."""
    block = np.arange(n) // width
    near = np.abs(block[:, None] - block[None, :]) <= 1
    return np.where(near, random.standard_normal((n, n)), 0.0) + np.diag(random.uniform(-5, 5, n))


def scattered(random: np.random.Generator, n: int, density: float) -> Array:
    matrix = np.where(random.random((n, n)) < density, random.standard_normal((n, n)), 0.0)
    return matrix + np.diag(np.where(random.random(n) < 0.8, random.standard_normal(n), 0.0))


def check(factorize: Factorize, matrix: Array) -> None:
    flag, factors, pivot = factorize(matrix)
    expected, exact, rows = textbook(matrix)
    assert flag == expected
    if flag == 0:
        assert pivot == rows
        assert np.array_equal(factors, exact)


def test_robots_and_stacks(factorize: Factorize) -> None:
    random = np.random.default_rng(1)
    for _ in range(40):
        n = int(random.integers(5, 70))
        check(factorize, legs(random, n, int(random.integers(1, 6)), int(random.integers(1, min(n, 8)))))
        check(factorize, chain(random, n, int(random.integers(1, 14))))


def test_any_matrices(factorize: Factorize) -> None:
    """Sizes below and beside those of registers, and with more rows than are told apart; many are singular."""
    random = np.random.default_rng(2)
    for n in (*range(1, 14), 31, 32, 33, 64, 255, 256, 257, 270):
        for density in (0.0, 0.05, 0.3, 1.0):
            check(factorize, scattered(random, n, density))
