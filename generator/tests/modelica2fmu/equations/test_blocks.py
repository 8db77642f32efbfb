"""Blocks: order, tearing, linear systems, against numpy."""

from __future__ import annotations

import numpy as np
import pytest
from contact_foundation.errors import InputError, Place, UnsupportedModelError
from hypothesis import given, settings
from hypothesis import strategies as st
from modelica2fmu.equations.blocks import (
    Assignment,
    LinearBlock,
    NonlinearBlock,
    Residual,
    block_targets,
    blocks_around,
    divided_blocks,
    needed_blocks,
)
from modelica2fmu.equations.sorting import solve_order
from modelica2fmu.symbolic import expression as ex
from modelica2fmu.symbolic.linear_form import LinearForms, solved_for


def nowhere(_span):
    return Place()


def execute(blocks, values):
    """Evaluates blocks with numpy as solver of the torn systems."""
    values = dict(values)
    for block in blocks:
        if isinstance(block, Assignment):
            values[block.target] = ex.evaluate(block.value, values)
        else:
            assert isinstance(block, LinearBlock)
            matrix, right = linear_system(block, values)
            values = after_inner(block, values, np.linalg.solve(matrix, right))
    return values


def linear_system(block, values):
    """Matrix and right-hand side, from the closed form or from the equations."""
    if block.system is not None:
        matrix = np.array([[ex.evaluate(item, values) for item in row] for row in block.system.matrix])
        return matrix, np.array([ex.evaluate(item, values) for item in block.system.right])

    def residuals(torn):
        point = after_inner(block, values, torn)
        return np.array([ex.evaluate(item, point) for item in block.residuals])

    rest = residuals(np.zeros(len(block.torn)))
    columns = [residuals(unit) - rest for unit in np.eye(len(block.torn))]
    return np.array(columns).T, -rest


def after_inner(block, values, torn):
    """Values with the torn unknowns and what follows from them."""
    values = {**values, **dict(zip(block.torn, torn, strict=True))}
    for step in block.inner:
        values[step.target] = ex.evaluate(step.value, values)
    return values


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 10**6), st.integers(2, 12))
def test_torn_linear_systems_have_the_solution_of_the_whole(seed, size):
    random = np.random.default_rng(seed)
    matrix = np.where(random.random((size, size)) < 0.3, random.choice([1.0, -1.0, 2.0, 0.7], (size, size)), 0.0)
    matrix += np.diag(random.uniform(1.0, 3.0, size)) * 3
    matrix = matrix[random.permutation(size)]
    right = random.uniform(-1, 1, size)
    names = [f"x{number}" for number in range(size)]
    entries = []
    for row in range(size):
        total = ex.multiply(-right[row], ex.symbol("p"))
        for column in range(size):
            total = ex.add(total, ex.multiply(matrix[row, column], ex.symbol(names[column])))
        entries.append(Residual(total))
    blocks = solve_order(entries, names, [], nowhere)
    values = execute(blocks, {"p": 1.5})
    assert [values[name] for name in names] == pytest.approx(list(np.linalg.solve(matrix, 1.5 * right)), abs=1e-9)


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 10**6), st.integers(4, 12))
def test_divided_blocks_give_what_is_wanted_first_and_then_the_rest(seed, size):
    random = np.random.default_rng(seed)
    names = [f"x{number}" for number in range(2 * size)]
    entries = []
    for row, name in enumerate(names):  # each of those before, and half of them of others behind
        others = [other for k, other in enumerate(names) if k < row or (k % 2 and random.random() < 0.3)]
        chosen = random.choice(others, min(2, len(others)), replace=False) if others else []
        total = ex.subtract(ex.multiply(7.0, ex.symbol(name)), ex.symbol("p"))
        for other in chosen:
            total = ex.subtract(total, ex.symbol(str(other)))
        entries.append(Residual(total))
    blocks = solve_order(entries, names, [], nowhere)
    wanted = [str(name) for name in random.choice(names, 2, replace=False)]
    first, last = divided_blocks(blocks, wanted)
    early = execute(first, {"p": 1.5})
    whole = execute(blocks, {"p": 1.5})
    assert all(early[name] == whole[name] for name in wanted)
    assert execute(last, early) == whole
    solved = [name for block in first if isinstance(block, LinearBlock) for name in block.torn]
    needed = {name for block in needed_blocks(first, [*wanted, *solved]) for name in block_targets(block)}
    assert all(target in needed for block in first if isinstance(block, Assignment) for target in block_targets(block))


