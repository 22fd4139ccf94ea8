"""Records that are cut off, damaged or no records at all: what is whole is kept."""

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hard.recording_rig import assert_prefix, read, write
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.stream_reader import StreamReader
from mcap.writer import MCAP0_MAGIC

from app.session.errors import BrokenRecordingError
from app.session.recording import Recording, read_recording
from app.session.sidecar import read_summary


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return write(tmp_path_factory.mktemp("whole"), 2.5).read_bytes()


@pytest.fixture(scope="module")
def full(tmp_path_factory: pytest.TempPathFactory, whole: bytes) -> Recording:
    return read(tmp_path_factory.mktemp("full"), whole)


@pytest.mark.long("statistics")
def test_a_file_cut_off_anywhere_gives_its_beginning_or_says_why_not(
    tmp_path: Path, whole: bytes, full: Recording
) -> None:
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


@pytest.mark.long("statistics")
def test_every_cut_file_has_a_summary(tmp_path: Path, whole: bytes) -> None:
    path = tmp_path / "cut.mcap"
    for length in range(0, len(whole), 601):
        path.write_bytes(whole[:length])
        assert read_summary(path).state in ("broken", "unfinished")


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=60)
@given(place=st.floats(0.0, 1.0, exclude_max=True), bits=st.integers(1, 255))
def test_one_flipped_byte_anywhere_never_crashes_and_never_gives_nan_or_other_numbers(
    tmp_path_factory: pytest.TempPathFactory,
    whole: bytes,
    full: Recording,
    place: float,
    bits: int,
) -> None:
    folder = tmp_path_factory.mktemp("flip", numbered=True)
    data = bytearray(whole)
    data[int(place * len(data))] ^= bits
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
