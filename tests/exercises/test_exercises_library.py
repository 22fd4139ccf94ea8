from pathlib import Path

import pytest

from app.core.errors import ConfigurationError
from app.exercises.errors import ExerciseError, UnknownExerciseError
from app.exercises.library import library, load_exercise

SHIPPED = [
    "first-insertion",
    "tensegrity-liver",
    "thick-tissue",
    "with-less-help",
    "breathing-liver",
    "kidney",
    "laparoscopic-tool",
    "hold-the-breath",
    "past-the-vessel",
    "plan-it-yourself",
    "against-repulsion",
    "beside-the-vein",
    "lung-between-ribs",
    "liver-ablation",
    "lung-biopsy",
    "scans-only",
    "lung-biopsy-complications",
]


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    folder = tmp_path / "exercises"
    folder.mkdir()
    return folder


def write(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_the_shipped_exercises_come_in_order_of_their_level(own: Path) -> None:
    known = library()
    assert known.ids() == SHIPPED
    assert known.broken == ()
    levels = [exercise.level for exercise in known]
    assert levels == [1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5, 6, 6, 6, 7]


@pytest.mark.parametrize("name", SHIPPED)
def test_each_shipped_exercise_is_named_as_its_file_and_describes_itself(name: str) -> None:
    exercise = load_exercise(name)
    assert exercise.id == name
    assert exercise.description
    assert any(limits.required for limits in exercise.tolerances.values())


def test_the_users_own_exercises_are_listed_too(own: Path) -> None:
    write(own, "mine.yaml", "id: mine\ntitle: Mine\nlevel: 2\n")
    assert library().ids() == [*SHIPPED[:4], "mine", *SHIPPED[4:]]
    assert load_exercise("mine").title == "Mine"


def test_a_broken_file_is_listed_as_such_and_hides_no_other(own: Path) -> None:
    path = write(own, "broken.yaml", "id: broken\ntitle: [\n")
    known = library()
    assert known.ids() == SHIPPED
    assert [file.path for file in known.broken] == [path]
    assert "not valid YAML" in known.broken[0].reason
    with pytest.raises(ExerciseError, match="not valid YAML"):
        load_exercise("broken")


def test_an_id_that_is_taken_is_reported(own: Path) -> None:
    write(own, "again.yaml", "id: thick-tissue\ntitle: Another\n")
    known = library()
    assert "'thick-tissue' is taken" in known.broken[0].reason
    assert load_exercise("thick-tissue").title == "Thick tissue"


def test_an_exercise_is_loaded_by_path_as_well(tmp_path: Path) -> None:
    path = write(tmp_path, "other.yaml", "id: other\ntitle: Other\n")
    assert load_exercise(path).id == "other"
    assert load_exercise(str(path)).id == "other"


def test_a_name_that_does_not_exist_is_refused_with_the_names_that_do(own: Path) -> None:
    with pytest.raises(UnknownExerciseError, match="no exercise 'lung'; there are first-insertion"):
        load_exercise("lung")


def test_a_file_that_does_not_exist_is_refused_by_path(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match=r"cannot read .*absent.yaml: No such file"):
        load_exercise(tmp_path / "absent.yaml")


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "content",
    [b"\xff\xfe", b"? [1]\n: 2\n", b"id: !!bool x\n", b"seed: " + b"9" * 5000, b"[" * 3000],
)
def test_no_file_however_broken_hides_the_others(own: Path, content: bytes) -> None:
    own.mkdir(parents=True, exist_ok=True)
    (own / "broken.yaml").write_bytes(content)
    (own / "folder.yaml").mkdir()
    found = library()
    assert len(found) == len(SHIPPED)
    assert [item.path.name for item in found.broken] == ["broken.yaml", "folder.yaml"]
