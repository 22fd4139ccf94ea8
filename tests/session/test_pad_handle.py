"""The handle of a long tool: rates by finite differences, and those of the arm at a trocar."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.arm.mechanics import load_arm
from app.arm.motion.pivot import HeldTool, Pivot
from app.core.arrays import unit
from app.core.errors import NumericalError
from app.planning.placement import PatientOrientation
from app.session.pad.geometry import PadScale, path_frame
from app.session.pad.hand import LEAST_OUTSIDE, Handle, HandLimits, HandPose, PadHand

TOOL = Handle(0.3)
FRAME = path_frame((0.1, -0.2, -1.0), PatientOrientation.SUPINE.rotation)
LIMITS = HandLimits(0.68, -0.03, 0.12)
MANY = settings(derandomize=True, deadline=None, max_examples=100)
SIDE = st.floats(-0.4, 0.4)


def hand_at(direction, depth, handle=TOOL):
    pose = HandPose(unit(direction), depth, True)
    return PadHand(FRAME, PadScale(0.08, 0.004), LIMITS, pose, handle)


@pytest.mark.long("journey")
@MANY
@given(SIDE, SIDE, st.floats(0.005, 0.11), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_tip_and_handle_go_as_the_arm_at_a_trocar_says(x, y, depth, right, up):
    axis = unit([x, y, -1.0])
    pivot = Pivot(load_arm(), HeldTool(0.3, 0.3, np.array([1.0, 0.0, 0.0])), np.zeros(3),
                  np.array([0.0, 0.0, -1.0]))  # fmt: skip
    step = 1e-6 * np.array([right, up])
    turn = (TOOL.turned(FRAME, axis, step, depth) - TOOL.turned(FRAME, axis, -step, depth)) / 2.0
    tip, grip = depth * turn, -(0.3 - depth) * turn
    rates = pivot.rates(depth * axis, tip)
    np.testing.assert_allclose(rates.velocity, grip, atol=1e-14)
    assert np.linalg.norm(grip) == pytest.approx(np.hypot(*step), abs=1e-12)
    np.testing.assert_allclose(tip, TOOL.scale(depth) * grip, atol=1e-14)


def test_the_tip_goes_the_other_way_and_farther_the_deeper_it_is():
    ways = []
    for depth in (0.03, 0.06, 0.1):
        after = TOOL.turned(FRAME, FRAME.axis, (0.01, 0.0), depth)
        ways.append(depth * (after - FRAME.axis) @ FRAME.right)
    assert ways[0] < 0.0
    assert ways == sorted(ways, reverse=True)
    assert ways[1] / 0.01 == pytest.approx(-0.06 / 0.24, rel=1e-2)


def test_mouse_keys_and_stick_move_the_handle_alike():
    dragged, tilted = hand_at(FRAME.axis, 0.05), hand_at(FRAME.axis, 0.05)
    dragged.drag((0.1, -0.05))  # 12 mm and 6 mm of the handle, the tip to the right and down
    tilted.tilt(0.1 * TOOL.reach / TOOL.length, -0.05 * TOOL.reach / TOOL.length)
    np.testing.assert_allclose(dragged.pose.direction, tilted.pose.direction, atol=1e-15)
    assert dragged.pose.direction @ FRAME.right > 0.0
    assert dragged.pose.depth == 0.05


def test_a_way_is_as_long_wherever_the_tool_leans():
    for lean in (0.0, 0.3, 0.6):
        axis = unit(np.cos(lean) * FRAME.axis + np.sin(lean) * FRAME.right)
        after = TOOL.turned(FRAME, axis, (0.006, 0.008), 0.05)
        assert np.arccos(after @ axis) == pytest.approx(0.01 / 0.25, rel=1e-9)


def test_a_handle_near_the_skin_and_a_mouse_that_leaps_stay_bounded():
    assert TOOL.scale(0.299) == pytest.approx(-0.299 / LEAST_OUTSIDE)
    hand = hand_at(FRAME.axis, 0.11)
    for step in ((1e6, -1e6), (0.0, 0.0), (-3.0, 2.0)):
        hand.drag(step)
        assert np.isfinite(hand.pose.direction).all()
        assert np.arctan2(np.hypot(*hand.pose.direction[:2]), -hand.pose.direction[2]) <= 0.6801
    with pytest.raises(NumericalError):
        hand.drag((np.nan, 0.0))


def test_without_a_handle_the_hand_is_as_it_was():
    plain, old = hand_at(FRAME.axis, 0.05, None), hand_at(FRAME.axis, 0.05, None)
    plain.tilt(0.01, 0.02)
    old.tilt(0.01, 0.02)
    np.testing.assert_allclose(FRAME.tilts(plain.pose.direction), (0.01, 0.02), atol=1e-12)


@pytest.mark.parametrize("length", [0.0, LEAST_OUTSIDE, 20.0, np.nan])
def test_a_tool_of_no_length_is_refused(length):
    with pytest.raises(NumericalError, match="handle"):
        Handle(length)
