"""Sheets of judges and examiners: what is read, and what is refused by row, column and value."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.exchange.errors import MarkSheetError
from app.exchange.mark_sheets import read_angoff, read_ratings

EXERCISES = {"ribs", "kidney"}


def sheet(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    path = folder / "sheet.csv"
    path.write_bytes(text.encode(encoding))
    return path


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_estimates_are_read_by_exercise_as_spreadsheets_write_them(
    tmp_path: Path, separator: str, encoding: str
) -> None:
    text = "Judge,ribs,kidney\nA,65,50\n\nÉ,70,55.5\n".replace(",", separator)
    read = read_angoff(sheet(tmp_path, text, encoding), EXERCISES)
    assert read.judges == ("A", "É")
    assert read.estimates == {"ribs": (65.0, 70.0), "kidney": (50.0, 55.5)}


def test_decimal_commas_are_read_where_semicolons_separate(tmp_path: Path) -> None:
    read = read_angoff(sheet(tmp_path, "judge;ribs\nA;62,5\n"), EXERCISES)
    assert read.estimates == {"ribs": (62.5,)}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("judge,ribs\nA,650\n", "sheet.csv, row 2, column ribs: '650' is no number from 0 to 100"),
        ("judge,ribs\nA,nan\n", "row 2, column ribs: 'nan' is no number"),
        ("judge,ribs\nA,6O\n", "row 2, column ribs: '6O' is no number"),
        ("judge,ribs,kidney\nA,60,\n", "row 2, column kidney: it is empty"),
        ("judge,ribs\nA,60\na,61\n", "row 3, column judge: 'a' stands there twice"),
        ("judge,ribs\n,60\n", "row 2, column judge: it is empty: name the judge"),
        ("judge,rib\nA,60\n", "row 1, column rib: there is no such exercise"),
        ("judge,ribs,ribs\nA,1,2\n", "'ribs' twice"),
        ("rater,ribs\nA,60\n", "the heading needs the column judge"),
        ("judge,ribs\nA\n", "row 2: 1 cells, the heading has 2"),
        ("judge,ribs\nA,60,70\n", "row 2: 3 cells, the heading has 2"),
        ("judge,ribs\n", "no rows"),
        ("", "the heading needs the column judge"),
        ("judge,ribs\nA,\0\n", "is no text"),
    ],
)
def test_an_estimate_that_cannot_be_is_told_by_row_column_and_value(
    tmp_path: Path, text: str, message: str
) -> None:
    with pytest.raises(MarkSheetError, match=message):
        read_angoff(sheet(tmp_path, text), EXERCISES)


def test_ratings_are_read_with_where_they_stand(tmp_path: Path) -> None:
    text = "attempt,rating,examiner\na1,2,X\na1,3,Y\na2,5,X\n"
    read = read_ratings(sheet(tmp_path, text))
    assert [(one.attempt, one.rating) for one in read] == [("a1", 2.0), ("a1", 3.0), ("a2", 5.0)]
    assert read[1].where == "sheet.csv, row 3, column attempt"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("attempt,rating\na1,\n", "row 2, column rating: it is empty"),
        ("attempt,rating\na1,good\n", "row 2, column rating: 'good' is no number"),
        ("attempt,rating\n,2\n", "row 2, column attempt: it is empty"),
        ("attempt,rating\na1,2\na1,3\n", "rated twice: delete one row, or name who rated"),
        ("attempt,rating,examiner\na1,2,X\na1,3,x\n", "row 3, column attempt: 'a1' is rated twice"),
        ("attempt,rating,note\na1,2,x\n", "column note: it is not known"),
    ],
)
def test_a_rating_that_cannot_be_is_told_by_row_column_and_value(
    tmp_path: Path, text: str, message: str
) -> None:
    with pytest.raises(MarkSheetError, match=message):
        read_ratings(sheet(tmp_path, text))


def test_a_sheet_that_is_not_there_or_no_utf_8_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MarkSheetError, match="cannot read"):
        read_ratings(tmp_path / "none.csv")
    with pytest.raises(MarkSheetError, match="not UTF-8"):
        read_angoff(sheet(tmp_path, "judge,ribs\nÉ,1\n", "latin-1"), EXERCISES)


@settings(deadline=None, max_examples=200, derandomize=True)
@given(st.binary(max_size=80), st.booleans())
def test_any_bytes_are_a_sheet_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: bytes, headed: bool
) -> None:
    path = tmp_path_factory.mktemp("any") / "sheet.csv"
    path.write_bytes((b"judge,ribs\n" if headed else b"") + data)
    try:
        read = read_angoff(path, EXERCISES)
    except MarkSheetError:
        return
    assert all(0.0 <= one <= 100.0 for own in read.estimates.values() for one in own)
