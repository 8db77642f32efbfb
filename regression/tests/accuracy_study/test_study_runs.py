"""A study of an FMU whose motion is known: errors told apart, the same with any number of processes, resumed."""

from __future__ import annotations

import csv
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from xml.etree import ElementTree

import pytest
from accuracy_study.definition import load_study
from accuracy_study.markdown import index_page, scene_page
from accuracy_study.page import write_page
from accuracy_study.picture import write_pictures
from accuracy_study.run import measured_times
from accuracy_study.sentences import study_sentences
from accuracy_study.study import Findings, carry_out_study
from accuracy_study.table import CPU_COLUMNS, write_parquet, write_table
from contact_foundation.errors import InputError

# h(0) = 1 m, g = 10 m/s2, e = 0.5: up again at 2.236 m/s from t = 0.4472 s on.
SPEED = math.sqrt(20)
IMPACT = math.sqrt(0.2)


def height(e: float, t: float) -> float:
    return e * SPEED * (t - IMPACT) - 5 * (t - IMPACT) ** 2


TEXT = f"""\
[study]
repeats = 1
time_limit = 20
[knobs]
tolerance = [1e-2, 1e-4, 1e-6]
solver = ["me", "cs"]
[[scene]]
name = "bounces"
model = "BouncingMass"
stop = 0.8
energy = "h"
knobs = {{ parameter = {{ e = [0.5, 0.6] }} }}
[scene.reference]
source = "free fall"
value = [{{ name = "h", time = 0.6, expected = {height(0.5, 0.6)!r} }}]
[[scene]]
name = "fails"
model = "BouncingMass"
stop = 0.8
knobs = {{ parameter = {{ fails_at = [1e9, 0.3] }} }}
"""


def copied(fmu: Path, _model: str, _sources: Sequence[Path], target: Path) -> None:
    shutil.copyfile(fmu, target)


def carried_out(folder: Path, fmu: Path, text: str = TEXT, jobs: int = 1, scheduler: str = "") -> Findings:
    folder.mkdir(exist_ok=True)
    (folder / "study.toml").write_text(text)
    study = load_study(folder / "study.toml")
    findings = carry_out_study(study, partial(copied, fmu), folder / "out", jobs, scheduler=scheduler)
    write_table(findings, folder / "out" / "table.csv")
    return findings


