"""Asks rumoca in a process of its own, and recovers from a cache of it that is damaged."""

from __future__ import annotations

import importlib.util
import json
import os
import re
import secrets
import shutil
import signal
import subprocess
import sys
import sysconfig
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

from contact_foundation.cache import user_cache
from contact_foundation.errors import BuildError
from contact_foundation.scratch import scratch_folder

from modelica2fmu.library.cache_pruning import prune_front_end_cache

_PROGRAM: Final = Path(__file__).with_name("process.py")
# rumoca's words where a package's files do not fit together; or where its cache says that they are empty.
LAYOUT: Final = re.compile(r"invalid Modelica package layout under '([^']*)': (.*)", re.DOTALL)


@dataclass(frozen=True)
class Request:
    """What rumoca is to do.

    Attributes:
        roots: folders of libraries.
        model: full name.
        file: that holds the model, or the name under which the text is known.
        text: ``None`` if it is that of the file.
        original: the file for a second look after an error.
    """

    roots: tuple[str, ...]
    model: str
    file: str
    text: str | None
    original: str


@dataclass(frozen=True)
class Answer:
    """What came of it.

    Attributes:
        flat: the flattened model, ``None`` after an error.
        error: rumoca's message.
        diagnostics: more messages about the same.
        crash: what ended the process, empty if it ended itself.
    """

    flat: dict[str, Any] | None = None
    error: str = ""
    diagnostics: Sequence[str] = ()
    crash: str = ""

    @property
    def may_be_of_the_cache(self) -> bool:
        """= true, if a damaged cache can be the reason of the error."""
        return bool(self.crash) or LAYOUT.search(self.error) is not None


def front_end_cache() -> Path:
    """The folder in which rumoca keeps what it has parsed for the builder, and nothing else."""
    return user_cache("rumoca")


def ask(request: Request, remark: Callable[[str], None]) -> Answer:
    """Rumoca's answer.

    If the process crashes, or finds the files of a package empty, it is asked once more with an empty cache. If that
    goes better, the kept cache is damaged and removed.

    Args:
        request: see :class:`Request`.
        remark: told if the cache was removed.

    Raises:
        BuildError: rumoca is not installed.
    """
    cache = front_end_cache()
    prune_front_end_cache(cache)
    answer = _run(request, cache.parent)
    if not answer.may_be_of_the_cache or not cache.is_dir():
        return answer
    with scratch_folder("cache") as fresh:
        again = _run(request, fresh)
    if not again.may_be_of_the_cache:
        _remove(cache)
        remark(f"the front end's cache was damaged and is made anew: {cache}")
    return again


def _run(request: Request, cache_home: Path) -> Answer:
    with without_modelicapath():
        process = subprocess.run(
            [sys.executable, "-S", str(_PROGRAM), _folder_of_rumoca()],
            input=json.dumps(asdict(request)).encode(),
            capture_output=True,
            env={**_allocator(), **os.environ, "XDG_CACHE_HOME": str(cache_home)},
            check=False,
        )
    said: dict[str, Any] = {}
    for line in process.stdout.split(b"\n"):
        with suppress(ValueError):  # an answer that was cut short
            said.update(json.loads(line))
    if "flat" in said or "error" in said:
        return Answer(said.get("flat"), said.get("error", ""), said.get("diagnostics", ()))
    if process.returncode < 0:
        return Answer(crash=signal.Signals(-process.returncode).name)
    words = process.stderr.decode(errors="replace").strip().splitlines() or [f"exit status {process.returncode}"]
    if "No module named 'rumoca'" in words[-1]:
        raise BuildError(
            "the Modelica front end rumoca is not installed", remedy="install it: pip install rumoca==0.10.2"
        )
    return Answer(crash=words[-1])


@cache
def _folder_of_rumoca() -> str:
    """The folder with the package; empty if it is not installed."""
    found = importlib.util.find_spec("rumoca")
    return "" if found is None or found.origin is None else str(Path(found.origin).parents[1])


@cache
def _allocator() -> dict[str, str]:
    """Has the process allocate by jemalloc where that is installed: a third of the C library's time goes into that."""
    library = Path("/usr/lib", sysconfig.get_config_var("MULTIARCH") or "", "libjemalloc.so.2")
    return {"LD_PRELOAD": str(library)} if sys.platform == "linux" and library.is_file() else {}


def _remove(folder: Path) -> None:
    """Takes the folder away at once, so that other builds find it whole or not at all."""
    old = folder.with_name(f".{folder.name}-{secrets.token_hex(4)}")
    with suppress(OSError):
        folder.rename(old)
        shutil.rmtree(old, ignore_errors=True)


@contextmanager
def without_modelicapath() -> Iterator[None]:
    """Hides MODELICAPATH from rumoca, which would prefer a library there to the one that was chosen."""
    path = os.environ.pop("MODELICAPATH", None)
    try:
        yield
    finally:
        if path is not None:
            os.environ["MODELICAPATH"] = path
