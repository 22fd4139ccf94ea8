"""Files of stations: what they hold, what is refused in one line, and what is taken."""

import hashlib
import json
import os
import signal
import zipfile
from pathlib import Path

import pytest
from school_stations import SchoolStation, headed, pool, stored

from app.commands import build
from app.core.files import watched
from app.core.progress import Cancelled, Progress
from app.session.archive import erase_person
from app.session.board import board_of
from app.session.course import courses, find_course
from app.session.errors import SessionError
from app.session.gathering import gather_file
from app.session.people import People
from app.session.results_file import write_course, write_results
from app.session.sidecar import cached, fresh_summary
from app.session.signature import signature_file
from app.session.station import StationKey, key_file
from app.session.stations import renew_key, revoke
from app.session.store import list_sessions, records


@pytest.fixture
def patch() -> pytest.MonkeyPatch:
    with pytest.MonkeyPatch.context() as patch:
        yield patch


@pytest.fixture
def school(tmp_path: Path, patch: pytest.MonkeyPatch) -> list[SchoolStation]:
    """Return two stations that know the head, and the head; the course lies at `course`."""
    head = headed(tmp_path / "head", patch)
    write_course(tmp_path / "course", head.folder)
    some = [SchoolStation(tmp_path / name, name, patch) for name in ("A", "B")]
    for one in some:
        one.enter()
        gather_file(tmp_path / "course", one.folder, trust=True)
    return [*some, head]


def student(number: int = 0) -> str:
    return list(pool()[1])[number]


def results(station: SchoolStation, out: Path) -> Path:
    station.enter()
    write_results(out, station.folder)
    return out


@pytest.mark.long("journey")
def test_results_hold_no_key_no_name_and_no_erased_key(school, tmp_path: Path) -> None:
    one, *_ = school
    one.record(student(0))
    one.record(student(1))
    people = one.enter()
    secret, pseudonym = StationKey.of().secret, people.everybody()[0].pseudonym
    gone = people.find(student(1)).pseudonym
    erase_person(gone, one.folder, delete_records=True)
    out = results(one, tmp_path / "r")
    assert out.stat().st_mode & 0o777 == 0o600
    with zipfile.ZipFile(out) as archive:
        every = b"".join(archive.read(name) for name in archive.namelist())
        manifest = json.loads(archive.read("manifest.json"))
    for text in (secret, secret.hex().encode(), student(1).encode(), gone.encode(), b"Lovelace"):
        assert text not in every
    assert pseudonym.encode() not in every
    assert [len(stone["digest"]) for stone in manifest["tombstones"]] == [64]
    assert len(manifest["files"]) == 3


@pytest.mark.long("journey")
def test_a_course_brings_the_same_keys_and_names_only_if_asked(school, tmp_path: Path) -> None:
    one, two, head = school
    assert {p.key for p in one.enter().everybody()} == set(pool()[1])
    assert [p.name for p in People().everybody(names=True)] == ["", "", ""]
    assert [c.id for c in courses()[0]] == ["autumn"]
    head.enter()
    write_course(tmp_path / "named", head.folder, names=True, pins=True)
    two.enter()
    gather_file(tmp_path / "named", two.folder)
    assert [p.name for p in People().everybody(names=True)] == ["", "", ""]
    gather_file(tmp_path / "named", two.folder, names=True)
    assert {p.name for p in People().everybody(names=True)} == {
        f"{name} Lovelace" for name in ("Ada", "Bob", "Cleo")
    }
    three = SchoolStation(tmp_path / "three", "three", one.patch)
    three.enter()
    gather_file(tmp_path / "named", three.folder, trust=True)
    assert People().sign_in("Ada", "1843").key == student(0)


