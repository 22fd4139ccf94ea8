"""Scripted hands against what was measured of people's."""

import numpy as np
import pytest

from app.core.arrays import FloatArray
from app.simulation import skills
from app.simulation.errors import SimulationError
from app.simulation.hands import (
    EXPERT,
    HANDS,
    PROFICIENT,
    WITHIN_HOLD,
    Hand,
    Script,
    named,
    write_hand_script,
)
from app.simulation.trainee import STEP, ScriptPhase, TraineeScript, script_stage, write_script

AXIS = np.array([0.1, 0.2, -1.0]) / np.linalg.norm([0.1, 0.2, -1.0])
DEPTH, HUB = 0.085, 0.115
"""Of the target and of the hub from the fulcrum [m]."""

SEEDS = range(1, 11)
EVERY = pytest.mark.parametrize("hand", HANDS.values(), ids=list(HANDS))


def hub_speed(script: TraineeScript, phase: ScriptPhase) -> FloatArray:
    """Velocity of the hub in the longest stretch of a phase [m/s], (n, 3)."""
    rows = script.rows
    places = np.column_stack([rows[:, 2], HUB * rows[:, 0], HUB * rows[:, 1]])
    velocity = np.diff(places, axis=0) / script.row
    at = np.flatnonzero(rows[:-1, 3] == phase)
    longest = max(np.split(at, np.flatnonzero(np.diff(at) > 1) + 1), key=len)
    return np.asarray(velocity[longest])


def share_of_1_to_7_hz(velocity: FloatArray, every: float) -> float:
    power = (np.abs(np.fft.rfft(velocity, axis=0)) ** 2).sum(axis=1)
    power[1:] *= 2.0
    frequency = np.fft.rfftfreq(len(velocity), every)
    return float(power[(frequency >= 1.0) & (frequency <= 7.0)].sum() / power.sum())


@EVERY
def test_a_hand_inserts_in_pieces_that_follow_each_other_as_measured(hand: Hand) -> None:
    """Share of the hub's velocity power in 1-7 Hz, of the whole and of what is not steady.

    Published: slow movements have distinct peaks there (Celik 2009), 0.02 to 0.6 of the power.
    """
    for seed in SEEDS:
        script = write_hand_script(AXIS, DEPTH, hand, seed)
        velocity = hub_speed(script, ScriptPhase.INSERT)
        assert 0.02 <= share_of_1_to_7_hz(velocity, script.row) <= 0.6
        assert 0.02 <= share_of_1_to_7_hz(velocity - velocity.mean(axis=0), script.row) <= 0.6


def test_the_quick_script_has_no_such_pieces_and_is_another_one() -> None:
    script = write_script(AXIS, DEPTH, skills.EXPERT, 1)
    assert share_of_1_to_7_hz(hub_speed(script, ScriptPhase.INSERT), STEP) < 0.01
    assert script.duration < 30.0


@EVERY
def test_the_tremor_of_a_hand_is_within_what_was_measured_at_a_braced_instrument(
    hand: Hand,
) -> None:
    """15 to 254 µm RMS per axis (PMC3032442)."""
    tile = write_hand_script(AXIS, DEPTH, hand, 1).tremor
    for rms in (HUB * tile[:, 0].std(), HUB * tile[:, 1].std(), tile[:, 2].std()):
        assert 15e-6 <= rms <= 254e-6


def test_hands_take_half_of_the_published_times_of_whole_procedures() -> None:
    """204 s for who is guided, 277 s for who is not (Weigel 2023); a third to two thirds."""
    for name, whole in (("expert-hand", 204.0), ("novice-hand", 277.0)):
        times = [write_hand_script(AXIS, DEPTH, HANDS[name], seed).duration for seed in SEEDS]
        assert np.median(times) / whole == pytest.approx(0.5, abs=0.05)
    assert [hand.skill.redirects for hand in HANDS.values()] == [2, 2, 1, 1, 1]


