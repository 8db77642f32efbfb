"""The law of anchored friction alone: what it can take, what it may not give, and where it slips."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model
from library_compiler import REPOSITORY, standard_library
from modelica2fmu.build import BuildOptions, build_fmu
from numpy.typing import NDArray

Array = NDArray[np.float64]
UP = np.tile([0.0, 0.0, 1.0], (4, 1))
CORNERS = np.array([[0.1, 0.1, 0], [-0.1, 0.1, 0], [-0.1, -0.1, 0], [0.1, -0.1, 0]])
MU = 0.4


@dataclass(frozen=True)
class Patch:
    """Arguments of the law: a square face of 10 N at rest if nothing else is said."""

    normal_force: Array
    normal: Array
    point: Array
    velocity: Array
    anchor: Array
    w: Array
    stiffness: float
    mu_static: float
    mu_dynamic: float

    def capacity(self) -> float:
        return self.mu_dynamic * float(self.normal_force.sum())


def square() -> Patch:
    return Patch(np.full(4, 2.5), UP, CORNERS, np.zeros((4, 3)), np.zeros(6), np.zeros(3), 1e6, MU, MU)


class Law:
    """The library's function inside an FMU: forces on the points and rate of the anchor."""

    def __init__(self, fmu: Path, folder: Path) -> None:
        description = read_model_description(str(fmu))
        self._reference = {v.name: v.valueReference for v in description.modelVariables}
        self._fmu = FMU2Model(
            guid=description.guid,
            unzipDirectory=extract(str(fmu), unzipdir=str(folder)),
            modelIdentifier=description.modelExchange.modelIdentifier,
            instanceName="law",
        )
        self._fmu.instantiate()
        self._fmu.setupExperiment(startTime=0.0)
        self._fmu.enterInitializationMode()
        self._fmu.exitInitializationMode()
        self._inputs = [
            *self._elements("normalForce", 4),
            *(e for name in ("normal", "point", "velocity") for e in self._elements(name, 4, 3)),
            *self._elements("anchor", 6),
            *self._elements("w", 3),
            *(self._reference[name] for name in ("stiffness", "muStatic", "muDynamic")),
        ]
        self._outputs = [*self._elements("force", 4, 3), *self._elements("anchorRate", 6)]

    def _elements(self, name: str, rows: int, columns: int = 0) -> list[int]:
        if columns == 0:
            return [self._reference[f"{name}[{i}]"] for i in range(1, rows + 1)]
        return [self._reference[f"{name}[{i},{j}]"] for i in range(1, rows + 1) for j in range(1, columns + 1)]

    def __call__(self, patch: Patch) -> tuple[Array, Array]:
        values = np.concatenate(
            [
                *(
                    np.ravel(part)
                    for part in (patch.normal_force, patch.normal, patch.point, patch.velocity, patch.anchor, patch.w)
                ),
                [patch.stiffness, patch.mu_static, patch.mu_dynamic],
            ]
        )
        self._fmu.setReal(self._inputs, [float(value) for value in values])
        result = np.array(self._fmu.getReal(self._outputs))
        return result[:12].reshape(4, 3), result[12:]

    def close(self) -> None:
        self._fmu.terminate()
        self._fmu.freeInstance()


@pytest.fixture(scope="module")
def law(tmp_path_factory: pytest.TempPathFactory, fmu_cache: Path) -> Iterator[Law]:
    folder = tmp_path_factory.mktemp("patch")
    options = BuildOptions(msl=standard_library("core"), cache=fmu_cache)
    sources = [REPOSITORY / "ContactMultiBodyTest", REPOSITORY / "ContactMultiBody"]
    report = build_fmu("ContactMultiBodyTest.Laws.FrictionOfPatch", sources, folder / "patch.fmu", options)
    made = Law(report.fmu, folder / "unzipped")
    yield made
    made.close()


def rigid(point: Array, v: Array, w: Array) -> Array:
    return np.asarray(v + np.cross(w, point), dtype=float)


def any_patch(rng: np.random.Generator) -> Patch:
    """Any state there may be: points far apart or on one spot, normals that agree or not, springs stretched too far."""
    force = rng.uniform(0, 1, 4) * 10 ** rng.uniform(-3, 3) * (rng.random(4) < 0.8)
    normal = rng.normal(size=(4, 3)) * rng.choice([0, 0.05, 1]) + [0, 0, rng.choice([1e-3, 1])]
    point = np.tile(rng.normal(size=3), (4, 1)) if rng.random() < 0.2 else rng.normal(size=(4, 3))
    point = point * 10 ** rng.uniform(-4, 0)
    stiffness, mu = 10 ** rng.uniform(3, 7), rng.uniform(0, 1)
    speed, turning = 10 ** rng.uniform(-6, 1), 10 ** rng.uniform(-4, 2)
    return Patch(
        normal_force=force,
        normal=normal / np.linalg.norm(normal, axis=1)[:, None],
        point=point,
        velocity=rigid(point, rng.normal(size=3) * speed, rng.normal(size=3) * turning),
        anchor=rng.normal(size=6) * mu * force.sum() / stiffness * 10 ** rng.uniform(-1, 0.5),
        w=rng.normal(size=3) * 10,
        stiffness=stiffness,
        mu_static=mu * rng.uniform(1, 2),
        mu_dynamic=mu,
    )


