"""The whole pipeline, run once for all tests that look at what came out of it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from cmb.fmu_provider import FmuProvider
from cmb.main import main
from contact_data import modelica_library
from contact_foundation.progress import silent
from fmu_regression.cases.case import load_case
from fmu_regression.cases.runner import Skip, Verdict, run_case
from fmu_regression.report.case_summary import text_table
from modelica2fmu.build import BuildOptions
from program import HAMMER, HANGS, CaseCheck, Cmb


@pytest.fixture(scope="session")
def cmb() -> Cmb:
    """Runs the program as a user does; the words after ``cmb`` in, status and output out."""

    def call(*words: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
        environment = dict(os.environ)
        environment.pop("MODELICAPATH", None)
        return subprocess.run(
            [sys.executable, "-m", "cmb.main", *map(str, words)],
            cwd=cwd,
            env=environment,
            capture_output=True,
            text=True,
            timeout=300,
        )

    return call


@pytest.fixture
def cmb_here(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Cmb:
    """The same in the tests' own process, which spares the program's start; what it does not catch fails the test."""

    def call(*words: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
        capfd.readouterr()
        with monkeypatch.context() as there:
            there.delenv("MODELICAPATH", raising=False)
            there.chdir(cwd or Path.cwd())
            try:
                status: object = main([str(word) for word in words])
            except SystemExit as end:  # by which argparse ends
                status = end.code
        assert isinstance(status, int)
        return subprocess.CompletedProcess([str(word) for word in words], status, *capfd.readouterr())

    return call


@pytest.fixture(scope="session")
def engine() -> None:
    """Skips where the contact engine is not installed into the library."""
    if not any((modelica_library() / "Resources" / "Library").glob("*/libContactMultiBody.a")):
        pytest.skip("the contact engine is not built; run scripts/setup")


@pytest.fixture(scope="session")
def hammer(cmb: Cmb, engine: None, tmp_path_factory: pytest.TempPathFactory) -> Path:  # noqa: ARG001
    """The output folder of ``cmb run`` on the hammer."""
    output = tmp_path_factory.mktemp("pipeline") / "hammer"
    done = cmb("run", HAMMER, "--output", output)
    assert done.returncode == 0, done.stderr
    (output / "summary.txt").write_text(done.stdout)
    return output


@pytest.fixture(scope="session")
def provide_fmu(engine: None, fmu_cache: Path, tmp_path_factory: pytest.TempPathFactory) -> FmuProvider:  # noqa: ARG001
    """Builds the FMU of a regression case's model, each model once."""
    return FmuProvider(tmp_path_factory.mktemp("fmus"), BuildOptions(cache=fmu_cache), silent)


@pytest.fixture
def check_case(provide_fmu: FmuProvider) -> CaseCheck:
    """Runs a regression case in its modes and fails with its table unless every check holds."""

    def check(path: Path) -> None:
        case = load_case(path)
        fmu = provide_fmu(case)
        if isinstance(fmu, Skip):
            pytest.skip(fmu.reason)
        result = run_case(case, fmu, time_limit=HANGS)
        assert result.verdict is Verdict.PASSED, text_table([result])

    return check
