"""Interpolation in tables, against SciPy, closed forms, and the Standard Library's own C where it is present."""

from __future__ import annotations

import ctypes
import subprocess
from pathlib import Path

import numpy as np
import pytest
from contact_foundation.errors import InputError, UnsupportedModelError
from modelica2fmu.library.standard_library import find_standard_library
from modelica2fmu.library.table_files import read_table
from modelica2fmu.packaging.runtime_sources import runtime_file, runtime_folders
from scipy.interpolate import Akima1DInterpolator, PchipInterpolator, RegularGridInterpolator

LINEAR, AKIMA, CONSTANT, FRITSCH_BUTLAND, STEFFEN, MODIFIED_AKIMA = range(1, 7)
HOLD, LAST_TWO_POINTS, PERIODIC, NO_EXTRAPOLATION = range(1, 5)
ALL_EVENTS, AT_JUMPS, NO_EVENTS = range(1, 4)
SMOOTH = [AKIMA, FRITSCH_BUTLAND, STEFFEN, MODIFIED_AKIMA]
DOUBLES = np.ctypeslib.ndpointer(dtype=np.float64, flags="C")

X = np.array([-1.0, 0.0, 0.5, 2.0, 2.25, 4.0, 7.0])
Y = np.array([3.0, 1.0, 1.5, 4.0, 4.5, -2.0, 0.5])
INSIDE = np.linspace(-1, 7, 401)

# Ends of errors: what a real ModelicaFormatError does not return from.
MESSAGES = """
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
int failures = 0;
void ModelicaFormatError(const char *f, ...) { (void)f; ++failures; }
void ModelicaError(const char *f) { (void)f; abort(); }
void ModelicaVFormatError(const char *f, va_list a) { (void)f; (void)a; abort(); }
void ModelicaFormatMessage(const char *f, ...) { (void)f; }
void ModelicaFormatWarning(const char *f, ...) { (void)f; }
void ModelicaVFormatMessage(const char *f, va_list a) { (void)f; (void)a; }
int usertab(char *name, int n, int *d, int *c, double **t) { return 1; }
void ModelicaVFormatWarning(const char *f, va_list a) { (void)f; (void)a; }
"""


def library(folder: Path, sources: list[Path], *options: str) -> ctypes.CDLL:
    (folder / "messages.c").write_text(MESSAGES)
    output = folder / "tables.so"
    command = ["gcc", "-w", "-O1", "-shared", "-fPIC", *options, "-o", str(output), str(folder / "messages.c")]
    subprocess.run([*command, *map(str, sources), "-lm"], check=True)
    return ctypes.CDLL(str(output))


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    includes = [f"-I{path}" for path in runtime_folders()]
    found = library(tmp_path_factory.mktemp("tables"), [runtime_file("fmurt_table.c")], *includes)
    real, whole = ctypes.c_double, ctypes.c_int
    found.fmurt_table_value.argtypes = [DOUBLES, DOUBLES, whole, whole, whole, real, whole]
    found.fmurt_table_surface.argtypes = [DOUBLES, whole, DOUBLES, whole, DOUBLES, whole, whole, real, real, whole]
    found.fmurt_table_at_time.argtypes = [DOUBLES, DOUBLES, whole, whole, whole, *[real] * 5, whole]
    found.fmurt_table_next_event.argtypes = [DOUBLES, whole, whole, real, real, whole, real]
    for name in ("value", "surface", "at_time", "next_event"):
        getattr(found, f"fmurt_table_{name}").restype = real
    return found


def curve(tables, smoothness, extrapolation, points, order=0, x=X, y=Y):
    return np.array([tables.fmurt_table_value(x, y, len(x), smoothness, extrapolation, u, order) for u in points])


def test_linear_segments(tables):
    assert curve(tables, LINEAR, HOLD, np.linspace(-3, 9, 121)) == pytest.approx(
        np.interp(np.linspace(-3, 9, 121), X, Y)
    )


def test_constant_segments_jump_at_the_points(tables):
    expected = [3, 3, 1, 1.5, 1.5, 4, 0.5]
    assert list(curve(tables, CONSTANT, HOLD, [-2, -0.5, 0, 0.5, 1.9, 2.2, 7])) == expected


