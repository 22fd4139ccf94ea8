"""What a patient calls for, by fields made by hand, and that no shipped exercise lacks it."""

from typing import Any

import numpy as np
import pytest

from app.compose.physics import calls_of
from app.core.configuration import parse
from app.core.errors import ConfigurationError
from app.exercises.called_for import Call, additions, called_for
from app.exercises.errors import ExerciseError
from app.exercises.library import library, load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.exercises.schema import Exercise
from app.exercises.tissue_choice import Needles
from app.imaging.field.tissue_field import FieldTissue, TissueField, TissueKind

ENTRY = (0.0, -100.0, 300.0)
NAMES = ("unknown", "air", "skin", "fat", "muscle", "organ", "bone", "lung")
CODE = {name: code for code, name in enumerate(NAMES)}
WHOLE = ("lateral_tissue", "shaft_friction", "cutting", "puncture", "relaxation")


def exercise(**changes: Any) -> Exercise:
    """Return an exercise whose path goes straight to the back from the entry."""
    plan = {"entry_mm": ENTRY, "target_mm": (0.0, -40.0, 300.0), "name": "by-hand"}
    document = {"id": "by-hand", "title": "By hand", "plan": plan, "target_organ": "liver"}
    return parse(document | changes, Exercise, "by hand")


def patient(inner: str = "fat", block: tuple[str, slice, slice] | None = None) -> TissueField:
    """Return a flat patient of 1 mm voxels: 2 mm of skin over one tissue, and a block in it.

    Args:
        inner: below the skin.
        block: tissue, and where it lies: depths and millimetres to the left, at all heights.
    """
    nz, ny, nx = 241, 161, 241  # heights, depths from 10 mm above the skin, to the left
    labels = np.full((nz, ny, nx), CODE[inner], np.uint8)
    labels[:, :10] = CODE["air"]
    labels[:, 10:12] = CODE["skin"]
    if block is not None:
        name, depths, lefts = block
        at = slice(10 + depths.start, 10 + depths.stop)
        labels[:, at, slice(120 + lefts.start, 120 + lefts.stop)] = CODE[name]
    affine = np.eye(4)
    affine[:3, 3] = (-120.0, -109.5, 180.0)
    tissues = tuple(FieldTissue(code, TissueKind(name)) for name, code in CODE.items())
    return TissueField(labels, np.full(labels.shape, 20, np.int8), affine, tissues)


def calls(chosen: Exercise, field: TissueField, *simulated: str) -> dict[str, Call]:
    profile = device_of(chosen)
    needles = Needles(field, placed_plan_of(chosen, profile), profile)
    return {one.effect: one for one in called_for(chosen, needles, simulated)}


def test_a_patient_of_fat_alone_is_pierced_cut_and_rubs_and_has_neither_bone_nor_breath() -> None:
    found = calls(exercise(), patient())
    assert set(found) - {"tissue_field"} == set(WHOLE)
    assert all(one.is_absent for one in found.values())


@pytest.mark.long("statistics")
def test_bone_beside_the_path_calls_for_its_contact_at_the_depth_that_geometry_says() -> None:
    field = patient(block=("bone", slice(20, 28), slice(10, 40)))
    # Its nearest edge lies 10 mm beside the path and 20 mm deep: sqrt(10² + 20²) = 22.4 mm.
    reason = calls(exercise(), field)["bone_contact"].reason
    depth = float(reason.split(" at ")[1].split(" mm")[0])
    assert depth == pytest.approx(22.4, abs=1.5)  # the cone is looked at in rings
    assert "meets" in calls(exercise(), field)["tissue_field"].reason


def test_bone_beyond_the_tilt_of_the_machine_calls_for_nothing() -> None:
    # 30 mm beside the path and 28 mm deep at most: 47°; the new joint of the icube turns by 39°.
    field = patient(block=("bone", slice(20, 28), slice(30, 60)))
    assert "bone_contact" not in calls(exercise(), field)


