"""Programs that are killed, stopped or run out of disk: what they leave behind can be used."""

import errno
import os
import random
import signal
import subprocess
import sys
import time
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from session_fakes import WALL, Bench, row

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.device.checkpoint import Checkpoint
from app.session import mcap_file
from app.session.context import RunContext
from app.session.header import Attachment, SessionHeader, new_id
from app.session.machine import State
from app.session.mcap_file import GrowingFile
from app.session.recorder import EAGER, Recorder
from app.session.recording import open_recording, read_recording
from app.session.replay import why_not
from app.session.sample_columns import SAMPLES_FILE
from app.session.sidecar import verify_record
from app.session.ticker import Standstill
from app.session.verify import verify

PROGRAMS = 24

CHILD = """
import os, signal, sys, time
from datetime import UTC, datetime
from pathlib import Path
sys.path[:0] = sys.argv[3:]
import numpy as np
from session_fakes import row
from app.core import state_vector as sv
from app.device.checkpoint import Checkpoint
from app.session.header import SessionHeader
from app.session.recorder import Recorder

def program(k):
    begin = time.monotonic()
    state = row(begin, 0)
    os.write(1, f"{k} {os.getpid()} {begin}\\n".encode())
    def rows(tick):
        newest = int((time.monotonic() - begin) * 1000)
        ticks = np.arange(tick + 1, newest + 1)
        found = np.tile(state, (len(ticks), 1))
        found[:, sv.TICK], found[:, sv.TIME] = ticks, begin + 0.001 * ticks
        return found
    header = SessionHeader(f"k{k}", datetime.now(UTC), begin, "s", "killed")
    start = Checkpoint.of(state, [])
    recorder = Recorder(Path(sys.argv[1]), header, rows, start=start)
    recorder.open()
    recorder.start()
    time.sleep(30)

programs = int(sys.argv[2])
for k in range(programs):
    if os.fork() == 0:
        program(k)
        os._exit(0)
for _ in range(programs):
    os.wait()
"""


@pytest.mark.long("journey")
@pytest.mark.promise("docs/sessions.md: so that one under its own name can always be replayed")
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_every_record_that_a_killed_program_leaves_can_be_replayed(tmp_path: Path) -> None:
    rng = random.Random(7)
    paths = [str(Path(__file__).parent), str(Path(__file__).parents[2])]
    with subprocess.Popen(
        [sys.executable, "-c", CHILD, str(tmp_path), str(PROGRAMS), *paths],
        stdout=subprocess.PIPE,
        text=True,
    ) as child:
        assert child.stdout is not None
        begun = [child.stdout.readline().split() for _ in range(PROGRAMS)]
        plan = sorted((float(t) + rng.uniform(0.0, 1.5), int(pid)) for _, pid, t in begun)
        for moment, pid in plan:
            time.sleep(max(0.0, moment - time.monotonic()))
            os.kill(pid, signal.SIGKILL)
        child.wait(timeout=30)
    records = sorted(tmp_path.glob("*.mcap"))
    assert records
    for path in records:
        recording = read_recording(path)
        assert not recording.complete
        assert recording.inputs.checkpoint is not None, path.name
        assert len(recording.inputs.values) == 0 or why_not(recording.inputs) == ""
    held = [len(read_recording(path).inputs.values) for path in records]
    assert sum(count > 0 for count in held) >= 4  # those that lived long enough on this machine


@pytest.mark.long("journey")
def test_what_a_kill_loses_is_bounded_from_the_first_block_on(tmp_path: Path) -> None:
    clock = VirtualClock(50.0)
    state = row(50.0, 0)

    def rows(tick: int) -> np.ndarray:
        ticks = np.arange(tick + 1, round(1e3 * (clock.now() - 50.0)) + 1)
        found = np.tile(state, (len(ticks), 1))
        found[:, sv.TICK], found[:, sv.TIME] = ticks, 50.0 + 1e-3 * ticks
        return found

    start = Checkpoint.of(state, [])
    recorder = Recorder(tmp_path, header(), rows, clock=clock, start=start)
    recorder.open()
    killed = tmp_path / "killed.mcap"
    for step in range(1, 101):
        clock.sleep(0.04)
        recorder.drain()
        killed.write_bytes(recorder.status().path.read_bytes())  # what the system has been given
        recording = read_recording(killed)
        assert recording.inputs.checkpoint is not None
        lost = 0.04 * step - 1e-3 * len(recording.inputs.values)
        assert lost <= (0.16 if 0.04 * step < EAGER else 0.7), step
        assert len(recording.inputs.values) == 0 or why_not(recording.inputs) == ""
    recorder.finish()


