"""Compiled objects of the runtime, which are the same in all FMUs, kept between builds."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from contact_foundation.output import whole_file

from modelica2fmu.library.cache_pruning import mark_used, prune_unused
from modelica2fmu.packaging.platforms import LINUX64, Platform
from modelica2fmu.packaging.toolchain import COMPILE_OPTIONS, DEPENDENCIES, Compilation, run_tool

_DIGEST_BYTES: Final = 32
_SIZE_BYTES: Final = 8


class ObjectStore:
    """A folder of objects, for one compiler and one set of headers.

    What cannot be read or written, or is damaged, counts as missing; objects are written whole, so several builds can
    share a folder. A file holds the digest of what follows it, the size of the dependencies, these, and the object.

    Args:
        folder: need not exist.
        headers: all that the sources may include: folders, and files whose names stand for installations.
        platform: what the objects are compiled for.
    """

    def __init__(self, folder: Path, headers: Sequence[Path], platform: Platform = LINUX64) -> None:
        program = platform.compiler()
        digest = hashlib.sha256(repr((program, COMPILE_OPTIONS, platform.compile_options)).encode())
        digest.update(run_tool([program, "--version"], "asking the compiler for its version").encode())
        for place in headers:
            for path in sorted(place.glob("*.h")) if place.is_dir() else [place]:
                digest.update(path.name.encode())
                digest.update(path.read_bytes())
        self._common = digest.digest()
        self._folder = folder

    def fetch(self, compilation: Compilation, target: Path) -> bool:
        """Copies the object of a source, and what is known of its dependencies, to ``target``; whether it was there."""
        path = self._path(compilation)
        try:
            content = path.read_bytes()
        except OSError:
            return False
        mark_used(path)
        digest, data = content[:_DIGEST_BYTES], content[_DIGEST_BYTES:]
        if digest != hashlib.sha256(data).digest():
            return False
        size = int.from_bytes(data[:_SIZE_BYTES], "little")
        target.with_suffix(DEPENDENCIES).write_bytes(data[_SIZE_BYTES : _SIZE_BYTES + size])
        target.write_bytes(data[_SIZE_BYTES + size :])
        return True

    def keep(self, compilation: Compilation, target: Path) -> None:
        """Keeps an object that was compiled."""
        dependencies = target.with_suffix(DEPENDENCIES).read_bytes()
        data = len(dependencies).to_bytes(_SIZE_BYTES, "little") + dependencies + target.read_bytes()
        try:
            with whole_file(self._path(compilation)) as staging:
                staging.write_bytes(hashlib.sha256(data).digest() + data)
            prune_unused(self._folder.glob("*.object"))
        except OSError:
            return

    def _path(self, compilation: Compilation) -> Path:
        digest = hashlib.sha256(self._common)
        digest.update(repr(compilation.flags).encode())
        digest.update(compilation.source.name.encode())
        digest.update(compilation.source.read_bytes())
        return self._folder / f"{digest.hexdigest()}.object"
