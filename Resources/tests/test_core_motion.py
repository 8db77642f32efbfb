"""Motion of the MultiBody core subset's bodies and joints against closed forms and conservation laws."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from scipy.special import ellipj, ellipk

G = 9.81
TOLERANCE = 1e-7


def _damped(t, x0, v0, frequency_squared, damping, rest):
    """Solution of x'' = -frequency_squared (x - rest) - damping x', underdamped."""
    decay = damping / 2
    omega = np.sqrt(frequency_squared - decay**2)
    a = x0 - rest
    b = (v0 + decay * a) / omega
    return rest + np.exp(-decay * t) * (a * np.cos(omega * t) + b * np.sin(omega * t))


@pytest.mark.full
@pytest.mark.parametrize("name", ["RevolutePendulum", pytest.param("RevoluteBackwards", marks=pytest.mark.full)])
def test_pendulum_follows_elliptic_function(simulate, name):
    result = simulate(name, stop=3.0)
    rate = np.sqrt(2 * G * 0.6 / (0.3 + 2 * 0.6**2))
    k = np.sin(1.2 / 2)
    # sn(u + K) = cd(u): the pendulum starts at rest at its largest angle.
    sn, cn, _, _ = ellipj(rate * result["time"] + ellipk(k**2), k**2)
    np.testing.assert_allclose(result["joint.phi"], 2 * np.arcsin(k * sn), atol=TOLERANCE)
    np.testing.assert_allclose(result["joint.w"], 2 * rate * k * cn, atol=10 * TOLERANCE)


@pytest.mark.full
def test_prismatic_with_spring_and_damper(simulate):
    result = simulate("PrismaticOscillator", stop=2.0)
    rest = 0.05 - 2 * G / 50
    expected = _damped(result["time"], 0.1, 0.2, 50 / 2, 3 / 2, rest)
    np.testing.assert_allclose(result["joint.s"], expected, atol=TOLERANCE)
    np.testing.assert_allclose(result["body.frame_a.r_0[3]"], expected, atol=TOLERANCE)


@pytest.mark.full
def test_cylindrical_falls_and_turns_independently(simulate):
    result = simulate("CylindricalScrew")
    t = result["time"]
    np.testing.assert_allclose(result["joint.s"], t - G * t**2 / 2, atol=TOLERANCE)
    np.testing.assert_allclose(result["joint.phi"], 2 * t, atol=TOLERANCE)


@pytest.mark.full
def test_universal_keeps_energy_and_is_two_rotations(simulate, vector):
    result = simulate("UniversalSwing", stop=2.0)
    np.testing.assert_allclose(result["energy"], result["energy"][0], atol=1e-7)
    assert np.ptp(result["joint.phi_a"]) > 0.5
    about = Rotation.from_euler("XY", np.stack([result["joint.phi_a"], result["joint.phi_b"]], axis=1))
    np.testing.assert_allclose(vector(result, "body.frame_a.R.T"), about.inv().as_matrix(), atol=1e-12)


@pytest.mark.full
def test_planar_throw_is_a_parabola(simulate):
    result = simulate("PlanarThrow")
    t = result["time"]
    np.testing.assert_allclose(result["body.frame_a.r_0[1]"], 0.1 + 2 * t, atol=TOLERANCE)
    np.testing.assert_allclose(result["body.frame_a.r_0[2]"], 0.2 + 3 * t - G * t**2 / 2, atol=TOLERANCE)
    np.testing.assert_allclose(result["joint.phi"], 0.3 + 4 * t, atol=TOLERANCE)


@pytest.mark.full
def test_planar_feels_the_part_of_gravity_in_its_plane(simulate, vector):
    result = simulate("PlanarTilted")
    normal = np.array([0.3, 0.2, 1.0]) / np.linalg.norm([0.3, 0.2, 1.0])
    gravity = np.array([0.0, 0.0, -G])
    expected = np.outer(result["time"] ** 2 / 2, gravity - normal * (normal @ gravity))
    np.testing.assert_allclose(vector(result, "body.frame_a.r_0"), expected, atol=TOLERANCE)
    along = np.array([1, 1, 0.5]) - normal * (normal @ [1, 1, 0.5])
    np.testing.assert_allclose(result["joint.s_x"], expected @ along / np.linalg.norm(along), atol=TOLERANCE)


