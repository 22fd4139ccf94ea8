"""A study is added just the way docs/extending.md says: the file on the page, nothing else."""

from pathlib import Path

import pytest
from extending_page import example

from app import studies
from app.studies.errors import StudyError
from app.studies.runner import declaration, find_study, run, study_names


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(studies, "__path__", [*studies.__path__, str(tmp_path)])
    return tmp_path


def works_as_the_page_says(folder: Path, name: str, code: str) -> None:
    (folder / name).write_text(code, encoding="utf-8")
    name = Path(name).stem
    assert name in study_names()
    assert declaration(name).question == "How many terms are enough?"
    result = run(name, repeats=1)
    assert result.failures == ()
    assert result.too_coarse() == ("1 terms", "2 terms")
    said = (result.study.name, result.study.title, result.study.reference)
    assert said == ("sine_series", "Sine by its series", "math.sin, 1e-16")


@pytest.mark.long("statistics")
def test_a_study_is_added_just_the_way_the_page_says(folder: Path) -> None:
    works_as_the_page_says(folder, *example("How to add a study"))


@pytest.mark.long("statistics")
def test_a_study_in_the_users_own_folder_is_found_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_STUDIES", str(tmp_path))
    works_as_the_page_says(tmp_path, *example("How to add a study"))


@pytest.mark.long("statistics")
def test_a_file_without_a_study_is_named(folder: Path) -> None:
    (folder / "empty_study.py").write_text("STUDY = 3\n", encoding="utf-8")
    with pytest.raises(StudyError, match=r"empty_study\.py has no DECLARATION"):
        find_study("empty_study")
    declared = example("How to add a study")[1].split("STUDY")[0] + "STUDY = 3\n"
    (folder / "empty_study.py").write_text(declared, encoding="utf-8")
    with pytest.raises(StudyError, match=r"empty_study\.py must define STUDY"):
        find_study("empty_study")
