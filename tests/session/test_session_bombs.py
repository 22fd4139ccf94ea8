"""Records of a few kilobytes that stand for gigabytes: refused by name, in little memory and time.

Each is listed in a process of its own with a limit of memory, so that a reader that falls for one
does not take the tests along.
"""

import json
import struct
import subprocess
import sys
import time
from pathlib import Path
from zlib import crc32

import pytest
import zstandard
from hard.recording_rig import write
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, Message, Metadata
from mcap.writer import MCAP0_MAGIC, CompressionType, Writer

from app.session import budget, sample_columns
from app.session.budget import ReadingBudget, allowed_bytes
from app.session.errors import BudgetExceededError, PeopleError
from app.session.recording import messages_agree, open_recording, read_recording
from app.session.roster import roster_in
from app.session.scan import scan
from app.session.ticks import read_inputs

LIMIT = 900 << 20
"""Address space of the process that lists [bytes]; Python with numpy takes a third of it."""

RESIDENT = 400 << 20
"""Memory that it may really use [bytes]."""

LISTING = f"""
import resource, sys, time
resource.setrlimit(resource.RLIMIT_AS, ({LIMIT}, {LIMIT}))
from pathlib import Path
from app.session.store import list_sessions
started = time.process_time()
for one in list_sessions(Path(sys.argv[1])):
    print(one.id, one.state, one.reason, sep=chr(9))
peak = Path("/proc/self/status").read_text().split("VmHWM:")[1].split()[0]
print(time.process_time() - started, 1024 * int(peak))
"""


def chunk(data: bytes, times: int, size: int | None = None) -> bytes:
    """A compressed chunk, so often; `size` is what it says that it holds."""
    packed = zstandard.compress(data)
    builder = RecordBuilder()
    size = len(data) if size is None else size
    Chunk("zstd", packed, 0, 0, 0, size).write(builder)
    return bytes(builder.end()) * times


def message(data: bytes) -> bytes:
    builder = RecordBuilder()
    Message(channel_id=1, data=data, log_time=0, publish_time=0, sequence=0).write(builder)
    return bytes(builder.end())


def channel(topic: str) -> bytes:
    builder = RecordBuilder()
    Channel(id=1, topic=topic, message_encoding="json", metadata={}, schema_id=0).write(builder)
    return bytes(builder.end())


def finished(path: Path, topic: str, data: bytes, name: str, attached: bytes) -> None:
    """A record with its end, an index, one message and one attachment."""
    with path.open("wb") as stream:
        writer = Writer(stream, compression=CompressionType.ZSTD)
        writer.start("", "x")
        number = writer.register_channel(topic, "json", 0)
        writer.add_metadata("session", {"id": path.stem})
        writer.add_attachment(0, 0, name, "application/octet-stream", attached)
        writer.add_message(number, 0, data, 0, 0)
        writer.finish()


def columns_of(rows: int, words: list[str]) -> bytes:
    """Samples of so many rows, each column a constant of nine bytes."""
    names = ("time", "valid", "depth", "measured", "state", "depth_source")
    kinds = ("number", "flag", "number", "number", "word", "word")
    text = json.dumps(
        {
            "rows": rows,
            "fields": [
                *((n, k, 1) for n, k in zip(names, kinds, strict=True)),
                *((n, "number", 3) for n in ("tip", "axis", "target", "hub", "guide", "felt")),
            ],
            "words": {"state": words, "depth_source": words},
        }
    ).encode()
    packed = zstandard.compress(text + (b"\0" + bytes(8)) * 24)
    head = struct.pack("<4sHII", b"ACUS", 1, len(text), crc32(packed))
    return head + packed


def small_messages(path: Path) -> None:
    path.write_bytes(MCAP0_MAGIC + chunk(channel("/events") + message(b"") * 2_000_000, 40))


def large_messages(path: Path) -> None:
    path.write_bytes(MCAP0_MAGIC + chunk(message(bytes(1 << 24)) * 4, 100))


def more_than_it_says(path: Path) -> None:
    path.write_bytes(MCAP0_MAGIC + chunk(message(bytes(1 << 24)) * 10, 20, size=1000))


def values_of_json(path: Path) -> None:
    empty = b'{"a":[' + b"[]," * 1_000_000 + b"[]]}"
    builder = RecordBuilder()
    Metadata("session", {"id": path.stem}).write(builder)
    head = MCAP0_MAGIC + bytes(builder.end())
    path.write_bytes(head + chunk(channel("/attempt") + message(empty) * 10, 2))


def indexed_again_and_again(path: Path) -> None:
    finished(path, "/events", b"{}", "a.bin", bytes(1 << 19))
    data = path.read_bytes()
    (start,) = struct.unpack_from("<Q", data, len(data) - 8 - 20)
    summary, footer = data[start : -8 - 29], bytearray(data[-8 - 29 : -8])
    place = start
    while data[place] != Opcode.ATTACHMENT_INDEX:
        place += 9 + struct.unpack_from("<Q", data, place + 1)[0]
    length = 9 + struct.unpack_from("<Q", data, place + 1)[0]
    summary += data[place : place + length] * 4000
    struct.pack_into("<I", footer, 25, crc32(summary + footer[:25]))
    path.write_bytes(data[:start] + summary + bytes(footer) + MCAP0_MAGIC)


def long_columns(path: Path) -> None:
    finished(path, "/events", b"{}", "samples.acus", columns_of(1 << 24, ["a"]))


def wide_words(path: Path) -> None:
    words = ["a" * 10_000, *(str(n) for n in range(10_000))]
    finished(path, "/events", b"{}", "samples.acus", columns_of(1 << 19, words))


