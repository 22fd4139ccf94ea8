"""Letting go of the needle: the program's forces make it neither fast nor energetic.

Beside every run stands its twin: the same needle from the same state with the motors off. What the
run has beyond it, the program's forces have given; the profile's `limits.let_go` bounds it.
"""

import numpy as np
import pytest
from hard.let_go_rig import SOON, LetGoRig, direction, scaled
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control import Fault
from app.device.control.speed_bounds import speed_bounds
from app.device.state import Limiter
from app.mechanisms.profile import LET_GO_UNSTATED, load_profile

PROFILES = {name: load_profile(name) for name in ("icube", "haply-2diy")}
FACTORS = st.one_of(
    st.sampled_from([(0.7,), (1.0,), (1.3,)]),
    st.tuples(*[st.sampled_from([0.7, 1.3])] * 4),
    st.tuples(*[st.floats(0.7, 1.3)] * 4),
)
"""Of the inertias of proximal links with rotors, distal links, tool and needle."""


FRICTION = 0.1  # [N] that the joints' own dry friction takes from a hand that holds
UPRIGHT = [direction(0.35, a) for a in np.linspace(-np.pi, np.pi, 24, endpoint=False)]


def unstated(name):
    """A profile that says nothing about letting go."""
    profile = PROFILES[name]
    limits = profile.limits.model_copy(update={"let_go": None})
    return profile.model_copy(update={"limits": limits})


def weightless(name):
    """A robot whose needle does not topple by its own weight."""
    profile = PROFILES[name]
    mounting = profile.mounting.model_copy(update={"gravity": (0.0, 0.0, 0.0)})
    return profile.model_copy(update={"mounting": mounting})


def assert_calm(run, profile) -> None:
    limit = profile.let_go
    assert run.excess_speed <= limit.speed
    assert run.excess_energy <= 1e-3 * limit.energy_mj
    if run.noticed is not None:
        late = run.rows[run.noticed + SOON :]
        assert not late[:, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]].any()
        assert set(run.rows[run.noticed :, sv.FAULT]) == {Fault.LET_GO}


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", PROFILES)
@settings(derandomize=True, deadline=None, max_examples=60)
@given(
    tilt=st.floats(0.0, 1.0),
    azimuth=st.floats(-3.1, 3.1),
    away=st.floats(0.0, 0.6),
    towards=st.floats(-3.1, 3.1),
    depth=st.one_of(st.just(0.0), st.floats(0.0, 1.0)),
    dial=st.sampled_from([1.0, 0.3, -1.0, -0.5]),
    stiffness=st.sampled_from([1.0, 4.0]),
    factors=FACTORS,
    others=st.sampled_from([(), ("cone_wall",), ("impedance",), ("impedance", "compensation")]),
    states=st.booleans(),
)
def test_let_go_anywhere_under_any_law_and_inertia_the_program_gives_no_more_than_the_profile_says(
    name, tilt, azimuth, away, towards, depth, dial, stiffness, factors, others, states
):
    profile = PROFILES[name] if states else unstated(name)
    low, high = profile.depth_range
    held = direction(tilt * profile.tilt_limit, azimuth)
    path = direction(away, towards)
    rig = LetGoRig(
        profile,
        held,
        path,
        low + depth * (high - low),
        dial,
        stiffness,
        others=others,
        body=scaled(profile, *factors),
    )
    with rig.loop:
        rig.arm()
        assert_calm(rig.run_away(), profile)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", PROFILES)
@settings(derandomize=True, deadline=None, max_examples=30)
@given(
    tilt=st.floats(0.0, 1.0),
    azimuth=st.floats(-3.1, 3.1),
    away=st.floats(0.0, 0.6),
    towards=st.floats(-3.1, 3.1),
    depth=st.one_of(st.sampled_from([0.0, 1.0]), st.floats(0.0, 1.0)),
    dial=st.sampled_from([1.0, -1.0]),
    factors=FACTORS,
)
def test_with_a_depth_that_no_camera_has_measured_the_needle_is_as_calm(
    name, tilt, azimuth, away, towards, depth, dial, factors
):
    """The truth is anywhere in the profile's range, and the loop is not told."""
    profile = weightless(name)
    low, high = profile.depth_range
    held = direction(tilt * profile.tilt_limit, azimuth)
    rig = LetGoRig(
        profile,
        held,
        direction(away, towards),
        low + depth * (high - low),
        dial,
        4.0,
        body=scaled(profile, *factors),
        cameras=False,
    )
    with rig.loop:
        rig.arm()
        assert rig.pull <= profile.limits.hand_force + FRICTION
        assert_calm(rig.run_away(), profile)


