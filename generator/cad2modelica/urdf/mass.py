"""Mass properties of a robot description's links, which are often approximate.

What no solver could use is repaired as little as possible, see ``mechanism.mass_repair``.
"""

from __future__ import annotations

import numpy as np
from lxml import etree

from cad2modelica.mechanism.model import MassProperties
from cad2modelica.source.number_limits import plain_number
from cad2modelica.urdf.elements import UrdfElements

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
