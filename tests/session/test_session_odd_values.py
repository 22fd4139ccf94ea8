"""Databases that hold values of another kind: lists, board and signing in go on, in one line."""

import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from session_fakes import Bench

from app.core.errors import AcusError
from app.core.paths import sessions
from app.session.access import Known
from app.session.admission import admissions
from app.session.board import board_of
from app.session.course import held_back
from app.session.index import INDEX, Index
from app.session.people import PEOPLE, People
from app.session.roster import RosterLine
from app.session.station import key_file
from app.session.store import list_sessions

VALUES = {"bytes": b"\xff\xfe\x00", "no UTF-8": "CAST(X'C3' AS TEXT)"}


def columns(path: Path) -> list[tuple[str, str]]:
    with closing(sqlite3.connect(path)) as there:
        tables = [
            row[0] for row in there.execute("SELECT name FROM sqlite_master WHERE type = 'table'")
        ]
        return [
            (table, row[1])
            for table in tables
            for row in there.execute(f"PRAGMA table_info({table})")
        ]


def put(path: Path, table: str, column: str, value: object) -> bool:
    """Put a value into every row of a column; False where another value must stand there."""
    with closing(sqlite3.connect(path)) as there:
        try:
            if isinstance(value, str) and value.startswith("CAST"):
                there.execute(f"UPDATE {table} SET {column} = {value}")
            else:
                there.execute(f"UPDATE {table} SET {column} = ?", (value,))
        except sqlite3.IntegrityError:
            return False
        there.commit()
    return True


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """A station with a student, a course's remark and two attempts, to be copied."""
    folder = tmp_path_factory.mktemp("station")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ACUS_DATA", str(folder / "data"))
        patch.setenv("ACUS_SESSIONS", str(folder / "sessions"))
        people = People()
        ada, _ = people.add(RosterLine("Ada", "Lovelace", "1843", ("A",)))
        people.set_instructor("correct horse")
        sessions().mkdir(parents=True)
        bench = Bench(sessions())
        bench.run(0.1)
        for student in (ada.key, "typed"):
            bench.trainer.begin(student)
            bench.insertion()
            bench.trainer.end()
        people.remark(next(sessions().glob("*.mcap")).stem, comment="x", released=True)
        with pytest.raises(AcusError):
            people.sign_in("Ada", "0000")
        Index(sessions()).refresh()
        people.database.close()
    return folder


def works(file: str) -> list[Callable[[], object]]:
    """What the window and the commands read."""
    reading: list[Callable[[], object]] = [
        lambda: list_sessions(sessions()),
        lambda: board_of(sessions(), People()),
        lambda: [one.summary for one in Index(sessions()).attempts()],
    ]
    if file == INDEX:
        return reading
    return [
        *reading,
        lambda: People().everybody(names=True),
        lambda: Known.of(People()),
        lambda: People().sign_in("Ada", "1843"),
        lambda: People().check_instructor("correct horse"),
        lambda: held_back([("a", "typed", "x", 1)]),
        lambda: (People().remarks(), admissions(), People().erased()),
    ]


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("file", "sealed", "kind"),
    [
        (PEOPLE, True, "bytes"),
        (PEOPLE, True, "no UTF-8"),
        (INDEX, True, "bytes"),
        (INDEX, False, "bytes"),
        (INDEX, False, "no UTF-8"),
    ],
)
def test_no_value_of_a_database_ends_the_program(kept, tmp_path, monkeypatch, file, kind, sealed):
    folder, odd = "data/people" if file == PEOPLE else "sessions", []
    for table, column in columns(kept / folder / file):
        here = tmp_path / f"{table}-{column}"
        shutil.copytree(kept, here)
        monkeypatch.setenv("ACUS_DATA", str(here / "data"))
        monkeypatch.setenv("ACUS_SESSIONS", str(here / "sessions"))
        if not sealed:
            key_file().unlink()
        if not put(here / folder / file, table, column, VALUES[kind]):
            continue
        for work in works(file):
            try:
                work()
            except AcusError as error:
                odd += [f"{table}.{column}: {error}"] if "\n" in str(error) else []
            except Exception as error:
                odd.append(f"{table}.{column}: {type(error).__name__}: {error}")
    assert odd == []
