"""What leaves, ranks or passes is read from sealed rows; what this station did not sign counts
nowhere until the instructor admits it."""

import hashlib
import json
import shutil
import sqlite3
from contextlib import closing
from datetime import UTC, date, datetime
from pathlib import Path

import pytest
from session_fakes import Bench

from app.commands import build
from app.exchange.results import Results, ResultsFormat, results_text
from app.session.admission import admissions, admit
from app.session.board import board_of, standings
from app.session.course import Course, CourseItem, attempts_used, why_not
from app.session.errors import PeopleError
from app.session.index import INDEX, Index, Indexed, totals_of
from app.session.people import PEOPLE, People
from app.session.roster import RosterLine
from app.session.sidecar import sidecar
from app.session.signature import signature_file
from app.session.station import key_file
from app.session.store import computed, list_sessions


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "records"
    monkeypatch.setenv("ACUS_SESSIONS", str(folder))
    people = People()
    for name in ("Ada", "Bob"):
        people.add(RosterLine(name, pin="1843"))
    bench = Bench(folder)
    bench.run(0.1)
    for _ in range(2):
        bench.trainer.begin(people.find("Ada").key)
        bench.run(2.0, 0.06)
        bench.trainer.end()
    Index(folder).refresh()
    return folder


def first(folder: Path) -> Path:
    return min(folder.glob("*.mcap"))


def best(folder: Path, name: str = "Ada") -> float | None:
    people = People()
    board, _ = board_of(folder, people)
    key = people.find(name).key
    return next((cell.best for (who, _), cell in board.cells.items() if who == key), None)


def everything(folder: Path) -> str:
    """Return all that leaves, in every form."""
    people = People()
    board, attempts = board_of(folder, people, now=datetime(2026, 2, 1, tzinfo=UTC))
    known = {person.key: person for person in people.everybody()}
    results = Results(board, attempts, known, people.remarks(), {})
    curves = [board.curve(*place) for place in board.cells]
    return "".join(results_text(results, form) for form in ResultsFormat) + repr(curves)


def tamper(folder: Path, text: str) -> None:
    with closing(sqlite3.connect(folder / INDEX)) as connection:
        connection.execute(text)
        connection.commit()


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "change",
    [
        "total = 99.5, passed = 1, counts = 1",
        "verdict = 'verified', counts = 1, total = 99.5",
        "student = 'p-000000000000'",
        "exercise = 'kidney', version = 7",
        "under = ''",
        'document = replace(document, \'"total":\', \'"total": 99.5, "was":\')',
        "total = 'ninety', counts = 9",
        "started = '2020-01-01T00:00:00+00:00'",
    ],
)
def test_a_row_that_was_edited_is_read_anew_from_its_record(folder: Path, change: str) -> None:
    before = everything(folder)
    tamper(folder, f"UPDATE attempts SET {change}")
    assert everything(folder) == before
    assert Index(folder).attempts() == Index(folder).attempts()


@pytest.mark.long("journey")
def test_a_row_of_another_attempt_or_with_a_seal_of_another_row_is_not_believed(
    folder: Path,
) -> None:
    before = everything(folder)
    one, other = sorted(path.stem for path in folder.glob("*.mcap"))
    tamper(folder, f"UPDATE seals SET seal = (SELECT seal FROM seals WHERE id = '{one}')")
    assert everything(folder) == before
    tamper(folder, "INSERT INTO attempts SELECT 'ghost', size, modified_ns, signed_ns, inode, "
           "signed_inode, station, started, student, exercise, version, state, duration, 100.0, 1, "
           f"verdict, 1, under, document FROM attempts WHERE id = '{other}'")  # fmt: skip
    assert everything(folder) == before


@pytest.mark.long("journey")
def test_a_trigger_in_the_index_changes_nothing(folder: Path) -> None:
    before = everything(folder)
    tamper(folder, "CREATE TRIGGER better AFTER INSERT ON attempts BEGIN "
           "UPDATE attempts SET total = 100.0, passed = 1; END")  # fmt: skip
    first(folder).touch()
    assert everything(folder) == before


