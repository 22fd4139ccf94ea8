"""What a student's own path is worth, by what the planner says of it."""

from math import inf
from types import SimpleNamespace

import pytest

from app.planning.judged import JudgedPlan
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError
from app.scoring.metrics import plan_clearance, plan_score


def judged(**changes):
    of = {"points": 71.5, "length_mm": 80.0, "angle_deg": 12.0, "clear_mm": 6.25} | changes
    return SimpleNamespace(planned=JudgedPlan(**of))


def test_points_and_millimetres_are_the_planner_s_own():
    assert plan_score.compute(judged()) == 71.5
    assert plan_clearance.compute(judged()) == 6.25


def test_a_path_with_nothing_near_has_points_and_no_room_in_figures():
    assert plan_score.compute(judged(clear_mm=inf)) == 71.5
    with pytest.raises(MetricUnavailableError):
        plan_clearance.compute(judged(clear_mm=inf))


@pytest.mark.parametrize("metric", [plan_score, plan_clearance])
def test_a_path_that_was_given_is_asked_nothing(metric):
    with pytest.raises(MetricNotAskedError):
        metric.compute(SimpleNamespace(planned=None))
