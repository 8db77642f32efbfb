"""Reading ``scene.json``: bodies with geometry and mass, joints and contact pairs (docs/architecture.md)."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from contact_foundation.errors import InputError, Place
from numpy.typing import NDArray

from fmu_regression.results.result import FloatArray

_FORMAT = 1
_MAX_BYTES = 500_000_000
_MAX_BODIES = 10_000
_MAX_VERTICES = 5_000_000


@dataclass(frozen=True)
class Mesh:
    """A triangle mesh in the axes of its body's frame_a.

    Attributes:
        name: the name in CAD.
        vertices: shape (v, 3), m.
        triangles: shape (t, 3), indices into vertices, counter-clockwise seen from outside.
        color: red, green, blue from 0 to 1.
    """

    name: str
    vertices: FloatArray
    triangles: NDArray[np.uint32]
    color: tuple[float, float, float]


@dataclass(frozen=True)
class SceneBody:
    """A rigid body.

    Attributes:
        name: Modelica name.
        label: name for people.
        variable: prefix of its variables in the result.
        fixed: whether it never moves.
        position: shape (3,), start position of its frame, m.
        rotation: shape (3, 3), start rotation T: v_body = T v_world.
        mass: kg.
        center_of_mass: shape (3,), from its frame, body axes, m.
        inertia: shape (3, 3), about the centre of mass, body axes, kg m2.
        meshes: its geometry; may be empty.
        frame: that contacts see it in, "frame_a" or "frame_b".
    """

    name: str
    label: str
    variable: str
    fixed: bool
    position: FloatArray
    rotation: FloatArray
    mass: float
    center_of_mass: FloatArray
    inertia: FloatArray
    meshes: tuple[Mesh, ...]
    frame: str = "frame_a"


@dataclass(frozen=True)
class SceneJoint:
    """A joint coordinate: the variable, its rate and the unit of the variable ("rad" or "m")."""

    name: str
    kind: str
    variable: str
    rate: str
    unit: str


@dataclass(frozen=True)
class ContactPair:
    """A pair of bodies that may touch.

    Attributes:
        index: its 1-based number in the manager's arrays.
        bodies: names of the two; forces are those on the first.
        restitution: coefficient of restitution asked for, or None.
    """

    index: int
    bodies: tuple[str, str]
    restitution: float | None


def drawn_force_sign(scene: Scene, pair: ContactPair) -> float:
    """What turns a force on a pair's first body into the one to be drawn: on the body that moves, if only one does."""
    fixed = {body.name: body.fixed for body in scene.bodies}
    first, second = pair.bodies
    return -1.0 if fixed[first] and not fixed[second] else 1.0


@dataclass(frozen=True)
class Scene:
    """A mechanism: what moves, how it is joined and what may touch.

    Attributes:
        name: of the mechanism.
        gravity: shape (3,), m/s2.
        bodies, joints, pairs: in the file's order.
        manager: prefix of the contact manager's variables, or "" without contacts.
        colliders: names of the manager's bodies in its order, where it tells forces of bodies instead of pairs; there
            are no pairs then.
    """

    name: str
    gravity: FloatArray
    bodies: tuple[SceneBody, ...]
    joints: tuple[SceneJoint, ...] = ()
    pairs: tuple[ContactPair, ...] = ()
    manager: str = ""
    colliders: tuple[str, ...] = ()

    def label(self, body: str) -> str:
        """The label of the body of a name; the name itself if there is none."""
        return next((b.label for b in self.bodies if b.name == body), body)

    def pair_label(self, pair: ContactPair) -> str:
        """Text for a pair, e.g. "head – anvil"."""
        return f"{self.label(pair.bodies[0])} – {self.label(pair.bodies[1])}"


