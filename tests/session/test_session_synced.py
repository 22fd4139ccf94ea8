"""What a record's page says to be on the disk has been waited for, when a power cut would count.

The tests wait for no disk (`conftest`); here it is looked at who would have waited, for which file,
and how much of it stood there then.
"""

import os
import stat
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from session_fakes import Bench, row

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.files import watched, write_atomically
from app.device.checkpoint import Checkpoint
from app.session.header import SessionHeader
from app.session.journal import FOLDER
from app.session.recorder import FLUSH_PERIOD, Recorder
from app.session.recording import read_recording
from app.session.signature import signature_file


class Disk:
    """What of each file and folder a power cut would leave, by its number in the file system."""

    def __init__(self) -> None:
        self.files: dict[int, bytes] = {}
        self.folders: dict[int, set[str]] = {}

    def sync(self, handle: int) -> None:
        about, path = os.fstat(handle), f"/proc/self/fd/{handle}"
        if stat.S_ISDIR(about.st_mode):
            self.folders[about.st_ino] = set(os.listdir(path))
        else:
            self.files[about.st_ino] = Path(path).read_bytes()

    def holds(self, path: Path, below: Path) -> bytes:
        """Content of a file after a power cut now; empty where a name on its way would be gone."""
        way = [path, *(folder for folder in path.parents if folder.is_relative_to(below))]
        named = all(
            one.name in self.folders.get(one.parent.stat().st_ino, set())
            for one in way
            if one != below
        )
        return self.files.get(path.stat().st_ino, b"") if named else b""


@pytest.fixture
def disk(monkeypatch: pytest.MonkeyPatch) -> Disk:
    made = Disk()
    monkeypatch.setattr(os, "fsync", made.sync)
    return made


def recorder_on(folder: Path, clock: VirtualClock) -> Recorder:
    state = row(50.0, 7)

    def rows(tick: int) -> np.ndarray:
        ticks = np.arange(max(tick, 7) + 1, 7 + round(1e3 * (clock.now() - 50.0)) + 1)
        found = np.tile(state, (len(ticks), 1))
        found[:, sv.TICK], found[:, sv.TIME] = ticks, 50.0 + 1e-3 * (ticks - 7)
        return found

    header = SessionHeader("a", datetime(2026, 1, 1, tzinfo=UTC), 50.0, "s", "x")
    return Recorder(folder, header, rows, clock=clock, start=Checkpoint.of(state, []))


@pytest.mark.promise(
    "docs/sessions.md: head and checkpoint are on the disk before its clock starts"
)
def test_a_power_cut_right_after_the_beginning_leaves_head_and_checkpoint(
    disk: Disk, tmp_path: Path
) -> None:
    recorder = recorder_on(tmp_path, VirtualClock(50.0))
    recorder.open()
    left = tmp_path / "left.mcap"
    left.write_bytes(disk.holds(recorder.status().path, tmp_path))
    recording = read_recording(left)
    assert recording.metadata["session"]["id"] == "a"
    assert recording.inputs.checkpoint is not None
    assert recording.inputs.checkpoint.checkpoint.tick == 7
    recorder.finish()


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/sessions.md: later every half second, when the file is also synced to the disk"
)
def test_a_power_cut_loses_half_a_second_of_an_attempt_and_a_block(
    disk: Disk, tmp_path: Path
) -> None:
    clock = VirtualClock(50.0)
    recorder = recorder_on(tmp_path, clock)
    recorder.open()
    left = tmp_path / "left.mcap"
    for step in range(1, 101):
        clock.sleep(0.04)
        recorder.drain()
        left.write_bytes(disk.holds(recorder.status().path, tmp_path))
        kept = 1e-3 * len(read_recording(left).inputs.values)
        assert 0.04 * step - kept <= FLUSH_PERIOD + 0.2, step
    recorder.finish()


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/sessions.md: The signature is planned on the disk before the record's last bytes are "
    "written"
)
def test_a_power_cut_while_a_record_is_ended_leaves_its_signature_planned(
    disk: Disk, tmp_path: Path
) -> None:
    plans: list[bytes] = []

    def look(what: str, path: Path) -> None:
        if what == "close":
            journals = (path.parent / FOLDER).iterdir()
            plans.extend(disk.holds(journal, path.parent) for journal in journals)

    bench = Bench(tmp_path / "records")
    bench.trainer.begin("s")
    bench.run(4.0, 0.05)
    with watched(look):
        bench.trainer.end()
    (record,) = bench.folder.glob("*.mcap")
    assert signature_file(record).exists()
    assert len(plans) == 1
    assert b'"seal"' in plans[0]
    assert record.name.encode() in plans[0]


def test_a_file_that_is_written_at_once_is_on_the_disk_before_it_takes_the_name(
    disk: Disk, tmp_path: Path
) -> None:
    target = tmp_path / "plan.json"
    target.write_text("old")
    taken: list[bytes] = []

    def look(what: str, path: Path) -> None:
        if what == "replace":
            (part,) = tmp_path.glob(f".{target.name}.*")
            taken.append(disk.files[part.stat().st_ino])

    with watched(look):
        write_atomically(target, "new")
    assert taken == [b"new"]
