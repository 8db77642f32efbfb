"""Starts `cmb`: until the program can tell what a signal interrupts, Ctrl-C ends it at once and without a traceback."""

from __future__ import annotations

import signal
import sys


def start() -> int:
    """Runs `cmb` in a process of its own, in which the launcher may have blocked Ctrl-C; returns the exit status."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # nohup and shells in the background ignore it
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    from cmb.main import main  # here, for it takes longest to load

    return main()


if __name__ == "__main__":
    sys.exit(start())
