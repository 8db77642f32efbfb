"""Assemblies for tests, as the CAD kernel would give them, and as STEP files that the kernel writes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from cad2modelica.brep.step_model import Face, Occurrence, Shape, StepModel
from cad2modelica.geometry.primitive_meshes import box_surface
from cad2modelica.geometry.spatial import Array, Pose
from cad2modelica.step.part_faces import PartFaces, PlaneFace, RoundFace

X, Y, Z = np.eye(3)


def part(
    name: str, *faces: RoundFace | PlaneFace, size: float = 0.1, volume: float = 1e-4, turned: Any = None
) -> PartFaces:
    points = np.array([face.point for face in faces]) if faces else np.zeros((1, 3))
    return PartFaces(
        name,
        tuple(face for face in faces if isinstance(face, RoundFace)),
        tuple(face for face in faces if isinstance(face, PlaneFace)),
        points.min(axis=0) - size,
        points.max(axis=0) + size,
        volume,
        turned,
    )


def shaft(point: Array, axis: Array, radius: float = 0.005, half_length: float = 0.02) -> RoundFace:
    return RoundFace("cylinder", point, axis, radius, half_length, False)


def hole(point: Array, axis: Array, radius: float = 0.005, half_length: float = 0.02) -> RoundFace:
    return RoundFace("cylinder", point, axis, radius, half_length, True)


def square(point: Array, normal: Array, side: float = 0.05) -> PlaneFace:
    first = np.roll(np.abs(normal), 1)
    second = np.cross(normal, first)
    corners = [point + side / 2 * (a * first + b * second) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    triangles = np.array([[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]])
    return PlaneFace(point, normal, triangles, side**2)


def box_model(boxes: dict[str, Pose], size: tuple[float, float, float] = (0.1, 0.02, 0.02)) -> StepModel:
    """Boxes of aluminium's shape, without faces that joints would be seen by."""
    vertices, triangles = box_surface(np.array(size))
    volume = float(np.prod(size))
    squares = np.square(size)
    inertia = volume / 12 * np.diag(squares.sum() - squares)
    face = Face("plane", np.zeros(3), Z, 0.0, (0, len(triangles)))
    shape = Shape("bar", vertices, triangles, (1.0, 0.0, 0.0), volume, np.zeros(3), inertia, (face,))
    return StepModel("Boxes", tuple(Occurrence(((name, "bar"),), shape, pose, None) for name, pose in boxes.items()))


def write_hinge(file: Path) -> None:
    """Writes a plate with a pin, and an arm with a bore on the pin; lengths in mm."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
    from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDocStd import TDocStd_Document
    from OCP.TopLoc import TopLoc_Location
    from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

    def cylinder(radius: float, low: float, height: float) -> Any:
        return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, low), gp_Dir(0, 0, 1)), radius, height).Shape()

    plate = BRepPrimAPI_MakeBox(gp_Pnt(-50, -50, -10), gp_Pnt(50, 50, 0)).Shape()
    base = BRepAlgoAPI_Fuse(plate, cylinder(5, -5, 25)).Shape()
    bar = BRepPrimAPI_MakeBox(gp_Pnt(-10, -10, 0), gp_Pnt(90, 10, 10)).Shape()
    arm = BRepAlgoAPI_Cut(bar, cylinder(5.1, -1, 30)).Shape()

    document = TDocStd_Document(TCollection_ExtendedString("XmlXCAF"))
    tool: Any = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colors: Any = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    root = tool.NewShape()
    TDataStd_Name.Set_s(root, TCollection_ExtendedString("Hinge"))
    for name, shape, height in (("base", base, 0.0), ("arm", arm, 0.0)):
        label = tool.AddShape(shape, False)
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(name))
        color = Quantity_Color(0.0, 1.0, 0.0, Quantity_TypeOfColor.Quantity_TOC_RGB)
        colors.SetColor(label, color, XCAFDoc_ColorType.XCAFDoc_ColorSurf)
        move = gp_Trsf()
        move.SetTranslation(gp_Vec(0, 0, height))
        component = tool.AddComponent(root, label, TopLoc_Location(move))
        TDataStd_Name.Set_s(component, TCollection_ExtendedString(f"{name}:1"))
    tool.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    writer.Transfer(document)
    writer.Write(str(file))
