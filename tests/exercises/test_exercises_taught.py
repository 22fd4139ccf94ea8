"""Each exercise says which steps of an intervention it teaches: those that it asks for."""

from pathlib import Path
from typing import Any

import pytest
import yaml

from app.exercises.library import library
from app.exercises.schema import Exercise
from app.exercises.taught import NOTHING, STEPS, taught, taught_words

SHIPPED = sorted(Path("resources/exercises").glob("*.yaml"))


def asked_for(written: dict[str, Any]) -> set[str]:
    """Return what the file itself asks for, read without the program's schema."""
    procedure, plan = written.get("procedure") or {}, written.get("plan")
    judged = set(written.get("tolerances") or {})
    found = {name for name in procedure if name in {step for step, _, _ in STEPS}}
    if isinstance(plan, dict) and plan.get("own"):
        found.add("own_path")
    lung = {"emphysema", "fissures", "intercostal", "lung", "pleural_angle", "rib_border"}
    if judged & {f"planned_{name}" for name in lung}:
        found.add("lung_path")
    guidance = written.get("guidance") or {}
    assessed = written.get("purpose") == "assessment"
    if guidance.get("mode", "control_ct" if assessed else "live") == "control_ct":
        found.add("control_scans")
    if "pause_before_pleura" in judged:
        found.add("pause")
    return found


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_a_shipped_exercise_teaches_what_its_file_asks_for(path: Path) -> None:
    written = yaml.safe_load(path.read_text(encoding="utf-8"))
    exercise = next(one for one in library() if one.id == written["id"])
    assert set(taught(exercise)) == asked_for(written)
    assert len(taught_words(exercise)) == max(1, len(taught(exercise)))


def test_the_steps_are_told_in_the_order_in_which_they_are_done() -> None:
    biopsy = next(one for one in library() if one.id == "lung-biopsy")
    assert taught(biopsy)[0] == "checklist"
    assert taught(biopsy)[-1] == "rollover"


def test_an_exercise_without_any_says_so() -> None:
    assert taught_words(Exercise.model_validate({"id": "x", "title": "X"})) == (NOTHING,)
