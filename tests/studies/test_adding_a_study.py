"""A study is added just the way docs/extending.md says: the file on the page, nothing else."""

import re
from pathlib import Path

import pytest

from app import studies
from app.studies.errors import StudyError
from app.studies.runner import find_study, run, study_names

PAGE = Path(__file__).resolve().parents[2] / "docs" / "extending.md"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(studies, "__path__", [*studies.__path__, str(tmp_path)])
    return tmp_path


def test_a_study_is_added_just_the_way_the_page_says(folder: Path) -> None:
    section = PAGE.read_text(encoding="utf-8").split("## How to add a study\n")[1].split("\n## ")[0]
    name = re.search(r"Save this as\s+`[\w/]+/(\w+)\.py`", section)
    code = re.search(r"```python\n(.*?)```", section, re.DOTALL)
    assert name is not None
    assert code is not None
    (folder / f"{name.group(1)}.py").write_text(code.group(1), encoding="utf-8")
    assert name.group(1) in study_names()
    result = run(name.group(1), repeats=1)
    assert result.failures == ()
    assert result.too_coarse() == ("1 terms", "2 terms")


def test_a_file_without_a_study_is_named(folder: Path) -> None:
    (folder / "empty_study.py").write_text("STUDY = 3\n", encoding="utf-8")
    with pytest.raises(StudyError, match=r"empty_study\.py must define STUDY"):
        find_study("empty_study")
