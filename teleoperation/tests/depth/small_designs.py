"""Designs for the tests."""

from __future__ import annotations

from pathlib import Path

import contact_data
from depth_study.design.design_file import load_design, parse_design
from depth_study.design.factors import Design

DESIGN_FILE = contact_data.depth_study() / "design.toml"
PUBLISHED_FILE = contact_data.depth_study() / "published.toml"

# A star: one centre, from which each of three factors alone can be switched on. No Hamiltonian path, three ends.
STAR = """
[factors]
a = ["off", "on"]
b = ["off", "on"]
c = ["off", "on"]
[[only]]
when = { a = "on" }
allow = { b = ["off"], c = ["off"] }
[[only]]
when = { b = "on" }
allow = { c = ["off"] }
"""


def thesis() -> Design:
    """The default design."""
    return load_design(DESIGN_FILE)


def design_of(text: str) -> Design:
    """The design of a TOML text."""
    return parse_design(text, Path("design.toml"))
