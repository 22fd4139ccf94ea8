"""The classifier: poses become events, noise does not."""

from dataclasses import replace

import numpy as np
import pytest

from app.session.machine import TABLE, AttemptEvent, State
from app.session.needle import DOWN, DepthSource, NeedlePose
from app.session.transitions import Classifier, classify

STILL = NeedlePose(
    p_tip=np.zeros(3),
    axis=DOWN,
    depth=0.0,
    time=0.0,
    orientation_age=0.0,
    depth_age=0.0,
    depth_source=DepthSource.TRACKED,
    valid=True,
    covariance=np.zeros((3, 3)),
)


def look(
    memory: Classifier, state: State, pose: NeedlePose, distance: float
) -> tuple[Classifier, AttemptEvent | None]:
    """Look at a pose as a running attempt does."""
    return classify(memory, state, pose.time, pose.depth if pose.measured else None, distance)


def play(
    depths: np.ndarray, state: State, distance: float = 0.001, **pose: object
) -> list[AttemptEvent]:
    """Events of a sequence of depths [m] at 50 Hz."""
    memory, events = Classifier(), []
    for k, depth in enumerate(depths):
        seen = replace(STILL, depth=float(depth), time=k * 0.02, **pose)
        memory, event = look(memory, state, seen, distance)
        if event is not None:
            state = TABLE[state, event]
            events.append(event)
    return events


def test_passing_the_skin_by_two_millimetres_is_an_insertion() -> None:
    assert play(np.linspace(-0.02, 0.0019, 50), State.ALIGNING) == []
    assert play(np.linspace(-0.02, 0.0025, 50), State.ALIGNING) == [AttemptEvent.INSERT]


def test_noise_about_the_skin_does_not_chatter() -> None:
    noise = np.random.default_rng(3).normal(0.0, 0.0003, 500)
    assert play(0.001 + noise, State.ALIGNING) == []
    assert play(0.001 + noise, State.INSERTING, distance=1.0) == []


def test_standing_still_for_a_second_near_the_target_is_a_hold() -> None:
    still = np.full(60, 0.05)
    assert play(still[:50], State.INSERTING) == []
    assert play(still, State.INSERTING) == [AttemptEvent.HOLD]


def test_camera_noise_does_not_prevent_a_hold() -> None:
    noise = np.random.default_rng(5).uniform(-0.0002, 0.0002, 200)
    assert play(0.05 + noise, State.INSERTING) == [AttemptEvent.HOLD]


def test_standing_still_far_from_the_target_is_no_hold() -> None:
    assert play(np.full(200, 0.05), State.INSERTING, distance=0.03) == []


def test_creeping_faster_than_a_millimetre_a_second_is_no_hold() -> None:
    assert play(0.03 + 0.0011 * np.arange(200) * 0.02, State.INSERTING) == []
    assert AttemptEvent.HOLD in play(0.03 + 0.0009 * np.arange(60) * 0.02, State.INSERTING)


def test_moving_on_ends_the_hold_and_a_new_one_needs_a_new_second() -> None:
    depths = np.concatenate([np.full(60, 0.05), np.full(60, 0.053)])
    assert play(depths, State.INSERTING) == [
        AttemptEvent.HOLD,
        AttemptEvent.INSERT,
        AttemptEvent.HOLD,
    ]
    assert play(depths[:90], State.INSERTING) == [AttemptEvent.HOLD, AttemptEvent.INSERT]


@pytest.mark.parametrize("state", [State.INSERTING, State.HOLDING])
def test_pulling_the_tip_out_of_the_skin_is_a_withdrawal(state: State) -> None:
    assert play(np.array([-0.001]), state) == [AttemptEvent.WITHDRAW]


@pytest.mark.parametrize("source", [DepthSource.MODEL, DepthSource.NONE])
def test_a_depth_that_no_camera_vouches_for_moves_nothing(source: DepthSource) -> None:
    for state in (State.ALIGNING, State.INSERTING, State.HOLDING):
        assert play(np.linspace(-0.05, 0.08, 100), state, depth_source=source) == []
        assert play(np.linspace(-0.05, 0.08, 100), state, valid=False) == []


def test_poses_at_equal_times_replace_one_another() -> None:
    memory = Classifier()
    for depth in (0.01, 0.02, 0.03):
        memory, event = look(memory, State.INSERTING, replace(STILL, depth=depth), 0.0)
        assert event is None
    assert memory.window == ((0.0, 0.03),)


def test_the_window_stays_short() -> None:
    memory = Classifier()
    for k in range(5000):
        pose = replace(STILL, depth=0.05, time=k * 0.02)
        memory, _ = look(memory, State.ALIGNING, pose, 1.0)
    assert len(memory.window) <= 52
