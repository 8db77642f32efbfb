"""Writes the Modelica package as text."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from cad2modelica.actuators.placement import Actuator
from cad2modelica.collision.collision_shapes import CollisionGeometry
from cad2modelica.emit.actuator_diagram import draw_actuators
from cad2modelica.emit.hull_files import package_geometry
from cad2modelica.mechanism.model import Assembly, Material
from cad2modelica.modelica.diagram import Extent, Point, draw
from cad2modelica.modelica.text import array, html, number, string, vector
from cad2modelica.modelica.view import ContactView, MechanismView

LIBRARY_VERSION = "0.1.0"
MECHANICS = "Mechanics"
MECHATRONICS = "Mechatronics"
GEOMETRY = "Geometry"
CLASSES = (MECHANICS, MECHATRONICS, GEOMETRY)
OUTPUT_POINTS = 1000

_RULES = {"geometric mean": "GeometricMean", "minimum": "Minimum", "maximum": "Maximum"}
_FRICTION = {"none": "None", "regularised": "Regularised", "anchored": "Anchored"}


@dataclass(frozen=True)
class PackageTexts:
    """Files of the package by their names, the mechatronic model apart because it is written only once.

    Attributes:
        files: Modelica files.
        mechatronics: the mechatronic model.
        resources: other files, by their paths in the package.
    """

    files: dict[str, str]
    mechatronics: str
    resources: dict[str, bytes]


def package_texts(
    assembly: Assembly,
    view: MechanismView,
    geometries: dict[str, CollisionGeometry],
    actuators: tuple[Actuator, ...],
    package: str,
    notes: tuple[str, ...],
) -> PackageTexts:
    """The texts of the package's files."""
    diagram = draw(view)
    drives = draw_actuators(actuators, diagram)
    environment = _environment()
    extents = {**diagram.extents, **drives.extents}
    common: dict[str, Any] = {
        "package": package,
        "label": assembly.name,
        "description": assembly.description or assembly.name,
        "documentation": assembly.description or assembly.name,
        "file": assembly.file.name,
        "source": assembly.source,
        "library_version": LIBRARY_VERSION,
        "stop_time": assembly.stop_time,
        "tolerance": assembly.tolerance,
        "interval": assembly.stop_time / OUTPUT_POINTS,
        "placement": lambda name: _placement(extents[name]),
    }
    mechanics = environment.get_template("mechanics.mo.jinja").render(
        **common,
        gravity=view.gravity,
        gravity_direction=view.gravity_direction,
        materials=[_material(material, view.material_names[material.name]) for material in assembly.materials],
        components=view.components,
        contacts=None if view.contacts is None else _contacts(view.contacts),
        connections=[
            {"first": connection.first, "second": connection.second, "points": _points(line)}
            for connection, line in zip(view.connections, diagram.lines, strict=True)
        ],
        size=_extent(diagram.size),
        notes=notes,
    )
    part_of = {view.part_names[name]: name for name in geometries}
    expressions, resources = package_geometry(package, {body: geometries[name] for body, name in part_of.items()})
    bodies = [{"name": body, "geometry": text, "label": part_of[body]} for body, text in expressions.items()]
    files = {
        "package.mo": environment.get_template("package.mo.jinja").render(**common),
        f"{MECHANICS}.mo": mechanics,
        f"{GEOMETRY}.mo": environment.get_template("geometry.mo.jinja").render(**common, bodies=bodies),
    }
    mechatronics = environment.get_template("mechatronics.mo.jinja").render(
        **common,
        actuators=actuators,
        flanges=[f"{joint}(useAxisFlange=true)" for joint in dict.fromkeys(item.joint for item in actuators)],
        actuator_connections=[
            {"first": item.first, "second": item.second, "points": _points(item.points), "color": item.color}
            for item in drives.connections
        ],
        mechatronics_size=_extent(drives.size),
    )
    return PackageTexts(files, mechatronics, resources)


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    environment.filters.update(string=string, html=html, number=number, vector=vector)
    return environment


def _placement(extent: Extent) -> str:
    return f"annotation (Placement(transformation(extent={_extent(extent)})))"


def _extent(extent: Extent) -> str:
    return _points(extent)


def _points(points: tuple[Point, ...]) -> str:
    return "{" + ",".join(f"{{{x},{y}}}" for x, y in points) + "}"


def _material(material: Material, name: str) -> dict[str, Any]:
    values = {
        "E": material.youngs_modulus,
        "nu": material.poissons_ratio,
        "restitution": material.restitution,
        "muStatic": material.static_friction,
        "muDynamic": material.dynamic_friction,
        "density": material.density,
    }
    modifiers = [f"{key}={number(value)}" for key, value in values.items() if value is not None]
    return {"name": name, "label": material.name, "modifiers": modifiers}


def _contacts(contacts: ContactView) -> dict[str, Any]:
    modifiers = _modifiers_of_bodies(contacts) if contacts.compiled else _modifiers_of_pairs(contacts)
    return {"class_name": contacts.class_name, "modifiers": [f"n={len(contacts.bodies)}", *modifiers]}


def _modifiers_of_bodies(contacts: ContactView) -> list[str]:
    # A part that is held has a mass, but moves as little as one of none.
    inertia = ("ContactMultiBody.Parts.Inertia()" if b in contacts.held else f"{b}.inertia" for b in contacts.bodies)
    modifiers = [*_surfaces(contacts), f"inertia={array(inertia)}"]
    if contacts.apart:
        modifiers.append(f"excluded={_pairs(contacts.apart)}")
    if contacts.stiffness is not None:  # two bodies act in series
        modifiers += _given_stiffness(2 * contacts.stiffness, len(contacts.bodies))
    if contacts.friction == "none":
        modifiers.append("useFriction=false")
    return modifiers + _friction_rule(contacts)


def _modifiers_of_pairs(contacts: ContactView) -> list[str]:
    modifiers = [*_surfaces(contacts), f"pairs={_pairs(contacts.pairs)}"]
    if contacts.stiffness is not None:
        modifiers += _given_stiffness(contacts.stiffness, len(contacts.pairs))
    if contacts.friction is not None:
        modifiers.append(f"friction=ContactMultiBody.Types.Friction.{_FRICTION[contacts.friction]}")
    modifiers += _friction_rule(contacts)
    if contacts.exact_within is not None:
        modifiers.append(f"exactWithin={number(contacts.exact_within)}")
    return modifiers


def _surfaces(contacts: ContactView) -> list[str]:
    return [f"{what}={array(f'{body}.{what}' for body in contacts.bodies)}" for what in ("geometry", "material")]


def _pairs(pairs: tuple[tuple[int, int], ...]) -> str:
    return array(f"{{{first},{second}}}" for first, second in pairs)


def _given_stiffness(stiffness: float, count: int) -> list[str]:
    return [
        "stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given",
        f"stiffness=fill({number(stiffness)}, {count})",
    ]


def _friction_rule(contacts: ContactView) -> list[str]:
    if contacts.friction_rule is None:
        return []
    return [f"frictionRule=ContactMultiBody.Types.CombinationRule.{_RULES[contacts.friction_rule]}"]