def test_no_state_gives_energy(law: Law) -> None:
    """What the springs gain is never more than what the bodies put in, at each instant, so over any motion."""
    rng = np.random.default_rng(1)
    for _ in range(2000):
        patch = any_patch(rng)
        force, rate = law(patch)
        put_in, gained = -force * patch.velocity, patch.stiffness * patch.anchor * rate
        scale = np.abs(put_in).sum() + np.abs(gained).sum()
        assert gained.sum() - put_in.sum() <= 1e-13 * scale, patch


def test_friction_is_tangential_and_within_its_limit(law: Law) -> None:
    rng = np.random.default_rng(2)
    for _ in range(1000):
        patch = any_patch(rng)
        force, _ = law(patch)
        sizes = np.linalg.norm(force, axis=1)
        assert sizes.sum() <= patch.mu_static * patch.normal_force.sum() * (1 + 1e-12)
        assert np.abs(np.einsum("ki,ki->k", force, patch.normal)).max() <= 1e-12 * (sizes.max() + 1e-300)


def test_the_order_of_the_points_does_not_matter(law: Law) -> None:
    """Points that swap their places in the list, as beside a flat rest, keep their forces."""
    rng = np.random.default_rng(7)
    compared = 0
    for _ in range(500):
        patch = any_patch(rng)
        force, rate = law(patch)
        order = rng.permutation(4)
        if not patch.normal_force.any() or (order == np.arange(4)).all():
            continue
        swapped = replace(
            patch,
            normal_force=patch.normal_force[order],
            normal=patch.normal[order],
            point=patch.point[order],
            velocity=patch.velocity[order],
        )
        other_force, other_rate = law(swapped)
        assert other_force == pytest.approx(force[order], rel=1e-6, abs=1e-9 * np.abs(force).max()), patch
        assert other_rate == pytest.approx(rate, rel=1e-6, abs=1e-9 * np.abs(rate).max()), patch
        compared += 1
    assert compared > 300


@pytest.mark.full
def test_a_motion_round_a_closed_way_takes_energy(law: Law) -> None:
    """Points that circle, rock and change their load; what goes in less what is stored never falls."""
    patch, lost_so_far, taken, dt = square(), 0.0, 0.0, 2e-6
    for step in range(4000):
        t = step * dt
        point = CORNERS * [1, 0.5, 1] + 0.02 * np.sin(3000 * t)
        load = 2.5 * (1 + 0.9 * np.sin(2000 * t + np.arange(4)))
        w = np.array([0, 0, 0.5 * np.sin(900 * t)])
        velocity = rigid(point, np.array([0.05 * np.cos(1300 * t), 0.03 * np.sin(1700 * t), 0]), w)
        patch = replace(patch, normal_force=load, point=point, velocity=velocity, w=w / 2)
        force, rate = law(patch)
        middle = replace(patch, anchor=patch.anchor + dt / 2 * rate)
        force, rate = law(middle)
        patch = replace(patch, anchor=patch.anchor + dt * rate)
        taken -= dt * float((force * velocity).sum())
        lost = taken - 0.5 * patch.stiffness * float(patch.anchor @ patch.anchor)
        assert lost >= lost_so_far - 1e-12
        lost_so_far = lost
    assert lost_so_far > 1e-4


def settled(law: Law, patch: Patch) -> Array:
    """Forces after sliding on with the same velocities until nothing changes."""
    way = patch.capacity() / patch.stiffness
    speed = float(np.sqrt((patch.normal_force @ (patch.velocity**2).sum(axis=1)) / patch.normal_force.sum()))
    for _ in range(800):
        _, rate = law(patch)
        patch = replace(patch, anchor=patch.anchor + 0.02 * way / speed * rate)
    return law(patch)[0]


def coulomb(patch: Patch) -> Array:
    speeds = np.linalg.norm(patch.velocity, axis=1)
    return np.asarray(-patch.mu_dynamic * (patch.normal_force / speeds)[:, None] * patch.velocity)


def resultant(patch: Patch, force: Array) -> Array:
    """Force and torque about the centre of pressure, by the radius of gyration."""
    weight = patch.normal_force / patch.normal_force.sum()
    lever = patch.point - weight @ patch.point
    radius = np.sqrt(weight @ (lever**2).sum(axis=1))
    return np.concatenate([force.sum(axis=0), np.cross(lever, force).sum(axis=0) / radius])


