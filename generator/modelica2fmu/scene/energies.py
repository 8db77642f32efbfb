"""Kinetic and potential energy of a model's bodies as variables of it."""

from __future__ import annotations

from typing import Final

from modelica2fmu.expand.scalar_model import Kind, ScalarEquation, ScalarModel, ScalarVariable
from modelica2fmu.frontend import ir
from modelica2fmu.scene.mechanism import Mechanism
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.expression import Node

KINETIC: Final = "cmbScene.kineticEnergy"
POTENTIAL: Final = "cmbScene.potentialEnergy"
_GRAVITY: Final = ("world.g", "world.n[1]", "world.n[2]", "world.n[3]")

_Scalar = float | Node
_Vector = tuple[_Scalar, _Scalar, _Scalar]


def add_energies(model: ScalarModel, mechanism: Mechanism) -> None:
    """Adds variables and equations of the energies of all bodies together, J.

    Kinetic: m v_cm^2/2 + w' I w/2. Potential, where the world has uniform gravity: -m g n r_cm, zero at the origin.
    """
    if not mechanism.bodies:
        return
    kinetic: _Scalar = 0.0
    potential: _Scalar = 0.0
    has_gravity = all(name in model.variables for name in _GRAVITY)
    for body in mechanism.bodies:
        mass = _value(model, f"{body}.m")
        rows = [_vector(model, f"{body}.frame_a.R.T", f"{row}") for row in (1, 2, 3)]
        center = _vector(model, f"{body}.r_CM")
        spin = _vector(model, f"{body}.w_a")
        around = _cross(spin, center)
        inertia = [_vector(model, f"{body}.I", f"{row}") for row in (1, 2, 3)]
        turned = _to_world(rows, around)
        speed = tuple(ex.add(a, b) for a, b in zip(_vector(model, f"{body}.v_0"), turned, strict=True))
        momentum = tuple(_dot(row, spin) for row in inertia)
        doubled = ex.add(ex.multiply(mass, _dot(speed, speed)), _dot(spin, momentum))
        kinetic = ex.add(kinetic, ex.multiply(0.5, doubled))
        if has_gravity:
            place = tuple(
                ex.add(a, b)
                for a, b in zip(_vector(model, f"{body}.frame_a.r_0"), _to_world(rows, center), strict=True)
            )
            height = _dot(_vector(model, "world.n"), place)
            weight = ex.multiply(mass, _value(model, "world.g"))
            potential = ex.subtract(potential, ex.multiply(weight, height))
    _declare(model, KINETIC, kinetic, "Kinetic energy of all bodies")
    if has_gravity:
        _declare(model, POTENTIAL, potential, "Potential energy of all bodies in uniform gravity, zero at the origin")


def _declare(model: ScalarModel, name: str, value: _Scalar, description: str) -> None:
    declaration = ir.Variable(name=name, type="Real", shape=(), unit="J", quantity="Energy", description=description)
    model.variables[name] = ScalarVariable(name=name, type="Real", kind=Kind.CONTINUOUS, declaration=declaration)
    model.equations.append(ScalarEquation(ex.symbol(name), value))


def _value(model: ScalarModel, name: str) -> _Scalar:
    variable = model.variables[name]
    is_number = variable.kind is Kind.CONSTANT and isinstance(variable.value, float | int)
    return variable.value if is_number else ex.symbol(name)  # type: ignore[return-value]


def _vector(model: ScalarModel, name: str, row: str = "") -> _Vector:
    x, y, z = (_value(model, f"{name}[{row}{',' if row else ''}{column}]") for column in (1, 2, 3))
    return x, y, z


def _dot(a: tuple[_Scalar, ...], b: tuple[_Scalar, ...]) -> _Scalar:
    total: _Scalar = 0.0
    for x, y in zip(a, b, strict=True):
        total = ex.add(total, ex.multiply(x, y))
    return total


def _cross(a: _Vector, b: _Vector) -> _Vector:
    def part(i: int, j: int) -> _Scalar:
        return ex.subtract(ex.multiply(a[i], b[j]), ex.multiply(a[j], b[i]))

    return part(1, 2), part(2, 0), part(0, 1)


def _to_world(rows: list[_Vector], vector: _Vector) -> tuple[_Scalar, ...]:
    """T' v, of the rows of T."""
    return tuple(_dot(tuple(row[column] for row in rows), vector) for column in range(3))
