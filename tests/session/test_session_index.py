"""The index of attempts and their signatures: made anew equal, nothing lost to a kill."""

import base64
import hashlib
import os
import random
import shutil
import signal
import sqlite3
import stat
import subprocess
import sys
import time
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest
from cryptography.hazmat.primitives.ciphers import Cipher
from cryptography.hazmat.primitives.ciphers.algorithms import AES256
from cryptography.hazmat.primitives.ciphers.modes import GCM
from session_fakes import Bench

from app.core.progress import Cancelled, Progress
from app.scoring.conditions import Conditions
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.database import DatabaseError
from app.session.index import INDEX, Index
from app.session.index_records import listing
from app.session.people import Person
from app.session.recording import read_recording
from app.session.sidecar import file_digest, read_kept, sidecar, write_summary
from app.session.signature import Signed, judge_whole, signature_file, signed
from app.session.station import SignatureError, StationKey, key_file, new_recovery_key, this_station
from app.session.store import delete, list_sessions, restore
from app.session.summary import Summary

NOON = datetime(2026, 11, 20, 12, tzinfo=UTC)

KILLS = int(os.environ.get("ACUS_KILLS", "20"))
"""So many programs are killed; 200 are for a long run."""

AT_ONCE = 4


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    bench = Bench(tmp_path / "records")
    bench.run(0.1)
    for name in ("s-1", "s-2", "s-1"):
        bench.trainer.begin(name)
        bench.run(0.6, 0.03)
        bench.trainer.end()
    return tmp_path / "records"


def first(folder: Path) -> Path:
    return min(folder.glob("*.mcap"))


# --- signatures -----------------------------------------------------------------------------------
def test_a_finished_attempt_is_signed_and_verified(folder: Path) -> None:
    assert {s.signature for s in list_sessions(folder)} == {"verified"}
    for path in folder.glob("*.mcap"):
        assert judge_whole(path, this_station()).verdict is Signed.VERIFIED
    assert stat.S_IMODE(key_file().stat().st_mode) == 0o600


def test_a_record_without_a_signature_is_unsigned_and_as_readable_as_before(folder: Path) -> None:
    path = first(folder)
    before = read_kept(path).summary
    signature_file(path).unlink()
    found = {s.id: s for s in list_sessions(folder)}[path.stem]
    assert found.signature == "unsigned"
    assert found == before
    assert Index(folder).refresh().total == 3


def test_a_byte_of_the_record_that_changed_is_found(folder: Path) -> None:
    path = first(folder)
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(bytes(data))
    assert judge_whole(path, this_station()).verdict is Signed.ALTERED
    found = {s.id: s for s in list_sessions(folder)}[path.stem]
    assert found.signature == "altered"
    assert any("altered after it was signed" in problem for problem in found.problems)


def test_a_better_score_written_into_the_list_is_found(folder: Path) -> None:
    from dataclasses import replace

    from app.session.sidecar import write_summary

    path = first(folder)
    summary = read_kept(path).summary
    better = dict(summary.score or {}) | {"total": 100.0, "passed": True}
    write_summary(path, replace(summary, score=better))  # with a digest of its own that is right
    found = {s.id: s for s in list_sessions(folder)}[path.stem]
    assert found.signature == "altered"
    assert Index(folder).refresh().total == 3
    assert {one.verdict for one in Index(folder).attempts()} == {"altered", "verified"}


def test_the_signature_of_another_attempt_does_not_fit(folder: Path) -> None:
    one, other = sorted(folder.glob("*.mcap"))[:2]
    shutil.copy(one, other)
    shutil.copy(signature_file(one), signature_file(other))
    assert judge_whole(other, this_station()).verdict is Signed.ALTERED


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"hmac": 1, "station": "x"}', "null"])
def test_a_damaged_signature_is_altered_and_breaks_no_list(folder: Path, text: str) -> None:
    signature_file(first(folder)).write_text(text)
    assert sorted(s.signature for s in list_sessions(folder)) == ["altered", *["verified"] * 2]


def test_another_stations_signature_counts_as_unsigned(folder: Path, tmp_path: Path) -> None:
    other = StationKey.of(tmp_path / "elsewhere")
    assert judge_whole(first(folder), other).sentence().startswith("unsigned: signed by another")


def test_without_a_usable_key_an_attempt_is_recorded_and_says_that_it_is_not_signed(
    tmp_path: Path,
) -> None:
    key_file().parent.mkdir(parents=True)
    key_file().write_text("no key")
    bench = Bench(tmp_path / "records")
    bench.run(0.1)
    bench.trainer.begin("s")
    bench.run(0.5, 0.03)
    result = bench.trainer.end()
    assert result.score is not None
    assert any("station's key" in problem for problem in result.summary.problems)
    assert [s.signature for s in list_sessions(tmp_path / "records")] == ["unsigned"]


