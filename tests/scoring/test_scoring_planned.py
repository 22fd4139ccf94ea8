"""What a student's own path is worth, by what the planner says of it."""

from math import inf
from types import SimpleNamespace

import pytest

from app.planning.judged import JudgedPlan
from app.planning.lung_path.values import LungCrossing, LungPathReport
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError
from app.scoring.metrics import (
    plan_clearance,
    plan_score,
    planned_emphysema,
    planned_fissures,
    planned_intercostal,
    planned_lung,
    planned_pleural_angle,
    planned_rib_border,
)


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


LUNG = LungPathReport(
    *((0.0, 0.0, 0.0), (0.0, 90.0, 0.0), 90.0, 0.0),
    pleura=(LungCrossing(25.0, 31.0, (0.0, 25.0, 0.0)),),
    fissures=(),
    lung_mm=58.5,
    emphysema_mm=None,
    rib_below_mm=7.0,
    rib_above_mm=4.5,
    rib_below_at=None,
    rib_above_at=None,
    intercostal_mm=3.5,
    spine_mm=None,
    is_protected=None,
    vessels=None,
    bronchi=(),
)


def test_the_figures_of_a_path_through_the_lung_are_those_of_its_report():
    plan = judged(lung=LUNG)
    values = {
        metric: metric.compute(plan)
        for metric in (
            *(planned_lung, planned_fissures, planned_rib_border),
            *(planned_intercostal, planned_pleural_angle),
        )
    }
    assert list(values.values()) == [58.5, 0.0, 4.5, 3.5, 31.0]
    assert {metric.deviation(plan) for metric in values} == {0.0}


def test_a_figure_that_nobody_knows_has_no_value_and_none_is_asked_where_no_report_was():
    with pytest.raises(MetricUnavailableError, match="nobody labelled"):
        planned_emphysema.compute(judged(lung=LUNG))
    with pytest.raises(MetricNotAskedError):
        planned_lung.compute(judged())


@pytest.mark.parametrize("metric", [plan_score, plan_clearance, planned_lung])
def test_a_path_that_was_given_is_asked_nothing(metric):
    with pytest.raises(MetricNotAskedError):
        metric.compute(SimpleNamespace(planned=None))
