"""Reads STEP files with Open CASCADE in its own process: ``python -m cad2modelica.brep.kernel_process TASK FOLDER``.

Native code that a file makes crash takes down this process, not the generator; and what it prints does not mix with its
output. TASK is a JSON file ({"files": {number: path}, "deflection", "angle"}: mm or null, rad). For each
file NUMBER.npz appears in FOLDER as soon as it is done, with the text ``manifest`` (JSON, see ``step_model``) and the
arrays ``vertices K`` (mm) and ``triangles K`` of each shape. Nothing else of the project is imported here.
"""

from __future__ import annotations

import json
import os
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepGProp import BRepGProp
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_AsciiString, TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label, TDF_LabelSequence, TDF_Tool
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape
from OCP.TopTools import TopTools_IndexedMapOfShape
from OCP.XCAFDoc import XCAFDoc_ColorTool, XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

MAXIMUM_OCCURRENCES = 5000
MAXIMUM_NESTING = 64
DEFLECTION_OF_SIZE = 1e-3  # of a part's diagonal, unless the task says otherwise

_KINDS = {
    GeomAbs_SurfaceType.GeomAbs_Plane: "plane",
    GeomAbs_SurfaceType.GeomAbs_Cylinder: "cylinder",
    GeomAbs_SurfaceType.GeomAbs_Cone: "cone",
    GeomAbs_SurfaceType.GeomAbs_Sphere: "sphere",
}


class _Refused(Exception):
    """The file cannot be read; the message is the reason."""


def main(task_file: str, folder: str) -> None:
    """Reads the files of a task; a reason why one cannot be read becomes ``{"refused": reason}``."""
    with open(task_file, encoding="utf-8") as stream:
        task = json.load(stream)
    for number, file in task["files"].items():
        arrays: dict[str, NDArray[Any]] = {}
        try:
            manifest = _StepReader(task["deflection"], task["angle"], arrays).read(file)
        except _Refused as reason:
            manifest = {"refused": str(reason)}
        unfinished = os.path.join(folder, "unfinished.npz")
        np.savez(unfinished, allow_pickle=False, manifest=np.array(json.dumps(manifest)), **arrays)
        os.replace(unfinished, os.path.join(folder, f"{number}.npz"))