def _left(hand: Hand) -> tuple[FloatArray, FloatArray]:
    """Angles [°] and distances from the target [mm] that a hand leaves, many seeds."""
    ends = np.array([write_hand_script(AXIS, DEPTH, hand, s).rows[-1] for s in range(1, 101)])
    angle = np.rad2deg(np.hypot(ends[:, 0], ends[:, 1]))
    aside = 1e3 * DEPTH * np.tan(np.deg2rad(angle))
    return angle, np.hypot(aside, 1e3 * (ends[:, 2] - DEPTH))


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("name", "degrees", "millimetres"),
    [
        ("novice-hand", (3.4, 0.4), (6.3, 0.8)),  # freehand, 3.4 ± 3.1° and 6.3 ± 3.6 mm
        ("proficient-hand", (1.3, 0.3), (4.0, 0.4)),  # guided, 1.3 ± 0.9° and 3.6 to 5.0 mm
        ("expert-hand", (0.95, 0.55), (1.8, 0.6)),  # the best, 0.4 to 1.5° and from 1.2 mm
    ],
)
def test_hands_leave_errors_as_published(
    name: str, degrees: tuple[float, float], millimetres: tuple[float, float]
) -> None:
    angle, distance = _left(HANDS[name])
    assert np.mean(angle) == pytest.approx(degrees[0], abs=degrees[1])
    assert np.mean(distance) == pytest.approx(millimetres[0], abs=millimetres[1])


@pytest.mark.long("machine")
def test_no_hand_is_better_than_the_best_that_was_published() -> None:
    angle, distance = _left(EXPERT)
    assert 0.4 <= np.mean(angle) <= 1.9
    assert np.mean(distance) >= 1.2


def test_hands_of_a_seed_differ_by_their_skill_alone() -> None:
    for seed in SEEDS:
        ends = [write_hand_script(AXIS, DEPTH, hand, seed).rows[-1] for hand in HANDS.values()]
        angles = [float(np.hypot(end[0], end[1])) for end in ends]
        assert (np.diff(angles) < 0.007).all()  # 0.4° of wander, which is each hand's own


@EVERY
def test_what_is_done_in_a_breath_hold_is_done_within_it(hand: Hand) -> None:
    rows = write_hand_script(AXIS, DEPTH, hand, 1, holds=True).rows
    needs = (rows[:, 3] == ScriptPhase.INSERT) | (rows[:, 3] >= ScriptPhase.CORRECT)
    at = np.flatnonzero(needs)
    for run in np.split(at, np.flatnonzero(np.diff(at) > 1) + 1):
        assert len(run) * 0.02 <= WITHIN_HOLD + 0.2


def test_a_script_of_any_time_between_rows_is_played_at_the_same_pace() -> None:
    slow = write_hand_script(AXIS, DEPTH, EXPERT, 1)
    quick = write_script(AXIS, DEPTH, skills.EXPERT, 1)
    place = 1  # of the speed, behind the beginning
    assert script_stage(quick, AXIS).parameters[place] == 1.0
    assert script_stage(slow, AXIS).parameters[place] == 0.25
    assert slow.duration == pytest.approx(0.02 * (len(slow.rows) - 1))


def test_movements_go_on_from_where_the_last_one_ended() -> None:
    for hand in HANDS.values():
        rows = write_hand_script(AXIS, 0.012, hand, 3).rows  # shallower than any overshoot is far
        assert np.isfinite(rows).all()
        assert np.abs(np.diff(rows[:, 2])).max() < 0.002
        assert np.rad2deg(np.abs(np.diff(rows[:, :2], axis=0)).max()) < 1.0


def test_names_tell_the_script_and_bad_ones_are_refused() -> None:
    assert named("expert", Script.QUICK) == "expert"
    assert HANDS[named("proficient", Script.HAND)] is PROFICIENT
    with pytest.raises(SimulationError, match="it must be above 0"):
        write_hand_script(AXIS, 0.0, EXPERT, 1)
