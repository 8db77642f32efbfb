"""Elements of electrical and translational networks: Modelica text, and the same equations as linear forms."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

ONE = "one"  # the number 1, as a variable
# Factor and variable; "der x" is the derivative of x, "cube x" its cube.
Terms = tuple[tuple[float, str], ...]
Equations = tuple[Terms, ...]

POTENTIAL = {"Pin": "v", "Flange": "s"}
FLOW = {"Pin": "i", "Flange": "f"}


@dataclass(frozen=True)
class Part:
    """An element.

    Attributes:
        ports: their names, each with its connector.
        variables: besides those of ports.
        text: what stands in its class.
        equations: the same for a value of its parameter ``k``.
        states: what is likely to be a state.
    """

    ports: Mapping[str, str]
    variables: tuple[str, ...]
    text: str
    equations: Callable[[float], Equations]
    states: tuple[str, ...] = ()


def _two_pins(text: str, equation: Callable[[float], Terms], states: tuple[str, ...] = ()) -> Part:
    def equations(k: float) -> Equations:
        return (
            equation(k),
            ((1, "v"), (-1, "a.v"), (1, "b.v")),
            ((1, "i"), (-1, "a.i")),
            ((1, "a.i"), (1, "b.i")),
        )

    return Part({"a": "Pin", "b": "Pin"}, ("v", "i"), f"extends TwoPins; equation {text}", equations, states)


def _two_flanges(text: str, equation: Callable[[float], Terms]) -> Part:
    def equations(k: float) -> Equations:
        return (
            equation(k),
            ((1, "s"), (1, "a.s"), (-1, "b.s")),
            ((1, "f"), (-1, "b.f")),
            ((1, "a.f"), (1, "b.f")),
        )

    return Part({"a": "Flange", "b": "Flange"}, ("s", "f"), f"extends TwoFlanges; equation {text}", equations)


def wave(speed: float) -> str:
    """The variable cos(speed*time)."""
    return f"cos {speed:g}"


def is_given(name: str) -> bool:
    """Whether a variable is a function of time, and none of a part."""
    return name == ONE or name.startswith(("cos ", "sin "))


PARTS: Mapping[str, Part] = {
    "Resistor": _two_pins("v = k*i;", lambda k: ((1, "v"), (-k, "i"))),
    "Capacitor": _two_pins("k*der(v) = i;", lambda k: ((k, "der v"), (-1, "i")), ("v",)),
    "Inductor": _two_pins("k*der(i) = v;", lambda k: ((k, "der i"), (-1, "v")), ("i",)),
    "Battery": _two_pins("v = k;", lambda k: ((1, "v"), (-k, ONE))),
    "Generator": _two_pins("v = cos(k*time);", lambda k: ((1, "v"), (-1, wave(k)))),
    "Supply": _two_pins("i = k;", lambda k: ((1, "i"), (-k, ONE))),
    "Cubic": _two_pins("i = k*v + v^3/8;", lambda k: ((k, "v"), (-1, "i"), (0.125, "cube v"))),
    "Ground": Part({"a": "Pin"}, (), "Pin a; equation a.v = 0;", lambda _: (((1, "a.v"),),)),
    "Transformer": Part(
        {"a": "Pin", "b": "Pin", "c": "Pin", "d": "Pin"},
        (),
        "Pin a; Pin b; Pin c; Pin d; equation a.v - b.v = k*(c.v - d.v); k*a.i = -c.i; a.i + b.i = 0; c.i + d.i = 0;",
        lambda k: (
            ((1, "a.v"), (-1, "b.v"), (-k, "c.v"), (k, "d.v")),
            ((k, "a.i"), (1, "c.i")),
            ((1, "a.i"), (1, "b.i")),
            ((1, "c.i"), (1, "d.i")),
        ),
    ),
    "Motor": Part(
        {"a": "Pin", "b": "Pin", "c": "Flange"},
        ("speed",),
        "Pin a; Pin b; Flange c; Real speed; equation "
        "speed = der(c.s); a.v - b.v = k*speed; a.i + b.i = 0; c.f = -k*a.i;",
        lambda k: (
            ((1, "speed"), (-1, "der c.s")),
            ((1, "a.v"), (-1, "b.v"), (-k, "speed")),
            ((1, "a.i"), (1, "b.i")),
            ((1, "c.f"), (k, "a.i")),
        ),
    ),
    "Mass": Part(
        {"a": "Flange", "b": "Flange"},
        ("s", "v", "acceleration"),
        "Flange a; Flange b; Real s; Real v; Real acceleration; equation "
        "a.s = s; b.s = s; v = der(s); acceleration = der(v); k*acceleration = a.f + b.f;",
        lambda k: (
            ((1, "a.s"), (-1, "s")),
            ((1, "b.s"), (-1, "s")),
            ((1, "v"), (-1, "der s")),
            ((1, "acceleration"), (-1, "der v")),
            ((k, "acceleration"), (-1, "a.f"), (-1, "b.f")),
        ),
        ("s", "v"),
    ),
    "Spring": _two_flanges("f = k*(s - 0.5);", lambda k: ((1, "f"), (-k, "s"), (0.5 * k, ONE))),
    "Damper": _two_flanges("f = k*der(s);", lambda k: ((1, "f"), (-k, "der s"))),
    "Rod": _two_flanges("s = k;", lambda k: ((1, "s"), (-k, ONE))),
    "Lever": Part(
        {"a": "Flange", "b": "Flange"},
        (),
        "Flange a; Flange b; equation b.s = k*a.s; a.f + k*b.f = 0;",
        lambda k: (((1, "b.s"), (-k, "a.s")), ((1, "a.f"), (k, "b.f"))),
    ),
    "Pull": Part(
        {"a": "Flange"}, (), "Flange a; equation a.f = cos(k*time);", lambda k: (((1, "a.f"), (-1, wave(k))),)
    ),
    "Weight": Part({"a": "Flange"}, (), "Flange a; equation a.f = -k;", lambda k: (((1, "a.f"), (k, ONE)),)),
    "Fixed": Part({"a": "Flange"}, (), "Flange a; equation a.s = k;", lambda k: (((1, "a.s"), (-k, ONE)),)),
}
WAVES = ("Generator", "Pull")


def classes() -> list[str]:
    """All of them and their connectors, a line each."""
    lines = [f"connector {name} Real {POTENTIAL[name]}; flow Real {FLOW[name]}; end {name};" for name in POTENTIAL]
    lines += [
        "partial model TwoPins Pin a; Pin b; Real v; Real i; "
        "equation v = a.v - b.v; i = a.i; a.i + b.i = 0; end TwoPins;",
        "partial model TwoFlanges Flange a; Flange b; Real s; Real f; "
        "equation s = b.s - a.s; f = b.f; a.f + b.f = 0; end TwoFlanges;",
    ]
    return [
        *lines,
        *(f"model {name} parameter Real k = 1; {part.text} end {name};" for name, part in PARTS.items()),
    ]