def header(name: str = "a") -> SessionHeader:
    return SessionHeader(name, datetime(2026, 1, 1, tzinfo=UTC), 50.0, "s", "x")


def test_the_checkpoint_is_on_the_disk_when_open_returns(tmp_path: Path) -> None:
    start = Checkpoint.of(row(50.0, 7), [])
    recorder = Recorder(tmp_path, header(), lambda _: np.empty((0, sv.SLOTS)), start=start)
    recorder.open()
    found = read_recording(recorder.status().path).inputs.checkpoint  # another program's eyes
    assert found is not None
    assert found.checkpoint.tick == 7
    recorder.finish()


def test_a_record_stands_under_its_name_only_with_its_beginning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[list[str]] = []
    publish = GrowingFile.publish

    def watched(self: GrowingFile) -> None:
        seen.append(sorted(p.name for p in tmp_path.glob("*.mcap")))
        publish(self)

    monkeypatch.setattr(GrowingFile, "publish", watched)
    recorder = Recorder(tmp_path, header())
    recorder.open()
    assert seen == [[]]
    assert [p.name for p in tmp_path.glob("*.mcap")] == ["a.mcap"]
    recorder.finish()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.mcap"]  # nothing else is left


class SmallDisk:
    """A folder that holds so many bytes; what was set aside counts, as on a real disk."""

    def __init__(self, folder: Path, size: int, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder, self.size = folder, size
        self._write, self._aside = mcap_file._write, mcap_file._set_aside
        monkeypatch.setattr(mcap_file, "_write", self.write)
        monkeypatch.setattr(mcap_file, "_set_aside", self.set_aside)

    @property
    def free(self) -> int:
        return self.size - sum(p.stat().st_size for p in self.folder.iterdir() if p.is_file())

    def write(self, fd: int, data: memoryview) -> int:
        if self.free <= 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return self._write(fd, data[: max(1, self.free)])  # a full disk takes a part first

    def set_aside(self, path: Path, size: int) -> None:
        if self.free < size:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        self._aside(path, size)


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path)


