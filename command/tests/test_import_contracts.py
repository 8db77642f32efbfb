"""Packages and sub-packages import in one direction, as the contracts in pyproject.toml say."""

from __future__ import annotations

from contact_data import checkout
from importlinter.cli import EXIT_STATUS_SUCCESS, lint_imports

PROJECT = checkout()


def test_imports_go_one_way(capsys):
    status = lint_imports(config_filename=str(PROJECT / "pyproject.toml"), cache_dir=None)
    assert status == EXIT_STATUS_SUCCESS, capsys.readouterr().out
