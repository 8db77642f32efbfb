"""Removing trivial equations."""

from __future__ import annotations

import pytest
from contact_foundation.errors import InputError
from modelica2fmu.equations.alias import eliminate_aliases, signed_terms
from modelica2fmu.expand.scalar_model import Kind, ScalarEquation, ScalarModel, ScalarVariable
from modelica2fmu.frontend import ir
from modelica2fmu.library.source_map import SourceMap
from modelica2fmu.symbolic import expression as ex


def s(name):
    return ex.symbol(name)


def reduced(variables, equations):
    model = ScalarModel("M", "")
    for variable in variables:
        model.variables[variable.name] = variable
    model.equations = [ScalarEquation(left, right) for left, right in equations]
    return eliminate_aliases(model, SourceMap([]))


def continuous(*names):
    return [ScalarVariable(name, "Real", Kind.CONTINUOUS) for name in names]


def test_chains_of_copies_and_negatives_end_at_one_variable():
    result = reduced(
        continuous("a", "b", "c", "d"),
        [(s("a"), s("b")), (ex.add(s("b"), s("c")), 0), (s("d"), ex.negate(s("c"))), (ex.symbol("der(a)"), s("c"))],
    )
    (equation,) = result.equations
    kept = {name for name in "abcd" if name not in result.replacements}
    assert len(kept) == 1
    (name,) = kept
    # der(a) = c = -a, whichever variable stands for all of them.
    values = {name: 2.0, f"der({name})": 5.0}
    assert abs(ex.evaluate(ex.subtract(equation.left, equation.right), values)) == 7.0


def test_constants_spread_through_expressions():
    result = reduced(
        continuous("zero", "x", "y"),
        [(s("zero"), 0), (s("x"), ex.multiply(s("zero"), s("y"))), (s("y"), ex.add(s("x"), 3))],
    )
    assert result.equations == []
    assert result.replacements == {"zero": 0, "x": 0, "y": 3}


def test_contradiction_is_an_error():
    with pytest.raises(InputError, match="contradict"):
        reduced(continuous("x", "y"), [(s("x"), 1), (s("y"), s("x")), (s("y"), 2)])


def test_variables_of_parameters_leave_the_equations():
    p = ScalarVariable("p", "Real", Kind.PARAMETER, value=2.0)
    result = reduced(
        [p, *continuous("a", "b", "x")],
        [(s("b"), ex.multiply(s("a"), 3)), (s("a"), ex.multiply(s("p"), s("p"))), (ex.symbol("der(x)"), s("b"))],
    )
    assert [name for name, _ in result.invariants] == ["a", "b"]
    assert len(result.equations) == 1


def test_removed_variable_leaves_its_start_value_and_preference():
    kept = ScalarVariable("k", "Real", Kind.CONTINUOUS)
    removed = ScalarVariable(
        "inner.r", "Real", Kind.CONTINUOUS, start=1.5, fixed=True, state_select=ir.StateSelect.PREFER
    )
    result = reduced([kept, removed], [(s("k"), ex.negate(s("inner.r"))), (ex.symbol("der(k)"), s("k"))])
    (name,) = {"k", "inner.r"} - set(result.replacements)
    variable = result.model.variables[name]
    assert variable.fixed
    assert variable.start == (1.5 if name == "inner.r" else -1.5)
    assert variable.state_select is ir.StateSelect.PREFER


def test_discrete_variable_stands_for_its_continuous_copy():
    model = [*continuous("copy"), ScalarVariable("held", "Real", Kind.DISCRETE)]
    scalar = ScalarModel("M", "", {item.name: item for item in model})
    scalar.equations = [
        ScalarEquation(s("copy"), s("held")),
        ScalarEquation(s("held"), ex.symbol("pre(held)"), target="held"),
    ]
    result = eliminate_aliases(scalar, SourceMap([]))
    assert result.replacements == {"copy": s("held")}


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (ex.subtract(s("a"), s("b")), (0, {"a": 1, "b": -1})),
        (ex.negate(ex.add(s("a"), s("b"))), (0, {"a": -1, "b": -1})),
        (ex.subtract(3, s("a")), (3, {"a": -1})),
        (ex.multiply(2, s("a")), None),
        (ex.add(s("a"), ex.add(s("b"), s("c"))), None),
    ],
)
def test_signed_terms(expression, expected):
    assert signed_terms(expression) == expected
