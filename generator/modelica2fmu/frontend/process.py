"""Runs rumoca in a process of its own: a broken file in its cache or an overflowing stack kills no more than that.

A program that reads a request from standard input and writes its answer, one JSON object a line, to standard output:
first ``{"flat": ...}`` or ``{"error": ...}``, and after an error ``{"diagnostics": [...]}``. It imports nothing of the
package and is started without ``site``, so that it starts quickly: its argument is the folder in which rumoca is
installed.
"""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path
from typing import IO, Any, Final

_UNREAD_PACKAGE: Final = re.compile(r"Failed to load source root '([^']+)'")


def main() -> None:
    """Answers the request on standard input."""
    # What libraries print must not come between the answers.
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as answers:
        os.dup2(2, 1)
        sys.path.append(sys.argv[1])
        _answer(json.load(sys.stdin), answers)
    os._exit(0)  # to take rumoca's trees apart costs a tenth of its time


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
            found = (
                str(item.message)
                for file in _files_to_look_at(request["original"], str(error))
                for item in rumoca.validate(file, model=request["model"])
            )
            answers.write(json.dumps({"diagnostics": list(found)}) + "\n")
        return
    answers.write('{"flat": ' + flat.replace("\n", " ") + "}\n")


def _files_to_look_at(original: str, error: str) -> list[str]:
    """The model's file; all files of a package that rumoca could not read, where its words name that package alone."""
    package = _UNREAD_PACKAGE.search(error)
    if package is None:
        return [original]
    return [str(file) for file in sorted(Path(package[1]).rglob("*.mo"))]


if __name__ == "__main__":
    main()