@pytest.mark.parametrize(("smoothness", "method"), [(AKIMA, "akima"), (MODIFIED_AKIMA, "makima")])
def test_akima(tables, smoothness, method):
    expected = Akima1DInterpolator(X, Y, method=method)
    assert curve(tables, smoothness, HOLD, INSIDE) == pytest.approx(expected(INSIDE), abs=1e-12)
    assert curve(tables, smoothness, HOLD, INSIDE, order=1) == pytest.approx(expected.derivative()(INSIDE), abs=1e-11)
    second = curve(tables, smoothness, LAST_TWO_POINTS, INSIDE[:-1], order=2)
    assert second == pytest.approx(expected.derivative(2)(INSIDE[:-1]), abs=1e-10)
    assert not curve(tables, smoothness, LAST_TWO_POINTS, np.array([-3.0, 8.0]), order=2).any()


def test_fritsch_butland(tables):
    first, last = X[1], X[-2]
    inner = INSIDE[(first < INSIDE) & (last > INSIDE)]  # at the ends SciPy has another rule
    expected = PchipInterpolator(X, Y)
    assert curve(tables, FRITSCH_BUTLAND, HOLD, inner) == pytest.approx(expected(inner), abs=1e-12)


def test_steffen_has_the_parabola_s_slope_where_that_is_moderate(tables):
    x, y = np.array([0.0, 1.0, 3.0, 4.0]), np.array([0.0, 1.0, 2.5, 4.0])
    parabola = np.polynomial.Polynomial.fit(x[:3], y[:3], 2)
    slope = curve(tables, STEFFEN, HOLD, [1.0], order=1, x=x, y=y)[0]
    assert slope == pytest.approx(parabola.deriv()(1.0))
    steep = np.array([0.0, 0.1, 9.0, 9.1])  # the parabola would overshoot: twice the smaller secant instead
    assert curve(tables, STEFFEN, HOLD, [1.0], order=1, x=x, y=steep)[0] == pytest.approx(0.2)


@pytest.mark.parametrize("smoothness", [FRITSCH_BUTLAND, STEFFEN])
def test_monotone_curves_keep_the_points_bounds(tables, smoothness):
    values = curve(tables, smoothness, HOLD, INSIDE)
    interval = np.clip(np.searchsorted(X, INSIDE, side="right") - 1, 0, len(X) - 2)
    low, high = np.minimum(Y[interval], Y[interval + 1]), np.maximum(Y[interval], Y[interval + 1])
    assert (values >= low - 1e-12).all()
    assert (values <= high + 1e-12).all()


@pytest.mark.parametrize("smoothness", [LINEAR, *SMOOTH])
def test_smooth_curves_continue_with_their_slope(tables, smoothness):
    step = 1e-7
    for number, beyond in ((0, X[0] - 2.0), (-1, X[-1] + 2.0)):
        end = X[number]
        inside = end + step * np.sign(end - beyond)
        slope = (curve(tables, smoothness, LAST_TWO_POINTS, [end]) - curve(tables, smoothness, HOLD, [inside])) / (
            end - inside
        )
        value = curve(tables, smoothness, LAST_TWO_POINTS, [beyond])[0]
        assert value == pytest.approx(Y[number] + slope[0] * (beyond - end), abs=1e-5)


def test_periodic_curves_repeat(tables):
    points = np.linspace(-0.9, 6.9, 40)
    for shift in (-16.0, 8.0, 80.0):
        repeated = curve(tables, AKIMA, PERIODIC, points + shift)
        assert repeated == pytest.approx(curve(tables, AKIMA, HOLD, points), abs=1e-12)


def test_no_extrapolation_is_an_error(tables):
    before = ctypes.c_int.in_dll(tables, "failures").value
    curve(tables, LINEAR, NO_EXTRAPOLATION, [-1.0, 7.0])
    assert ctypes.c_int.in_dll(tables, "failures").value == before
    curve(tables, LINEAR, NO_EXTRAPOLATION, [-1.01])
    assert ctypes.c_int.in_dll(tables, "failures").value == before + 1


