"""The board by columns is the board that one gets one attempt after the other; pages of the index
say what its rows say, and nothing that this station did not seal.

The plain board below is written from what `docs/people.md` says of it: each attempt by itself, each
pair of conditions asked of `comparable`, slopes by hand.
"""

import sqlite3
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import pytest
from session_fakes import Bench
from test_session_course import attempt

from app.scoring.conditions import DeviceKind, comparable
from app.session import index as indexes
from app.session import index_pages
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.index import INDEX, Index, Indexed
from app.session.people import Person, Remarks
from app.session.store import delete

NOW = datetime(2026, 11, 20, 12, tzinfo=UTC)
PEOPLE = [Person(f"p-{k}", f"P{k}", ()) for k in range(5)]
ITEMS = [
    CourseItem(exercise="lung"),
    CourseItem(exercise="liver", version=2),
    CourseItem(exercise="kidney"),
]


def random_attempts(seed: int, number: int) -> list[Indexed]:
    rng = np.random.default_rng(seed)

    def any_of(*values: Any) -> Any:
        return values[rng.integers(len(values))]

    found = []
    for k in range(number):
        one = attempt(
            f"a-{k:03d}",
            any_of(*(one.key for one in PEOPLE[:4]), "nobody"),
            any_of(None, *(float(n) for n in range(40, 100, 7))),
            exercise=any_of("lung", "liver", "kidney", "spine"),
            version=any_of(1, 1, 2),
            verdict=any_of(*["verified"] * 6, "unsigned", "altered", "verified (station B)"),
            dial=any_of(0.5, 0.5, float(rng.uniform(0.0, 1.0)), float(rng.uniform(0.4, 0.6))),
            views=any_of(*[("axial",)] * 6, ("3d", "axial"), None),
            hand=any_of(*["mouse"] * 6, "robot", "arm"),
            kind=any_of(*[DeviceKind.SIMULATED] * 5, DeviceKind.EMULATED, DeviceKind.UNKNOWN),
            drill=any_of("", "", "", "aim"),
            seed=any_of(None, k),
            ct=any_of("", *["ct-1"] * 8, "ct-2"),
            level=any_of(*[0] * 8, 1, 2),
        )
        one = replace(one, started=(NOW - timedelta(hours=number - k)).isoformat())
        stands = one.verdict.startswith("verified")
        counts = one.counts and stands and one.conditions.by_person and not one.conditions.drill
        found.append(
            replace(one, stands=stands, counts=counts, passed=one.passed if stands else None)
        )
    return found


def why_not(one: Indexed, item: CourseItem, said: Remarks | None, held: set[str]) -> str:
    made = one.conditions
    if one.id in held:
        return "not released yet"
    if one.verdict == "altered":
        return "altered after it was signed"
    if said is not None and said.void:
        return "declared void by the instructor"
    if said is not None and said.excess:
        return "beyond the attempts that the course allows"
    if not one.stands:
        return "not sealed by this station"
    if not one.counts:
        if made.scripted or made.hand == "arm":
            return "carried out by the arm"
        if made.drill:
            return "a drill"
        return "emulated robot" if made.kind == "emulated" else "not scored or void"
    return "" if one.version == item.version else f"version {one.version} of the exercise"


def plain(some: list[Indexed], remarks: dict[str, Remarks], held: set[str]) -> dict[Any, Any]:
    """Return ids that count, trend and reasons for each cell, one attempt after the other."""
    cells: dict[Any, Any] = {(p.key, i.exercise): ([], {}) for p in PEOPLE for i in ITEMS}
    for item in ITEMS:
        mine = [one for one in some if (one.student, one.exercise) in cells]
        mine = [one for one in mine if one.exercise == item.exercise]
        why = {one.id: why_not(one, item, remarks.get(one.id), held) for one in mine}
        groups: list[list[Indexed]] = []
        for one in mine:
            if why[one.id]:
                continue
            for group in groups:
                alike = replace(one.conditions, seed=None) == replace(
                    group[0].conditions, seed=None
                )
                if alike or not comparable(group[0].conditions, one.conditions):
                    group.append(one)
                    break
            else:
                groups.append([one])
        most = max(groups, key=lambda group: (len(group), group[-1].started), default=[])
        for one in mine:
            counted, left = cells[one.student, item.exercise]
            if not why[one.id] and one in most:
                counted.append(one)
            else:
                reason = why[one.id] or "made under other conditions than most"
                left[reason] = left.get(reason, 0) + 1
    return cells


def trend_of(totals: list[float]) -> float | None:
    last = totals[-8:]
    slopes = [(y - x) / (b - a) for a, x in enumerate(last) for b, y in enumerate(last) if b > a]
    return median(slopes) if len(last) >= 3 else None


