"""Equations of motion with needle, gravity and friction: against 40 digits, energy, skewness."""

from dataclasses import replace

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from app.core.arrays import frozen
from app.mechanisms.pantograph import (
    DynamicModel,
    dynamic_terms,
    forward,
    inverse,
    jacobian,
    mass_matrix,
    velocity_terms,
)
from app.mechanisms.pantograph.dynamics import axial_load_kernel, friction_kernel
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
LEVEL = PROFILE.dynamic_model
TILTED = replace(LEVEL, gravity=frozen([3.0, -6.0, -7.0]))
STATES = [
    ((0.0, 0.16056), (1.3, -0.7), 0.05, 0.2),
    ((0.05, 0.17), (-0.4, 2.1), 0.11, -0.3),
    ((-0.06, 0.2), (3.0, 1.0), -0.03, 0.0),
    ((0.02, 0.09), (0.0, -1.5), 0.0, 1.0),
    ((-0.03, 0.24), (2.0, 2.0), 0.09, 0.1),
]


class Exact:
    """The same robot as bodies with positions and angles, in 40 digits.

    Coordinates (q1, q2, depth); every body is a map of them with a weight: a point with its mass,
    an angle with its inertia, the needle's direction with its inertia across.
    """

    def __init__(self, model: DynamicModel) -> None:
        self.model, self.part, self.lengths = model, PROFILE.inertia, PROFILE.geometry

    def maps(self, u):
        a1, a2, base = (mpmath.mpf(v) for v in self.model.geometry.links)
        fulcrum = mpmath.matrix([mpmath.mpf(v) for v in self.model.geometry.fulcrum_xyz])
        part, cos, sin = self.part, mpmath.cos, mpmath.sin
        elbows = [
            mpmath.matrix([side * base / 2 + a1 * cos(q), a1 * sin(q), 0])
            for side, q in ((-1, u[0]), (1, u[1]))
        ]
        e = elbows[1] - elbows[0]
        l2 = e[0] ** 2 + e[1] ** 2
        r = mpmath.sqrt((a2**2 - l2 / 4) / l2)
        p3 = elbows[0] + mpmath.matrix([e[0] / 2 - r * e[1], e[1] / 2 + r * e[0], 0])
        d = (p3 - fulcrum) / mpmath.norm(p3 - fulcrum)
        com = fulcrum + d * (u[2] - PROFILE.geometry.needle_length + part.needle_centre)
        found = [(part.tool_mass, p3, True), (part.needle_mass, com, True)]
        found.append((part.needle_inertia, d, False))
        for side, q, elbow in ((-1, u[0], elbows[0]), (1, u[1], elbows[1])):
            motor = mpmath.matrix([side * base / 2, 0, 0])
            along = (p3 - elbow) / a2
            turn = mpmath.matrix([mpmath.atan2(along[1], along[0]), 0, 0])
            c1, c2 = part.proximal_centre, part.distal_centre
            found += [
                (part.proximal_mass, motor + (elbow - motor) / a1 * c1, True),
                (part.proximal_inertia + part.reflected_rotor, mpmath.matrix([q, 0, 0]), False),
                (part.distal_mass, elbow + along * c2, True),
                (part.distal_inertia, turn, False),
            ]
        return found

    def terms(self, u, rates):
        """Mass matrix (3, 3), velocity terms (3,) and gravity (3,) by numerical derivatives."""
        mpmath.mp.dps = 40
        u, rates = ([mpmath.mpf(v) for v in values] for values in (u, rates))
        h = mpmath.mpf(10) ** -12

        def column(i, sign):
            return self.maps([v + (sign * h if k == i else 0) for k, v in enumerate(u)])

        moved = [self.maps([v + s * h * r for v, r in zip(u, rates, strict=True)]) for s in (1, -1)]
        here = self.maps(u)
        sides = [(column(i, 1), column(i, -1)) for i in range(3)]
        gravity = mpmath.matrix([mpmath.mpf(v) for v in self.model.gravity.tolist()])
        mass, velocity, fall = mpmath.zeros(3, 3), mpmath.zeros(3, 1), mpmath.zeros(3, 1)
        for b, (weight, value, heavy) in enumerate(here):
            partial = [(up[b][1] - down[b][1]) / (2 * h) for up, down in sides]
            second = (moved[0][b][1] - 2 * value + moved[1][b][1]) / h**2
            for i in range(3):
                for j in range(3):
                    mass[i, j] += weight * mpmath.fdot(partial[i], partial[j])
                velocity[i] += weight * mpmath.fdot(partial[i], second)
                if heavy:
                    fall[i] -= weight * mpmath.fdot(partial[i], gravity)
        return (np.array(m.tolist(), dtype=float) for m in (mass, velocity, fall))


@pytest.mark.parametrize("state", STATES)
def test_every_term_is_that_of_the_lagrangian_in_forty_digits(state):
    p3, rates, depth, depth_rate = state
    q = inverse(TILTED.geometry, p3)
    mass, velocity, gravity = Exact(TILTED).terms([*q, depth], [*rates, depth_rate])
    found = dynamic_terms(TILTED, q, rates, depth, depth_rate)
    np.testing.assert_allclose(found.mass, mass[:2, :2], rtol=1e-13)
    scale = np.abs(velocity).max()
    np.testing.assert_allclose(found.velocity, velocity[:2, 0], atol=1e-12 * scale)
    np.testing.assert_allclose(found.gravity, gravity[:2, 0], atol=1e-14)
    np.testing.assert_allclose(mass[2, :2], 0.0, atol=1e-20)  # sliding does not turn the needle
    v = jacobian(TILTED.geometry, q) @ rates
    load = axial_load_kernel(*v, *forward(TILTED.geometry, q), depth, TILTED.values, 0)
    assert load == pytest.approx(-velocity[2, 0] - gravity[2, 0], rel=1e-12)