def test_without_a_fix_the_icube_gives_no_more_than_its_longest_lever_allows_and_says_why():
    profile = weightless("icube")
    for path in UPRIGHT[::3]:
        rig = LetGoRig(profile, direction(0.0, 0.0), path, -0.02, stiffness=30.0, cameras=False)
        with rig.loop:
            rig.arm()
            row = rig.loop.latest().row
            assert 0.8 < rig.pull <= 1.85
        assert row[sv.GUIDANCE_LIMIT] <= 1.8
        assert row[sv.GUIDANCE_LIMITED_BY] in (Limiter.DEPTH, Limiter.LETTING_GO)


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("dial", [1.0, -1.0])
def test_with_the_tissues_force_too_the_needle_is_calm(name, dial):
    profile = PROFILES[name]
    rng = np.random.default_rng(3)
    for factor in (0.7, 0.7, 1.0, 1.3, 1.3):
        held = direction(rng.uniform(0.0, profile.tilt_limit), rng.uniform(-3.1, 3.1))
        path = direction(rng.uniform(0.0, 0.5), rng.uniform(-3.1, 3.1))
        body = scaled(profile, factor)
        depth = rng.uniform(*profile.depth_range)
        rig = LetGoRig(profile, held, path, depth, dial, 4.0, tissue=True, body=body)
        with rig.loop:
            rig.arm()
            assert_calm(rig.run_away(300), profile)


@pytest.mark.parametrize("name", PROFILES)
def test_a_strong_force_that_finds_no_hand_is_noticed_ends_and_the_robot_comes_to_rest(name):
    profile = weightless(name)
    rig = LetGoRig(profile, direction(0.3, 1.0), direction(0.1, 1.0), 0.03, 1.0, 4.0)
    with rig.loop:
        rig.arm()
        felt = np.linalg.norm(rig.loop.latest().felt)
        run = rig.run_away(3000)
    assert felt > 0.3 * profile.limits.hand_force
    assert run.noticed is not None
    assert run.noticed < SOON
    assert not run.rows[run.noticed :, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]].any()
    assert_calm(run, profile)
    assert run.speed[-1] < 1e-3


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("factor", [0.7, 1.3])
def test_letting_go_while_moving_with_the_force_is_as_calm(name, factor):
    profile = PROFILES[name]
    body = scaled(profile, factor)
    rig = LetGoRig(profile, direction(0.35, 0.5), direction(0.0, 0.0), -0.02, 1.0, 4.0, body=body)
    with rig.loop:
        rig.arm()
        lever = profile.pantograph.needle_length + 0.02
        for k in range(100):  # at 0.08 m/s towards the path
            rig.hold(direction(0.35 - 0.08 * 1e-3 * k / lever, 0.5))
            rig.step(1)
        assert_calm(rig.run_away(), profile)


@pytest.mark.parametrize(
    ("name", "depth", "force"),
    [("icube", 0.09, 4.9), ("icube", -0.02, 2.8), ("haply-2diy", -0.02, 0.5)],
)
def test_a_hand_in_normal_motion_keeps_the_whole_force(name, depth, force):
    """Held and moved at 0.08 m/s with and against the force: nothing is taken away."""
    profile = PROFILES[name]
    rig = LetGoRig(profile, direction(0.45, 0.5), direction(0.0, 0.0), depth, stiffness=4.0)
    lever = profile.pantograph.needle_length - depth
    with rig.loop:
        rig.arm()
        for k in (*range(275), *range(275, 0, -1)):
            rig.hold(direction(0.45 - 0.08 * 1e-3 * k / lever, 0.5))
            rig.step(1)
        rows = rig.loop.rows()[-550:]
    assert np.linalg.norm(rows[:, sv.FELT], axis=1).max() > force
    assert rows[:, sv.LET_GO_SCALE].min() == 1.0
    assert not rows[:, sv.FAULT].any()


def strongest(name, held, towards, depth):
    """Force felt [N] at a pose by a guidance that wants all it can get, and the governor's row."""
    rig = LetGoRig(PROFILES[name], held, towards, depth, stiffness=30.0)
    with rig.loop:
        rig.arm()
        row = rig.loop.latest().row
        return float(np.linalg.norm(row[sv.FELT])), row


def test_where_students_align_an_icube_gives_what_its_motors_can():
    """Tip 20 mm outside the skin, measured, needle upright, guidance in every direction."""
    found = [strongest("icube", direction(0.0, 0.0), path, -0.02)[0] for path in UPRIGHT]
    assert np.median(found) >= 2.4
    assert min(found) >= 2.2


def test_over_all_poses_outside_the_skin_the_icube_keeps_most_of_its_motors_force():
    rng = np.random.default_rng(5)
    profile = PROFILES["icube"]
    given_, torque_alone = [], []
    for _ in range(40):
        tilt = np.arccos(1.0 - rng.random() * (1.0 - np.cos(profile.tilt_limit)))
        held = direction(tilt, rng.uniform(-np.pi, np.pi))
        path = direction(rng.uniform(0.0, 0.9), rng.uniform(-np.pi, np.pi))
        force, row = strongest("icube", held, path, -0.02)
        used = np.abs(row[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]).max()
        alone = force * profile.limits.joint_torque / used
        given_.append(force)
        torque_alone.append(min(alone, profile.limits.hand_force))
    assert np.median(given_) >= 0.85 * np.median(torque_alone)


def test_a_haply_gives_half_a_newton_where_students_align():
    found = [strongest("haply-2diy", direction(0.0, 0.0), path, -0.02)[0] for path in UPRIGHT]
    assert min(found) >= 0.5


