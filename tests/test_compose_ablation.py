"""A scripted hand leaves three electrodes in place and ablates; the robot's help is none."""

import pytest

from app.compose.exercise_ct import load_field, read_ct
from app.compose.trial import Trials, attempt
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of


@pytest.fixture(scope="module")
def prepared():
    exercise = load_exercise("liver-ablation")
    placed = placed_plan_of(exercise, device_of(exercise))
    return exercise, placed, load_field(exercise, read_ct(exercise), placed.plan)


def values(score):
    return {row.name: row.value for row in score.rows}


@pytest.mark.long("machine")
def test_an_expert_reaches_the_wanted_margin_and_passes_and_a_novice_does_not(prepared):
    exercise, placed, field = prepared
    trials = Trials(exercise, placed, tissues=field)
    expert, novice = (trials.score(skill, 1).score for skill in ("expert", "novice"))
    assert expert.passed
    assert not novice.passed
    reached = [values(score)["least_margin"] for score in (expert, novice)]
    assert reached[0] > 6.0
    assert 0.0 < reached[1] < 5.0
    spacing = [values(score)["electrode_spacing"] for score in (expert, novice)]
    assert spacing[0] < 3.0 < spacing[1]


@pytest.mark.long("statistics")
def test_an_attempt_without_a_trainer_scores_as_one_with_it(prepared):
    exercise, placed, field = prepared
    quick = Trials(exercise, placed, tissues=field).score("expert", 1).score
    whole = attempt(exercise, placed, "expert", 1, tissues=field).score
    one, other = values(quick), values(whole)
    for name, within in (
        ("least_margin", 0.05),
        ("ablated_share", 0.05),
        ("electrode_spacing", 0.05),
        ("vessels_near_zone", 0.0),
        ("zone_reaches", 0.0),
        ("total_time", 0.1),
    ):
        assert one[name] == pytest.approx(other[name], abs=within)
