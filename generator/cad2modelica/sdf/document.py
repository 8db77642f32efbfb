"""Files of SDFormat: models and worlds, with those that they include."""

from __future__ import annotations

from pathlib import Path

from contact_foundation.errors import CmbError, InputError, Place
from lxml import etree

from cad2modelica.geometry.spatial import IDENTITY
from cad2modelica.meshio.mesh_library import MeshLibrary
from cad2modelica.meshio.mesh_reference import MeshReferences
from cad2modelica.sdf.elements import SdfElements
from cad2modelica.sdf.scopes import SEPARATOR, WORLD, Link, Scope
from cad2modelica.source.choices import SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.source.problems import Problems
from cad2modelica.source.xml_document import read_xml

MOST_MODELS = 5000
DEEPEST = 16
CONFIGURATION = "model.config"
MODEL_FILE = "model.sdf"
_SILENT = frozenset(
    (
        "light", "gui", "physics", "scene", "atmosphere", "magnetic_field", "spherical_coordinates", "state", "road",
        "wind", "audio", "gravity", "pose", "static", "self_collide", "allow_auto_disable", "enable_wind", "name",
    )
)  # fmt: skip
_LOST = ("plugin", "actor", "population", "gripper")


class SdfDocument:
    """Builds the scopes of a description.

    Args:
        problems: receives what is wrong.
        notes: receives what was left out.
        choices: where files may lie.
    """

    def __init__(self, problems: Problems, notes: list[str], choices: SourceChoices) -> None:
        self._problems = problems
        self._notes = notes
        self._choices = choices
        self._models = 0
        self._lost: dict[str, int] = {}

    def read(self, root: etree._Element, path: Path) -> Scope:
        """The outermost scope of a file: its world, or a world around its models.

        Raises:
            InputError: the file holds neither.
        """
        elements = self._elements(root, path)
        world = root.find(WORLD)
        if world is not None and root.findall(WORLD)[1:]:
            self._notes.append(Lost(f"of {len(root.findall(WORLD))} worlds the first is read"))
        holder = world if world is not None else root
        scope = Scope(
            name="",
            element=holder if world is not None else etree.Element(WORLD),
            elements=elements,
            library=self._library(path),
            parent=None,
            placed=IDENTITY,
            relative_to="",
            placement="",
            is_static=False,
        )
        self._fill(scope, holder, 0)
        for tag, count in self._lost.items():
            self._notes.append(Lost(f"left out: {count} elements {tag!r}"))
        if not scope.models and not scope.links:
            place = Place(file=path)
            self._problems.add("holds no model", place, "Name a file with a model or a world.")
        return scope

    def _elements(self, root: etree._Element, path: Path) -> SdfElements:
        text = root.get("version", "1.4")
        major, _, minor = text.partition(".")
        try:
            version = (int(major), int(minor.split(".")[0] or 0))
        except ValueError:
            version = (0, 0)
        if not (1, 2) <= version <= (1, 12):
            self._problems.add(
                f"is SDFormat {text!r}", Place(file=path), "Versions 1.2 to 1.12 are read; gz sdf -p converts others."
            )
        return SdfElements(path, version, self._problems, self._notes)

    def _library(self, path: Path) -> MeshLibrary:
        return MeshLibrary(MeshReferences(path, self._choices.package_paths))

    # ----- contents of a model or a world -----

    def _fill(self, scope: Scope, element: etree._Element, depth: int) -> None:
        handlers = {"link": self._add_link, "joint": self._add_named, "frame": self._add_named}
        for child in element.iterchildren():
            tag = str(child.tag)
            if tag in handlers:
                handlers[tag](scope, child)
            elif tag == "model":
                self._add_model(scope, child, child, scope.elements, scope.library, depth)
            elif tag == "include":
                self._include(scope, child, depth)
            elif tag in _LOST or (tag not in _SILENT and "}" not in tag and ":" not in tag and tag != "world"):
                self._lost[tag] = self._lost.get(tag, 0) + 1

    def _add_link(self, scope: Scope, element: etree._Element) -> None:
        name = element.get("name", "")
        if self._is_taken(scope, name, element):
            return
        elements = scope.elements
        own = elements.flag(element, "self_collide", elements.flag(scope.element, "self_collide"))
        scope.links[name] = Link(_joined(scope.name, name), element, scope, scope.is_static, own)

    def _add_named(self, scope: Scope, element: etree._Element) -> None:
        name = element.get("name", "")
        if not self._is_taken(scope, name, element):
            (scope.joints if element.tag == "joint" else scope.frames)[name] = element

    def _is_taken(self, scope: Scope, name: str, element: etree._Element) -> bool:
        known = scope.links if element.tag == "link" else scope.joints if element.tag == "joint" else scope.frames
        if name and name not in known:
            return False
        place = scope.elements.place(element)
        self._problems.add(f"a {element.tag} needs a name of its own; {name!r} is not", place, "Rename it.")
        return True

    def _add_model(
        self,
        scope: Scope,
        element: etree._Element,
        placing: etree._Element,
        elements: SdfElements,
        library: MeshLibrary,
        depth: int,
    ) -> None:
        """Adds a model that stands in a scope; ``placing`` is the element that says where, an include or itself."""
        outer = scope.elements
        own_name = element.get("name", "")
        name = outer.text(placing, "name", own_name) if placing is not element else own_name
        place = outer.place(placing)
        self._models += 1
        if not name or name in scope.models:
            self._problems.add(f"a model needs a name of its own; {name!r} is not", place, "Rename the model.")
            return
        if self._models > MOST_MODELS or depth > DEEPEST:
            self._problems.add(f"more than {MOST_MODELS} models, or nested deeper than {DEEPEST}", place, "Split it.")
            return
        source = placing if placing.find("pose") is not None else element
        where = outer if source is placing else elements
        static = elements.flag(element, "static")
        static = outer.flag(placing, "static", static) if placing is not element else static
        alone = scope.element.tag == WORLD and scope.element.getparent() is None and len(scope.models) == 0
        model = Scope(
            name=_joined(scope.name, name),
            element=element,
            elements=elements,
            library=library,
            parent=scope,
            placed=where.pose(source),
            relative_to=where.relative_to(source) if source is placing else "",
            placement=placing.get("placement_frame", "") or element.get("placement_frame", ""),
            is_static=static or scope.is_static,
            merged=placing is not element and placing.get("merge", "false") in ("true", "1"),
        )
        if placing is not element and outer.text(placing, "placement_frame"):
            model.placement = outer.text(placing, "placement_frame")
        if model.merged or (alone and placing is element):
            model.name = scope.name
        scope.models[name] = model
        self._fill(model, element, depth + 1)

    # ----- included files -----

    def _include(self, scope: Scope, element: etree._Element, depth: int) -> None:
        place = scope.elements.place(element)
        uri = scope.elements.text(element, "uri")
        try:
            file = self._file(scope.elements.file, uri, place)
            root = read_xml(file)
        except CmbError as error:
            if self._choices.allow_missing:
                self._notes.append(Lost(f"the model {uri!r} is left out: {error.message}"))
            else:
                remedy = f"{error.remedy or ''}\n  --allow-missing does without the model.".strip()
                self._problems.record(InputError(error.message, place=error.place, remedy=remedy))
            return
        if etree.QName(root).localname != "sdf":
            self._problems.add(f"includes {uri!r}, which is no SDFormat", place, "Name a model of SDFormat.")
            return
        inner = self._elements(root, file)
        models = root.findall("model")
        if not models:
            self._problems.add(f"includes {uri!r}, which holds no model", place, "Name a file with a model.")
        for model in models[:1]:
            self._add_model(scope, model, element, inner, self._library(file), depth)

    def _file(self, including: Path, uri: str, place: Place) -> Path:
        """The file of a model: what a URI names, or the one that its folder's ``model.config`` names."""
        if uri.startswith(("http://", "https://")):
            raise InputError(
                f"includes {uri!r}; nothing is fetched from the network",
                place=place,
                remedy="Save the model beside the file and write model://NAME.",
            )
        references = MeshReferences(including, self._choices.package_paths)
        if uri.lower().endswith((".sdf", ".world", ".xml")):
            return references.find(uri, place)
        folder = uri.rstrip("/")
        wanted = folder.replace("\\", "/").rpartition("/")[2]

        def inside(name: str) -> Path:
            """A file of the model's folder; files of that name may lie elsewhere."""
            file = references.find(f"{folder}/{name}", place)
            if file.resolve().parent.name != wanted:
                raise InputError(
                    f"names the model {wanted!r}, which does not exist: no folder of that name lies beside "
                    f"{including.name}, or above it",
                    place=place,
                    remedy=f"Name the folder that holds the folder {wanted}: --package-path FOLDER",
                )
            return file

        try:
            configuration = read_xml(inside(CONFIGURATION))
        except CmbError as error:
            try:
                return inside(MODEL_FILE)
            except CmbError:
                raise error from None
        named = [item for item in configuration.findall("sdf") if (item.text or "").strip()]
        best = max(named, key=_version_of, default=None)
        return references.find(f"{folder}/{(best.text or '').strip() if best is not None else MODEL_FILE}", place)


def _version_of(element: etree._Element) -> tuple[int, ...]:
    """The version of a model's file, up to the newest that is read."""
    words = element.get("version", "0").split(".")
    version = tuple(int(word) if word.isdigit() else 0 for word in words)
    return version if version <= (1, 12) else (0,)


def _joined(outer: str, inner: str) -> str:
    return f"{outer}{SEPARATOR}{inner}" if outer else inner
