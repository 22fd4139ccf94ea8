"""The hand at an emulated robot: what typed orders make it do."""

import numpy as np
import pytest

from app.compose.emulator import SPEED, EmulatedHand
from app.device.errors import LinkError
from app.mechanisms.errors import MechanismError
from app.mechanisms.pantograph import system_inverse
from app.mechanisms.profile import load_profile
from app.simulation.plant import initial_plant

PROFILE = load_profile("icube")
DEPTH = -0.015
START = initial_plant(PROFILE, (0.0, 0.0, -1.0), DEPTH)
Q = START["plant_q_left"], START["plant_q_right"]


class Inbox:
    def write(self, **values):
        self.values = values


@pytest.fixture
def hand():
    return EmulatedHand(PROFILE, DEPTH, Q, "none")


def after(hand, seconds):
    """HAND_* after a while of work."""
    inbox = Inbox()
    for now in np.arange(0.0, seconds, 0.02) + 10.0:
        hand.work(float(now), inbox)
    return inbox.values


def test_turning_one_link_moves_that_joint_alone(hand):
    hand.obey(["turn", "left", "10"])
    wanted = after(hand, 5.0)
    x, y = wanted["hand_x"], wanted["hand_y"]
    assert wanted["hand_holds"] == 1.0
    axis = np.array([x, y, -np.sqrt(1.0 - x * x - y * y)])
    geometry = PROFILE.pantograph
    q, _ = system_inverse(geometry, geometry.fulcrum - (geometry.needle_length - DEPTH) * axis)
    np.testing.assert_allclose(q - Q, [np.radians(10.0), 0.0], atol=1e-6)
    hand.obey(["turn", "left", "-10"])
    back = after(hand, 5.0)
    assert np.hypot(back["hand_x"], back["hand_y"]) < 1e-6


def test_a_typed_order_never_moves_the_needle_faster_than_a_hand_would(hand):
    hand.obey(["lean", "20", "-5"])
    inbox, before = Inbox(), np.zeros(2)
    for now in np.arange(0.0, 3.0, 0.01):
        hand.work(float(now), inbox)
        at = np.array([inbox.values["hand_x"], inbox.values["hand_y"]])
        assert np.hypot(*(at - before)) <= SPEED * 0.011
        before = at
    np.testing.assert_allclose(before, np.sin(np.radians([20.0, -5.0])))


def test_the_needle_can_be_let_go_and_taken_again(hand):
    assert after(hand, 0.1)["hand_holds"] == 0.0
    hand.obey(["hold", "on"])
    assert after(hand, 0.1)["hand_holds"] == 1.0
    hand.obey(["hold", "off"])
    assert after(hand, 0.1)["hand_holds"] == 0.0


@pytest.mark.parametrize(
    ("order", "reason"),
    [
        ("hold 2", "hold on|off"),
        ("hold nobody", "hold on|off"),
        ("turn up 3", "turn left|right DEGREES"),
        ("turn left far", "'far' is no number"),
        ("lean 3", "lean X Y"),
        ("lean 80 0", "at most 45"),
        ("lean nan 0", "at most 45"),
    ],
)
def test_an_order_that_cannot_be_obeyed_is_refused_with_what_can(hand, order, reason):
    with pytest.raises(LinkError) as refused:
        hand.obey(order.split())
    assert reason in str(refused.value)


def turn_round(hand):
    for _ in range(20):
        hand.obey(["turn", "left", "40"])


def test_a_link_that_cannot_be_turned_so_far_is_refused(hand):
    with pytest.raises((LinkError, MechanismError)):
        turn_round(hand)


def test_a_hand_that_is_not_known_is_refused():
    with pytest.raises(LinkError, match="valid names: none, rest, script"):
        EmulatedHand(PROFILE, DEPTH, Q, "nobody")


def test_an_order_that_there_is_not_is_answered_with_all_that_there_are():
    from app.compose.emulator import Emulator, EmulatorSetup
    from app.mechanisms.profile import load_profile

    emulator = Emulator(EmulatorSetup(load_profile("icube")), lambda _: None)
    with pytest.raises(LinkError, match="no fault or order 'smoke'") as told:
        emulator.switch("smoke 1")
    for name in ("drop", "error", "reset", "unplug", "park", "hold", "turn", "lean"):
        assert name in str(told.value)
    emulator.switch("park on")
