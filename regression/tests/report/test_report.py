"""The report: one file, well formed, deterministic, showing what the CSV holds."""

from __future__ import annotations

import base64
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmu_regression.report.animation import frame_rows, make_animation, quaternions
from fmu_regression.report.page import Section, render_page
from fmu_regression.report.simulation_report import write_report
from fmu_regression.results.result import SimulationResult, read_csv
from fmu_regression.results.thinning import display_rows
from fmu_regression.scene.scene_file import load_scene
from headless_browser import needs_bundle
from lxml import html
from scene_viewer.bundle import MISSING, REMEDY
from scipy.spatial.transform import Rotation
from synthetic import body, bouncing_ball, box_mesh, hammer, pose_signals, scene, sphere_mesh, write_scene

pytestmark = needs_bundle


def page_data(page: Path) -> dict[str, Any]:
    tree = html.parse(str(page))
    return dict(json.loads(tree.xpath("//script[@id='data']")[0].text))


class Nesting(HTMLParser):
    """Finds elements that are not closed, or closed in the wrong order."""

    VOID = ("meta", "link", "input", "br", "img")

    def unclosed(self, text: str) -> list[str]:
        self.open: list[str] = []
        self.problems: list[str] = []
        self.feed(text)
        self.close()
        return self.problems + self.open

    def handle_starttag(self, tag: str, attrs: object) -> None:  # noqa: ARG002
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.problems.append(f"{tag} at {self.getpos()}")


def decode(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), dtype=kind)


def test_is_well_formed_and_needs_nothing_else(folder: Path) -> None:
    text = (folder / "report.html").read_text()
    assert Nesting().unclosed(text) == []
    root = html.fromstring(text)
    for element in root.iter():
        for key in ("src", "href", "action", "data", "poster", "srcset"):
            assert not re.match(r"(?i)(https?:|//|file:)", element.get(key, ""))
    addresses = set(re.findall(r"https?://[^\s\"'`)]+", text))
    assert addresses <= {"http://www.w3.org/1999/xhtml"}  # the name of HTML's elements, never fetched
    assert "@import" not in text
    assert "url(http" not in text
    identities = [element.get("id") for element in root.iter() if element.get("id")]
    assert len(identities) == len(set(identities))


def test_has_its_sections_and_an_element_for_each_plot(folder: Path) -> None:
    root = html.parse(str(folder / "report.html")).getroot()
    assert [section.get("id") for section in root.xpath("//section")] == [
        "summary",
        "animation",
        "impacts",
        "contacts",
        "joints",
        "energy",
    ]
    for plot in page_data(folder / "report.html")["plots"]:
        assert root.get_element_by_id(plot["id"]) is not None
        assert plot["xLabel"] == "time in s"
        assert " in " in plot["yLabel"]


def test_repeats_to_the_byte(folder: Path, tmp_path: Path) -> None:
    write_report(read_csv(folder / "result.csv"), folder / "scene.json", tmp_path / "again.html")
    assert (tmp_path / "again.html").read_bytes() == (folder / "report.html").read_bytes()


