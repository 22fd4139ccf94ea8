"""The needle holder's own stages survive whatever stands in the state: bounded commands, no NaN."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.mechanisms.profile import load_profile
from app.mechanisms.status import OK

PROFILE = load_profile("tensegrity")
MACHINE = PROFILE.machine
CABLES, WINCHES = PROFILE.cables, PROFILE.winches

anything = st.one_of(
    st.floats(-5.0, 5.0), st.sampled_from([np.nan, np.inf, -np.inf, 0.0, 1e300, 5e-324])
)
SLOTS = [
    *range(*sv.CABLE.indices(sv.SLOTS)), *range(*sv.REEL.indices(sv.SLOTS)),
    *range(*sv.Q.indices(sv.SLOTS)), *range(*sv.PATH.indices(sv.SLOTS)),
    *range(*sv.AXIS.indices(sv.SLOTS)), *range(*sv.TORQUE.indices(sv.SLOTS)),
    *range(*sv.JACOBIAN.indices(sv.SLOTS)), sv.DEPTH, sv.L_OUT, sv.L_IN, sv.DT, sv.TIME, sv.Q_TIME,
    sv.FORCE_CAP, sv.SAFETY_SCALE,
]  # fmt: skip


def fair(holds: bool) -> np.ndarray:
    """State of an armed machine at a fair pose."""
    state = sv.empty_state()
    axis = np.array([0.2, -0.1, -0.97])
    state[sv.Q] = MACHINE.usable(axis)
    state[sv.PATH], state[sv.DT], state[sv.TIME], state[sv.Q_TIME] = axis, 1e-3, 5.0, 5.0
    state[sv.ENABLED] = state[sv.SAFETY_SCALE] = state[sv.HOLD] = 1.0
    state[sv.HOLD] = float(holds)
    state[sv.CABLE], state[sv.TENSION] = 12.0, 12.0
    state[sv.FORCE_CAP], state[sv.L_OUT], state[sv.DEPTH] = 5.0, 0.25, 0.04
    pose = MACHINE.stages().pose
    pose.function(state, pose.parameters)
    state[sv.AXIS] = MACHINE.axis(state[sv.Q])
    state[sv.L_IN] = 0.093
    return state


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=300)
@given(
    holds=st.booleans(),
    broken=st.lists(st.tuples(st.sampled_from(SLOTS), anything), min_size=1, max_size=4),
)
def test_whatever_a_slot_holds_the_winches_are_told_something_bounded(holds, broken):
    stages, state = MACHINE.stages(), fair(holds)
    (watch,), (efforts,) = stages.watch, stages.efforts
    for tick in range(4):
        if tick == 2:
            for slot, value in broken:
                state[slot] = value
        stages.pose.function(state, stages.pose.parameters)
        watch.function(state, watch.parameters)
        efforts.function(state, efforts.parameters)
        told = state[sv.HOLDING] > 0.5
        assert np.isfinite(state[sv.REEL_RATE]).all()
        assert (np.abs(state[sv.REEL_RATE]) <= WINCHES.fastest).all()
        if not told:
            assert (state[sv.TENSION] >= 0.0).all()
            assert (state[sv.TENSION] <= CABLES.most).all()
        assert np.isfinite(state[sv.TENSION]).all() or told
        assert np.isfinite(state[sv.MACHINE_FAULT])


@pytest.mark.parametrize(
    "q", [(0.0, 2.2), (np.pi, 2.2), (2.2, 0.0), (2.2, np.pi), (1e-9, 1e-9), (7.0, -3.0)]
)
def test_where_a_cable_has_no_lever_nothing_pulls(q):
    stages, state = MACHINE.stages(), fair(holds=True)
    state[sv.Q] = q
    for stage in (stages.pose, *stages.watch, *stages.efforts):
        stage.function(state, stage.parameters)
    assert state[sv.KINEMATICS] != OK
    assert not state[sv.TENSION].any()
    assert state[sv.HOLDING] == 0.0


@settings(derandomize=True, deadline=None, max_examples=60)
@given(
    torque=st.tuples(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0)),
    step=st.floats(-1e-9, 1e-9),
)
def test_tensions_are_continuous_in_what_is_asked_also_at_a_limit(torque, step):
    def told(left: float, right: float) -> np.ndarray:
        (efforts,), state = MACHINE.stages().efforts, fair(holds=False)
        state[sv.TORQUE] = left, right
        efforts.function(state, efforts.parameters)
        asked = np.array([left, right])
        had = state[sv.TENSION].copy()
        assert np.abs(state[sv.SHORTFALL]).max() <= np.abs(asked).max() + 1e-9
        return had

    left, right = torque
    assert told(left + step, right) == pytest.approx(told(left, right), abs=1e-6)