def test_surface_is_bilinear(tables):
    x, y = np.array([0.0, 1.0, 3.0]), np.array([-1.0, 0.0, 2.0, 5.0])
    z = np.random.default_rng(1).normal(size=(3, 4))
    places = np.random.default_rng(2).uniform([0, -1], [3, 5], size=(50, 2))
    expected = RegularGridInterpolator((x, y), z)(places)

    def surface(u, v, order=0, extrapolation=LAST_TWO_POINTS):
        return tables.fmurt_table_surface(x, 3, y, 4, z, LINEAR, extrapolation, u, v, order)

    assert [surface(u, v) for u, v in places] == pytest.approx(expected)
    for u, v in places:
        assert surface(u, v, 1) == pytest.approx((surface(u + 1e-6, v) - surface(u - 1e-6, v)) / 2e-6, abs=1e-6)
        assert surface(u, v, 2) == pytest.approx((surface(u, v + 1e-6) - surface(u, v - 1e-6)) / 2e-6, abs=1e-6)
    assert surface(4.0, 7.0) == pytest.approx(
        RegularGridInterpolator((x, y), z, bounds_error=False, fill_value=None)((4.0, 7.0))
    )
    assert surface(-2.0, 9.0, extrapolation=HOLD) == pytest.approx(z[0, -1])


# --- over the time ---

TIMES = np.array([0.0, 1.0, 1.0, 2.0, 3.0])
VALUES = np.array([0.0, 1.0, 5.0, 5.0, 2.0])


def passing(tables, smoothness, extrapolation, start, shift, events, stop):
    """Events and values of a simulation: on both sides of each event, and between events."""
    x, y = TIMES, VALUES

    def next_event(time):
        return tables.fmurt_table_next_event(x, len(x), extrapolation, start, shift, events, time)

    def value(time, following, before):
        return tables.fmurt_table_at_time(
            x, y, len(x), smoothness, extrapolation, start, shift, time, following, before, 0
        )

    time, rows = -1.0, []
    following = next_event(time)
    while time < stop:
        reached = min(following, stop)
        middle = (time + reached) / 2
        rows.append((middle, value(middle, following, following)))
        if following > stop:
            break
        rows.append((reached, value(reached, following, following)))  # still on the left
        before, following, time = following, next_event(reached), reached
        rows.append((time, value(time, following, before)))
    return rows


def test_a_jump_is_taken_at_its_event(tables):
    rows = passing(tables, LINEAR, HOLD, -10.0, 0.0, ALL_EVENTS, 4.0)
    assert rows == pytest.approx(
        np.array(
            [
                (-0.5, 0), (0, 0), (0, 0), (0.5, 0.5), (1, 1), (1, 5), (1.5, 5), (2, 5), (2, 5), (2.5, 3.5),
                (3, 2), (3, 2), (3.5, 2),
            ]
        )
    )  # fmt: skip


def test_only_jumps_and_ends_make_events(tables):
    times = sorted({time for time, _ in passing(tables, LINEAR, HOLD, -10.0, 0.0, AT_JUMPS, 4.0)})
    assert times == pytest.approx([-0.5, 0, 0.5, 1, 2, 3, 3.5])  # those between events among them


def test_nothing_before_the_start_and_a_shifted_curve_after(tables):
    rows = passing(tables, LINEAR, HOLD, 0.5, 0.25, ALL_EVENTS, 1.0)
    assert rows == pytest.approx(np.array([(-0.25, 0), (0.5, 0), (0.5, 0.25), (0.75, 0.5)]))


def test_a_periodic_curve_repeats_with_its_events(tables):
    rows = dict(passing(tables, CONSTANT, PERIODIC, 0.0, 0.0, ALL_EVENTS, 9.0))
    for time in (0.5, 1.5, 2.5):
        assert rows[time] == rows[time + 3] == rows[time + 6]
    assert (rows[0.5], rows[1.5], rows[2.5]) == (0, 5, 5)
    assert rows[3.0] == 0  # of the new period: no value of the last point


# --- the Standard Library's own C ---


