"""Names of what a run writes into its folder."""

from __future__ import annotations

PACKAGE_FOLDER = "model"
RESULT = "result.csv"
REPORT = "report.html"
