"""Statements rolled into loops are the statements that were there, in their order."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from modelica2fmu.codegen.rolled_code import rolled

LOOP = re.compile(r"for \(size_t rolled = 0; rolled < (\d+); \+\+rolled\) \{")
INDEX = re.compile(r"\[(\d+) ([+-]) (\d+) \* rolled\]")


def unrolled(lines: Sequence[str]) -> list[str]:
    """What the loops execute, statement by statement."""
    result: list[str] = []
    position = 0
    while position < len(lines):
        head = LOOP.fullmatch(lines[position])
        position += 1
        if head is None:
            result.append(lines[position - 1])
            continue
        end = lines.index("}", position)
        for k in range(int(head[1])):
            for line in lines[position:end]:
                result.append(INDEX.sub(lambda m, k=k: f"[{int(m[1]) + int(m[2] + m[3]) * k}]", line.strip()))
        position = end + 1
    return result


pieces = st.one_of(
    st.tuples(st.integers(0, 50), st.integers(-2, 13), st.integers(1, 60), st.sampled_from("rwi")).map(
        lambda p: [f"{p[3]}[{abs(p[0] + p[1] * k)}]" for k in range(p[2])]
    ),
    st.tuples(st.integers(0, 9), st.integers(0, 20)).map(
        lambda p: [f"(r[{p[0] + 6 * (k // 3) + k % 3}]*w[{k}])" for k in range(3 * p[1])]
    ),
    st.lists(st.sampled_from(["0.5", "r[3]", "w[4]", "(1.0 / r[7])"]), max_size=5),
)


@settings(max_examples=300, deadline=None)
@given(st.lists(pieces, max_size=6))
def test_loops_execute_the_same_statements(parts: list[list[str]]) -> None:
    texts = [text for part in parts for text in part]
    statements = [f"a1[{k}] = {text};" for k, text in enumerate(texts)]
    lines = rolled(statements)
    assert unrolled(lines) == statements
    assert len(lines) <= len(statements)


@pytest.mark.parametrize("period", [1, 2, 3, 4, 6, 9])
def test_regular_copies_are_one_loop_whatever_their_number(period: int) -> None:
    statements = [f"a7[{k}] = r[{20 + 13 * (k // period) + k % period}];" for k in range(500 * period)]
    assert len(rolled(statements)) == period + 2


MANY = """model Many
  constant Integer n = 300;
  function mixed
    input Real x[:, 2];
    input Real scale[size(x, 1)];
    output Real y[size(x, 1), 2];
  external "C" mix_all(x, size(x, 1), scale, y)
    annotation(Include="static void mix_all(const double *x, size_t n, const double *s, double *y) {
      for (size_t i = 0; i < n; ++i) { y[2*i] = s[i]*x[2*i + 1]; y[2*i + 1] = -s[i]*x[2*i]; } }");
  end mixed;
  parameter Real scale[n] = {1 + 0.01*i for i in 1:n};
  Real x[n, 2](start = {{i/n, 0} for i in 1:n}, each fixed = true);
equation
  der(x) = mixed(x, scale);
  annotation(experiment(StopTime = 1, Tolerance = 1e-9, Interval = 0.25));
end Many;
"""


def test_a_call_with_hundreds_of_elements_gets_and_gives_each(simulate: Callable[..., np.ndarray]) -> None:
    result = simulate(MANY, [f"x[{i},{j}]" for i in range(1, 301) for j in (1, 2)], stop=1.0, fmi_type="CoSimulation")
    for i in (1, 2, 77, 299, 300):
        angle = (1 + 0.01 * i) * result["time"]
        assert result[f"x[{i},1]"] == pytest.approx(i / 300 * np.cos(angle), abs=1e-6)
        assert result[f"x[{i},2]"] == pytest.approx(-i / 300 * np.sin(angle), abs=1e-6)
