"""Dynamics of the tensegrity needle holder: against the energy of its points, and Lagrange."""

import numpy as np
import pytest

from app.mechanisms.errors import MechanismError, SingularError
from app.mechanisms.tensegrity import (
    GuideMasses,
    JointReading,
    TensegrityGeometry,
    forward,
    inverse,
    jacobian,
    machine_points,
)
from app.mechanisms.tensegrity.dynamics import guide_dynamics

READINGS = [TensegrityGeometry(reading=reading) for reading in JointReading]
both = pytest.mark.parametrize("geometry", READINGS, ids=lambda g: g.reading.value)
MASSES = GuideMasses()
POSES = [(0.0, 0.0, 1.0), (0.3, 0.2, 1.0), (-0.4, 0.5, 1.0), (0.5, -0.6, 1.0)]
GRAVITY = np.array([1.0, -2.0, -9.0])


def weights(geometry, beta):
    """Places (n, 3) [m] and masses (n,) [kg] of many small pieces of all bars, by Gauss' rule."""
    shown = machine_points(geometry, forward(geometry, beta))
    nodes, shares = np.polynomial.legendre.leggauss(12)
    places, masses = [], []
    for start, end in shown.bars:
        radius = geometry.radii[int(start[-1]) - 1]
        u, v = shown.points[start] / radius, shown.points[end] / radius
        side = geometry.sides[int(start[-1]) - 1]
        for node, share in zip(nodes, shares, strict=True):
            phi = 0.5 * side * (1.0 + node)
            places.append(radius * (np.sin(side - phi) * u + np.sin(phi) * v) / np.sin(side))
            masses.append(MASSES.density * radius * side * 0.5 * share)
    return np.array(places), np.array(masses)


@both
def test_mass_and_gravity_are_those_of_all_the_bars_points_and_the_guide(geometry):
    h = 1e-5
    for t in POSES:
        beta = inverse(geometry, t)
        found = guide_dynamics(geometry, MASSES, beta, gravity=GRAVITY)
        _, masses = weights(geometry, beta)
        moved = [
            (weights(geometry, beta + d)[0] - weights(geometry, beta - d)[0]) / (2.0 * h)
            for d in h * np.eye(2)
        ]
        inertia, moment = MASSES.along
        by_joints = jacobian(geometry, beta)
        mass = inertia * by_joints.T @ by_joints
        mass += np.array([[np.sum(masses[:, None] * a * b) for a in moved] for b in moved])
        assert found.mass == pytest.approx(mass, rel=1e-7)
        fall = -moment * GRAVITY @ by_joints
        fall -= np.array([masses @ (a @ GRAVITY) for a in moved])
        assert found.gravity == pytest.approx(fall, rel=1e-6, abs=1e-9)


@both
def test_velocity_terms_are_those_of_lagrange(geometry):
    """h_k = Σ (∂M_ki/∂β_j - ½ ∂M_ij/∂β_k) v_i v_j."""
    rng, h = np.random.default_rng(1), 1e-5
    for t in POSES:
        beta, rates = inverse(geometry, t), rng.uniform(-2.0, 2.0, 2)
        by = np.array(
            [
                guide_dynamics(geometry, MASSES, beta + d).mass
                - guide_dynamics(geometry, MASSES, beta - d).mass
                for d in h * np.eye(2)
            ]
        ) / (2.0 * h)  # [j, i, k] = ∂M_ik/∂β_j
        lagrange = np.einsum("jki,i,j->k", by, rates, rates)
        lagrange -= 0.5 * np.einsum("kij,i,j->k", by, rates, rates)
        found = guide_dynamics(geometry, MASSES, beta, rates).velocity
        assert found == pytest.approx(lagrange, rel=1e-6, abs=1e-9)


def test_a_needle_adds_its_inertia_its_weight_and_what_its_sliding_brings():
    geometry = READINGS[0]
    beta, rates = inverse(geometry, (0.2, 0.1, 1.0)), np.array([0.7, -0.4])
    by_joints = jacobian(geometry, beta)
    without = guide_dynamics(geometry, MASSES, beta, rates)
    having = guide_dynamics(geometry, MASSES, beta, rates, needle=(3e-4, 2e-3, 1e-4))
    assert having.mass - without.mass == pytest.approx(3e-4 * by_joints.T @ by_joints)
    still = guide_dynamics(geometry, MASSES, beta, rates, needle=(3e-4, 2e-3, 0.0))
    sliding = 1e-4 * by_joints.T @ by_joints @ rates
    assert having.velocity - still.velocity == pytest.approx(sliding)
    lifted = 2e-3 * 9.80665 * by_joints[2]
    assert having.gravity - without.gravity == pytest.approx(lifted)


def test_the_mass_matrix_is_positive_all_over_the_cone():
    rng = np.random.default_rng(2)
    for geometry in READINGS:
        for _ in range(100):
            tilt, turn = np.deg2rad(40.0) * rng.uniform(), rng.uniform(0.0, 7.0)
            t = (np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt))
            mass = guide_dynamics(geometry, MASSES, inverse(geometry, t)).mass
            assert np.linalg.eigvalsh(mass).min() > 0.0


def test_a_pose_without_dynamics_and_impossible_masses_are_named():
    geometry = READINGS[0]
    with pytest.raises(SingularError):
        guide_dynamics(geometry, MASSES, inverse(geometry, geometry.bases[0]))
    with pytest.raises(MechanismError, match="density"):
        GuideMasses(density=-1.0)
