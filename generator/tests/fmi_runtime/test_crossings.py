"""Where event indicators change their signs first within a step, against closed forms."""

from __future__ import annotations

import ctypes
import math
import subprocess
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from modelica2fmu.packaging.runtime_sources import runtime_file, runtime_folders
from modelica2fmu.packaging.toolchain import COMPILE_OPTIONS

Indicator = Callable[[float], float]
Found = tuple[float, int, int]
Search = Callable[[Sequence[Indicator], float, float], Found]
ASKED = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_double, ctypes.POINTER(ctypes.c_double))


@pytest.fixture(scope="module")
def search(tmp_path_factory: pytest.TempPathFactory) -> Search:
    target = tmp_path_factory.mktemp("crossings") / "crossings.so"
    options = [option for option in COMPILE_OPTIONS if option != "-fvisibility=hidden"]
    includes = [f"-I{path}" for path in runtime_folders()]
    command = ["gcc", *options, *includes, "-shared", str(runtime_file("fmurt_crossing.c")), "-lm", "-o", str(target)]
    subprocess.run(command, check=True)
    library = ctypes.CDLL(str(target))
    library.fmurt_crossing_create.restype = ctypes.c_void_p
    library.fmurt_crossing_create.argtypes = [ctypes.c_size_t]
    library.fmurt_crossing_destroy.argtypes = [ctypes.c_void_p]
    library.fmurt_crossing_look.argtypes = [
        ctypes.c_void_p,
        ctypes.c_double,
        ctypes.c_void_p,
        ASKED,
        ctypes.c_void_p,
    ]
    library.fmurt_crossing_tell.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p]

    def run(indicators: Sequence[Indicator], begin: float, end: float) -> Found:
        """The time from which on signs are shown that differ, how many evaluations it took, and which differ."""
        asked = []

        def answer(_: object, time: float, values: ctypes._Pointer[ctypes.c_double]) -> int:
            asked.append(time)
            for i, indicator in enumerate(indicators):
                values[i] = indicator(time)
            return 0

        callback = ASKED(answer)
        crossing = library.fmurt_crossing_create(len(indicators))
        for time in (begin, end):
            values = np.array([indicator(time) for indicator in indicators])
            library.fmurt_crossing_look(crossing, time, values.ctypes.data, callback, None)
        first = np.array([indicator(begin) for indicator in indicators])
        shown = np.empty(len(indicators))
        before, after = begin, end
        assert library.fmurt_crossing_tell(crossing, end, shown.ctypes.data) == 0
        while 0.5 * (before + after) not in (before, after):
            middle = 0.5 * (before + after)
            if not library.fmurt_crossing_tell(crossing, middle, shown.ctypes.data):
                break
            if np.any(shown * first <= 0.0):
                after = middle
                signs = sum(1 << i for i in range(len(indicators)) if shown[i] * first[i] <= 0.0)
            else:
                before = middle
        library.fmurt_crossing_destroy(crossing)
        return after, len(asked), signs if after < end else 0

    return run


def jump(at: float, before: float, after: float) -> Indicator:
    return lambda time: before if time < at else after


def depth(at: float) -> Indicator:
    return lambda time: math.expm1(3.0 * (time - at))


def test_a_jump_beside_a_zero_costs_little(search: Search) -> None:
    """Bodies meet, and the speed of their impact jumps to what it is: either way round, nearly at either end."""
    for at in (1.0001, 1.01, 1.05, 1.0999):
        for early, late in ((-0.0125, 0.46), (-3.0, 1e-3)):
            found, evaluations, signs = search([depth(at), jump(at, early, late)], 1.0, 1.1)
            assert found == pytest.approx(at, abs=5e-14)
            assert signs
            assert evaluations <= 20


def test_smooth_zeros_alone(search: Search) -> None:
    found, evaluations, _ = search([lambda time: math.cos(time)], 1.0, 2.0)
    assert found == pytest.approx(math.pi / 2, abs=1e-13)
    assert evaluations <= 12


def test_the_first_of_many(search: Search) -> None:
    """Random zeros and jumps, some at one time, some that keep their signs."""
    random = np.random.default_rng(3)
    for _ in range(300):
        count = int(random.integers(1, 8))
        times = np.sort(random.uniform(2.0, 3.4, count))
        times[random.random(count) < 0.3] = times[0]
        indicators: list[Indicator] = []
        for at in times:
            sign, size, kind = float(random.choice([-1.0, 1.0])), 10.0 ** random.uniform(-8, 4), random.random()
            if kind < 0.4:
                indicators.append(jump(at, -sign * size, sign * 10.0 ** random.uniform(-8, 4)))
            elif kind < 0.7:
                indicators.append(lambda time, at=at, k=sign * size: k * (time - at))
            else:
                indicators.append(lambda time, at=at, k=sign * size: k * ((time - at) ** 3 + 0.1 * (time - at)))
        inside = [at for at in times if at < 3.0]
        if not inside:
            continue
        found, evaluations, signs = search(indicators, 2.0, 3.0)
        assert found == pytest.approx(min(inside), abs=2e-13)
        assert signs
        assert evaluations <= 80


def test_signs_that_do_not_change_are_not_looked_for(search: Search) -> None:
    """`fmurt_watch` does that."""
    found, evaluations, signs = search([lambda time: (time - 0.25) * (time - 0.75)], 0.0, 1.0)
    assert (found, evaluations, signs) == (1.0, 0, 0)
