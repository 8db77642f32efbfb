"""Reading a study's design from TOML (docs/teleoperation.md), and refusing one that cannot be studied."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from contact_foundation.errors import InputError, Place, ProblemList
from contact_foundation.toml_text import parse_toml, read_toml

from depth_study.design.factors import Contrast, Design, Factor, Restriction

MAX_CONSTELLATIONS = 100
_KEYS = {"title", "factors", "only", "expected", "contrast"}


def load_design(path: Path) -> Design:
    """The design that a TOML file holds.

    Raises:
        InputError: the file cannot be read or is no TOML; ProblemList with all that is inconsistent in it.
    """
    return _Reader(path).design(read_toml(path, "a TOML file with a design"))


def parse_design(text: str, path: Path) -> Design:
    """The design that the text of a TOML file holds; ``path`` is what errors name.

    Raises:
        InputError: it is no TOML; ProblemList with all that is inconsistent in it.
    """
    return _Reader(path).design(parse_toml(text, path))


class _Reader:
    """Collects the problems of one file."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._problems: list[InputError] = []
        self._factors: tuple[Factor, ...] = ()

    def design(self, data: Mapping[str, Any]) -> Design:
        for key in sorted(set(data) - _KEYS):
            self._problem(key, "is not known", f"Known are {', '.join(sorted(_KEYS))}.")
        title = data.get("title", self._path.stem)
        if not isinstance(title, str):
            self._problem("title", "is no text", "Write it in quotation marks.")
            title = ""
        self._factors = self._read_factors(data.get("factors"))
        self._stop()
        restrictions = tuple(
            r for k, entry in enumerate(self._tables(data, "only")) if (r := self._restriction(k, entry)) is not None
        )
        contrasts = tuple(
            c for k, entry in enumerate(self._tables(data, "contrast")) if (c := self._contrast(k, entry)) is not None
        )
        self._stop()
        design = Design(title, self._factors, restrictions, contrasts)
        self._check_size(design)
        self._check_graph(design)
        self._check_contrasts(design)
        self._check_expected(design, data.get("expected", {}))
        self._stop()
        return design

    def _read_factors(self, data: object) -> tuple[Factor, ...]:
        if not isinstance(data, dict) or not data:
            self._problem("factors", "is missing or empty", 'Give a table such as camera = ["central", "parallel"].')
            return ()
        factors = []
        for name, levels in data.items():
            place = f"factors.{name}"
            if not isinstance(levels, list) or not all(_is_name(level) for level in levels):
                self._problem(place, "is no list of names", 'Levels are texts without "/", commas and line ends.')
            elif len(levels) < 2:
                self._problem(place, "has fewer than two levels", "Leave the factor out, or vary it.")
            elif len(set(levels)) < len(levels):
                twice = next(level for level in levels if levels.count(level) > 1)
                self._problem(place, f'has the level "{twice}" twice', "Remove one of them.")
            else:
                factors.append(Factor(name, tuple(levels)))
        return tuple(factors)

    def _restriction(self, k: int, entry: Mapping[str, Any]) -> Restriction | None:
        place = f"only[{k + 1}]"
        self._known(place, entry, {"when", "allow"})
        when, allow = (
            self._level_table(f"{place}.when", entry.get("when")),
            self._level_table(f"{place}.allow", entry.get("allow")),
        )
        if when is None or allow is None:
            return None
        if any(len(levels) != 1 for levels in when.values()):
            self._problem(f"{place}.when", "has a factor with several levels", "Write one entry for each level.")
            return None
        both = set(when) & set(allow)
        if both:
            self._problem(place, f'restricts "{min(both)}" by itself', "Remove the level from the factor instead.")
            return None
        return Restriction({name: levels[0] for name, levels in when.items()}, allow)

    def _contrast(self, k: int, entry: Mapping[str, Any]) -> Contrast | None:
        name = entry.get("name")
        place = f"contrast[{k + 1}]" if not isinstance(name, str) else f'contrast "{name}"'
        self._known(place, entry, {"name", "factor", "from", "to", "where"})
        factor = entry.get("factor")
        if not isinstance(name, str) or not name:
            self._problem(place, "has no name", 'Give name = "...".')
            return None
        if factor not in {known.name for known in self._factors}:
            self._problem(place, f"names the factor {factor!r}, which is not there", self._known_factors())
            return None
        ends = [self._level_table(f"{place}, {end}", {factor: entry.get(end)}) for end in ("from", "to")]
        where = self._level_table(f"{place}.where", entry.get("where", {}))
        if ends[0] is None or ends[1] is None or where is None:
            return None
        if factor in where:
            self._problem(place, f'restricts its own factor "{factor}"', "Restrict other factors in `where`.")
            return None
        start, end = ends[0][factor], ends[1][factor]
        if set(start) & set(end):
            self._problem(place, f'has "{min(set(start) & set(end))}" in `from` and in `to`', "Remove one of them.")
            return None
        return Contrast(name, factor, start, end, where)

    def _level_table(self, place: str, data: object) -> dict[str, tuple[str, ...]] | None:
        """Levels by factor; a single level may stand without brackets."""
        if not isinstance(data, dict):
            self._problem(place, "is missing or no table", 'Write { factor = "level" }.')
            return None
        known = {factor.name: factor.levels for factor in self._factors}
        table = {}
        for name, value in data.items():
            levels = value if isinstance(value, list) else [value]
            if name not in known:
                self._problem(place, f'names the factor "{name}", which is not there', self._known_factors())
                return None
            strange = [level for level in levels if level not in known[name]]
            if strange or not levels:
                text = f'has {strange[0]!r}, which is no level of "{name}"' if strange else "has no level"
                self._problem(place, text, f"Levels are {', '.join(known[name])}.")
                return None
            table[name] = tuple(levels)
        return table

    def _check_size(self, design: Design) -> None:
        count = 1
        for factor in design.factors:
            count *= len(factor.levels)
        if count > 100 * MAX_CONSTELLATIONS or len(design.constellations) > MAX_CONSTELLATIONS:
            self._problem(
                "factors",
                f"there are more than {MAX_CONSTELLATIONS} constellations",
                "Nobody judges that many in one session; take factors or levels away.",
            )
            self._stop()

    def _check_graph(self, design: Design) -> None:
        count = len(design.constellations)
        for k, factor in enumerate(design.factors):
            for level in factor.levels:
                if not any(levels[k] == level for levels in design.constellations):
                    self._problem(f"factors.{factor.name}", f'no constellation has "{level}"', "Correct `only`.")
            if not any(edge.factor == factor.name for edge in design.edges):
                self._problem(f"factors.{factor.name}", "no two constellations differ in this alone", "Loosen `only`.")
        parts = design.parts()
        if count and len(parts) > 1:
            lone = design.names[parts[1][0]]
            self._problem(
                "only", f"no steps of one factor lead from {design.names[0]} to {lone}", "Loosen what is allowed there."
            )

    def _check_contrasts(self, design: Design) -> None:
        seen: set[str] = set()
        for contrast in design.contrasts:
            if contrast.name in seen:
                self._problem(f'contrast "{contrast.name}"', "is there twice", "Give it another name.")
            seen.add(contrast.name)
            if not design.directed_edges(contrast):
                self._problem(f'contrast "{contrast.name}"', "has no edges", "Correct its levels or `where`.")

    def _check_expected(self, design: Design, data: object) -> None:
        if not isinstance(data, dict):
            self._problem("expected", "is no table", "Write [expected].")
            return
        self._known("expected", data, {"constellations", "edges"})
        for key, found in (("constellations", len(design.constellations)), ("edges", len(design.edges))):
            if key in data and data[key] != found:
                self._problem(
                    f"expected.{key}", f"says {data[key]}, but the factors give {found}", "Correct either of them."
                )

    def _tables(self, data: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
        entries = data.get(key, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            self._problem(key, "is no list of tables", f"Write [[{key}]] above each.")
            return []
        return entries

    def _known(self, place: str, entry: Mapping[str, Any], keys: set[str]) -> None:
        for key in sorted(set(entry) - keys):
            self._problem(f"{place}.{key}", "is not known", f"Known are {', '.join(sorted(keys))}.")

    def _known_factors(self) -> str:
        return f"Factors are {', '.join(factor.name for factor in self._factors)}."

    def _problem(self, component: str, message: str, remedy: str) -> None:
        self._problems.append(InputError(message, place=Place(file=self._path, component=component), remedy=remedy))

    def _stop(self) -> None:
        if self._problems:
            raise ProblemList(f"{self._path}: this design cannot be studied", self._problems)


def _is_name(value: object) -> bool:
    return isinstance(value, str) and bool(value.strip()) and not set(value) & set('/,;"\n\r\t')
