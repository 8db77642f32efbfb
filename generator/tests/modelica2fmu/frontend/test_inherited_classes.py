"""Classes that a package inherits are found by their names with dots (Modelica Language Specification 3.6, 5.3.2)."""

from __future__ import annotations

import pytest
from contact_foundation.errors import InputError
from fmpy import read_model_description
from modelica2fmu.build import BuildOptions, build_fmu

FLUIDS = {
    "Fluid": "package Fluid model Part parameter Real q = 1; end Part; type T = Real(min = 0);"
    " record R Real a = 3; end R; end Fluid;",
    "Water": 'package Water "of " + "1 mm" extends Fluid; end Water;',
}
MODEL = (
    "model Short = Water.Part(q = 7); model M extends Water.Part(q = 5); Water.Part a; Water.Part b(q = 3);"
    " parameter Water.T t = 4; parameter Water.R r(a = 6); Short s; end M;"
)
VALUES = {"q": 5, "a.q": 1, "b.q": 3, "t": 4, "r.a": 6, "s.q": 7}


def starts(fmu):
    return {each.name: float(each.start) for each in read_model_description(str(fmu)).modelVariables if each.start}


def test_in_a_file(tmp_path, fmu_cache):
    source = tmp_path / "P.mo"
    source.write_text(f'package P "some"\n{" ".join(FLUIDS.values())}\n{MODEL}\nend P;\n', encoding="utf-8")
    build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    assert starts(tmp_path / "M.fmu").items() >= VALUES.items()


def test_in_a_package_of_files(tmp_path, fmu_cache):
    package = tmp_path / "P"
    package.mkdir()
    (package / "package.mo").write_text("package P\nend P;\n", encoding="utf-8")
    for name, text in {**FLUIDS, "M": "model M Water.Part a; Water.Part b(q = 3); end M;"}.items():
        (package / f"{name}.mo").write_text(f"within P;\n{text}\n", encoding="utf-8")
    build_fmu("P.M", [package], tmp_path / "M.fmu", BuildOptions(cache=fmu_cache))
    assert starts(tmp_path / "M.fmu").items() >= {"a.q": 1, "b.q": 3}.items()


def test_another_error_of_the_same_model_is_told_with_its_line(tmp_path):
    source = tmp_path / "P.mo"
    model = "model M\n  Water.Part a;\n  Real x = nothing + 1;\nend M;"
    text = f"package P\n{' '.join(FLUIDS.values())}\n{model}\nend P;\n"
    source.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="nothing") as caught:
        build_fmu("P.M", [source], tmp_path / "M.fmu", BuildOptions())
    assert caught.value.place.line == 5
    assert not (tmp_path / "M.fmu").exists()
