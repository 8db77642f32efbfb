"""What came out of regression cases: a table for the terminal, JUnit XML, an HTML page with plots."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from contact_foundation.output import whole_file
from lxml import etree

from fmu_regression.cases.runner import CaseResult, RunResult, Verdict
from fmu_regression.compare.checks import Outcome, SignalCheck
from fmu_regression.report.page import Cell, Column, Row, Section, Table, Tile, render_page
from fmu_regression.report.plots import Plot, Series
from fmu_regression.results.result import SimulationResult

_PLOTS_PER_CASE = 4
# All that is no Char of XML 1.0, section 2.2.
_NO_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_MODE_NAMES = {"me": "model exchange", "cs": "co-simulation"}


def text_table(results: Sequence[CaseResult]) -> str:
    """A line a run and a line for every check that failed; no trailing newline."""
    width = max((len(result.name) for result in results), default=4)
    lines = []
    for result in results:
        if result.error or result.skipped:
            lines.append(f"{result.name:<{width}}  --  {result.verdict.value:<7}  {result.error or result.skipped}")
        for run in result.runs:
            lines.append(f"{result.name:<{width}}  {run.mode}  {run.verdict.value:<7}  {_run_text(run)}")
            lines += [f"    {o.check.subject}: {o.message}{_limit(o)}" for o in run.outcomes if not o.passed]
    count = Counter(result.verdict for result in results)
    lines.append(", ".join(f"{count[verdict]} {verdict.value}" for verdict in Verdict if count[verdict]) or "no cases")
    return "\n".join(lines)


def write_junit(results: Sequence[CaseResult], target: Path) -> None:
    """Writes JUnit XML: a testsuite a case, a testcase a check; without times, so that equal runs give equal files."""
    suites = etree.Element("testsuites", name="regression")
    for result in results:
        suite = etree.SubElement(suites, "testsuite", name=_xml_text(result.name))
        if result.error or result.skipped:
            entry = etree.SubElement(suite, "testcase", classname=_xml_text(result.name), name="case")
            kind = "error" if result.error else "skipped"
            etree.SubElement(entry, kind, message=_xml_text(result.error or result.skipped))
        for run in result.runs:
            if run.error:
                entry = etree.SubElement(
                    suite, "testcase", classname=_xml_text(result.name), name=f"{run.mode}: simulation"
                )
                etree.SubElement(entry, "error", message=_xml_text(run.error))
            for outcome in run.outcomes:
                name = _xml_text(f"{run.mode}: {outcome.check.subject}")
                entry = etree.SubElement(suite, "testcase", classname=_xml_text(result.name), name=name)
                if not outcome.passed:
                    etree.SubElement(entry, "failure", message=_xml_text(outcome.message + _limit(outcome)))
        for key, tag in (("tests", "testcase"), ("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
            suite.set(key, str(sum(1 for _ in suite.iter(tag))))
    text = etree.tostring(suites, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    with whole_file(target) as staging:
        staging.write_bytes(text)


def write_summary(results: Sequence[CaseResult], target: Path) -> None:
    """Writes an HTML page: the verdicts, every check with its figures, and plots against the references."""
    sections = [_overview(results), *(_case_section(k, result) for k, result in enumerate(results))]
    failed = sum(1 for result in results if result.verdict in (Verdict.FAILED, Verdict.ERROR))
    count = len(results)
    subtitle = f"{count} case{'s' if count != 1 else ''}, {failed or 'none'} failed"
    with whole_file(target) as staging:
        staging.write_text(render_page("Regression", subtitle, sections), encoding="utf-8", newline="\n")


def _overview(results: Sequence[CaseResult]) -> Section:
    count = Counter(result.verdict for result in results)
    checks = [outcome for result in results for run in result.runs for outcome in run.outcomes]
    held = sum(outcome.passed for outcome in checks)
    tiles = [
        Tile("Passed", str(count[Verdict.PASSED]), "", f"of {len(results)} cases", "good"),
        Tile("Failed", str(count[Verdict.FAILED]), "", "a check does not hold", "bad" * (count[Verdict.FAILED] > 0)),
        Tile("Errors", str(count[Verdict.ERROR]), "", "no result to check", "bad" * (count[Verdict.ERROR] > 0)),
        Tile("Skipped", str(count[Verdict.SKIPPED]), "", "not run here"),
        Tile("Checks", str(len(checks)), "", f"{held} hold"),
    ]
    rows = []
    for result in results:
        about = result.case.description if result.case is not None else ""
        if not result.runs:
            text = result.error or result.skipped
            rows.append(
                Row((Cell(result.name, "text"), Cell("–", "text"), _verdict(result.verdict), Cell(text, "text")))
            )
        for run in result.runs:
            cells = (
                Cell(result.name, "text"),
                Cell(_MODE_NAMES[run.mode], "text"),
                _verdict(run.verdict),
                Cell(run.error.splitlines()[0] if run.error else f"{_run_text(run)} {about}".strip(), "text"),
            )
            rows.append(Row(cells))
    columns = tuple(Column(title, "text") for title in ("Case", "Mode", "Verdict", ""))
    return Section("summary", "Summary", tiles=tuple(tiles), tables=(Table(columns, tuple(rows)),))


def _case_section(number: int, result: CaseResult) -> Section:
    columns = (
        Column("Mode", "text"),
        Column("Check", "text"),
        Column("Verdict", "text"),
        Column("Measured"),
        Column("Allowed"),
        Column("", "text"),
    )
    rows = tuple(
        Row(
            (
                Cell(run.mode, "text"),
                Cell(outcome.check.subject, "text"),
                _verdict(Verdict.PASSED if outcome.passed else Verdict.FAILED),
                Cell(_figure(outcome.measured)),
                Cell(_figure(outcome.allowed)),
                Cell(outcome.message, "text"),
            )
        )
        for run in result.runs
        for outcome in run.outcomes
    )
    notes = [note for note in (result.error, result.skipped) if note]
    notes += [f"{_MODE_NAMES[run.mode]}: {run.error}" for run in result.runs if run.error]
    return Section(
        f"case-{number + 1}",
        result.name,
        lead=result.case.description if result.case is not None else "",
        plots=tuple(_plots(number, result)),
        tables=(Table(columns, rows),) if rows else (),
        notes=tuple(notes),
    )


def _plots(number: int, result: CaseResult) -> list[Plot]:
    """The signals that come nearest to their limits, or lie beyond, with the reference."""
    ranked: dict[str, float] = {}
    for run in result.runs:
        for outcome in run.outcomes:
            for name in outcome.check.signals:
                ranked[name] = max(ranked.get(name, 0.0), _strain(outcome))
    worst = sorted(ranked, key=lambda name: -ranked[name])[:_PLOTS_PER_CASE]
    plots = []
    for k, name in enumerate(worst):
        series = [
            Series(_MODE_NAMES[run.mode], run.result.time, run.result[name])
            for run in result.runs
            if run.result is not None and name in run.result
        ]
        series += _reference_series(result.reference, name)
        label = next((run.result.axis_label(name) for run in result.runs if run.result is not None), "value")
        plots.append(Plot(f"plot-{number + 1}-{k + 1}", name, "time in s", label, tuple(series)))
    return plots


def _reference_series(reference: SimulationResult | None, name: str) -> list[Series]:
    if reference is None or name not in reference:
        return []
    return [Series("reference", reference.time, reference[name], dashed=True, color=7)]


def _strain(outcome: Outcome) -> float:
    """How near a check came to its limit; above 1 it failed."""
    base = 0.0 if outcome.passed else 1.0
    if outcome.measured is None or not outcome.allowed or not isinstance(outcome.check, SignalCheck):
        return base
    return outcome.measured / outcome.allowed


def _run_text(run: RunResult) -> str:
    if run.error:
        return run.error
    held = sum(outcome.passed for outcome in run.outcomes)
    text = f"{held} of {len(run.outcomes)} checks hold"
    if run.result is not None and run.result.counters is not None:
        text += f", {run.result.counters.steps} steps"
    return text + "."


def _limit(outcome: Outcome) -> str:
    return "" if outcome.allowed is None else f" (allowed {outcome.allowed:.3g})"


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.3g}"


def _verdict(verdict: Verdict) -> Cell:
    mark = {Verdict.PASSED: "text good", Verdict.FAILED: "text bad", Verdict.ERROR: "text bad"}
    return Cell(verdict.value, mark.get(verdict, "text"))


def _xml_text(text: str) -> str:
    """Text without the characters that XML cannot hold; an FMU's log and names of files may have any."""
    return _NO_XML.sub("?", text)
