"""Modelica unit expressions as products of SI base units, as FMI's ``BaseUnit`` wants them.

Grammar: Modelica Language Specification 3.6, chapter 19. Values: The International System of Units,
9th edition (BIPM 2019), tables 2 to 8.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

#: Order of the exponents, and the names of FMI's attributes.
BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


@dataclass(frozen=True)
class Unit:
    """A unit: ``base value = factor * value + offset``, exponents in the order of ``BASE_UNITS``."""

    exponents: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0

    def __mul__(self, other: Unit) -> Unit:
        exponents = tuple(a + b for a, b in zip(self.exponents, other.exponents, strict=True))
        return Unit(exponents, self.factor * other.factor)

    def __pow__(self, exponent: int) -> Unit:
        return Unit(tuple(exponent * e for e in self.exponents), math.pow(self.factor, exponent))


def _unit(factor: float = 1.0, offset: float = 0.0, **exponents: int) -> Unit:
    return Unit(tuple(exponents.get(name, 0) for name in BASE_UNITS), factor, offset)


_ONE = _unit()

# Symbols that take an SI prefix.
_PREFIXABLE = {
    "g": _unit(1e-3, kg=1),
    "m": _unit(m=1),
    "s": _unit(s=1),
    "A": _unit(A=1),
    "K": _unit(K=1),
    "mol": _unit(mol=1),
    "cd": _unit(cd=1),
    "rad": _unit(rad=1),
    "sr": _unit(rad=2),
    "Hz": _unit(s=-1),
    "N": _unit(kg=1, m=1, s=-2),
    "Pa": _unit(kg=1, m=-1, s=-2),
    "J": _unit(kg=1, m=2, s=-2),
    "W": _unit(kg=1, m=2, s=-3),
    "C": _unit(A=1, s=1),
    "V": _unit(kg=1, m=2, s=-3, A=-1),
    "F": _unit(kg=-1, m=-2, s=4, A=2),
    "Ohm": _unit(kg=1, m=2, s=-3, A=-2),
    "S": _unit(kg=-1, m=-2, s=3, A=2),
    "Wb": _unit(kg=1, m=2, s=-2, A=-1),
    "T": _unit(kg=1, s=-2, A=-1),
    "H": _unit(kg=1, m=2, s=-2, A=-2),
    "lm": _unit(cd=1, rad=2),
    "lx": _unit(cd=1, rad=2, m=-2),
    "Bq": _unit(s=-1),
    "Gy": _unit(m=2, s=-2),
    "Sv": _unit(m=2, s=-2),
    "kat": _unit(mol=1, s=-1),
    "l": _unit(1e-3, m=3),
    "L": _unit(1e-3, m=3),
    "t": _unit(1e3, kg=1),
    "bar": _unit(1e5, kg=1, m=-1, s=-2),
    "eV": _unit(1.602176634e-19, kg=1, m=2, s=-2),
    "var": _unit(kg=1, m=2, s=-3),
    "VA": _unit(kg=1, m=2, s=-3),
    "Wh": _unit(3600.0, kg=1, m=2, s=-2),
}

_PLAIN = {
    "1": _ONE,
    "degC": _unit(1.0, 273.15, K=1),
    "degF": _unit(5.0 / 9.0, 273.15 - 32.0 * 5.0 / 9.0, K=1),
    "degRk": _unit(5.0 / 9.0, K=1),
    "deg": _unit(math.pi / 180.0, rad=1),
    "rev": _unit(2.0 * math.pi, rad=1),
    "rpm": _unit(math.pi / 30.0, rad=1, s=-1),
    "min": _unit(60.0, s=1),
    "h": _unit(3600.0, s=1),
    "d": _unit(86400.0, s=1),
    "%": _unit(0.01),
}

_PREFIXES = {
    "da": 1e1, "h": 1e2, "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12, "P": 1e15, "E": 1e18, "Z": 1e21, "Y": 1e24,
    "d": 1e-1, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12, "f": 1e-15, "a": 1e-18, "z": 1e-21, "y": 1e-24,
}  # fmt: skip

_TOKEN = re.compile(r"[A-Za-z%]+|[+-]?\d+|[./()]")
_MAXIMUM_LENGTH = 200
_MAXIMUM_EXPONENT = 20


class _Parser:
    """Recursive descent over the tokens of one unit expression; ``ValueError`` where it is none."""

    def __init__(self, text: str) -> None:
        self._tokens = _TOKEN.findall(text)
        if len(text) > _MAXIMUM_LENGTH or "".join(self._tokens) != text:
            raise ValueError(text)
        self._next = 0

    def parse(self) -> Unit:
        unit = self._expression()
        if self._peek():
            raise ValueError(self._peek())
        return unit

    def _peek(self) -> str:
        return self._tokens[self._next] if self._next < len(self._tokens) else ""

    def _take(self) -> str:
        token = self._peek()
        self._next += 1
        return token

    def _expression(self) -> Unit:
        unit = self._factors()
        if self._peek() == "/":
            self._take()
            unit = unit * self._group_or_factor() ** -1
        return unit

    def _group_or_factor(self) -> Unit:
        if self._peek() != "(":
            return self._factor()
        self._take()
        unit = self._expression()
        if self._take() != ")":
            raise ValueError(")")
        return unit

    def _factors(self) -> Unit:
        unit = self._group_or_factor()
        while self._peek() == ".":
            self._take()
            unit = unit * self._group_or_factor()
        return unit

    def _factor(self) -> Unit:
        unit = _symbol(self._take())
        if re.fullmatch(r"[+-]?\d+", self._peek()):
            exponent = int(self._take())
            if abs(exponent) > _MAXIMUM_EXPONENT:
                raise ValueError(exponent)
            unit = unit**exponent
        return unit


def _symbol(symbol: str) -> Unit:
    if symbol in _PLAIN:
        return _PLAIN[symbol]
    if symbol in _PREFIXABLE:
        return _PREFIXABLE[symbol]
    for prefix, factor in _PREFIXES.items():
        rest = symbol[len(prefix) :]
        if symbol.startswith(prefix) and rest in _PREFIXABLE:
            unit = _PREFIXABLE[rest]
            return replace(unit, factor=factor * unit.factor)
    raise ValueError(symbol)


def parse_unit(text: str) -> Unit | None:
    """Reads a Modelica unit expression, ``kg.m2/s2``; ``None`` if it is none or a unit is not known."""
    try:
        return _Parser(text).parse()
    except (ValueError, OverflowError):
        return None


def display_conversion(unit: Unit, display: Unit) -> tuple[float, float] | None:
    """Factor and offset of ``display value = factor * value + offset``; ``None`` if the units do not fit."""
    if unit.exponents != display.exponents:
        return None
    return unit.factor / display.factor, (unit.offset - display.offset) / display.factor


def rate_unit(text: str) -> str:
    """The unit of the time derivative of a variable of unit ``text``: "m/s2" for "m/s"; "" where it is not known."""
    unit = parse_unit(text)
    if unit is None or unit.offset != 0.0:
        return ""
    numerator, _, denominator = text.partition("/")
    seconds = re.fullmatch(r"s([2-9]?)", denominator)
    if not denominator:
        rate = f"{numerator}/s"
    elif seconds is not None:
        rate = f"{numerator}/s{int(seconds[1] or 1) + 1}"
    else:
        rate = f"{numerator}/({denominator.removeprefix('(').removesuffix(')')}.s)"
    return rate if parse_unit(rate) == unit * _unit(s=-1) else ""
