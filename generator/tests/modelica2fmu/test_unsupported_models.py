"""Wrong and untranslatable models are refused with file and line, and nothing is written."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from contact_foundation.errors import InputError, UnsupportedModelError
from modelica2fmu.build import BuildOptions, build_fmu


def refused(text: str, folder: Path, error: type[InputError], **options: object) -> InputError:
    name = text.split(None, 2)[1]
    source = folder / f"{name}.mo"
    source.write_text(text, encoding="utf-8")
    output = folder / "out.fmu"
    with pytest.raises(error) as caught:
        build_fmu(name, [source], output, **options)
    assert not output.exists()
    assert sorted(path.name for path in folder.iterdir()) == [source.name]
    assert caught.value.exit_status == 2
    assert isinstance(caught.value, InputError)
    return caught.value


def test_syntax_error_has_file_and_line(tmp_path):
    error = refused("model Broken\n  Real x;\nequation\n  der(x) = -x\nend Broken;\n", tmp_path, InputError)
    assert error.place is not None
    assert error.place.file is not None
    assert error.place.file.name == "Broken.mo"
    assert error.place.line == 5
    assert "end" in error.message


def test_unknown_variable_has_file_and_line(tmp_path):
    error = refused("model Unknown\n  Real x;\nequation\n  der(x) = -why;\nend Unknown;\n", tmp_path, InputError)
    assert "why" in error.message
    assert error.place is not None
    assert error.place.line == 4


def test_function_that_is_not_translated_is_named_with_its_line(tmp_path):
    text = 'model Late\n  Real x = time;\n  parameter Real y = 2;\n  parameter String s = String(y, format = "%g");\n'
    text += "end Late;\n"
    error = refused(text, tmp_path, UnsupportedModelError)
    assert "C format" in error.message
    assert error.place is not None
    assert (error.place.file.name if error.place.file else "", error.place.line) == ("Late.mo", 4)


def test_panic_of_the_front_end_is_an_error_of_the_model(tmp_path):
    refused("model Rate\n  input Real u;\n  Real y = der(u);\nend Rate;\n", tmp_path, InputError)


def test_derivative_of_external_output_is_refused(tmp_path):
    text = """model Rough
  pure function f
    input Real x;
    output Real y;
    external "C" y = sin(x) annotation(Include = "#include <math.h>");
  end f;
  Real x = f(time);
  Real v = der(x);
end Rough;
"""
    error = refused(text, tmp_path, UnsupportedModelError)
    assert "external function" in error.message
    assert error.place is not None
    assert error.place.line in (7, 8)


def test_linearly_dependent_equations_are_refused(tmp_path):
    text = "model Singular\n  Real x, y;\nequation\n  x + y = 1;\n  2*x + 2*y = 2;\nend Singular;\n"
    error = refused(text, tmp_path, InputError)
    assert "linearly dependent" in error.message


def test_unbalanced_model_is_refused(tmp_path):
    refused("model Open\n  Real x, y;\nequation\n  x = time;\nend Open;\n", tmp_path, InputError)


def test_parameter_without_value_is_warned_of(tmp_path, fmu_cache):
    source = tmp_path / "Unset.mo"
    source.write_text("model Unset\n  parameter Real p;\n  Real x = p*time;\nend Unset;\n", encoding="utf-8")
    report = build_fmu("Unset", [source], tmp_path / "out.fmu", BuildOptions(cache=fmu_cache))
    assert any("parameter p has no value" in warning for warning in report.warnings)


def test_missing_source_is_named(tmp_path):
    with pytest.raises(InputError, match="does not exist"):
        build_fmu("M", [tmp_path / "M.mo"], tmp_path / "out.fmu")


@pytest.mark.parametrize("name", ["", "a b", "../x", "1M", "M.", "M;system"])
def test_names_that_are_no_class_names_are_refused(tmp_path, name):
    with pytest.raises(InputError, match="no name"):
        build_fmu(name, [tmp_path], tmp_path / "out.fmu")


def test_folder_of_external_code_must_stay_in_its_package(tmp_path):
    text = """model Escape
  pure function f
    input Real x;
    output Real y;
    external "C" y = f(x) annotation(IncludeDirectory = "modelica://Escape/../../etc");
  end f;
  Real x = f(time);
end Escape;
"""
    error = refused(text, tmp_path, InputError)
    assert "leaves its package" in error.message


LOOP = (
    "model Loop\n  Real v[4](each start = 1, each fixed = true);\n  Real a[4];\nequation\n  for i in 1:4 loop\n    {}\n"
)
LOOP += "  end for;\n  {}\nend Loop;\n"


def test_derivatives_of_elements_in_a_loop_are_refused_where_they_are_lost(tmp_path):
    error = refused(LOOP.format("der(v[i]) = -i*v[i];", "a = v;"), tmp_path, UnsupportedModelError)
    assert "0 for the right side" in error.message
    assert error.place is not None
    assert (error.place.file.name if error.place.file else "", error.place.line) == ("Loop.mo", 5)
    assert "der(v) = a" in (error.remedy or "")


def test_the_loop_written_as_the_message_says_decays(simulate):
    result = simulate(LOOP.format("a[i] = -i*v[i];", "der(v) = a;"), ["v[1]", "v[4]"])
    assert result["v[1]"][-1] == pytest.approx(math.exp(-1), rel=1e-6)
    assert result["v[4]"][-1] == pytest.approx(math.exp(-4), rel=1e-5)


def test_a_derivative_that_is_zero_is_none_that_was_lost(simulate):
    text = (
        LOOP.format("a[i] = i;", "der(v) = zeros(4);")
        .replace("model Loop", "model Rest")
        .replace("end Loop", "end Rest")
    )
    assert simulate(text.replace("Loop", "Rest"), ["v[3]"])["v[3]"][-1] == 1.0


def test_arrays_beyond_reach_are_told_at_once(translated):
    text = "model Wide\n  Real small = 1;\n  Real big[3000, 3000](each start = 0, each fixed = true);\nequation\n"
    with pytest.raises(UnsupportedModelError, match=r"of 3000 x 3000 elements") as caught:
        translated(f"{text}  der(big) = -big;\nend Wide;\n")
    assert caught.value.place is not None
    assert (caught.value.place.line, caught.value.place.component) == (3, "big")
    assert "9000001 scalar variables" in caught.value.message