class _StepReader:
    def __init__(self, deflection: float | None, angle: float, arrays: dict[str, NDArray[Any]]) -> None:
        self._deflection = deflection
        self._angle = angle
        self._arrays = arrays
        self._shapes: list[dict[str, Any]] = []
        self._of_label: dict[str, int] = {}
        self._occurrences: list[dict[str, Any]] = []

    def read(self, file: str) -> dict[str, Any]:
        document = TDocStd_Document(TCollection_ExtendedString("XmlXCAF"))
        reader = STEPCAFControl_Reader()
        reader.SetNameMode(True)
        reader.SetColorMode(True)
        if reader.ReadFile(file) != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise _Refused("is no STEP file that the CAD kernel reads")
        reader.Transfer(document)  # not done where a file holds no shape
        self._tool: Any = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
        self._colors: Any = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
        roots = _labels(lambda found: self._tool.GetFreeShapes(found))
        for root in roots:
            self._walk(root, [], TopLoc_Location(), None, [])
        return {"shapes": self._shapes, "occurrences": self._occurrences, "roots": [_name(root) for root in roots]}

    def _walk(
        self, label: TDF_Label, path: list[list[str]], location: TopLoc_Location, color: Any, above: list[str]
    ) -> None:
        """Adds the parts below a product.

        ``path`` holds [name of the instance, name of its product] from the root's first component on.
        """
        key = _entry(label)
        if key in above or len(above) > MAXIMUM_NESTING:
            raise _Refused(f"its assemblies contain themselves, or are nested deeper than {MAXIMUM_NESTING}")
        if XCAFDoc_ShapeTool.IsAssembly_s(label):
            for component in _labels(lambda found: XCAFDoc_ShapeTool.GetComponents_s(label, found, False)):
                product = TDF_Label()
                if not XCAFDoc_ShapeTool.GetReferredShape_s(component, product):
                    continue
                step = [_name(component), _name(product)]
                placed = location.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(component))
                self._walk(product, [*path, step], placed, self._color(component) or color, [*above, key])
            return
        if len(self._occurrences) >= MAXIMUM_OCCURRENCES:
            raise _Refused(f"places more than {MAXIMUM_OCCURRENCES} parts")
        shape = self._shape(label, key)
        if shape is not None:
            pose = _rows(location)
            self._occurrences.append(
                {"path": path or [["", _name(label)]], "shape": shape, "pose": pose, "color": color}
            )

    def _shape(self, label: TDF_Label, key: str) -> int | None:
        """The number of a product's shape, which is meshed once; None if it has no face."""
        if key in self._of_label:
            return self._of_label[key]
        shape = XCAFDoc_ShapeTool.GetShape_s(label)
        if not _explored(shape, TopAbs_ShapeEnum.TopAbs_FACE):
            return None
        number = len(self._shapes)
        self._of_label[key] = number
        self._shapes.append({"name": _name(label), "color": self._color_below(label, shape), **self._measure(shape)})
        faces, vertices, triangles = self._mesh(shape)
        self._shapes[-1]["faces"] = faces
        self._arrays[f"vertices {number}"] = vertices
        self._arrays[f"triangles {number}"] = triangles
        return number

    def _measure(self, shape: TopoDS_Shape) -> dict[str, Any]:
        """Volume (mm3), its centre (mm) and inertia about it at density 1 (mm5), in the product's axes."""
        solids = _explored(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
        if not solids:
            return {"volume": 0.0, "center": [0.0] * 3, "inertia": [0.0] * 9, "solids": 0}
        properties = GProp_GProps()
        for solid in solids:
            own = GProp_GProps()
            BRepGProp.VolumeProperties_s(solid, own)
            if own.Mass() < 0:  # a solid that is turned inside out
                own = GProp_GProps()
                BRepGProp.VolumeProperties_s(solid.Reversed(), own)
            properties.Add(own)
        center, tensor = properties.CentreOfMass(), properties.MatrixOfInertia()
        return {
            "volume": properties.Mass(),
            "center": [center.X(), center.Y(), center.Z()],
            "inertia": [tensor.Value(i, j) for i in (1, 2, 3) for j in (1, 2, 3)],
            "solids": len(solids),
        }

    def _mesh(self, shape: TopoDS_Shape) -> tuple[list[dict[str, Any]], NDArray[np.float64], NDArray[np.int64]]:
        box = Bnd_Box()
        BRepBndLib.Add_s(shape, box)
        size = float(np.sqrt(box.SquareExtent())) if not box.IsVoid() else 1.0
        BRepMesh_IncrementalMesh(shape, self._deflection or DEFLECTION_OF_SIZE * size, False, self._angle, False)
        faces: list[dict[str, Any]] = []
        corners: list[NDArray[np.int64]] = [np.zeros((0, 3), dtype=np.int64)]
        nodes = _SharedNodes(shape)
        count = 0
        for found in _explored(shape, TopAbs_ShapeEnum.TopAbs_FACE):
            face = TopoDS.Face_s(found)
            location = TopLoc_Location()
            mesh = BRep_Tool.Triangulation_s(face, location)
            if mesh is None:
                continue
            numbers = nodes.of_face(face, mesh, location)
            indices = numbers[np.array([mesh.Triangle(k + 1).Get() for k in range(mesh.NbTriangles())]) - 1]
            if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
                indices = indices[:, ::-1]
            faces.append({**_surface(face), "triangles": [count, count + len(indices)]})
            corners.append(indices)
            count += len(indices)
        return faces, np.array(nodes.points).reshape(-1, 3), np.concatenate(corners)

    def _color(self, label: TDF_Label) -> list[float] | None:
        color = Quantity_Color()
        for kind in (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen):
            if XCAFDoc_ColorTool.GetColor_s(label, kind, color):
                return _displayed(color)
        return None

    def _color_below(self, label: TDF_Label, shape: TopoDS_Shape) -> list[float] | None:
        """A product's colour: its own, or the first of a solid or face in it."""
        own = self._color(label)
        if own is not None:
            return own
        color = Quantity_Color()
        for kind in (TopAbs_ShapeEnum.TopAbs_SOLID, TopAbs_ShapeEnum.TopAbs_SHELL, TopAbs_ShapeEnum.TopAbs_FACE):
            for item in _explored(shape, kind)[:50]:
                for choice in (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen):
                    if self._colors.GetColor(item, choice, color):
                        return _displayed(color)
        return None


class _SharedNodes:
    """Numbers mesh nodes so that faces share those on their common edges, whatever tolerance the edges have."""

    def __init__(self, shape: TopoDS_Shape) -> None:
        self._edges, self._corners = TopTools_IndexedMapOfShape(), TopTools_IndexedMapOfShape()
        TopExp.MapShapes_s(shape, TopAbs_ShapeEnum.TopAbs_EDGE, self._edges)
        TopExp.MapShapes_s(shape, TopAbs_ShapeEnum.TopAbs_VERTEX, self._corners)
        self._number: dict[tuple[int, int, int], int] = {}
        self.points: list[list[float]] = []

    def of_face(self, face: Any, mesh: Any, location: TopLoc_Location) -> NDArray[np.int64]:
        """The numbers of a face's nodes; new nodes get new ones."""
        rows = np.array(_rows(location))
        points = np.array([_triple(mesh.Node(k + 1)) for k in range(mesh.NbNodes())]) @ rows[:, :3].T + rows[:, 3]
        keys = self._keys(face, mesh, location)
        numbers = np.empty(len(points), dtype=np.int64)
        for node, point in enumerate(points):
            key = keys.get(node)
            known = self._number.get(key) if key is not None else None
            if known is None:
                known = len(self.points)
                self.points.append(point.tolist())
                if key is not None:
                    self._number[key] = known
            numbers[node] = known
        return numbers

    def _keys(self, face: Any, mesh: Any, location: TopLoc_Location) -> dict[int, tuple[int, int, int]]:
        """For nodes on edges which node of which edge they are, or which corner."""
        keys: dict[int, tuple[int, int, int]] = {}
        for item in _explored(face, TopAbs_ShapeEnum.TopAbs_EDGE):
            edge = TopoDS.Edge_s(item)
            if BRep_Tool.Degenerated_s(edge):
                continue
            polygon = BRep_Tool.PolygonOnTriangulation_s(edge, mesh, location)
            if polygon is None:
                continue
            number = self._edges.FindIndex(edge)
            last = polygon.NbNodes()
            for k in range(2, last):
                keys[polygon.Node(k) - 1] = (0, number, k)
            along = TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
            for k, corner in ((1, TopExp.FirstVertex_s(along)), (last, TopExp.LastVertex_s(along))):
                if not corner.IsNull():
                    keys[polygon.Node(k) - 1] = (1, self._corners.FindIndex(corner), 0)
        return keys


def _surface(face: Any) -> dict[str, Any]:
    """Kind and measures of a face: a point (mm) and a direction of its axis or normal, and its radius (mm)."""
    surface = BRepAdaptor_Surface(face)
    kind = _KINDS.get(surface.GetType(), "other")
    result: dict[str, Any] = {"kind": kind, "point": [0.0] * 3, "axis": [0.0, 0.0, 1.0], "radius": 0.0, "angle": 0.0}
    if kind == "plane":
        frame = surface.Plane().Axis()
        result |= {"point": _triple(frame.Location()), "axis": _triple(frame.Direction())}
    elif kind in ("cylinder", "cone"):
        body = surface.Cylinder() if kind == "cylinder" else surface.Cone()
        radius = body.Radius() if kind == "cylinder" else body.RefRadius()
        frame = body.Axis()
        result |= {"point": _triple(frame.Location()), "axis": _triple(frame.Direction()), "radius": radius}
        if kind == "cone":
            result["angle"] = body.SemiAngle()
    elif kind == "sphere":
        ball = surface.Sphere()
        result |= {"point": _triple(ball.Location()), "radius": ball.Radius()}
    return result


def _displayed(color: Quantity_Color) -> list[float]:
    return list(color.Values(Quantity_TypeOfColor.Quantity_TOC_sRGB))


def _labels(fill: Any) -> list[TDF_Label]:
    found = TDF_LabelSequence()
    fill(found)
    return [found.Value(k + 1) for k in range(found.Length())]


def _name(label: TDF_Label) -> str:
    name = TDataStd_Name()
    if not label.FindAttribute(TDataStd_Name.GetID_s(), name):
        return ""
    return str(name.Get().ToExtString())


def _entry(label: TDF_Label) -> str:
    text = TCollection_AsciiString()
    TDF_Tool.Entry_s(label, text)
    return str(text.ToCString())


def _explored(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> list[TopoDS_Shape]:
    explorer = TopExp_Explorer(shape, kind)
    found = []
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def _rows(location: TopLoc_Location) -> list[list[float]]:
    """Three rows of four numbers: rotation and position (mm)."""
    transformation = location.Transformation()
    return [[transformation.Value(i, j) for j in (1, 2, 3, 4)] for i in (1, 2, 3)]


def _triple(item: Any) -> list[float]:
    return [item.X(), item.Y(), item.Z()]


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