@pytest.mark.long("journey")
def test_verify_looks_at_the_index_too(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    name = first(folder).stem
    assert run("session", "verify", name) == 0
    tamper(folder, f"UPDATE attempts SET total = 99.5 WHERE id = '{name}'")
    assert run("session", "verify", name) == 3
    assert "the index was altered: total: 99.5 in the index" in capsys.readouterr().out


def run(*args: str) -> int:
    try:
        build()(args=list(args), prog_name="acus", standalone_mode=False)
    except SystemExit as end:
        return int(end.code or 0)
    return 0


@pytest.mark.long("journey")
@pytest.mark.parametrize("field", ["score", "conditions", "rules"])
def test_a_summary_that_was_edited_with_a_right_plain_digest_is_not_believed(
    folder: Path, field: str
) -> None:
    before = everything(folder)
    for path in folder.glob("*.mcap"):
        document = json.loads(sidecar(path).read_text())
        if field == "conditions":
            document["conditions"]["version"] = 7
        else:
            document["score"] |= {"total": 99.5, "passed": True, "void_reason": ""}
        if field == "rules":
            document["score"]["scoring_version"] = 1
        document.pop("digest")
        text = json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
        document["digest"] = hashlib.sha256(text.encode()).hexdigest()
        sidecar(path).write_text(json.dumps(document))
    (folder / INDEX).unlink()
    assert everything(folder) == before
    assert {one.signature for one in list_sessions(folder)} == {"verified"}


def copied_for(folder: Path, name: str) -> Path:
    """Copy Ada's attempt under another's key, as a student with an editor would."""
    source, key = first(folder), People().find(name).key.encode()
    ada = People().find("Ada").key.encode()
    target = source.with_name("20260116-080000-copied.mcap")
    target.write_bytes(source.read_bytes().replace(ada, key))
    return target


@pytest.mark.long("journey")
def test_a_copy_of_anothers_record_counts_nowhere_until_it_is_admitted(folder: Path) -> None:
    path, people = copied_for(folder, "Bob"), People()
    bob = people.find("Bob")
    item = CourseItem(exercise="liver-01", attempts=1)
    index = Index(folder)
    index.refresh()

    def own() -> list[Indexed]:
        return list(index.attempts([bob.key]))

    (copy,) = index.attempts([bob.key])
    assert (copy.verdict, copy.counts, copy.passed, copy.stands) == ("unsigned", False, None, False)
    assert best(folder, "Bob") is None
    assert attempts_used(own(), item) == []
    assert totals_of(folder, bob.key, "liver-01", 1) == []
    course = Course(id="c", title="C", items=(item,))
    assert why_not(course, "liver-01", own(), date(2026, 2, 1)) == ""
    board, _ = board_of(folder, people)
    assert dict(board.cells[bob.key, "liver-01"].why) == {"not sealed by this station": 1}
    assert {s.id: s.signature for s in computed(folder)}[path.stem] == "unsigned"
    with pytest.raises(PeopleError, match="say why"):
        admit([path], "  ")
    admit([path], "recorded on the laptop that was stolen")
    (copy,) = index.attempts([bob.key])
    assert (copy.verdict, copy.stands) == ("admitted", True)
    assert len(attempts_used(own(), item)) == 1
    assert {s.id: s.signature for s in list_sessions(folder)}[path.stem] == "admitted"
    assert standings(folder, (), bob) == {}


@pytest.mark.long("journey")
def test_an_admission_holds_for_one_record_and_under_its_seal_only(folder: Path) -> None:
    path = copied_for(folder, "Bob")
    admit([path], "a reason")
    index = Index(folder)
    index.refresh()
    bob = People().find("Bob").key
    path.write_bytes(path.read_bytes() + b"x")
    index.refresh()
    assert [one.verdict for one in index.attempts([bob])] == ["unsigned"]
    with closing(sqlite3.connect(People().folder / PEOPLE)) as connection:
        connection.execute("UPDATE admitted SET why = 'because'")
        connection.commit()
    assert admissions() == {}
    with pytest.raises(PeopleError, match="only an unsigned attempt"):
        admit([first(folder)], "twice is better")


@pytest.mark.long("journey")
def test_a_signature_that_was_taken_away_lets_nothing_pass(folder: Path) -> None:
    for path in folder.glob("*.mcap"):
        signature_file(path).unlink()
    index = Index(folder)
    index.refresh()
    assert [(one.counts, one.passed) for one in index.attempts()] == [(False, None)] * 2


@pytest.mark.long("journey")
def test_where_nothing_was_ever_sealed_everything_counts_as_before(folder: Path) -> None:
    shutil.rmtree(key_file().parent)
    index = Index(folder)
    index.refresh()
    assert [(one.verdict, one.stands) for one in index.attempts()] == [("unsigned", True)] * 2
    assert {one.passed for one in index.attempts()} == {True}


@pytest.mark.long("journey")
def test_a_stations_key_that_was_taken_away_lets_nothing_count(folder: Path) -> None:
    People().set_instructor("correct horse battery")
    copied_for(folder, "Bob")
    key_file().unlink()
    index = Index(folder)
    index.refresh()
    assert {(one.counts, one.passed) for one in index.attempts()} == {(False, None)}


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "table", ["CREATE TABLE attempts (id TEXT)", "CREATE VIEW attempts AS SELECT 1 AS id"]
)
def test_rebuild_mends_an_index_with_a_wrong_table(folder: Path, table: str) -> None:
    content = Index(folder).content()
    tamper(folder, "DROP TABLE attempts")
    tamper(folder, table)
    assert Index(folder).rebuild().total == 2
    assert Index(folder).content() == content


@pytest.mark.long("journey")
def test_an_export_says_what_is_signed(folder: Path, tmp_path: Path) -> None:
    copied_for(folder, "Bob")
    assert run("session", "export", "--out", str(tmp_path / "a.csv")) == 0
    head, *rows = (tmp_path / "a.csv").read_text("utf-8-sig").splitlines()
    place = head.split(",").index("signature")
    assert sorted(row.split(",")[place] for row in rows) == ["unsigned", "verified", "verified"]
