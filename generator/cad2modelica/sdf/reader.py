"""SDFormat to the model: models and worlds, links, joints, geometry, surfaces, at joint position zero.

The format of Gazebo as sdformat.org specifies it, versions 1.2 to 1.12.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import networkx as nx
from contact_foundation.progress import Progress, silent
from lxml import etree

from cad2modelica.geometry.spatial import IDENTITY, Array, Pose
from cad2modelica.mechanism.description_defaults import DECOMPOSED_TRIANGLES, GRAVITY
from cad2modelica.mechanism.model import GROUND, Assembly, ContactSettings, DecompositionLimits
from cad2modelica.sdf.document import SdfDocument
from cad2modelica.sdf.joints import JointReader, joint_name
from cad2modelica.sdf.parts import Host, PartReader, SdfParts
from cad2modelica.sdf.scopes import Link, Scope, UnknownFrame
from cad2modelica.source.choices import DEFAULT_CHOICES, SourceChoices
from cad2modelica.source.lost import Lost
from cad2modelica.source.problems import Problems

WORLD_GRAVITY = (0.0, 0.0, -9.8)
"""Of a world that says nothing, m/s2: the format's default."""
FRICTION_RULE = "minimum"
"""Gazebo takes the smaller of two coefficients of friction."""


def read_sdf(
    root: etree._Element, path: Path, progress: Progress = silent, choices: SourceChoices = DEFAULT_CHOICES
) -> Assembly:
    """Reads a model or a world.

    Args:
        root: the element ``sdf``.
        path: the file.
        progress: is told which link is being read.
        choices: where models and meshes may lie, and what becomes of those that cannot be read.

    Raises:
        InputError: the input is wrong; a ``ProblemList`` if several problems were found.
    """
    problems = Problems(str(path))
    notes: list[str] = []
    scope = SdfDocument(problems, notes, choices).read(root, path)
    problems.raise_if_any()
    links = scope.all_links()
    hosts, standing = _hosts(scope, links, problems)
    problems.raise_if_any()
    parts = PartReader(links, hosts, problems, notes, choices).read(standing, progress)
    reader = JointReader({name: parts.names[host.part] for name, host in hosts.items()}, GROUND, notes)
    for inner in scope.all_scopes():
        for element in inner.joints.values():
            reader.read(inner, element)
    reader.follow()
    problems.raise_if_any()
    _note_groups(links, hosts, notes)
    joints = reader.found
    if not any(not part.grounded for part in parts.parts.values()):
        problems.add("holds no link that moves", scope.elements.place(root), "Models that are static stand.")
        problems.raise_if_any()
    return Assembly(
        name=_name(root, scope, path),
        source="SDFormat",
        file=path,
        gravity=_gravity(scope, notes),
        materials=tuple(parts.materials.values()),
        planes=tuple(parts.planes),
        parts=(*parts.parts.values(), *joints.between),
        joints=tuple(joints.joints),
        contacts=ContactSettings(
            excluded=tuple(_excluded(links, hosts, parts)),
            decomposition=DecompositionLimits(triangles=DECOMPOSED_TRIANGLES),
            friction_rule=FRICTION_RULE,
        ),
        notes=tuple(notes),
        limits_stop=True,
        couplings=tuple(joints.couplings),
        aliases={name: parts.names[host.part] for name, host in hosts.items() if name not in parts.parts},
    )


def _gravity(scope: Scope, notes: list[str]) -> Array:
    """Of the world: the format's default if it says nothing. Before 1.6 it stood among the settings of the physics.

    Models that stand in no world have the gravity of all descriptions without one.
    """
    elements, world = scope.elements, scope.element
    inside = world.find("physics/gravity") is not None
    if world.find("gravity") is None and inside and elements.version < (1, 6):
        return elements.numbers(world, "physics/gravity", WORLD_GRAVITY)
    if inside:
        notes.append(Lost("the gravity in the element physics is left out: since 1.6 that of the world counts"))
    return elements.numbers(world, "gravity", GRAVITY if world.getparent() is None else WORLD_GRAVITY)


