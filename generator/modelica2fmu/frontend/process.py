"""Runs rumoca in a process of its own: a broken file in its cache or an overflowing stack kills no more than that.

A program that reads a request from standard input and writes its answer, one JSON object a line, to standard output:
first ``{"flat": ...}`` or ``{"error": ...}``, and after an error ``{"diagnostics": [...]}``. It imports nothing of the
package, so that it starts quickly.
"""

from __future__ import annotations

import json
import os
import sys
from typing import IO, Any


def main() -> None:
    """Answers the request on standard input."""
    # What libraries print must not come between the answers.
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as answers:
        os.dup2(2, 1)
        _answer(json.load(sys.stdin), answers)


def _answer(request: dict[str, Any], answers: IO[str]) -> None:
    import rumoca

    try:
        session = rumoca.Session(request["roots"])
        if request["text"] is None:
            compiled = session.load(request["file"], model=request["model"])
        else:
            compiled = session.loads(request["text"], model=request["model"], filename=request["file"])
        flat = compiled.to_json("flat")
    except BaseException as error:  # a panic of rumoca derives from BaseException alone
        answers.write(json.dumps({"error": str(error)}) + "\n")
        answers.flush()
        if isinstance(error, rumoca.RumocaError):
            diagnostics = rumoca.validate(request["original"], model=request["model"])
            answers.write(json.dumps({"diagnostics": [str(item.message) for item in diagnostics]}) + "\n")
        return
    answers.write('{"flat": ' + flat.replace("\n", " ") + "}\n")


if __name__ == "__main__":
    main()
