"""Forces in random mechanisms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from tree_draft import Draft
from tree_joints import Joint
from tree_motion import Load, Look, Place, Pose, Vector

DISTANCE_APART = 0.3  # of the ends of line forces at the start


def drive(draft: Draft, name: str, joint: Joint, first: Place, second: Place) -> None:
    """Spring, damper or given force at the flanges of a joint."""
    choose = draft.choose
    assert joint.axis is not None
    axis = joint.axis / np.linalg.norm(joint.axis)
    is_turning = joint.kind == "Revolute"
    library, rest = ("MR", "phi_rel0") if is_turning else ("MT", "s_rel0")
    kind, c, d, free = (
        choose.random(),
        draft.choose.within(1, 30),
        draft.choose.within(0.1, 1.5),
        draft.choose.within(-0.2, 0.2),
    )
    amplitude, frequency = draft.choose.within(0.5, 3), draft.choose.within(0.3, 1.5)
    drive = f"d{name}"
    if kind < 0.4:
        draft.declare(f"{library}.Components.SpringDamper", drive, f"c={c}, d={d}, {rest}={free}")
    elif kind < 0.7:
        draft.declare(f"{library}.Components.Damper", drive, f"d={d}")
        c = 0.0
    else:
        source = "Torque" if is_turning else "Force"
        draft.declare(f"{library}.Sources.{source}", drive, "useSupport=true")
        draft.declare("Modelica.Blocks.Sources.Sine", f"s{name}", f"amplitude={amplitude}, f={frequency}")
        draft.connections.append(f"    connect(s{name}.y, {drive}.{'tau' if is_turning else 'f'});")
        draft.connect(f"{drive}.flange", f"{name}.axis")
        draft.connect(f"{drive}.support", f"{name}.support")
    if kind < 0.7:
        draft.connect(f"{drive}.flange_a", f"{name}.support")
        draft.connect(f"{drive}.flange_b", f"{name}.axis")
    number_of = len(draft.mechanism.turning)
    if is_turning:
        draft.mechanism.turning.append((first, second, axis, joint.start))

    def force(time: float, look: Look, angles: Vector) -> Sequence[Load]:
        a, b = look(first), look(second)
        along = a.axes @ axis
        if kind >= 0.7:
            size = amplitude * np.sin(2 * np.pi * frequency * time)
        elif is_turning:
            size = -c * (angles[number_of] - free) - d * along @ (b.w - a.w)
        else:
            rate = along @ (b.v - a.v - np.cross(a.w, b.r - a.r))
            size = -c * (along @ (b.r - a.r) - free) - d * rate
        if is_turning:
            return [
                Load(second.body, b.r, 0 * along, size * along),
                Load(first.body, b.r, 0 * along, -size * along),
            ]
        return [Load(second.body, b.r, size * along, 0 * along), Load(first.body, b.r, -size * along, 0 * along)]

    draft.mechanism.forces.append(force)


def line_force(draft: Draft, poses: Sequence[Pose]) -> None:
    """A spring, a damper or both between frames."""
    first, second = draft.choose.sample(draft.frames, 2)
    look = draft.at_start(poses)
    a, b = look(first.place), look(second.place)
    if first.place.body == second.place.body or np.linalg.norm(b.r - a.r) < DISTANCE_APART:
        return
    name, c, d, rest = (
        f"l{len(draft.lines)}",
        draft.choose.within(5, 60),
        draft.choose.within(0.2, 3),
        draft.choose.within(0.1, 0.6),
    )
    kind = draft.choose.choice(["Spring", "Damper", "SpringDamperParallel"])
    text = {"Spring": f"c={c}, s_unstretched={rest}", "Damper": f"d={d}"}.get(
        kind, f"c={c}, d={d}, s_unstretched={rest}"
    )
    draft.declare(f"MB.Forces.{kind}", name, f"{text}, animation=false")
    draft.connect(first.name, f"{name}.frame_a")
    draft.connect(second.name, f"{name}.frame_b")
    c, d = (0.0 if kind == "Damper" else c), (0.0 if kind == "Spring" else d)

    def force(_: float, look: Look, __: Vector) -> Sequence[Load]:
        a, b = look(first.place), look(second.place)
        away = b.r - a.r
        length = float(np.linalg.norm(away))
        pull = (c * (length - rest) + d * away @ (b.v - a.v) / length) * away / length
        none = np.zeros(3)
        return [Load(first.place.body, a.r, pull, none), Load(second.place.body, b.r, -pull, none)]

    draft.mechanism.forces.append(force)


def given_force(draft: Draft) -> None:
    """A constant or swinging force or torque, between frames or from the world."""
    choose = draft.choose
    kind = choose.choice(["WorldForce", "WorldTorque", "Force", "Torque"])
    is_between, is_force = kind in ("Force", "Torque"), kind.endswith("Force")
    first, second = choose.sample(draft.frames, 2)
    if second.place.body is None:
        first, second = second, first
    resolved = choose.choice(["world", "frame_b", *(["frame_a"] if is_between else [])])
    name, size, swing = f"g{len(draft.lines)}", draft.choose.arm(1.0 if is_force else 0.05), choose.random() < 0.5
    types = "ResolveInFrameAB" if is_between else "ResolveInFrameB"
    draft.declare(f"MB.Forces.{kind}", name, f"resolveInFrame=MB.Types.{types}.{resolved}, animation=false")
    for k in range(3):
        block = f"Sine {name}s{k + 1}(amplitude={size[k]}, f=0.7, phase=0.4)"
        constant = f"Constant {name}s{k + 1}(k={size[k]})"
        draft.lines.append(f"    Modelica.Blocks.Sources.{block if swing else constant};")
        draft.connections.append(f"    connect({name}s{k + 1}.y, {name}.{'force' if is_force else 'torque'}[{k + 1}]);")
    draft.connect(second.name, f"{name}.frame_b")
    if is_between:
        draft.connect(first.name, f"{name}.frame_a")

    def force(time: float, look: Look, _: Vector) -> Sequence[Load]:
        a, b = look(first.place), look(second.place)
        axes = {"world": np.eye(3), "frame_a": a.axes, "frame_b": b.axes}[resolved]
        value = axes @ size * (np.sin(2 * np.pi * 0.7 * time + 0.4) if swing else 1.0)
        parts = (value, 0 * value) if is_force else (0 * value, value)
        loads = [Load(second.place.body, b.r, *parts)]
        return [*loads, Load(first.place.body, b.r, -parts[0], -parts[1])] if is_between else loads

    draft.mechanism.forces.append(force)