@pytest.mark.long("journey")
@pytest.mark.parametrize("seed", range(8))
def test_the_board_by_columns_is_that_of_one_attempt_after_the_other(seed: int) -> None:
    some = random_attempts(seed, 1000)
    remarks = {
        one.id: Remarks(
            "said", "slipped" if k % 3 == 0 else "", True, "beyond" if k % 3 == 1 else ""
        )
        for k, one in enumerate(some[::17])
    }
    held = {one.id for one in some[5::23]}
    board = progress_board(PEOPLE, ITEMS, some, remarks, NOW, held)
    expected = plain(some, remarks, held)
    assert sum(len(counted) for counted, _ in expected.values()) > 20
    assert set(board.cells) == set(expected)
    for place, (counted, left) in expected.items():
        cell, totals = board.cells[place], [one.total or 0.0 for one in counted]
        assert list(board.counted.get(place, ())) == counted
        assert (cell.attempts, cell.others, dict(cell.why)) == (
            len(counted), sum(left.values()), left,
        )  # fmt: skip
        assert cell.best == max(totals, default=None)
        assert cell.last == (totals[-1] if totals else None)
        assert cell.trend == trend_of(totals)
        assert cell.passed == any(one.passed for one in counted)
        assert cell.since == (NOW - counted[-1].time if counted else None)
        mine = [one for one in some if (one.student, one.exercise) == place]
        told = [remarks[one.id].void for one in mine if one.id in remarks and remarks[one.id].void]
        assert list(cell.void) == told


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder of seven records, of which six are in pages of two."""
    bench = Bench(tmp_path / "records")
    bench.run(0.1)
    for number in range(7):
        bench.trainer.begin(f"s-{number % 2}")
        bench.run(0.4, 0.03)
        bench.trainer.end()
    Index(tmp_path / "records").refresh()
    loose = list(Index(tmp_path / "records").attempts())
    for module in (indexes, index_pages):
        monkeypatch.setattr(module, "PAGE", 2)
    (tmp_path / "records" / INDEX).unlink()
    Index(tmp_path / "records").refresh()
    assert count(tmp_path / "records") == 3
    assert list(Index(tmp_path / "records").attempts()) == loose
    return tmp_path / "records"


def count(folder: Path) -> int:
    return int(do(folder, "SELECT count(*) FROM pages")[0][0])


def do(folder: Path, text: str) -> list[Any]:
    with closing(sqlite3.connect(folder / INDEX)) as connection:
        found = connection.execute(text).fetchall()
        connection.commit()
    return found


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "change",
    [
        "UPDATE pages SET body = replace(body, '\"s-0\"', '\"s-9\"')",
        "UPDATE pages SET body = '{'",
        "UPDATE pages SET seal = ''",
        "UPDATE pages SET number = number + 1",
        "UPDATE seals SET page = NULL",
        "UPDATE seals SET page = 7",
        "DELETE FROM pages",
        "DELETE FROM attempts",
        "UPDATE attempts SET total = 99.0, document = '{}'",
    ],
)
def test_pages_and_rows_that_were_edited_change_nothing(folder: Path, change: str) -> None:
    before = list(Index(folder).attempts())
    said = [(one.summary, one.conditions) for one in before]
    do(folder, change)
    index = Index(folder)
    index.refresh()
    assert sorted(index.attempts(), key=lambda one: one.id) == before
    assert [(one.summary, one.conditions) for one in index.attempts()] == said


@pytest.mark.long("journey")
def test_what_goes_comes_or_is_written_anew_leaves_its_page(folder: Path) -> None:
    index, before = Index(folder), list(Index(folder).attempts())
    delete(folder, before[0].id)
    other = sorted(folder.glob("*.mcap"))[3]
    other.write_bytes(other.read_bytes() + b"\0")
    seen = index.refresh()
    assert (seen.gone, seen.read, seen.total) == (1, 1, 6)
    assert [one.id for one in index.attempts()] == [one.id for one in before[1:]]
    rebuilt = Index(folder)
    rebuilt.rebuild()
    assert list(rebuilt.attempts()) == list(index.attempts())


@pytest.mark.long("journey")
def test_a_page_that_is_put_back_brings_no_attempt_back(folder: Path) -> None:
    gone = Index(folder).attempts()[0].id
    (kept,) = do(folder, f"SELECT number, body, seal FROM pages WHERE body LIKE '%{gone}%'")
    delete(folder, gone)
    Index(folder).refresh()
    with closing(sqlite3.connect(folder / INDEX)) as connection:
        connection.execute("INSERT INTO pages (number, body, seal) VALUES (?, ?, ?)", kept)
        connection.commit()
    index = Index(folder)
    index.refresh()
    assert gone not in {one.id for one in index.attempts()}
    assert len({one.id for one in index.attempts()}) == len(index.attempts()) == 6


@pytest.mark.long("journey")
def test_beyond_so_many_records_some_are_looked_at_each_time(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(indexes, "LOOKED_AT", 2)
    one = sorted(folder.glob("*.mcap"))[3]
    one.write_bytes(one.read_bytes() + b"\0")  # where it lies: no name and no inode changes
    index = Index(folder)
    assert sum(index.refresh().read for _ in range(60)) == 1
