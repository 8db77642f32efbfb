"""Mass and geometry of the parts of an import file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from contact_foundation.errors import CmbError, InputError
from lxml import etree

from cad2modelica.brep.step_model import StepModel, read_step_files
from cad2modelica.geometry.mesh import Mesh
from cad2modelica.geometry.spatial import Array
from cad2modelica.mechanism.mass_check import check_against_geometry, check_tensor
from cad2modelica.mechanism.mass_properties import NO_MASS, solid_mass
from cad2modelica.mechanism.model import MassProperties
from cad2modelica.meshio.mesh_files import read_mesh
from cad2modelica.simscape.elements import Elements
from cad2modelica.source.choices import SourceChoices
from cad2modelica.source.file_reference import resolve_inside
from cad2modelica.source.lost import Lost
from cad2modelica.source.number_limits import SMALLEST
from cad2modelica.source.units import to_si

STEP_ENDINGS = (".step", ".stp")
DEFAULT_COLOR = (0.7, 0.7, 0.7)


@dataclass(frozen=True, eq=False)
class PartContent:
    """Mass properties and meshes of a part, in its axes."""

    mass: MassProperties
    meshes: tuple[Mesh, ...]


class PartReader:
    """Reads the elements ``Part``, each once.

    Args:
        elements: reads numbers, receives problems.
        notes: receives doubts.
        choices: what becomes of parts without geometry or mass.
    """

    def __init__(self, elements: Elements, notes: list[str], choices: SourceChoices) -> None:
        self._elements = elements
        self._notes = notes
        self._choices = choices
        self._contents: dict[etree._Element, PartContent] = {}
        self._step: dict[Path, StepModel | InputError] = {}

    def read(self, parts: Iterable[etree._Element]) -> dict[etree._Element, PartContent]:
        """Mass and geometry of the parts; STEP files are read in one run of the CAD kernel."""
        distinct = list(dict.fromkeys(parts))
        files: dict[etree._Element, Path | CmbError] = {}
        for part in distinct:
            element = part.find("{*}GeometryFile")
            if element is not None and element.get("name"):
                files[part] = self._file(element)
        step = [file for file in files.values() if isinstance(file, Path) and file.suffix.lower() in STEP_ENDINGS]
        self._step = read_step_files(step, self._choices.tessellation)
        lost: dict[str, list[tuple[str, CmbError]]] = {}
        for part in distinct:
            meshes: tuple[Mesh, ...] = ()
            try:
                found = files.get(part)
                if isinstance(found, CmbError):
                    raise found
                if found is not None:
                    meshes = self._meshes(found, part)
            except CmbError as error:
                lost.setdefault(error.remedy or error.message, []).append((part.get("name", ""), error))
            self._contents[part] = self._content(part, meshes)
        self._report_lost(lost)
        return self._contents

    def _file(self, element: etree._Element) -> Path | CmbError:
        name = element.get("name", "").replace("\\", "/")
        place = self._elements.place(element)
        folders = (self._elements.file.parent, *self._choices.package_paths)
        failure: CmbError | None = None
        for folder in folders:
            try:
                return resolve_inside(folder, name, place)
            except InputError as error:
                failure = failure or error
        assert failure is not None
        return failure

    def _meshes(self, file: Path, part: etree._Element) -> tuple[Mesh, ...]:
        name, color = part.get("name", ""), _color(part)
        if file.suffix.lower() not in STEP_ENDINGS:
            vertices, triangles = read_mesh(file)
            return (Mesh(name, vertices * self._elements.units.mesh_length, triangles, color or DEFAULT_COLOR),)
        model = self._step[file]
        if isinstance(model, InputError):
            raise model
        if not model.occurrences:
            self._notes.append(Lost(f"part {name!r}: {file.name} holds no surface"))
        return tuple(
            Mesh(
                name,
                item.pose.point(item.shape.vertices),
                item.shape.triangles,
                color or item.color or item.shape.color or DEFAULT_COLOR,
            )
            for item in model.occurrences
        )

    def _report_lost(self, lost: dict[str, list[tuple[str, CmbError]]]) -> None:
        """Parts without their geometry: one problem, or one note each, for the same reason."""
        for found in lost.values():
            for name, error in found[:1] if not self._choices.allow_missing else found:
                if self._choices.allow_missing:
                    reason = error.message.strip().rstrip(".")
                    self._notes.append(Lost(f"part {name!r}: geometry left out: {reason}"))
                    continue
                more = f" (and {len(found) - 1} more geometry files)" if len(found) > 1 else ""
                remedy = f"{error.remedy or ''}\n  --allow-missing does without the geometry.".strip()
                self._elements.problems.record(InputError(error.message + more, place=error.place, remedy=remedy))

    def _content(self, part: etree._Element, meshes: tuple[Mesh, ...]) -> PartContent:
        name = part.get("name", "")
        element = part.find("{*}MassProperties")
        mass = (
            to_si(float(self._elements.numbers(element, "Mass", 1)[0]), self._elements.units.mass)
            if (element is not None)
            else 0.0
        )
        if element is None or mass == 0.0:
            if self._choices.density is not None and meshes:
                return PartContent(self._by_density(name, meshes, self._choices.density), meshes)
            return PartContent(NO_MASS, meshes)
        properties = MassProperties(mass, self._center(element), self._inertia(element))
        place = self._elements.place(element, name)
        if mass >= SMALLEST and not np.any(properties.inertia):
            self._notes.append(f"part {name!r} has a mass without inertia: it is taken as a point")
            return PartContent(properties, meshes)
        finding = check_tensor(properties)
        if finding is not None:
            self._elements.problems.add(finding.message, place, "Assign a material in the CAD system and export again.")
            return PartContent(properties, meshes)
        for doubt in check_against_geometry(properties, meshes) if meshes else ():
            if doubt.wrong:
                self._elements.problems.add(doubt.message, place, doubt.remedy)
            else:
                self._notes.append(f"part {name!r}: {doubt.message}")
        return PartContent(properties, meshes)

    def _center(self, element: etree._Element) -> Array:
        return to_si(self._elements.numbers(element, "CenterOfMass", 3), self._elements.units.length)

    def _inertia(self, element: etree._Element) -> Array:
        """About the centre of mass in the part's axes: xx, yy, zz, yz, zx, xy, elements of the tensor.

        That products are the tensor's elements is seen on exports of four systems, against integrals over the geometry.
        """
        xx, yy, zz, yz, zx, xy = self._elements.numbers(element, "Inertia", 6)
        tensor = np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])
        units = self._elements.units
        return to_si(to_si(to_si(tensor, units.length), units.length), units.mass)

    def _by_density(self, name: str, meshes: tuple[Mesh, ...], density: float) -> MassProperties:
        found, closed = solid_mass(meshes, density)
        doubt = "" if closed else "; its geometry is not closed, and the hull was taken"
        self._notes.append(
            f"part {name!r} has the mass {found.mass:.4g} kg of its geometry with {density:g} kg/m3{doubt}"
        )
        return found


def placed_meshes(meshes: Iterable[Mesh], position: Array, rotation: Array) -> tuple[Mesh, ...]:
    """Meshes in the axes that theirs have the pose in."""
    return tuple(replace(mesh, vertices=mesh.vertices @ rotation.T + position) for mesh in meshes)


def _color(part: etree._Element) -> tuple[float, float, float] | None:
    element = part.find("{*}VisualProperties/{*}Diffuse")
    if element is None:
        return None
    try:
        red, green, blue = (float(element.get(key, "")) for key in "rgb")
    except ValueError:
        return None
    if not all(0.0 <= value <= 1.0 for value in (red, green, blue)):
        return None
    return red, green, blue
