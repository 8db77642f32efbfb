"""The scene of an FMU of a hand-written model: bodies, shapes and pairs, as its variables tell them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
from contact_foundation.errors import InputError, Place

from fmu_regression.fmi.description import ModelDescription, Variable
from fmu_regression.fmi.fmu import open_fmu
from fmu_regression.results.result import FloatArray
from fmu_regression.scene.descriptor_mesh import descriptor_meshes
from fmu_regression.scene.scene_file import ContactPair, Scene, SceneBody, load_scene

_MANAGER: Final = re.compile(r"(.+)\.pairDistance\[1\]")
_BODY_MANAGER: Final = re.compile(r"(.+)\.force\[1,1\]")
_WITHOUT_FRAMES: Final = re.compile(r"(.+)\.contactCount")
_FRAME: Final = re.compile(r"(.+)\.(frame_[ab])\.r_0\[1\]")
_AXES: Final = (1, 2, 3)
_MOVES: Final = ("continuous", "discrete")


def load_scene_of(path: Path) -> Scene:
    """The scene of a file: ``scene.json``, or an FMU that holds a contact manager.

    Raises:
        InputError: the file is wrong, or the FMU has no contact manager whose bodies are found.
    """
    return scene_of_fmu(path) if path.suffix == ".fmu" else load_scene(path)


def scene_of_fmu(path: Path) -> Scene:
    """The scene that the first contact manager of an FMU shows, as it is after initialization.

    Bodies are the components whose ``frame_a`` or ``frame_b`` has the variables of the manager's frames; what has no
    mass of its own counts as fixed where it does not move.

    Raises:
        InputError: there is no contact manager that tells its bodies, or a body of it is not found.
    """
    with open_fmu(path) as opened:
        description = opened.description
        found = _manager(description)
        if found is None:
            raise _no_scene(description, path)
        mode = "me" if "me" in description.identifiers else "cs"
        with opened.instantiate(mode) as instance:  # type: ignore[arg-type]
            instance.functions.enter_initialization(1e-6, description.start, description.start + 1.0)
            instance.functions.exit_initialization()
            numbers = [v for v in description.variables.values() if v.kind in ("Real", "Integer")]
            values: dict[str, float] = {}
            for data_type in {variable.data_type for variable in numbers}:
                chosen = [variable for variable in numbers if variable.data_type == data_type]
                read = instance.functions.reader(data_type, [variable.reference for variable in chosen])
                values.update(zip((v.name for v in chosen), map(float, read()), strict=True))
    return _Reading(path, description, found, values).scene()


def _manager(description: ModelDescription) -> str | None:
    """The first manager that shows pairs, or else the first that shows the forces on its frames."""
    names = description.variables
    pairs = (match[1] for name in names if (match := _MANAGER.fullmatch(name)))
    bodies = (match[1] for name in names if (match := _BODY_MANAGER.fullmatch(name)))
    of_frames = (name for name in bodies if f"{name}.contactCount" in names and f"{name}.frame[1].r_0[1]" in names)
    return next(pairs, None) or next(of_frames, None)


def _no_scene(description: ModelDescription, path: Path) -> InputError:
    name = next((match[1] for name in description.variables if (match := _WITHOUT_FRAMES.fullmatch(name))), None)
    if name is None:
        said = "the FMU has no contact manager, so there is no scene to report on"
        return InputError(said, place=Place(file=path), remedy="Leave --scene out, or name a scene.json.")
    return InputError(
        f"{name} holds its bodies itself, and a report shows bodies that are components of their own",
        place=Place(file=path, component=name),
        remedy=f"Leave --scene out, and plot {name}.contactCount and others; or take a contact manager.",
    )


class _Frame(NamedTuple):
    """A frame of a component; what is fixed in the world has a frame_b alone."""

    component: str
    name: str

    @property
    def positions(self) -> list[str]:
        return [f"{self.component}.{self.name}.r_0[{i}]" for i in _AXES]

    @property
    def rotations(self) -> list[str]:
        return [f"{self.component}.{self.name}.R.T[{i},{j}]" for i in _AXES for j in _AXES]


class _Reading:
    def __init__(self, path: Path, description: ModelDescription, manager: str, values: Mapping[str, float]) -> None:
        self._path = path
        self._description = description
        self._variables = description.variables
        self._manager = manager
        self._values = values
        frames = [_Frame(*match.groups()) for name in self._variables if (match := _FRAME.fullmatch(name))]
        self._frames = sorted(frames, key=lambda frame: frame.name)  # frame_a first

    def scene(self) -> Scene:
        count = self._count("geometry[{}]")
        bodies = [self._body(number) for number in range(1, count + 1)]
        pairs = []
        for index in range(1, self._count("pair[{},1]") + 1):
            first, second = (int(self._values[f"{self._manager}.pair[{index},{side}]"]) for side in (1, 2))
            restitution = self._values.get(f"{self._manager}.restitution[{index}]")
            pairs.append(ContactPair(index, (bodies[first - 1].name, bodies[second - 1].name), restitution))
        direction = self._numbers([f"world.n[{i}]" for i in _AXES])
        gravity = np.zeros(3) if direction is None else direction * self._values.get("world.g", 0.0)
        name = self._description.name
        by_body = f"{self._manager}.pairDistance[1]" not in self._variables
        colliders = tuple(body.name for body in bodies) if by_body else ()
        return Scene(name, gravity, tuple(bodies), (), tuple(pairs), self._manager, colliders)

    def _count(self, pattern: str) -> int:
        count = 0
        while f"{self._manager}.{pattern.format(count + 1)}" in self._variables:
            count += 1
        return count

    def _body(self, number: int) -> SceneBody:
        descriptor = self._variables[f"{self._manager}.geometry[{number}]"].start or ""
        frame = self._frame(number, descriptor)
        component = frame.component
        moves = any(self._variables[name].variability in _MOVES for name in (*frame.positions, *frame.rotations))
        # A BodyBox has its mass in a body inside.
        massive = next(
            (name for name in (component, f"{component}.body") if f"{name}.I[1,1]" in self._values), component
        )
        center = self._numbers([f"{massive}.r_CM[{i}]" for i in _AXES])
        inertia = self._numbers([f"{massive}.I[{i},{j}]" for i in _AXES for j in _AXES])
        return self._seen_from(
            _Frame(component, "frame_a"),
            SceneBody(
                name=component,
                label=component,
                variable=component,
                fixed=not moves,
                position=self._required(frame.positions),
                rotation=self._required(frame.rotations).reshape(3, 3),
                mass=self._values.get(f"{massive}.m", 0.0),
                center_of_mass=np.zeros(3) if center is None else center,
                inertia=np.zeros((3, 3)) if inertia is None else inertia.reshape(3, 3),
                meshes=descriptor_meshes(descriptor, number),
                frame=frame.name,
            ),
        )

    def _seen_from(self, own: _Frame, body: SceneBody) -> SceneBody:
        """A body whose centre of mass and inertia are told in its own frame, told in the frame that it is seen from."""
        position, rotation = self._numbers(own.positions), self._numbers(own.rotations)
        if own.name == body.frame or position is None or rotation is None:
            return body
        turned = body.rotation @ rotation.reshape(3, 3).T
        center = turned @ body.center_of_mass + body.rotation @ (position - body.position)
        return replace(body, center_of_mass=center, inertia=turned @ body.inertia @ turned.T)

    def _frame(self, number: int, descriptor: str) -> _Frame:
        """The component's frame that a frame of the manager is connected to: its position is the same variable."""
        own = [self._variables[f"{self._manager}.frame[{number}].r_0[{i}]"] for i in _AXES]
        same = [frame for frame in self._frames if self._is_same(own, frame)]
        of_shape = [frame for frame in same or self._frames if self._shape(frame.component) == descriptor]
        found = of_shape or same
        if not found:
            raise InputError(
                f"no component's frame_a or frame_b is found that {self._manager}.frame[{number}] is connected to",
                place=Place(file=self._path),
                remedy="Connect the manager with the bodies' own frames.",
            )
        return next((frame for frame in found if f"{frame.component}.m" in self._values), found[0])

    def _is_same(self, own: Sequence[Variable], frame: _Frame) -> bool:
        other = [self._variables[name] for name in frame.positions]
        return all(
            a.reference == b.reference or (a.variability not in _MOVES and self._values[a.name] == self._values[b.name])
            for a, b in zip(own, other, strict=True)
        )

    def _shape(self, component: str) -> str | None:
        variable = self._variables.get(f"{component}.geometry")
        return None if variable is None else variable.start

    def _numbers(self, names: Sequence[str]) -> FloatArray | None:
        if any(name not in self._values for name in names):
            return None
        return np.array([self._values[name] for name in names])

    def _required(self, names: Sequence[str]) -> FloatArray:
        found = self._numbers(names)
        if found is None:
            raise InputError(f"the FMU has no {names[0]}", place=Place(file=self._path))
        return found
