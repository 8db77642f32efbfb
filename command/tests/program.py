"""The program under test and its sample."""

from __future__ import annotations

import subprocess
from collections.abc import Callable

from cmb.project import ROOT

Cmb = Callable[..., "subprocess.CompletedProcess[str]"]

HAMMER = ROOT / "Resources" / "cad" / "hammer"
