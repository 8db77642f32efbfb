"""Models with the frames in them: where links, joints, frames and nested models stand in the world.

Semantics of poses: sdformat.org, "Pose frame semantics" of SDFormat 1.7 and later; what earlier versions mean follows
from the same rules with their defaults.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from lxml import etree

from cad2modelica.geometry.spatial import IDENTITY, Pose
from cad2modelica.meshio.mesh_library import MeshLibrary
from cad2modelica.sdf.elements import SdfElements

MODEL_FRAME = "__model__"
WORLD = "world"
SEPARATOR = "::"


class UnknownFrame(Exception):  # the caller knows the place, and words the error
    """A frame that does not exist, or stands in itself; the text is its name."""


@dataclass(frozen=True, eq=False)
class Link:
    """A link of a model.

    Attributes:
        name: with the names of the models around it, as the format writes them.
    """

    name: str
    element: etree._Element
    scope: Scope
    is_static: bool
    collides_itself: bool


@dataclass(eq=False)
class Scope:
    """A model, or the world.

    Attributes:
        name: of the model, with those around it; empty for the world and for a model that stands alone.
        element: the element ``model`` or ``world``.
        elements: reads attributes of its file.
        library: reads mesh files for its file.
        parent: the scope around it.
        placed: the pose as given, of the placement frame, in the frame that it names.
        relative_to: that frame, in the parent scope.
        placement: the frame of the model that the pose places; its own frame if empty.
        merged: whether its contents belong to the parent's names too.
    """

    name: str
    element: etree._Element
    elements: SdfElements
    library: MeshLibrary
    parent: Scope | None
    placed: Pose
    relative_to: str
    placement: str
    is_static: bool
    merged: bool = False
    links: dict[str, Link] = field(default_factory=dict)
    joints: dict[str, etree._Element] = field(default_factory=dict)
    frames: dict[str, etree._Element] = field(default_factory=dict)
    models: dict[str, Scope] = field(default_factory=dict)
    _poses: dict[str, Pose] = field(default_factory=dict)
    _busy: set[str] = field(default_factory=set)

    def world_pose(self) -> Pose:
        """The model's own frame in the world.

        Raises:
            UnknownFrame: a frame on the way does not exist.
        """
        if self.parent is None:
            return self.placed
        return self.parent.world_pose() @ self.parent.frame(self._own_key())

    def frame(self, name: str) -> Pose:
        """The pose of what a name means, in this model's frame.

        Raises:
            UnknownFrame: it does not exist, or stands in itself.
        """
        if name in (MODEL_FRAME, ""):
            return IDENTITY
        if name == WORLD and self.parent is None:
            return self.placed.inverse()
        if name not in self._poses:
            if name in self._busy:
                raise UnknownFrame(f"{name}, which stands in itself")
            self._busy.add(name)
            try:
                self._poses[name] = self._resolved(name)
            finally:
                self._busy.discard(name)
        return self._poses[name]

    def _resolved(self, name: str) -> Pose:
        first, separator, rest = name.partition(SEPARATOR)
        if separator and first in self.models:
            return self.frame(first) @ self.models[first].frame(rest)
        if name in self.links:
            return self._given(self.links[name].element, MODEL_FRAME)
        if name in self.joints:
            element = self.joints[name]
            return self._given(element, self.elements.text(element, "child"))
        if name in self.frames:
            element = self.frames[name]
            return self._given(element, element.get("attached_to", "") or MODEL_FRAME)
        if name in self.models:
            model = self.models[name]
            outer = self.frame(model.relative_to or MODEL_FRAME) @ model.placed
            return outer @ model.frame(model.placement or MODEL_FRAME).inverse()
        for key, model in self.models.items():
            if model.merged and model.holds(name):
                return self.frame(key) @ model.frame(name)
        if self.merged and self.parent is not None:
            return self.parent.frame(self._own_key()).inverse() @ self.parent.frame(name)
        raise UnknownFrame(name)

    def _given(self, element: etree._Element, default: str) -> Pose:
        """The pose of an element of this model, in the model's frame."""
        return self.frame(self.elements.relative_to(element) or default) @ self.elements.pose(element)

    def holds(self, name: str) -> bool:
        """Whether a name is one of this model's own."""
        return any(name in names for names in (self.links, self.joints, self.frames, self.models))

    def link(self, name: str) -> Link | None:
        """The link that a name means: its own, a nested model's, or the one that a frame is attached to; None: world.

        Raises:
            UnknownFrame: there is none.
        """
        return self._link(name, 0)

    def _link(self, name: str, depth: int) -> Link | None:
        if depth > len(self.frames) + len(self.models) + 64:
            raise UnknownFrame(f"{name}, which is attached to itself")
        if name == WORLD:
            return None
        first, separator, rest = name.partition(SEPARATOR)
        if name in self.links:
            return self.links[name]
        if separator and first in self.models:
            return self.models[first]._link(rest, depth + 1)
        if name in self.frames:
            attached = self.frames[name].get("attached_to", "") or MODEL_FRAME
            return self._link(attached, depth + 1)
        if name in self.joints:
            return self._link(self.elements.text(self.joints[name], "child"), depth + 1)
        if name == MODEL_FRAME:
            return self._canonical(depth)
        if name in self.models:
            return self.models[name]._link(MODEL_FRAME, depth + 1)
        for model in self.models.values():
            if model.merged and model.holds(name):
                return model._link(name, depth + 1)
        if self.merged and self.parent is not None:
            return self.parent._link(name, depth + 1)
        raise UnknownFrame(name)

    def _canonical(self, depth: int) -> Link | None:
        """The link that a model's own frame is attached to; the world for the world's."""
        if self.element.tag == WORLD:
            return None
        given = self.element.get("canonical_link", "")
        if given:
            return self._link(given, depth + 1)
        if self.links:
            return next(iter(self.links.values()))
        for model in self.models.values():
            return model._link(MODEL_FRAME, depth + 1)
        raise UnknownFrame(MODEL_FRAME)

    def _own_key(self) -> str:
        """The name under which the parent has this model."""
        if self.parent is None:
            raise AssertionError("the outermost scope is no model of another")
        return next(key for key, model in self.parent.models.items() if model is self)

    def all_links(self) -> list[Link]:
        """Links of this model and those in it."""
        found = list(self.links.values())
        for model in self.models.values():
            found += model.all_links()
        return found

    def all_scopes(self) -> list[Scope]:
        """This model and those in it."""
        return [self, *(scope for model in self.models.values() for scope in model.all_scopes())]
