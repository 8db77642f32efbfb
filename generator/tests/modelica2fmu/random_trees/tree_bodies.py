"""Bodies of random mechanisms, and what holds them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from tree_draft import Draft, Frame
from tree_forces import drive
from tree_joints import X, Y, random_joint, turn, turned, vector
from tree_motion import Mass, Place, Pose, Vector, condition, mass_at


def body(draft: Draft) -> None:
    """A body, and what holds it."""
    number_of, name = len(draft.bodies), f"b{len(draft.bodies)}"
    is_loose = draft.choose.random() < 0.12
    kind, text, mass, end = _kind_of_body(draft)
    own = Place(number_of, np.zeros(3), np.eye(3))
    draft.mechanism.masses.append(mass)
    draft.bodies.append(name)
    if is_loose:
        start, orientation = turned(draft.choose, "0")
        r, v = draft.choose.arm(1.0), draft.choose.arm()
        start = f"r_0(fixed=true, start={vector(r)}), v_0(fixed=true, start={vector(v)}), {start}"
        draft.declare(f"MB.Parts.{kind}", name, f"{text}, {start}, animation=false")
        # Angular velocities at the start are in the axes of the world here.
        draft.starts.append(lambda _, t: (r + v * t, orientation(t)))
    else:
        draft.declare(f"MB.Parts.{kind}", name, f"{text}, animation=false")
        _hold(draft, number_of, Frame(f"{name}.frame_a", own), end)
    draft.frames.append(Frame(f"{name}.frame_a", own))
    if end is not None:
        draft.frames.append(Frame(f"{name}.frame_b", own.moved(end, np.eye(3))))
    for index, axis in enumerate("123"):
        draft.watched[f"{name}.frame_a.r_0[{axis}]"] = lambda look, k=index: look(own).r[k]
        draft.watched[f"{name}.frame_a.R.T[{axis},1]"] = lambda look, k=index: look(own).axes[0, k]
        draft.watched[f"{name}.frame_a.R.T[2,{axis}]"] = lambda look, k=index: look(own).axes[k, 1]


def point_mass(draft: Draft) -> None:
    """A mass at a frame."""
    frame = draft.choose.choice(draft.frames)
    m, name = draft.choose.within(0.2, 1), f"m{len(draft.lines)}"
    if frame.place.body is None:
        return
    draft.declare("MB.Parts.PointMass", name, f"m={m}, animation=false")
    draft.connect(frame.name, f"{name}.frame_a")
    k = frame.place.body
    draft.mechanism.masses[k] = draft.mechanism.masses[k].plus(mass_at(m, frame.place.origin, np.zeros((3, 3))))
    draft.has_points = True


def _rigid(draft: Draft, frame: Frame) -> Frame:
    """Often a frame beside another one."""
    choice, r, name = draft.choose.random(), draft.choose.arm(), f"f{len(draft.lines)}"
    if choice < 0.4:
        return frame
    if choice < 0.7:
        draft.declare("MB.Parts.FixedTranslation", name, f"r={vector(r)}, animation=false")
        place, moved = frame.place, (r, np.eye(3))
    else:
        n, angle = draft.choose.direction(), draft.choose.within(-120, 120)
        draft.declare("MB.Parts.FixedRotation", name, f"r={vector(r)}, n={vector(n)}, angle={angle}, animation=false")
        place, moved = frame.place, (r, turn(n, np.radians(angle)))
    if draft.choose.random() < 0.7:
        draft.connect(frame.name, f"{name}.frame_a")
        return Frame(f"{name}.frame_b", place.moved(*moved))
    draft.connect(frame.name, f"{name}.frame_b")
    return Frame(f"{name}.frame_a", place.moved(-moved[1].T @ moved[0], moved[1].T))


def _kind_of_body(draft: Draft) -> tuple[str, str, Mass, Vector | None]:
    choice, end = draft.choose.random(), draft.choose.arm()
    if np.linalg.norm(end) < 0.1:
        end = np.array([0.3, 0.0, 0.1])
    if choice < 0.7:
        m, center = draft.choose.within(0.4, 3), draft.choose.arm(0.3)
        root = np.array([[draft.choose.within(-0.2, 0.2) for _ in range(3)] for _ in range(3)])
        inertia = np.round(m * (root @ root.T + 0.01 * np.eye(3)), 3)
        # An inertia of masses somewhere: no moment exceeds the sum of the others.
        inertia = np.round(np.trace(inertia) * np.eye(3) - inertia, 3)
        text = f"m={m}, r_CM={vector(center)}, I_11={inertia[0, 0]:.3f}, I_22={inertia[1, 1]:.3f}, "
        text += f"I_33={inertia[2, 2]:.3f}, I_21={inertia[1, 0]:.3f}, I_31={inertia[2, 0]:.3f}, "
        text += f"I_32={inertia[2, 1]:.3f}"
        mass = mass_at(m, center, inertia)
        return ("Body", text, mass, None) if choice < 0.35 else ("BodyShape", f"r={vector(end)}, {text}", mass, end)
    length, density = float(np.linalg.norm(end)), draft.choose.within(500, 3000)
    unit, width = end / length, draft.choose.within(0.05, 0.15)
    if choice < 0.85:
        height = draft.choose.within(0.03, 0.1)
        m = density * length * width * height
        principal = m / 12 * np.array([width**2 + height**2, length**2 + height**2, length**2 + width**2])
        text = f"r={vector(end)}, width={width}, height={height}, density={density}"
    else:
        m = density * np.pi * width**2 / 4 * length
        side = m * (3 * width**2 / 4 + length**2) / 12
        principal = np.array([m * width**2 / 8, side, side])
        text = f"r={vector(end)}, diameter={width}, density={density}"
    z = np.cross(unit, Y if np.linalg.norm(np.cross(unit, Y)) > 1e-6 else X)
    z = z / np.linalg.norm(z)
    axes = np.column_stack([unit, np.cross(z, unit), z])
    kind = "BodyBox" if choice < 0.85 else "BodyCylinder"
    return kind, text, mass_at(m, end / 2, axes @ np.diag(principal) @ axes.T), end


def _hold(draft: Draft, number_of: int, own: Frame, end: Vector | None) -> None:
    """Joins a body to a frame that is there already; the joint may lie either way round."""
    parent = _rigid(draft, draft.choose.choice(draft.frames))
    if end is not None and draft.choose.random() < 0.3:
        child = _rigid(draft, Frame(own.name.replace("frame_a", "frame_b"), own.place.moved(end, np.eye(3))))
    else:
        child = _rigid(draft, own)
    joint, name, is_reversed = random_joint(draft.choose), f"j{number_of}", draft.choose.random() < 0.3
    first, second = (child, parent) if is_reversed else (parent, child)
    text = joint.text
    if joint.axis is not None and draft.choose.random() < 0.5:
        text += ", useAxisFlange=true"
        drive(draft, name, joint, first.place, second.place)
    draft.declare(f"MB.Joints.{joint.kind}", name, f"{text}, animation=false")
    draft.connect(first.name, f"{name}.frame_a")
    draft.connect(f"{name}.frame_b", second.name)
    for kind, a, b in joint.conditions:
        draft.mechanism.conditions.append(condition(kind, first.place, second.place, a, b))

    def start(poses: Sequence[Pose], time: float) -> Pose:
        at, axes = (np.zeros(3), np.eye(3)) if parent.place.body is None else poses[parent.place.body]
        at, axes = at + axes @ parent.place.origin, axes @ parent.place.axes
        r, rotation = joint.step(time)
        if is_reversed:
            r, rotation = -rotation.T @ r, rotation.T
        at, axes = at + axes @ r, axes @ rotation
        axes = axes @ child.place.axes.T
        return at - axes @ child.place.origin, axes

    draft.starts.append(start)
