"""Which depths of the cameras are believed."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.session.fixes import AGREEING, FORGOTTEN, DepthGate

SPEED = 0.15
FRAME = 1.0 / 30.0
SIGMA = 2e-4


def feed(gate, depths, start=10.0, frame=FRAME, variance=SIGMA**2):
    """Verdict on each depth, one a frame."""
    return [gate.take(start + frame * k, d, variance) for k, d in enumerate(depths)]


def test_a_first_depth_counts_only_after_the_next_ten_have_agreed():
    assert feed(DepthGate(SPEED), [0.05] * 13) == [False] * AGREEING + [True] * 3


def test_a_hand_that_moves_as_hands_do_is_followed():
    depths = 0.02 + 0.8 * SPEED * FRAME * np.arange(40)
    assert all(feed(DepthGate(SPEED), depths)[AGREEING:])


@settings(derandomize=True, deadline=None, max_examples=100)
@given(jump=st.floats(0.010, 0.1), sign=st.sampled_from([-1.0, 1.0]), later=st.integers(0, 20))
def test_a_jump_is_refused_and_ten_new_ones_have_to_agree_whichever_was_right(jump, sign, later):
    gate = DepthGate(SPEED)
    verdicts = feed(gate, [0.04] * (AGREEING + 1 + later) + [0.04 + sign * jump] * 15)
    after = verdicts[AGREEING + 1 + later :]
    assert after == [False] * AGREEING + [True] * 5


def test_one_false_marker_among_right_ones_costs_ten_pictures_and_is_never_believed():
    depths = [0.04] * 20 + [0.09] + [0.04] * 20
    verdicts = feed(DepthGate(SPEED), depths)
    assert verdicts[19]
    assert not any(verdicts[20 : 21 + AGREEING])
    assert all(verdicts[21 + AGREEING :])


def test_a_marker_that_comes_and_goes_between_two_places_is_never_believed():
    assert not any(feed(DepthGate(SPEED), [0.02, 0.09] * 50))


def test_after_a_gap_the_next_depth_is_a_first_one_again():
    gate = DepthGate(SPEED)
    assert feed(gate, [0.04] * 12)[-1]
    later = 10.0 + 12 * FRAME + FORGOTTEN
    assert not gate.take(later, 0.04, SIGMA**2)
    assert "just found" in gate.doubt


def test_a_slow_computer_is_believed_too_but_not_when_a_depth_comes_back_elsewhere():
    gate = DepthGate(SPEED)
    assert feed(gate, [0.04] * 12, frame=0.4) == [False] * AGREEING + [True] * 2
    later = 10.0 + 12 * 0.4 + 0.3
    assert gate.take(later, 0.05, SIGMA**2)
    assert not gate.take(later + 0.9, 0.09, SIGMA**2)


@pytest.mark.parametrize("wrong", [(np.nan, 1e-8), (np.inf, 1e-8), (0.04, np.nan), (0.04, -1.0)])
def test_what_is_no_number_is_refused_like_a_jump(wrong):
    gate = DepthGate(SPEED)
    assert feed(gate, [0.04] * 12)[-1]
    assert not gate.take(10.0 + 12 * FRAME, *wrong)
    assert not gate.take(10.0 + 13 * FRAME, 0.04, SIGMA**2)


def test_the_doubt_says_why_and_how_far_it_is():
    gate = DepthGate(SPEED)
    feed(gate, [0.04] * 12)
    assert gate.doubt == ""
    gate.take(10.0 + 12 * FRAME, 0.09, SIGMA**2)
    assert "jumped by 50 mm" in gate.doubt
    assert "0 of 10" in gate.doubt


def test_a_depth_that_is_wrong_in_every_picture_alike_passes_for_no_gate_can_see_it():
    assert feed(DepthGate(SPEED), [0.04 + 0.003] * 12)[-1]
