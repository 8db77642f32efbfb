"""The linear and nonlinear solvers that generated code calls, against numpy and known roots."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable

import fixture_models as models
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from modelica2fmu.packaging.runtime_sources import runtime_file, runtime_folders
from numpy.typing import NDArray

Array = NDArray[np.float64]
OK, DISCARD, ERROR = 0, 1, 2


def pointer(array: NDArray[np.float64] | NDArray[np.int32]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


@pytest.fixture(scope="session")
def library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    target = tmp_path_factory.mktemp("solvers") / "solvers.so"
    sources = [runtime_file(f"fmurt_{name}.c") for name in ("dead_center", "linear", "lu", "nonlinear")]
    sources.append(models.FIXTURES / "systems.c")
    command = [
        "gcc",
        "-std=c11",
        "-O2",
        "-ffp-contract=off",
        "-shared",
        "-fPIC",
        *(f"-I{path}" for path in runtime_folders()),
    ]
    command += map(str, sources)
    subprocess.run([*command, "-lm", "-o", str(target)], check=True)
    loaded = ctypes.CDLL(str(target))
    loaded.last_message.restype = ctypes.c_char_p
    return loaded


@pytest.fixture(scope="session")
def solve(library: ctypes.CDLL) -> Callable[[Array, Array], tuple[int, Array]]:
    def solve_linear(a: Array, b: Array) -> tuple[int, Array]:
        matrix, x = np.array(a, order="F", copy=True), b.copy()
        scale, pivot = np.zeros(len(b)), np.zeros(len(b), dtype=np.int32)
        parts = pointer(matrix), pointer(scale), pointer(pivot)
        result = library.fmurt_factorize(len(b), *parts)
        if result == 0:
            library.fmurt_substitute(len(b), *parts, pointer(x))
        return result, x

    return solve_linear


def test_random_systems_are_solved_to_rounding(solve: Callable[[Array, Array], tuple[int, Array]]) -> None:
    random = np.random.default_rng(1)
    for n in (1, 2, 3, 5, 10, 24, 60, 150):
        a, x = random.standard_normal((n, n)), random.standard_normal(n)
        result, found = solve(a, a @ x)
        assert result == 0
        assert np.linalg.norm(a @ found - a @ x) <= 1e-13 * n * np.linalg.norm(a) * np.linalg.norm(x)
        assert np.allclose(found, x, rtol=0.0, atol=1e-14 * n * np.linalg.cond(a))


def eliminated(a: Array) -> tuple[Array, list[int]]:
    """Factors and pivots by elimination column after column, in the order of operations that the library promises."""
    a, pivots = a.copy(), []
    for k in range(len(a)):
        for j, row in enumerate(pivots):
            a[[j, row], k] = a[[row, j], k]
            a[j + 1 :, k] -= a[j, k] * a[j + 1 :, j]
        row = k + int(np.argmax(np.abs(a[k:, k])))
        pivots.append(row)
        a[[k, row], k] = a[[row, k], k]  # rows of finished columns stay
        a[k + 1 :, k] /= a[k, k]
    return a, pivots


def test_factors_are_those_of_one_column_after_the_other_to_the_last_bit(library: ctypes.CDLL) -> None:
    """However many columns are eliminated at once, and however wide the registers are."""
    random = np.random.default_rng(8)
    for n in (1, 2, 3, 4, 5, 6, 7, 8, 11, 24, 61):
        for density in (0.2, 1.0):
            a = np.where(random.random((n, n)) < density, random.standard_normal((n, n)), 0.0) + np.eye(n)
            a *= np.exp2(random.integers(-60, 60, n))[:, None]
            matrix, scale, pivot = np.array(a, order="F"), np.zeros(n), np.zeros(n, dtype=np.int32)
            assert library.fmurt_factorize(n, pointer(matrix), pointer(scale), pointer(pivot)) == 0
            factors, pivots = eliminated(a * scale[:, None])
            assert np.array_equal(matrix, factors)
            assert list(pivot) == pivots


def test_rows_are_scaled_by_powers_of_two_to_sizes_next_to_one(library: ctypes.CDLL) -> None:
    sizes = np.array([5e-324, 1e-310, 2.2250738585072014e-308, 1e-300, 1e-9, 0.5, 1.0, 3.0, 1e9, 1e300, 1.7e308])
    n = len(sizes)
    matrix, scale, pivot = np.array(np.diag(sizes), order="F"), np.zeros(n), np.zeros(n, dtype=np.int32)
    library.fmurt_factorize(n, pointer(matrix), pointer(scale), pointer(pivot))
    exponents = np.frexp(sizes)[1]
    assert np.array_equal(scale, np.ldexp(1.0, np.minimum(-exponents, 1000)))


def test_many_right_hand_sides_are_solved_at_once(library: ctypes.CDLL) -> None:
    random = np.random.default_rng(3)
    lanes = 4
    for n in (1, 2, 7, 24):
        a, x = random.standard_normal((n, n)), random.standard_normal((n, lanes))
        matrix, right = np.array(a, order="F", copy=True), np.ascontiguousarray(a @ x)
        scale, pivot = np.zeros(n), np.zeros(n, dtype=np.int32)
        assert library.fmurt_factorize(n, pointer(matrix), pointer(scale), pointer(pivot)) == 0
        library.fmurt_substitute_lanes(n, pointer(matrix), pointer(scale), pointer(pivot), pointer(right))
        assert np.allclose(right, x, rtol=0.0, atol=1e-14 * n * np.linalg.cond(a))


def test_rows_and_columns_of_different_units(solve: Callable[[Array, Array], tuple[int, Array]]) -> None:
    random = np.random.default_rng(2)
    a = random.standard_normal((12, 12))
    x = random.standard_normal(12)
    rows, columns = 10.0 ** random.integers(-12, 12, 12), 10.0 ** random.integers(-12, 12, 12)
    result, found = solve(a * rows[:, None] * columns, rows * (a @ x))
    assert result == 0
    assert np.allclose(found * columns, x, rtol=1e-10)


@pytest.mark.parametrize(
    ("matrix", "column"),
    [
        ([[0.0]], 1),
        ([[1.0, 2.0], [2.0, 4.0]], 2),
        ([[0.0, 1.0], [0.0, 3.0]], 1),
        ([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]], 3),
        ([[1e-8, 2e-8], [2e8, 4e8]], 2),
        ([[1.0, 0.0], [0.0, np.nan]], 2),
        ([[1.0, np.inf], [1.0, 1.0]], 2),
    ],
)
def test_singular_systems_name_their_column(
    matrix: list[list[float]], column: int, solve: Callable[[Array, Array], tuple[int, Array]]
) -> None:
    assert solve(np.array(matrix), np.ones(len(matrix)))[0] == column


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.lists(st.integers(-3, 3), min_size=4, max_size=4), min_size=4, max_size=4))
def test_small_integer_systems(solve: Callable[[Array, Array], tuple[int, Array]], rows: list[list[int]]) -> None:
    a = np.array(rows, dtype=float)
    determinant = round(float(np.linalg.det(a)))
    result, x = solve(a, a @ np.arange(1.0, 5.0))
    assert (result == 0) == (determinant != 0)
    if determinant != 0:
        assert np.allclose(x, np.arange(1.0, 5.0), rtol=1e-11)


@pytest.fixture(scope="session")
def solve_system(library: ctypes.CDLL) -> Callable[[int, list[float]], tuple[int, Array, str]]:
    def run(number: int, start: list[float]) -> tuple[int, Array, str]:
        n = len(start)
        x, work = np.array(start), np.full(n * n + 7 * n + 1, 0.25)
        integers = np.zeros(n, dtype=np.int32)
        result = library.solve_system(number, n, pointer(x), ctypes.c_double(1e-10), pointer(work), pointer(integers))
        assert work[-1] == 0.25  # not a number more than promised
        return result, x, library.last_message().decode()

    return run


@pytest.mark.parametrize(
    ("number", "start", "root"),
    [
        (0, [-1.2, 1.0], [1.0, 1.0]),
        (1, [0.0, 1.0], [1.098159e-5, 9.106146]),
        (2, [10.0], [1.0]),
        (7, [3.0], [0.0]),
        (7, [0.0], [0.0]),
    ],
)
def test_roots_are_found(
    number: int, start: list[float], root: list[float], solve_system: Callable[..., tuple[int, Array, str]]
) -> None:
    result, x, _ = solve_system(number, start)
    assert result == OK
    assert x == pytest.approx(root, rel=1e-6, abs=1e-10)


def test_a_linkage_closes(solve_system: Callable[..., tuple[int, Array, str]]) -> None:
    result, (p, q), _ = solve_system(4, [1.0, 0.5])
    assert result == OK
    # law of cosines in the triangle of the sides 1, 2, 2.5
    assert np.cos(p) == pytest.approx((1.0 + 6.25 - 4.0) / 5.0, abs=1e-12)
    assert np.cos(q) == pytest.approx((4.0 + 6.25 - 1.0) / 10.0, abs=1e-12)


def test_what_has_no_root_is_discarded(solve_system: Callable[..., tuple[int, Array, str]]) -> None:
    result, _, message = solve_system(3, [2.0])
    assert result == DISCARD
    assert "does not converge" in message or "singular" in message
    assert solve_system(2, [-1.0])[0] == DISCARD
    assert solve_system(6, [1.0])[0] == ERROR


def test_a_singular_jacobian_at_the_root_is_no_failure(solve_system: Callable[..., tuple[int, Array, str]]) -> None:
    result, x, _ = solve_system(5, [1.0, 7.0])
    assert result == OK
    assert x.tolist() == [1.0, 7.0]
    result, _, message = solve_system(5, [3.0, 7.0])
    assert result == DISCARD
    assert "singular in unknown 2" in message


@pytest.fixture(scope="session")
def follow_system(library: ctypes.CDLL) -> Callable[[int, list[float], int], tuple[int, Array]]:
    def run(number: int, accepted: list[float], following: int) -> tuple[int, Array]:
        n = len(accepted)
        x, work = np.array(accepted) + 7.0, np.full(n * n + 7 * n + 1, 0.25)
        integers = np.zeros(n, dtype=np.int32)
        kept = np.array(accepted)
        result = library.follow_system(
            number, n, pointer(kept), following, pointer(x), pointer(work), pointer(integers)
        )
        assert work[-1] == 0.25  # not a number more than promised
        assert kept.tolist() == accepted
        return result, x

    return run


SOLVE, FOLLOW_OR_SOLVE, FOLLOW = 0, 1, 2
CLOSURES = np.array([[0.86321, 0.38976], [-0.86321, -0.38976]])  # of system 4, a triangle of sides 1, 2 and 2.5


def test_solutions_are_followed_from_the_accepted_ones(follow_system: Callable[..., tuple[int, Array]]) -> None:
    for closure in CLOSURES:
        for way in np.random.default_rng(4).uniform(-0.05, 0.05, (20, 2)):
            result, x = follow_system(4, [*(closure + way)], FOLLOW)
            assert result == OK
            assert np.cos(x[0]) + 2.0 * np.cos(x[1]) == pytest.approx(2.5, abs=1e-11)
            assert np.sin(x[0]) == pytest.approx(2.0 * np.sin(x[1]), abs=1e-11)
            assert x == pytest.approx(closure, abs=2e-3)


def residuals_in_a_triangle(x: Array) -> tuple[Array, Array]:
    """System 4 and its Jacobian."""
    first, second = np.cos(x[0]) + 2.0 * np.cos(x[1]) - 2.5, np.sin(x[0]) - 2.0 * np.sin(x[1])
    matrix = [[-np.sin(x[0]), -2.0 * np.sin(x[1])], [np.cos(x[0]), -2.0 * np.cos(x[1])]]
    return np.array([first, second]), np.array(matrix)


def gone_slowly(start: list[float]) -> Array:
    """What x becomes while the residual that it starts with vanishes by and by; not a number where it cannot."""
    x, whole = np.array(start), residuals_in_a_triangle(np.array(start))[0]
    for share in np.linspace(1.0, 0.0, 2001)[1:]:
        for _ in range(2):
            residual, matrix = residuals_in_a_triangle(x)
            change = np.linalg.solve(matrix, residual - share * whole)
            if np.max(np.abs(change)) > 0.05:
                return np.full(2, np.nan)
            x = x - change
    return x


def test_following_takes_no_other_solution(follow_system: Callable[..., tuple[int, Array]]) -> None:
    """Where Newton's iteration would come to another closure, or to the same after turns, a step is too long."""
    random, refused = np.random.default_rng(5), 0
    near = CLOSURES[0] + random.uniform(-0.2, 0.2, (50, 2))
    starts = [*near.tolist(), *random.uniform(-3.0, 3.0, (25, 2)).tolist()]
    for start in starts:
        result, x = follow_system(4, start, FOLLOW)
        refused += result == DISCARD
        if result == OK:
            assert x == pytest.approx(gone_slowly(start), abs=1e-6)
    assert 0.5 < refused / len(starts) < 0.9
    assert follow_system(4, [0.1, -2.5], FOLLOW)[0] == DISCARD
    assert follow_system(4, [0.1, -2.5], FOLLOW_OR_SOLVE)[0] == OK


def test_a_kink_is_followed_in_small_steps(follow_system: Callable[..., tuple[int, Array]]) -> None:
    """System 8: x + 10 max(x, 0) = 0.1. The Jacobian beside the kink is wrong beyond it, however short the step."""
    assert follow_system(8, [-1e-3], FOLLOW)[1] == pytest.approx([0.1 / 11.0])
    assert follow_system(8, [-1e-3], FOLLOW)[0] == OK
