"""The unsteady hand by itself, against what is published: push, unrest, levels, seed.

Published, read as abstracts: needles of freehand insertions end 3.4 ± 3.1° off (PMC4499536); eye
surgeons who hold an instrument still have 49 µm RMS of error, 133 µm while they work (Riviere,
Rader and Khosla 1997); errors across a movement grow in proportion to it (doi 10.1007/BF00241415).
"""

import numpy as np
import pytest

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.mechanisms.profile import load_profile
from app.simulation.errors import SimulationError
from app.simulation.unsteady import HIGHEST, LEVEL_1, LEVEL_5, hand_unsteady_by_level
from app.simulation.unsteady_hand import Unsteadiness

PROFILE = load_profile("icube")
FREEHAND, ITS_SD = 3.4, 3.1
"""Angle of the needle that freehand insertions leave [°]."""
HELD_STILL, AT_WORK = 49e-6, 133e-6
"""RMS error of an instrument in the hand [m]."""
SPEED = 0.02
"""Of an ordinary insertion [m/s]."""
LEVER = 0.15
"""Of the needle outside the skin, where nothing is said [m]."""


class Hand:
    """The stage alone; the needle is where the hand is, so that only the hand is seen."""

    def __init__(self, level: float, seed: int) -> None:
        self.state = sv.empty_state()
        _, self._step, self._parameters = hand_unsteady_by_level(PROFILE)
        self.state[sv.DT], self.state[sv.HAND_HOLDS] = 1e-3, 1.0
        self.state[sv.HAND_LEVEL], self.state[sv.HAND_SEED] = level, seed
        self.state[sv.PLANT_DEPTH] = PROFILE.needle_length - LEVER

    def wait(self, seconds: float) -> FloatArray:
        """Rows of what the hand is off while nothing is wanted anew, shape (ticks, 3)."""
        rows = np.empty((round(1e3 * seconds), 3))
        for row in rows:
            self._step(self.state, self._parameters)
            row[:] = self.off
        return rows

    def push(self, way: float, speed: float = SPEED) -> None:
        for _ in range(round(1e3 * abs(way) / speed)):
            self.state[sv.HAND_DEPTH] += np.copysign(1e-3 * speed, way)
            self._step(self.state, self._parameters)

    @property
    def off(self) -> FloatArray:
        row: FloatArray = self.state[[sv.UNSTEADY_X, sv.UNSTEADY_Y, sv.UNSTEADY_DEPTH]]
        return row

    @property
    def turned(self) -> float:
        """Angle of the needle from where it is wanted, of the mean of a second [°]."""
        return float(np.degrees(np.linalg.norm(self.wait(1.0)[:, :2].mean(axis=0))))


def turned(level: float, ways: list[float], seeds: int = 150, pause: float = 0.5) -> FloatArray:
    """Angles after pushes with pauses between them, one a seed [°]."""
    angles = []
    for seed in range(1, seeds + 1):
        hand = Hand(level, seed)
        for way in ways:
            hand.push(way)
            hand.wait(pause)
        angles.append(hand.turned)
    return np.array(angles)


@pytest.mark.long("machine")
def test_a_push_that_nobody_mends_leaves_what_freehand_insertions_leave() -> None:
    angles = turned(1, [0.085])
    assert angles.mean() == pytest.approx(FREEHAND, abs=3.0 * ITS_SD / np.sqrt(len(angles)))
    assert angles.std() <= ITS_SD


@pytest.mark.long("machine")
def test_the_error_grows_in_proportion_to_the_way_and_pauses_make_it_less() -> None:
    whole, half = turned(1, [0.08]), turned(1, [0.04])
    assert half.mean() == pytest.approx(0.5 * whole.mean(), rel=0.1)
    pieces = turned(1, [0.01] * 8)
    assert np.sqrt((pieces**2).mean() / (whole**2).mean()) == pytest.approx(8**-0.5, rel=0.25)


@pytest.mark.long("machine")
def test_who_pulls_out_goes_another_way_than_he_came() -> None:
    there_and_back = turned(1, [0.06, -0.06])
    assert np.median(there_and_back) > 1.0


