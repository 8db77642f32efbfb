"""Elements of arrays of components have the values that the language says, or the model is refused.

Modelica Language Specification 3.6: 7.2.5 (modification of arrays), 10.4.1.1 (``{e for i in A, j in B}`` is ``{{e for i
in A} for j in B}``), 10.4.2 (``[a, b]`` of vectors has them for columns).
"""

from __future__ import annotations

import random

import numpy as np
import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError, UnsupportedModelError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu, translate
from modelica2fmu.library.standard_library import StandardLibrary

MODELS = """package Arrays
  model Vector
    parameter Real k[2] = {0, 0};
    Real x[2](each start = 0);
  equation
    der(x) = k;
  end Vector;
  model Scalar
    parameter Real k = 0;
    Real x(start = 0);
  equation
    der(x) = k;
  end Scalar;
  model M
    %s
  end M;
end Arrays;
"""
VECTORS = "give the array a name"
NESTED = "with the last iterator outermost"
ROWS = "{{1, 2}, ones(2)}, and its name"


def written(folder, text):
    file = folder / "Arrays.mo"
    file.write_text(MODELS % text, encoding="utf-8")
    return file


@pytest.mark.parametrize(
    ("text", "remedy"),
    [
        ("Vector o[2](k = [{1, 2}, {3, 4}]);", VECTORS),
        ("Vector o[2](k = [{i for i in 1:2}, ones(2)]);", VECTORS),
        ("parameter Real a[2] = {1, 2}; Vector o[2](k = [a, 2*a]);", VECTORS),
        ("Vector o[2](x(start = [{1, 2}, zeros(2)]));", VECTORS),
        ("Scalar o[2, 2](k = [{1, 2}, {3, 4}]);", VECTORS),
        ("Scalar o[2, 2](k = {10*i + j for i in 1:2, j in 1:2});", NESTED),
        ("Scalar o[2, 2](x(start = {10*i + j for i in 1:2, j in 1:2}));", NESTED),
        ("Scalar o[2, 2](k = {{5, -2}, ones(2)});", ROWS),
        ("Scalar o[2, 2](k = {{5, -2}, {3*i for i in 1:2}});", ROWS),
    ],
)
def test_arrays_that_the_front_end_takes_apart_wrongly_are_refused(text, remedy, tmp_path):
    file = written(tmp_path, text)
    with pytest.raises(UnsupportedModelError) as caught:
        translate("Arrays.M", [file], StandardLibrary(core_subset(), "", "core subset"))
    assert "take" in caught.value.message
    assert remedy in (caught.value.remedy or "")
    assert caught.value.place is not None
    assert caught.value.place.line == 15


def test_arrays_of_numbers_and_names_are_taken_apart(tmp_path, fmu_cache):
    file = written(
        tmp_path,
        "parameter Real rows[2, 2] = [{1, 2}, {3, 4}];"
        " Vector named[2](k = rows); Vector each_[2](each k = {1, 2}); Scalar m[2, 2](k = [1, 2.5e0; 3, 4]);"
        " parameter Real mixed[:, :] = {{5, -2}, ones(2)}; Scalar s[2, 2](k = mixed);"
        " Vector w[2](k = {{5, -2}, ones(2)});"
        " parameter Real more[:, :] = {{10*i + j for i in 1:2} for j in 1:2}; Scalar n[2, 2](k = more);",
    )
    build_fmu("Arrays.M", [file], tmp_path / "m.fmu", BuildOptions(cache=fmu_cache))
    wanted = {
        "named[1].x[2]": 3,
        "named[2].x[1]": 2,
        "each_[2].x[2]": 2,
        "m[1,2].x": 2.5,
        "m[2,1].x": 3,
        "n[1,2].x": 21,
        "s[1,2].x": -2,
        "s[2,1].x": 1,
        "w[2].x[1]": 1,
    }
    result = simulate_fmu(str(tmp_path / "m.fmu"), output=list(wanted), stop_time=1)
    assert {name: result[name][-1] for name in wanted} == pytest.approx(wanted, rel=1e-6)


# --- random modifiers ---


def _vector(source: random.Random, size: int) -> tuple[str, np.ndarray]:
    """An expression, and its value, that Python's own rules of arrays say."""
    values = np.array([source.randint(-9, 9) for _ in range(size)], float)
    literal = "{" + ", ".join(f"{value:g}" for value in values) + "}"
    number = source.randint(2, 5)
    step = np.arange(1, size + 1)
    return source.choice(
        [
            (literal, values),
            (f"fill({number}, {size})", np.full(size, float(number))),
            (f"{{{number}*i for i in 1:{size}}}", number * step),
            (f"{{i^2 - {number} for i in 1:{size}}}", step**2 - number),
            (f"ones({size})", np.ones(size)),
        ]
    )


def _matrix(source: random.Random, rows: int, columns: int) -> tuple[str, np.ndarray]:
    """The same of two dimensions."""
    kind = source.randrange(4)
    if kind == 0:
        lines = [_vector(source, columns) for _ in range(rows)]
        return "{" + ", ".join(text for text, _ in lines) + "}", np.array([value for _, value in lines])
    if kind == 1:
        lines = [_vector(source, rows) for _ in range(columns)]
        return "[" + ", ".join(text for text, _ in lines) + "]", np.array([value for _, value in lines]).T
    if kind == 2:
        number = source.randint(2, 9)
        value = np.array([[number * i + j for i in range(1, columns + 1)] for j in range(1, rows + 1)], float)
        return f"{{{number}*i + j for i in 1:{columns}, j in 1:{rows}}}", value
    value = np.array([[source.randint(-9, 9) for _ in range(columns)] for _ in range(rows)], float)
    return "[" + "; ".join(", ".join(f"{item:g}" for item in line) for line in value) + "]", value


@pytest.mark.full
@pytest.mark.parametrize("seed", range(6))
def test_random_arrays_of_modifiers_hold_or_are_refused(seed, tmp_path, fmu_cache):
    source = random.Random(seed)
    parts, wanted = ["Scalar plain[2](k = {3, 4});"], {"plain[2].x": 4.0}
    for number in range(10):
        size = source.randint(2, 3)
        name = f"o{number}"
        if source.random() < 0.5:
            text, value = _matrix(source, size, 2)
            part = f"Vector {name}[{size}](k = {text});"
            found = {f"{name}[{i + 1}].x[{j + 1}]": value[i, j] for i in range(size) for j in range(2)}
        else:
            text, value = _matrix(source, size, 3)
            part = f"Scalar {name}[{size}, 3](k = {text});"
            found = {f"{name}[{i + 1},{j + 1}].x": value[i, j] for i in range(size) for j in range(3)}
        file = written(tmp_path, part)
        try:
            translate("Arrays.M", [file], StandardLibrary(core_subset(), "", "core subset"))
        except InputError:
            continue
        parts.append(part)
        wanted.update(found)
    file = written(tmp_path, " ".join(parts))
    build_fmu("Arrays.M", [file], tmp_path / "m.fmu", BuildOptions(cache=fmu_cache))
    result = simulate_fmu(str(tmp_path / "m.fmu"), output=list(wanted), stop_time=1)
    assert {name: result[name][-1] for name in wanted} == pytest.approx(wanted, rel=1e-6)
