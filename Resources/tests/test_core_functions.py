"""Functions of the MultiBody core subset against numpy and scipy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

E = np.array([2, -1, 2]) / 3
DYAD = np.array([[1, 2, 3], [2, 4, 5], [3, 5, 6]])


@pytest.fixture(scope="module")
def frames(simulate):
    return simulate("FrameFunctions", stop=2.0, interval=0.1)


@pytest.fixture(scope="module")
def own(simulate):
    return simulate("OwnFunctions", stop=2.0, interval=0.1)


def _angles(result):
    t = result["time"]
    return np.stack([0.3 + t, 0.5 * t - 0.4, 1.2 * t**2], axis=1)


def _direction(result):
    t = result["time"]
    return np.stack([np.ones_like(t), -2 * np.ones_like(t), 0.5 + t], axis=1)


def _matrix(rotation):
    """Coordinates in the old frame to coordinates in the turned one."""
    return rotation.inv().as_matrix()


def _turning(motion, t):
    """Angular velocity in the turned frame, by a central difference of fourth order."""
    step = 1e-4
    values = [_matrix(motion(t + k * step)) for k in (-2, -1, 1, 2)]
    rate = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step)
    product = -np.einsum("tij,tkj->tik", rate, _matrix(motion(t)))
    return np.stack([product[:, 2, 1], product[:, 0, 2], product[:, 1, 0]], axis=1)


@pytest.mark.parametrize(("name", "sequence"), [("R123", "XYZ"), ("R313", "ZXZ")])
def test_three_rotations(frames, vector, name, sequence):
    def motion(t):
        return Rotation.from_euler(sequence, np.stack([0.3 + t, 0.5 * t - 0.4, 1.2 * t**2], axis=1))

    np.testing.assert_allclose(vector(frames, f"{name}.T"), _matrix(motion(frames["time"])), atol=1e-13)
    np.testing.assert_allclose(vector(frames, f"{name}.w"), _turning(motion, frames["time"]), atol=1e-9)


def test_rotation_about_an_axis(frames, vector):
    angle = 0.3 + frames["time"]
    expected = _matrix(Rotation.from_rotvec(np.outer(angle, E)))
    np.testing.assert_allclose(vector(frames, "planar.T"), expected, atol=1e-13)
    np.testing.assert_allclose(vector(frames, "planar.w"), np.tile(E, (len(angle), 1)), atol=1e-13)
    wrapped = np.angle(np.exp(1j * angle))
    np.testing.assert_allclose(frames["planarAngle"], wrapped, atol=1e-12)
    about2 = _matrix(Rotation.from_euler("y", _angles(frames)[:, 1:2]))
    np.testing.assert_allclose(vector(frames, "about2.T"), about2, atol=1e-13)


def test_compositions_undo_each_other(frames, vector):
    for part in ("T", "w"):
        expected = vector(frames, f"R123.{part}")
        np.testing.assert_allclose(vector(frames, f"absolute.{part}"), expected, atol=1e-12)
        for name in ("fromT", "fromTinv", "fromT2"):
            np.testing.assert_allclose(vector(frames, f"{name}.{part}"), expected, atol=1e-12)
    product = vector(frames, "inverse.T") @ vector(frames, "R123.T")
    np.testing.assert_allclose(product, np.tile(np.eye(3), (len(product), 1, 1)), atol=1e-12)
    assert not vector(frames, "null.w").any()
    assert (vector(frames, "null.T") == np.eye(3)).all()


def test_vectors_and_tensors_resolve(frames, vector):
    T, P, v = vector(frames, "R123.T"), vector(frames, "planar.T"), _direction(frames)
    np.testing.assert_allclose(vector(frames, "v1"), np.einsum("tji,tj->ti", T, v), atol=1e-12)
    np.testing.assert_allclose(vector(frames, "v2"), np.einsum("tij,tj->ti", T, v), atol=1e-12)
    np.testing.assert_allclose(vector(frames, "vRelative"), np.einsum("tij,tkj,tk->ti", T, P, v), atol=1e-12)
    w1 = np.einsum("tji,tj->ti", T, vector(frames, "R123.w"))
    np.testing.assert_allclose(vector(frames, "w1"), w1, atol=1e-12)
    np.testing.assert_allclose(vector(frames, "dyad1"), np.einsum("tji,jk,tkl->til", T, DYAD, T), atol=1e-12)
    np.testing.assert_allclose(vector(frames, "dyad2"), np.einsum("tij,jk,tlk->til", T, DYAD, T), atol=1e-12)


def test_angles_come_back(frames, vector):
    wrapped = np.angle(np.exp(1j * _angles(frames)))
    solved = vector(frames, "angles123")
    np.testing.assert_allclose(solved, wrapped, atol=1e-10)
    euler = Rotation.from_euler("ZXZ", vector(frames, "angles313"))
    np.testing.assert_allclose(_matrix(euler), vector(frames, "R123.T"), atol=1e-10)
    assert np.all(np.abs(vector(frames, "angles313")) <= np.pi + 1e-12)
    # Of two solutions the one whose first angle is nearer to the guess, 0
    assert np.all(np.abs(vector(frames, "angles313")[:, 0]) <= np.pi / 2 + 1e-9)


def test_frames_from_two_vectors(frames, vector):
    x = np.array([1, 2, 3]) / np.sqrt(14)
    z = np.cross(x, [0, 1, 1]) / np.linalg.norm(np.cross(x, [0, 1, 1]))
    np.testing.assert_allclose(vector(frames, "fromAxes.T")[0], [x, np.cross(z, x), z], atol=1e-14)
    x, y = np.array([0.6, 0.8, 0]), np.cross([0, 0.6, 0.8], [0.6, 0.8, 0])
    y = y / np.linalg.norm(y)
    np.testing.assert_allclose(vector(frames, "fromXZ.T")[0], [x, y, np.cross(x, y)], atol=1e-14)
    parallel = vector(frames, "fromParallel.T")[0]
    np.testing.assert_allclose(parallel @ parallel.T, np.eye(3), atol=1e-14)
    np.testing.assert_allclose(parallel[0], [0, 1, 0], atol=1e-14)


def test_other_forms_of_an_orientation(frames, vector):
    T = vector(frames, "R123.T")
    np.testing.assert_allclose(vector(frames, "vector"), T.transpose(0, 2, 1).reshape(-1, 9), atol=0)
    np.testing.assert_allclose(vector(frames, "exy"), T.transpose(0, 2, 1)[:, :, :2], atol=0)
    assert np.abs(vector(frames, "orthonormality")).max() < 1e-13
    np.testing.assert_array_equal(vector(frames, "axis3")[0], [0, 0, 1])


def test_quaternions(frames, vector):
    T, Q = vector(frames, "R123.T"), vector(frames, "Q")
    np.testing.assert_allclose(_matrix(Rotation.from_quat(Q)), T, atol=1e-12)
    assert np.all(Q[:, 3] >= 0), "on the side of no rotation"
    np.testing.assert_allclose(vector(frames, "Qopposite"), -Q, atol=1e-12)
    np.testing.assert_allclose(vector(frames, "QofT"), -Q, atol=1e-12)
    np.testing.assert_allclose(vector(frames, "QofTinv"), Q, atol=1e-12)
    np.testing.assert_allclose(vector(frames, "TofQ"), T, atol=1e-12)
    np.testing.assert_allclose(vector(frames, "TinvOfQ"), T.transpose(0, 2, 1), atol=1e-12)
    planar = vector(frames, "Qplanar")
    np.testing.assert_allclose(_matrix(Rotation.from_quat(planar)), vector(frames, "planar.T"), atol=1e-12)
    relative = vector(frames, "Qrelative")
    np.testing.assert_allclose(_matrix(Rotation.from_quat(relative)), vector(frames, "relative.T"), atol=1e-12)
    np.testing.assert_allclose(vector(frames, "Qabsolute"), Q, atol=1e-12)
    np.testing.assert_allclose(vector(frames, "Qinverse"), Q * [-1, -1, -1, 1], atol=0)
    v1, v2 = vector(frames, "v1"), vector(frames, "v2")
    np.testing.assert_allclose(vector(frames, "Qv1"), v1, atol=1e-12)
    np.testing.assert_allclose(vector(frames, "Qv2"), v2, atol=1e-12)
    for name, expected in (("Qm1", v1), ("Qm2", v2)):
        np.testing.assert_allclose(vector(frames, name), np.stack([expected, 2 * expected], axis=2), atol=1e-12)
    np.testing.assert_allclose(frames["Qlength[1]"], 1.25, atol=1e-12)
    np.testing.assert_array_equal(vector(frames, "Qnull")[0], [0, 0, 0, 1])
    np.testing.assert_allclose(vector(frames, "Qsmall")[0], 1e-4 * E, atol=1e-12)


def test_own_functions(own, vector):
    T, w = vector(own, "R123.T"), vector(own, "R123.w")
    np.testing.assert_allclose(vector(own, "fromQ.T"), T, atol=1e-12)
    # Residue of the loop closure: tan(angle/2) along the axis
    for name in ("equality", "Qequality"):
        residue = np.tile(np.tan(0.1) * E, (len(T), 1))
        np.testing.assert_allclose(vector(own, name), residue, atol=1e-12)
    np.testing.assert_allclose(vector(own, "Qw2"), w, atol=1e-12)
    np.testing.assert_allclose(vector(own, "Qw1"), np.einsum("tji,tj->ti", T, w), atol=1e-12)
    np.testing.assert_allclose(vector(own, "small")[0], np.sin(1e-4) * E, atol=1e-14)
    np.testing.assert_allclose(vector(own, "smallWithResidues")[0][3:], 0, atol=1e-7)


def test_vector_functions(frames, vector):
    v = _direction(frames)
    length = np.linalg.norm(v, axis=1)
    np.testing.assert_allclose(frames["length"], length, atol=1e-13)
    for name in ("unit", "unitChecked"):
        np.testing.assert_allclose(vector(frames, name), v / length[:, None], atol=1e-13)
    assert not vector(frames, "nothing").any()


def test_mathematics_and_conversions(simulate, vector):
    result = simulate("MathFunctions")
    x = 0.2 + 0.3 * result["time"]
    functions = [np.sin(x), np.cos(x), np.tan(x), np.arcsin(x), np.arccos(x), np.arctan(x), np.arctan2(-x, -2.0)]
    functions += [np.sinh(x), np.cosh(x), np.tanh(x), np.exp(x), np.log(x), np.log10(x)]
    np.testing.assert_allclose(vector(result, "y"), np.stack(functions, axis=1), rtol=1e-13)
    factors = [180 / np.pi, np.pi / 180, 30 / np.pi, np.pi / 30, 3.6, 1 / 3.6, 1.0]
    np.testing.assert_allclose(vector(result, "c"), np.outer(x, factors), rtol=1e-13)
    constants = [np.pi, np.e, 9.80665, np.pi / 180, 180 / np.pi]
    np.testing.assert_allclose(vector(result, "k")[0], constants, rtol=1e-15)
