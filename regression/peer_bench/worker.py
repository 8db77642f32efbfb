"""A process that simulates with one program: requests come as lines of JSON on standard input, answers go back so too.

Started by the interpreter that has the program: ``python -m peer_bench.worker mujoco``. The first line that it writes
is the program's version. What libraries print on standard output is sent to standard error.
"""

from __future__ import annotations

import json
import os
import sys
from importlib import import_module
from typing import Any

from peer_bench.programs.simulation import timed
from peer_bench.scenes import scene


def main() -> int:
    """Serves requests until standard input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    try:
        program: Any = import_module(f"peer_bench.programs.{sys.argv[1]}_program")
    except ImportError as error:
        _send(answers, {"missing": str(error)})
        return 0
    _send(answers, {"version": program.VERSION})
    for line in sys.stdin:
        _send(answers, answer(program, json.loads(line)))
    return 0


def answer(program: Any, request: dict[str, Any]) -> dict[str, Any]:
    """What a request for a simulation gives: its values, times and counts, or why it failed.

    Args:
        program: a module with ``simulation``.
        request: scene (name) and settings.
    """
    chosen = scene(request["scene"])
    try:
        found = timed(program.simulation(chosen, request["settings"]), chosen)
    except Exception as error:  # whatever a program raises is its answer
        return {"failure": f"{type(error).__name__}: {' '.join(str(error).split())[:200]}"}
    return {"values": found.values, "cpu_time": found.cpu_time, "work": found.work}


def _send(stream: Any, content: dict[str, Any]) -> None:
    stream.write(json.dumps(content) + "\n")
    stream.flush()


if __name__ == "__main__":
    sys.exit(main())
