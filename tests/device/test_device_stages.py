"""Each stage of a tick by itself: kinematics, simulated encoders."""

import numpy as np
import pytest

from app.core import state_vector as sv
from app.device.control.kinematics import HELD, MODEL, TRACKED, Kinematics
from app.device.links.simulated import SimulatedEncoders
from app.mechanisms.pantograph import forward, inverse, jacobian, lever_map, needle_at
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph
DT = 1e-3


def tick(state, *stages, **slots):
    state[sv.TIME] += DT
    state[sv.DT] = DT
    for name, value in slots.items():
        state[sv.INDEX[name]] = value
    for _, function, parameters in stages:
        function(state, parameters)


def placing():
    """The machine's own stage and the one that places the needle, as one."""
    pose, place = PROFILE.machine.stages().pose, Kinematics.of(PROFILE).stage()

    def both(state, _):
        pose.function(state, pose.parameters)
        place.function(state, place.parameters)

    return "placing", both, None


def state_at(p3=(0.03, 0.19)):
    state = sv.empty_state()
    state[sv.TIME] = 5.0
    state[sv.Q_LEFT], state[sv.Q_RIGHT] = inverse(GEOMETRY, p3)
    return state


def test_the_stage_places_the_needle_as_the_mechanisms_room_does():
    state, stage = state_at(), placing()
    state[sv.TRACKED_TIME], state[sv.TRACKED_DEPTH] = 5.0, 0.07
    state[sv.QD_LEFT], state[sv.QD_RIGHT] = 0.4, -0.2
    tick(state, stage)
    q = state[[sv.Q_LEFT, sv.Q_RIGHT]]
    needle = needle_at(GEOMETRY, forward(GEOMETRY, q), GEOMETRY.needle_length - 0.07)
    rate = jacobian(GEOMETRY, q) @ [0.4, -0.2]
    for vector, expected in (
        (sv.P3, needle.p3),
        (sv.AXIS, needle.axis),
        (sv.HUB, needle.hub),
        (sv.TIP, needle.tip),
        (sv.P3_V, rate),
        (sv.HUB_V, lever_map(needle) @ rate),
        (sv.JACOBIAN, jacobian(GEOMETRY, q).ravel()),
    ):
        assert state[vector] == pytest.approx(expected, abs=1e-15)
    assert (state[sv.L_IN], state[sv.L_OUT], state[sv.DEPTH]) == pytest.approx(
        (needle.l_in, needle.l_out, 0.07), abs=1e-15
    )
    assert state[sv.KINEMATICS] == 0.0


def test_the_stage_clears_last_ticks_forces():
    state = state_at()
    state[list(sv.SUMS)] = 3.0
    tick(state, placing())
    assert not state[list(sv.SUMS)].any()


def test_the_depth_is_tracked_then_held_then_the_models():
    state, stage = state_at(), placing()
    tick(state, stage, tracked_time=5.0, tracked_depth=0.05)
    assert (state[sv.DEPTH_SOURCE], state[sv.DEPTH]) == (TRACKED, pytest.approx(0.05))
    sources, depths = [], []
    for _ in range(400):
        tick(state, stage)
        sources.append(int(state[sv.DEPTH_SOURCE]))
        depths.append(state[sv.DEPTH])
    assert sources[50] == TRACKED
    assert sources[150] == HELD
    assert sources[250] == MODEL
    assert depths[150] == pytest.approx(0.05)
    assert depths[-1] == pytest.approx(state[sv.L_IN])  # L_out = C - L_in


def test_a_fix_from_the_future_goes_stale_like_an_old_one():
    state, stage = state_at(), placing()
    tick(state, stage, tracked_time=5.0 + 3600.0, tracked_depth=0.05)
    assert state[sv.DEPTH_SOURCE] == MODEL
    assert state[sv.DEPTH] == pytest.approx(state[sv.L_IN])
    tick(state, stage, tracked_time=state[sv.TIME] + 2.5 * DT, tracked_depth=0.05)  # mere jitter
    assert state[sv.DEPTH_SOURCE] == TRACKED


def test_losing_and_finding_the_marker_moves_the_lever_without_a_jump():
    state, stage = state_at(), placing()
    depths = []
    for k in range(1500):
        seen = k < 300 or k > 900
        fix = {"tracked_time": state[sv.TIME], "tracked_depth": 0.05} if seen else {}
        tick(state, stage, **fix)
        depths.append(state[sv.DEPTH])
    away = abs(state[sv.L_IN] - 0.05)
    assert np.abs(np.diff(depths)).max() < 1.5 * away * DT / 0.1
    assert depths[-1] == pytest.approx(0.05)


def test_a_depth_beyond_the_needle_leaves_a_positive_lever():
    state, stage = state_at(), placing()
    tick(state, stage, tracked_time=5.0, tracked_depth=0.5)
    assert state[sv.L_OUT] == Kinematics.of(PROFILE).l_out_min


def test_the_angle_error_is_exact_near_zero():
    state, stage = state_at((0.0, 0.16056)), placing()
    for angle in (1e-12, 1e-9, 1e-5, 0.3):
        tick(state, stage, path_x=np.sin(angle), path_z=-np.cos(angle))
        assert state[sv.ANGLE_ERROR] == pytest.approx(angle, rel=1e-4)


def test_without_a_path_there_is_no_angle_error():
    state = state_at()
    tick(state, placing())
    assert state[sv.ANGLE_ERROR] == 0.0


def test_where_no_pose_exists_the_last_one_stays_and_the_status_says_so():
    state, stage = state_at(), placing()
    tick(state, stage)
    placed = state.copy()
    tick(state, stage, q_left=np.nan, qd_left=3.0)
    assert state[sv.KINEMATICS] == 5.0
    kept = [sv.P3_X, sv.P3_Y, sv.AXIS_X, sv.AXIS_Y, sv.AXIS_Z, sv.HUB_X, sv.TIP_X, sv.L_OUT]
    assert state[kept] == pytest.approx(placed[kept])
    assert not state[[sv.P3_VX, sv.P3_VY, sv.HUB_VX, sv.HUB_VY, sv.HUB_VZ]].any()


def test_before_any_valid_pose_the_needle_stands_upright():
    state = sv.empty_state()
    tick(state, placing(), q_left=np.nan)
    assert state[sv.AXIS].tolist() == [0.0, 0.0, -1.0]
    assert state[sv.L_IN] == GEOMETRY.fulcrum[2]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_simulated_encoders_pass_on_what_is_no_number(bad):
    state, stage = sv.empty_state(), SimulatedEncoders(20_000, (3.4, -0.19)).stage()
    tick(state, stage, plant_q_left=bad)
    assert not np.isfinite(state[sv.Q_LEFT])


def test_simulated_encoders_give_whole_counts_from_home():
    state, stage = sv.empty_state(), SimulatedEncoders(20_000, (3.4, -0.19)).stage()
    count = 2.0 * np.pi / 20_000
    for q in np.linspace(-1.0, 4.0, 101):
        tick(state, stage, plant_q_left=q, plant_q_right=-q)
        for found, true, home in ((sv.Q_LEFT, q, 3.4), (sv.Q_RIGHT, -q, -0.19)):
            assert abs(state[found] - true) <= 0.5 * count * (1.0 + 1e-9)
            counts = (state[found] - home) / count
            assert counts == pytest.approx(round(counts), abs=1e-9)
    assert state[sv.Q_TIME] == state[sv.TIME]
