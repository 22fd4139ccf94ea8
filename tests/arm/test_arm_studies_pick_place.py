"""The study of insertions: what counts as success, how failures are counted, and a few trials."""

from dataclasses import replace
from importlib.util import find_spec

import numpy as np
import pytest

from app.arm.scene import ArmTrial, CarryFailure, CarryPhase
from app.arm.studies.pick_place import INEXACT, measured, outcome
from app.studies.runner import examine

GOOD = ArmTrial(
    1,
    np.array([0.0, 0.0, -1.0]),
    0.08,
    {"fulcrum_mm": 0.1},
    (CarryPhase("insert", 20.0, {"tip_mm": 0.5, "axis_from_fulcrum_mm": 0.4, "ring_N": 0.0}),),
    None,
    "",
    20.0,
    1.0,
    2.0,
)


def ending(tip, axis):
    errors = {"tip_mm": tip, "axis_from_fulcrum_mm": axis, "ring_N": 0.5}
    return replace(GOOD, phases=(CarryPhase("insert", 20.0, errors),))


def test_success_is_a_tip_within_3_mm_and_an_axis_within_1_mm_of_the_fulcrum():
    assert outcome(GOOD) == outcome(ending(3.0, 1.0)) == "succeeded"
    assert outcome(ending(3.01, 0.1)) == INEXACT
    assert outcome(ending(0.1, 1.01)) == INEXACT
    assert outcome(replace(GOOD, failure=CarryFailure.NO_WAY)) == "no way"


def test_failures_are_counted_by_cause_and_nine_of_ten_must_succeed():
    failed = replace(GOOD, failure=CarryFailure.SLIPPED, phases=())
    for bad, passed in ((1, True), (2, False)):
        found = measured(range(10), lambda seed, _, bad=bad: failed if seed < bad else GOOD)
        sheets = {sheet.name: sheet for sheet in found.sheets}
        assert dict(row[:2] for row in sheets["outcomes"].rows) == {
            "succeeded": 10 - bad,
            "slipped": bad,
        }
        assert len(sheets["trials"].rows) == 10
        assert found.passed is passed
        assert found.lines[0].startswith(f"{10 - bad} of 10 tools inserted")
        assert "known exactly: no error of calibration" in found.lines[-1]  # what it leaves out


def test_it_draws():
    figure = pytest.importorskip("matplotlib.figure").Figure()
    found = measured(range(3), lambda seed, _: GOOD if seed else ending(2.9, 1.5))
    found.figures[0].draw(figure)
    assert len(figure.axes) == 2


@pytest.mark.long("statistics")
@pytest.mark.skipif(
    any(find_spec(name) is None for name in ("mujoco", "ompl", "ruckig")),
    reason="needs the extra arm: make extra NAME=arm",
)
def test_the_quick_study_inserts_its_tools_by_pictures_alone():
    found = examine("pick_place", quick=True).findings
    assert found.passed
    assert found.lines[0].startswith("3 of 3 tools inserted")
