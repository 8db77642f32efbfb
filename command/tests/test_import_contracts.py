"""Packages and sub-packages import in one direction, as the contracts in pyproject.toml say."""

from __future__ import annotations

from pathlib import Path

from importlinter.cli import EXIT_STATUS_SUCCESS, lint_imports

PROJECT = Path(__file__).resolve().parents[2]


def test_imports_go_one_way(capsys):
    status = lint_imports(config_filename=str(PROJECT / "pyproject.toml"), cache_dir=None)
    assert status == EXIT_STATUS_SUCCESS, capsys.readouterr().out
