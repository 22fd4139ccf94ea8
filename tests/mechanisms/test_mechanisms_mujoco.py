"""The closed chain against MuJoCo's closed loop: accelerations, free swing, statics."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from app.core.arrays import frozen
from app.exchange.errors import ExportError
from app.mechanisms.pantograph import (
    dynamic_terms,
    force_map,
    forward,
    inverse,
    jacobian,
    joint_torques,
    needle_at,
    printed_force,
)
from app.mechanisms.pantograph.dynamics import axial_load_kernel
from app.mechanisms.profile import load_profile
from app.simulation.errors import SimulationError
from app.studies.references.mujoco_pantograph import (
    MjcfSettings,
    MujocoPantograph,
    felt_in_mujoco,
    write_mjcf,
)

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph
TILTED = 0.6, 1.5, -9.6


def model_in(gravity, needle=True):
    inertia = PROFILE.lumped_inertia
    if not needle:
        inertia = replace(inertia, needle_mass=0.0, needle_inertia=0.0)
    return replace(PROFILE.dynamic_model, gravity=frozen(gravity), inertia=inertia)


def test_accelerations_are_those_of_mujocos_tree_with_rigid_constraints():
    """Random states, torques and tilted gravity, with the needle sliding: joints and depth."""
    rng, gravity = np.random.default_rng(3), (3.0, -6.0, -7.0)
    model, machine = model_in(gravity), MujocoPantograph(PROFILE, MjcfSettings(gravity=gravity))
    for _ in range(100):
        radius, turn = rng.uniform(0.0, 0.07), rng.uniform(0.0, 2.0 * np.pi)
        p3 = GEOMETRY.fulcrum[:2] + radius * np.array([np.cos(turn), np.sin(turn)])
        q, rates = inverse(GEOMETRY, p3), rng.uniform(-3.0, 3.0, 2)
        depth, rate = rng.uniform(-0.02, 0.12), rng.uniform(-1.0, 1.0)
        torques = rng.uniform(-0.3, 0.3, 2)
        machine.place(q, rates, depth, rate)
        machine.push(torques)
        theirs = machine.acceleration()
        terms = dynamic_terms(model, q, rates, depth, rate)
        ours = np.linalg.solve(terms.mass, torques - terms.velocity - terms.gravity)
        assert theirs[machine.motors] == pytest.approx(ours, abs=3e-9 * np.abs(ours).max())
        v = jacobian(GEOMETRY, q) @ rates
        load = axial_load_kernel(*v, *p3, depth, model.values, 0)
        slide = theirs[machine.address("depth")]
        assert slide == pytest.approx(load / PROFILE.inertia.needle_mass, rel=3e-9)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("needle", [True, False], ids=["with needle", "bare links"])
def test_a_free_swing_of_two_seconds_follows_mujoco_to_a_millionth(needle):
    """RK4 at 0.1 ms, constraint stiffness 1e7 1/s²; ours with DOP853 at 1e-12.

    No extrapolation: the largest difference of a motor angle is 5e-9 of the swing's range.
    """
    depth, model = 0.11, model_in(TILTED, needle)

    def rate(_, y):
        terms = dynamic_terms(model, y[:2], y[2:], depth)
        return [*y[2:], *np.linalg.solve(terms.mass, -terms.velocity - terms.gravity)]

    q, rates = inverse(GEOMETRY, (-0.03, 0.15)), np.array([0.3, -0.2])
    times = np.linspace(0.0, 2.0, 101)
    ours = solve_ivp(
        rate, (0.0, 2.0), [*q, *rates], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=times
    ).y[:2]
    settings = MjcfSettings(needle=needle, slides=False, fixed_depth=depth, gravity=TILTED)
    machine = MujocoPantograph(PROFILE, settings)
    machine.place(q, rates, depth)
    theirs = [machine.q]
    for _ in times[1:]:
        machine.run(round(0.02 / settings.step))
        theirs.append(machine.q)
    reach = np.ptp(ours, axis=1).max()
    assert reach > 1.0  # a swing, not a tremble
    assert np.abs(np.array(theirs).T - ours).max() <= 1e-6 * reach
    assert np.abs(np.array(theirs).T - ours).max() <= 2e-8 * reach


def test_damped_joints_slow_down_as_in_mujoco():
    model = model_in((0.0, 0.0, 0.0))
    q, rates = inverse(GEOMETRY, (0.0, 0.16)), np.array([0.5, 0.2])
    settings = MjcfSettings(
        slides=False, fixed_depth=0.05, damped=True, gravity=(0.0, 0.0, 0.0), step=2e-4
    )

    def rate(_, y):
        terms = dynamic_terms(model, y[:2], y[2:], 0.05)
        force = -terms.velocity - PROFILE.friction.viscous * y[2:]
        return [*y[2:], *np.linalg.solve(terms.mass, force)]

    machine = MujocoPantograph(PROFILE, settings)
    machine.place(q, rates, 0.05)
    machine.run(1000)
    ours = solve_ivp(rate, (0.0, 0.2), [*q, *rates], method="DOP853", rtol=1e-11, atol=1e-12).y
    assert machine.q == pytest.approx(ours[:2, -1], abs=1e-8)


@pytest.mark.parametrize("tilt_deg", [0.0, 30.0, 39.0, 45.0])
@pytest.mark.parametrize("azimuth", [0.3, 2.5])
def test_virtual_work_is_felt_as_wanted_and_the_printed_law_is_not(tilt_deg, azimuth):
    """Wanted 2 N in the tilt plane: at 45° the printed law gives 4 N, virtual work 2 N."""
    tilt = np.radians(tilt_deg)
    outwards = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    needle = needle_at(
        GEOMETRY, GEOMETRY.fulcrum[:2] + GEOMETRY.fulcrum[2] * np.tan(tilt) * outwards[:2]
    )
    wanted = outwards - needle.axis * (outwards @ needle.axis)
    wanted *= 2.0 / np.linalg.norm(wanted)
    j = jacobian(GEOMETRY, inverse(GEOMETRY, needle.p3))
    felt = felt_in_mujoco(PROFILE, tilt, azimuth, joint_torques(j, force_map(needle, wanted)))
    assert felt == pytest.approx(wanted, abs=1e-5)
    felt = felt_in_mujoco(PROFILE, tilt, azimuth, joint_torques(j, printed_force(needle, wanted)))
    assert np.linalg.norm(felt) == pytest.approx(2.0 / np.cos(tilt) ** 2, abs=1e-4)


def test_the_model_starts_with_a_closed_loop_and_moves_as_ours():
    machine = MujocoPantograph(PROFILE)
    q = inverse(GEOMETRY, (0.03, 0.19))
    machine.place(q, (0.4, -0.2), 0.02, 0.1)
    carriage = machine.data.site("carriage").xpos
    assert carriage == pytest.approx([*forward(GEOMETRY, q), 0.0], abs=1e-15)
    for side in ("left_end", "right_end"):
        assert machine.data.site(side).xpos == pytest.approx(carriage, abs=1e-15)
    needle = needle_at(GEOMETRY, forward(GEOMETRY, q), GEOMETRY.needle_length - 0.02)
    assert machine.data.site("hub").xpos == pytest.approx(needle.hub, abs=1e-15)
    assert machine.data.site("tip").xpos == pytest.approx(needle.tip, abs=1e-15)


def test_a_tool_without_mass_is_refused_by_name():
    part = PROFILE.inertia.model_copy(update={"tool_mass": 0.0})
    with pytest.raises(ExportError, match=r"tool_mass is 0\.0 kg"):
        write_mjcf(PROFILE.model_copy(update={"inertia": part}))


def test_a_missing_mujoco_names_the_extra(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "mujoco", None)
    with pytest.raises(SimulationError, match=r"make extra NAME=physics"):
        felt_in_mujoco(PROFILE, 0.1, 0.0, (0.0, 0.0))
