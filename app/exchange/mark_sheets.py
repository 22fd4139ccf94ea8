"""Sheets that judges and examiners fill: CSV of estimates by exercise, and of ratings by attempt.

Each is checked whole before anything is made of it; what is wrong is told by file, row, column and
value. Separated by commas, semicolons or tabs; where not by commas, a decimal comma is one.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from app.core.files import read_at_most
from app.core.messages import sentence
from app.exchange.errors import MarkSheetError
from app.session.people_marks import Rating

JUDGE: Final = "judge"
ATTEMPT, RATING, EXAMINER = "attempt", "rating", "examiner"


@dataclass(frozen=True, slots=True)
class AngoffSheet:
    """Estimates of judges.

    Attributes:
        judges: as the sheet names them, in its order.
        estimates: by id of the exercise, points of each judge.
    """

    judges: tuple[str, ...]
    estimates: dict[str, tuple[float, ...]]


@dataclass(frozen=True, slots=True)
class _SheetRow:
    """One row: file and number of its line for messages, and its cells by column."""

    file: str
    line: int
    cells: dict[str, str]

    def error(self, column: str, reason: str) -> MarkSheetError:
        return MarkSheetError(
            sentence(
                "{file}, row {row}, column {column}: {reason}",
                file=self.file,
                row=self.line,
                column=column,
                reason=reason,
            )
        )

    def number(self, column: str, comma: bool, low: float, high: float) -> float:
        """Return a cell as a number.

        Raises:
            MarkSheetError: if it is empty, none, or beyond `low` ... `high`.
        """
        cell = self.cells[column]
        if not cell:
            raise self.error(column, sentence("it is empty: give a number, or leave the row out"))
        try:
            number = float(cell.replace(",", ".") if comma else cell)
        except ValueError:
            number = math.nan
        if not low <= number <= high:
            raise self.error(
                column,
                sentence(
                    "{cell!r} is no number from {low:g} to {high:g}", cell=cell, low=low, high=high
                ),
            )
        return number


def read_angoff(path: Path, exercises: Collection[str]) -> AngoffSheet:
    """Read estimates: a row for each judge, a column for each exercise, points from 0 to 100.

    Args:
        path: the sheet; its first column is `judge`, the others are ids of exercises.
        exercises: ids that there are.

    Raises:
        MarkSheetError: if the sheet cannot be used; says where.
    """
    columns, rows, comma = _table(path, (JUDGE,))
    names = [name for name in columns if name != JUDGE]
    for name in names:
        if name not in exercises:
            raise MarkSheetError(
                sentence(
                    "{file}, row 1, column {column}: there is no such exercise; columns are judge "
                    "and ids as `acus exercise list` has them",
                    file=path.name,
                    column=name,
                )
            )
    judges: list[str] = []
    estimates: dict[str, list[float]] = {name: [] for name in names}
    for row in rows:
        judge = row.cells[JUDGE]
        if not judge:
            raise row.error(JUDGE, sentence("it is empty: name the judge"))
        if judge.casefold() in (other.casefold() for other in judges):
            raise row.error(
                JUDGE, sentence("{judge!r} stands there twice: delete one row", judge=judge)
            )
        judges.append(judge)
        for name in names:
            estimates[name].append(row.number(name, comma, 0.0, 100.0))
    return AngoffSheet(tuple(judges), {name: tuple(own) for name, own in estimates.items()})


def read_ratings(path: Path) -> list[Rating]:
    """Read global ratings: `attempt` (its id), `rating`, and if several rate `examiner`.

    Raises:
        MarkSheetError: if the sheet cannot be used; says where.
    """
    columns, rows, comma = _table(path, (ATTEMPT, RATING), optional=(EXAMINER,))
    ratings, seen = [], set()
    for row in rows:
        attempt, examiner = row.cells[ATTEMPT], row.cells.get(EXAMINER, "")
        if not attempt:
            raise row.error(ATTEMPT, sentence("it is empty: give the attempt's id"))
        if (attempt, examiner.casefold()) in seen:
            raise row.error(
                ATTEMPT,
                sentence(
                    "{attempt!r} is rated twice{hint}",
                    attempt=attempt,
                    hint=""
                    if EXAMINER in columns
                    else sentence(": delete one row, or name who rated in a column examiner"),
                ),
            )
        seen.add((attempt, examiner.casefold()))
        where = sentence("{file}, row {row}, column attempt", file=row.file, row=row.line)
        ratings.append(Rating(attempt, row.number(RATING, comma, 0.0, 100.0), where))
    return ratings


def _table(
    path: Path, needed: Collection[str], optional: Collection[str] | None = None
) -> tuple[list[str], list[_SheetRow], bool]:
    """Return columns and rows of a sheet, and whether a comma in it is a decimal one.

    Args:
        path: the sheet.
        needed: columns that it has to have.
        optional: that it may have as well; None takes any.

    Raises:
        MarkSheetError: if it is no table of these.
    """
    text = _text(path)
    separator = max(",;\t", key=text.split("\n", 1)[0].count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    try:
        table = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader]
    except csv.Error as error:
        raise MarkSheetError(
            sentence(
                "{file}, row {row}: {reason}: save it anew as “CSV UTF-8”",
                file=path.name,
                row=reader.line_num,
                reason=str(error),
            )
        ) from error
    columns = table[0][1] if table else []
    columns = [name.casefold() if name.casefold() in needed else name for name in columns]
    while columns and not columns[-1]:
        columns.pop()  # a separator at the end of each line
    for problem in _heading_problems(path.name, columns, needed, optional):
        raise MarkSheetError(problem)
    rows = []
    for line, cells in table[1:]:
        if not any(cells):
            continue
        if len(cells) < len(columns) or any(cells[len(columns) :]):
            raise MarkSheetError(
                sentence(
                    "{file}, row {row}: {cells} cells, the heading has {columns}",
                    file=path.name,
                    row=line,
                    cells=len(cells),
                    columns=len(columns),
                )
            )
        rows.append(_SheetRow(path.name, line, dict(zip(columns, cells, strict=False))))
    if not rows:
        raise MarkSheetError(sentence("{file} has a heading and no rows: fill it", file=path.name))
    return columns, rows, separator != ","


def _heading_problems(
    file: str, columns: list[str], needed: Collection[str], optional: Collection[str] | None
) -> Iterator[str]:
    for name in needed:
        if name not in columns:
            yield sentence(
                "{file}, row 1: the heading needs the column {column}", file=file, column=name
            )
    for place, name in enumerate(columns):
        if not name or name in columns[:place]:
            yield sentence(
                "{file}, row 1: the heading has {column!r} twice, or no name: name each column "
                "once",
                file=file,
                column=name,
            )
        if optional is not None and name not in (*needed, *optional):
            yield sentence(
                "{file}, row 1, column {column}: it is not known; columns are {columns}",
                file=file,
                column=name,
                columns=", ".join((*needed, *optional)),
            )


def _text(path: Path) -> str:
    try:
        data = read_at_most(path)
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except OSError as error:
        raise MarkSheetError(
            sentence("cannot read {path}: {reason}", path=path, reason=error.strerror or str(error))
        ) from error
    except UnicodeDecodeError as error:
        raise MarkSheetError(
            sentence("{file} is not UTF-8: save it as “CSV UTF-8” and try again", file=path.name)
        ) from error
    if "\0" in text:
        raise MarkSheetError(
            sentence("{file} is no text: save it as “CSV UTF-8” and try again", file=path.name)
        )
    return text
