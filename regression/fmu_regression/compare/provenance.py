"""Where figures come from: machine and versions."""

from __future__ import annotations

import os
import platform
from importlib import metadata


def machine() -> str:
    """Processor, cores and system."""
    processor = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as stream:
            processor = next(line.split(":", 1)[1].strip() for line in stream if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return f"{processor}, {os.cpu_count()} cores, {platform.system()} {platform.release()}"


def versions(generation_tool: str) -> dict[str, str]:
    """Name to version of the software that matters; ``generation_tool`` wrote the FMU."""
    found = {"Python": platform.python_version()}
    for package in ("fmpy", "numpy", "contactmultibody"):
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            continue
    if generation_tool:
        found["FMU written by"] = generation_tool
    return found
