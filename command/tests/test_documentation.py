"""Links between the project's pages lead somewhere, and tables that commands keep are theirs."""

from __future__ import annotations

import re
import runpy
import subprocess
from pathlib import Path

import pytest
from contact_data import checkout

PROJECT = checkout()
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)


def _tracked(pattern: str) -> list[Path]:
    listed = subprocess.run(
        ["git", "ls-files", pattern], cwd=PROJECT, capture_output=True, text=True, check=True
    ).stdout
    return [PROJECT / name for name in listed.splitlines() if (PROJECT / name).is_file()]


def _anchors(page: Path) -> set[str]:
    """As GitHub and most renderers make them of headings."""
    headings = HEADING.findall(page.read_text(encoding="utf-8"))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def _broken(page: Path, link: str) -> bool:
    path, _, anchor = link.partition("#")
    if ":" in path:
        return False
    target = (page.parent / path).resolve() if path else page
    return not target.exists() or bool(anchor and target.suffix == ".md" and anchor not in _anchors(target))


def test_links_between_pages_lead_somewhere() -> None:
    pages = _tracked("*.md")
    links = [(page, link) for page in pages for link in LINK.findall(page.read_text(encoding="utf-8"))]
    assert len(links) > 100
    assert [f"{page.relative_to(PROJECT)}: {link}" for page, link in links if _broken(page, link)] == []


@pytest.mark.parametrize("suffix", ["py", "hpp", "cpp", "md"])
def test_pages_that_sources_name_exist(suffix: str) -> None:
    # The change log names pages as they were.
    sources = [source for source in _tracked(f"*.{suffix}") if source.name != "CHANGELOG.md"]
    named = {
        name for source in sources for name in re.findall(r"\bdocs/[\w/-]+\.md", source.read_text(encoding="utf-8"))
    }
    assert named, "the sources name no page at all"
    assert sorted(name for name in named if not (PROJECT / name).is_file()) == []


def test_sections_that_folders_and_sources_name_exist() -> None:
    section = re.compile(r'(docs/[\w/-]+\.md)(?:\]\([^)]*\))?, "([^"\n]+)"')
    sources = [source for suffix in ("hpp", "cpp", "py", "md") for source in _tracked(f"*.{suffix}")]
    named = {pair for source in sources for pair in section.findall(source.read_text(encoding="utf-8"))}
    assert len(named) > 20
    headings = {page: HEADING.findall((PROJECT / page).read_text(encoding="utf-8")) for page, _ in named}
    missing = {pair for pair in named if not any(heading.startswith(pair[1]) for heading in headings[pair[0]])}
    assert missing == set()


def test_the_summary_of_pairs_is_that_of_their_table() -> None:
    script = runpy.run_path(str(PROJECT / "external-c" / "bench" / "pairs_table.py"))
    page = script["PAGE"].read_text(encoding="utf-8")
    assert script["with_summary"](page, script["summary"](script["read_table"](script["TABLE"]))) == page


def test_rows_of_pairs_are_read_as_bench_pairs_prints_them() -> None:
    script = runpy.run_path(str(PROJECT / "external-c" / "bench" / "pairs_table.py"))
    printed = [
        "| pair | 1 mm | 10 cm | 30 cm | apart | distance | coherent |\n",
        "|---|---|---|---|---|---|---|\n",
        "| box, hull-20 | 0.80 (1.47) | (1.27e+03) | | 0.07 (0.08) | 1.13 (1.11) | 0.62 (1.55) |\n",
        "\n",
        "| box, hull-20, apart | 1.13 | 1.11 | 0.98 |\n",
    ]
    (row,) = script["timed_rows"](printed)
    assert [row[name] for name in script["HEADER"]] == [
        *("box", "hull-20", "0.80", "1.47", "", "1.27e+03", "", "", "0.07", "0.08", "1.13", "1.11", "0.62", "1.55"),
    ]
    with pytest.raises(ValueError, match="no ratio"):
        script["timed_rows"](["| box, box | fast | | | | | |"])
