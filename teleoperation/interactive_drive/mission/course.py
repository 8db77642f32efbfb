"""A machine's assembly with the boxes of a course around it, as a folder that is generated and built as any other."""

from __future__ import annotations

import math
import shutil
from pathlib import Path

from contact_foundation.errors import InputError, Place
from lxml import etree

from interactive_drive.mission.mission_file import Mission, Obstacle

GEOMETRY = "course.wrl"
_NAMESPACE = "urn:contactmultibody:assembly:1"
_MILLI = 1e3
_GOAL = "goalMark"
_GREEN = (0.2, 0.7, 0.3)


def write_course(mission: Mission, assembly: Path, folder: Path) -> Path:
    """Writes assembly, geometry, the modeller's packages and the experiment of a mission to a folder.

    Args:
        mission: with an assembly.
        assembly: its file, in millimetres.
        folder: to write to; what it holds is replaced.

    Returns:
        The assembly's file in the folder.

    Raises:
        InputError: the assembly has none of the parts or materials that the mission names.
    """
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(assembly.parent, folder, ignore=shutil.ignore_patterns("*.py", "*.md", "experiment.toml"))
    tree = etree.parse(folder / assembly.name)
    root = tree.getroot()
    units, parts, contacts = (root.find(f"{{{_NAMESPACE}}}{name}") for name in ("units", "parts", "contacts"))
    if units is None or units.get("length") != "mm" or parts is None or contacts is None:
        raise InputError(
            "cannot be part of a mission: it must have parts, contacts and lengths in mm", place=Place(file=assembly)
        )
    plane = root.find(f".//{{{_NAMESPACE}}}plane[@name='{mission.ground}']")
    if plane is None:
        raise InputError(f"has no plane {mission.ground}", place=Place(file=assembly), remedy="See ground.")
    material = plane.get("material") or ""
    parts.append(_part(_mark(mission), material, shape="none"))
    for obstacle in mission.obstacles:
        parts.append(_part(obstacle, material, shape="box"))
        for support in mission.supports:
            _pair(contacts, support, obstacle.name)
        if obstacle.movable:
            for other in (mission.ground, *(each.name for each in mission.obstacles if not each.movable)):
                _pair(contacts, obstacle.name, other)
    tree.write(folder / assembly.name, xml_declaration=True, encoding="UTF-8")
    (folder / GEOMETRY).write_text(_geometry(mission), encoding="utf-8")
    count = len(contacts.findall(f"{{{_NAMESPACE}}}include"))
    (folder / "Course.mo").write_text(_model(mission, count), encoding="utf-8")
    packages = sorted(path.name for path in folder.iterdir() if (path / "package.mo").is_file())
    sources = ", ".join(f'"{name}"' for name in (*packages, "Course.mo"))
    (folder / "experiment.toml").write_text(f'model = "Course"\nsources = [{sources}]\n', encoding="utf-8")
    return folder / assembly.name


def _mark(mission: Mission) -> Obstacle:
    """What shows where the goal is; nothing touches it."""
    side, (x, y) = math.sqrt(2) * mission.goal.radius, mission.goal.position
    return Obstacle(_GOAL, (side, side, 0.002), (x, y, 0.0), (0.0, 0.0, 0.0), 0.0, _GREEN)


def _model(mission: Mission, pairs: int) -> str:
    """The driven model with as many pairs as the course has, boxes on four points."""
    points = 4 if any(obstacle.movable for obstacle in mission.obstacles) else 1
    return (
        f'model Course "{mission.title}"\n  extends {mission.model}(pairs={pairs}, points={points});\n'
        "  annotation (experiment(StopTime=1, Tolerance=1e-4, Interval=0.01));\nend Course;\n"
    )


def _part(obstacle: Obstacle, material: str, shape: str) -> etree._Element:
    part = etree.Element(f"{{{_NAMESPACE}}}part", name=obstacle.name, material=material)
    if not obstacle.movable:
        part.set("grounded", "true")
    pose = _add(part, "pose")
    _add(pose, "position", _numbers(_MILLI * each for each in obstacle.position))
    if any(obstacle.angles):
        _add(pose, "rollPitchYaw", _numbers(obstacle.angles))
    x, y, z = obstacle.size
    mass = (obstacle.density or 1.0) * x * y * z
    properties = _add(part, "massProperties")
    _add(properties, "mass", f"{mass:.12g}")
    _add(properties, "centerOfMass", "0 0 0")
    inertia = _add(properties, "inertia")
    share = _MILLI**2 * mass / 12
    values = {"xx": share * (y * y + z * z), "yy": share * (x * x + z * z), "zz": share * (x * x + y * y)}
    for name, value in ({"about": "centerOfMass", "axes": "part", "products": "tensor"}).items():
        inertia.set(name, value)
    for name, number in values.items():
        inertia.set(name, f"{number:.12g}")
    for name in ("xy", "xz", "yz"):
        inertia.set(name, "0")
    geometry = _add(part, "geometry")
    for name, value in {"file": GEOMETRY, "node": obstacle.name, "coordinates": "node", "length": "mm"}.items():
        geometry.set(name, value)
    _add(part, "collision").set("shape", shape)
    return part


def _add(parent: etree._Element, name: str, text: str | None = None) -> etree._Element:
    child = etree.SubElement(parent, f"{{{_NAMESPACE}}}{name}")
    child.text = text
    return child


def _pair(contacts: etree._Element, first: str, second: str) -> None:
    include = _add(contacts, "include")
    include.set("first", first)
    include.set("second", second)


def _geometry(mission: Mission) -> str:
    """The boxes as VRML, one node each."""
    nodes = [
        f"DEF {obstacle.name} Transform {{ children [ Shape {{\n"
        f"  appearance Appearance {{ material Material {{ diffuseColor {_numbers(obstacle.color)} }} }}\n"
        f"  geometry Box {{ size {_numbers(_MILLI * each for each in obstacle.size)} }}\n}} ] }}\n"
        for obstacle in (_mark(mission), *mission.obstacles)
    ]
    return "#VRML V2.0 utf8\n" + "".join(nodes)


def _numbers(values: object) -> str:
    return " ".join(f"{value:.12g}" for value in values)  # type: ignore[attr-defined]