@pytest.mark.long("journey")
def test_records_of_a_known_station_count_and_the_board_is_that_of_both(
    school, tmp_path: Path
) -> None:
    one, two, _ = school
    one.record(student())
    two.record(student())
    gather_file(results(one, tmp_path / "a"), *at(two), trust=True)
    assert {s.signature for s in list_sessions(two.folder)} == {"verified", "verified (station A)"}
    board, attempts = board_of(two.folder, two.enter(), find_course("autumn"))
    assert len(attempts) == 2
    assert sum(cell.attempts for cell in board.cells.values()) == 2


def at(station: SchoolStation) -> tuple[Path]:
    station.enter()
    return (station.folder,)


@pytest.mark.long("journey")
def test_what_is_beyond_a_limit_is_marked_and_said_and_nothing_is_lost(
    school, tmp_path: Path
) -> None:
    one, two, _ = school
    for station in (one, one, two, two):
        station.record(student())
    done = gather_file(results(one, tmp_path / "a"), *at(two), trust=True)
    assert (done.attempts, done.excess) == (2, 2)
    beyond = {name for name, said in two.enter().remarks().items() if said.excess}
    assert beyond == {"2026-A-0002", "2026-B-0002"}  # the first of each station come first
    board, _ = board_of(two.folder, People(), find_course("autumn"))
    (cell,) = [cell for cell in board.cells.values() if cell.attempts or cell.why]
    assert cell.attempts == 2
    assert dict(cell.why) == {"beyond the attempts that the course allows": 2}
    two.enter().remark("2026-A-0001", void="the needle was bent")
    assert gather_file(tmp_path / "a", two.folder).excess == 1


def test_an_unknown_or_revoked_station_is_refused_in_one_line(school, tmp_path: Path) -> None:
    one, two, _ = school
    one.record(student())
    out = results(one, tmp_path / "a")
    two.enter()
    before = stored(two)
    refused(out, two, "which is not known here")
    gather_file(out, *at(two), trust=True)
    revoke("A")
    refused(out, two, "which the instructor has revoked")
    assert {s.signature for s in list_sessions(two.folder)} == {"revoked (station A)"}
    assert before["attempts"] == {}


def refused(out: Path, station: SchoolStation, why: str, trust: bool = False) -> None:
    """Look that a file is refused in one line that names it, and that nothing of it is here."""
    before = stored(station)
    with pytest.raises(SessionError, match=why) as found:
        gather_file(out, station.folder, trust)
    assert str(out) in str(found.value)
    assert "\n" not in str(found.value)
    assert stored(station) == before
    assert list(station.root.rglob(".gathering*")) == []