@pytest.mark.long("statistics")
def test_what_breathes_calls_for_the_breath() -> None:
    assert "breathing" in calls(exercise(), patient("organ"))
    lung = calls(exercise(), patient(block=("lung", slice(40, 90), slice(-60, 60))))
    assert "lung" in lung["breathing"].reason
    assert "pleura" in lung["puncture"].reason


@pytest.mark.long("statistics")
def test_a_bevelled_needle_calls_for_its_curve() -> None:
    assert "bevel" not in calls(exercise(), patient())
    assert "bevel" in calls(exercise(needle={"tip": "bevel"}), patient())


@pytest.mark.long("statistics")
def test_a_label_that_is_hardly_sure_calls_for_nothing() -> None:
    field = patient(block=("bone", slice(20, 28), slice(-10, 10)))
    unsure = list(field.tissues)
    unsure[CODE["bone"]] = FieldTissue(CODE["bone"], TissueKind.BONE, confidence=0.4)
    hardly = TissueField(field.labels, field.distance, field.affine_mm, tuple(unsure))
    assert "bone_contact" in calls(exercise(), field)
    assert "bone_contact" not in calls(exercise(), hardly)


def test_what_is_simulated_or_declined_with_a_reason_is_not_absent() -> None:
    field = patient("organ")
    chosen = exercise(without={"breathing": "the patient holds the breath"})
    found = calls(chosen, field, "puncture")
    assert found["puncture"].is_present
    assert not found["breathing"].is_absent
    more = additions(list(found.values()), chosen)
    assert set(more["effects"]) == set(WHOLE) - {"puncture"}


def test_the_breath_that_is_proposed_is_that_of_the_target() -> None:
    chosen = exercise(target_organ="kidney")
    more = additions(list(calls(chosen, patient("organ")).values()), chosen)
    part = more["effects"]["breathing"]
    assert part["organ"] == "kidney"
    # The mean of 39 kidneys is 11.1 mm to the feet (doi 10.1186/2193-1801-3-131).
    assert part["parameters"]["superior_inferior"] == 0.0111


def test_a_reason_for_what_is_not_called_for_is_refused() -> None:
    chosen = exercise(without={"bone_contact": "no rib is near"})
    with pytest.raises(ExerciseError, match="bone_contact is not called for"):
        calls(chosen, patient())


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"without": {"breathing": "  "}}, "without a reason"),
        ({"without": {"breeze": "calm"}}, "no effect is called 'breeze'"),
        ({"without": {"breathing": "x"}, "effects": ["breathing"]}, "asks for it"),
        ({"without": {"tissue_field": "x"}, "tissue": "field"}, "asks for it"),
    ],
)
def test_a_reason_that_says_nothing_is_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ConfigurationError, match=message):
        exercise(**changes)


def test_a_tool_in_a_trocar_calls_for_nothing() -> None:
    found, field = calls_of(load_exercise("laparoscopic-tool"))
    assert found == ()
    assert field is None


FEW = ("kidney", "thick-tissue")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(one.id, marks=() if one.id in FEW else pytest.mark.long("journey"))
        for one in library()
    ],
)
def test_nothing_is_absent_from_a_shipped_exercise_without_a_reason(name: str) -> None:
    found, _ = calls_of(load_exercise(name))
    assert not [one.words for one in found if one.is_absent]


@pytest.mark.long("statistics")
def test_the_exercise_as_it_was_lacked_what_its_patient_calls_for() -> None:
    now = load_exercise("kidney")
    document = now.model_dump(mode="json", by_alias=True)
    before = {"tissue": "layers", "without": {}, "effects": {"lateral_tissue": {}}}
    found, _ = calls_of(Exercise.model_validate(document | before))
    absent = {one.effect for one in found if one.is_absent}
    assert absent >= {"bone_contact", "breathing", "puncture", "tissue_field"}
