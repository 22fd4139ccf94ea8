"""Columns, blocks, digests and checkpoints: every bit comes back, or it is said why not."""

import math
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.session import blocks, checkpoint_file, columns
from app.session.budget import ReadingBudget
from app.session.digest import digests
from app.session.errors import BrokenRecordingError

ANY_FLOAT = st.floats(allow_nan=True, allow_infinity=True, allow_subnormal=True, width=64)


def budget() -> ReadingBudget:
    return ReadingBudget("a.mcap", 1 << 20)


def bits(values: FloatArray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=np.float64).view(np.uint64)


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=200)
@given(st.lists(st.tuples(ANY_FLOAT, ANY_FLOAT, ANY_FLOAT), min_size=1, max_size=40))
def test_any_numbers_stored_as_columns_come_back_with_every_bit(rows: list[tuple[float]]) -> None:
    values = np.array(rows, dtype=np.float64)
    values = np.hstack((values, values[:, :1], np.full((len(values), 1), -0.0)))
    data = columns.encode(values)
    again, taken = columns.decode(data, *values.shape, budget())
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
    again, _ = columns.decode(columns.encode(values), *values.shape, budget())
    np.testing.assert_array_equal(bits(again), bits(values))


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=150)
@given(cut=st.floats(0.0, 1.0, exclude_max=True), at=st.floats(0.0, 1.0), flip=st.integers(0, 255))
def test_a_block_that_is_cut_or_changed_is_refused_or_read_and_never_crashes(
    cut: float, at: float, flip: int
) -> None:
    rows = np.random.default_rng(4).normal(size=(30, sv.SLOTS))
    rows[:, sv.TICK] = np.arange(1, 31)
    good = blocks.pack(rows, 0)
    with pytest.raises(BrokenRecordingError):
        blocks.unpack(good[: int(cut * len(good))], budget())
    changed = bytearray(good)
    changed[min(int(at * len(good)), len(good) - 1)] ^= flip
    with suppress(BrokenRecordingError):
        assert blocks.unpack(bytes(changed), budget()).values.shape[1] == len(blocks.COLUMNS)


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
    values = blocks.unpack(blocks.pack(rows, 0), budget()).values
    assert np.isnan(values[:, blocks.COLUMNS.index("q_left")]).tolist() == [0, 0, 1, 0, 0]


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
