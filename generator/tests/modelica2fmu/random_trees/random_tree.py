"""Random trees of bodies and joints of ``Modelica.Mechanics.MultiBody``, with forces and sensors, and their motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from tree_bodies import body, point_mass
from tree_draft import Draft
from tree_forces import given_force, line_force
from tree_joints import Chooser, vector
from tree_motion import Look, Vector


@dataclass(frozen=True)
class RandomTree:
    """A package P with a model M, its variables, and their values in a motion."""

    text: str
    names: Sequence[str]
    values: Callable[[Look], Vector]
    motion: Callable[[Sequence[float]], Sequence[Look]]


def random_tree(seed: int) -> RandomTree:
    """The mechanism of a seed."""
    draft = Draft(Chooser(seed))
    choose = draft.choose
    for _ in range(choose.choice([1, 2, 2, 3, 3, 4, 5])):
        body(draft)
    poses = draft.poses(0.0)
    for _ in range(choose.choice([0, 1, 1, 2])):
        line_force(draft, poses)
    for part, chance in ((given_force, 0.4), (point_mass, 0.3), (_sensor, 0.5), (_sensor, 0.3)):
        if choose.random() < chance:
            part(draft)
    world = _world(draft)
    choose.shuffle(draft.lines)
    choose.shuffle(draft.connections)
    text = "\n".join(
        [
            "package P",
            "  import MB = Modelica.Mechanics.MultiBody;",
            "  import MR = Modelica.Mechanics.Rotational;",
            "  import MT = Modelica.Mechanics.Translational;",
            "  model M",
            f"    inner MB.World world({world}, enableAnimation=false);",
            *draft.lines,
            "  equation",
            *draft.connections,
            "  end M;",
            "end P;",
            "",
        ]
    )
    names = list(draft.watched)
    functions = list(draft.watched.values())
    return RandomTree(
        text,
        names,
        lambda look: np.array([each(look) for each in functions]),
        lambda times: draft.mechanism.motion(draft.poses, times),
    )


def _world(draft: Draft) -> str:
    choice, n, g = draft.choose.random(), draft.choose.direction(), draft.choose.within(1, 12)
    if choice < 0.15:
        return "gravityType=MB.Types.GravityTypes.NoGravity"
    if choice < 0.3 and not draft.has_points:
        mu = draft.choose.within(0.3, 1)
        origin_apart = 1e-3
        draft.mechanism.gravity = lambda r: -mu * r / max(float(np.linalg.norm(r)), origin_apart) ** 3
        return f"gravityType=MB.Types.GravityTypes.PointGravity, mu={mu}"
    draft.mechanism.gravity = lambda _: g * n / np.linalg.norm(n)
    return f"g={g}, n={vector(n)}"


def _sensor(draft: Draft) -> None:
    first, second = draft.choose.sample(draft.frames, 2)
    kind = draft.choose.choice(["RelativePosition", "RelativeVelocity", "RelativeAngularVelocity"])
    name = f"e{len(draft.lines)}"
    resolved = draft.choose.choice(["world", "frame_a", "frame_b"])
    types = f"MB.Types.ResolveInFrameAB.{resolved}"
    draft.declare(f"MB.Sensors.{kind}", name, f"resolveInFrame={types}")
    draft.connect(first.name, f"{name}.frame_a")
    draft.connect(second.name, f"{name}.frame_b")
    output = {"RelativePosition": "r_rel", "RelativeVelocity": "v_rel", "RelativeAngularVelocity": "w_rel"}[kind]

    def value(look: Look) -> Vector:
        a, b = look(first.place), look(second.place)
        axes = {"world": np.eye(3), "frame_a": a.axes, "frame_b": b.axes}[resolved]
        # The rate of the relative position in frame_a, as it is seen there.
        seen = {"r_rel": b.r - a.r, "v_rel": b.v - a.v - np.cross(a.w, b.r - a.r), "w_rel": b.w - a.w}[output]
        return np.asarray(axes.T @ seen)

    for k in range(3):
        draft.watched[f"{name}.{output}[{k + 1}]"] = lambda look, k=k: float(value(look)[k])