def test_the_key_travels_only_under_the_recovery_key(tmp_path: Path) -> None:
    key, recovery = StationKey.of(tmp_path), new_recovery_key()
    wrapped = key.wrapped(recovery)
    assert key.secret.hex() not in str(wrapped)
    assert StationKey.unwrapped(wrapped, recovery.lower().replace("-", " ")) == key
    with pytest.raises(SignatureError, match="not the recovery key"):
        StationKey.unwrapped(wrapped, new_recovery_key())
    with pytest.raises(SignatureError, match="eight groups"):
        StationKey.unwrapped(wrapped, "ABCD")
    with pytest.raises(SignatureError, match="damaged"):
        StationKey.unwrapped({**wrapped, "salt": "?"}, recovery)
    with pytest.raises(SignatureError, match="damaged"):
        StationKey.unwrapped({**wrapped, "nonce": wrapped["nonce"] + "00"}, recovery)
    for name in wrapped:  # the station's id is bound to it as well
        text = wrapped[name]
        other = ("0" if text[0] != "0" else "1") + text[1:]
        with pytest.raises(SignatureError, match="not the recovery key"):
            StationKey.unwrapped({**wrapped, name: other}, recovery)
    again = key.wrapped(recovery)
    assert not {again[name] for name in ("salt", "nonce", "sealed")} & set(wrapped.values())


def test_a_wrapped_key_is_opened_by_any_aes_gcm(tmp_path: Path) -> None:
    # scrypt and AES-256-GCM as docs/privacy.md tells them, without the program's own code
    key, recovery = StationKey.of(tmp_path), new_recovery_key()
    wrapped = {name: text for name, text in key.wrapped(recovery).items() if name != "station"}
    salt, nonce, sealed = (bytes.fromhex(wrapped[name]) for name in ("salt", "nonce", "sealed"))
    assert (len(salt), len(nonce), len(sealed)) == (16, 12, 32 + 16)
    raw = base64.b32decode(recovery.replace("-", ""))
    stretched = hashlib.scrypt(raw, salt=salt, n=2**14, r=8, p=1, dklen=32)
    opened = Cipher(AES256(stretched), GCM(nonce, sealed[32:])).decryptor()
    opened.authenticate_additional_data(b"acus station key\0" + key.station.encode())
    assert opened.update(sealed[:32]) + opened.finalize() == key.secret


def test_a_key_that_an_earlier_build_wrapped_says_what_to_do() -> None:
    with pytest.raises(SignatureError, match=r"earlier build.*instructor.*without `--key`"):
        StationKey.unwrapped(
            {"station": "0" * 16, "salt": "00" * 16, "secret": "00" * 32, "tag": "00" * 32},
            new_recovery_key(),
        )


def test_two_programs_that_start_together_draw_one_key(tmp_path: Path) -> None:
    code = (
        "from pathlib import Path; from app.session.station import StationKey;"
        f"print(StationKey.of(Path({str(tmp_path / 'p')!r})).station)"
    )
    children = [
        subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        for _ in range(3)
    ]
    assert len({child.communicate()[0] for child in children}) == 1


# --- the index ------------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_the_index_follows_the_folder_and_is_rebuilt_equal(folder: Path) -> None:
    index = Index(folder)
    assert (index.refresh().read, index.refresh().read) == (3, 0)
    assert [one.student for one in index.attempts()] == ["s-1", "s-2", "s-1"]
    assert len(index.attempts(["s-2"])) == 1
    content = index.content()
    name = delete(folder, index.attempts()[0].id).stem
    assert (index.refresh().gone, len(index.attempts())) == (1, 2)
    restore(folder, name)
    index.refresh()
    assert index.content() == content
    for path in folder.glob("*.json"):
        path.write_text("{}")
    assert index.rebuild().read == 3
    assert index.content() == content


def test_a_row_gives_the_summary_that_the_list_gives(folder: Path) -> None:
    index = Index(folder)
    index.refresh()
    listed = {s.id: s.document() for s in list_sessions(folder)}
    assert {one.id: one.summary.document() for one in index.attempts()} == listed
    assert all(not one.counts or one.total is not None for one in index.attempts())