def table(folder: Path) -> list[dict[str, str]]:
    with (folder / "out" / "table.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    return [{name: value for name, value in row.items() if name not in CPU_COLUMNS} for row in rows]


@pytest.fixture(scope="module")
def clean(bouncing_mass: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Findings]:
    folder = tmp_path_factory.mktemp("clean")
    return folder, carried_out(folder, bouncing_mass)


@pytest.mark.full
def test_errors_are_told_apart(clean):
    folder, findings = clean
    rows = table(folder)
    assert len(rows) == 2 * (2 * 2 * 3)
    wrong_e = abs(height(0.6, 0.6) - height(0.5, 0.6)) / height(0.5, 0.6)
    for row in rows[:12]:
        error, solver, model = (float(row[name]) for name in ("error", "solver_error", "model_error"))
        assert float(row["geometry_error"]) == 0.0
        if row["solver"] == "me":  # this FMU counts nothing itself
            assert int(row["steps"]) > 0
            assert int(row["events"]) >= 1
        if row["parameter.e"] == "0.5":
            assert model < 1e-6
            # v jumps at the impact by 1.5 of the speed: at output times around it a shift in time shows as that much.
            assert error <= 2 * solver + 1e-6
        else:
            assert model == pytest.approx(wrong_e, rel=1e-6)
            assert error == pytest.approx(wrong_e, rel=0.1)
    by_tolerance = [float(row["solver_error"]) for row in rows[:3]]
    assert by_tolerance[2] < 0.1 * by_tolerance[0]
    # The largest rise of h is that after the impact.
    assert float(rows[2]["energy_rise"]) == pytest.approx((0.5 * SPEED) ** 2 / 20, rel=1e-2)
    assert findings.scenes[0].tight == pytest.approx(1e-9)


@pytest.mark.parametrize(
    ("first", "later", "repeats", "kept"),
    [
        (0.2, [0.1, 0.3], 3, [0.2, 0.1, 0.3]),
        (2.0, [], 3, [2.0]),  # takes long
        (0.0, [0.1], 1, [0.1]),  # a virtual machine's clock may stand still
        (None, [0.0, 0.1, 0.2], 2, [0.1, 0.2]),
        (0.0, [0.0, 0.0, 0.0], 1, []),
    ],
)
def test_times_that_the_clock_did_not_see_do_not_count(first, later, repeats, kept):
    runs = iter(later)
    assert measured_times(first, lambda: next(runs), repeats) == kept
    assert next(runs, None) is None


def test_failures_stay_in_the_table_with_their_reason(clean):
    folder, _ = clean
    failed = [row for row in table(folder) if row["parameter.fails_at"] == "0.3"]
    assert len(failed) == 6
    assert all(row["failure"] and not row["error"] for row in failed)


def test_sentences_page_and_pictures(clean):
    folder, findings = clean
    bounces, fails = study_sentences(findings)
    assert bounces.startswith("bounces: An error below ")
    assert " costs " in bounces
    assert "what limits you is the solver" in bounces
    assert "E, model error: 0.5: " in bounces
    assert "0.6: 4.4e-01" in bounces or f"0.6: {abs(height(0.6, 0.6) / height(0.5, 0.6) - 1):.1e}" in bounces
    assert "6 of 12 runs failed" in fails
    write_page(findings, folder / "study.html")
    page = (folder / "study.html").read_text()
    assert "known answers: free fall" in page
    assert "Pareto front" in page
    assert page.count("Order of convergence") == 2
    written = write_pictures(findings, folder / "pictures")
    assert [path.name for path in written] == ["bounces.svg", "fails.svg"]
    text, failing = (scene_page(findings, found, Path("images")) for found in findings.scenes)
    assert "`BouncingMass`, measured against: known answers: free fall." in text
    assert "](images/bounces.svg)" in text
    assert "| e 0.6 | 0.0e+00 | 3.0e-01 | " in text
    assert "12 runs. Machine: " in text
    assert "Times were measured at a load of " in text
    assert "6 of 12 runs failed" in failing
    index = index_page([found.scene for found in findings.scenes], Path("pages"), Path("images"))
    assert "[Fails](pages/fails.md)" in index
    assert "](images/bounces.svg)" in index
    drawing = ElementTree.parse(written[0])
    marks = [e for e in drawing.iter() if e.find("{http://www.w3.org/2000/svg}title") is not None]
    # On virtual machines the clock may miss a run.
    timed = [row for row in findings.scenes[0].rows if row.outcome.cpu_time]
    assert len(marks) == len(timed) >= 6


@pytest.mark.full
def test_any_number_of_processes_gives_the_same(clean, bouncing_mass, tmp_path):
    carried_out(tmp_path, bouncing_mass, jobs=3)
    assert table(tmp_path) == table(clean[0])


def test_parquet_holds_the_same_rows(clean, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    folder, findings = clean
    write_parquet(findings, tmp_path / "table.parquet")
    found = parquet.read_table(tmp_path / "table.parquet").to_pylist()
    rows = table(folder)
    assert len(found) == len(rows)
    for have, row in zip(found, rows, strict=True):
        for name, text in row.items():
            value = have[name]
            assert ("" if value is None else repr(value) if isinstance(value, float) else str(value)) == text
    assert isinstance(found[0]["error"], float)
    assert isinstance(found[0]["steps"], int)


def test_a_cluster_gives_the_same(clean, bouncing_mass, tmp_path):
    distributed = pytest.importorskip("distributed", reason="distributed is not installed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        carried_out(tmp_path, bouncing_mass, scheduler=cluster.scheduler_address)
    assert table(tmp_path) == table(clean[0])


def test_a_second_call_runs_only_what_is_missing(clean, bouncing_mass, tmp_path):
    shutil.copytree(clean[0] / "out", tmp_path / "out")
    files = sorted((tmp_path / "out" / "runs").iterdir())
    files[0].unlink()
    files[1].write_text(files[1].read_text()[:40])
    before = {path: path.stat().st_mtime_ns for path in files[2:]}
    carried_out(tmp_path, bouncing_mass)
    assert {path: path.stat().st_mtime_ns for path in files[2:]} == before
    assert sorted((tmp_path / "out" / "runs").iterdir()) == files
    assert table(tmp_path) == table(clean[0])


@pytest.mark.full
def test_killed_and_called_again(clean, bouncing_mass, tmp_path):
    (tmp_path / "study.toml").write_text(TEXT)
    code = (
        "import sys; from functools import partial; from pathlib import Path\n"
        "from test_study_runs import copied, carried_out\n"
        "if __name__ == '__main__':\n"
        "    carried_out(Path(sys.argv[1]), Path(sys.argv[2]), jobs=2)\n"
    )
    script = tmp_path / "call.py"
    script.write_text(code)
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
    process = subprocess.Popen([sys.executable, script, tmp_path, bouncing_mass], env=environment)
    deadline = time.monotonic() + 60
    runs = tmp_path / "out" / "runs"
    while len(list(runs.glob("*.json"))) < 4 and time.monotonic() < deadline:
        assert process.poll() is None
        time.sleep(0.002)
    process.send_signal(signal.SIGKILL)
    process.wait()
    time.sleep(0.2)  # its workers end with it
    kept = {path: path.stat().st_mtime_ns for path in runs.glob("*.json")}
    assert 4 <= len(kept) < 24
    carried_out(tmp_path, bouncing_mass)
    assert all(path.stat().st_mtime_ns == stamp for path, stamp in kept.items())
    assert table(tmp_path) == table(clean[0])


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("e = [0.5, 0.6]", "mu = [0.5]"), "scene[1].knobs.parameter.mu: 0.5:"),
        (
            ("parameter = { e = [0.5, 0.6] }", 'friction = ["None"]'),
            "scene[1].knobs.friction: 'None': the scene",
        ),
        (('energy = "h"', 'energy = "H"'), "scene[1].energy:"),
        (('energy = "h"', 'signals = ["speed"]'), "scene[1].signals:"),
        (('name = "h", time', 'name = "x", time'), "scene[1].reference:"),
        (('energy = "h"', "parameters = { E = 1 }"), "scene[1].parameters:"),
    ],
)
def test_what_a_scene_does_not_have_is_refused(bouncing_mass, tmp_path, change, said):
    assert change[0] in TEXT
    with pytest.raises(InputError) as caught:
        carried_out(tmp_path, bouncing_mass, TEXT.replace(*change, 1))
    assert f"{tmp_path / 'study.toml'}: {said}" in str(caught.value)
    assert not (tmp_path / "out" / "runs").exists()


def test_a_folder_of_something_else_is_refused(bouncing_mass, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "thesis.tex").write_text("")
    with pytest.raises(InputError, match="no folder of a study"):
        carried_out(tmp_path, bouncing_mass)
