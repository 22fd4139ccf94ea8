"""Records that are cut off, damaged or no records at all: what is whole is kept."""

import json
import math
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.stream_reader import StreamReader
from mcap.writer import MCAP0_MAGIC

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.events import Event
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.session import blocks, checkpoint_file, columns
from app.session.digest import digests
from app.session.errors import BrokenRecordingError, RecordingError
from app.session.facts import PLAN, plan_record
from app.session.header import Attachment, SessionHeader
from app.session.machine import State
from app.session.needle import DOWN, DepthSource, NeedlePose
from app.session.recorder import Recorder
from app.session.recording import Recording, read_recording
from app.session.sample import Sample, encode
from app.session.scan import scan
from app.session.store import find, list_sessions
from app.session.summary import read_summary

WALL = datetime(2026, 1, 15, 9, 31, 22, tzinfo=UTC)
PLACED = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0])), Placement(), np.zeros(3))


def pose(time: float, depth: float, valid: bool = True) -> NeedlePose:
    return NeedlePose(
        p_tip=np.array([0.0, 0.0, -depth]),
        axis=DOWN,
        depth=depth,
        time=time,
        orientation_age=0.0,
        depth_age=0.0,
        depth_source=DepthSource.TRACKED if valid else DepthSource.NONE,
        valid=valid,
        covariance=1e-8 * np.eye(3),
        reason="" if valid else "not a number",
    )


def write(folder: Path, seconds: float, name: str = "a", bad: float | None = None) -> Path:
    """A finished record of a needle that goes in at 10 mm/s."""
    clock = VirtualClock(50.0)
    rows: list[np.ndarray] = []
    header = SessionHeader(
        name,
        WALL,
        50.0,
        "s-1",
        "liver-01",
        metadata={PLAN: plan_record(PLACED)},
        attachments=(Attachment("exercise.json", "application/json", b'{"id": "liver-01"}'),),
    )

    def since(tick: int) -> np.ndarray:
        return np.array(rows[tick:]).reshape(-1, sv.SLOTS)

    recorder = Recorder(folder, header, since, clock=clock)
    recorder.open()
    for k in range(round(seconds * 50)):
        for _ in range(20):
            clock.sleep(0.001)
            state = sv.empty_state()
            state[sv.TIME], state[sv.TICK] = clock.now(), len(rows) + 1
            rows.append(state)
        depth = bad if bad is not None and k == 5 else 0.01 * (clock.now() - 50.0)
        seen = pose(clock.now(), depth)
        recorder.sample(Sample(clock.now(), State.INSERTING, seen, None, np.zeros(3)))
        if k % 25 == 0:
            recorder.event(Event(clock.now(), "scan", f"scan {k}", {"number": k}))
        recorder.drain()
    recorder.finish((Attachment("score.json", "application/json", b'{"total": 1.0}'),))
    return recorder.status().path


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return write(tmp_path_factory.mktemp("whole"), 4.0).read_bytes()


def read(folder: Path, data: bytes) -> Recording:
    path = folder / "cut.mcap"
    path.write_bytes(data)
    return read_recording(path)


def assert_prefix(part: Recording, full: Recording) -> None:
    """What a damaged record gives is exactly the beginning of what the whole one gives."""
    n, m = len(part.samples.time), len(part.inputs.values)
    for name in ("time", "depth", "tip", "axis", "state", "valid"):
        np.testing.assert_array_equal(getattr(part.samples, name), getattr(full.samples, name)[:n])
    np.testing.assert_array_equal(part.inputs.values, full.inputs.values[:m])
    assert part.events == full.events[: len(part.events)]


def test_a_file_cut_off_anywhere_gives_its_beginning_or_says_why_not(
    tmp_path: Path, whole: bytes
) -> None:
    full = read(tmp_path, whole)
    assert full.complete
    first = whole.index(b"session")
    lengths = [*range(0, len(whole), 307), *range(len(whole) - 40, len(whole))]
    seen = 0
    for length in lengths:
        if length < first + 400:
            with suppress(BrokenRecordingError):
                read(tmp_path, whole[:length])
            continue
        part = read(tmp_path, whole[:length])
        # A cut inside the closing magic leaves nothing out.
        assert part.complete == (length >= len(whole) - len(MCAP0_MAGIC))
        assert part.complete or part.problems
        assert_prefix(part, full)
        assert len(part.samples.time) >= seen
        seen = len(part.samples.time)


