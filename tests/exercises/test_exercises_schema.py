from pathlib import Path

import pytest

from app.core.errors import ConfigurationError
from app.exercises.library import read_exercise
from app.exercises.parts import ViewName
from app.exercises.schema import Exercise
from app.planning.placement import PatientOrientation
from app.scoring.defaults import DEFAULT_TOLERANCES

MINIMAL = "id: mine\ntitle: Mine\n"


def read(tmp_path: Path, text: str) -> Exercise:
    path = tmp_path / "mine.yaml"
    path.write_text(MINIMAL + text, encoding="utf-8")
    return read_exercise(path)


def test_a_name_and_a_title_are_enough(tmp_path: Path) -> None:
    exercise = read(tmp_path, "")
    assert exercise.ct.phantom is not None
    assert exercise.plan == "phantom_default"
    assert exercise.tolerances == dict(DEFAULT_TOLERANCES)
    assert exercise.placement.placement().orientation is PatientOrientation.SUPINE


def test_a_remedy_can_be_asked_for_of_a_folder(tmp_path: Path) -> None:
    plan = "plan: {entry_mm: [0, -90, 300], target_mm: [5, -20, 300]}\n"
    exercise = read(tmp_path, plan + "ct: {folder: chest, remedy: straighten}\n")
    assert exercise.ct.remedy == "straighten"
    assert read(tmp_path, plan + "ct: {folder: chest}\n").ct.remedy == "none"
    with pytest.raises(ConfigurationError, match="remedy goes with folder"):
        read(tmp_path, "ct: {phantom: {seed: 1}, remedy: halve}\n")
    with pytest.raises(ConfigurationError, match="'resample', 'straighten' or 'halve'"):
        read(tmp_path, plan + "ct: {folder: chest, remedy: paint}\n")


def test_structures_lie_beside_the_exercise_or_among_the_users(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = "structures: [{file: a.seg.nrrd, risks: {portal vein: 3}}, {file: b.nii.gz}]\n"
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    (tmp_path / "data" / "structures").mkdir(parents=True)
    (tmp_path / "data" / "structures" / "b.nii.gz").touch()
    first, second = read(tmp_path, text).structures
    assert first.file == tmp_path / "a.seg.nrrd"
    assert dict(first.risks) == {"portal vein": 3.0}
    assert second.file == tmp_path / "data" / "structures" / "b.nii.gz"
    (tmp_path / "b.nii.gz").touch()
    assert read(tmp_path, text).structures[1].file == tmp_path / "b.nii.gz"


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("structures: [{file: a.nrrd, risks: {x: 3}}, {file: b.nrrd, risks: {x: 1}}]", "twice"),
        ("structures: [{file: a.nrrd, risks: {x: -1}}]", "greater than or equal to 0"),
        ("structures: [{file: a.nrrd, risks: {x: 51}}]", "less than or equal to 50"),
        ("structures: [{file: ''}]", "names a file"),
        ("structures: [{risks: {x: 1}}]", "file"),
    ],
)
def test_structures_that_cannot_be_meant_are_refused(tmp_path: Path, text: str, why: str) -> None:
    with pytest.raises(ConfigurationError, match=why):
        read(tmp_path, text + "\n")


def test_everything_can_be_given(tmp_path: Path) -> None:
    exercise = read(
        tmp_path,
        """
version: 3
level: 2
description: All fields.
ct: {folder: chest, series: 1.2.3}
plan: {entry_mm: [0, -90, 300], target_mm: [5, -20, 300], name: liver}
placement: {orientation: left_down, rotation_deg: [0, 10, 0]}
device: icube
joint: old
rig: thesis
assistance: 0.25
effects: {breathing: {organ: liver, model: lujan, parameters: {period: 5}}, lateral_tissue: }
layers: [{name: skin, thickness_mm: 2, side_stiffness_kpa: 50}]
target_organ: liver
tolerances: {angle_error: {expert: 1, good: 2, pass: 3, zero: 9, weight: 2, required: true}}
rules: {pass_mark: 70, minimum_tracking: 50}
views: [force_gauge]
seed: 9
""",
    )
    assert exercise.ct.folder == tmp_path / "chest"
    assert exercise.placement.placement().rotation_deg == (0.0, 10.0, 0.0)
    assert exercise.effects["breathing"].parameters == {"period": 5.0}
    assert exercise.effects["lateral_tissue"].parameters == {}
    assert exercise.layers[0].thickness == pytest.approx(0.002)
    assert exercise.layers[0].side_stiffness == pytest.approx(50e3)
    assert exercise.views == (ViewName.FORCE_GAUGE,)
    assert exercise.tolerances["angle_error"].knots == (1.0, 2.0, 3.0, 9.0)


def test_effects_may_be_a_list_of_names(tmp_path: Path) -> None:
    exercise = read(tmp_path, "effects: [breathing, shaft_friction]\n")
    assert list(exercise.effects) == ["breathing", "shaft_friction"]


def test_force_laws_are_named_bare_with_parameters_or_not_at_all(tmp_path: Path) -> None:
    assert list(read(tmp_path, "").laws) == ["fixture"]
    assert not read(tmp_path, "laws: {}\n").laws
    laws = read(tmp_path, "laws: {fixture: , mine: {parameters: {force: 2}}}\n").laws
    assert laws["fixture"].parameters == {}
    assert laws["mine"].parameters == {"force": 2.0}


