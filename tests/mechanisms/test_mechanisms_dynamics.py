"""Closed-chain dynamics: positive definite, consistent with energy and with its derivatives."""

import numpy as np
import pytest

from app.mechanisms.pantograph import (
    LumpedInertia,
    forward,
    inverse,
    jacobian,
    mass_matrix,
    velocity_terms,
)
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
GEOMETRY, INERTIA = PROFILE.pantograph, PROFILE.lumped_inertia


def poses() -> list[np.ndarray]:
    points = [(0.0, 0.16056), (0.05, 0.16), (-0.06, 0.2), (0.02, 0.09), (-0.03, 0.24)]
    return [inverse(GEOMETRY, p) for p in points]


def mass_derivatives(q: np.ndarray, step: float = 1e-6) -> np.ndarray:
    return np.array(
        [
            (
                mass_matrix(GEOMETRY, INERTIA, q + step * e)
                - mass_matrix(GEOMETRY, INERTIA, q - step * e)
            )
            / (2.0 * step)
            for e in np.eye(2)
        ]
    )


def test_the_mass_matrix_is_positive_definite_over_the_workspace():
    for angle in np.linspace(0.0, 6.2, 16):
        for radius in (0.0, 0.03, 0.06, 0.09):
            p3 = GEOMETRY.fulcrum[:2] + radius * np.array([np.cos(angle), np.sin(angle)])
            mass = mass_matrix(GEOMETRY, INERTIA, inverse(GEOMETRY, p3))
            assert mass[0, 1] == mass[1, 0]
            assert np.linalg.eigvalsh(mass).min() > 1e-3


def test_the_mass_matrix_gives_the_kinetic_energy_of_the_moving_bodies():
    """The same energy from the velocities of the bodies, taken by finite differences."""
    part, lengths = PROFILE.inertia, PROFILE.geometry
    rates, step = np.array([1.3, -0.7]), 1e-6

    def bodies(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        p3 = forward(GEOMETRY, q)
        points, angles = [p3], []
        for side, angle in ((-1.0, q[0]), (1.0, q[1])):
            motor = np.array([side * lengths.base / 2, 0.0])
            driven = np.array([np.cos(angle), np.sin(angle)])
            elbow = motor + lengths.proximal * driven
            passive = (p3 - elbow) / lengths.distal
            points += [motor + part.proximal_centre * driven, elbow + part.distal_centre * passive]
            angles += [angle, np.arctan2(passive[1], passive[0])]
        return np.array(points), np.array(angles)

    masses = np.array([part.tool_mass, *(2 * [part.proximal_mass, part.distal_mass])])
    inertias = np.array(2 * [part.proximal_inertia + part.reflected_rotor, part.distal_inertia])
    for q in poses():
        ahead, behind = bodies(q + step * rates), bodies(q - step * rates)
        speed = (ahead[0] - behind[0]) / (2 * step)
        spin = (ahead[1] - behind[1]) / (2 * step)
        energy = 0.5 * masses @ (speed**2).sum(axis=1) + 0.5 * inertias @ spin**2
        mass = mass_matrix(GEOMETRY, INERTIA, q)
        assert 0.5 * rates @ mass @ rates == pytest.approx(energy, rel=1e-7)


def test_the_velocity_terms_are_those_of_the_christoffel_symbols():
    rates = np.array([1.3, -0.7])
    for q in poses():
        d = mass_derivatives(q)
        symbols = 0.5 * (np.einsum("kij->ijk", d) + np.einsum("jik->ijk", d) - d)
        expected = np.einsum("ijk,j,k->i", symbols, rates, rates)
        # symbols[i, j, k] = (∂_k M_ij + ∂_j M_ik - ∂_i M_jk) / 2
        assert velocity_terms(GEOMETRY, INERTIA, q, rates) == pytest.approx(expected, abs=1e-9)


def test_the_tool_mass_alone_gives_the_jacobians_mass_matrix():
    tool = LumpedInertia(driven=0.0, passive=0.0, coupling=0.0, tool=2.0)
    for q in poses():
        j = jacobian(GEOMETRY, q)
        assert mass_matrix(GEOMETRY, tool, q) == pytest.approx(2.0 * j.T @ j, abs=1e-16)


def test_power_in_is_the_rate_of_kinetic_energy():
    """Runge-Kutta of the free and of the driven mechanism: energy changes by the work done."""

    def derivative(state: np.ndarray, torques: np.ndarray) -> np.ndarray:
        q, rates = state[:2], state[2:4]
        mass = mass_matrix(GEOMETRY, INERTIA, q)
        acceleration = np.linalg.solve(mass, torques - velocity_terms(GEOMETRY, INERTIA, q, rates))
        return np.concatenate([rates, acceleration, [torques @ rates]])

    for torques in (np.zeros(2), np.array([0.05, -0.03])):
        state, h = np.array([*poses()[0], 2.0, 1.0, 0.0]), 1e-3
        start = 0.5 * state[2:4] @ mass_matrix(GEOMETRY, INERTIA, state[:2]) @ state[2:4]
        for _ in range(100):
            k1 = derivative(state, torques)
            k2 = derivative(state + 0.5 * h * k1, torques)
            k3 = derivative(state + 0.5 * h * k2, torques)
            k4 = derivative(state + h * k3, torques)
            state = state + h / 6.0 * (k1 + 2 * k2 + 2 * k3 + k4)
        end = 0.5 * state[2:4] @ mass_matrix(GEOMETRY, INERTIA, state[:2]) @ state[2:4]
        assert end - start == pytest.approx(state[4], abs=1e-12)