@pytest.mark.parametrize(
    "name",
    [
        "SphericalCone",
        *(pytest.param(f"SphericalStates{kind}", marks=pytest.mark.full) for kind in ("Quaternions", "Angles")),
    ],
)
def test_spherical_circles_steadily(simulate, vector, name):
    result = simulate(name, stop=2.0)
    inertia = 0.1 + 1.5 * 0.8**2 - 0.04
    rate = np.sqrt(1.5 * G * 0.8 / (inertia * np.cos(0.7)))
    turn = rate * result["time"]
    axis = np.stack([np.sin(0.7) * np.cos(turn), np.sin(0.7) * np.sin(turn), np.full_like(turn, np.cos(0.7))], axis=1)
    np.testing.assert_allclose(vector(result, "body.frame_a.R.T")[:, 2], axis, atol=1e-6)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("FreeMotionQuaternions", marks=pytest.mark.full),
        pytest.param("FreeMotionAngles", marks=pytest.mark.full),
        "FreeMotionWithoutStates",
        "FreeBodyQuaternions",
        pytest.param("FreeBodyAngles", marks=pytest.mark.full),
        pytest.param("FreeBodyEnforced", marks=pytest.mark.full),
    ],
)
def test_free_symmetric_body_precesses_regularly(simulate, vector, name):
    """R(t) = exp(t L/I1) R(0) exp(-t lambda e3) with lambda = (I3 - I1)/I1 w3 (Landau and Lifshitz, Mechanics, 33)."""
    result = simulate(name, stop=2.0)
    t = result["time"]
    start = Rotation.from_euler("XYZ", [0.2, 0.3, 0.4])
    w_body = start.inv().apply([0.5, 0.4, 3])
    momentum = start.apply(np.array([0.2, 0.2, 0.3]) * w_body)
    rate = (0.3 - 0.2) / 0.2 * w_body[2]
    spin = Rotation.from_rotvec(np.outer(-rate * t, [0, 0, 1]))
    orientation = Rotation.from_rotvec(np.outer(t, momentum / 0.2)) * start * spin
    np.testing.assert_allclose(vector(result, "body.frame_a.R.T"), orientation.inv().as_matrix(), atol=1e-7)
    line = np.array([1, 2, 3]) + np.outer(t, [0.1, 0.2, 0.3])
    np.testing.assert_allclose(vector(result, "body.frame_a.r_0"), line, atol=1e-9)
    if name in ("FreeBodyQuaternions", "FreeBodyEnforced"):
        np.testing.assert_allclose(np.linalg.norm(vector(result, "body.Q"), axis=1), 1, atol=1e-8)


@pytest.mark.full
def test_chain_gains_momentum_by_gravity_alone(simulate, vector):
    result = simulate("FreeChain")
    momentum = vector(result, "momentum")
    weight = np.array([0, 0, -4 * G])
    np.testing.assert_allclose(momentum, momentum[0] + np.outer(result["time"], weight), atol=1e-6)
    assert np.ptp(result["joint.phi"]) > 0.1
    assert np.ptp(result["slide.s"]) > 0.1


def _gauss_inertia(density, size, hole, rotation, middle):
    """Mass, centre and inertia tensor about the centre by Gauss quadrature, exact for second moments."""
    points = np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T / np.sqrt(3) / 2
    total = np.zeros(())
    tensor = np.zeros((3, 3))
    for sign, extent in ((1, size), (-1, hole)):
        mass = sign * density * np.prod(extent) / 8
        for point in points * np.array(extent):
            total = total + mass
            tensor += mass * (point @ point * np.eye(3) - np.outer(point, point))
    return total, middle, rotation @ tensor @ rotation.T


@pytest.mark.full
def test_homogeneous_bodies_weigh_what_they_are_made_of(simulate, vector):
    result = simulate("Homogeneous")
    r = np.array([0.4, 0, 0.1])
    length = np.linalg.norm(r)
    axes = np.stack([r / length, [0, 1, 0], np.cross(r / length, [0, 1, 0])], axis=1)
    mass, centre, tensor = _gauss_inertia(1000, (length, 0.1, 0.2), (length, 0.04, 0.05), axes, r / 2)
    assert result["box.body.m"][0] == pytest.approx(mass, rel=1e-12)
    np.testing.assert_allclose(vector(result, "box.body.r_CM")[0], centre, atol=1e-12)
    np.testing.assert_allclose(vector(result, "box.body.I")[0], tensor, atol=1e-12)

    r = np.array([0.5, 0.1, 0])
    length, axis = np.linalg.norm(r), r / np.linalg.norm(r)
    # A ring of radius q and thickness dq: dm = 2 pi q dq l rho; moments q^2 along and q^2/2 + l^2/12 across the axis.
    q, weight = np.polynomial.legendre.leggauss(8)
    q, weight = 0.04 + 0.01 * q, 0.01 * weight
    ring = 2000 * 2 * np.pi * q * length * weight
    along, across = (ring * q**2).sum(), (ring * (q**2 / 2 + length**2 / 12)).sum()
    assert result["tube.body.m"][0] == pytest.approx(ring.sum(), rel=1e-12)
    expected = along * np.outer(axis, axis) + across * (np.eye(3) - np.outer(axis, axis))
    np.testing.assert_allclose(vector(result, "tube.body.I")[0], expected, atol=1e-12)