def test_frames_of_the_animation_are_rows_of_the_csv(folder: Path) -> None:
    result = read_csv(folder / "result.csv")
    animation = page_data(folder / "report.html")["animation"]
    time = decode(animation["time"], "<f8")
    rows = np.array([np.flatnonzero(result.time == t)[-1] for t in time])
    assert time.size == np.unique(result.time).size
    for entry in animation["bodies"]:
        track = decode(entry["track"], "<f4").reshape(-1, 7)
        if entry["label"] in ("anvil", "stand"):
            assert track.shape == (1, 7)
            continue
        position = result.vector([f"{entry['label']}.frame_a.r_0[{i}]" for i in (1, 2, 3)])[rows]
        assert track[:, :3] == pytest.approx(position, abs=1e-6)
        names = [f"{entry['label']}.frame_a.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3)]
        world_to_body = result.vector(names)[rows].reshape(-1, 3, 3)
        body_to_world = Rotation.from_quat(track[:, 3:]).as_matrix()
        assert np.swapaxes(body_to_world, 1, 2) == pytest.approx(world_to_body, abs=1e-6)


def test_plots_hold_the_values_of_the_csv(folder: Path) -> None:
    result = read_csv(folder / "result.csv")
    plots = {plot["id"]: plot for plot in page_data(folder / "report.html")["plots"]}
    force = plots["contact-normalForce"]
    series = force["series"][0]
    assert decode(force["times"][series["time"]], "<f8") == pytest.approx(result.time)
    assert decode(series["values"], "<f4") == pytest.approx(result["contacts.normalForce[1]"], rel=1e-6)


def test_arrow_stands_where_hammer_and_anvil_meet(folder: Path) -> None:
    animation = page_data(folder / "report.html")["animation"]
    (force,) = animation["forces"]
    track = decode(force["track"], "<f4").reshape(-1, 6)
    # The first blow only: this pendulum knows nothing of the sides of its anvil and swings through them later.
    first = decode(animation["time"], "<f8") < 0.3
    pushes = track[first & (np.abs(track[:, 3:]).max(axis=1) > 0)]
    assert pushes.shape[0] >= 3
    assert np.abs(pushes[:, 2]).max() < 3e-3  # the anvil's top is z = 0
    assert ((pushes[:, 0] > 0.44) & (pushes[:, 0] < 0.66)).all()


@pytest.mark.parametrize(("way", "follows"), [(0.05, False), (10.0, True)])
def test_what_goes_far_is_followed_instead_of_seen_from_afar(tmp_path: Path, way: float, follows: bool) -> None:
    time = np.linspace(0, 1, 11)
    position = np.stack([way * time, np.zeros(11), 3 * time * (1 - time)], axis=1)
    signals = pose_signals("cart", position, np.broadcast_to(np.eye(3), (11, 3, 3)))
    cart = body("cart", mass=1.0, meshes=[box_mesh("c", (0.2, 0.2, 0.2), (0, 0, 0), [0.5, 0.5, 0.5])])
    path = write_scene(scene("Cart", [cart]), tmp_path / "scene.json")
    write_report(SimulationResult(time=time, signals=signals), path, tmp_path / "report.html")
    animation = page_data(tmp_path / "report.html")["animation"]
    assert animation["follow"] is follows
    assert animation["radius"] < 1.0  # the height of 0.75 m is in view, the way of 10 m is not
    assert animation["radius"] > 0.4
    assert animation["floor"] == pytest.approx(-0.1)
    travel = decode(animation["travel"], "<f4").reshape(-1, 3)
    assert travel[:, 0] == pytest.approx(way * time, abs=1e-6)
    assert travel[:, 2] == pytest.approx(0)


def test_a_page_cannot_be_broken_out_of(tmp_path: Path) -> None:
    content, result = hammer(rows=20)
    evil = "</script><script>alert(1)</script><b>&\u2028"
    content["name"] = evil
    content["bodies"][1]["label"] = evil
    write_report(result, write_scene(content, tmp_path / "scene.json"), tmp_path / "report.html")
    root = html.parse(str(tmp_path / "report.html")).getroot()
    assert len(root.xpath("//script")) == 2
    assert root.xpath("//h1")[0].text == evil
    assert any(body["label"] == evil for body in page_data(tmp_path / "report.html")["animation"]["bodies"])


def test_without_scene_all_signals_are_plotted(tmp_path: Path) -> None:
    _, result, _ = bouncing_ball(0.5)
    write_report(result, None, tmp_path / "report.html")
    names = {s["name"] for plot in page_data(tmp_path / "report.html")["plots"] for s in plot["series"]}
    assert names == set(result.signals)


def test_spikes_survive_thinning() -> None:
    rng = np.random.default_rng(1)
    values = rng.normal(size=100_000)
    values[[137, 50_001, 99_998]] = [1e3, -1e3, 2e3]
    values[777] = np.nan
    rows = display_rows(values, 2000)
    assert rows.size <= 2000
    assert (np.diff(rows) > 0).all()
    assert {0, 137, 50_001, 99_998, 99_999} <= set(rows.tolist())
    assert display_rows(values[:1500], 2000).tolist() == list(range(1500))
    assert display_rows(np.full(9000, np.nan), 2000).size <= 2000


def test_long_results_keep_the_peak_of_the_force_in_plot_and_animation(tmp_path: Path) -> None:
    content, short, _ = bouncing_ball(0.5)
    fine = np.unique(np.concatenate([np.linspace(0, short.time[-1], 60_000), short.time]))
    signals = {name: np.interp(fine, short.time, values) for name, values in short.signals.items()}
    result = SimulationResult(time=fine, signals=signals)
    write_report(result, write_scene(content, tmp_path / "scene.json"), tmp_path / "report.html")
    data = page_data(tmp_path / "report.html")
    force = next(plot for plot in data["plots"] if plot["id"] == "contact-normalForce")
    peak = result["contacts.normalForce[1]"].max()
    values = decode(force["series"][0]["values"], "<f4")
    assert values.size < fine.size / 2
    assert values.max() == pytest.approx(peak)
    assert data["animation"]["largestForce"] == pytest.approx(peak)
    rows = frame_rows(load_scene(tmp_path / "scene.json"), result)
    assert rows.size <= 3000
    assert int(np.argmax(result["contacts.normalForce[1]"])) in rows
    assert rows[0] == 0
    assert rows[-1] == fine.size - 1
    assert (tmp_path / "report.html").stat().st_size < 8_000_000


def test_quaternions_of_all_orientations() -> None:
    turns = Rotation.random(2000, random_state=3)
    special = Rotation.from_rotvec(np.pi * np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0], [0.6, 0.8, 0]]))
    matrices = np.concatenate([turns.as_matrix(), special.as_matrix()])
    found = quaternions(np.swapaxes(matrices, 1, 2))
    assert Rotation.from_quat(found).as_matrix() == pytest.approx(matrices, abs=1e-12)
    assert (np.einsum("ni,ni->n", found[1:], found[:-1]) >= 0).all()


