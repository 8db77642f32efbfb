"""What is told of the machine beside figures."""

from __future__ import annotations

import os

from fmu_regression.compare.provenance import load, load_text


def test_a_load_beyond_the_cores_is_told_to_lengthen_times():
    cores = os.cpu_count() or 1
    alone, beside = load_text([0.25, None, 0.75]), load_text([0.5, 4.0 * cores])
    assert alone == "Times were measured at a load of 0.2 to 0.8, 0.5 in the median."
    assert f"load of 0.5 to {4.0 * cores:.1f}" in beside
    assert "beside other work, which lengthens them" in beside


def test_a_load_that_is_not_known_is_not_told(monkeypatch):
    def none() -> tuple[float, float, float]:
        raise OSError

    monkeypatch.setattr(os, "getloadavg", none)
    assert load() is None
    assert load_text([load(), None]) == ""
