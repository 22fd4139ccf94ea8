"""A few hundred mutated files with a fixed seed; ten thousand are `make fuzz`."""

import io
import random
from pathlib import Path

import numpy as np
import pydicom
import pytest

from app.core.errors import AcusError
from app.imaging.errors import FileDamagedError, WorkerLostError
from app.imaging.filling import filled
from app.imaging.header_reading import file_headers
from app.imaging.reading import load_ct
from tests.fuzz.archives import archives
from tests.fuzz.campaign import MOST_CHILD_BYTES, campaign
from tests.fuzz.documents import documents
from tests.fuzz.seeds import MIDDLE, Seed, bomb, seeds


@pytest.fixture(scope="module")
def known(tmp_path_factory):
    return {seed.name: seed for seed in seeds(tmp_path_factory.mktemp("seeds"))}


@pytest.mark.long("journey")
@pytest.mark.filterwarnings("ignore")  # what pydicom says of a value while it writes the seeds
def test_mutated_files_of_every_kind_end_in_a_named_error_or_something_right(tmp_path):
    tally = campaign(tmp_path, 420, seed=2024)
    assert tally.wrong == []
    assert tally.lost == []
    assert tally.outcomes["right"] > 60
    assert tally.child_bytes < MOST_CHILD_BYTES


@pytest.mark.long("journey")
def test_every_kind_of_file_that_the_program_reads_itself_has_its_place(tmp_path):
    names = {name for name, *_ in documents(tmp_path)}
    assert names >= {
        "calibration", "lens", "history", "ICube pair", "ROS pair", "OpenCV yml", "OpenCV xml",
        "OpenCV json", "rig", "device", "plate", "exercise", "pen profile", "pen settings", "plan",
        "transform", "URDF", "points.csv", "points.yaml", "record", "sidecar",
    }  # fmt: skip
    assert sum(name.startswith("TemugeB") for name in names) == 2


@pytest.mark.long("journey")
def test_rle_that_makes_its_decoder_panic_is_refused_by_name(tmp_path, known):
    path, seed = tmp_path / "panic", known["RLE"]
    whole = seed.files[MIDDLE]
    start = whole.index(b"\xfe\xff\x00\xe0", whole.index(b"\xe0\x7f\x10\x00")) + 8
    start = whole.index(b"\xfe\xff\x00\xe0", start) + 8
    dice, panicked = random.Random(3), 0
    for _ in range(60):
        data = bytearray(whole)
        data[start + 64 : start + 400] = dice.randbytes(336)
        path.write_bytes(data)
        (header,) = file_headers(path)
        try:
            filled([header], np.dtype(np.int16))
        except WorkerLostError:
            raise
        except FileDamagedError as error:
            panicked += "PanicException in pylibjpeg-rle" in str(error)
    assert panicked


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
    (header,) = file_headers(path)
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
        (header,) = file_headers(path)
        assert "its compressed picture is 32 × 32, its header says 32 × 16" in header.damage


def test_an_unknown_transfer_syntax_is_refused_by_name_at_the_scan(tmp_path, known):
    path = Path(tmp_path, "film")
    data = known["RLE"].files[0].replace(b"1.2.840.10008.1.2.5\0", b"1.2.840.10008.1.2.4.100\0")
    start = data.index(b"UI\x14\x001.2.840.10008.1.2.4.100")
    data = data[: start + 2] + b"\x18\0" + data[start + 4 :]
    path.write_bytes(data)
    (header,) = file_headers(path)
    assert "no decoder for transfer syntax 1.2.840.10008.1.2.4.100 (MPEG2" in header.damage


def test_compressed_pixels_cut_short_are_told_at_the_scan(tmp_path, known):
    path = Path(tmp_path, "cut")
    for name in ("RLE", "JPEG-LS", "JPEG 2000", "JPEG lossless"):
        path.write_bytes(known[name].files[0][:-40])
        (header,) = file_headers(path)
        assert header.damage
        with pytest.raises(FileDamagedError):
            filled([header], np.dtype(np.int16))


@pytest.mark.long("journey")
def test_archives_and_records_of_the_programs_own_have_their_place(tmp_path):
    names = {name for name, *_ in archives(tmp_path)}
    assert names == {
        "acusx", "list of an acusx", "exercise of an acusx", "backup", "list of a backup",
        "people of a backup", "names of a backup", "block of a record", "event of a record",
        "metadata of a record",
    }  # fmt: skip


@pytest.mark.long("journey")
def test_a_piece_that_is_cut_out_of_an_exercises_file_anywhere_is_a_named_error(tmp_path):
    kind = next(one for one in archives(tmp_path / "made") if one[0] == "acusx")
    _, whole, lay, read = kind
    seen = set()
    for start in range(0, len(whole), max(1, len(whole) // 60)):
        at = tmp_path / str(start)
        at.mkdir()
        lay(at, whole[:start] + whole[start + 100 :])
        with pytest.raises(AcusError) as error:
            read(at)
        seen.add(str(error.value).split(" (")[0].rpartition(":")[2])
    assert seen


@pytest.mark.long("journey")
def test_a_backup_whose_list_of_people_is_no_utf_8_is_a_named_error(tmp_path):
    kind = next(one for one in archives(tmp_path / "made") if one[0] == "people of a backup")
    _, whole, lay, read = kind
    for number, name in enumerate((b"persons", b"pseudonym", b"Ada")):
        at = tmp_path / str(number)
        at.mkdir()
        lay(at, whole.replace(name, b"\xff" * len(name)))
        with pytest.raises(AcusError):
            read(at)
