"""One task in a process: it comes pickled on standard input; what it raises goes back so on standard output."""

from __future__ import annotations

import os
import pickle
import sys

from fmu_regression.simulate.limited_process import end_with_parent


def main() -> int:
    """Carries out the task."""
    end_with_parent()
    answer = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what FMUs print is no answer
    task = pickle.load(sys.stdin.buffer)
    try:
        task()
    except Exception as error:
        answer.write(pickle.dumps(error))
        answer.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main())