def rewritten(source: Path, to: Path, change) -> Path:
    """Copy a file with what its members hold changed by a function of name and bytes."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(to, "w") as new:
        for info in old.infolist():
            data = change(info.filename, old.read(info))
            if data is not None:
                new.writestr(info.filename, data, info.compress_type)
    return to


def in_manifest(**changes):
    def change(name: str, data: bytes) -> bytes:
        return json.dumps(json.loads(data) | changes).encode() if name == "manifest.json" else data

    return change


def turned(data: bytes) -> bytes:
    return data[:100] + bytes((data[100] ^ 1,)) + data[101:]


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda name, data: turned(data) if name.endswith(".mcap") else data, "damaged at records"),
        (lambda name, data: None if name.endswith(".sig") and "rec" in name else data, "damaged"),
        (lambda name, data: turned(data) if name == "manifest.json" else data, "a"),
        (in_manifest(tombstones=[]), "altered after its station signed it"),
        (in_manifest(remarks=[]), "altered after its station signed it"),
        (in_manifest(version=99), "newer version"),
        (in_manifest(format="acus-backup"), "another file of Acus"),
        (lambda name, data: None if name == "manifest.json" else data, "holds no results"),
    ],
)
def test_a_tampered_or_newer_file_is_refused(school, tmp_path: Path, change, why: str) -> None:
    one, *_ = school
    one.record(student())
    one.enter().remark("2026-A-0001", comment="well done")
    erase_person(one.enter().find(student(2)).pseudonym, one.folder, delete_records=True)
    out = results(one, tmp_path / "a")
    other = SchoolStation(tmp_path / "C", "C", one.patch)
    other.enter()
    refused(rewritten(out, tmp_path / "changed", change), other, why, trust=True)
    assert gather_file(out, other.folder, trust=True).attempts == 1


def test_a_file_that_is_cut_or_no_archive_is_refused(school, tmp_path: Path) -> None:
    one, two, _ = school
    one.record(student())
    out = results(one, tmp_path / "a")
    (tmp_path / "cut").write_bytes(out.read_bytes()[: out.stat().st_size // 2])
    (tmp_path / "text").write_text("no archive")
    two.enter()
    for name in ("cut", "text"):
        refused(tmp_path / name, two, "is cut or no file of Acus")
    with pytest.raises(SessionError, match="No such file"):
        gather_file(tmp_path / "none", two.folder)


def test_a_record_that_its_station_did_not_sign_is_not_taken(school, tmp_path: Path) -> None:
    one, two, _ = school
    name = one.record(student())
    two.record(student(1))
    # signed by another station's key, in a file that this station signs
    path = one.folder / f"{name}.mcap"
    out = results(one, tmp_path / "a")
    gather_file(out, *at(two), trust=True)
    for file in (path, signature_file(path)):
        (two.folder / file.name).unlink()
    with zipfile.ZipFile(out) as archive:
        signature = json.loads(archive.read(f"records/{name}.sig"))
    signature["shown"]["total"] = "12.000000"
    refused(resigned(out, tmp_path / "forged", one, signature, name), two, "is forged")


def test_lists_take_the_summary_of_a_station_only_where_it_says_what_was_signed(
    school, tmp_path: Path
) -> None:
    one, two, _ = school
    name = one.record(student())
    out = results(one, tmp_path / "a")
    gather_file(out, *at(two), trust=True)
    path = two.folder / f"{name}.mcap"
    kept = cached(path)
    assert kept.fits(path)
    assert kept.summary.document() == fresh_summary(path).document()
    three = SchoolStation(tmp_path / "three", "three", one.patch)
    with zipfile.ZipFile(out) as archive:
        summary = json.loads(archive.read(f"records/{name}.json"))
    summary["score"]["total"] = 12.0
    forged = resigned(out, tmp_path / "b", one, summary, name, ".json")
    assert gather_file(forged, *at(three), trust=True).attempts == 1
    assert cached(three.folder / f"{name}.mcap") is None
    (listed,) = list_sessions(three.folder)
    assert listed.score["total"] == kept.summary.score["total"]


def resigned(
    out: Path, to: Path, station: SchoolStation, document: dict, name: str, ending: str = ".sig"
) -> Path:
    """Let a station sign a file that holds something else beside a record."""
    station.enter()
    key, data = StationKey.of(), json.dumps(document).encode()
    with zipfile.ZipFile(out) as archive:
        manifest = json.loads(archive.read("manifest.json"))
    manifest["files"][f"records/{name}{ending}"] = hashlib.sha256(data).hexdigest()
    text = json.dumps(manifest).encode()
    seal = key.sign("file", {"manifest": hashlib.sha256(text).hexdigest()})
    new = {f"records/{name}{ending}": data, "manifest.json": text, "manifest.sig": seal.encode()}
    rewritten(out, to, lambda each, old: new.get(each, old))
    return to


def test_the_same_id_with_another_record_stays_and_is_named(school, tmp_path: Path) -> None:
    one, two, _ = school
    name = one.record(student(0))
    mine = two.record(student(1))
    for ending in (".mcap", ".sig", ".json"):
        (two.folder / f"{mine}{ending}").rename(two.folder / f"{name}{ending}")
    before = (two.folder / f"{name}.mcap").read_bytes()
    done = gather_file(results(one, tmp_path / "a"), *at(two), trust=True)
    (line,) = done.different
    assert line.startswith(f"the attempt {name} is another record here: the one here was kept")
    assert (two.folder / f"{name}.mcap").read_bytes() == before


def test_two_people_with_one_pseudonym_are_named_and_neither_is_lost(
    school, tmp_path: Path
) -> None:
    from app.session.roster import RosterLine

    *_, head = school
    three = SchoolStation(tmp_path / "three", "three", head.patch)
    three.enter().add(RosterLine("ada", pin="1843"))
    own = three.enter().find("ada").key
    done = gather_file(tmp_path / "course", three.folder, trust=True)
    assert done.people == 2
    assert len(done.different) == 1
    assert "Ada is somebody else here" in done.different[0]
    assert People().find("Ada").key == own


def test_who_was_left_out_for_a_pseudonym_comes_in_once_the_one_here_has_another(
    school, tmp_path: Path
) -> None:
    from app.session.roster import RosterLine

    *_, head = school
    three = SchoolStation(tmp_path / "three", "three", head.patch)
    three.enter().add(RosterLine("ada", pin="1843"))
    own = three.enter().find("ada").key
    (line,) = gather_file(tmp_path / "course", three.folder, trust=True).different
    assert "(`acus people rename`), then take this in again" in line
    assert run("people", "rename", "ada", "Ada Three") == 0
    done = gather_file(tmp_path / "course", three.folder, trust=True)
    assert (done.people, done.different) == (1, ())
    assert People().find("Ada Three").key == own
    assert People().find("Ada").key == student(0)


@pytest.mark.long("journey")
def test_results_of_another_course_are_taken_and_said_to_count_for_nobody_here(
    school, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from app.session.roster import RosterLine

    one, _, head = school
    for number in range(2):
        one.record(student(number))
    results(one, tmp_path / "a")
    other = SchoolStation(tmp_path / "other", "other", head.patch)
    other.enter().add(RosterLine("Zoe"))
    assert run("store", "gather", str(tmp_path / "a"), "--folder", str(other.folder)) == 3
    refused = capsys.readouterr().out
    assert "✖" in refused
    assert "`acus store stations` there, then gather it with --trust" in refused
    assert not records(other.folder)
    place = ["--trust", "--folder", str(other.folder)]
    assert run("store", "gather", str(tmp_path / "a"), *place) == 0
    said = capsys.readouterr().out
    assert "A: 2 attempts added" in said
    assert "2 attempts are of students who are not known here and count for nobody" in said
    assert "take the course of their station in too" in said
    assert not board_of(other.folder, People())[0].counted
    assert run("store", "gather", str(tmp_path / "course"), *place) == 0
    assert run("store", "gather", str(tmp_path / "a"), *place) == 0
    assert "count for nobody" not in capsys.readouterr().out
    board = board_of(other.folder, People())[0]
    assert [board.cells[student(k), "liver-01"].attempts for k in range(2)] == [1, 1]


@pytest.mark.long("journey")
def test_an_erased_person_and_their_attempts_do_not_come_back(school, tmp_path: Path) -> None:
    one, two, _ = school
    one.record(student())
    two.record(student())
    early = results(two, tmp_path / "early")
    gather_file(early, *at(one), trust=True)
    people = one.enter()
    people.remark("2026-B-0001", comment="well done")
    erase_person(people.find(student()).pseudonym, one.folder, delete_records=True)
    done = gather_file(results(one, tmp_path / "late"), *at(two), trust=True)
    assert done.erased == 1
    for station in (one, two):
        for name in ("early", "late", "course"):
            station.enter()
            gather_file(tmp_path / name, station.folder, trust=True)
        assert records(station.folder) == []
        assert student() not in stored(station)["people"]
        assert People().remarks() == {}


def test_a_renewed_key_is_known_by_the_one_before(school, tmp_path: Path) -> None:
    one, two, _ = school
    one.record(student())
    gather_file(results(one, tmp_path / "a"), *at(two), trust=True)
    one.enter()
    renew_key()
    one.record(student(1))
    assert gather_file(results(one, tmp_path / "b"), *at(two)).attempts == 1
    assert {s.signature for s in list_sessions(two.folder)} == {"verified (station A)"}
    one.enter()
    key_file().unlink()  # another key under another id: nobody signed for it
    StationKey.of()
    refused_later = results(one, tmp_path / "c")
    refused(refused_later, entered(two), "which is not known here")


def entered(station: SchoolStation) -> SchoolStation:
    station.enter()
    return station


def test_cancelling_leaves_nothing_and_the_next_try_takes_all(school, tmp_path: Path) -> None:
    one, two, _ = school
    for _ in range(3):
        one.record(student())
    out = results(one, tmp_path / "a")
    two.enter()
    before = stored(two)
    seen = []

    def listen(fraction: float, _: str) -> None:
        seen.append(fraction)
        if fraction > 0.4:
            progress.cancel()

    progress = Progress(listen)
    with pytest.raises(Cancelled):
        gather_file(out, two.folder, trust=True, progress=progress)
    assert stored(two) == before
    assert list(two.root.rglob(".gathering*")) == []
    assert gather_file(out, two.folder, trust=True).attempts == 3


def killed_before(step: int):
    """Return a watch that kills this program before a step."""
    count = iter(range(step + 1, -1000, -1))

    def watch(*_: object) -> None:
        if next(count) == 1:
            os.kill(os.getpid(), signal.SIGKILL)

    return watch


@pytest.mark.long("journey")
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_kill_at_every_step_takes_all_or_nothing(school, tmp_path: Path) -> None:
    one, two, _ = school
    one.record(student())
    one.enter().remark("2026-A-0001", comment="well done")
    erase_person(one.enter().find(student(2)).pseudonym, one.folder, delete_records=True)
    two.record(student(2))
    out = results(one, tmp_path / "a")
    two.enter()
    before, ends = stored(two), []
    for at_step in range(200):
        child = os.fork()
        if child == 0:
            with watched(killed_before(at_step)):
                gather_file(out, two.folder, trust=True)
            os._exit(0)
        _, status = os.waitpid(child, 0)
        found = stored(entered(two))
        left = [p for p in two.root.rglob(".*") if p.name not in (".trash",)]
        assert left == [], at_step
        ends.append(found == before)
        if not ends[-1]:
            assert set(found["attempts"]) == {"2026-A-0001"}
            assert found["said"] == {("2026-A-0001", "comment"): "well done"}
            assert student(2) not in found["people"]
        if os.WIFEXITED(status):
            break
    assert ends == sorted(ends, reverse=True), "once taken it stays"
    assert ends.count(True) > 5
    assert not ends[-1]


def run(*args: str) -> int:
    try:
        build()(args=list(args), prog_name="acus", standalone_mode=False)
    except SystemExit as end:
        return int(end.code or 0)
    return 0


@pytest.mark.long("journey")
def test_by_command_refused_files_are_named_and_the_others_taken(
    school, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one, two, _ = school
    one.record(student())
    one.enter()
    place = ["--folder", str(one.folder)]
    assert run("store", "results", "--out", str(tmp_path / "a"), "--course", "autumn", *place) == 0
    (tmp_path / "b").write_text("no")
    two.enter()
    place = ["--folder", str(two.folder)]
    assert run("store", "gather", str(tmp_path / "b"), str(tmp_path / "a"), "--trust", *place) == 3
    said = capsys.readouterr().out
    assert "A: 1 attempt added" in said
    assert f"{tmp_path / 'b'} is cut or no file of Acus" in said
    assert run("store", "gather", str(tmp_path / "a"), *place) == 0
    assert run("store", "station", "--out", str(tmp_path / "c"), *place) == 0
    assert "3 students and 1 course written" in capsys.readouterr().out
