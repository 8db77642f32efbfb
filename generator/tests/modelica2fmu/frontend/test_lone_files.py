"""A model in a file by itself is built whatever lies beside the file."""

from __future__ import annotations

import numpy as np
import pytest
from contact_data import core_subset
from contact_foundation.errors import InputError
from fmpy import simulate_fmu
from modelica2fmu.build import BuildOptions, build_fmu, translate
from modelica2fmu.frontend import loading
from modelica2fmu.frontend.runner import Answer
from modelica2fmu.library.standard_library import StandardLibrary

DECAY = """
model Decay
  Real x(start = 1, fixed = true);
equation
  der(x) = -x;
end Decay;
"""
# Two definitions of one class, which no package may have, and a file that is no Modelica at all.
BESIDE = {
    "first.mo": "model Other Real a = 1; end Other;",
    "second.mo": "model Other Real a = 2; end Other;",
    "n.mo": "?",
}


@pytest.fixture
def folder(tmp_path):
    for name, text in BESIDE.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def final_value(fmu, name):
    return simulate_fmu(str(fmu), stop_time=1.0, relative_tolerance=1e-8, output=[name])[name][-1]


def test_files_beside_a_model_are_not_loaded(folder, fmu_cache):
    (folder / "Decay.mo").write_text(DECAY)
    build_fmu("Decay", [folder / "Decay.mo"], folder / "m.fmu", BuildOptions(cache=fmu_cache))
    assert final_value(folder / "m.fmu", "x") == pytest.approx(np.exp(-1), rel=1e-6)


def test_files_beside_a_package_in_one_file_are_not_loaded(folder, fmu_cache):
    (folder / "Laws.mo").write_text(f"package Laws {DECAY} end Laws;")
    (folder / "User.mo").write_text("model User\n  Laws.Decay decay;\nend User;\n")
    build_fmu("User", [folder / "User.mo", folder / "Laws.mo"], folder / "m.fmu", BuildOptions(cache=fmu_cache))
    assert final_value(folder / "m.fmu", "decay.x") == pytest.approx(np.exp(-1), rel=1e-6)


def test_files_of_a_package_folder_are_loaded(folder, fmu_cache):
    package = folder / "Laws"
    package.mkdir()
    (package / "package.mo").write_text("package Laws\nend Laws;\n")
    (package / "package.order").write_text("Decay\nUser\n")
    (package / "Decay.mo").write_text(f"within Laws;{DECAY}")
    (package / "User.mo").write_text("within Laws;\nmodel User\n  Decay decay;\nend User;\n")
    build_fmu("Laws.User", [package], folder / "m.fmu", BuildOptions(cache=fmu_cache))
    assert final_value(folder / "m.fmu", "decay.x") == pytest.approx(np.exp(-1), rel=1e-6)


def test_errors_name_the_file_itself(folder):
    (folder / "Decay.mo").write_text(DECAY.replace("= -x", "= -y"))
    with pytest.raises(InputError, match="'y'") as caught:
        build_fmu("Decay", [folder / "Decay.mo"], folder / "m.fmu")
    assert (caught.value.place.file, caught.value.place.line) == (folder / "Decay.mo", 5)
    assert "cmb-sources" not in str(caught.value)


def test_a_file_that_names_no_library_uses_one_that_does(tmp_path, fmu_cache):
    (tmp_path / "Laws.mo").write_text(f"package Laws {DECAY.replace('= -x', '= -Modelica.Constants.pi*x')} end Laws;")
    (tmp_path / "User.mo").write_text("model User\n  Laws.Decay decay;\nend User;\n")
    sources = [tmp_path / "User.mo", tmp_path / "Laws.mo"]
    build_fmu("User", sources, tmp_path / "m.fmu", BuildOptions(msl=core_subset(), cache=fmu_cache))
    assert final_value(tmp_path / "m.fmu", "decay.x") == pytest.approx(np.exp(-np.pi), rel=1e-6)


def test_libraries_that_no_file_names_are_not_loaded(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(loading, "ask", lambda request, _remark: asked.append(request) or Answer(error="enough"))
    for text in (DECAY, DECAY.replace("-x", "-x*Modelica.Constants.pi")):
        (tmp_path / "Decay.mo").write_text(text)
        with pytest.raises(InputError):
            translate("Decay", [tmp_path / "Decay.mo"], StandardLibrary(core_subset(), "", "core subset"))
    assert "import Modelica;" not in asked[0].text
    assert "import Modelica;" in asked[-1].text
