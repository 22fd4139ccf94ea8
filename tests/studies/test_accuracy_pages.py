"""docs/accuracy says what the kept tables say."""

import re

import pytest

from app.studies.kept import kept, kept_names
from tools.accuracy_pages import FOLDER, index, pages


@pytest.mark.parametrize("file", ["index.md", *(f"{name}.md" for name in kept_names())])
def test_a_page_is_what_its_kept_table_says(file):
    assert (FOLDER / file).read_text(encoding="utf-8") == pages()[file], "write it: make accuracy"


def test_no_page_and_no_diagram_is_of_a_study_that_is_not_there():
    names = set(kept_names())
    assert {path.stem for path in FOLDER.glob("*.md")} == {*names, "index", "hard", "published"}
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


def sections(name):
    text = (FOLDER.parent / name).read_text(encoding="utf-8")
    for part in re.split(r"(?m)^## ", text)[1:]:
        title, _, body = part.partition("\n")
        yield title.strip(), body


def test_figures_of_ways_stand_in_docs_accuracy_alone():
    """`docs/studies.md` says what follows; it had times and errors of other measurements beside."""
    names, told = set(kept_names()), []
    for title, body in sections("studies.md"):
        if title not in names:
            continue
        assert f"[The figures](accuracy/{title}.md)" in body.replace("\n", " "), title
        ways = {way.name for way in kept(title).result.study.ways}
        for row in re.findall(r"(?m)^\|(.*)\|$", body):
            cells = [cell.strip().strip("`") for cell in row.split("|")]
            if cells[0] in ways or "time" in cells:
                told.append((title, row))
    assert told == []


def test_a_page_has_every_ways_error_in_every_setting_where_that_is_short():
    page = pages()["contact.md"]
    point = next(p for p in kept("contact").points if p.setting == "1000 N/m")
    (row,) = (line for line in page.splitlines() if line.startswith("| 1000 N/m |"))
    assert f" {point.error:.2g} " in row
