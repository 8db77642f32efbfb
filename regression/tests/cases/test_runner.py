"""Running cases on an FMU with known motion: what holds passes, what does not is told."""

from __future__ import annotations

import math
import os
import signal
from dataclasses import dataclass
from pathlib import Path

import pytest
from contact_foundation.errors import BuildError
from fmu_regression.cases.case import Case
from fmu_regression.cases.runner import CaseResult, Skip, Verdict, run_case, run_cases
from fmu_regression.report.case_summary import text_table, write_junit, write_summary
from fmu_regression.results.result import write_csv
from fmu_regression.simulate.simulation import simulate
from lxml import etree

FIRST = math.sqrt(0.2)

HEAD = """
[case]
model = "BouncingMass"
package = "BouncingMass.mo"
stop = 1.1
tolerance = 1e-9
interval = 0.01
mode = "{mode}"
{more}
"""
BOUNCES = """
[[event]]
name = "bounces"
times = [{times}]
tolerance = 1e-6
"""


@pytest.fixture
def cases(tmp_path: Path, bouncing_mass: Path) -> Path:
    """Four cases: one right, one with wrong expectations, one that cannot simulate, one that is skipped."""
    folder = tmp_path / "cases"
    folder.mkdir()
    reference = simulate(bouncing_mass, signals=["h", "v"], stop=1.1, tolerance=1e-11, interval=0.01)
    write_csv(reference, folder / "mass.csv")
    more = 'reference = "mass.csv"\ndescription = "A <mass> & more"'
    signal = '[[signal]]\nname = "h"\ntolerance = 1e-6\n'
    times = f"{FIRST}, {2 * FIRST}"
    (folder / "right.toml").write_text(HEAD.format(mode="me", more=more) + signal + BOUNCES.format(times=times))
    (folder / "wrong.toml").write_text(
        HEAD.format(mode="both", more=more + "\nparameters = { e = 0.49 }") + signal + BOUNCES.format(times=times)
    )
    (folder / "breaks.toml").write_text(
        HEAD.format(mode="cs", more="parameters = { fails_at = 0.5 }") + BOUNCES.format(times=times)
    )
    (folder / "needs.toml").write_text(HEAD.format(mode="cs", more='requires = ["msl"]') + BOUNCES.format(times=times))
    (folder / "typo.toml").write_text("[case]\nstopp = 1\n")
    (folder / "unbuilt.toml").write_text(
        HEAD.format(mode="cs", more="").replace("BouncingMass", "Other") + BOUNCES.format(times=times)
    )
    return folder


def test_verdicts_and_summaries(cases: Path, tmp_path: Path, bouncing_mass: Path) -> None:
    def provide(case: Case) -> Path | Skip:
        if case.requires:
            return Skip("the Modelica Standard Library is not here")
        if case.model == "Other":
            raise BuildError("no compiler")
        return bouncing_mass

    results = run_cases(cases, provide)
    verdicts = {result.name: result.verdict for result in results}
    assert verdicts == {
        "breaks": Verdict.ERROR,
        "needs": Verdict.SKIPPED,
        "right": Verdict.PASSED,
        "typo": Verdict.ERROR,
        "unbuilt": Verdict.ERROR,
        "wrong": Verdict.FAILED,
    }
    wrong = results[-1]
    assert [run.mode for run in wrong.runs] == ["me", "cs"]
    assert not any(outcome.passed for run in wrong.runs for outcome in run.outcomes)

    table = text_table(results)
    assert "1 passed, 1 failed, 3 error, 1 skipped" in table
    assert "cannot be computed" in table

    write_junit(results, tmp_path / "junit.xml")
    tree = etree.parse(str(tmp_path / "junit.xml"))
    assert len(tree.findall(".//failure")) == 4
    assert len(tree.findall(".//error")) == 3
    assert len(tree.findall(".//skipped")) == 1
    assert [suite.get("failures") for suite in tree.findall("testsuite[@name='right']")] == ["0"]

    write_summary(results, tmp_path / "summary.html")
    text = (tmp_path / "summary.html").read_text()
    assert "A &lt;mass&gt; &amp; more" in text
    write_summary(results, tmp_path / "again.html")
    assert (tmp_path / "again.html").read_text() == text


@dataclass(frozen=True)
class Provider:
    """Gives an FMU; the process of a case whose name is ``deadly`` is killed, the first time only or each time."""

    fmu: Path
    deadly: str = ""
    marks: Path | None = None

    def __call__(self, case: Case) -> Path | Skip:
        if case.name == self.deadly:
            mark = self.marks / "killed" if self.marks else None
            if mark is None or not mark.exists():
                if mark is not None:
                    mark.touch()
                os.kill(os.getpid(), signal.SIGKILL)
        return Skip("not here") if case.requires else self.fmu


@pytest.mark.full
def test_processes_give_the_same_results_in_the_same_order(cases: Path, tmp_path: Path, bouncing_mass: Path) -> None:
    heard: list[str] = []
    alone = run_cases(cases, Provider(bouncing_mass))
    together = run_cases(
        cases,
        Provider(bouncing_mass, "right", tmp_path),
        jobs=2,
        progress=lambda _phase, _fraction, message="": heard.append(message),
    )
    assert (tmp_path / "killed").exists()
    assert [text_table([result]) for result in together] == [text_table([result]) for result in alone]
    assert heard[-1].startswith("6 of 6, 0 s left")
    lost = next(r for r in run_cases(cases, Provider(bouncing_mass, "right"), jobs=2) if "right" in r.name)
    assert lost.verdict is Verdict.ERROR
    assert "ended again and again: signal SIGKILL" in lost.error


def test_names_that_are_no_text_and_messages_with_any_character(tmp_path: Path) -> None:
    name = os.fsdecode(b"K\xe4se")  # Latin-1 in a file name
    results = [CaseResult(name, None, error="\x1b[31m \uffff \ud800 <&> \U0001f528")]
    write_junit(results, tmp_path / "junit.xml")
    suite = etree.parse(str(tmp_path / "junit.xml")).find("testsuite")
    assert suite is not None
    assert suite.get("name") == "K?se"
    assert suite.find("testcase/error").get("message") == "?[31m ? ? <&> \U0001f528"
    write_summary(results, tmp_path / "summary.html")
    assert "K?se" in (tmp_path / "summary.html").read_text(encoding="utf-8")


def test_co_simulation_counts_the_same_bounces(cases: Path, bouncing_mass: Path) -> None:
    from fmu_regression.cases.case import load_case

    text = (cases / "right.toml").read_text().replace('mode = "me"', 'mode = "cs"').replace("1e-6", "6e-3")
    (cases / "right.toml").write_text(text)
    result = run_case(load_case(cases / "right.toml"), bouncing_mass)
    # The step of co-simulation shows an event only between its ends, hence half a step of tolerance.
    assert result.verdict is Verdict.PASSED, text_table([result])


def test_missing_reference_is_an_error(cases: Path, bouncing_mass: Path) -> None:
    from fmu_regression.cases.case import load_case

    (cases / "mass.csv").unlink()
    result = run_case(load_case(cases / "right.toml"), bouncing_mass)
    assert result.verdict is Verdict.ERROR
    assert "mass.csv" in result.error
