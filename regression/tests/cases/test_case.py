"""Reading cases: what is right is read, what is wrong is named."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_foundation.errors import InputError, ProblemList
from fmu_regression.cases.case import find_cases, load_case
from fmu_regression.compare.checks import BoundCheck, EventCheck, MeanCheck, MonotonicCheck, SignalCheck, ValueCheck

GOOD = """
[case]
description = "A mass that bounces"
model = "Package.Model"
package = "Package.mo"
sources = ["../library"]
requires = ["msl"]
reference = "mass.csv"
stop = 2
tolerance = 1e-8
interval = 0.01
mode = "both"
parameters = { "mass.m" = 2.0, "wall.thin" = true }

[[signal]]
name = "a[1]"
tolerance = 1e-6
window = [0, 1.5]
tube = 1e-3

[[value]]
sum = ["a", "b"]
expected = 3
tolerance = 0.1

[[event]]
name = "v"
threshold = 0
direction = "falling"
times = [0.5, 1]
tolerance = 1e-6
value_of = "h"
values = [1, 0.5]
value_tolerance = 1e-3

[[mean]]
name = "f"
relative_tolerance = 0.01
window = [1, 2]

[[bound]]
name = "x"
minimum = 0

[[monotonic]]
name = "energy"
direction = "falling"
tolerance = 1e-6
"""


def write(folder: Path, text: str) -> Path:
    path = folder / "mass.toml"
    path.write_text(text)
    return path


def test_everything_is_read(tmp_path: Path) -> None:
    case = load_case(write(tmp_path, GOOD))
    assert case.name == "mass"
    assert case.package == tmp_path / "Package.mo"
    assert case.sources == (tmp_path / "../library",)
    assert case.reference == tmp_path / "mass.csv"
    assert case.modes == ("me", "cs")
    assert case.requires == ("msl",)
    assert case.parameters == {"mass.m": 2.0, "wall.thin": True}
    assert case.time_tolerance == pytest.approx(2e-5)
    assert case.max_step is None
    assert case.checks == (
        SignalCheck("a[1]", 1e-6, 1e-3, (0, 1.5), 1e-3),
        ValueCheck(("a", "b"), 3, 0.1),
        EventCheck("v", 1e-6, 0, "falling", (0.5, 1), value_of="h", values=(1, 0.5), value_tolerance=1e-3),
        MeanCheck(("f",), 0.01, relative=True, window=(1, 2)),
        BoundCheck(("x",), minimum=0),
        MonotonicCheck(("energy",), "falling", 1e-6),
    )
    assert case.signals == ("a[1]", "a", "b", "v", "h", "f", "x", "energy")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[case]", "[cases]", "case: is missing"),
        ("stop = 2", "", r"case\.stop: is missing"),
        ("stop = 2", "stop = -2", r"case\.stop: -2 is not after"),
        ("stop = 2", "stop = true", r"case\.stop: True is not a number"),
        ("tolerance = 1e-8", "tolerance = 0", r"case\.tolerance: 0 is too small"),
        ("interval = 0.01", "intervall = 0.01", r"case\.intervall: is not a key"),
        ('mode = "both"', 'mode = "fast"', r"case\.mode: 'fast' is none of me, cs, both"),
        ('model = "Package.Model"', "", r"case\.model: give either model or fmu"),
        ('package = "Package.mo"', 'package = "/etc/Package.mo"', r"case\.package: .* must be relative"),
        ('reference = "mass.csv"', "", r"case\.reference: is missing"),
        ('package = "Package.mo"', "", r"case\.package: is missing"),
        ("[[signal]]", "[[signals]]", "signals: is not a table of a case"),
        ("[[signal]]", "[signal]", "signal: is not a list of tables"),
        ('name = "a[1]"', "", r"signal\[1\]\.name: give either name"),
        ('name = "a[1]"', "names = 1", r"signal\[1\]\.names: is not a list of texts"),
        ("window = [0, 1.5]", "window = [1.5, 0]", r"signal\[1\]\.window: is not \[from, to\]"),
        ("value_tolerance = 1e-3", "", r"event\[1\]\.value_of: give value_of and value_tolerance"),
        ('sum = ["a", "b"]', 'sum = ["a", 1]', r"value\[1\]\.sum: is not a list of texts"),
        ('sum = ["a", "b"]', "", r"value\[1\]\.name: give either name"),
        ("relative_tolerance = 0.01", "", r"mean\[1\]\.tolerance: give either"),
        ("minimum = 0", "", r"bound\[1\]\.minimum: give minimum, maximum or both"),
        ('direction = "falling"\ntolerance', 'direction = "down"\ntolerance', r"monotonic\[1\]\.direction: 'down'"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in GOOD
    path = write(tmp_path, GOOD.replace(old, new, 1))
    with pytest.raises(ProblemList, match=message) as caught:
        load_case(path)
    assert str(path) in str(caught.value)
    assert caught.value.exit_status == 2


def test_all_problems_are_told_at_once(tmp_path: Path) -> None:
    path = write(tmp_path, GOOD.replace("stop = 2", "stop = 0").replace("minimum = 0", "smallest = 0"))
    with pytest.raises(ProblemList) as caught:
        load_case(path)
    assert len(caught.value.problems) == 3


@pytest.mark.parametrize(("content", "message"), [(b"[case", "is no TOML"), (b"\xff", "no UTF-8")])
def test_no_toml(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "case.toml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=message):
        load_case(path)


def test_one_table_may_name_many_signals(tmp_path: Path) -> None:
    case = load_case(write(tmp_path, GOOD.replace('name = "a[1]"', 'names = ["a[1]", "a[2]"]')))
    assert case.checks[:2] == (
        SignalCheck("a[1]", 1e-6, 1e-3, (0, 1.5), 1e-3),
        SignalCheck("a[2]", 1e-6, 1e-3, (0, 1.5), 1e-3),
    )


def test_finding_cases(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no case"):
        find_cases(tmp_path)
    with pytest.raises(InputError, match="no such folder"):
        find_cases(tmp_path / "nothing")
    (tmp_path / "sub").mkdir()
    for name in ("b.toml", "a.toml", "sub/c.toml"):
        (tmp_path / name).touch()
    assert [path.name for path in find_cases(tmp_path)] == ["a.toml", "b.toml", "c.toml"]