def test_point_gravity_gives_keplers_ellipse(simulate, vector):
    result = simulate("PointGravityOrbit", stop=3.0)
    mu, r0, v0 = 4.0, np.array([1.0, 0, 0]), np.array([0, 2.2, 0.4])
    energy = v0 @ v0 / 2 - mu
    np.testing.assert_allclose(result["energy"], energy, atol=1e-8)
    np.testing.assert_allclose(vector(result, "area"), np.tile(np.cross(r0, v0), (len(result["time"]), 1)), atol=1e-8)
    # The start is an apsis, since r0 and v0 are at right angles: Kepler's equation from there.
    a = -mu / (2 * energy)
    eccentricity = 1 - 1 / a
    motion = np.sqrt(mu / a**3)
    across = v0 / np.linalg.norm(v0)
    for t, position in zip(result["time"], vector(result, "planet.r_0"), strict=True):
        anomaly = brentq(lambda e, t=t: e - eccentricity * np.sin(e) - motion * t, -10, 20, xtol=1e-13)
        x, y = a * (np.cos(anomaly) - eccentricity), a * np.sqrt(1 - eccentricity**2) * np.sin(anomaly)
        np.testing.assert_allclose(position, x * r0 + y * across, atol=1e-7)


@pytest.mark.full
def test_gravity_can_be_any_function(simulate, vector):
    result = simulate("ExternalGravity", stop=2.0)
    t = result["time"]
    np.testing.assert_allclose(vector(result, "mass.r_0"), np.stack([np.cos(t), np.sin(t), t / 2], axis=1), atol=1e-8)


@pytest.mark.full
def test_line_forces_and_newton_for_the_whole(simulate, vector):
    result = simulate("LineForces")
    assert np.allclose(result["springDamper.f"], 40 * (result["springDamper.s"] - 0.5) + result["springDamper.f_d"])
    assert np.allclose(result["spring.f"], 30 * (result["spring.s"] - 0.4))
    rotation = vector(result, "lower.frame_a.R.T")
    w, z = vector(result, "lower.w_a"), vector(result, "lower.z_a")
    lever = np.array([0.05, 0, -0.1])
    local = np.cross(z, lever) + np.cross(w, np.cross(w, lever))
    centre = vector(result, "lower.a_0") + np.einsum("tij,ti->tj", rotation, local)
    upper, frame = vector(result, "upper.a_0"), vector(result, "lower.a_0")
    rate = 1.0 * upper + 0.8 * centre + 0.2 * (0.7 * upper + 0.3 * frame)
    outside = -vector(result, "support.frame_b.f") - vector(result, "ground.frame_b.f")
    outside = outside + np.array([0, 0, -2.0 * G])
    np.testing.assert_allclose(rate, outside, atol=1e-8)


@pytest.mark.full
def test_world_forces_obey_newton_and_euler(simulate, vector):
    result = simulate("WorldForces")
    rotation = vector(result, "body.frame_a.R.T")
    w, z = vector(result, "body.w_a"), vector(result, "body.z_a")
    lever = np.array([0.1, 0, 0])
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    force = np.array([1, 2, 3]) + np.array([c, s, 0]) + np.array([0, 0, 1]) + np.array([-s, c, 0])
    force_body = rotation @ force + np.array([0.5, -0.5, 0.2])
    torque = np.array([0.1, 0, 0]) + 0.1 * np.array([-s, c, 0]) + np.array([0, 0, 0.1])
    torque = torque + 0.1 * (np.array([c, s, 0]) + np.array([-s, c, 0]))
    centre = np.einsum("tij,tj->ti", rotation, vector(result, "body.a_0"))
    centre = centre + np.cross(z, lever) + np.cross(w, np.cross(w, lever))
    np.testing.assert_allclose(2 * centre, force_body, atol=1e-9)
    inertia = np.array([0.1, 0.2, 0.3])
    about_centre = rotation @ torque - np.cross(lever, force_body)
    np.testing.assert_allclose(inertia * z + np.cross(w, inertia * w), about_centre, atol=1e-9)


@pytest.mark.full
def test_mutual_forces_keep_momentum_and_angular_momentum(simulate, vector):
    result = simulate("MutualForces")
    for name in ("momentum", "spin"):
        values = vector(result, name)
        np.testing.assert_allclose(values, np.tile(values[0], (len(values), 1)), atol=2e-7)
    assert np.ptp(result["first.r_0[3]"]) > 0.1


