"""Compiled objects of the runtime, which are the same in all FMUs, kept between builds."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Sequence
from pathlib import Path

from cmb_base.output import whole_file

from modelica2fmu.packaging.toolchain import COMPILE_OPTIONS, DEPENDENCIES, Compilation, compiler, run_tool


class ObjectStore:
    """A folder of objects, for one compiler and one set of headers.

    What cannot be read or written counts as missing; objects are written whole, so several builds can share a folder.

    Args:
        folder: need not exist.
        headers: all that the sources may include: folders, and files whose names stand for installations.
    """

    def __init__(self, folder: Path, headers: Sequence[Path]) -> None:
        digest = hashlib.sha256(repr((compiler(), COMPILE_OPTIONS)).encode())
        digest.update(run_tool([compiler(), "--version"], "asking the compiler for its version").encode())
        for place in headers:
            for path in sorted(place.glob("*.h")) if place.is_dir() else [place]:
                digest.update(path.name.encode())
                digest.update(path.read_bytes())
        self._common = digest.digest()
        self._folder = folder

    def fetch(self, compilation: Compilation, target: Path) -> bool:
        """Copies the object of a source, and what is known of its dependencies, to ``target``; whether it was there."""
        kept = self._path(compilation)
        try:
            for suffix in (DEPENDENCIES, ".o"):
                shutil.copyfile(kept.with_suffix(suffix), target.with_suffix(suffix))
        except OSError:
            return False
        return True

    def keep(self, compilation: Compilation, target: Path) -> None:
        """Keeps an object that was compiled."""
        kept = self._path(compilation)
        try:
            for suffix in (DEPENDENCIES, ".o"):
                with whole_file(kept.with_suffix(suffix)) as staging:
                    shutil.copyfile(target.with_suffix(suffix), staging)
        except OSError:
            return

    def _path(self, compilation: Compilation) -> Path:
        digest = hashlib.sha256(self._common)
        digest.update(repr(compilation.flags).encode())
        digest.update(compilation.source.name.encode())
        digest.update(compilation.source.read_bytes())
        return self._folder / f"{digest.hexdigest()}.o"
