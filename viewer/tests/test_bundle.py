"""What set-up fetches: pinned with hashes, never committed, and told in one line where it cannot be had."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from headless_browser import needs_bundle
from javascript import VIEWER
from scene_viewer.bundle import NAMES, bundled

ROOT = VIEWER.parent


def test_every_package_is_pinned_with_a_hash_and_without_an_address() -> None:
    packages = json.loads((VIEWER / "package-lock.json").read_text())["packages"]
    wanted = json.loads((VIEWER / "package.json").read_text())
    for name, version in {**wanted["dependencies"], **wanted["devDependencies"]}.items():
        assert packages[f"node_modules/{name}"]["version"] == version  # no ranges
    for name, package in packages.items():
        if name:
            assert package["integrity"].startswith("sha512-"), name
            assert "resolved" not in package, name


def test_nothing_that_is_fetched_or_bundled_is_committed() -> None:
    listed = subprocess.run(["git", "ls-files", "viewer"], cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode != 0:
        pytest.skip("this is no checkout")
    assert not [name for name in listed.stdout.splitlines() if "node_modules" in name or "/bundle/" in name]


@needs_bundle
def test_scripts_carry_their_licences_and_ask_for_nothing_elsewhere() -> None:
    for name in NAMES:
        text = bundled(name)
        for call in ("importScripts(", "XMLHttpRequest", "WebSocket(", "sendBeacon"):
            assert call not in text, (name, call)
    assert "three.js authors" in bundled("viewer.js")
    assert "Leon Sorokin" in bundled("plots.js")


@needs_bundle
def test_the_wheel_carries_the_scripts(tmp_path: Path) -> None:
    words = [sys.executable, "setup.py", "-q", "build_py", "--build-lib", str(tmp_path)]
    subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True)
    for name in NAMES:
        assert (tmp_path / "scene_viewer" / "bundle" / name).read_text(encoding="utf-8") == bundled(name)


@pytest.mark.skipif(shutil.which("npm") is None, reason="npm is not installed")
def test_a_registry_that_cannot_be_reached_is_told_in_one_line(tmp_path: Path) -> None:
    leave = shutil.ignore_patterns("node_modules", "bundle", "tests")
    shutil.copytree(VIEWER, tmp_path / "viewer", ignore=leave)
    (tmp_path / "scripts").mkdir()
    program = shutil.copy(ROOT / "scripts" / "setup-viewer", tmp_path / "scripts")
    environment = {
        **os.environ,
        "npm_config_registry": "http://127.0.0.1:9",
        "npm_config_cache": str(tmp_path / "cache"),
    }
    done = subprocess.run([sys.executable, program], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 3
    (line,) = done.stderr.splitlines()
    assert "the viewer's scripts are not installed (npm: ECONNREFUSED)" in line
    assert "Call scripts/setup again" in line
    assert not (tmp_path / "viewer" / "scene_viewer" / "bundle").exists()
