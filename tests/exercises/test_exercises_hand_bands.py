"""Bands of a hand: read, refused, and applied to the hand that they are of and to no other."""

from pathlib import Path

import pytest

from app.core.errors import ConfigurationError
from app.exercises.drill import DrillKind
from app.exercises.drilled import drilled
from app.exercises.hand_bands import BandsSource
from app.exercises.library import read_exercise
from app.exercises.locks import HandName
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan

TOLERANCES = """
tolerances:
  lateral_error: {expert: 1, good: 2, pass: 3, weight: 3, required: true}
  angle_error: {expert: 1, good: 2, pass: 3, weight: 2, required: true}
  total_time: {expert: 100, good: 200, pass: 300}
"""
MOUSE = """
bands:
  mouse:
    source: scripts
    metrics:
      angle_error: {expert: 0.25, good: 0.5, pass: 1, zero: 4}
"""


def read(tmp_path: Path, text: str) -> Exercise:
    path = tmp_path / "mine.yaml"
    path.write_text(f"id: mine\ntitle: Mine\n{text}", encoding="utf-8")
    return read_exercise(path)


def test_the_bands_of_a_hand_take_the_place_of_knots_and_of_nothing_else(tmp_path: Path) -> None:
    exercise = read(tmp_path, TOLERANCES + MOUSE)
    for hand in ("mouse", "keyboard"):
        judged = exercise.tolerances_for(hand)
        assert judged["angle_error"].knots == (0.25, 0.5, 1.0, 4.0)
        assert (judged["angle_error"].weight, judged["angle_error"].required) == (2.0, True)
        others = {name for name in judged if judged[name] != exercise.tolerances[name]}
        assert others == {"angle_error"}
        assert list(judged) == list(exercise.tolerances), "in the exercise's order"
        assert exercise.bands_for(hand) is HandName.MOUSE
    for hand in ("robot", "pen", "script", "arm", "tablet", "gamepad", ""):
        assert exercise.tolerances_for(hand) == exercise.tolerances
        assert exercise.bands_for(hand) is None
    assert exercise.bands[HandName.MOUSE].source is BandsSource.SCRIPTS


def test_a_zero_that_is_not_said_is_twice_the_bands_own_pass(tmp_path: Path) -> None:
    tolerances = TOLERANCES.replace("pass: 3, weight: 2", "pass: 3, zero: 9, weight: 2")
    exercise = read(tmp_path, tolerances + MOUSE.replace(", zero: 4", ""))
    assert exercise.tolerances["angle_error"].knots[3] == 9.0
    assert exercise.tolerances_for("mouse")["angle_error"].knots[3] == 2.0


@pytest.mark.parametrize(
    ("metric", "knots", "match"),
    [
        ("peak_force", "{expert: 1, good: 2, pass: 3}", "no tolerance"),
        ("lateral_error", "{expert: 1, good: 2, pass: 3}", "same for every hand"),
        ("angle_error", "{expert: 3, good: 2, pass: 1}", "runs against"),
        ("angle_error", "{expert: 1, good: 3, pass: 2}", "rise or fall strictly"),
        ("angle_error", "{expert: 1, good: 2, pass: 3, weight: 9}", "weight"),
    ],
)
def test_bands_that_cannot_be_meant_are_refused_with_hand_and_metric(
    tmp_path: Path, metric: str, knots: str, match: str
) -> None:
    bands = f"bands:\n  mouse: {{metrics: {{{metric}: {knots}}}}}\n"
    with pytest.raises(ConfigurationError, match=match):
        read(tmp_path, TOLERANCES + bands)


@pytest.mark.parametrize("text", ["bands: {robot: {metrics: {}}}", "bands: {mouse: {metrics: {}}}"])
def test_a_hand_that_is_none_of_the_simulated_ones_has_none(tmp_path: Path, text: str) -> None:
    with pytest.raises(ConfigurationError, match="bands"):
        read(tmp_path, TOLERANCES + text + "\n")


@pytest.mark.parametrize("kind", list(DrillKind))
def test_a_drill_is_judged_by_the_bands_of_the_same_hand(tmp_path: Path, kind: DrillKind) -> None:
    exercise = read(tmp_path, TOLERANCES + MOUSE)
    plan = Plan((0.0, -95.0, 300.0), (20.0, -20.0, 310.0))
    drill = drilled(exercise, kind, PlacedPlan.of(plan, Placement(), (0.0, 0.16, 0.09)))
    again = Exercise.model_validate(drill.model_dump(mode="json"))  # as its record is read
    assert again.tolerances_for("mouse") == drill.tolerances_for("mouse")
    judged = drill.tolerances_for("mouse")
    assert judged["angle_error"].knots == (0.25, 0.5, 1.0, 4.0)
    assert drill.tolerances["angle_error"].knots == (1.0, 2.0, 3.0, 6.0)
    if kind is DrillKind.ALIGN:
        assert judged["angle_at_skin"].knots == (0.25, 0.5, 1.0, 4.0)
        assert drill.tolerances["angle_at_skin"].knots == (1.0, 2.0, 3.0, 6.0)