def test_without_needle_and_gravity_the_terms_are_those_of_the_links():
    bare = replace(LEVEL.inertia, needle_mass=0.0, needle_inertia=0.0)
    model = replace(LEVEL, inertia=bare)
    for p3, rates, depth, depth_rate in STATES:
        q = inverse(model.geometry, p3)
        found = dynamic_terms(model, q, rates, depth, depth_rate)
        np.testing.assert_allclose(found.mass, mass_matrix(model.geometry, bare, q), rtol=1e-15)
        h = velocity_terms(model.geometry, bare, q, rates)
        np.testing.assert_allclose(found.velocity, h, rtol=1e-13, atol=1e-18)
        assert not found.gravity.any()  # a level base: gravity has no part in the plane


def test_a_level_needle_at_its_fulcrum_falls_outwards_only_as_far_as_its_weight_is_outside():
    """Upright base: the needle is an inverted pendulum outside, a hanging one inside."""
    q = inverse(LEVEL.geometry, (0.02, 0.16056))
    outside = dynamic_terms(LEVEL, q, (0.0, 0.0), -0.03).gravity
    inside = dynamic_terms(LEVEL, q, (0.0, 0.0), 0.12).gravity
    balanced = dynamic_terms(LEVEL, q, (0.0, 0.0), 0.1).gravity
    assert np.abs(balanced).max() < 1e-17
    assert np.sign(outside).tolist() == (-np.sign(inside)).tolist()


def test_the_rate_of_the_mass_matrix_less_twice_the_coriolis_matrix_is_skew():
    """With Christoffel symbols of M(q) the power of h is that of ½ Ṁ; h itself is C q̇."""
    step = 1e-6
    for p3, rates, depth, _ in STATES:
        q, v = inverse(LEVEL.geometry, p3), np.array(rates)

        def mass(at, depth=depth):
            return dynamic_terms(LEVEL, at, (0.0, 0.0), depth).mass

        d = np.array([(mass(q + step * e) - mass(q - step * e)) / (2 * step) for e in np.eye(2)])
        symbols = 0.5 * (np.einsum("kij->ijk", d) + np.einsum("jik->ijk", d) - d)
        coriolis = np.einsum("ijk,k->ij", symbols, v)
        skew = np.einsum("kij,k->ij", d, v) - 2.0 * coriolis
        np.testing.assert_allclose(skew, -skew.T, atol=1e-15)
        h = dynamic_terms(LEVEL, q, v, depth).velocity
        np.testing.assert_allclose(h, coriolis @ v, atol=1e-9 * np.abs(h).max() + 1e-12)


def test_a_free_swing_keeps_its_energy_and_friction_takes_what_it_takes():
    """Sliding needle (prescribed by nobody: it is the third coordinate) in tilted gravity."""
    for model in (replace(TILTED, coulomb=0.0, viscous=0.0), TILTED):
        y0 = np.array([*inverse(model.geometry, (0.0, 0.17)), 0.02, 0.5, -0.3, 0.05, 0.0])

        def energy(y, model=model):
            terms = dynamic_terms(model, y[:2], y[3:5], y[2])
            s = y[2] + model.inertia.needle_centre - model.geometry.needle_length
            m, lengths, part = model.inertia, PROFILE.geometry, PROFILE.inertia
            p3 = forward(model.geometry, y[:2])
            axis = np.array([*p3, 0.0]) - model.geometry.fulcrum
            axis /= np.linalg.norm(axis)
            fall = m.tool * model.gravity[:2] @ p3 + m.needle_mass * s * model.gravity @ axis
            for q in ((-1, y[0]), (1, y[1])):
                driven = np.array([np.cos(q[1]), np.sin(q[1])])
                elbow = np.array([q[0] * lengths.base / 2, 0.0]) + lengths.proximal * driven
                fall += model.gravity[:2] @ (
                    part.proximal_mass * part.proximal_centre * driven
                    + part.distal_mass
                    * (elbow + part.distal_centre * (p3 - elbow) / lengths.distal)
                )
            return 0.5 * y[3:5] @ terms.mass @ y[3:5] + 0.5 * m.needle_mass * y[5] ** 2 - fall

        def rate(_, y, model=model):
            terms = dynamic_terms(model, y[:2], y[3:5], y[2], y[5])
            torque = -terms.velocity - terms.gravity - terms.friction
            v = jacobian(model.geometry, y[:2]) @ y[3:5]
            p3 = forward(model.geometry, y[:2])
            load = axial_load_kernel(*v, *p3, y[2], model.values, 0)
            slide = load / model.inertia.needle_mass
            return [*y[3:6], *np.linalg.solve(terms.mass, torque), slide, terms.friction @ y[3:5]]

        end = solve_ivp(rate, (0.0, 0.08), y0, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        assert energy(y0) - energy(end) == pytest.approx(end[6], abs=2e-12)


def test_friction_opposes_the_speed_and_settles_at_its_coulomb_value():
    assert friction_kernel(0.0, 0.004, 0.002, 0.02) == 0.0
    assert friction_kernel(1.0, 0.004, 0.002, 0.02) == pytest.approx(0.006)
    assert friction_kernel(-1.0, 0.004, 0.002, 0.02) == pytest.approx(-0.006)