def test_a_disk_that_fills_loses_no_score(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    disk = SmallDisk(bench.folder, mcap_file.RESERVE + 60_000, monkeypatch)
    bench.folder.mkdir(parents=True, exist_ok=True)
    bench.trainer.begin("s")
    depth = 0.0
    while bench.trainer._running.log.recorder.status().full == "":
        depth = min(depth + 0.01, 0.06)
        bench.run(0.5, depth)
        assert bench.clock.now() < 200.0
    bench.run(1.0, 0.05)
    result = bench.trainer.end()
    assert result.score is not None
    assert result.record is not None
    assert "the disk is full" in result.summary.problems[0]
    recording = read_recording(result.record)
    assert recording.complete
    assert "score.json" in recording.attachments
    assert verify(recording).confirmed  # its samples found room in what had been set aside
    assert disk.free > 0


def test_a_disk_without_room_for_the_end_is_said_at_the_beginning(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench.folder.mkdir(parents=True, exist_ok=True)
    SmallDisk(bench.folder, mcap_file.RESERVE // 2, monkeypatch)
    bench.trainer.begin("s")
    events = [e.message for e in bench.trainer.events.drain() if e.kind == "recorder"]
    assert "No space left" in events[0]
    result = bench.trainer.end()
    assert result.record is None
    assert list(bench.folder.iterdir()) == []


def test_a_score_without_its_samples_stands_as_written_and_is_not_confirmed(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mcap_file, "RESERVE", 0)
    bench.folder.mkdir(parents=True, exist_ok=True)
    bench.trainer.begin("s")
    bench.run(1.0, 0.05)
    file = bench.trainer._running.log.recorder._file._file
    file.full, file._size = True, 16_000  # as if the disk were full, with little set aside
    bench.run(2.0, 0.06)
    monkeypatch.setattr("app.session.recorder._LAST_WORDS", 1_000)
    large = Attachment(SAMPLES_FILE, "application/octet-stream", bytes(100_000))
    monkeypatch.setattr("app.session.attempt_log.attachment", lambda _: large)
    result = bench.trainer.end()
    assert result.record is not None
    found = verify_record(result.record)
    assert found.standing is not None
    assert found.standing.total == result.score.total
    assert not found.confirmed
    assert "not recorded" in found.cut


def test_ids_that_are_taken_are_drawn_again(tmp_path: Path) -> None:
    names = iter(["taken", "deleted", "free"])
    (tmp_path / "taken.mcap").touch()
    (tmp_path / ".trash").mkdir()
    (tmp_path / ".trash" / "deleted.mcap").touch()
    context = RunContext(folder=tmp_path, identify=lambda _: next(names))
    assert context._free_id(WALL) == "free"
    drawn = {new_id(WALL) for _ in range(5000)}
    assert len(drawn) == 5000  # 16 bits would collide about 190 times


class Still:
    """Times of looks, ticks of the loop, and how long the computer slept."""

    def __init__(self) -> None:
        self.asleep = 0.0
        self.sleep = Standstill(lambda: self.asleep)

    def look(self, now: float, tick: int) -> float:
        return self.sleep.before(now, tick)


def test_a_program_that_slept_is_told_from_one_that_was_busy() -> None:
    still = Still()
    assert still.look(10.0, 0) == 0.0
    assert still.look(10.02, 20) == 0.0
    assert still.look(12.5, 2500) == 0.0  # the window was busy: the loop went on
    assert still.look(14.6, 2530) == pytest.approx(2.1)  # stopped and continued
    assert still.look(14.62, 2550) == 0.0
    still.asleep = 3600.0  # a lid was closed: the monotonic clock did not count it
    assert still.look(14.64, 2570) == 3600.0
    assert still.look(14.66, 2590) == 0.0


def test_an_attempt_ends_when_the_program_slept_and_says_so(bench: Bench) -> None:
    bench.trainer.begin("s")
    bench.run(0.5, 0.03)
    bench.clock.sleep(2.5)  # nobody ticked
    bench.trainer.tick(bench.clock.now())
    result = bench.trainer.result
    assert result is not None
    assert result.state is State.ABORTED
    assert "slept for 2.5 s" in result.reason
    assert [e.data["seconds"] for e in result.events if e.kind == "slept"] == [pytest.approx(2.5)]
    assert result.record is not None
    assert any(e.kind == "slept" for e in read_recording(result.record).events)
    assert result.score is None or result.score.total is None


def test_an_attempt_just_ended_is_shown_without_reading_its_record(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    from app.session.review import review, review_of_result

    bench.trainer.begin("s")
    bench.run(2.0, 0.06)
    result = bench.trainer.end()
    assert result.record is not None
    back = review(open_recording(result.record))
    os.rename(result.record, result.record.with_suffix(".away"))
    shown = review_of_result(result)
    for name in ("id", "student", "started", "state", "duration", "scans", "problems", "marks",
                 "spans", "score", "conditions", "force_limit", "risks"):  # fmt: skip
        assert getattr(shown, name) == getattr(back, name), name
    np.testing.assert_array_equal(shown.tip, back.tip)


def test_samples_in_columns_are_those_of_the_messages(bench: Bench) -> None:
    bench.trainer.begin("s")
    bench.run(2.0, 0.06)
    path = bench.trainer.end().record
    assert path is not None
    fast, whole = open_recording(path), read_recording(path)
    assert type(fast.inputs).__name__ == "DeferredInputs"
    assert len(fast.inputs.values) == len(whole.inputs.values) > 0
    assert fast.events == whole.events
    assert fast.problems == whole.problems == ()
    assert verify_record(path).confirmed
    spoilt = bytearray(path.read_bytes())
    spoilt[spoilt.index(b"ACUS") + 200] ^= 0x10
    path.write_bytes(bytes(spoilt))
    again = open_recording(path)  # the messages still have them
    np.testing.assert_array_equal(again.samples.tip, whole.samples.tip)
    assert any("damaged" in problem for problem in again.problems)
    assert EAGER > 0.0
    assert isinstance(bench.clock, VirtualClock)