def load_scene(path: Path) -> Scene:
    """Reads a scene file.

    Raises:
        InputError: the file is missing, no JSON, of another format, or a value has the wrong type, shape or range;
            the place in the file is named.
    """
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise InputError("the file is too large to be a scene", place=Place(file=path))
        with path.open(encoding="utf-8") as stream:
            raw = json.load(stream, parse_constant=_no_constant)
    except OSError as error:
        raise InputError(f"cannot read: {error.strerror}", place=Place(file=path)) from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"not a JSON file: {error}", place=Place(file=path)) from error
    return _Reader(path).scene(raw)


def _no_constant(text: str) -> NoReturn:
    raise ValueError(f"{text} is not a number of JSON")


class _Reader:
    """Turns parsed JSON into a Scene; every error names the path of keys to the value."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def scene(self, raw: Any) -> Scene:
        top = self._object(raw, "scene")
        if top.get("format") != _FORMAT:
            self._wrong("format", f"is {top.get('format')!r}, this program reads format {_FORMAT}")
        bodies = tuple(
            self._body(item, f"bodies[{k}]") for k, item in enumerate(self._list(top, "bodies", "", _MAX_BODIES))
        )
        names = [body.name for body in bodies]
        for name in names:
            if names.count(name) > 1:
                self._wrong("bodies", f"has the name {name!r} twice")
        contacts = self._object(top.get("contacts") or {}, "contacts")
        by_body = "bodies" in contacts
        pairs = tuple(
            self._pair(item, f"contacts.pairs[{k}]", names)
            for k, item in enumerate(self._list(contacts, "pairs", "contacts.") if contacts and not by_body else [])
        )
        colliders = self._list(contacts, "bodies", "contacts.", _MAX_BODIES) if by_body else []
        if by_body and "pairs" in contacts:
            self._wrong("contacts", "has pairs and bodies: a manager tells the forces of one or the other")
        for k, collider in enumerate(colliders):
            if collider not in names:
                self._wrong(f"contacts.bodies[{k}]", "does not name a body of the scene")
        return Scene(
            name=self._text(top, "name", ""),
            gravity=self._array(top.get("gravity"), (3,), "gravity"),
            bodies=bodies,
            joints=tuple(
                self._joint(item, f"joints[{k}]")
                for k, item in enumerate(self._list(top, "joints", "") if "joints" in top else [])
            ),
            pairs=pairs,
            manager=self._text(contacts, "manager", "contacts.") if contacts else "",
            colliders=tuple(str(collider) for collider in colliders),
        )

    def _body(self, raw: Any, where: str) -> SceneBody:
        item = self._object(raw, where)
        prefix = f"{where}."
        rotation = self._array(item.get("rotation"), (3, 3), f"{prefix}rotation")
        if np.abs(rotation @ rotation.T - np.eye(3)).max() > 1e-6 or np.linalg.det(rotation) < 0:
            self._wrong(f"{prefix}rotation", "is not a rotation matrix")
        fixed = item.get("fixed", False)
        if not isinstance(fixed, bool):
            self._wrong(f"{prefix}fixed", "is not true or false")
        name = self._text(item, "name", prefix)
        mass = self._number(item.get("mass", 0.0), f"{prefix}mass")
        if mass < 0:
            self._wrong(f"{prefix}mass", "is negative")
        return SceneBody(
            name=name,
            label=str(item.get("label") or name),
            variable=str(item.get("variable") or name),
            fixed=fixed,
            position=self._array(item.get("position"), (3,), f"{prefix}position"),
            rotation=rotation,
            mass=mass,
            center_of_mass=self._array(item.get("centerOfMass", [0, 0, 0]), (3,), f"{prefix}centerOfMass"),
            inertia=self._array(item.get("inertia", np.zeros((3, 3)).tolist()), (3, 3), f"{prefix}inertia"),
            meshes=tuple(
                self._mesh(mesh, f"{prefix}meshes[{k}]")
                for k, mesh in enumerate(self._list(item, "meshes", prefix) if "meshes" in item else [])
            ),
        )

    def _mesh(self, raw: Any, where: str) -> Mesh:
        item = self._object(raw, where)
        vertices = self._array(item.get("vertices"), (None, 3), f"{where}.vertices")
        if len(vertices) > _MAX_VERTICES:
            self._wrong(f"{where}.vertices", f"has more than {_MAX_VERTICES} entries")
        triangles = self._array(item.get("triangles"), (None, 3), f"{where}.triangles")
        if triangles.size and (
            (triangles != np.floor(triangles)).any() or triangles.min() < 0 or triangles.max() >= len(vertices)
        ):
            self._wrong(f"{where}.triangles", f"has an index outside 0 to {len(vertices) - 1}")
        color = self._array(item.get("color", [0.6, 0.65, 0.7]), (3,), f"{where}.color")
        if (color < 0).any() or (color > 1).any():
            self._wrong(f"{where}.color", "is not between 0 and 1")
        return Mesh(
            name=str(item.get("name", "")),
            vertices=vertices,
            triangles=triangles.astype(np.uint32),
            color=(float(color[0]), float(color[1]), float(color[2])),
        )

    def _joint(self, raw: Any, where: str) -> SceneJoint:
        item = self._object(raw, where)
        prefix = f"{where}."
        return SceneJoint(
            name=self._text(item, "name", prefix),
            kind=self._text(item, "type", prefix),
            variable=self._text(item, "variable", prefix),
            rate=str(item.get("rate") or ""),
            unit=str(item.get("unit") or ""),
        )

    def _pair(self, raw: Any, where: str, names: Sequence[str]) -> ContactPair:
        item = self._object(raw, where)
        index = item.get("index")
        if not isinstance(index, int) or isinstance(index, bool) or index < 1:
            self._wrong(f"{where}.index", "is not a positive whole number")
        bodies = item.get("bodies")
        if not isinstance(bodies, list) or len(bodies) != 2 or not all(b in names for b in bodies):
            self._wrong(f"{where}.bodies", "does not name two bodies of the scene")
        restitution = item.get("restitution")
        return ContactPair(
            index=index,
            bodies=(str(bodies[0]), str(bodies[1])),
            restitution=None if restitution is None else self._number(restitution, f"{where}.restitution"),
        )

    def _object(self, raw: Any, where: str) -> dict[str, Any]:
        if not isinstance(raw, dict):
            self._wrong(where, "is not an object")
        return raw

    def _list(self, item: dict[str, Any], key: str, prefix: str, limit: int = 100_000) -> list[Any]:
        value = item.get(key)
        if not isinstance(value, list):
            self._wrong(f"{prefix}{key}", "is not a list")
        if len(value) > limit:
            self._wrong(f"{prefix}{key}", f"has more than {limit} entries")
        return value

    def _text(self, item: dict[str, Any], key: str, prefix: str) -> str:
        value = item.get(key)
        if not isinstance(value, str) or not value:
            self._wrong(f"{prefix}{key}", "is not a text")
        return value

    def _number(self, value: Any, where: str) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            self._wrong(where, "is not a number")
        return float(value)

    def _array(self, value: Any, shape: tuple[int | None, ...], where: str) -> FloatArray:
        try:
            array = np.array(value, dtype=np.float64)
        except (TypeError, ValueError):
            self._wrong(where, f"is not an array of numbers of shape {_shape_text(shape)}")
        if array.size == 0 and shape[0] is None:
            return np.empty((0, *(n or 0 for n in shape[1:])))
        if len(array.shape) != len(shape) or any(
            n is not None and n != m for n, m in zip(shape, array.shape, strict=True)
        ):
            self._wrong(where, f"has shape {_shape_text(array.shape)} instead of {_shape_text(shape)}")
        if not np.isfinite(array).all():
            self._wrong(where, "has a value that is not finite")
        return array

    def _wrong(self, where: str, what: str) -> NoReturn:
        raise InputError(f"{where} {what}", place=Place(file=self._path))


def _shape_text(shape: Sequence[int | None]) -> str:
    return "x".join("n" if n is None else str(n) for n in shape)