def _name(root: etree._Element, scope: Scope, path: Path) -> str:
    model = root.find("model")
    source = model if model is not None else scope.element
    return source.get("name", "") or path.stem


def _hosts(scope: Scope, links: Sequence[Link], problems: Problems) -> tuple[dict[str, Host], set[str]]:
    """Where every link belongs, and the names of parts that stand in the world.

    Links that fixed joints hold together are one part, which has the name of the first; but links of static models are
    parts of their own.
    """
    fixed: nx.Graph[str] = nx.Graph()
    fixed.add_nodes_from(link.name for link in links)
    standing = {link.name for link in links if link.is_static}
    for inner in scope.all_scopes():
        for element in inner.joints.values():
            if element.get("type") != "fixed":
                continue
            try:
                ends = [inner.link(inner.elements.text(element, end)) for end in ("parent", "child")]
            except UnknownFrame as missing:
                name = joint_name(inner, element)
                place = inner.elements.place(element)
                problems.add(f"the joint {name!r} names {missing}, which does not exist", place, "Correct it.")
                continue
            names = [link.name for link in ends if link is not None]
            if len(names) == 2 and not {*names} <= standing:
                fixed.add_edge(*names)
            standing |= set(names) if len(names) == 1 else set()
    order = {link.name: number for number, link in enumerate(links)}
    by_name = {link.name: link for link in links}
    hosts: dict[str, Host] = {}
    grounded: set[str] = set()
    for group in nx.connected_components(fixed):
        members = sorted(group, key=order.__getitem__)
        try:
            poses = {name: _world_pose(by_name[name]) for name in members}
        except UnknownFrame as missing:
            link = by_name[members[0]]
            place = link.scope.elements.place(link.element)
            problems.add(f"a pose of {link.name!r} names {missing}, which does not exist", place, "Correct the name.")
            continue
        first = members[0]
        if any(name in standing for name in members):
            grounded.add(first)
        for name in members:
            inner_pose = poses[first].inverse() @ poses[name] if name != first else IDENTITY
            hosts[name] = Host(first, inner_pose, poses[name])
    return hosts, grounded


def _world_pose(link: Link) -> Pose:
    return link.scope.world_pose() @ link.scope.frame(link.element.get("name", ""))


def _note_groups(links: Sequence[Link], hosts: dict[str, Host], notes: list[str]) -> None:
    groups: dict[str, list[str]] = {}
    for link in links:
        host = hosts[link.name].part
        if host != link.name:
            groups.setdefault(host, []).append(link.name)
    for host, others in groups.items():
        notes.append(f"fixed to {host!r} and one body with it: {', '.join(repr(name) for name in others)}")


def _excluded(links: Sequence[Link], hosts: dict[str, Host], parts: SdfParts) -> list[tuple[str, str]]:
    """Pairs that do not touch: links of one model that do not collide with their like, and bits that do not match."""
    models: dict[str, set[int]] = {}
    selves: set[str] = set()
    for link in links:
        host = parts.names[hosts[link.name].part]
        models.setdefault(host, set()).add(id(_outermost(link.scope)))
        if link.collides_itself:
            selves.add(host)
    names = [name for name in (*parts.parts, *(plane.name for plane in parts.planes)) if name in parts.surfaces]
    bits = {name: [surface.bits for surface in parts.surfaces[name]] for name in names}
    return [
        (first, second)
        for number, first in enumerate(names)
        for second in names[number + 1 :]
        if not any(a & b for a in bits[first] for b in bits[second])
        or (models.get(first, set()) & models.get(second, set()) and not {first, second} & selves)
    ]


def _outermost(scope: Scope) -> Scope:
    """The model below the world that a scope belongs to."""
    while scope.parent is not None and scope.parent.parent is not None:
        scope = scope.parent
    return scope
