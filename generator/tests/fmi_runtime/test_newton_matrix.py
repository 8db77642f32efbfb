"""The integrator's linear solver, which eliminates sparse rows first, against numpy."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable

import fixture_models as models
import numpy as np
import pytest
from modelica2fmu.packaging.dependencies import find_sundials
from modelica2fmu.packaging.runtime_sources import runtime_file, runtime_folders
from numpy.typing import NDArray

Array = NDArray[np.float64]
Solver = Callable[[Array, Array], "Array | None"]


@pytest.fixture(scope="module")
def solve(tmp_path_factory: pytest.TempPathFactory) -> Solver:
    target = tmp_path_factory.mktemp("newton") / "newton.so"
    sundials = find_sundials()
    sources = [runtime_file("fmurt_dense.c"), runtime_file("fmurt_lu.c"), models.FIXTURES / "newton.c"]
    command = [
        "gcc",
        "-std=c11",
        "-O2",
        "-shared",
        "-fPIC",
        *(f"-I{path}" for path in (*runtime_folders(), sundials.include)),
    ]
    subprocess.run([*command, *map(str, sources), str(sundials.archive), "-lm", "-o", str(target)], check=True)
    library = ctypes.CDLL(str(target))

    def run(a: Array, b: Array) -> Array | None:
        matrix, right, x = np.array(a, order="F"), b.copy(), np.zeros(2 * len(b))
        arguments = (ctypes.c_void_p(item.ctypes.data) for item in (matrix, right, x))
        if library.solve_newton(len(b), *arguments) != 0:
            return None
        assert np.array_equal(x[: len(b)], x[len(b) :])  # the same in place
        return x[: len(b)]

    return run


def check(solve: Solver, a: Array, random: np.random.Generator) -> None:
    x = random.standard_normal(len(a))
    found = solve(a, a @ x)
    assert found is not None
    # Backward stable: the residual is of the size of rounding, whatever the condition.
    assert np.linalg.norm(a @ found - a @ x) <= 1e-14 * len(a) * np.linalg.norm(a) * np.linalg.norm(found)


@pytest.mark.parametrize("gamma", [1e-6, 1e-3, 0.1, 10.0])
def test_mechanisms(solve: Solver, gamma: float) -> None:
    """Positions and speeds in any order, stiff forces, some positions with rates of several speeds (quaternions)."""
    random = np.random.default_rng(4)
    for n in (1, 2, 5, 12, 24):
        kinematics = np.eye(n)
        for row in range(0, n, 3):
            kinematics[row, random.integers(0, n, 3)] = random.uniform(-0.5, 0.5, 3)
        stiffness, damping = 1e5 * random.standard_normal((n, n)), 1e2 * random.standard_normal((n, n))
        jacobian = np.block([[np.zeros((n, n)), kinematics], [stiffness, damping]])
        order = random.permutation(2 * n)
        check(solve, (np.eye(2 * n) - gamma * jacobian)[np.ix_(order, order)], random)


def test_any_matrices(solve: Solver) -> None:
    """Full, sparse and diagonal ones, rows that look sparse but hold the pivots of each other."""
    random = np.random.default_rng(5)
    for n in (1, 2, 3, 7, 20, 60):
        for density in (0.0, 1 / n, 0.3, 1.0):
            matrix = np.where(random.random((n, n)) < density, random.standard_normal((n, n)), 0.0)
            check(solve, matrix + np.diag(random.uniform(0.5, 2.0, n) * random.choice([-1, 1], n)), random)


def test_a_pivot_of_zero_needs_other_rows(solve: Solver) -> None:
    check(solve, np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1e-9, 1.0]]), np.random.default_rng(6))


@pytest.mark.parametrize("matrix", [np.zeros((2, 2)), np.ones((3, 3)), np.full((2, 2), np.nan)])
def test_singular_matrices_are_refused(solve: Solver, matrix: Array) -> None:
    assert solve(matrix, np.ones(len(matrix))) is None
