"""The wheel carries the viewer's bundled scripts (scripts/setup-viewer): who installs it needs no Node.js."""

import os
import subprocess
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

BUNDLE = Path(__file__).parent / "scripts" / "setup-viewer"


class BuildWithViewer(build_py):
    """Bundles before package data are collected."""

    def run(self):
        """Refuses to build without the scripts, unless told to."""
        wanted = not self.editable_mode and not os.environ.get("CMB_WITHOUT_VIEWER")
        if wanted and subprocess.run([sys.executable, BUNDLE], check=False).returncode != 0:
            raise SystemExit("A wheel without the viewer's scripts is built with CMB_WITHOUT_VIEWER=1 alone.")
        super().run()


# A launcher of our own, not an entry point: command/launcher/cmb says why.
setup(cmdclass={"build_py": BuildWithViewer}, scripts=["command/launcher/cmb"])
