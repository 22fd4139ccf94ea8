"""What a volume needs, what there is, and what the volumes that are open give back."""

import gc

import numpy as np
import pytest

from app.core.arrays import read_only
from app.imaging import memory
from app.imaging.errors import TooLargeError
from app.imaging.reading import load_ct, read_series, read_with
from app.imaging.rescaling import fresh_array
from app.imaging.scanning import scan_folder
from tests.imaging.dicom_factory import Slices

VOXELS = 5 * 12 * 16
BEYOND = np.full((12, 16), 60000, "<u2").tobytes()


@pytest.fixture
def room(monkeypatch):
    """Set what is free, and what is open, whatever other tests keep."""

    def give(free, held=0):
        monkeypatch.setattr(memory, "available", lambda: free)
        monkeypatch.setattr(memory, "open_bytes", lambda: held)

    return give


def test_a_series_whose_values_are_no_whole_numbers_needs_four_bytes_a_voxel(tmp_path, room):
    Slices(tags={"RescaleSlope": "1.3"}).write(tmp_path)
    assert load_ct(tmp_path).hu.dtype == np.float32
    two, four = (int(VOXELS * n * memory.WORKING_COPIES / memory.SHARE) + 2 for n in (2, 4))
    for free, usable in ((two, False), (four, True)):
        room(free)
        (series,) = scan_folder(tmp_path).series
        assert series.usable is usable
        assert series.remedy == ("none" if usable else "halve")


def test_values_that_turn_out_to_need_four_bytes_are_looked_at_again(tmp_path, room):
    Slices(tags={"PixelData": BEYOND}).write(tmp_path)
    room(int(VOXELS * 2 * memory.WORKING_COPIES / memory.SHARE) + 2)
    (series,) = scan_folder(tmp_path).series
    assert series.usable
    with pytest.raises(TooLargeError, match=r"values beyond 16 bits and needs .* ask to halve it"):
        read_series(series)
    halved = read_with(series, "halve")
    assert halved.hu.dtype == np.float32
    assert halved.hu.size < VOXELS
    assert np.all(halved.hu == 60000 - 1024)


def test_what_is_open_is_in_the_way_while_a_volume_is_read_and_gone_afterwards(room):
    size = (100, 100, 100)
    volume = 2_000_000
    beside = volume / memory.SHARE
    room(int(beside) + 1)
    assert memory.need_of(size, 2).factors == (2, 2, 1)  # nothing is given back afterwards
    room(int(beside) + 1, held=volume)
    assert memory.need_of(size, 2).factors == (1, 1, 1)
    room(int(beside) - 1, held=100 * volume)
    need = memory.need_of(size, 2)
    assert need.factors == (2, 2, 1)  # there is no room for both
    assert "free beside the 0.2 GB of what is open" in need.reason


def is_open(size):
    """Whether a volume of so many bytes is open; other tests keep volumes of other sizes."""
    gc.collect()
    return size in memory._held.values()


def test_a_volume_counts_as_open_as_long_as_anybody_looks_at_it():
    array = fresh_array((4, 61, 67), np.dtype(np.int16))
    size = array.nbytes
    assert not is_open(size)
    memory.hold(array)
    kept = read_only(array)[1:2]
    del array
    assert is_open(size)
    assert memory.open_bytes() >= size
    del kept
    assert not is_open(size)


def test_a_volume_that_was_read_is_open_until_it_is_let_go(tmp_path):
    Slices(shape=(13, 19)).write(tmp_path)
    volume = load_ct(tmp_path)
    size = volume.hu.nbytes
    assert is_open(size)
    del volume
    assert not is_open(size)


def test_a_machine_that_does_not_say_what_is_free_gets_no_warning(room):
    room(None)
    assert memory.need_of((10_000, 10_000, 10_000), 4).reason == ""
