"""Letting go of the needle: never faster than 0.25 m/s, and no force 50 ms after it is noticed."""

import numpy as np
import pytest
from hard.let_go_rig import LetGoRig, direction
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control import Fault
from app.device.control.speed_bounds import speed_bounds
from app.mechanisms.profile import DeviceProfile, load_profile

PROFILES = {name: load_profile(name) for name in ("icube", "haply-2diy")}


def weightless(name: str) -> DeviceProfile:
    """A robot whose needle does not topple by its own weight, which no force law answers for."""
    profile = PROFILES[name]
    mounting = profile.mounting.model_copy(update={"gravity": (0.0, 0.0, 0.0)})
    return profile.model_copy(update={"mounting": mounting})


FASTEST = 0.25
SOON = 50  # ticks, ms


def assert_calm(speeds, rows) -> None:
    assert speeds.max() <= FASTEST
    noticed = np.flatnonzero(rows[:, sv.LET_GO] > 0.0)
    if len(noticed):
        late = rows[noticed[0] + SOON :]
        assert not late[:, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]].any()
        assert set(rows[noticed[0] :, sv.FAULT]) == {Fault.LET_GO}


@pytest.mark.parametrize("name", PROFILES)
@settings(derandomize=True, deadline=None, max_examples=40)
@given(
    tilt=st.floats(0.0, 1.0),
    azimuth=st.floats(-3.1, 3.1),
    away=st.floats(0.0, 0.6),
    towards=st.floats(-3.1, 3.1),
    depth=st.floats(0.0, 1.0),
    dial=st.sampled_from([1.0, 0.3, -1.0, -0.5]),
    stiffness=st.sampled_from([1.0, 4.0]),
    tissue=st.booleans(),
    others=st.sampled_from([(), ("cone_wall",), ("impedance",), ("impedance", "compensation")]),
)
def test_let_go_anywhere_under_any_law_the_hub_stays_slow(
    name, tilt, azimuth, away, towards, depth, dial, stiffness, tissue, others
):
    profile = weightless(name)
    low, high = profile.depth_range
    held = direction(tilt * profile.tilt_limit, azimuth)
    path = direction(away, towards)
    rig = LetGoRig(profile, held, path, low + depth * (high - low), dial, stiffness, tissue, others)
    with rig.loop:
        rig.arm()
        assert_calm(*rig.let_go())


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("dial", [1.0, -1.0])
@pytest.mark.parametrize("tissue", [False, True])
def test_with_its_weight_too_the_needle_is_slow_until_50_ms_after_it_is_noticed(name, dial, tissue):
    profile = PROFILES[name]
    rng = np.random.default_rng(3)
    for _ in range(5):
        held = direction(rng.uniform(0.0, profile.tilt_limit), rng.uniform(-3.1, 3.1))
        path = direction(rng.uniform(0.0, 0.5), rng.uniform(-3.1, 3.1))
        rig = LetGoRig(profile, held, path, rng.uniform(*profile.depth_range), dial, 4.0, tissue)
        with rig.loop:
            rig.arm()
            speeds, rows = rig.let_go(300)
        noticed = np.flatnonzero(rows[:, sv.LET_GO] > 0.0)
        assert speeds[: (noticed[0] if len(noticed) else 0) + SOON].max() <= FASTEST


@pytest.mark.parametrize("name", PROFILES)
def test_a_strong_force_that_finds_no_hand_is_noticed_ends_and_the_robot_comes_to_rest(name):
    profile = weightless(name)
    rig = LetGoRig(profile, direction(0.3, 1.0), direction(0.1, 1.0), 0.03, 1.0, 4.0)
    with rig.loop:
        rig.arm()
        felt = np.linalg.norm(rig.loop.latest().felt)
        speeds, rows = rig.let_go(3000)
    assert felt > 0.1 * profile.limits.hand_force
    noticed = np.flatnonzero(rows[:, sv.LET_GO] > 0.0)
    assert noticed[0] < SOON
    assert not rows[noticed[0] :, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]].any()
    assert_calm(speeds, rows)
    assert speeds[-1] < 1e-3


@pytest.mark.parametrize("name", PROFILES)
def test_letting_go_while_moving_with_the_force_is_as_slow(name):
    profile = PROFILES[name]
    rig = LetGoRig(profile, direction(0.35, 0.5), direction(0.0, 0.0), 0.02, 1.0, 4.0)
    with rig.loop:
        rig.arm()
        lever = profile.pantograph.needle_length - 0.02
        for k in range(100):  # at 0.08 m/s towards the path
            rig.hold(direction(0.35 - 0.08 * 1e-3 * k / lever, 0.5))
            rig.step(1)
        assert_calm(*rig.let_go())


@pytest.mark.parametrize(
    ("name", "depth", "force"),
    [("icube", 0.09, 4.9), ("icube", 0.0, 1.5), ("haply-2diy", 0.05, 0.3)],
)
def test_a_hand_in_normal_motion_keeps_the_whole_force(name, depth, force):
    """Held and moved at 0.08 m/s with and against the force: nothing is taken away."""
    profile = PROFILES[name]
    rig = LetGoRig(profile, direction(0.45, 0.5), direction(0.0, 0.0), depth)
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


def test_disarming_forgets_the_needle_that_ran_away():
    rig = LetGoRig(PROFILES["icube"], direction(0.3, 1.0), direction(0.0, 0.0), 0.05, 1.0, 4.0)
    with rig.loop:
        rig.arm()
        rig.let_go()
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
def test_over_a_wire_that_is_a_tick_late_and_loses_messages_the_hub_stays_as_slow(
    name, rate_hz, drop
):
    profile = weightless(name)
    loop = profile.loop.model_copy(update={"rate_hz": rate_hz})
    profile = profile.model_copy(update={"loop": loop})
    rng = np.random.default_rng(7)
    for _ in range(8):
        held = direction(rng.uniform(0.0, profile.tilt_limit), rng.uniform(-3.1, 3.1))
        path = direction(rng.uniform(0.0, 0.6), rng.uniform(-3.1, 3.1))
        depth = rng.uniform(*profile.depth_range)
        rig = LetGoRig(profile, held, path, depth, stiffness=4.0, wire=True)
        with rig.loop:
            rig.arm()
            rig.board.faults.set("drop", drop)
            speeds, _ = rig.let_go(round(0.4 * rate_hz))
        assert speeds.max() <= FASTEST
