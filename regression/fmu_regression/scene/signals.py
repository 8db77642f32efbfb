"""Names of the variables that belong to a scene, and which of them an FMU has."""

from __future__ import annotations

from collections.abc import Container, Sequence

from contact_foundation.errors import InputError, Place

from fmu_regression.fmi.description import ModelDescription
from fmu_regression.scene.scene_file import ContactPair, Scene, SceneBody, SceneJoint

_AXES = (1, 2, 3)
_LISTED = 4  # signals named in a message


def position_names(body: SceneBody) -> list[str]:
    """Names of the position of the body's frame, x y z."""
    return [f"{body.variable}.{body.frame}.r_0[{i}]" for i in _AXES]


def rotation_names(body: SceneBody) -> list[str]:
    """Names of the nine elements of T, row by row."""
    return [f"{body.variable}.{body.frame}.R.T[{i},{j}]" for i in _AXES for j in _AXES]


def velocity_candidates(body: SceneBody) -> list[list[str]]:
    """Names under which the velocity of the body's frame, world axes, may be found; best first."""
    if body.frame != "frame_a":
        return []
    return [[f"{body.variable}.v_0[{i}]" for i in _AXES], [f"{body.variable}.body.v_0[{i}]" for i in _AXES]]


def angular_velocity_candidates(body: SceneBody) -> list[list[str]]:
    """Names under which the angular velocity, body axes, may be found; best first."""
    own = ("w_a", "body.w_a") if body.frame == "frame_a" else ()
    return [[f"{body.variable}.{variable}[{i}]" for i in _AXES] for variable in (*own, f"{body.frame}.R.w")]


def first_present(candidates: Sequence[Sequence[str]], known: Container[str]) -> Sequence[str] | None:
    """The first list of names that is known completely."""
    return next((names for names in candidates if all(name in known for name in names)), None)


def pair_signal(scene: Scene, pair: ContactPair, quantity: str) -> str:
    """Name of a scalar quantity of a pair, e.g. "normalForce"."""
    return f"{scene.manager}.{quantity}[{pair.index}]"


def force_names(scene: Scene, pair: ContactPair) -> list[str]:
    """Names of the force on the pair's first body, world axes."""
    return [f"{scene.manager}.force[{pair.index},{i}]" for i in _AXES]


def body_force_names(scene: Scene, number: int) -> list[str]:
    """Names of the contact force on the manager's body of this number (from 1), world axes; of scenes without pairs."""
    return [f"{scene.manager}.force[{number},{i}]" for i in _AXES]


def touch_names(scene: Scene) -> list[str]:
    """What a manager that tells forces of bodies tells of all contacts: their number, the largest depth."""
    return [f"{scene.manager}.{quantity}" for quantity in ("contactCount", "largestDepth", "relativeDepth")]


def point_names(scene: Scene, pair: ContactPair, slot: int) -> list[str]:
    """Names of a contact point of the pair (slots from 1), world axes; not every FMU shows them."""
    return [f"{scene.manager}.point[{pair.index},{slot},{i}]" for i in _AXES]


def point_force_names(scene: Scene, pair: ContactPair, slot: int) -> list[str]:
    """Names of the force on the first body at a contact point, world axes; not every FMU shows them."""
    return [f"{scene.manager}.pointForce[{pair.index},{slot},{i}]" for i in _AXES]


def effort_name(joint: SceneJoint) -> str:
    """Name of the torque or force that acts along a joint's coordinate."""
    return f"{joint.variable.rpartition('.')[0]}.{'f' if joint.unit == 'm' else 'tau'}"


def elastic_energy_name(scene: Scene) -> str:
    """Name of the energy stored in all contacts."""
    return f"{scene.manager}.elasticEnergy"


def missing_signals(scene: Scene, known: Container[str]) -> list[str]:
    """What a report cannot do without: the poses of bodies that move, and force or distance of each pair or body.

    Args:
        scene: the scene.
        known: names of a result's signals or an FMU's variables.
    """
    missing: list[str] = []
    for body in scene.bodies:
        if not body.fixed:
            missing += [name for name in position_names(body) + rotation_names(body) if name not in known]
    for pair in scene.pairs:
        names = [pair_signal(scene, pair, quantity) for quantity in ("normalForce", "distance")]
        missing += names[:1] if not any(name in known for name in names) else []
    for number in range(1, len(scene.colliders) + 1):
        missing += [name for name in body_force_names(scene, number) if name not in known]
    return missing


def require_signals(scene: Scene, known: Container[str], place: Place, remedy: str) -> None:
    """Refuses a result or an FMU that says nothing about parts of a scene, or that knows more of it.

    Args:
        scene: the scene.
        known: names of the result's signals or the FMU's variables.
        place: the result or the FMU.
        remedy: what the user can do if the scene is the right one.

    Raises:
        InputError: signals are missing, which are named; or there are contact pairs that the scene does not have.
    """
    missing = missing_signals(scene, known)
    if missing:
        listed = ", ".join(missing[:_LISTED]) + (
            f", and {len(missing) - _LISTED} more" if len(missing) > _LISTED else ""
        )
        raise InputError(
            f"has no {listed}, which the report on the scene {scene.name!r} needs; without them it would deny motion "
            "and contacts",
            place=place,
            remedy=f"{remedy} If they are there, the scene belongs to another model.",
        )
    what, beyond = "contact pair", f"{scene.manager}.normalForce[{max((p.index for p in scene.pairs), default=0) + 1}]"
    if scene.colliders:
        what, beyond = "colliding body", body_force_names(scene, len(scene.colliders) + 1)[0]
    if scene.manager and beyond in known:
        raise InputError(
            f"has {beyond}, a {what} that the scene {scene.name!r} does not have: it belongs to another model",
            place=place,
            remedy="Name the scene.json beside the package that the FMU was built from.",
        )


def signals_for(scene: Scene, description: ModelDescription) -> list[str]:
    """What to record for a report: poses and speeds of moving bodies, joints, contacts; only what the FMU has.

    Returns:
        names in a fixed order, each once.
    """
    known = description.variables
    wanted: list[str] = []
    for body in scene.bodies:
        if body.fixed:
            continue
        wanted += position_names(body) + rotation_names(body)
        wanted += first_present(velocity_candidates(body), known) or []
        wanted += first_present(angular_velocity_candidates(body), known) or []
    for joint in scene.joints:
        wanted += [joint.variable, joint.rate, effort_name(joint)]
    for pair in scene.pairs:
        wanted += [
            pair_signal(scene, pair, quantity)
            for quantity in ("distance", "normalForce", "approachSpeed", "impactSpeed", "touches")
        ]
        wanted += force_names(scene, pair)
        slot = 1
        while all(name in known for name in point_names(scene, pair, slot) + point_force_names(scene, pair, slot)):
            wanted += point_names(scene, pair, slot) + point_force_names(scene, pair, slot)
            slot += 1
    for number in range(1, len(scene.colliders) + 1):
        wanted += body_force_names(scene, number)
    if scene.colliders:
        wanted += touch_names(scene)
    if scene.pairs or scene.colliders:
        wanted.append(elastic_energy_name(scene))
    return [name for name in dict.fromkeys(wanted) if name in known]
