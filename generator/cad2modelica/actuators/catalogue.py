"""The library's components for joints, read from its Modelica files: parameters, inputs and outputs.

Only what ``ContactMultiBody.Actuators`` itself uses is understood: public declarations one a statement, ``extends`` of
classes of the same library with modifications. Everything below ``equation`` is skipped.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from contact_data import modelica_library

from cad2modelica.mechanism.model import JointType

PACKAGE = "ContactMultiBody.Actuators"
DOMAINS = {JointType.REVOLUTE: "Rotational", JointType.SCREW: "Rotational", JointType.PRISMATIC: "Translational"}
SENSOR = "Sensor"
IDEAL = "Position"  # forces a motion: there can be one at a joint

_HEAD = re.compile(r"\b(?:model|block)\s+\w+\s+\"(?P<description>[^\"]*)\"")
_DECLARATION = re.compile(
    r"^(?P<final>final )?(?P<parameter>parameter )?(?P<type>[\w.]+) (?P<name>\w+)(?P<rest>.*)$", re.DOTALL
)
_INTERNAL = frozenset({"useSupport"})
_SECTION = re.compile(r"^(protected|initial equation|equation|algorithm)\b")


@dataclass(frozen=True)
class Parameter:
    """A parameter of a component.

    Attributes:
        boolean: whether it is true or false instead of a number.
        default: as Modelica text; None if the library gives none.
        minimum: smallest value allowed; None if any number is.
        positive: whether zero is excluded too.
        unit: as the type's name, without its package ("Inertia"), or "Real".
    """

    name: str
    boolean: bool
    default: str | None
    minimum: float | None
    positive: bool
    unit: str
    description: str


@dataclass(frozen=True)
class Signal:
    """An input or output connector; ``condition`` names the Boolean parameter it exists by."""

    name: str
    quantity: str
    unit: str
    description: str
    condition: str | None


@dataclass(frozen=True)
class ComponentClass:
    """A component that can be given to a joint."""

    name: str
    domain: str
    description: str
    parameters: tuple[Parameter, ...]
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]

    @property
    def class_name(self) -> str:
        """Full name in Modelica."""
        return f"{PACKAGE}.{self.domain}.{self.name}"

    def parameter(self, name: str) -> Parameter | None:
        """The parameter of that name, if there is one."""
        return next((parameter for parameter in self.parameters if parameter.name == name), None)


def components_for(joint: JointType) -> tuple[ComponentClass, ...]:
    """Components for joints of a type, in the library's order; none for types without an axis to drive."""
    domain = DOMAINS.get(joint)
    return _domain(domain) if domain is not None else ()


@cache
def _domain(domain: str) -> tuple[ComponentClass, ...]:
    folder = modelica_library() / "Actuators" / domain
    return tuple(_read(folder / f"{name}.mo", domain) for name in (folder / "package.order").read_text("utf-8").split())


def _read(file: Path, domain: str) -> ComponentClass:
    parameters, signals = _members(file)
    head = _HEAD.search(file.read_text(encoding="utf-8"))
    return ComponentClass(
        name=file.stem,
        domain=domain,
        description=head["description"] if head is not None else "",
        parameters=tuple(parameters.values()),
        inputs=tuple(signal for kind, signal in signals if kind == "RealInput"),
        outputs=tuple(signal for kind, signal in signals if kind == "RealOutput"),
    )


def _members(file: Path) -> tuple[dict[str, Parameter], list[tuple[str, Signal]]]:
    """Parameters that can be set, and signals, of a class and its bases."""
    parameters: dict[str, Parameter] = {}
    signals: list[tuple[str, Signal]] = []
    for statement in _statements(file.read_text(encoding="utf-8")):
        if statement.startswith("extends "):
            base = statement.split("(")[0].removeprefix("extends ").strip()
            path = modelica_library() / "Actuators" / f"{base.replace('.', '/')}.mo"
            if not path.is_file():
                continue  # icons
            inherited, more = _members(path)
            parameters |= _modified(inherited, _arguments(statement))
            signals += more
            continue
        match = _DECLARATION.match(statement)
        if match is None or match["final"]:
            continue
        kind = match["type"].split(".")[-1]
        attributes, rest = _attributes(match["rest"])
        description = re.findall(r'"([^"]*)"', re.sub(r"annotation\s*\(.*", "", rest, flags=re.DOTALL))
        label = description[-1] if description else ""
        if match["parameter"] and match["name"] not in _INTERNAL:
            default = re.match(r'\s*=\s*([^"]*)', rest)
            minimum = attributes.get("min")
            parameters[match["name"]] = Parameter(
                name=match["name"],
                boolean=kind == "Boolean",
                default=default[1].strip() if default is not None else None,
                minimum=0.0 if minimum is not None else None,
                positive=minimum not in (None, "0"),
                unit=kind,
                description=label,
            )
        elif kind in ("RealInput", "RealOutput"):
            condition = re.match(r"\s*if (\w+)", rest)
            signals.append(
                (
                    kind,
                    Signal(
                        match["name"],
                        attributes.get("quantity", "").strip('"'),
                        attributes.get("unit", "").strip('"'),
                        label,
                        condition[1] if condition is not None else None,
                    ),
                )
            )
    return parameters, signals


def _modified(parameters: dict[str, Parameter], modifications: dict[str, str]) -> dict[str, Parameter]:
    """Parameters after an extends clause: final ones cannot be set any more, others have a new default."""
    result = {}
    for name, parameter in parameters.items():
        if f"final {name}" in modifications:
            continue
        result[name] = replace(parameter, default=modifications.get(name, parameter.default))
    return result


def _attributes(rest: str) -> tuple[dict[str, str], str]:
    """The modification that follows a name, and what comes after it."""
    if not rest.startswith("("):
        return {}, rest
    end = _closing(rest)
    return {key.removeprefix("final "): value for key, value in _split(rest[1:end]).items()}, rest[end + 1 :]


def _arguments(statement: str) -> dict[str, str]:
    opening = statement.find("(")
    if opening < 0:
        return {}
    inner = statement[opening:]
    return _split(inner[1 : _closing(inner)])


def _split(text: str) -> dict[str, str]:
    """``a=1, final b=2`` as a dictionary."""
    pairs = (item.partition("=") for item in _separated(text, ","))
    return {" ".join(key.split()): value.strip() for key, equals, value in pairs if equals}


def _closing(text: str) -> int:
    depth = 0
    for position, character in enumerate(text):
        depth += (character == "(") - (character == ")")
        if depth == 0:
            return position
    raise AssertionError(f"unbalanced parentheses in {text!r}")


def _statements(text: str) -> Iterator[str]:
    """Public declarations of the file's class, each on one line, without annotations' layout."""
    without_comments = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)
    head = _HEAD.search(without_comments)
    body = without_comments[head.end() :] if head is not None else ""
    for statement in _separated(body, ";"):
        line = " ".join(statement.split())
        if _SECTION.match(line):
            return
        yield line


def _separated(text: str, separator: str) -> Iterator[str]:
    """Parts between separators that stand in no parentheses, braces or strings."""
    depth, start, quoted = 0, 0, False
    for position, character in enumerate(text):
        if character == '"' and text[position - 1] != "\\":
            quoted = not quoted
        if quoted:
            continue
        depth += (character in "({[") - (character in ")}]")
        if character == separator and depth == 0:
            yield text[start:position]
            start = position + 1
    if text[start:].strip():
        yield text[start:]
