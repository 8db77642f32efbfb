"""Mass properties of a robot description's links, which are often approximate.

Simulators take placeholders like unit inertia or point masses, so descriptions in circulation are full of them. What no
solver could use is repaired as little as possible; everything doubtful is noted with its numbers.
"""

from __future__ import annotations

import numpy as np
from lxml import etree

from cad2modelica.geometry.mesh import Mesh, join
from cad2modelica.mechanism.mass_check import check_against_geometry, check_tensor
from cad2modelica.mechanism.model import MassProperties
from cad2modelica.urdf.elements import UrdfElements, plain_number

LEAST_GYRATION = 1e-3
"""Least radius of gyration over the size of the geometry that a repaired inertia gets."""
SIZE_WITHOUT_GEOMETRY = 0.1  # m

_COMPONENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


def has_mass(link: etree._Element) -> bool:
    """Whether a link has mass; a mass of 0 or a text that is no number counts as none."""
    element = link.find("inertial/mass")
    try:
        return element is not None and plain_number(element.get("value", "0")) != 0.0
    except ValueError:
        return True  # reported where the number is read


def gets_mass_by_density(link: etree._Element) -> bool:
    """Whether a link says nothing of its mass and has geometry."""
    has_geometry = link.find("visual/geometry") is not None or link.find("collision/geometry") is not None
    return has_geometry and link.find("inertial/mass") is None


def has_inertia_alone(link: etree._Element) -> bool:
    """Whether a link without mass has moments or products of inertia, which no body has."""
    inertia = link.find("inertial/inertia")
    texts = [] if inertia is None or has_mass(link) else [inertia.get(key, "0") for key in _COMPONENTS]
    return any(text.strip("-+ 0.eE") for text in texts)


def read_mass_properties(inertial: etree._Element, elements: UrdfElements) -> MassProperties:
    """What the element ``inertial`` says, in the link's axes; kg, m, kg.m2."""
    origin = elements.origin(inertial)
    mass = elements.numbers(inertial.find("mass"), "value", (0.0,))[0]
    element = inertial.find("inertia")
    value = {key: elements.numbers(element, key, (0.0,))[0] for key in _COMPONENTS}
    tensor = np.array(
        [
            [value["ixx"], value["ixy"], value["ixz"]],
            [value["ixy"], value["iyy"], value["iyz"]],
            [value["ixz"], value["iyz"], value["izz"]],
        ]
    )
    turned = origin.rotation @ tensor @ origin.rotation.T
    return MassProperties(float(mass), origin.position, (turned + turned.T) / 2)


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


def _listed(moments: np.ndarray) -> str:
    return ", ".join(f"{moment:.3g}" for moment in moments)
