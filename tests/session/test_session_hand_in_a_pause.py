"""The hand in a pause, alone: what it is told, where it is let go to, what is known afterwards."""

from types import SimpleNamespace

import numpy as np
import pytest
from session_fakes import row

from app.core.arrays import read_only
from app.session.needle import DepthSource, NeedlePose
from app.session.still_hand import StillHand
from app.session.transitions import PauseCause

CAMERAS, WINDOW = PauseCause.CAMERAS, PauseCause.WINDOW


class Inputs:
    """Keeps what the loop was told of the hand."""

    def __init__(self) -> None:
        self.told: list[tuple[float, float, float, bool]] = []

    def hand(self, x: float, y: float, depth: float, holds: bool) -> None:
        self.told.append((x, y, depth, holds))


def device(x=0.0, y=0.0, depth=0.03, grip=None):
    """Return the loop's hand: where it is wanted, and where it is, if it moves by itself."""
    slots = {"hand_x": x, "hand_y": y, "hand_depth": depth, "hand_holds": 1.0}
    slots |= dict(zip(("grip_x", "grip_y", "grip_depth"), grip or 3 * (np.nan,), strict=True))
    return SimpleNamespace(row=row(0.0, 1, **slots))


def pose(time: float, age: float = 0.0, measured: bool = True) -> NeedlePose:
    source = DepthSource.TRACKED if measured else DepthSource.MODEL
    return NeedlePose(
        read_only(np.zeros(3)), read_only(np.array([0.0, 0.0, -1.0])), 0.03, time, 0.0, age,
        source, True, read_only(1e-9 * np.eye(3)),
    )  # fmt: skip


@pytest.fixture
def hand():
    return StillHand(Inputs())


def told(hand: StillHand) -> list[tuple[float, float, float, bool]]:
    return hand._inputs.told


def seen_then_lost(hand: StillHand, seen, lost) -> None:
    """See the needle at a place and let the cameras lose it at another."""
    hand.follow(None, device(*seen), pose(1.0), False)
    hand.follow(None, device(*lost), pose(1.1, measured=False), False)
    hand.follow(CAMERAS, device(*lost), pose(1.2, measured=False), False)


@pytest.mark.parametrize("cause", [cause for cause in PauseCause if cause is not CAMERAS])
def test_in_every_other_pause_the_hand_is_neither_pushed_nor_pulled_nor_leant(hand, cause) -> None:
    seen_then_lost(hand, (0.0, 0.0, 0.05), (0.0, 0.0, 0.03))
    hand.follow(None, device(), pose(1.3), False)
    hand.follow(cause, device(), pose(1.4), False)
    for place in ((0.0, 0.0, 0.04), (0.0, 0.0, 0.01), (0.2, -0.1, 0.03)):
        assert hand.move(*place, True) is False
    assert set(told(hand)) == {(0.0, 0.0, 0.03, True)}


def test_a_simulated_hand_stays_where_it_is_and_another_where_it_is_wanted(hand) -> None:
    on_its_way = device(0.1, 0.0, 0.08, grip=(0.04, 0.0, 0.05))
    hand.follow(WINDOW, on_its_way, pose(1.0), True)
    assert told(hand)[-1] == (0.04, 0.0, 0.05, True)
    for other, simulated in ((on_its_way, False), (device(0.1, 0.0, 0.08), True)):
        hand.forget()
        hand.follow(WINDOW, other, pose(1.0), simulated)
        assert told(hand)[-1] == (0.1, 0.0, 0.08, True)


def test_as_long_as_the_pause_lasts_the_hand_is_told_to_stand_there(hand) -> None:
    hand.follow(WINDOW, device(), pose(1.0), False)
    hand.follow(WINDOW, device(depth=0.09), pose(1.1), False)  # somebody had moved it just then
    assert told(hand) == 2 * [(0.0, 0.0, 0.03, True)]


def test_between_where_it_was_lost_and_seen_it_goes_and_beyond_neither(hand) -> None:
    seen_then_lost(hand, (0.0, 0.0, 0.03), (0.1, 0.0, 0.03))
    for x, goes in ((0.05, 0.05), (-0.4, 0.0), (0.4, 0.1)):
        assert hand.move(x, 0.3, 0.02, True)
        assert told(hand)[-1] == pytest.approx((goes, 0.0, 0.02, True))


@pytest.mark.parametrize(("seen", "lost"), [(0.05, 0.03), (0.03, 0.05)])
def test_it_goes_in_no_deeper_than_it_has_been_seen_or_was_lost(hand, seen, lost) -> None:
    """Lost on its way out it may come back to where it was seen; lost on its way in, to there."""
    seen_then_lost(hand, (0.0, 0.0, seen), (0.0, 0.0, lost))
    assert hand.move(0.0, 0.0, 0.09, True)
    assert told(hand)[-1][2] == 0.05
    assert hand.move(0.0, 0.0, -0.02, True)
    assert told(hand)[-1][2] == -0.02


def test_it_may_be_let_go_of_while_the_cameras_do_not_see_it(hand) -> None:
    seen_then_lost(hand, (0.0, 0.0, 0.03), (0.0, 0.0, 0.03))
    hand.move(0.0, 0.0, 0.03, False)
    assert told(hand)[-1] == (0.0, 0.0, 0.03, False)


@pytest.mark.parametrize("bad", [(np.nan, 0.0, 0.01), (0.0, np.inf, 0.01), (0.0, 0.0, np.nan)])
def test_what_is_no_place_moves_it_nowhere_in_a_pause(hand, bad) -> None:
    seen_then_lost(hand, (0.0, 0.0, 0.03), (0.1, 0.0, 0.03))
    before = list(told(hand))
    assert hand.move(*bad, True) is False
    assert told(hand) == before


def test_where_it_was_seen_is_where_it_was_as_the_picture_was_taken(hand) -> None:
    hand.follow(None, device(0.0), pose(1.0, measured=False), False)
    hand.follow(None, device(0.1), pose(1.1, measured=False), False)
    hand.follow(None, device(0.2), pose(1.2, age=0.05), False)
    hand.follow(CAMERAS, device(0.2), pose(1.3, measured=False), False)
    hand.move(-1.0, 0.0, 0.0, True)
    assert told(hand)[-1][0] == pytest.approx(0.1)


def test_of_another_attempt_nothing_is_known_of_where_the_needle_was_seen(hand) -> None:
    hand.follow(None, device(0.1, depth=0.09), pose(1.0), False)
    hand.forget()
    hand.follow(CAMERAS, device(0.0), pose(2.0, measured=False), False)
    hand.move(0.1, 0.0, 0.09, True)
    assert told(hand)[-1] == (0.0, 0.0, 0.03, True)
