"""The tutorial of the user's guide, followed to the letter, ends with what it says."""

from __future__ import annotations

import html
import re
from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu
from library_compiler import REPOSITORY
from modelica2fmu.build import BuildOptions, build_fmu

G = 9.80665
"""What a World takes unless it is told otherwise."""

pytestmark = pytest.mark.skipif(
    not (REPOSITORY / "ContactMultiBody" / "Resources" / "Library" / "linux64" / "libContactMultiBody.a").is_file(),
    reason="the contact engine is not installed; run scripts/setup",
)


def snippets() -> list[str]:
    """The blocks of code of the page, in order."""
    page = (REPOSITORY / "ContactMultiBody" / "UsersGuide" / "GettingStarted.mo").read_text("utf-8")
    blocks = re.findall(r"<blockquote><pre>\n(.*?)</pre></blockquote>", page, re.DOTALL)
    return [html.unescape(block.replace('\\"', '"')) for block in blocks]


def finished_model() -> str:
    """The model that the five steps make: each block goes where its step says."""
    world, body, shape, floor, manager, _commands = snippets()
    head, end = world.rstrip().rsplit("\n", 1)
    assert end == "end Bounce;"
    body = body.rstrip()
    assert body.endswith(");")
    return "\n".join([head, f"{body[:-2]},\n{shape.rstrip()});", floor, manager, end, ""])


def test_five_steps_make_a_ball_that_bounces_and_rests(tmp_path: Path, fmu_cache: Path) -> None:
    source = tmp_path / "Bounce.mo"
    source.write_text(finished_model(), encoding="utf-8")
    options = BuildOptions(msl=REPOSITORY / "Resources" / "MultiBodyCore", cache=fmu_cache)
    report = build_fmu("Bounce", [source, REPOSITORY / "ContactMultiBody"], tmp_path / "Bounce.fmu", options)
    result = simulate_fmu(
        str(report.fmu),
        stop_time=3.0,
        output_interval=5e-4,
        relative_tolerance=1e-6,
        fmi_type="CoSimulation",
        output=["ball.r_0[3]", "contacts.normalForce[1]", "contacts.impactSpeed[1]"],
    )
    height = result["ball.r_0[3]"] - 0.1
    inner = height[1:-1]
    apexes = inner[(inner > height[:-2]) & (inner >= height[2:]) & (inner > 0.01)]
    # Each time 0.49 of its height; slow bounces lose more, as the guide says.
    assert apexes[:3] == pytest.approx(0.9 * 0.49 ** np.arange(1, 4), rel=0.02)
    assert height[-1] == pytest.approx(-G / 1e6, rel=1e-3)
    assert result["contacts.normalForce[1]"][-1] == pytest.approx(G, rel=1e-4)
    assert result["contacts.impactSpeed[1]"].max() == pytest.approx((2 * G * 0.9) ** 0.5, rel=1e-3)


def test_the_commands_are_the_programs() -> None:
    commands = snippets()[-1].split("\n")
    assert [line.split()[:2] for line in commands if line] == [["cmb", "fmu"], ["cmb", "simulate"], ["cmb", "report"]]