@pytest.mark.parametrize("turning", [0.0, 0.3, 1.0, 3.0, 1e3])
def test_a_face_that_slides_and_turns_has_the_sliding_friction_of_its_points(law: Law, turning: float) -> None:
    rng = np.random.default_rng(4)
    for _ in range(3):
        point = np.column_stack([rng.normal(size=(4, 2)) * 0.1, np.zeros(4)])
        force = rng.uniform(0.2, 1, 4) * 100
        v = np.array([*rng.normal(size=2), 0])
        spin = np.array([0, 0, turning * np.linalg.norm(v) / 0.1])
        centre = force @ point / force.sum()
        patch = replace(square(), point=point, normal_force=force, velocity=rigid(point - centre, v, spin))
        difference = resultant(patch, settled(law, patch)) - resultant(patch, coulomb(patch))
        assert np.linalg.norm(difference) < 5e-3 * patch.capacity()


def test_a_peg_in_a_hole_is_held_though_its_normals_cancel(law: Law) -> None:
    normal = np.array([[1.0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
    spinning = replace(square(), normal=normal, point=-0.1 * normal, normal_force=np.full(4, 100.0))
    spinning = replace(spinning, velocity=rigid(spinning.point, np.zeros(3), np.array([0, 0, 2.0])))
    torque = np.cross(spinning.point, settled(law, spinning)).sum(axis=0)
    assert torque == pytest.approx([0, 0, -MU * 400 * 0.1], rel=2e-3, abs=1e-9)
    held = replace(spinning, velocity=np.zeros((4, 3)), anchor=np.array([0, 0, 5e-5, 0, 0, 5e-5]))
    assert law(held)[1] == pytest.approx(np.zeros(6), abs=1e-15)


def test_what_sticks_is_elastic_up_to_nine_tenths(law: Law) -> None:
    """The rate of the anchor is the velocity of the face, whatever its direction."""
    rng = np.random.default_rng(5)
    limit = MU * 10 / 1e6
    for _ in range(100):
        anchor = rng.normal(size=6) * [1, 1, 0, 0, 0, 1]
        stretch = anchor[:3] + np.cross(anchor[3:], CORNERS / np.sqrt(0.02))
        anchor *= rng.uniform(0, 0.89) * limit / np.linalg.norm(stretch, axis=1).max()
        v, spin = np.array([*rng.normal(size=2), 0]), np.array([0, 0, 10 * rng.normal()])
        patch = replace(square(), anchor=anchor, velocity=rigid(CORNERS, v, spin))
        _, rate = law(patch)
        expected = np.array([*v, 0, 0, spin[2] * np.sqrt(0.02)])
        assert rate == pytest.approx([*expected[:3], 0, 0, expected[5]], rel=5e-3)
        still, rate = law(replace(patch, velocity=np.zeros((4, 3))))
        assert np.abs(rate).max() < 1e-15
        assert resultant(patch, still) == pytest.approx(-1e6 * anchor, rel=5e-3, abs=1e-9)


def test_points_that_roll_do_not_stretch_anything(law: Law) -> None:
    """Where the contact lies, how it is loaded and how fast the bodies roll do not matter while nothing slides."""
    rng = np.random.default_rng(6)
    anchor = np.array([1e-6, 5e-7, 0, 0, 0, 1e-6])
    for _ in range(100):
        point = np.column_stack([rng.normal(size=(4, 2)), np.zeros(4)])
        w = np.array([*rng.normal(size=2) * 50, 0])
        force, rate = law(replace(square(), point=point, anchor=anchor, w=w, normal_force=rng.uniform(5, 9, 4)))
        assert np.abs(rate).max() < 1e-15
        assert force.sum(axis=0)[:2] == pytest.approx(-1e6 * anchor[:2], rel=5e-3)


@pytest.mark.parametrize("speed", [1e-6, 0.005, 0.02, 1.0])
def test_each_point_has_the_friction_of_its_own_speed(law: Law, speed: float) -> None:
    patch = replace(square(), normal_force=np.full(4, 250.0), mu_static=0.6)
    patch = replace(patch, velocity=np.tile([speed, 0, 0], (4, 1)))
    expected = 1000 * (0.4 + 0.2 * np.exp(-((speed / 0.01) ** 2)))
    assert settled(law, patch).sum(axis=0) == pytest.approx([-expected, 0, 0], rel=1e-3, abs=1e-9)


def test_without_normal_force_all_is_forgotten_and_nothing_given(law: Law) -> None:
    patch = replace(
        square(), normal_force=np.zeros(4), anchor=np.full(6, 1e-6), velocity=rigid(CORNERS, np.ones(3), np.ones(3))
    )
    force, rate = law(patch)
    assert np.abs(force).max() == 0
    assert (rate < -0.9 * 1e-6 / 1e-3).all()
