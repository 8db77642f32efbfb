"""Where figures come from: machine, what else it did, and versions."""

from __future__ import annotations

import os
import platform
import statistics
from collections.abc import Iterable
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


def load() -> float | None:
    """Processes that wanted a processor in the last minute, this one too; None where the system does not tell."""
    try:
        return round(os.getloadavg()[0], 2)
    except (AttributeError, OSError):
        return None


def load_text(loads: Iterable[float | None]) -> str:
    """At which load times were measured, as a sentence; "" where nothing is known of it."""
    known = [value for value in loads if value is not None]
    if not known:
        return ""
    least, median, most = min(known), statistics.median(known), max(known)
    text = f"Times were measured at a load of {least:.1f} to {most:.1f}, {median:.1f} in the median"
    if most > (os.cpu_count() or 1):
        return f"{text}: beside other work, which lengthens them."
    return f"{text}."


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
