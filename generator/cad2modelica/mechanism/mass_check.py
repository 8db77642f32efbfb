"""Whether mass properties can belong to a body, and to the geometry they come with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cad2modelica.geometry.mesh import Mesh, VolumeIntegrals, bodies, is_closed, join, volume_integrals, weld
from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.model import MassProperties
from cad2modelica.source.number_limits import SMALLEST

RELATIVE_TOLERANCE = 1e-6
DENSITY_LIMITS = (0.05, 50_000.0)  # kg/m3: aerogel to twice osmium
USUAL_DENSITIES = (20.0, 25_000.0)  # kg/m3: light foam to osmium, with some room
COMMON_DENSITIES = (500.0, 20_000.0)  # kg/m3: wood to tungsten
REMARK_TOLERANCE = 0.05
NO_OFFSET = 1e-9  # m; less is rounding
# Ratios of units of length that files mix up.
UNIT_RATIOS = {1000.0: "mm and m", 100.0: "cm and m", 10.0: "mm and cm", 25.4: "mm and inch", 1 / 0.0254: "inch and m"}
RATIO_TOLERANCE = 1.2  # two of them differ by a factor of 1.55 at least
GYRATION_OF_SIZE = 0.26  # a rod's or a plate's radius of gyration over its diagonal, 0.29; less of compact bodies
LARGEST_GYRATION = 10.0  # of the mechanism's size, for parts whose own size is not known


@dataclass(frozen=True)
class MassFinding:
    """A doubt about mass properties; ``wrong`` if no real body can have them."""

    message: str
    remedy: str
    wrong: bool


def check_tensor(properties: MassProperties) -> MassFinding | None:
    """Checks mass > 0, inertia positive definite, and the triangle inequality of the principal moments."""
    if not properties.mass >= SMALLEST:
        least = f" (at least {SMALLEST:g} kg)" if properties.mass > 0 else ""
        return MassFinding(
            f"mass is {properties.mass:g} kg, but must be positive{least}", "Assign a material in the CAD system.", True
        )
    moments = np.linalg.eigvalsh(properties.inertia)
    listed = ", ".join(f"{moment:.4g}" for moment in moments)
    if not moments[0] > 0:
        return MassFinding(
            f"the inertia about the centre of mass is not positive definite (principal moments {listed} kg.m2)",
            "Check which point ('about') and which sign of the products ('products') the numbers belong to.",
            True,
        )
    return check_moments(properties.inertia)


def check_moments(inertia: Array) -> MassFinding | None:
    """Checks the triangle inequality of the principal moments; with it, none of them is negative."""
    moments = np.linalg.eigvalsh(inertia)
    if moments[2] <= (moments[0] + moments[1]) + RELATIVE_TOLERANCE * abs(moments[2]):
        return None
    listed = ", ".join(f"{moment:.4g}" for moment in moments)
    return MassFinding(
        f"no body has these principal moments of inertia: {listed} kg.m2 (one exceeds the sum of the others)",
        "Check which point ('about') and which sign of the products ('products') the numbers belong to.",
        True,
    )


def check_against_mechanism(properties: MassProperties, length: float) -> MassFinding | None:
    """Compares a part without geometry with the mechanism's size: a doubt about units, never an error.

    Args:
        properties: of the part.
        length: distance between the joints that are farthest apart, m.
    """
    gyration = float(np.sqrt(np.linalg.eigvalsh(properties.inertia)[2] / properties.mass))
    away = float(np.linalg.norm(properties.center_of_mass))
    if gyration <= LARGEST_GYRATION * length and away <= LARGEST_GYRATION * length:
        return None
    return MassFinding(
        f"its radius of gyration is {gyration:.3g} m and its centre of mass {away:.3g} m from its origin, but the "
        f"joints of the whole mechanism lie within {length:.3g} m",
        "check the units of mass, length and inertia",
        False,
    )


def check_against_geometry(properties: MassProperties, meshes: tuple[Mesh, ...]) -> list[MassFinding]:
    """Compares mass properties with the geometry: size always, integrals where all bodies are closed.

    Returns:
        Findings that are wrong (units mixed up) or worth a remark (overridden or lumped masses).
    """
    vertices, triangles = weld(*join(meshes))
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    diagonal = float(np.linalg.norm(high - low))
    outside = np.maximum(low - properties.center_of_mass, properties.center_of_mass - high).max()
    if not diagonal >= SMALLEST:
        return [MassFinding("all points of the geometry coincide", "Export the geometry again.", True)]
    remedy = "Check the units of the XML file and of the geometry ('length'), and the part's coordinate system."
    if outside > 10 * diagonal:
        return [
            MassFinding(
                f"the centre of mass lies {outside:g} m outside the geometry, which is {diagonal:g} m in size",
                remedy,
                True,
            )
        ]
    gyration = float(np.sqrt(np.linalg.eigvalsh(properties.inertia)[2] / properties.mass))
    pieces = bodies(vertices, triangles)
    closed = all(is_closed(piece[1]) for piece in pieces)
    integrals = [volume_integrals(*piece) for piece in pieces] if closed else []
    volume = sum(item.volume for item in integrals)
    mixed = _mixed_units((_gyration(integrals) if volume > 0 else GYRATION_OF_SIZE * diagonal) / gyration)
    if gyration > 30 * diagonal or gyration < diagonal / 3000:
        message = f"the radius of gyration is {gyration:.3g} m, the geometry {diagonal:.3g} m in size{mixed}"
        return [MassFinding(message, remedy, True)]
    if volume <= 0:
        return []
    density = properties.mass / volume
    if not DENSITY_LIMITS[0] <= density <= DENSITY_LIMITS[1]:
        return [MassFinding(f"mass over volume is {density:.3g} kg/m3, which no solid has{mixed}", remedy, True)]
    findings = []
    if not USUAL_DENSITIES[0] <= density <= USUAL_DENSITIES[1]:
        findings.append(MassFinding(_unusual(density) + (mixed or _other_mass(density)), remedy, False))
    if outside > 0:
        findings.append(MassFinding("the centre of mass lies outside the geometry's box", remedy, False))
    if len(pieces) == 1 and outside <= 0:
        expected = density * integrals[0].inertia
        offset = float(np.linalg.norm(integrals[0].center - properties.center_of_mass))
        difference = float(np.abs(expected - properties.inertia).max() / np.abs(expected).max())
        if offset > REMARK_TOLERANCE * diagonal or difference > REMARK_TOLERANCE:
            centre = f"centre {1000 * offset:.3g} mm off, " if offset >= NO_OFFSET else ""
            findings.append(
                MassFinding(
                    "mass properties are not those of the geometry at uniform density "
                    f"({centre}inertia {100 * difference:.0f} % off)",
                    "Fine if they were overridden on purpose.",
                    False,
                )
            )
    return findings


def _gyration(integrals: list[VolumeIntegrals]) -> float:
    """The largest radius of gyration of bodies of one density together."""
    volume = sum(item.volume for item in integrals)
    center = sum((item.volume * item.center for item in integrals), np.zeros(3)) / volume
    inertia = np.zeros((3, 3))
    for item in integrals:
        arm = item.center - center
        inertia += item.inertia + item.volume * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return float(np.sqrt(np.linalg.eigvalsh(inertia)[2] / volume))


def _mixed_units(ratio: float) -> str:
    """What a geometry that is so many times too large says about units; empty if it says nothing."""
    factor, way = (ratio, "large") if ratio > 1 else (1 / ratio, "small")
    for known, units in UNIT_RATIOS.items():
        if known / RATIO_TOLERANCE < factor < known * RATIO_TOLERANCE:
            return f"; the geometry is {known:.4g} times too {way} for the inertia, as if {units} were mixed up"
    return ""


def _unusual(density: float) -> str:
    side = "less" if density < USUAL_DENSITIES[0] else "more"
    return f"mass over volume is {density:.3g} kg/m3, {side} than of any usual material"


def _other_mass(density: float) -> str:
    """What a density says about the unit of mass; empty if it says nothing."""
    low = density < USUAL_DENSITIES[0]
    other = density * (1000 if low else 1e-3)
    if not COMMON_DENSITIES[0] <= other <= COMMON_DENSITIES[1]:
        return ""
    return f"; {other:.4g} kg/m3 if the unit of mass were {'kg instead of g' if low else 'g instead of kg'}"
