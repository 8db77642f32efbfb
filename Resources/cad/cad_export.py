"""What the samples' CAD scripts share: weighing solids with the kernel, VRML by its writer, the assembly's XML.

Needs CadQuery (``pip install cadquery``). Lengths are millimetres, angles degrees, as usual in CAD.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import cadquery as cq
from cadquery.occ_impl.exporters.assembly import toCAF
from lxml import etree
from OCP.BRepGProp import BRepGProp
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.GProp import GProp_GProps
from OCP.VrmlAPI import VrmlAPI_ShadedRepresentation, VrmlAPI_Writer

NAMESPACE = "urn:contactmultibody:assembly:1"

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class MassProperties:
    """Mass in kg, centre of mass in mm, inertia tensor about it in kg mm2; all in the solids' own axes."""

    mass: float
    center: Vector
    inertia: list[list[float]]


def solid_of(work: cq.Workplane) -> cq.Solid:
    """The only solid of a workplane."""
    (solid,) = work.solids().vals()
    if not isinstance(solid, cq.Solid):
        raise TypeError(f"expected a solid, got {type(solid).__name__}")
    return solid


def number(value: float) -> str:
    """Shortest text that reads back to ``value`` rounded to 12 significant digits, without a negative zero."""
    rounded = float(f"{value:.12g}")
    return "0" if rounded == 0 else f"{rounded:.12g}"


def numbers(*values: float) -> str:
    """Blank-separated numbers."""
    return " ".join(number(value) for value in values)


def weigh(solids: Iterable[tuple[cq.Solid, float]]) -> MassProperties:
    """Weighs solids, each with its density in kg/m3, by the kernel's volume integrals."""
    properties = GProp_GProps()
    for solid, density in solids:
        single = GProp_GProps()
        BRepGProp.VolumeProperties_s(solid.wrapped, single, 1e-9)
        properties.Add(single, density * 1e-9)
    center = properties.CentreOfMass()
    matrix = properties.MatrixOfInertia()
    scale = max(abs(matrix.Value(i, i)) for i in (1, 2, 3))
    inertia = [[matrix.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)]
    cleaned = [[0.0 if abs(value) < 1e-8 * scale else value for value in row] for row in inertia]
    coordinates = tuple(0.0 if abs(value) < 1e-6 else value for value in (center.X(), center.Y(), center.Z()))
    return MassProperties(properties.Mass(), (coordinates[0], coordinates[1], coordinates[2]), cleaned)


def vrml_name(name: str) -> str:
    """The DEF name that the kernel's writer makes of a product name."""
    return re.sub(r"\s", "_", name)


def write_vrml(
    assembly: cq.Assembly, solids: Iterable[cq.Solid], file: Path, *, chord_error: float, angle_error: float
) -> None:
    """Meshes the solids and has the kernel write the assembly, product structure and names included.

    Args:
        assembly: what is written; it holds the solids.
        solids: those to mesh.
        file: the VRML file.
        chord_error: mm.
        angle_error: rad.
    """
    for solid in solids:
        BRepMesh_IncrementalMesh(solid.wrapped, chord_error, False, angle_error, False)
    _, document = toCAF(assembly, coloredSTEP=True)
    writer = VrmlAPI_Writer()
    writer.SetRepresentation(VrmlAPI_ShadedRepresentation)
    writer.SetDeflection(chord_error)
    if not writer.WriteDoc(document, str(file), 1.0):
        raise RuntimeError(f"the kernel could not write {file}")


def new_assembly(name: str) -> etree._Element:
    """The root element of an assembly file."""
    return etree.Element(f"{{{NAMESPACE}}}assembly", {"name": name}, nsmap={None: NAMESPACE})


def add(owner: etree._Element, tag: str, text: str | None = None, **attributes: str) -> etree._Element:
    """Adds a child element."""
    element = etree.SubElement(owner, f"{{{NAMESPACE}}}{tag}", attributes)
    element.text = text
    return element


def add_mass_properties(part: etree._Element, properties: MassProperties) -> None:
    """Adds a part's mass properties."""
    inertia = properties.inertia
    element = add(part, "massProperties")
    add(element, "mass", number(properties.mass))
    add(element, "centerOfMass", numbers(*properties.center))
    add(
        element,
        "inertia",
        about="centerOfMass",
        axes="part",
        products="tensor",
        xx=number(inertia[0][0]),
        yy=number(inertia[1][1]),
        zz=number(inertia[2][2]),
        xy=number(inertia[0][1]),
        xz=number(inertia[0][2]),
        yz=number(inertia[1][2]),
    )


def write_xml(root: etree._Element, file: Path) -> None:
    """Writes an assembly file."""
    etree.indent(root)
    file.write_bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8") + b"\n")
