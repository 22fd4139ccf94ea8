"""What a planner said of a student's path, out of the record again as it was."""

from math import inf

import pytest

from app.imaging.field import TissueKind
from app.planning.judged import JudgedPlan, WayHindrance
from app.session.planned import event_of, judged_plan

RIB = WayHindrance("rib", TissueKind.BONE, 12.0, 3.5, is_sure=False)


@pytest.mark.parametrize(
    "plan",
    [
        JudgedPlan(71.5, 80.0, 12.0, 6.25, "portal vein", 40.0, pleural_deg=20.0),
        JudgedPlan(90.0, 60.0, 5.0, inf),
        JudgedPlan(0.0, 130.0, 70.0, 0.0, "rib", 12.0, (RIB,), None, True, True),
    ],
)
def test_a_plan_comes_out_of_its_event_as_it_went_in(plan):
    event = event_of(plan, 3.0)
    assert judged_plan([event]) == plan
    if plan.clear_mm < inf:
        assert event.data["clear_mm"] == plan.clear_mm
