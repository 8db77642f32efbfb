"""What the front end refuses is told briefly, with the place and a way out."""

from __future__ import annotations

import pytest
from cmb_base.errors import InputError
from modelica2fmu.build import build_fmu


def test_a_package_whose_files_do_not_fit_is_named_with_a_few_of_them(tmp_path, monkeypatch):
    """As all files seem to be when a power failure has emptied what the front end keeps of them."""
    package = tmp_path / "Broken"
    package.mkdir()
    (package / "package.mo").write_text("package Broken end Broken;\n")
    for k in range(9):
        (package / f"M{k}.mo").write_text(f"model M{k} Real x = 1; end M{k};\n")  # without `within`
    (tmp_path / "Uses.mo").write_text("model Uses extends Broken.M1; end Uses;\n")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    with pytest.raises(InputError, match=r"Broken: is no package: ") as caught:
        build_fmu("Uses", [tmp_path / "Uses.mo", package], tmp_path / "u.fmu")
    text = str(caught.value)
    assert text.count("Broken") < 15
    assert "more\n" in text
    assert f"remove {tmp_path / 'cache' / 'rumoca'}" in text
