"""Random models of SDFormat whose links, frames, joints and nested models stand where they were drawn.

Places in the world come first; the file then says each of them against any frame that it may name.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from cad2modelica import read_assembly
from cad2modelica.geometry.spatial import Pose
from scipy.spatial.transform import Rotation

KINDS = ("revolute", "prismatic", "ball", "universal", "screw")
MODEL = "__model__"


def words(values: np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)


@dataclass(frozen=True)
class Mass:
    """A link in the world: its pose, mass, centre of mass, and inertia about that."""

    pose: Pose
    mass: float
    center: np.ndarray
    inertia: np.ndarray


@dataclass(frozen=True)
class Hinge:
    """A joint in the world."""

    kind: str
    ends: tuple[str, str]
    origin: np.ndarray
    axes: list[np.ndarray]


@dataclass
class Model:
    """One model: its text, the frames in it by name, and a frame of its own by which it can be placed."""

    text: str
    frames: dict[str, Pose]
    handle: str


@dataclass
class Drawn:
    """A file, and what it holds by the names that the format gives."""

    draw: random.Random
    links: dict[str, Mass] = field(default_factory=dict)
    joints: dict[str, Hinge] = field(default_factory=dict)

    def file(self) -> str:
        pose = self.somewhere()
        model = self.model(pose, 2, "")
        placed, attribute = self.placed(model, pose)
        return f'<sdf version="1.9"><model name="top"{attribute}>{self.pose(placed, "")}{model.text}</model></sdf>'

    def somewhere(self) -> Pose:
        turn = np.eye(3)
        if self.draw.random() < 0.8:
            turn = Rotation.from_quat([self.draw.gauss(0, 1) for _ in range(4)]).as_matrix()
        return Pose(np.array([self.draw.uniform(-1, 1) for _ in range(3)]), turn)

    def pose(self, pose: Pose, attribute: str) -> str:
        turn = Rotation.from_matrix(pose.rotation)
        way = self.draw.randrange(3)
        if way == 0:
            return (
                f'<pose {attribute} rotation_format="quat_xyzw">{words(pose.position)} {words(turn.as_quat())}</pose>'
            )
        angles = turn.as_euler("xyz")
        if way == 1:
            return f'<pose {attribute} degrees="true">{words(pose.position)} {words(np.degrees(angles))}</pose>'
        return f"<pose {attribute}>{words(pose.position)} {words(angles)}</pose>"

    def said(self, pose: Pose, known: Mapping[str, Pose], default: Pose) -> str:
        """A pose against one of the known frames, or against what counts if none is named."""
        name = self.draw.choice([None, *known])
        base = default if name is None else known[name]
        return self.pose(base.inverse() @ pose, "" if name is None else f'relative_to="{name}"')

    def placed(self, model: Model, pose: Pose) -> tuple[Pose, str]:
        if self.draw.random() < 0.4:
            return model.frames[model.handle], f' placement_frame="{model.handle}"'
        return pose, ""

    def model(self, world: Pose, depth: int, path: str) -> Model:
        draw = self.draw
        entries = [("link", f"l{number}") for number in range(draw.randint(1, 3))]
        entries += [("frame", f"f{number}") for number in range(draw.randint(0, 3))]
        entries += [("model", f"m{number}") for number in range(draw.randint(0, 2) if depth else 0)]
        draw.shuffle(entries)
        known = {MODEL: world}
        text = ""
        for kind, name in entries:
            pose = self.somewhere()
            if kind == "link":
                text += self.link(name, pose, known, path)
            elif kind == "frame":
                base = draw.choice([None, *known])
                attached = f' attached_to="{base}"' if base is not None else ""
                text += f'<frame name="{name}"{attached}>{self.said(pose, known, known[base or MODEL])}</frame>'
            else:
                inner = self.model(pose, depth - 1, f"{path}{name}::")
                place, attribute = self.placed(inner, pose)
                text += f'<model name="{name}"{attribute}>{self.said(place, known, world)}{inner.text}</model>'
                known |= {f"{name}::{key}": value for key, value in inner.frames.items() if key != MODEL}
            known[name] = pose
        for number in range(draw.randint(0, 2)):
            text += self.joint(f"j{number}", known, path)
        handles = [name for name in known if "::" not in name and name[0] in "lfj"]
        return Model(text, known, draw.choice(handles))

    def link(self, name: str, pose: Pose, known: dict[str, Pose], path: str) -> str:
        spread = np.array([[self.draw.gauss(0, 1) for _ in range(3)] for _ in range(3)])
        second = spread @ spread.T + 0.1 * np.eye(3)
        tensor = np.trace(second) * np.eye(3) - second
        mass, center = self.draw.uniform(1, 3), self.somewhere()
        inertia = center.rotation @ tensor @ center.rotation.T
        self.links[path + name] = Mass(pose, mass, np.array(center.position), inertia)
        text = f'<link name="{name}">{self.said(pose, known, known[MODEL])}<inertial>{self.said(center, known, pose)}'
        elements = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}
        moments = "".join(f"<i{key}>{float(tensor[place])!r}</i{key}>" for key, place in elements.items())
        return f"{text}<mass>{mass!r}</mass><inertia>{moments}</inertia></inertial></link>"

    def joint(self, name: str, known: dict[str, Pose], path: str) -> str:
        links = [key for key in known if key.split("::")[-1].startswith("l")]
        if len(links) < 2:
            return ""
        parent, child = self.draw.sample(links, 2)
        kind = self.draw.choice(KINDS)
        pose, place = known[child], ""
        if self.draw.random() < 0.8:
            pose = self.somewhere()
            place = self.said(pose, known, known[child])
        known[name] = pose
        axes, text = [], ""
        for tag in {"ball": [], "universal": ["axis", "axis2"]}.get(kind, ["axis"]):
            vector = np.array([self.draw.gauss(0, 1) for _ in range(3)])
            frame = self.draw.choice([None, *known])
            said = "" if frame is None else f' expressed_in="{frame}"'
            axis = (pose if frame is None else known[frame]).direction(vector)
            axes.append(axis / np.linalg.norm(axis))
            text += f"<{tag}><xyz{said}>{words(vector)}</xyz></{tag}>"
        self.joints[path + name] = Hinge(kind, (path + parent, path + child), np.array(pose.position), axes)
        ends = f"<parent>{parent}</parent><child>{child}</child>"
        return f'<joint name="{name}" type="{kind}">{place}{ends}{text}</joint>'


@pytest.mark.parametrize("seed", range(40))
def test_all_stand_where_they_were_drawn(tmp_path: Path, seed: int) -> None:
    drawn = Drawn(random.Random(f"frames {seed}"))
    (tmp_path / "model.sdf").write_text(drawn.file())
    assembly = read_assembly(tmp_path / "model.sdf")
    parts = {part.name: part for part in assembly.parts if "between" not in part.name}
    assert parts.keys() == drawn.links.keys()
    for name, link in drawn.links.items():
        pose, found = parts[name].pose, parts[name].mass_properties
        np.testing.assert_allclose(pose.position, link.pose.position, atol=1e-9)
        np.testing.assert_allclose(pose.rotation, link.pose.rotation, atol=1e-9)
        assert found.mass == link.mass
        np.testing.assert_allclose(pose.point(found.center_of_mass), link.center, atol=1e-9)
        np.testing.assert_allclose(pose.rotation @ found.inertia @ pose.rotation.T, link.inertia, atol=1e-8)
    joints = {joint.name: joint for joint in assembly.joints}
    for name, hinge in drawn.joints.items():
        second = joints.get(f"{name} second axis")
        assert (second is not None) == (hinge.kind == "universal")
        assert (joints[name].parent, (second or joints[name]).child) == hinge.ends
        np.testing.assert_allclose(joints[name].origin, hinge.origin, atol=1e-9)
        found_axes = [joint.axis for joint in (joints[name], second) if joint is not None and joint.axis is not None]
        assert len(found_axes) == len(hinge.axes)
        for axis, expected in zip(found_axes, hinge.axes, strict=True):
            np.testing.assert_allclose(axis, expected, atol=1e-9)