def test_an_exercise_survives_being_written_and_read(tmp_path: Path) -> None:
    exercise = read(
        tmp_path, "effects: [breathing]\nplan: {entry_mm: [0, 0, 0], target_mm: [0, 50, 0]}\n"
    )
    assert Exercise.model_validate(exercise.model_dump(mode="json")) == exercise


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("colour: red", r"colour: .*'red'"),
        ("assistance: 1.5", r"assistance: .*less than or equal to 1.*1\.5"),
        ("assistance: -1.01", r"assistance: .*greater than or equal to -1"),
        ("laws: [fixture, fixture]", r"laws: .*named twice"),
        ("laws: {fixture: {stiffness: 3}}", r"laws\.fixture\.stiffness"),
        ("assistance: .nan", r"assistance: .*finite"),
        ("version: 0", "version: .*greater than or equal to 1"),
        ("ct: {}", "ct: .*either phantom: .* or folder"),
        ("ct: {folder: a, phantom: {seed: 1}}", "ct: .*one of the two"),
        ("ct: {folder: a}\nplan: {own: true}", "needs target_mm"),
        ("plan: {own: false}", r"plan\.own"),
        ("plan: {own: true, entry_mm: [0, 0, 0]}", r"plan.*entry_mm"),
        ("ct: {folder: a}", "plan phantom_default needs ct: {phantom"),
        ("ct: {phantom: {seed: -1}}", r"ct\.phantom\.seed"),
        ("plan: {entry_mm: [0, 0, 0], target_mm: [0, 0, 0.2]}", r"plan.*0\.2 mm apart"),
        ("plan: {entry_mm: [0, 0], target_mm: [0, 0, 9]}", r"plan.*entry_mm"),
        ("placement: {orientation: sitting}", "placement.orientation: .*'supine', 'prone'"),
        ("placement: {rotation_deg: [0, 400, 0]}", "placement: .*within ±360"),
        ("device: robo", "mine.yaml: device: 'robo' is not known; valid names are .*icube"),
        ("rig: webcam", "mine.yaml: rig: 'webcam' is not known; valid names are thesis, wide"),
        ("effects: {breathing: {parameters: {period: fast}}}", r"parameters\.period"),
        ("effects: {breathing: {periods: 3}}", r"effects\.breathing\.periods"),
        ("effects: 3", "effects: "),
        ("effects: [{breathing: {}}]", "effects: .*names only"),
        ("effects: [breathing, breathing]", "effects: .*named twice"),
        ("assistance: yes", "assistance: .*number.*True"),
        ('ct: {folder: "a\\0b"}', "ct: .*no path"),
        ("layers: [{name: fat, thickness_mm: -1}]", r"layers\.0\.thickness_mm"),
        ("layers: [{name: fat, thickness_mm: 0}]", r"layers\.0\.thickness_mm"),
        ("layers: [{name: fat, thickness_mm: 5, toughness: -1}]", r"layers\.0\.toughness"),
        ("layers: [{name: a, thickness_mm: 5, relaxation_share: 1}]", r"layers\.0\.relaxation_s"),
        ("layers: [{name: fat, thickness_mm: 5}, {name: skin, thickness_mm: 2}]", "layers: .*skin"),
        (
            "layers: [{name: rib, thickness_mm: 5, rigid: true}, {name: lung, thickness_mm: 9}]",
            "layers: .*'lung' lies below 'rib', which is rigid",
        ),
        ("tolerances: {entry_error: {expert: 1, good: 2, pass: 3}}", "no metric 'entry_error'"),
        ("tolerances: {angle_error: {expert: 3, good: 2, pass: 1}}", "of which lower is better"),
        ("tolerances: {angle_error: {expert: -3, good: 2, pass: 3}}", "finite and 0 or more"),
        ("tolerances: {angle_error: {expert: 1, good: 2, pass: 1.0e+308}}", "finite and 0 or more"),
        ("tolerances: {angle_error: {expert: 1, good: 2, pass: 3, weight: 1.0e+308}}", "weight"),
        ("tolerances: {angle_error: {expert: 1, good: 2}}", r"tolerances\.angle_error\.pass"),
        ("tolerances: {angle_error: {expert: 1, good: 2, pass: 3, weight: 0}}", "a weight above 0"),
        ("views: [xray]", r"views\.0: .*'live_overlay', 'bullseye'"),
    ],
)
def test_what_is_wrong_is_named_with_file_field_and_valid_values(
    tmp_path: Path, text: str, message: str
) -> None:
    with pytest.raises(ConfigurationError, match=message) as caught:
        read(tmp_path, text + "\n")
    assert "mine.yaml" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["", "Big", "a b", "-a", "a--b", "../a", "a" * 65])
def test_an_id_that_is_no_file_name_is_refused(tmp_path: Path, name: str) -> None:
    path = tmp_path / "x.yaml"
    path.write_text(f"id: {name!r}\ntitle: X\n", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="id: "):
        read_exercise(path)


def test_a_key_that_is_given_twice_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="given twice"):
        read(tmp_path, "seed: 1\nseed: 2\n")


def test_an_exercise_is_frozen(tmp_path: Path) -> None:
    exercise = read(tmp_path, "")
    with pytest.raises(ValueError, match="frozen"):
        exercise.seed = 3  # type: ignore[misc]


def test_a_plan_is_judged_only_where_the_student_makes_it(tmp_path: Path) -> None:
    judged = "tolerances:\n  plan_score: {expert: 75, good: 65, pass: 50}\n"
    with pytest.raises(ConfigurationError, match="own: true"):
        read(tmp_path, judged)
    own = read(tmp_path, judged + "plan: {own: true}\n")
    assert own.needs_field, "else nothing could tell what lies on the path"
    assert not read(tmp_path, "").needs_field
