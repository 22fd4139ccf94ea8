"""A few hundred mutated files with a fixed seed; ten thousand are `make fuzz`."""

import io
from pathlib import Path

import numpy as np
import pydicom
import pytest

from app.imaging.errors import FileDamagedError
from app.imaging.examining import examine
from app.imaging.filling import filled
from app.imaging.reading import load_ct
from tests.fuzz.campaign import MOST_CHILD_BYTES, campaign
from tests.fuzz.seeds import MIDDLE, Seed, bomb, seeds


@pytest.fixture(scope="module")
def known(tmp_path_factory):
    return {seed.name: seed for seed in seeds(tmp_path_factory.mktemp("seeds"))}


@pytest.mark.filterwarnings("ignore")  # what pydicom says of a value while it writes the seeds
def test_mutated_files_end_in_a_named_error_or_a_right_volume(tmp_path):
    tally = campaign(tmp_path, 300, seed=2024)
    assert tally.wrong == []
    assert tally.outcomes["volume"] > 20
    assert tally.child_bytes < MOST_CHILD_BYTES


NAMES = (
    "explicit", "implicit", "big endian", "deflated", "RLE", "JPEG-LS", "JPEG 2000",
    "JPEG lossless", "no preamble",
)  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_every_lossless_encoding_is_read_to_the_same_voxels(tmp_path, known, name):
    seed: Seed = known[name]
    for k, data in enumerate(seed.files):
        (tmp_path / f"s{k}").write_bytes(data)
    volume = load_ct(tmp_path)
    assert volume.hu.dtype == np.int16
    np.testing.assert_array_equal(volume.hu, seed.hu)


def test_a_deflate_bomb_is_read_no_further_than_its_header_says(tmp_path, known):
    path = Path(tmp_path, "bomb")
    path.write_bytes(bomb(known["deflated"].files[MIDDLE], 64))
    (header,) = examine(path)
    assert header.damage == ""
    np.testing.assert_array_equal(
        filled([header], np.dtype(np.int16))[0], known["deflated"].hu[MIDDLE]
    )


def test_a_picture_larger_than_its_header_says_is_refused_at_the_scan(tmp_path, known):
    path = Path(tmp_path, "large")
    for name in ("JPEG-LS", "JPEG 2000", "JPEG lossless"):
        file = pydicom.dcmread(io.BytesIO(known[name].files[0]))
        file.Rows = 16
        file.save_as(path, enforce_file_format=True)
        (header,) = examine(path)
        assert "its compressed picture is 32 × 32, its header says 32 × 16" in header.damage


def test_an_unknown_transfer_syntax_is_refused_by_name_at_the_scan(tmp_path, known):
    path = Path(tmp_path, "film")
    data = known["RLE"].files[0].replace(b"1.2.840.10008.1.2.5\0", b"1.2.840.10008.1.2.4.100\0")
    start = data.index(b"UI\x14\x001.2.840.10008.1.2.4.100")
    data = data[: start + 2] + b"\x18\0" + data[start + 4 :]
    path.write_bytes(data)
    (header,) = examine(path)
    assert "no decoder for transfer syntax 1.2.840.10008.1.2.4.100 (MPEG2" in header.damage


def test_compressed_pixels_cut_short_are_told_at_the_scan(tmp_path, known):
    path = Path(tmp_path, "cut")
    for name in ("RLE", "JPEG-LS", "JPEG 2000", "JPEG lossless"):
        path.write_bytes(known[name].files[0][:-40])
        (header,) = examine(path)
        assert header.damage
        with pytest.raises(FileDamagedError):
            filled([header], np.dtype(np.int16))
