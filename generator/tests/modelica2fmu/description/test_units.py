"""Unit expressions against the definitions of the SI."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from modelica2fmu.description.units import BASE_UNITS, display_conversion, parse_unit, rate_unit


def exponents(**powers: int) -> tuple[int, ...]:
    return tuple(powers.get(name, 0) for name in BASE_UNITS)


@pytest.mark.parametrize(
    ("text", "powers", "factor"),
    [
        ("1", {}, 1.0),
        ("m", {"m": 1}, 1.0),
        ("rad", {"rad": 1}, 1.0),
        ("deg", {"rad": 1}, math.pi / 180.0),
        ("rad/s", {"rad": 1, "s": -1}, 1.0),
        ("rev/min", {"rad": 1, "s": -1}, 2.0 * math.pi / 60.0),
        ("m/s2", {"m": 1, "s": -2}, 1.0),
        ("kg.m2", {"kg": 1, "m": 2}, 1.0),
        ("N.m", {"kg": 1, "m": 2, "s": -2}, 1.0),
        ("N/m", {"kg": 1, "s": -2}, 1.0),
        ("N.s/m", {"kg": 1, "s": -1}, 1.0),
        ("N.m.s/rad", {"kg": 1, "m": 2, "s": -1, "rad": -1}, 1.0),
        ("N/m3/2", None, 0.0),
        ("J/(kg.K)", {"m": 2, "s": -2, "K": -1}, 1.0),
        ("kg/(m.s2)", {"kg": 1, "m": -1, "s": -2}, 1.0),
        ("1/s", {"s": -1}, 1.0),
        ("s-1", {"s": -1}, 1.0),
        ("mm", {"m": 1}, 1e-3),
        ("mm2", {"m": 2}, 1e-6),
        ("kN", {"kg": 1, "m": 1, "s": -2}, 1e3),
        ("GPa", {"kg": 1, "m": -1, "s": -2}, 1e9),
        ("V/A", {"kg": 1, "m": 2, "s": -3, "A": -2}, 1.0),
        ("min", {"s": 1}, 60.0),
        ("km/h", {"m": 1, "s": -1}, 1.0 / 3.6),
        ("bar", {"kg": 1, "m": -1, "s": -2}, 1e5),
        ("wb", None, 0.0),
        ("", None, 0.0),
        ("m/", None, 0.0),
        ("m s", None, 0.0),
        ("(m", None, 0.0),
        ("m99999999", None, 0.0),
    ],
)
def test_unit_expressions(text: str, powers: dict[str, int] | None, factor: float) -> None:
    unit = parse_unit(text)
    if powers is None:
        assert unit is None
        return
    assert unit is not None
    assert unit.exponents == exponents(**powers)
    assert unit.factor == pytest.approx(factor, rel=1e-14)


def test_display_units() -> None:
    def convert(unit: str, display: str) -> tuple[float, float] | None:
        base, shown = parse_unit(unit), parse_unit(display)
        assert base is not None
        assert shown is not None
        return display_conversion(base, shown)

    assert convert("rad", "deg") == (pytest.approx(180.0 / math.pi), 0.0)
    assert convert("K", "degC") == (1.0, pytest.approx(-273.15))
    assert convert("m", "mm") == (pytest.approx(1000.0), 0.0)
    assert convert("m", "s") is None


@given(st.text(alphabet="kgmsNrad.()/0123456789-% ", max_size=40))
def test_any_text_is_a_unit_or_not(text: str) -> None:
    unit = parse_unit(text)
    if unit is not None:
        assert len(unit.exponents) == len(BASE_UNITS)
        assert unit.factor > 0.0


@pytest.mark.parametrize(
    ("text", "rate"),
    [
        ("1", "1/s"),
        ("m", "m/s"),
        ("m/s", "m/s2"),
        ("rad/s2", "rad/s3"),
        ("N.m", "N.m/s"),
        ("kg/m3", "kg/(m3.s)"),
        ("W/(m2.K)", "W/(m2.K.s)"),
        ("degC", ""),  # a difference of temperatures has another zero
        ("m/s9", "m/s10"),
        ("", ""),
        ("furlong", ""),
    ],
)
def test_units_of_derivatives(text: str, rate: str) -> None:
    assert rate_unit(text) == rate
    unit, derivative = parse_unit(text), parse_unit(rate)
    if unit is not None and derivative is not None:
        assert derivative.factor == pytest.approx(unit.factor)
        seconds = BASE_UNITS.index("s")
        for index, (before, after) in enumerate(zip(unit.exponents, derivative.exponents, strict=True)):
            assert after == before - (index == seconds)
