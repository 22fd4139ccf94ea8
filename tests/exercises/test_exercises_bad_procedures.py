"""Procedures that cannot be: each is refused in a line that says what is wrong and what will do."""

from typing import Any

import pytest

from app.core.errors import AcusError
from app.exercises.library import load_exercise
from app.exercises.schema import Exercise
from app.imaging.scan_order import ScanOrder

BIOPSY: dict[str, Any] = {"biopsy": {}}


def asking(procedure: dict[str, Any], **more: Any) -> Exercise:
    return Exercise.model_validate(
        {"id": "x", "title": "X", "tissue": "field", "procedure": procedure, **more}
    )


LONG_NOTCH = {"throw_mm": 20, "notch_mm": 16, "dead_tip_mm": 6}
ABLATION = {"power_w": 40, "minutes": 20}


@pytest.mark.parametrize(
    ("procedure", "words"),
    [
        ({**BIOPSY, "checklist": {"inr": 2.4}}, r"inr 2\.4: above 1\.8 .* 1\.8 or less"),
        ({**BIOPSY, "checklist": {"platelets": 30}}, r"platelets 30 .* below 50 .* 50 or more"),
        ({**BIOPSY, "checklist": {"inr": 0}}, "greater than 0"),
        ({"rollover": {}, "checklist": {}}, "rollover is after samples or an ablation"),
        ({"biopsy": {"throws": [LONG_NOTCH]}}, "longer than the throw of 20 mm"),
        ({"biopsy": {"diagnostic_mm": 15}}, "more than the longest notch holds"),
        ({"grid": {"lines": 4}}, "an odd number has a line in the middle"),
        ({"ablation": {"power_w": 41, "minutes": 20}}, "41"),
        ({"ablation": {**ABLATION, "electrodes": [{"target_mm": [0, 0, 0]}] * 2}}, "at one place"),
        ({**BIOPSY, "ablation": ABLATION}, "samples and ablation are two exercises"),
        ({}, "names no step; there are grid, anaesthetic, biopsy"),
    ],
)
def test_what_cannot_be_done_is_refused_in_a_line(procedure: dict[str, Any], words: str) -> None:
    with pytest.raises((ValueError, AcusError), match=words):
        asking(procedure)


@pytest.mark.parametrize("tilt", [-30.5, 31.0, float("nan")])
def test_no_gantry_tilts_further_than_thirty_degrees(tilt: float) -> None:
    with pytest.raises(AcusError, match="30"):
        ScanOrder(0.0, 3, 3.0, tilt_deg=tilt)


def test_what_is_not_asked_for_is_not_judged() -> None:
    judged = {"expert": 10, "good": 20, "pass": 60, "zero": 300}
    with pytest.raises((ValueError, AcusError), match="add rollover to procedure"):
        asking(BIOPSY, tolerances={"rollover_time": judged})
    full = {"expert": 100, "good": 75, "pass": 50, "zero": 0}
    with pytest.raises((ValueError, AcusError), match="add checklist to procedure"):
        asking(BIOPSY, tolerances={"checklist_done": full})


def test_the_entry_of_trials_needs_its_target() -> None:
    with pytest.raises(ValueError, match="trial_entry_mm goes with target_mm"):
        asking(BIOPSY, plan={"own": True, "trial_entry_mm": [0, 0, 0]})


def test_what_an_exercise_does_not_ask_for_leaves_its_document_as_it_was() -> None:
    plain = asking({"biopsy": {}, "anaesthetic": {}}).model_dump(mode="json")
    assert set(plain["procedure"]) == {
        "grid", "anaesthetic", "biopsy", "complications", "ablation",
    }  # fmt: skip
    own = load_exercise("plan-it-yourself").model_dump(mode="json")
    assert set(own["plan"]) == {"own", "target_mm"}
    asked = load_exercise("lung-biopsy").model_dump(mode="json")
    assert Exercise.model_validate(asked) == load_exercise("lung-biopsy")
