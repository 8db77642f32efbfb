"""A page that cmb serves as long as it is looked at."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

CMB = (sys.executable, "-m", "cmb.main")


@contextmanager
def serving(*words: object) -> Iterator[str]:
    """Runs a command of cmb meanwhile, and gives the address of its page."""
    with subprocess.Popen([*CMB, *map(str, words)], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield next(found[0] for line in process.stdout if (found := re.search(r"http://\S+", line)))
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate()
