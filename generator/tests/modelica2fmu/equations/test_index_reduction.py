"""Index reduction on small systems: what is differentiated, which states are chosen."""

from __future__ import annotations

import pytest
from contact_foundation.errors import InputError, Place, UnsupportedModelError
from modelica2fmu.equations.index_reduction import reduce_index
from modelica2fmu.expand.scalar_model import Kind, ScalarModel, ScalarVariable
from modelica2fmu.frontend import ir
from modelica2fmu.symbolic import expression as ex


def system(names, selects=None, kinds=None):
    model = ScalarModel("M", "")
    for name in names:
        model.variables[name] = ScalarVariable(
            name,
            "Real",
            (kinds or {}).get(name, Kind.CONTINUOUS),
            state_select=(selects or {}).get(name, ir.StateSelect.DEFAULT),
        )
    return model


def reduced(model, residuals, unknowns=None):
    names = unknowns or [name for name, item in model.variables.items() if item.kind is Kind.CONTINUOUS]
    return reduce_index(
        model, [(residual, None) for residual in residuals], names, [], ex.symbol, lambda _span: Place()
    )


def s(name):
    return ex.symbol(name)


def d(name):
    return ex.symbol(f"der({name})")


def test_explicit_ordinary_equation_needs_nothing():
    result = reduced(system(["x"]), [ex.subtract(d("x"), s("x"))])
    assert result.states == ["x"]
    assert result.differentiations == 0


def test_coupled_masses_keep_the_preferred_position():
    # Two coordinates tied by a rigid rod: x2 = x1 + 1, both with speeds, one force between them.
    names = ["x1", "v1", "x2", "v2", "f"]
    equations = [
        ex.subtract(d("x1"), s("v1")),
        ex.subtract(d("x2"), s("v2")),
        ex.subtract(d("v1"), s("f")),
        ex.add(d("v2"), s("f")),
        ex.subtract(s("x2"), ex.add(s("x1"), 1)),
    ]
    for preferred, other in (("1", "2"), ("2", "1")):
        selects = {f"x{preferred}": ir.StateSelect.PREFER, f"v{preferred}": ir.StateSelect.PREFER}
        result = reduced(system(names, selects), equations)
        assert set(result.states) == {f"x{preferred}", f"v{preferred}"}
        assert f"der(x{other})" in result.dummies
        # The rod's equation once and twice, and the definitions of both speeds.
        assert result.differentiations >= 2


def test_state_that_cannot_be_one_is_told():
    always = ir.StateSelect.ALWAYS
    model = system(["x", "y"], {"x": always, "y": always})
    result = reduced(model, [ex.subtract(d("x"), 1), ex.subtract(s("y"), ex.multiply(2, s("x")))])
    # y has no derivative in the equations, so only x counts as a state.
    assert result.states == ["x"]
    model = system(["x", "y", "z"], {"x": always, "y": always})
    equations = [
        ex.subtract(ex.add(d("x"), d("y")), 1),
        ex.subtract(s("y"), s("x")),
        ex.subtract(s("z"), d("x")),
    ]
    result = reduced(model, equations)
    assert len(result.states) == 1
    assert len(result.rejected_states) == 1


def test_unit_vector_keeps_all_components_as_states():
    # The direction of a pointer that turns with speed w: p' = w (-q, p), and |(p, q)| = 1 stated beside it.
    model = system(["p", "q", "w"])
    turning = ex.subtract(s("w"), ex.subtract(ex.multiply(s("p"), d("q")), ex.multiply(s("q"), d("p"))))
    norm = ex.subtract(ex.add(ex.multiply(s("p"), s("p")), ex.multiply(s("q"), s("q"))), 1)
    result = reduced(model, [turning, norm, ex.subtract(s("w"), 3)])
    assert result.states == ["p", "q"]
    assert result.unit_vectors == [("p", "q")] or result.unit_vectors == [("q", "p")]
    (stabilized,) = result.stabilized.values()
    values = {"p": 1.1, "q": 0.0, "der(p)": 0.0, "der(q)": 5.0}
    # Off the circle the stabilized equation asks for an inward speed.
    inward = ex.evaluate(stabilized, values)
    assert inward == pytest.approx(10 * (1.1**2 - 1))


def test_known_rate_of_a_rotation_matrix_is_used():
    model = system(["phi", "w", "x", *(f"R.w[{k}]" for k in (1, 2, 3))])
    for row in range(3):
        for column in range(3):
            name = f"R.T[{row + 1},{column + 1}]"
            model.variables[name] = ScalarVariable(name, "Real", Kind.CONTINUOUS, orientation=("R", row, column))
    cosine, sine = ex.unary("cos", s("phi")), ex.unary("sin", s("phi"))
    matrix = [[cosine, sine, 0], [ex.negate(sine), cosine, 0], [0, 0, 1]]
    equations = [ex.subtract(s(f"R.T[{i + 1},{j + 1}]"), matrix[i][j]) for i in range(3) for j in range(3)]
    equations += [s("R.w[1]"), s("R.w[2]"), ex.subtract(s("R.w[3]"), s("w"))]
    equations += [ex.subtract(d("phi"), s("w")), ex.subtract(d("w"), 1)]
    # x is bound to an element of the matrix, and its rate is asked for.
    equations += [ex.subtract(s("x"), s("R.T[1,2]")), ex.add(d("x"), s("y"))]
    model.variables["y"] = ScalarVariable("y", "Real", Kind.CONTINUOUS)
    result = reduced(model, equations)
    assert set(result.states) == {"phi", "w"}
    assert result.differentiations == 1  # of the equation of x, not of those of the matrix
    (derivative,) = [item for item in result.equations if item.derivative_of is not None]
    values = {"der(x)": 0.0, **{name: 0.0 for name in ex.symbols(derivative.residual)}}
    values.update({"R.w[3]": 2.0, "R.T[2,2]": 0.6})
    # x' = T12' = -(skew(w) T)_12 = w3 T22
    assert ex.evaluate(derivative.residual, values) == pytest.approx(-2.0 * 0.6)


def test_singular_system_is_refused():
    with pytest.raises(InputError, match="structurally singular"):
        reduced(system(["x", "y"]), [ex.subtract(s("x"), 1), ex.subtract(s("x"), 2)])


def test_input_that_would_have_to_be_differentiated_is_refused():
    model = system(["x", "v", "u"], kinds={"u": Kind.INPUT})
    equations = [ex.subtract(s("x"), s("u")), ex.subtract(s("v"), d("x"))]
    with pytest.raises(UnsupportedModelError, match="the input u"):
        reduced(model, equations)
