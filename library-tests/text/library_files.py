"""What the files of the library say, read as text."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from library_compiler import PACKAGES, REPOSITORY

_HEADER = re.compile(
    r"(?:^|\n)(?P<prefix>(?:partial |pure )*)(?P<kind>package|model|block|function|record|class|type)\s+(?P<name>\w+)"
    r"(?:\s*=.*?\))?\s*\"(?P<description>[^\"]*)\"",
    re.DOTALL,
)


@dataclass(frozen=True)
class ClassFile:
    """One file of a package and the class it holds."""

    path: Path
    text: str
    name: str
    kind: str
    prefix: str
    description: str

    @property
    def full_name(self) -> str:
        folder = self.path.parent.relative_to(REPOSITORY)
        if self.path.name == "package.mo":
            folder = folder.parent
        return ".".join([*folder.parts, self.name])

    @property
    def is_model(self) -> bool:
        return self.kind == "model" and "partial" not in self.prefix

    @property
    def html(self) -> str:
        match = re.search(r"info=\"<html>(.*?)</html>\"", self.text, re.DOTALL)
        return match.group(1).replace('\\"', '"') if match else ""

    @property
    def experiments(self) -> list[str]:
        return re.findall(r"\bexperiment\(([^)]*)\)", self.text)


def read_class(path: Path) -> ClassFile:
    text = path.read_text("utf-8")
    match = _HEADER.search(text)
    assert match is not None, f"{path}: no class with a description"
    return ClassFile(
        path=path,
        text=text,
        name=match["name"],
        kind=match["kind"],
        prefix=match["prefix"],
        description=match["description"],
    )


@cache
def class_files() -> tuple[ClassFile, ...]:
    return tuple(read_class(path) for package in PACKAGES for path in sorted((REPOSITORY / package).rglob("*.mo")))


@cache
def case_models() -> frozenset[str]:
    """Models that a regression case builds and simulates."""
    cases = (REPOSITORY / "regression" / "cases").rglob("*.toml")
    return frozenset(tomllib.loads(path.read_text("utf-8"))["case"]["model"] for path in cases)


def runnable_models() -> list[str]:
    """Examples and test models: everything that can be simulated by itself."""
    return [
        file.full_name
        for file in class_files()
        if file.is_model and (".Examples." in file.full_name or file.full_name.startswith("ContactMultiBodyTest."))
    ]