@pytest.mark.long("journey")
def test_a_first_look_reads_the_names_of_a_folder_twice(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program that knows nothing went through it four times: 300 000 names of a large school."""
    Index(folder).refresh()
    for known in ("journal._swept", "store._cleared"):
        monkeypatch.setattr(f"app.session.{known}", set())
    looks: list[str] = []

    def counted(name: str, real: Callable[[Any], Any]) -> Callable[[Any], Any]:
        def look(place: Any) -> Any:
            looks.extend([name] if Path(place) == folder else [])
            return real(place)

        return look

    for name in ("listdir", "scandir"):
        monkeypatch.setattr(os, name, counted(name, getattr(os, name)))
    Index(folder).refresh()
    assert looks == ["listdir", "scandir"]


@pytest.mark.parametrize("seed", range(20))
def test_the_listing_is_what_each_name_says(tmp_path: Path, seed: int) -> None:
    """Against names and inodes asked for one by one."""
    rng = random.Random(seed)
    ends = (".mcap", ".sig", ".json", "", ".mcap.part", "mcap", ".sig.sig", ".MCAP")
    for number in range(60):
        name = f"{rng.choice(('', '.', 'a.b'))}{rng.randrange(9)}{rng.choice(ends)}"
        if rng.random() < 0.1:
            (tmp_path / f"{name}-{number}.mcap").mkdir()
        elif name != ".":
            (tmp_path / name).touch()
    for name in ("mcap", "sig", ".mcap"):
        (tmp_path / name).touch()
    inode = {path.name: path.stat().st_ino for path in tmp_path.iterdir() if path.is_file()}
    wanted = {
        name.removesuffix(".mcap"): (number, inode.get(f"{name.removesuffix('.mcap')}.sig", 0))
        for name, number in inode.items()
        if name.endswith(".mcap")
    }
    assert listing(tmp_path) == wanted


def test_an_index_that_is_no_database_is_said_and_made_anew(folder: Path) -> None:
    Index(folder).refresh()
    for file in folder.glob(f"{INDEX}*"):
        file.write_bytes(b"not a database" * 500)
    with pytest.raises(DatabaseError, match="damaged: `acus store rebuild`"):
        Index(folder).refresh()
    assert Index(folder).rebuild().total == 3
    assert Index(folder).refresh().read == 0


def test_an_index_of_a_newer_version_is_left_alone(folder: Path) -> None:
    Index(folder).refresh()
    with sqlite3.connect(folder / INDEX) as connection:
        connection.execute("PRAGMA user_version = 99")
    for work in (Index(folder).refresh, Index(folder).rebuild):
        with pytest.raises(DatabaseError, match="newer version of Acus"):
            work()


def test_a_locked_index_is_one_line_and_works_afterwards(folder: Path) -> None:
    Index(folder).refresh()
    first(folder).touch()
    other = sqlite3.connect(folder / INDEX, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    with pytest.raises(DatabaseError, match=r"in use by another program for 0\.1 s"):
        Index(folder, busy=0.1).refresh()
    other.execute("ROLLBACK")
    other.close()
    assert Index(folder).refresh().read == 1


def test_a_folder_that_can_only_be_read_is_indexed_in_memory(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.session.index.os.access", lambda *_: False)
    index = Index(folder)
    assert index.path is None
    assert index.refresh().total == 3
    assert not (folder / INDEX).exists()


@pytest.mark.long("journey")
def test_a_full_disk_is_one_line(folder: Path) -> None:
    index = Index(folder)
    index.refresh()
    with index.database.read() as connection:
        pages = connection.exec_driver_sql("PRAGMA page_count").scalar()
    whole = [dict(row) for row in rows_of(index)]
    with pytest.raises(DatabaseError, match="disk is full"):
        fill(index, pages)
    assert [dict(row) for row in rows_of(index)] == whole


def fill(index: Index, pages: int) -> None:
    with index.database.write() as connection:
        connection.exec_driver_sql(f"PRAGMA max_page_count = {pages}")
        for number in range(2000):
            connection.exec_driver_sql(
                "INSERT INTO attempts SELECT ? || id, size, modified_ns, signed_ns, inode, "
                "signed_inode, station, started, student, exercise, version, state, duration, "
                "total, passed, verdict, counts, under, document FROM attempts "
                "WHERE id NOT LIKE 'x%'",
                (f"x{number}",),
            )


def rows_of(index: Index) -> list[dict[str, object]]:
    with index.database.read() as connection:
        found = connection.exec_driver_sql("SELECT * FROM attempts ORDER BY id")
        return [dict(row._mapping) for row in found]


def test_a_look_that_is_cancelled_goes_on_the_next_time(folder: Path) -> None:
    progress = Progress(lambda fraction, _: progress.cancel() if fraction > 0.3 else None)
    with pytest.raises(Cancelled):
        Index(folder).refresh(progress)
    assert Index(folder).refresh().total == 3


CHILD = """
import os, sys, time
from pathlib import Path
sys.path[:0] = sys.argv[3:]
from session_fakes import Bench
from app.session.header import new_id
from app.session.index import Index
import sqlalchemy

def program():
    folder = Path(sys.argv[1])
    bench = Bench(folder)
    object.__setattr__(bench.context, "identify", new_id)
    bench.run(0.1)
    while True:
        bench.trainer.begin("s")
        bench.run(0.3, 0.02)
        result = bench.trainer.end()
        os.write(1, f"{result.summary.id}\\n".encode())
        Index(folder).refresh()

for line in sys.stdin:
    child = os.fork()
    if child == 0:
        program()
        os._exit(0)
    os.write(1, f"begun {child}\\n".encode())
"""


@pytest.mark.long("journey")
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.timeout(1200)
def test_no_kill_loses_a_finished_attempt_and_the_index_is_rebuilt_equal(tmp_path: Path) -> None:
    rng = random.Random(13)
    folder = tmp_path / "records"
    folder.mkdir()
    paths = [str(Path(__file__).parent), str(Path(__file__).parents[2])]
    running: list[tuple[float, int]] = []
    killed = 0
    with subprocess.Popen(
        [sys.executable, "-c", CHILD, str(folder), "", *paths],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as parent:
        assert parent.stdin is not None
        assert parent.stdout is not None
        # How long an attempt takes on this computer, now: lives are as long, a little or a lot.
        parent.stdin.write("\n")
        parent.stdin.flush()
        first = int(parent.stdout.readline().split()[1])
        start = time.monotonic()
        finished = [parent.stdout.readline().strip()]
        longer = max(1.0, 2.0 * AT_ONCE * (time.monotonic() - start))
        os.kill(first, signal.SIGKILL)
        begun = 0
        while killed < KILLS:
            if begun < KILLS and len(running) < AT_ONCE:
                parent.stdin.write("\n")
                parent.stdin.flush()
                begun += 1
                while not (line := parent.stdout.readline()).startswith("begun"):
                    finished.append(line.strip())
                life = longer * rng.uniform(0.2, 1.6)
                running.append((time.monotonic() + life, int(line.split()[1])))
                continue
            running.sort()
            moment, pid = running.pop(0)
            time.sleep(max(0.0, moment - time.monotonic()))
            os.kill(pid, signal.SIGKILL)
            killed += 1
        parent.stdin.close()
        finished += [line.strip() for line in parent.stdout]
    finished = [line for line in finished if line and not line.startswith("begun")]
    assert len(finished) >= KILLS // 4  # those that lived long enough on this machine
    index = Index(folder)
    index.refresh()
    known = {one.id: one for one in index.attempts()}
    for name in finished:
        assert read_recording(folder / f"{name}.mcap").complete
        assert known[name].state == "ended"
        assert known[name].verdict == "verified"
        assert sidecar(folder / f"{name}.mcap").exists()
    old = time.time() - 60.0
    for path in folder.glob("*.mcap"):  # what was cut off is no longer under way
        if path.stem not in known:
            os.utime(path, (old, old))
    index.refresh()
    content = index.content()
    assert index.rebuild().total == len(list(folder.glob("*.mcap")))
    assert index.content() == content


def test_a_drill_is_a_persons_and_counts_for_nobody(tmp_path: Path) -> None:
    key = StationKey.of()
    for name, drill in (("whole", ""), ("part", "depth")):
        under = Conditions("first-insertion", 1, hand="mouse", scoring_version=7, drill=drill)
        score = {"total": 90.0, "passed": True, "void_reason": "", "rows": []}
        path = tmp_path / f"{name}.mcap"
        path.write_bytes(b"not opened: the sidecar is enough")
        summary = Summary(
            name, "2026-11-20T10:00:00+00:00", "p-a", "first-insertion",
            state="ended", score=score, conditions=under,
        )  # fmt: skip
        write_summary(path, summary)
        text = signed(path, file_digest(path), summary, {}, key)
        signature_file(path).write_text(text)
    index = Index(tmp_path)
    index.refresh()
    attempts = index.attempts()
    assert {one.id: one.counts for one in attempts} == {"whole": True, "part": False}
    items, ada = [CourseItem(exercise="first-insertion")], Person("p-a", "Ada")
    cell = progress_board([ada], items, attempts, {}, NOON).cells["p-a", "first-insertion"]
    assert (cell.attempts, cell.why) == (1, (("a drill", 1),))