def test_without_the_viewers_scripts_the_page_has_its_tables_and_says_so(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scene_viewer.bundle._file", lambda name: tmp_path / "gone" / name)
    write_report(read_csv(folder / "result.csv"), folder / "scene.json", tmp_path / "report.html")
    text = (tmp_path / "report.html").read_text()
    assert Nesting().unclosed(text) == []
    root = html.fromstring(text)
    assert [note.text for note in root.xpath("//p[@class='missing']")] == [f"{MISSING} {REMEDY}"]
    assert not root.xpath("//script | //canvas")
    whole = html.parse(str(folder / "report.html")).getroot()
    assert root.xpath("//td/text()") == whole.xpath("//td/text()")
    assert root.xpath("//h2/text()") == whole.xpath("//h2/text()")


def test_a_page_that_draws_nothing_needs_no_scripts() -> None:
    text = render_page("Title", "", [Section("notes", "Notes", notes=("One.",))])
    assert "<script" not in text
    assert 'class="missing"' not in text


def test_licences_of_what_is_bundled_travel_along(folder: Path) -> None:
    text = (folder / "report.html").read_text()
    for holder in ("three.js authors", "Leon Sorokin"):
        assert holder in text
    assert text.count("The above copyright notice and this permission notice shall be included") == 2


def test_equal_parts_share_an_entry_of_the_key(tmp_path: Path) -> None:
    ball = sphere_mesh("b", 0.1, [0.1, 0.1, 0.1])
    labels = ("left/foot", "right/foot", "left/shank", "torso")
    bodies = [body(f"b{k}", label=label, fixed=True, meshes=[ball]) for k, label in enumerate(labels)]
    bodies.append(body("b9", label="odd/foot", fixed=True, meshes=[sphere_mesh("b", 0.1, [0.9, 0.1, 0.1])]))
    made = load_scene(write_scene(scene("Parts", bodies), tmp_path / "scene.json"))
    animation = make_animation(made, SimulationResult(time=np.array([0.0, 1.0]), signals={}))
    assert animation is not None
    assert [entry.label for entry in animation.key] == ["foot (2)", "left/shank", "torso", "odd/foot"]