def test_every_cut_file_has_a_summary(tmp_path: Path, whole: bytes) -> None:
    path = tmp_path / "cut.mcap"
    for length in range(0, len(whole), 601):
        path.write_bytes(whole[:length])
        assert read_summary(path).state in ("broken", "unfinished")


@settings(derandomize=True, deadline=None, max_examples=60)
@given(place=st.floats(0.0, 1.0, exclude_max=True), bits=st.integers(1, 255))
def test_one_flipped_byte_anywhere_never_crashes_and_never_gives_nan_or_other_numbers(
    tmp_path_factory: pytest.TempPathFactory, whole: bytes, place: float, bits: int
) -> None:
    folder = tmp_path_factory.mktemp("flip", numbered=True)
    data = bytearray(whole)
    data[int(place * len(data))] ^= bits
    full = read(folder, whole)
    try:
        part = read(folder, bytes(data))
    except BrokenRecordingError:
        return
    known = set(full.samples.time.tolist())
    assert set(part.samples.time.tolist()) <= known
    assert not np.isnan(part.samples.depth).any()
    ticks = part.inputs.column("tick") if "tick" in part.inputs.columns else np.zeros(0)
    assert set(ticks.tolist()) <= set(full.inputs.column("tick").tolist())


def test_a_chunk_whose_checksum_is_wrong_is_left_out_and_the_rest_kept(
    tmp_path: Path, whole: bytes
) -> None:
    path = tmp_path / "w.mcap"
    path.write_bytes(whole)
    full = read_recording(path)
    with path.open("rb") as stream:
        chunks = [
            record
            for record in StreamReader(stream, emit_chunks=True).records
            if type(record).__name__ == "Chunk"
        ]
    assert len(chunks) >= 4
    spoilt = bytearray(whole)
    at = whole.index(chunks[1].data)
    spoilt[at - 8 - 4 - len(b"zstd") - 4] ^= 0xFF  # the stored checksum of the second chunk
    part = read(tmp_path, bytes(spoilt))
    assert any("crc" in problem for problem in part.problems)
    assert 0 < len(part.samples.time) < len(full.samples.time)
    assert part.samples.time[0] == full.samples.time[0]
    assert part.samples.time[-1] == full.samples.time[-1]


def test_the_first_chunk_may_be_damaged_because_the_index_repeats_the_channels(
    tmp_path: Path, whole: bytes
) -> None:
    spoilt = bytearray(whole)
    spoilt[whole.index(b"\x28\xb5\x2f\xfd")] ^= 0xFF  # the magic of its zstd frame
    part = read(tmp_path, bytes(spoilt))
    assert any("left out" in problem for problem in part.problems)
    assert len(part.samples.time) > 50


@pytest.mark.parametrize(
    "data", [b"", b"\x89", b"PK\x03\x04" + bytes(500), b"\x00" * 64, bytes(range(256)) * 9]
)
def test_what_is_no_mcap_file_is_refused(tmp_path: Path, data: bytes) -> None:
    with pytest.raises(BrokenRecordingError, match="not an MCAP file"):
        read(tmp_path, data)


def test_an_empty_mcap_file_of_somebody_else_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BrokenRecordingError, match="no session"):
        read(tmp_path, MCAP0_MAGIC + b"\x01" + (8).to_bytes(8, "little") + bytes(8))