@pytest.mark.parametrize(
    ("name", "depth", "by"),
    [
        ("icube", -0.02, Limiter.TORQUE),
        ("icube", 0.11, Limiter.DEPTH),
        ("haply-2diy", -0.02, Limiter.LETTING_GO),
    ],
)
def test_the_largest_force_to_be_had_and_its_reason_are_told(name, depth, by):
    force, row = strongest(name, direction(0.2, 0.4), direction(0.5, 2.0), depth)
    assert row[sv.GUIDANCE_LIMIT] == pytest.approx(force, rel=0.02)
    assert row[sv.GUIDANCE_LIMITED_BY] == by


def test_without_a_wanted_force_the_limit_is_that_of_the_worst_direction():
    path = direction(0.2, 0.4)
    for name in PROFILES:
        rig = LetGoRig(PROFILES[name], path, path, -0.02, dial=0.0)
        with rig.loop:
            rig.arm()
            told = rig.loop.latest().row[sv.GUIDANCE_LIMIT]
        around = [
            strongest(name, path, direction(0.6, a), -0.02)[0] for a in np.linspace(-3.0, 3.0, 9)
        ]
        assert 0.8 * min(around) < told <= min(around) * 1.01


def test_a_profile_that_states_no_limit_is_held_to_a_quarter_of_a_metre_per_second():
    assert LET_GO_UNSTATED.speed == 0.25
    profile = unstated("icube")
    assert profile.let_go is LET_GO_UNSTATED
    weaker = LetGoRig(profile, direction(0.0, 0.0), UPRIGHT[0], -0.02, stiffness=30.0)
    with weaker.loop:
        weaker.arm()
        row = weaker.loop.latest().row
    assert row[sv.GUIDANCE_LIMITED_BY] == Limiter.LETTING_GO
    assert 0.5 < np.linalg.norm(row[sv.FELT]) < 1.5


def test_disarming_forgets_the_needle_that_ran_away():
    rig = LetGoRig(PROFILES["icube"], direction(0.3, 1.0), direction(0.0, 0.0), 0.05, 1.0, 4.0)
    with rig.loop:
        rig.arm()
        rig.run_away(1000)
        assert rig.loop.latest().fault is Fault.LET_GO
        rig.hold(direction(0.3, 1.0))
        rig.step(1500)
        assert rig.loop.latest().fault is Fault.LET_GO
        assert not rig.loop.latest().felt.any()
        rig.loop.inbox.write(enabled=0.0)
        rig.step(1)
        rig.arm()
        assert rig.loop.latest().fault is Fault.NONE
        assert np.linalg.norm(rig.loop.latest().felt) > 1.0


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=200)
@given(
    st.lists(st.floats(0.0, 80.0), min_size=3, max_size=24),
    st.floats(-0.2, 0.2),
    st.floats(-0.5, 0.5),
    st.floats(1e-4, 3e-3),
    st.lists(st.floats(1e-4, 5e-3), min_size=24, max_size=24),
)
def test_the_true_speed_always_lies_between_the_bounds(pushes, start, phase, count, steps):
    """Any push up to what was sent, any phase of the encoder, ticks of any length."""
    arm, speed, x, time = 0.15, start, phase * count, 5.0  # m per rad
    ring = np.zeros(4 * 24)
    speeds = []
    for k, push in enumerate(pushes):
        ring[4 * k : 4 * k + 4] = np.floor(x / count + 0.5) * count, 0.0, time, push
        speeds.append(speed)
        time += steps[k]
        x += (speed * steps[k] + 0.5 * push * steps[k] ** 2) / arm
        speed += push * steps[k]
    n = len(pushes)
    ring[4 * (n - 1) + 3] = 0.0
    least, most = speed_bounds(ring, n - 1, n, arm, 0.0, arm * arm, 0.0, 0.0, count)
    assert speeds[-1] <= most + 1e-9
    assert least <= max(speeds) + 1e-9


@pytest.mark.parametrize(
    ("name", "rate_hz"), [("icube", 500.0), ("icube", 1000.0), ("haply-2diy", 1000.0)]
)
@pytest.mark.parametrize("drop", [0.0, 0.3])
def test_over_a_wire_that_is_a_tick_late_and_loses_messages_the_needle_is_as_calm(
    name, rate_hz, drop
):
    profile = PROFILES[name]
    loop = profile.loop.model_copy(update={"rate_hz": rate_hz})
    profile = profile.model_copy(update={"loop": loop})
    rng = np.random.default_rng(7)
    for factor in (0.7, 1.0, 1.3, 0.7, 1.0, 1.3):
        held = direction(rng.uniform(0.0, profile.tilt_limit), rng.uniform(-3.1, 3.1))
        path = direction(rng.uniform(0.0, 0.6), rng.uniform(-3.1, 3.1))
        depth = rng.uniform(*profile.depth_range)
        rig = LetGoRig(
            profile, held, path, depth, stiffness=4.0, wire=True, body=scaled(profile, factor)
        )
        with rig.loop:
            rig.arm()
            rig.board.faults.set("drop", drop)
            assert_calm(rig.run_away(round(0.4 * rate_hz)), profile)
