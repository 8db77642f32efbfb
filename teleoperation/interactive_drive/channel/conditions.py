"""What a channel is like, and how a user writes it down."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from contact_foundation.errors import InputError, Place
from contact_foundation.near_names import did_you_mean

_QUANTITY = re.compile(r"([0-9]+(?:\.[0-9]*)?|\.[0-9]+)\s*([A-Za-z%/]*)")
_UNITS: Mapping[str, Mapping[str, float]] = {
    "bandwidth": {"bit": 1.0, "kbit": 1e3, "Mbit": 1e6, "bit/s": 1.0, "kbit/s": 1e3, "Mbit/s": 1e6},
    "delay": {"ms": 1e-3, "s": 1.0},
    "jitter": {"ms": 1e-3, "s": 1.0},
    "loss": {"%": 1e-2},
}
_LEAST_BANDWIDTH = 1e3
_LONGEST = 10.0
_MOST_LOSS = 0.9
_EXAMPLE = "Write it as bandwidth=64kbit,delay=200ms,jitter=20ms,loss=1%; what is left out is not limited."


@dataclass(frozen=True)
class Conditions:
    """One direction of a channel; both directions are alike.

    Attributes:
        bandwidth: bit/s; infinite if it is not limited.
        delay: from leaving to arriving, s.
        jitter: the delay is spread evenly over so much to either side, s; at most the delay.
        loss: share of messages that do not arrive, 0 to 0.9.
    """

    bandwidth: float = math.inf
    delay: float = 0.0
    jitter: float = 0.0
    loss: float = 0.0

    def __str__(self) -> str:
        parts = [f"{self.bandwidth / 1e3:g} kbit/s"] if math.isfinite(self.bandwidth) else []
        if self.delay:
            spread = f" ± {1e3 * self.jitter:g} ms" if self.jitter else ""
            parts.append(f"{1e3 * self.delay:g} ms{spread} each way")
        if self.loss:
            parts.append(f"{100 * self.loss:g} % lost")
        return ", ".join(parts) or "nothing limited"


def parse_conditions(text: str) -> Conditions:
    """Conditions from a text such as ``bandwidth=64kbit,delay=200ms,jitter=20ms,loss=1%``.

    Raises:
        InputError: a name or unit is unknown, a name is given twice, a number is out of range.
    """
    values: dict[str, float] = {}
    for word in text.split(","):
        name, equals, quantity = (part.strip() for part in word.partition("="))
        if not equals or name not in _UNITS:
            raise _wrong(f"{word.strip()!r} is nothing that a channel has", did_you_mean(name, _UNITS))
        if name in values:
            raise _wrong(f"{name} is given twice")
        values[name] = _quantity(name, quantity)
    conditions = Conditions(**values)
    if conditions.bandwidth < _LEAST_BANDWIDTH:
        raise _wrong(f"a bandwidth of {conditions.bandwidth:g} bit/s carries no frame in time; 1 kbit is the least")
    if conditions.delay > _LONGEST:
        raise _wrong(f"a delay of {conditions.delay:g} s is more than {_LONGEST:g} s")
    if conditions.jitter > conditions.delay:
        raise _wrong("jitter is more than the delay, so that messages would arrive before they leave")
    if conditions.loss > _MOST_LOSS:
        raise _wrong(f"a loss of {100 * conditions.loss:g} % is more than {100 * _MOST_LOSS:g} %")
    return conditions


def _quantity(name: str, text: str) -> float:
    match, units = _QUANTITY.fullmatch(text), _UNITS[name]
    if match is None or match[2] not in units:
        raise _wrong(f"{name} is no number with a unit of {', '.join(units)}: {text!r}")
    return float(match[1]) * units[match[2]]


def _wrong(message: str, hint: str | None = None) -> InputError:
    return InputError(message, place=Place(component="--channel"), remedy=f"{hint} {_EXAMPLE}" if hint else _EXAMPLE)
