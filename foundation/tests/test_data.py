"""The data that the programs read is found in the checkout."""

from __future__ import annotations

from pathlib import Path

import contact_data
import pytest

CHECKOUT = Path(__file__).resolve().parents[2]


def test_each_entry_leads_into_the_checkout():
    assert contact_data.modelica_library() == CHECKOUT / "ContactMultiBody"
    assert contact_data.core_subset() == CHECKOUT / "Resources" / "MultiBodyCore"
    assert contact_data.assembly_schema() == CHECKOUT / "Resources" / "schema" / "assembly.xsd"
    assert contact_data.depth_study() == CHECKOUT / "Resources" / "depth-study"
    assert contact_data.regression_cases() == CHECKOUT / "regression" / "cases"
    assert contact_data.dependencies() == CHECKOUT / ".deps"
    assert contact_data.checkout() == CHECKOUT


def test_entries_hold_what_they_say():
    assert (contact_data.modelica_library() / "package.mo").is_file()
    assert (contact_data.core_subset() / "Modelica" / "package.mo").is_file()
    assert contact_data.assembly_schema().is_file()
    assert (contact_data.depth_study() / "design.toml").is_file()
    assert list(contact_data.regression_cases().rglob("*.toml"))


def test_an_installation_without_cases_has_none(monkeypatch, tmp_path):
    monkeypatch.setattr(contact_data, "_entry", lambda name: tmp_path / name)
    assert contact_data.regression_cases() is None
    with pytest.raises(FileNotFoundError, match="no checkout"):
        contact_data.checkout()
