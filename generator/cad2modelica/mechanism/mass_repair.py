"""Mass properties of robot descriptions, which are often approximate.

Simulators take placeholders like unit inertia or point masses, so descriptions in circulation are full of them. What no
solver could use is repaired as little as possible; everything doubtful is noted with its numbers.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from cad2modelica.geometry.mesh import Mesh, join
from cad2modelica.mechanism.mass_check import check_against_geometry, check_moments, check_tensor
from cad2modelica.mechanism.model import MassProperties

LEAST_GYRATION = 1e-3
"""Least radius of gyration over the size of the geometry that a repaired inertia gets."""
SIZE_WITHOUT_GEOMETRY = 0.1  # m


def usable(properties: MassProperties, meshes: tuple[Mesh, ...]) -> tuple[MassProperties, list[str]]:
    """Mass properties that a solver can use, and what is doubtful about them.

    Returns:
        The properties, their inertia with principal moments of at least a thousandth of the size as radius of
        gyration if one of them was zero or negative; and remarks.
    """
    remarks: list[str] = []
    moments, axes = np.linalg.eigh(properties.inertia)
    size = float(np.linalg.norm(np.ptp(join(meshes)[0], axis=0))) if meshes else SIZE_WITHOUT_GEOMETRY
    least = properties.mass * (LEAST_GYRATION * size) ** 2
    if moments[0] <= 1e-12 * max(moments[2], least):
        raised = np.maximum(moments, least)
        remarks.append(
            f"principal moments of inertia {_listed(moments)} kg.m2 raised to {_listed(raised)}, "
            "for a body that can turn freely needs inertia about every axis"
        )
        properties = MassProperties(properties.mass, properties.center_of_mass, (axes * raised) @ axes.T)
    finding = check_tensor(properties)
    if finding is not None:
        remarks.append(finding.message)
    elif meshes:
        remarks += [doubt.message for doubt in check_against_geometry(properties, meshes)]
    return properties, remarks


def impossible_members(members: Iterable[tuple[str, MassProperties]]) -> list[str]:
    """Remarks on bodies that no mass distribution has, where several are fixed to each other: their sum hides it.

    A member without inertia is a point mass, which is possible.
    """
    massive = [(name, properties) for name, properties in members if properties.mass > 0]
    if len(massive) < 2:
        return []
    findings = [(name, check_moments(properties.inertia)) for name, properties in massive]
    return [f"{name!r}, fixed to others: {finding.message}" for name, finding in findings if finding is not None]


def _listed(moments: np.ndarray) -> str:
    return ", ".join(f"{moment:.3g}" for moment in moments)
