"""An exercise asks for complications, or has nothing of them."""

import pytest
from chest import ENTRY, TARGET, chest

from app.core.errors import AcusError
from app.exercises.library import load_exercise
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.session.complication_case import ComplicationCase
from app.session.scripted_steps import sampling_time

PLACED = PlacedPlan.of(Plan(ENTRY, TARGET, "p"), Placement(), (0.0, 0.16, 0.09))
ASKS = {
    "id": "x",
    "title": "X",
    "tissue": "field",
    "guidance": {"mode": "control_ct"},
    "procedure": {"complications": {}},
}


def changed(**values):
    return Exercise.model_validate({**ASKS, **values})


@pytest.mark.long("journey")
def test_what_is_not_asked_for_is_not_there() -> None:
    plain, with_them = load_exercise("lung-biopsy"), load_exercise("lung-biopsy-complications")
    assert ComplicationCase.of(plain, PLACED, chest()) is None
    assert ComplicationCase.of(load_exercise("kidney"), PLACED, chest()) is None
    assert ComplicationCase.of(with_them, PLACED, None) is None
    assert ComplicationCase.of(with_them, PLACED, chest()) is not None
    assert not {"complication_noticed", "complication_answer"} & set(plain.tolerances)
    assert sampling_time(plain.procedure) < sampling_time(with_them.procedure)


def test_complications_are_seen_in_control_scans_alone() -> None:
    assert changed().procedure.complications.emphysema is None
    with pytest.raises(ValueError, match=r"guidance\.mode: control_ct"):
        changed(guidance={"mode": "live"})
    with pytest.raises(ValueError, match="use tissue: field"):
        changed(tissue="layers")


def test_something_must_be_able_to_happen() -> None:
    nothing = {"complications": {"pneumothorax": False, "bleeding": False}}
    with pytest.raises(ValueError, match="leave complications out"):
        changed(procedure=nothing)


def test_what_cannot_happen_is_not_judged() -> None:
    judged = {"complication_answer": {"expert": 95, "good": 75, "pass": 50, "zero": 0}}
    assert changed(tolerances=judged).tolerances
    with pytest.raises((ValueError, AcusError), match="add complications to procedure"):
        changed(tolerances=judged, procedure={"anaesthetic": {}})