def wide_blocks(path: Path) -> None:
    block = struct.pack("<4sHHIIQ", b"ACUB", 2, 60_000, 1 << 20, 0, 0)
    block += (b"\0" + bytes(8)) * 60_000 + bytes(1 << 20)
    data = channel("/loop/inputs") + message(block)
    path.write_bytes(MCAP0_MAGIC + chunk(data, 1))


REFUSED = {
    "small-messages": small_messages,
    "large-messages": large_messages,
    "values-of-json": values_of_json,
    "long-columns": long_columns,
    "indexed-again": indexed_again_and_again,
}
"""Refused by what they would take."""

BROKEN = {"more-than-it-says": more_than_it_says, "wide-words": wide_words}
"""Damaged, and read as that."""


@pytest.fixture(scope="module")
def listed(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    folder = tmp_path_factory.mktemp("bombs")
    for name, make in (REFUSED | BROKEN).items():
        make(folder / f"{name}.mcap")
        assert (folder / f"{name}.mcap").stat().st_size < 1 << 20, name
    write(folder, 1.0, name="good")
    (folder / "good.json").write_bytes(b"[" + b"[]," * 2_000_000 + b"[]]")
    done = subprocess.run(
        [sys.executable, "-c", LISTING, str(folder)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    *lines, last = done.stdout.splitlines()
    return {line.split("\t")[0]: line.split("\t")[1:] for line in lines} | {"spent": last.split()}


@pytest.mark.long("journey")
def test_a_folder_of_bombs_is_listed_in_seconds_and_little_memory(
    listed: dict[str, list[str]],
) -> None:
    seconds, resident = map(float, listed["spent"])
    assert seconds < 15.0
    assert resident < RESIDENT


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", REFUSED)
def test_a_bomb_is_refused_with_its_name_its_size_and_what_it_may_take(
    listed: dict[str, list[str]], name: str
) -> None:
    state, reason = listed[name]
    assert state == "broken"
    assert reason.startswith(f"{name}.mcap has 0.")
    assert "MB and would take more than" in reason


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", BROKEN)
def test_what_does_not_hold_what_it_says_is_left_out(
    listed: dict[str, list[str]], name: str
) -> None:
    assert listed[name][0] in ("broken", "unfinished")


@pytest.mark.long("journey")
def test_a_sidecar_that_is_a_bomb_is_written_anew_and_the_record_listed(
    listed: dict[str, list[str]],
) -> None:
    assert listed["good"][0] == "unfinished"


def test_a_block_of_ticks_is_refused_before_it_is_made(tmp_path: Path) -> None:
    wide_blocks(tmp_path / "wide.mcap")
    with pytest.raises(BudgetExceededError, match=r"wide\.mcap has 0\.\d MB"):
        read_inputs(scan(tmp_path / "wide.mcap"), [])


def test_an_attachment_of_megabytes_is_left_out_and_said(tmp_path: Path) -> None:
    finished(tmp_path / "a.mcap", "/events", b"{}", "exercise.json", b"[" * (2 << 20))
    content = scan(tmp_path / "a.mcap")
    assert "exercise.json" not in content.attachments
    assert "exercise.json is left out: it has 2.1 MB" in content.problems[0]


def test_columns_that_do_not_say_their_size_are_not_ours() -> None:
    packed = zstandard.ZstdCompressor(write_content_size=False).compress(bytes(1 << 20))
    data = struct.pack("<4sHII", b"ACUS", 1, 10, crc32(packed)) + packed
    with pytest.raises(Exception, match="cannot be read"):
        sample_columns.unpack(data, ReadingBudget("a.mcap", len(data)))


@pytest.mark.long("journey")
def test_an_honest_record_takes_less_than_two_thirds_of_what_it_may(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also the one in which nothing moves, whose file is the smallest for its length."""
    monkeypatch.setattr(budget, "LEAST_BYTES", 0)
    monkeypatch.setattr(budget, "BYTES_PER_BYTE", budget.BYTES_PER_BYTE * 2 / 3)
    kept = Path(__file__).parents[1] / "data"
    paths = [*kept.glob("records*/*.mcap"), write(tmp_path, 10.0)]
    assert len(paths) > 15
    for path in paths:
        open_recording(path)
        messages_agree(read_recording(path))


def test_a_long_record_may_take_what_the_machine_has_free(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.imaging.memory.available", lambda: 8 << 30)
    assert allowed_bytes(200_000) == budget.LEAST_BYTES + 200_000 * budget.BYTES_PER_BYTE
    assert allowed_bytes(20 << 20) == budget.LEAST_BYTES + (20 << 20) * budget.BYTES_PER_BYTE
    assert allowed_bytes(1 << 30) == int(0.7 * (8 << 30))
    monkeypatch.setattr("app.imaging.memory.available", lambda: 1 << 30)
    assert allowed_bytes(1 << 30) == 2 << 30


def test_a_roster_that_is_larger_than_any_course_is_refused_unread(tmp_path: Path) -> None:
    roster = tmp_path / "roster.csv"
    roster.write_bytes(b"pseudonym\n" + b"Ada\n" * (8 << 20))
    with pytest.raises(PeopleError, match=r"cannot read .*roster\.csv: it is larger than 1 MB"):
        roster_in(roster)


def test_a_roster_of_ten_thousand_students_is_read_at_once(tmp_path: Path) -> None:
    roster = tmp_path / "roster.csv"
    roster.write_text("pseudonym\n" + "".join(f"Student {n}\n" for n in range(10_000)))
    started = time.process_time()
    lines, errors = roster_in(roster)
    assert (len(lines), errors) == (10_000, [])
    assert time.process_time() - started < 2.0
