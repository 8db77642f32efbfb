"""``scene.json``: what a report needs to draw a simulated mechanism."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from cad2modelica.geometry.mesh import Mesh, weld
from cad2modelica.geometry.spatial import Array
from cad2modelica.kinematics.kinematic_graph import KinematicTree
from cad2modelica.kinematics.loops import LoopAnalysis
from cad2modelica.mechanism.model import Assembly, JointType, Material, Part
from cad2modelica.modelica.view import MechanismView

FORMAT = 1

_COORDINATES = {
    JointType.REVOLUTE: ("phi", "w", "rad"),
    JointType.SCREW: ("phi", "w", "rad"),
    JointType.PRISMATIC: ("s", "v", "m"),
}


def scene_text(assembly: Assembly, tree: KinematicTree, loops: LoopAnalysis, view: MechanismView, name: str) -> str:
    """The scene as JSON; the same scene gives the same text."""
    scene = {
        "format": FORMAT,
        "name": name,
        "gravity": _list(assembly.gravity),
        "bodies": [_body(part, view, part.name in tree.fixed) for part in assembly.parts] + _planes(assembly, view),
        "joints": [
            {
                "name": view.joint_names[joint.name],
                "type": joint.type.value,
                "variable": f"{view.joint_names[joint.name]}.{_COORDINATES[joint.type][0]}",
                "rate": f"{view.joint_names[joint.name]}.{_COORDINATES[joint.type][1]}",
                "unit": _COORDINATES[joint.type][2],
            }
            for joint in assembly.joints
            if joint.type in _COORDINATES and joint.name not in loops.planar_constraints
        ],
        **_contacts(assembly, view),
    }
    return json.dumps(scene, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"


def _body(part: Part, view: MechanismView, fixed: bool) -> dict[str, Any]:
    name = view.part_names[part.name]
    return {
        "name": name,
        "label": part.name,
        "variable": name,
        "fixed": fixed,
        "position": _list(part.pose.position),
        "rotation": _rows(part.pose.rotation.T),
        "mass": part.mass_properties.mass,
        "centerOfMass": _list(part.mass_properties.center_of_mass),
        "inertia": _rows(part.mass_properties.inertia),
        "meshes": [_mesh(mesh) for mesh in part.meshes],
    }


def _mesh(mesh: Mesh) -> dict[str, Any]:
    vertices, triangles = weld(mesh.vertices, mesh.triangles)
    return {
        "name": mesh.name,
        "vertices": [[round(value, 9) + 0.0 for value in vertex] for vertex in vertices.tolist()],
        "triangles": triangles.tolist(),
        "color": [round(channel, 6) for channel in mesh.color],
    }


def _planes(assembly: Assembly, view: MechanismView) -> list[dict[str, Any]]:
    return [
        {
            "name": view.plane_names[plane.name],
            "label": plane.name,
            "variable": view.plane_names[plane.name],
            "fixed": True,
            "position": _list(plane.position),
            "rotation": _rows(np.eye(3)),
            "plane": {"normal": _list(plane.normal)},
            "meshes": [],
        }
        for plane in assembly.planes
    ]


def _contacts(assembly: Assembly, view: MechanismView) -> dict[str, Any]:
    """The entry ``contacts``; none where nothing can touch."""
    if view.contacts is None:
        return {}
    if view.contacts.compiled:
        return {"contacts": {"manager": "contacts", "bodies": list(view.contacts.bodies)}}
    material_of = {view.part_names[part.name]: part.material for part in assembly.parts}
    material_of |= {view.plane_names[plane.name]: plane.material for plane in assembly.planes}
    materials = {material.name: material for material in assembly.materials}
    pairs = []
    for index, (first, second) in enumerate(view.contacts.pairs, start=1):
        bodies = [view.contacts.bodies[first - 1], view.contacts.bodies[second - 1]]
        pair: dict[str, Any] = {"index": index, "bodies": bodies}
        restitution = _restitution([materials.get(material_of[body] or "") for body in bodies])
        if restitution is not None:
            pair["restitution"] = restitution
        pairs.append(pair)
    return {"contacts": {"manager": "contacts", "pairs": pairs}}


def _restitution(materials: list[Material | None]) -> float | None:
    """The smaller of the two coefficients, as the contact manager combines them; None if one is not given."""
    values = [material.restitution if material is not None else None for material in materials]
    known = [value for value in values if value is not None]
    return min(known) if len(known) == len(values) else None


def _list(values: Array) -> list[float]:
    return [float(value) + 0.0 for value in values]


def _rows(matrix: Array) -> list[list[float]]:
    return [_list(row) for row in matrix]
