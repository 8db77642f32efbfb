"""Pictures of the animation at chosen times, taken by a headless Chromium from the report itself."""

from __future__ import annotations

import math
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from contact_foundation.errors import BuildError, InputError
from contact_foundation.output import whole_file

from fmu_regression.report.simulation_report import report_html
from fmu_regression.results.result import SimulationResult
from fmu_regression.scene.scene_file import Scene

_BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# What the browser does in the background would need a network; the software renderer needs no display or GPU.
_FLAGS = (
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--disable-quic",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--hide-scrollbars",
    "--virtual-time-budget=5000",
)
_TIME_LIMIT = 120
_PNG_START = b"\x89PNG"


def find_browser() -> str | None:
    """Path of a Chromium on this machine, or None."""
    return next((path for name in _BROWSERS if (path := shutil.which(name))), None)


def save_pictures(
    result: SimulationResult,
    scene: Scene,
    times: Sequence[float],
    targets: Sequence[Path],
    *,
    size: tuple[int, int] = (1280, 720),
) -> None:
    """Saves the animation at some times as PNG files.

    Args:
        result: the simulation.
        scene: with geometry.
        times: s.
        targets: one PNG file for each time.
        size: width and height in pixels.

    Raises:
        InputError: a time is not finite, or the scene has no geometry.
        BuildError: there is no Chromium, or it takes no picture.
    """
    if not all(math.isfinite(time) for time in times):
        raise InputError("the time of a picture must be a number")
    if not any(mesh.triangles.size for body in scene.bodies for mesh in body.meshes):
        raise InputError(f"{scene.name} has no geometry to draw")
    browser = find_browser()
    if browser is None:
        raise BuildError("no Chromium found to draw pictures", remedy="install the Debian package chromium")
    with tempfile.TemporaryDirectory(prefix="cmb-picture-") as folder:
        page = Path(folder) / "report.html"
        page.write_text(report_html(result, scene), encoding="utf-8")
        for time, target in zip(times, targets, strict=True):
            with whole_file(target) as staging:
                _shoot(browser, f"{page.as_uri()}#t={time:.9g}&picture", staging, Path(folder), size)


def _shoot(browser: str, address: str, target: Path, folder: Path, size: tuple[int, int]) -> None:
    shot = folder / "shot.png"
    command = [
        browser,
        *_FLAGS,
        f"--user-data-dir={folder / 'profile'}",
        f"--window-size={size[0]},{size[1]}",
        f"--screenshot={shot}",
        address,
    ]
    try:
        run = subprocess.run(command, capture_output=True, timeout=_TIME_LIMIT, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise BuildError(f"Chromium failed: {error}") from error
    if not shot.is_file() or not shot.read_bytes().startswith(_PNG_START):
        detail = run.stderr.decode("utf-8", "replace").strip().splitlines()
        raise BuildError(
            f"Chromium took no picture (status {run.returncode}): {detail[-1] if detail else 'no message'}"
        )
    target.write_bytes(shot.read_bytes())
    shot.unlink()
