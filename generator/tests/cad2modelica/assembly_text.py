"""Writes small assemblies without geometry, in SI units."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np


def numbers(values: Sequence[float] | np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)


def part(
    name: str,
    *,
    position: Sequence[float] = (0, 0, 0),
    turn: tuple[Sequence[float], float] = ((0, 0, 1), 0),
    mass: float = 1.0,
    center: Sequence[float] = (0, 0, 0),
    inertia: Sequence[float] = (0.01, 0.01, 0.01),
    start: str = "",
) -> str:
    orientation = f'<axisAngle axis="{numbers(turn[0])}" angle="{float(turn[1])!r}"/>'
    return f"""<part name="{name}">
      <pose><position>{numbers(position)}</position>{orientation}</pose>
      <massProperties><mass>{mass!r}</mass><centerOfMass>{numbers(center)}</centerOfMass>
        <inertia about="centerOfMass" axes="part" products="tensor" xx="{inertia[0]!r}" yy="{inertia[1]!r}"
          zz="{inertia[2]!r}" xy="0" xz="0" yz="0"/></massProperties>{start}</part>"""


def joint(
    name: str,
    kind: str,
    parent: str,
    child: str,
    *,
    origin: Sequence[float] = (0, 0, 0),
    axis: Sequence[float] | None = None,
    axis2: Sequence[float] | None = None,
    start: str = "",
    extra: str = "",
    pitch: float | None = None,
) -> str:
    axes = f"<axis>{numbers(axis)}</axis>" if axis is not None else ""
    axes += f"<axis2>{numbers(axis2)}</axis2>" if axis2 is not None else ""
    begin = f"<start {start}/>" if start else ""
    lead = f' pitch="{pitch!r}"' if pitch is not None else ""
    return f"""<joint name="{name}" type="{kind}" parent="{parent}" child="{child}"{lead}>
      <origin>{numbers(origin)}</origin>{axes}{begin}{extra}</joint>"""


def write_assembly(
    file: Path,
    parts: Sequence[str],
    joints: Sequence[str],
    gravity: Sequence[float] = (0, 0, -9.81),
    name: str = "Test",
) -> Path:
    file.write_text(
        f"""<assembly xmlns="urn:contactmultibody:assembly:1" name="{name}">
        <units length="m" mass="kg" angle="rad"/><gravity>{numbers(gravity)}</gravity>
        <parts>{"".join(parts)}</parts><joints>{"".join(joints)}</joints></assembly>"""
    )
    return file
