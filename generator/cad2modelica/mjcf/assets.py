"""Meshes and colours of a model, by their names."""

from __future__ import annotations

from pathlib import PurePosixPath

import numpy as np
from contact_foundation.errors import InputError, Place

from cad2modelica.geometry.convex_hull import hull_surface
from cad2modelica.geometry.mesh import VolumeIntegrals
from cad2modelica.geometry.primitive_meshes import Surface
from cad2modelica.geometry.spatial import Array, rotation_of_quaternion
from cad2modelica.meshio.mesh_library import MeshLibrary, UnreadableMesh, scaled
from cad2modelica.mjcf.document import MAIN, MjcfDocument, place_of
from cad2modelica.mjcf.elements import Item, MjcfElements
from cad2modelica.mjcf.mesh_integrals import mesh_integrals
from cad2modelica.source.number_limits import are_usable

DEFAULT_COLOR = (0.5, 0.5, 0.5)


class MjcfAssets:
    """What the sections ``asset`` define.

    Args:
        document: the model.
        elements: reads attributes.
        library: reads mesh files.
    """

    def __init__(self, document: MjcfDocument, elements: MjcfElements, library: MeshLibrary) -> None:
        self._elements = elements
        self._library = library
        self._meshes: dict[str, Item] = {}
        self._materials: dict[str, Item] = {}
        self._surfaces: dict[str, Surface] = {}
        self.ignored: set[str] = set()
        for section in document.sections("asset"):
            for element in section:
                item = document.item(element, MAIN)
                if element.tag == "mesh":
                    self._meshes[item.name or PurePosixPath(item.text("file")).stem] = item
                elif element.tag == "material":
                    self._materials[item.name] = item
                elif element.tag not in ("texture",):
                    self.ignored.add(str(element.tag))

    def surface(self, name: str, geom: Item) -> Surface:
        """A mesh by its name, in the axes of a geom that uses it, m.

        Raises:
            UnreadableMesh: its file cannot be read.
            InputError: there is no such mesh, or it is no surface.
        """
        if name not in self._surfaces:
            self._surfaces[name] = self._read(name, geom)
        return self._surfaces[name]

    def integrals(self, name: str, geom: Item) -> VolumeIntegrals:
        """Volume, centre and inertia of a mesh, by the rule that the mesh names.

        Raises:
            UnreadableMesh: its file cannot be read.
            InputError: there is no such mesh, or it has no volume.
        """
        vertices, triangles = self.surface(name, geom)
        rule = self._meshes[name].text("inertia", "legacy")
        if rule == "convex":
            vertices, triangles = self._hull(vertices, place_of(self._elements, geom))
        found = mesh_integrals(vertices, triangles, rule)
        if not found.volume > 0.0:
            raise InputError(
                f"the mesh {name!r} has no volume, from which its mass could follow",
                place=place_of(self._elements, geom),
                remedy='Close the mesh, give the body an inertial, or the mesh inertia="convex".',
            )
        return found

    def color(self, geom: Item) -> tuple[float, float, float]:
        """The colour of a geom: its own, or that of its material."""
        material = self._materials.get(geom.text("material"))
        source = geom if geom.has("rgba") or material is None else material
        fallback = (1.0, 1.0, 1.0, 1.0) if source is material else (*DEFAULT_COLOR, 1.0)
        red, green, blue, _ = np.clip(self._elements.numbers(source, "rgba", fallback), 0.0, 1.0)
        return float(red), float(green), float(blue)

    def _read(self, name: str, geom: Item) -> Surface:
        item = self._meshes.get(name)
        if item is None:
            raise InputError(
                f"names the mesh {name!r}, which no asset defines",
                place=place_of(self._elements, geom),
                remedy="Correct the name, or add the mesh to the assets.",
            )
        place = place_of(self._elements, item)
        if item.has("builtin"):
            raise UnreadableMesh(
                f"the mesh {name!r} is made by the simulator ({item.text('builtin')}), and has no file",
                place=place,
                remedy="Write it to a mesh file, or use a primitive.",
            )
        if not item.has("vertex") and not item.text("file"):
            raise UnreadableMesh(
                f"the mesh {name!r} has no file: a plugin of the simulator makes it",
                place=place,
                remedy="Write it to a mesh file, or use a primitive.",
            )
        vertices, triangles = self._inline(item) if item.has("vertex") else self._file(item)
        position = self._elements.numbers(item, "refpos", (0.0, 0.0, 0.0))
        turn = rotation_of_quaternion(self._elements.numbers(item, "refquat", (1.0, 0.0, 0.0, 0.0)))
        scale = self._elements.numbers(item, "scale", (1.0, 1.0, 1.0))
        return scaled(((vertices - position) @ turn, triangles), scale, place)

    def _file(self, item: Item) -> Surface:
        compiler = self._elements.compiler
        file = PurePosixPath(item.text("file").replace("\\", "/"))
        name = file.name if compiler.strip_path else file.as_posix()
        reference = (PurePosixPath(compiler.mesh_folder) / name).as_posix()
        return self._library.surface(reference, place_of(self._elements, item))

    def _inline(self, item: Item) -> Surface:
        """A mesh whose corners stand in the model; without faces it is their convex hull."""
        place = place_of(self._elements, item)
        try:
            vertices = np.array(item.text("vertex").split(), dtype=np.float64).reshape(-1, 3)
            triangles = np.array(item.text("face").split(), dtype=np.int64).reshape(-1, 3)
        except ValueError as error:
            raise InputError("vertex and face must be numbers in threes", place=place) from error
        inside = not triangles.size or 0 <= triangles.min() <= triangles.max() < len(vertices)
        if not are_usable(vertices) or not inside:
            raise InputError("a face needs vertices that exist", place=place, remedy="Correct the mesh.")
        return (vertices, triangles) if triangles.size else self._hull(vertices, place)

    def _hull(self, vertices: Array, place: Place) -> Surface:
        hull = hull_surface(vertices)
        if hull is None:
            raise InputError("the corners of the mesh span no solid", place=place, remedy="Correct the mesh.")
        return hull