@pytest.mark.long("machine")
def test_a_hand_that_means_to_hold_still_does_as_measured() -> None:
    for level, measured, tremor in ((1, HELD_STILL, LEVEL_1.tremor), (5, AT_WORK, LEVEL_5.tremor)):
        rows = np.concatenate([Hand(level, seed).wait(20.0)[2000:] for seed in range(1, 9)])
        rms = np.sqrt((rows[:, 0] ** 2).mean()) * LEVER
        assert rms == pytest.approx(np.hypot(measured, tremor), rel=0.25)


def test_it_does_not_wander_off_while_it_rests() -> None:
    hand = Hand(5, 3)
    minute = hand.wait(60.0)[:, :2]
    early, late = minute[:20000].mean(axis=0), minute[40000:].mean(axis=0)
    assert np.degrees(np.linalg.norm(late - early)) < 0.1


def test_a_hand_of_level_0_is_steady_to_the_bit() -> None:
    hand = Hand(0, 4)
    hand.push(0.02)
    assert not hand.wait(1.0).any()


@pytest.mark.long("machine")
def test_the_hand_is_the_worse_the_higher_the_level() -> None:
    means = [turned(level, [0.03], seeds=100).mean() for level in (1, 2, 3, HIGHEST)]
    assert means[0] < means[1] < means[2] < means[3]
    assert means[3] / means[0] == pytest.approx(6.6 / 3.4, rel=0.2)


def test_above_the_highest_level_it_gets_no_worse() -> None:
    rows = [Hand(level, 2).wait(1.0) for level in (HIGHEST, 9)]
    np.testing.assert_array_equal(*rows)


def test_one_seed_is_one_hand_to_the_bit_and_another_is_another() -> None:
    def run(seed: int) -> FloatArray:
        hand = Hand(3, seed)
        hand.push(0.01)
        return hand.wait(0.5)

    np.testing.assert_array_equal(run(5), run(5))
    assert np.abs(run(5) - run(6)).max() > 1e-6


def test_sizes_that_are_none_are_refused() -> None:
    good = {name: getattr(LEVEL_1, name) for name in LEVEL_1.__slots__}
    for name, value in (("aside", -0.1), ("unrest", np.nan), ("lag", 0.0), ("memory", 0.0)):
        with pytest.raises(SimulationError, match="unsteadiness"):
            Unsteadiness(**{**good, name: value})


def left(seed: int, speed: float = SPEED, click: float = 0.0) -> float:
    """Angle after 20 mm at one go [°]; `click`: seconds from one click of the wheel to the next."""
    hand, way = Hand(1, seed), 0.02
    hand.wait(0.001)  # it is there: all draw the same side
    if not click:
        hand.push(way, speed)
    for _ in range(round(way / (speed * click)) if click else 0):
        hand.state[sv.HAND_DEPTH] += speed * click
        hand.wait(click)
    return hand.turned


@pytest.mark.long("machine")
@pytest.mark.parametrize(("speed", "click"), [(5e-4, 0.0), (1.9e-3, 0.0), (0.2e-3 / 0.12, 0.12)])
def test_a_push_leaves_its_line_however_slow_it_is(speed: float, click: float) -> None:
    """The last is a fine wheel: 0.2 mm each 120 ms, as somebody turns who means to outwit it."""
    fast = np.mean([left(seed) for seed in range(1, 9)])
    slow = np.mean([left(seed, speed, click) for seed in range(1, 9)])
    assert slow == pytest.approx(fast, rel=0.1)


@pytest.mark.long("machine")
def test_a_hand_that_swings_back_after_a_click_makes_no_other_push_of_it() -> None:
    """Coarse clicks without a rest: 1 mm each 150 ms, faster than the weight comes to rest."""
    clicked = np.array([left(seed, 1e-3 / 0.15, 0.15) for seed in range(1, 60)])
    fast = np.array([left(seed) for seed in range(1, 60)])
    assert np.sqrt((clicked**2).mean()) == pytest.approx(np.sqrt((fast**2).mean()), rel=0.15)
