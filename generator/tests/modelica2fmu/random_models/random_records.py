"""Random modifiers of records, as wholes and of single fields, from several classes around, with what they must mean.

Modelica Language Specification 3.6, 7.2 and 12.6. Where a modifier gives a field a value, and the record has one as a
whole from the same class or from one further in, Dymola and OpenModelica ignore the field's; no value is expected then.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, field

Fields = dict[str, float]
# Text, and its value where the class's own parameter is that.
Number = tuple[str, Callable[[float], float]]

FIELDS = ("e", "mu", "E")
LEVELS = ("Inner", "Middle", "Outer")
PACKAGE = """package P
  record Base
    parameter Real e = 0.5;
    parameter Real mu = 0.375;
    parameter Real E = 16;
    parameter Real G = E/2;
  end Base;
  record Steel
    extends Base(E = 200, mu = 0.125);
  end Steel;
  model Body
    parameter Base m;
    Real y = m.e + 10*m.mu + m.G;
  end Body;
"""


def defaults(record: str) -> Fields:
    found = {"e": 0.5, "mu": 0.375, "E": 16.0}
    return found | {"E": 200.0, "mu": 0.125} if record == "Steel" else found


@dataclass(frozen=True)
class RandomRecords:
    """A package P with a model M, and the values that its variables must have."""

    text: str
    values: dict[str, float]


@dataclass
class _Record:
    """One of them, from inside outwards."""

    values: Fields = field(default_factory=lambda: defaults("Base"))
    is_whole: bool = False
    unclear: set[str] = field(default_factory=set)

    def give(self, name: str, value: float) -> None:
        self.values[name] = value
        if self.is_whole:
            self.unclear.add(name)

    def give_whole(self, values: Fields) -> None:
        self.values, self.is_whole, self.unclear = dict(values), True, set()


class _Writer:
    def __init__(self, choose: random.Random) -> None:
        self.choose = choose
        self.k = "k"

    def number(self) -> Number:
        digit = float(self.choose.randint(1, 9))
        kinds: list[Number] = [
            (f"{digit:g}", lambda _: digit),
            (self.k, lambda k: k),
            (f"{digit:g}*{self.k}", lambda k: digit * k),
        ]
        return self.choose.choice(kinds)

    def whole(self, bronze: tuple[str, Fields] | None, k: float) -> tuple[str, Fields]:
        """A value of a record, where a class has a record of that name and these values, or none."""
        if bronze is not None and self.choose.random() < 0.3:
            return bronze
        record = self.choose.choice(["Base", "Steel"])
        values, arguments = defaults(record), []
        for name in FIELDS:
            if self.choose.random() < 0.4:
                text, value = self.number()
                values[name] = value(k)
                arguments.append(f"{name} = {text}")
        return f"{record}({', '.join(arguments)})", values

    def change(self, found: _Record, bronze: tuple[str, Fields], k: float) -> str:
        """A modifier of the record m, or nothing."""
        kind = self.choose.choice(["none", "whole", "whole", "fields", "attributes"])
        if kind == "whole":
            text, values = self.whole(bronze, k)
            found.give_whole(values)
            return f"m = {text}"
        if kind == "attributes":
            return f"m({self.choose.choice(FIELDS)}(min = -1))"
        if kind == "fields":
            arguments = []
            for name in self.choose.sample(FIELDS, self.choose.randint(1, 2)):
                text, value = self.number()
                found.give(name, value(k))
                arguments.append(f"{name} = {text}")
            return f"m({', '.join(arguments)})"
        return ""


def random_records(seed: int) -> RandomRecords:
    """Two bodies with records in a class, and two classes that extend it or have it as a component."""
    writer = _Writer(random.Random(seed))
    records = {"a": _Record(), "b": _Record()}
    lines, around = [PACKAGE.rstrip("\n")], ""
    for number, level in enumerate(LEVELS):
        writer.k = f"k{number}"
        k = float(writer.choose.randint(2, 5))
        whole = writer.whole(None, k)
        changes = {name: writer.change(record, (f"bronze{number}", whole[1]), k) for name, record in records.items()}
        lines += [f"  model {level}", f"    parameter Real k{number} = {k:g};"]
        lines.append(f"    parameter Base bronze{number} = {whole[0]};")
        if number == 0:
            lines += [f"    Body {name}{_in_parentheses(change)};" for name, change in changes.items()]
        else:
            inside = ", ".join(f"{name}{_in_parentheses(change)}" for name, change in changes.items() if change)
            for part in reversed(around.split(".")[:-1]):
                inside = f"{part}({inside})" if inside else ""
            if writer.choose.random() < 0.5:
                lines.append(f"    extends {LEVELS[number - 1]}{_in_parentheses(inside)};")
            else:
                lines.append(f"    {LEVELS[number - 1]} part{number}{_in_parentheses(inside)};")
                around = f"part{number}.{around}"
        lines.append(f"  end {level};")
    lines += [f"  model M = {LEVELS[-1]};", "end P;", ""]
    values: dict[str, float] = {}
    for name, record in records.items():
        fields = record.values | {"G": record.values["E"] / 2}
        unclear = record.unclear | ({"G"} if "E" in record.unclear else set())
        values |= {f"{around}{name}.m.{key}": value for key, value in fields.items() if key not in unclear}
    return RandomRecords("\n".join(lines), values)


def _in_parentheses(text: str) -> str:
    return f"({text})" if text else ""