@pytest.fixture(scope="module")
def original(tmp_path_factory):
    found = find_standard_library()
    folder = Path(found.folder) / "Modelica" / "Resources" / "C-Sources"
    if not (folder / "ModelicaStandardTables.c").is_file():
        pytest.skip("needs the complete Modelica Standard Library (MODELICAPATH names none)")
    result = library(
        tmp_path_factory.mktemp("original"), [folder / "ModelicaStandardTables.c"], f"-I{folder}", "-DNO_FILE_SYSTEM",
    )  # fmt: skip
    text, size, whole, real = ctypes.c_char_p, ctypes.c_size_t, ctypes.c_int, ctypes.c_double
    columns = ctypes.POINTER(ctypes.c_int)
    result.ModelicaStandardTables_CombiTable1D_init2.argtypes = [
        text, text, DOUBLES, size, size, columns, size, whole, whole, whole,
    ]  # fmt: skip
    result.ModelicaStandardTables_CombiTable1D_init2.restype = ctypes.c_void_p
    result.ModelicaStandardTables_CombiTable1D_getValue.argtypes = [ctypes.c_void_p, whole, real]
    result.ModelicaStandardTables_CombiTable1D_getValue.restype = real
    return result


@pytest.mark.parametrize("extrapolation", [HOLD, LAST_TWO_POINTS, PERIODIC])
@pytest.mark.parametrize("smoothness", [LINEAR, AKIMA, CONSTANT, FRITSCH_BUTLAND, STEFFEN, MODIFIED_AKIMA])
@pytest.mark.parametrize("count", [1, 2, 3, 4, 7])
def test_curves_are_those_of_the_standard_library(tables, original, smoothness, extrapolation, count):
    x, y = X[:count].copy(), Y[:count].copy()
    columns = (ctypes.c_int * 1)(2)
    table = original.ModelicaStandardTables_CombiTable1D_init2(
        b"NoName", b"NoName", np.ascontiguousarray(np.stack([x, y], axis=1)), count, 2, columns, 1, smoothness,
        extrapolation, 0,
    )  # fmt: skip
    points = np.linspace(-7.3, 12.1, 173)
    expected = [original.ModelicaStandardTables_CombiTable1D_getValue(table, 1, u) for u in points]
    assert curve(tables, smoothness, extrapolation, points, x=x, y=y) == pytest.approx(expected, abs=1e-11)


# --- files ---


def test_tables_are_read_from_text(tmp_path):
    file = tmp_path / "t.txt"
    file.write_text("#1\n# a comment\ndouble a(1,2) # 1 row\n 9 8\nfloat b(2, 3)\n1 2.5,3e1\n\n4\t5 6 # end\n")
    assert read_table(file, "b").tolist() == [[1, 2.5, 30], [4, 5, 6]]
    assert read_table(file, "a").tolist() == [[9, 8]]
    with pytest.raises(InputError, match="no table c"):
        read_table(file, "c")


def test_tables_are_read_from_comma_separated_values(tmp_path):
    file = tmp_path / "t.csv"
    file.write_text("time;x\n0;1\n\n2;3.5\n")
    assert read_table(file, "Values", ";", 1).tolist() == [[0, 1], [2, 3.5]]
    with pytest.raises(InputError, match="number"):
        read_table(file, "Values", ";", 0)


@pytest.mark.parametrize(
    ("text", "message"),
    [("double a(1,1)\n1\n", "#1"), ("#1\ndouble a(2,2)\n1 2 3\n", "3 numbers instead of 2 times 2"),
     ("#1\ndouble a(99999,99999)\n", "too large"), ("#1\ndouble a(1,1)\nx\n", "number is needed")],
)  # fmt: skip
def test_wrong_files_are_refused_by_name(tmp_path, text, message):
    file = tmp_path / "t.txt"
    file.write_text(text)
    with pytest.raises(InputError, match=message) as caught:
        read_table(file, "a")
    assert caught.value.place.file == file


def test_files_of_matlab_are_refused(tmp_path):
    (tmp_path / "t.mat").write_bytes(b"MATLAB")
    with pytest.raises(UnsupportedModelError, match="MATLAB"):
        read_table(tmp_path / "t.mat", "a")
