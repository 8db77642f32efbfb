"""The library's back ends are the engine's, in the same order: they are passed by number."""

from __future__ import annotations

import re

from contact_data import checkout

REPOSITORY = checkout()


def test_literals_are_the_engines_back_ends_in_order() -> None:
    header = (REPOSITORY / "external-c" / "include" / "contact_multibody.h").read_text(encoding="utf-8")
    numbers = {name: int(value) for name, value in re.findall(r"CMB_BACKEND_(\w+) = (\d+)", header)}
    assert sorted(numbers.values()) == list(range(len(numbers)))
    in_order = sorted(numbers, key=lambda name: numbers[name])

    source = (REPOSITORY / "ContactMultiBody" / "Types" / "Backend.mo").read_text(encoding="utf-8")
    listed = source[source.index("enumeration(") : source.index("annotation")]
    literals = re.findall(r"^ +(\w+) \"", listed, flags=re.MULTILINE)
    assert [{"Automatic": "AUTO"}.get(name, name.upper()) for name in literals] == in_order
