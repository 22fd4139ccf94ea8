"""docs/accuracy says what the kept tables say."""

import pytest

from app.studies.kept import kept, kept_names
from tools.accuracy_pages import FOLDER, index, pages


@pytest.mark.parametrize("file", ["index.md", *(f"{name}.md" for name in kept_names())])
def test_a_page_is_what_its_kept_table_says(file):
    assert (FOLDER / file).read_text(encoding="utf-8") == pages()[file], "write it: make accuracy"


def test_no_page_and_no_diagram_is_of_a_study_that_is_not_there():
    names = set(kept_names())
    assert {path.stem for path in FOLDER.glob("*.md")} == {*names, "index", "hard"}
    assert {path.stem for path in FOLDER.glob("*.svg")} == names


def test_the_index_has_a_row_for_each_study_with_its_default_and_its_exception():
    rows = [line for line in index().splitlines() if line.startswith("| [")]
    assert len(rows) == len(kept_names())
    for name, row in zip(kept_names(), rows, strict=True):
        assert f"`{kept(name).default}`" in row
        assert row.endswith(f"| {kept(name).exception or '-'} |".replace("|", "|"))


def test_a_diagram_shows_every_family_of_ways_and_both_limits():
    for name in kept_names():
        study, text = kept(name).result.study, (FOLDER / f"{name}.svg").read_text(encoding="utf-8")
        for family in {way.family for way in study.ways}:
            measured = any(point.family == family for point in kept(name).points)
            assert not measured or family.replace("&", "&amp;") in text, (name, family)
