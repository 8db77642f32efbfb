"""Inertia of parts as a joint feels it."""

from __future__ import annotations

import math

import numpy as np

from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import Joint, JointType, Part


def inertia_about(joint: Joint, part: Part) -> float:
    """Inertia of a part in the joint's coordinate: kg, or kg.m2 about the axis."""
    properties = part.mass_properties
    if joint.type is JointType.PRISMATIC or joint.axis is None:
        return properties.mass
    axis: Array = joint.axis
    arm = np.cross(part.pose.point(properties.center_of_mass) - joint.origin, axis)
    turned = part.pose.rotation.T @ axis
    about = float(turned @ properties.inertia @ turned) + properties.mass * float(arm @ arm)
    along = joint.pitch / (2 * math.pi)
    return about + properties.mass * along**2