def test_blocks_that_two_systems_have_in_common_are_left_out_where_the_others_stand_around_them():
    x, y, z = (ex.symbol(name) for name in "xyz")
    simulation = [Assignment("y", ex.multiply(x, x)), Assignment("z", ex.add(y, x))]
    start, told = Assignment("x", ex.symbol("start(x)")), Assignment("told", z, is_discrete=True)
    assert blocks_around([start, *simulation, told], simulation) == ([start], [told])
    # What the simulation needs must not need it: then all is solved in its own order.
    between = Assignment("x", ex.subtract(ex.symbol("p"), y))
    assert blocks_around([simulation[0], between, simulation[1]], simulation) is None
    other = [start, Assignment("y", x), simulation[1]]
    assert blocks_around(other, simulation) is None


def test_long_chains_are_evaluated_from_their_equations_and_short_ones_in_closed_form():
    # Masses in a row: accelerations a[k] = a[k - 1] + s[k], forces f[k] = f[k + 1] + a[k], p f[k] + s[k] = k + 1.
    for count, closed in ((4, True), (40, False)):
        s, a, f = ([ex.symbol(f"{kind}{k}") for k in range(count)] for kind in ("der(s)", "a", "f"))
        entries = []
        for k in range(count):
            entries.append(Residual(ex.subtract(a[k], ex.add(a[k - 1] if k else 0, s[k]))))
            entries.append(Residual(ex.subtract(f[k], ex.add(f[k + 1] if k + 1 < count else 0, a[k]))))
            entries.append(Residual(ex.subtract(ex.add(ex.multiply(ex.symbol("p"), f[k]), s[k]), k + 1)))
        names = [node.name for node in (*s, *a, *f)]
        (block,) = solve_order(entries, names, [node.name for node in s], nowhere)
        assert isinstance(block, LinearBlock)
        assert len(block.torn) == count
        assert (block.system is not None) == closed
        values = execute([block], {"p": 2.0})
        ones = np.tri(count)
        expected = np.linalg.solve(2.0 * ones.T @ ones + np.eye(count), np.arange(1.0, count + 1.0))
        assert [values[node.name] for node in s] == pytest.approx(list(expected))


def test_rows_of_a_trunk_stand_below_those_of_its_legs():
    # Each of four legs shares the trunk's unknown alone; their rows come in another order, behind the trunk's.
    p, legs, trunk = ex.symbol("p"), [ex.symbol(f"leg{k}") for k in range(4)], ex.symbol("trunk")
    of_trunk = ex.multiply(p, trunk)
    for leg in legs:
        of_trunk = ex.add(of_trunk, ex.multiply(p, leg))
    of_legs = [ex.add(ex.multiply(p, leg), ex.add(ex.multiply(p, trunk), k)) for k, leg in enumerate(legs)]
    entries = [Residual(row) for row in (of_trunk, *of_legs[::-1])]
    names = [node.name for node in (trunk, *legs)]
    (block,) = solve_order(entries, names, [], nowhere)
    assert isinstance(block, LinearBlock)
    assert block.system is not None
    matrix, _ = linear_system(block, {"p": 2.0})
    assert (np.diag(matrix) != 0.0).all()
    values = execute([block], {"p": 2.0})
    assert [values[node.name] for node in legs] == pytest.approx([-values["trunk"] - 0.5 * k for k in range(4)])


def test_tearing_assumes_the_preferred_unknown():
    # A pendulum's equations: given the acceleration a, all forces follow.
    a, f, g, m = (ex.symbol(name) for name in ("der(w)", "f", "g", "m"))
    entries = [Residual(ex.subtract(f, ex.multiply(m, a))), Residual(ex.add(ex.multiply(3, a), ex.add(f, g)))]
    (block,) = solve_order(entries, ["f", "der(w)"], ["der(w)"], nowhere)
    assert isinstance(block, LinearBlock)
    assert block.torn == ("der(w)",)
    assert block.inner[0].target == "f"