def test_a_length_beyond_the_file_does_not_ask_for_memory(tmp_path: Path, whole: bytes) -> None:
    data = whole + b"\x06" + (2**62).to_bytes(8, "little")
    assert read(tmp_path, data).complete
    cut = whole[: len(whole) // 2]
    part = read(tmp_path, cut + b"\x06" + (2**62).to_bytes(8, "little"))
    assert not part.complete


def test_a_folder_and_a_missing_file_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none.mcap"):
        with pytest.raises(BrokenRecordingError, match="cannot read"):
            read_recording(path)


def test_a_record_of_no_length_is_whole(tmp_path: Path) -> None:
    recording = read_recording(write(tmp_path, 0.0))
    assert recording.complete
    assert recording.samples.tip.shape == (0, 3)
    assert recording.inputs.values.shape[0] == 0
    assert recording.attachments["score.json"]


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_pose_that_is_no_number_stands_as_null_in_the_record(tmp_path: Path, bad: float) -> None:
    path = write(tmp_path, 1.0, bad=bad)
    with path.open("rb") as stream:
        for record in StreamReader(stream).records:
            data = getattr(record, "data", b"")
            if type(record).__name__ == "Message" and data[:1] == b"{":
                json.loads(data, parse_constant=pytest.fail)
    recording = read_recording(path)
    assert np.isnan(recording.samples.depth).sum() == 1
    assert len(recording.trajectory()) == len(recording.samples.time) - 1


@settings(derandomize=True, deadline=None, max_examples=100)
@given(
    st.recursive(
        st.one_of(st.floats(), st.integers(), st.text(max_size=5), st.none(), st.booleans()),
        lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
        max_leaves=8,
    )
)
def test_whatever_is_encoded_is_strict_json(document: object) -> None:
    json.loads(encode(document), parse_constant=pytest.fail)


def test_samples_at_equal_times_are_scored_once(tmp_path: Path) -> None:
    clock = VirtualClock(50.0)
    header = SessionHeader("b", WALL, 50.0, "s", "e", metadata={PLAN: plan_record(PLACED)})
    recorder = Recorder(tmp_path, header, clock=clock)
    recorder.open()
    for depth in (0.01, 0.02, 0.03):
        recorder.sample(Sample(50.0, State.INSERTING, pose(50.0, depth), None, np.zeros(3)))
    recorder.finish()
    assert len(read_recording(recorder.status().path).trajectory()) == 1


BAD_MESSAGES = [
    ("/attempt", "timestamp", None),
    ("/attempt", "timestamp", {"sec": "x", "nsec": 0}),
    ("/attempt", "time", 10**400),
    ("/attempt", "time", {}),
    ("/attempt", "state", []),
    ("/attempt", "valid", []),
    ("/attempt", "tip", {"x": 1.0}),
    ("/attempt", "tip", {"x": "a", "y": 0.0, "z": 0.0}),
    ("/events", "data", "x"),
    ("/events", "data", None),
    ("/events", "message", 5),
]


@pytest.mark.parametrize(("topic", "field", "value"), BAD_MESSAGES)
def test_a_message_of_another_shape_is_left_out_and_said(
    tmp_path: Path, topic: str, field: str, value: object
) -> None:
    path = write(tmp_path, 1.0)
    whole = read_recording(path)
    content = scan(path)
    document = json.loads(content.messages[topic][0]) | {field: value}
    clock = VirtualClock(50.0)
    recorder = Recorder(tmp_path, SessionHeader("b", WALL, 50.0, "s-1", "liver-01"), clock=clock)
    recorder.open()
    for data in content.messages[topic]:
        recorder._file.message(topic, 1, data)
    recorder._file.message(topic, 1, json.dumps(document).encode())
    recorder.finish()
    part = read_recording(recorder.status().path)
    assert len(part.samples.time) == (len(whole.samples.time) if topic == "/attempt" else 0)
    assert len(part.events) == (len(whole.events) if topic == "/events" else 0)
    assert any(topic in problem for problem in part.problems)


@pytest.mark.parametrize(
    "change",
    [
        {"version": 2},
        {"scans": math.inf},
        {"student": "\ud800"},
        {"score": {"total": "abc"}},
        {"score": {"total": 1.0, "rows": None}},
        {"score": {"total": 1.0, "rows": [1]}},
        {"score": {"total": 1.0, "rows": [{"name": "x"}]}},
        {"score": [["total", 1.0]]},
    ],
)
def test_a_summary_that_is_not_ours_is_made_again_from_the_record(
    tmp_path: Path, change: dict[str, object]
) -> None:
    path = write(tmp_path, 1.0)
    fresh = read_summary(path)
    path.with_suffix(".json").write_text(json.dumps(fresh.document() | change), encoding="utf-8")
    assert read_summary(path) == fresh
    path.with_suffix(".json").write_text("[" * 100_000, encoding="utf-8")
    assert read_summary(path) == fresh


def test_a_renamed_record_is_listed_by_the_name_that_finds_it(tmp_path: Path) -> None:
    path = write(tmp_path, 1.0)
    path.rename(tmp_path / "renamed.mcap")
    (summary,) = list_sessions(tmp_path)
    assert find(tmp_path, summary.id) == tmp_path / "renamed.mcap"


def test_a_file_in_place_of_the_folder_is_said_to_be_one(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    recorder = Recorder(tmp_path / "file", SessionHeader("a", WALL, 50.0, "s-1", "liver-01"))
    with pytest.raises(RecordingError, match="is a file, not a folder"):
        recorder.open()


# --- columns, blocks and digests of version 2 -----------------------------------------------------
ANY_FLOAT = st.floats(allow_nan=True, allow_infinity=True, allow_subnormal=True, width=64)


def bits(values: FloatArray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=np.float64).view(np.uint64)


@settings(derandomize=True, deadline=None, max_examples=200)
@given(st.lists(st.tuples(ANY_FLOAT, ANY_FLOAT, ANY_FLOAT), min_size=1, max_size=40))
def test_any_numbers_stored_as_columns_come_back_with_every_bit(rows: list[tuple[float]]) -> None:
    values = np.array(rows, dtype=np.float64)
    values = np.hstack((values, values[:, :1], np.full((len(values), 1), -0.0)))
    data = columns.encode(values)
    again, taken = columns.decode(data, *values.shape)
    assert taken == len(data)
    np.testing.assert_array_equal(bits(again), bits(values))


@settings(derandomize=True, deadline=None, max_examples=100)
@given(
    start=st.integers(0, 10**15),
    jitter=st.lists(st.integers(-(10**6), 10**9), min_size=2, max_size=60),
)
def test_times_of_a_clock_in_nanoseconds_come_back_with_every_bit(
    start: int, jitter: list[int]
) -> None:
    values = (start + np.cumsum(jitter))[:, None] * 1e-9
    again, _ = columns.decode(columns.encode(values), *values.shape)
    np.testing.assert_array_equal(bits(again), bits(values))


@settings(derandomize=True, deadline=None, max_examples=150)
@given(cut=st.floats(0.0, 1.0, exclude_max=True), at=st.floats(0.0, 1.0), flip=st.integers(0, 255))
def test_a_block_that_is_cut_or_changed_is_refused_or_read_and_never_crashes(
    cut: float, at: float, flip: int
) -> None:
    rows = np.random.default_rng(4).normal(size=(30, sv.SLOTS))
    rows[:, sv.TICK] = np.arange(1, 31)
    good = blocks.pack(rows, 0)
    with pytest.raises(BrokenRecordingError):
        blocks.unpack(good[: int(cut * len(good))])
    changed = bytearray(good)
    changed[min(int(at * len(good)), len(good) - 1)] ^= flip
    with suppress(BrokenRecordingError):
        assert blocks.unpack(bytes(changed)).values.shape[1] == len(blocks.COLUMNS)


@settings(derandomize=True, deadline=None, max_examples=100)
@given(slot=st.integers(0, sv.SLOTS - 1), bit=st.integers(0, 63))
def test_one_changed_bit_of_any_slot_changes_the_digest(slot: int, bit: int) -> None:
    rows = np.random.default_rng(5).normal(size=(1, sv.SLOTS))
    other = bits(rows).copy()
    other[0, slot] ^= np.uint64(1) << np.uint64(bit)
    same = digests(other.view(np.float64)) == digests(rows)
    assert bool(same[0]) == (slot == sv.TICK_COST)


def test_a_number_that_is_none_in_the_encoders_stays_one_in_the_record() -> None:
    rows = np.zeros((5, sv.SLOTS))
    rows[2, sv.Q_LEFT] = math.nan
    values = blocks.unpack(blocks.pack(rows, 0)).values
    assert np.isnan(values[:, blocks.COLUMNS.index("q_left")]).tolist() == [0, 0, 1, 0, 0]


def test_a_block_of_version_1_still_reads() -> None:
    values = np.arange(12.0).reshape(4, 3)
    head = blocks._HEADER.pack(b"ACUB", 1, 3, 4, 2, 17)
    block = blocks.unpack(head + np.ascontiguousarray(values.T).tobytes())
    np.testing.assert_array_equal(block.values, values)
    assert (block.first_tick, block.lost, len(block.digests), len(block.states)) == (17, 2, 0, 0)


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"ACUC",
        b"ACUX" + bytes(20),
        b"ACUC\x09\x00" + bytes(20),
        b"ACUC\x01\x00\x02\x00\x00\x00{}",
        b"ACUC\x01\x00\x05\x00\x00\x00[1,2]",
        b'ACUC\x01\x00\x29\x00\x00\x00{"tick": 1, "slots": ["a"], "stages": []} ',
        b'ACUC\x01\x00\x31\x00\x00\x00{"tick": 1, "slots": [], "stages": [["a", -5], 3]}',
    ],
)
def test_a_checkpoint_that_is_none_is_refused(data: bytes) -> None:
    with pytest.raises(BrokenRecordingError, match="checkpoint"):
        checkpoint_file.unpack(data)
