"""docs/exercises.md says what the program does."""

import re
from pathlib import Path

import pytest

from app.exercises.guidance import GuidancePart
from app.exercises.parts import EffectPart, LawPart, LayerPart, PlacementPart, ViewName
from app.exercises.procedure import ProcedurePart
from app.exercises.reading import ReadingPart
from app.exercises.schema import Exercise
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.metrics import available
from app.scoring.rows import ScoreRules
from app.simulation.effects import effect_names

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "exercises.md").read_text(encoding="utf-8")


def first_cells(heading: str) -> set[str]:
    """Names in back quotes in the first column of the tables under a heading."""
    section = re.split(r"\n##+ ", PAGE.split(heading)[1])[0]
    rows = [line.split("|")[1] for line in section.splitlines() if line.startswith("|")]
    return {name for cell in rows for name in re.findall(r"`([^`]+)`", cell)}


def test_every_field_of_the_file_is_explained_and_no_other() -> None:
    explained = {name.split(".")[0] for name in first_cells("## The file, field by field")}
    assert explained == set(Exercise.model_fields)
    nested = {name for name in first_cells("## The file, field by field") if "." in name}
    fields = {f"placement.{name}" for name in PlacementPart.model_fields}
    fields |= {f"guidance.{name}" for name in GuidancePart.model_fields}
    fields |= {f"reading.{name}" for name in ReadingPart.model_fields}
    fields |= {f"procedure.{name}" for name in ProcedurePart.model_fields}
    assert nested == fields | {f"rules.{name}" for name in ScoreRules.model_fields}


@pytest.mark.parametrize("model", [LayerPart, EffectPart, LawPart])
def test_the_fields_of_layers_and_effects_are_named(model: type) -> None:
    for name in model.model_fields:  # type: ignore[attr-defined]
        assert name in PAGE


def test_every_view_and_effect_is_named() -> None:
    assert all(f"`{view.value}`" in PAGE for view in ViewName)
    assert first_cells("### Effects") <= set(effect_names())


def test_every_force_law_is_explained() -> None:
    from app.device.control.laws import law_names

    assert first_cells("### Force laws") == set(law_names())


def test_every_metric_is_defined_and_no_other() -> None:
    assert first_cells("### Metrics") == set(available())


def test_the_default_tolerances_are_those_of_the_page() -> None:
    for name, limits in DEFAULT_TOLERANCES.items():
        numbers = " \\| ".join(rf"{knot:g}\S*( \w+)?" for knot in limits.knots[:3])
        required = "yes" if limits.required else "no"
        assert re.search(rf"`{name}` \| {numbers} \| {limits.weight:g} \| {required} \|", PAGE)


def test_the_shortest_exercise_of_the_page_is_one(tmp_path: Path) -> None:
    from app.exercises.library import read_exercise

    block = re.search(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    assert block is not None
    path = tmp_path / "mine.yaml"
    path.write_text(block.group(1), encoding="utf-8")
    assert read_exercise(path).id == "first-insertion"