def test_nonlinear_component_keeps_explicit_parts_out_of_the_iteration():
    x, y, z = (ex.symbol(name) for name in "xyz")
    entries = [
        Residual(ex.subtract(y, ex.unary("cos", x))),
        Residual(ex.subtract(z, ex.unary("sin", x))),
        Residual(ex.subtract(ex.add(y, z), ex.symbol("p"))),
    ]
    (block,) = solve_order(entries, ["x", "y", "z"], [], nowhere)
    assert isinstance(block, NonlinearBlock)
    assert block.torn == ("x",)
    assert [step.target for step in block.inner] == ["y", "z"]


def test_discrete_loop_is_reported_by_its_variables():
    a, b = ex.symbol("a"), ex.symbol("b")
    entries = [Assignment("a", ex.logical_not(b), is_discrete=True), Assignment("b", a, is_discrete=True)]
    with pytest.raises(UnsupportedModelError, match=r"a, b|b, a"):
        solve_order(entries, ["a", "b"], [], nowhere)


def test_singular_system_names_equation_and_unknown():
    x = ex.symbol("x")
    with pytest.raises(InputError, match="unknowns without an equation: y"):
        solve_order([Residual(ex.subtract(x, 1)), Residual(ex.add(x, 2))], ["x", "y"], [], nowhere)


def test_blocks_nobody_needs_are_left_out():
    blocks = [Assignment("a", ex.symbol("p")), Assignment("b", ex.symbol("a")), Assignment("c", ex.symbol("p"))]
    assert [block.target for block in needed_blocks(blocks, ["b"])] == ["a", "b"]


@pytest.mark.parametrize(
    ("residual", "value"),
    [
        (ex.subtract(ex.symbol("x"), ex.symbol("p")), 2.0),
        (ex.add(ex.multiply(ex.symbol("p"), ex.symbol("x")), 6), -3.0),
        (ex.subtract(ex.divide(ex.symbol("x"), ex.symbol("p")), 5), 10.0),
        (ex.add(ex.symbol("x"), ex.subtract(ex.multiply(ex.symbol("p"), ex.symbol("x")), 9)), 3.0),
    ],
)
def test_single_equations_are_solved(residual, value):
    solution = solved_for(residual, "x")
    assert solution is not None
    assert ex.evaluate(solution, {"p": 2.0}) == pytest.approx(value)


def test_nonlinear_equation_is_not_solved():
    assert solved_for(ex.subtract(ex.unary("sin", ex.symbol("x")), ex.symbol("x")), "x") is None


def test_linear_form_has_slopes_and_rest():
    x, y, p = (ex.symbol(name) for name in "xyp")
    expression = ex.add(
        ex.multiply(ex.unary("sin", p), ex.subtract(x, ex.multiply(2, y))), ex.select(ex.less(p, 1), x, 3)
    )
    form = LinearForms(["x", "y"])(expression)
    assert form is not None
    values = {"p": 0.3, "x": 1.7, "y": -0.4}
    total = ex.evaluate(form.constant, values) + sum(
        ex.evaluate(slope, values) * values[name] for name, slope in form.coefficients.items()
    )
    assert total == pytest.approx(ex.evaluate(expression, values))
    assert LinearForms(["x"])(ex.multiply(x, x)) is None


REMEMBERED = """model Remembered "A rate follows from what was caught from a loop, and from nothing else"
  Real phi(start = 0.3), psi(start = -0.4);
  discrete Real caught;
  Real s(start = 0, fixed = true);
initial equation
  pre(caught) = psi;
equation
  cos(phi) + cos(psi) = 1.5;
  sin(phi) + sin(psi) = 0.1;
  when time > 0.5 then
    caught = 2*phi;
  end when;
  der(s) = caught;
end Remembered;
"""


def test_rates_behind_discrete_variables_stay_out_of_the_loop_that_they_follow_from(simulate):
    result = simulate(REMEMBERED, ["phi", "psi", "s"], stop=1.0)
    assert result["s"][-1] == pytest.approx(0.5 * result["psi"][0] + 0.5 * 2 * result["phi"][0], abs=1e-6)