@pytest.mark.full
def test_driven_arm_with_sliding_load(simulate):
    result = simulate("DrivenRobot")
    t = result["time"]
    np.testing.assert_allclose(result["shoulder.phi"], 0.5 * (1 - np.cos(2 * t)), atol=1e-12)

    def radial(time, state):
        phi, rate = 0.5 * (1 - np.cos(2 * time)), np.sin(2 * time)
        s, v = state
        return [v, (0.5 + s) * rate**2 + G * np.sin(phi) - (200 * (s - 0.1) + 5 * v) / 0.5]

    expected = solve_ivp(radial, (0, t[-1]), [0.1, 0], t_eval=t, rtol=1e-11, atol=1e-13).y
    np.testing.assert_allclose(result["slide.s"], expected[0], atol=TOLERANCE)
    np.testing.assert_allclose(result["slide.v"], expected[1], atol=TOLERANCE)


@pytest.mark.full
def test_sensors_measure_what_the_frames_say(simulate, vector):
    result = simulate("Sensors", interval=0.004)
    position = vector(result, "rod.frame_b.r_0")
    tip, base = vector(result, "rod.frame_b.R.T"), vector(result, "arm.frame_a.R.T")
    np.testing.assert_array_equal(vector(result, "position.r"), position)
    np.testing.assert_allclose(vector(result, "positionInFrame.r"), np.einsum("tij,tj->ti", tip, position), atol=1e-12)
    # Differences of the interpolated output: 1e-10 by 0.004 s, and their own truncation, leave less than 1e-6.
    inner = slice(2, -2)

    def rate(values):
        """Central difference of fourth order."""
        return (values[:-4] - 8 * values[1:-3] + 8 * values[3:-1] - values[4:]) / (12 * 0.004)

    velocity = np.einsum("tij,tj->ti", base[inner], rate(position))
    np.testing.assert_allclose(vector(result, "velocity.v")[inner], velocity, atol=1e-6)
    seen = np.einsum("tij,tj->ti", base, position)
    np.testing.assert_allclose(vector(result, "relativePosition.r_rel"), seen, atol=1e-12)
    seen_rate = np.einsum("tij,tkj,tk->ti", tip[inner], base[inner], rate(seen))
    np.testing.assert_allclose(vector(result, "relativeVelocity.v_rel")[inner], seen_rate, atol=1e-6)
    np.testing.assert_allclose(result["distance.distance"], np.linalg.norm(position, axis=1), atol=1e-12)
    w = vector(result, "angularVelocity.w")
    turning = np.einsum("tij,tkj->tik", rate(tip), tip[inner])
    np.testing.assert_allclose(
        w[inner], -np.stack([turning[:, 2, 1], turning[:, 0, 2], turning[:, 1, 0]], 1), atol=1e-6
    )
    about = np.stack([-np.sin(result["turn.phi"]), np.cos(result["turn.phi"]), 0 * result["time"]], axis=1)
    swing = about * result["swing.w"][:, None]
    np.testing.assert_allclose(vector(result, "relativeAngularVelocity.w_rel"), swing, atol=1e-9)
    angles = vector(result, "angles.angles")
    np.testing.assert_allclose(Rotation.from_euler("ZYX", angles).inv().as_matrix(), tip, atol=1e-12)
    force, torque = vector(result, "cutForce.force"), -vector(result, "cutTorque.torque")
    hinge = np.einsum("tij,tj->ti", vector(result, "cutForce.frame_a.R.T"), rate_of_hinge(result))
    local_torque = np.einsum("tij,tj->ti", vector(result, "cutForce.frame_a.R.T"), torque)
    turn = np.stack([0 * result["time"], 0 * result["time"], result["turn.w"]], axis=1)
    power = (force * hinge).sum(axis=1) + (local_torque * turn).sum(axis=1)
    np.testing.assert_allclose(result["power.power"], power, atol=1e-9)
    # What passes the cut moves the rod: Newton for its centre.
    w, z, lever = vector(result, "rod.body.w_a"), vector(result, "rod.body.z_a"), np.array([0, 0, -0.3])
    centre = np.cross(z, lever) + np.cross(w, np.cross(w, lever))
    centre = np.einsum("tji,tj->ti", vector(result, "rod.frame_a.R.T"), centre) + vector(result, "rod.body.a_0")
    world_force = np.einsum("tji,tj->ti", vector(result, "cutForce.frame_a.R.T"), force)
    np.testing.assert_allclose(world_force, 0.5 * (centre + np.array([0, 0, G])), atol=1e-9)


def rate_of_hinge(result):
    """Velocity of the end of the arm, in coordinates of the world frame."""
    phi, w = result["turn.phi"], result["turn.w"]
    return 0.5 * np.stack([-np.sin(phi) * w, np.cos(phi) * w, 0 * phi], axis=1)
