"""Text that stands with the pixels, anywhere, does not come into a copy; every pixel does.

Files are written by pydicom, GDCM, OpenJPEG and CharLS, and read back by pydicom's own decoders.
"""

import struct
from datetime import timedelta
from pathlib import Path

import numpy as np
import pydicom
import pytest
from dicom_factory import Slices
from pydicom.dataset import Dataset
from pydicom.encaps import encapsulate, generate_frames
from pydicom.uid import (
    UID,
    DeflatedExplicitVRLittleEndian,
    ExplicitVRBigEndian,
    ExplicitVRLittleEndian,
    ImplicitVRLittleEndian,
    JPEG2000Lossless,
    JPEGLosslessSV1,
    JPEGLSLossless,
    RLELossless,
)

from app.imaging.errors import FileDamagedError
from app.imaging.header_reading import file_headers
from app.imaging.privacy.actions import Rules
from app.imaging.privacy.deidentifying import Secrets, convert, verify
from app.imaging.privacy.profile import profile
from app.imaging.privacy.report import Tally
from app.imaging.privacy.uids import UidMap

TEXT = b"BEHINDZQ"
SHAPE = (40, 56)


def picture(bits: int = 12, signed: bool = False) -> np.ndarray:
    """Return noise on a slope: nothing that a coder can make short."""
    rng = np.random.default_rng(bits + signed)
    row, column = np.indices(SHAPE)
    values = (row * 37 + column * 11 + rng.integers(0, 40, SHAPE)) % (1 << bits)
    if signed:
        values -= 1 << (bits - 1)
    return values.astype("<i2" if signed else "<u2")


def made(folder: Path, values: np.ndarray, stored: int = 12, high: int | None = None) -> Dataset:
    tags = {"BitsStored": stored, "HighBit": stored - 1 if high is None else high}
    (path,) = Slices(shape=SHAPE, offsets=(0.0,), tags=tags, signed=values.dtype.kind == "i").write(
        folder
    )
    dataset = pydicom.dcmread(path)
    dataset.PixelData = values.tobytes()
    return dataset


def encoded(dataset: Dataset, syntax: UID) -> tuple[Dataset, list[bytes]]:
    """Encode a file by somebody else's coder."""
    if syntax == JPEGLosslessSV1:
        import gdcm

        image = dataset.pixel_array
        reader_path = dataset.filename
        dataset.save_as(reader_path)
        reader = gdcm.ImageReader()
        reader.SetFileName(str(reader_path))
        assert reader.Read()
        change = gdcm.ImageChangeTransferSyntax()
        change.SetTransferSyntax(gdcm.TransferSyntax(gdcm.TransferSyntax.JPEGLosslessProcess14_1))
        change.SetInput(reader.GetImage())
        assert change.Change()
        writer = gdcm.ImageWriter()
        writer.SetFileName(str(reader_path))
        writer.SetFile(reader.GetFile())
        writer.SetImage(change.GetOutput())
        assert writer.Write()
        dataset = pydicom.dcmread(reader_path)
        assert np.array_equal(dataset.pixel_array, image)
    else:
        dataset.compress(syntax, generate_instance_uid=False)
    return dataset, list(generate_frames(dataset.PixelData, number_of_frames=1))


def copied(dataset: Dataset, folder: Path, **save) -> tuple[Dataset, bytes, Tally]:
    """Write a file and import it; the copy, its bytes, and what was done."""
    path, to = folder / "in.dcm", folder / "out.dcm"
    dataset.save_as(path, **save)
    header = file_headers(path)[0]
    assert not header.damage
    rules = Rules(profile(), UidMap(b"k"), timedelta(days=-40), "P-1", "CT-00000001")
    secrets, tally = Secrets(profile()), Tally()
    digest = convert(header, to, rules, (), secrets, tally)
    verify(to, secrets, rules.uids.old, digest)
    return pydicom.dcmread(to), to.read_bytes(), tally


def stored_values(dataset: Dataset) -> np.ndarray:
    """Values of the stored bits alone (PS3.5 8.1.1), of what pydicom decodes."""
    values = dataset.pixel_array.astype(np.int64) >> (dataset.HighBit + 1 - dataset.BitsStored)
    values &= (1 << dataset.BitsStored) - 1
    if dataset.PixelRepresentation:
        values -= (values >> (dataset.BitsStored - 1)) << dataset.BitsStored
    return values


NATIVE = [ExplicitVRLittleEndian, ImplicitVRLittleEndian, DeflatedExplicitVRLittleEndian]


@pytest.mark.parametrize("syntax", [*NATIVE, ExplicitVRBigEndian])
@pytest.mark.parametrize("tail", [TEXT, TEXT * 200, b"\0" * 64 + TEXT, TEXT[:4]])
def test_bytes_behind_the_last_pixel_are_left_out(tmp_path, syntax, tail):
    values = picture()
    dataset = made(tmp_path, values)
    if syntax == ExplicitVRBigEndian:
        dataset.PixelData = values.astype(">u2").tobytes()
    dataset.PixelData += tail
    dataset.file_meta.TransferSyntaxUID = syntax
    little = syntax != ExplicitVRBigEndian
    dataset._is_little_endian = dataset._read_little = None
    path = {"implicit_vr": syntax == ImplicitVRLittleEndian, "little_endian": little}
    copy, raw, tally = copied(dataset, tmp_path, **path)
    assert TEXT[:4] not in raw
    assert TEXT[:4] not in copy.PixelData
    assert len(copy.PixelData) == 2 * SHAPE[0] * SHAPE[1]
    assert np.array_equal(copy.pixel_array, values)
    assert tally.stripped == 1
    assert copy.file_meta.TransferSyntaxUID == syntax


@pytest.mark.parametrize("signed", [False, True])
@pytest.mark.parametrize(("stored", "high"), [(12, 11), (10, 9), (15, 14)])
def test_text_in_unused_bits_is_left_out_and_the_stored_values_stay(tmp_path, signed, stored, high):
    values = picture(stored, signed)
    low = high + 1 - stored
    cells = ((values.astype(np.int64) & ((1 << stored) - 1)) << low).astype("<u2").ravel()
    free = np.array([bit for bit in range(16) if not low <= bit <= high])
    bits = np.unpackbits(np.frombuffer(TEXT, np.uint8))
    for bit in free:  # the text, bit by bit, in each unused bit of the first cells
        cells[: bits.size] |= bits.astype("<u2") << np.uint16(bit)
    dataset = made(tmp_path, values, stored, high)
    dataset.PixelData = cells.tobytes()
    before = stored_values(dataset)
    copy, _, tally = copied(dataset, tmp_path)
    assert np.array_equal(stored_values(copy), before)
    new = np.frombuffer(copy.PixelData, "<u2")
    for bit in free:
        if signed and bit > high:  # repeats the sign
            expected = (new >> high) & 1
            assert np.array_equal((new >> bit) & 1, expected)
        else:
            assert not ((new >> bit) & 1).any()
    assert tally.stripped == 1


@pytest.mark.parametrize("extended", [False, True])
def test_signed_values_stay_bit_for_bit_however_their_sign_is_written(tmp_path, extended):
    values = picture(12, signed=True)
    cells = values.view("<u2") & (0xFFFF if extended else 0x0FFF)
    dataset = made(tmp_path, values)
    dataset.PixelData = cells.tobytes()
    copy, _, tally = copied(dataset, tmp_path)
    assert copy.PixelData == cells.tobytes()
    assert tally.stripped == 0


def test_a_padding_value_beyond_the_stored_bits_stays(tmp_path):
    values = picture()
    values[:3] = 63536
    dataset = made(tmp_path, values)
    dataset.add_new(0x00280120, "US", 63536)
    copy, _, _ = copied(dataset, tmp_path)
    assert copy.PixelData == values.tobytes()


def segment(marker: int, body: bytes) -> bytes:
    return struct.pack(">HH", marker, len(body) + 2) + body


def in_front(frame: bytes, part: bytes) -> bytes:
    """Put a segment behind the start of a JPEG frame."""
    return frame[:2] + part + frame[2:]


def before_the_scan(frame: bytes, part: bytes) -> bytes:
    at = frame.index(b"\xff\xda")
    return frame[:at] + part + frame[at:]


JPEG_WAYS = {
    "comment": lambda frame: in_front(frame, segment(0xFFFE, TEXT)),
    "comment before the scan": lambda frame: before_the_scan(frame, segment(0xFFFE, TEXT * 9)),
    "application": lambda frame: in_front(frame, segment(0xFFE1, b"Exif\0\0" + TEXT)),
    "application 8": lambda frame: in_front(frame, segment(0xFFE8, TEXT)),
    "application 0 that is no JFIF": lambda frame: in_front(frame, segment(0xFFE0, TEXT + TEXT)),
    "application 15": lambda frame: before_the_scan(frame, segment(0xFFEF, TEXT)),
    "behind the end": lambda frame: frame.rstrip(b"\0") + TEXT,
    "far behind the end": lambda frame: frame + b"\0" * 30 + TEXT + b"\xff\xd9",
}


@pytest.mark.parametrize("way", JPEG_WAYS)
@pytest.mark.parametrize("syntax", [JPEGLSLossless, JPEGLosslessSV1])
def test_comments_and_the_like_of_jpeg_and_jpeg_ls_are_left_out(tmp_path, syntax, way):
    values = picture()
    dataset, (frame,) = encoded(made(tmp_path, values), syntax)
    spoilt = JPEG_WAYS[way](frame)
    dataset.PixelData = encapsulate([spoilt + b"\0" * (len(spoilt) % 2)])
    copy, raw, tally = copied(dataset, tmp_path)
    assert TEXT not in raw
    assert np.array_equal(copy.pixel_array, values)
    assert tally.stripped == 1
    assert copy.file_meta.TransferSyntaxUID == syntax


def boxed(frame: bytes) -> bytes:
    """Put a code stream into a JP2 file with a box of somebody's own."""

    def box(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">L", len(body) + 8) + kind + body

    head = struct.pack(">LLHBBBB", *SHAPE, 1, 11, 7, 0, 0)
    header = box(b"ihdr", head) + box(b"colr", b"\x01\0\0\0\0\0\x11")
    return (
        box(b"jP  ", b"\r\n\x87\n") + box(b"ftyp", b"jp2 \0\0\0\0jp2 ") + box(b"jp2h", header)
        + box(b"uuid", bytes(16) + TEXT) + box(b"jp2c", frame)
    )  # fmt: skip


def in_the_tile(frame: bytes, part: bytes) -> bytes:
    """Put a segment into the head of the first tile."""
    at = frame.index(b"\xff\x90\x00\x0a")
    size = struct.unpack_from(">L", frame, at + 6)[0]
    start = frame[: at + 6] + struct.pack(">L", size + len(part)) + frame[at + 10 : at + 12]
    return start + part + frame[at + 12 :]


J2K_WAYS = {
    "comment": lambda frame: (
        frame[: frame.index(b"\xff\x90")]
        + segment(0xFF64, b"\0\x01" + TEXT)
        + frame[frame.index(b"\xff\x90") :]
    ),
    "comment of bytes": lambda frame: (
        frame[: frame.index(b"\xff\x90")]
        + segment(0xFF64, b"\0\0" + TEXT * 5)
        + frame[frame.index(b"\xff\x90") :]
    ),
    "comment of a tile": lambda frame: in_the_tile(frame, segment(0xFF64, b"\0\x01" + TEXT)),
    "behind the end": lambda frame: frame.rstrip(b"\0") + TEXT,
    "box": boxed,
}


@pytest.mark.parametrize("way", J2K_WAYS)
def test_comments_and_the_like_of_jpeg_2000_are_left_out(tmp_path, way):
    values = picture()
    dataset, (frame,) = encoded(made(tmp_path, values), JPEG2000Lossless)
    spoilt = J2K_WAYS[way](frame.rstrip(b"\0") if way == "box" else frame)
    dataset.PixelData = encapsulate([spoilt + b"\0" * (len(spoilt) % 2)])
    copy, raw, tally = copied(dataset, tmp_path)
    assert TEXT not in raw
    assert np.array_equal(copy.pixel_array, values)
    assert tally.stripped == 1


RLE_WAYS = {
    "behind the end": lambda frame: frame + TEXT,
    "unused offsets": lambda frame: frame[:40] + TEXT + frame[48:],
    "between head and segment": lambda frame: (
        struct.pack("<LLL", 2, *(8 + at for at in struct.unpack_from("<LL", frame, 4)))
        + frame[12:64] + TEXT + frame[64:]
    ),
}  # fmt: skip


@pytest.mark.parametrize("way", RLE_WAYS)
def test_what_rle_passes_over_is_left_out_or_the_file_refused(tmp_path, way):
    values = picture()
    dataset, (frame,) = encoded(made(tmp_path, values), RLELossless)
    dataset.PixelData = encapsulate([RLE_WAYS[way](frame)])
    if way != "behind the end":  # no decoder takes these
        with pytest.raises(FileDamagedError):
            copied(dataset, tmp_path)
        return
    copy, raw, tally = copied(dataset, tmp_path)
    assert TEXT not in raw
    assert np.array_equal(copy.pixel_array, values)
    assert tally.stripped == 1


@pytest.mark.parametrize("syntax", [JPEGLSLossless, JPEG2000Lossless, RLELossless, JPEGLosslessSV1])
def test_text_in_the_offset_table_is_left_out_and_a_tidy_file_is_copied_bit_for_bit(
    tmp_path, syntax
):
    values = picture()
    dataset, (frame,) = encoded(made(tmp_path, values), syntax)
    tidy = dataset.PixelData
    copy, raw, tally = copied(dataset, tmp_path)
    assert copy.PixelData == tidy
    assert tally.stripped == 0
    table = struct.pack("<HHL", 0xFFFE, 0xE000, 8) + TEXT
    dataset.PixelData = table + struct.pack("<HHL", 0xFFFE, 0xE000, len(frame)) + frame
    copy, raw, tally = copied(dataset, tmp_path)
    assert TEXT not in raw
    assert np.array_equal(copy.pixel_array, values)
    assert tally.stripped == 1


@pytest.mark.parametrize("signed", [False, True])
@pytest.mark.parametrize("syntax", [RLELossless, JPEGLosslessSV1, JPEGLSLossless, JPEG2000Lossless])
def test_text_in_unused_bits_of_encoded_pixels_is_left_out(tmp_path, syntax, signed):
    values = picture(12, signed)
    cells = (values.view("<u2") & 0x0FFF).ravel()
    letters = np.unpackbits(np.frombuffer(TEXT, np.uint8)).astype("<u2")
    cells[: letters.size] |= letters << np.uint16(15)
    dataset = made(tmp_path, values, 16)
    dataset.PixelRepresentation = 0
    dataset.PixelData = cells.tobytes()
    dataset, _ = encoded(dataset, syntax)
    dataset.BitsStored, dataset.HighBit, dataset.PixelRepresentation = 12, 11, int(signed)
    if syntax in (JPEGLSLossless, JPEG2000Lossless):  # theirs are values unless they are overlays
        dataset.add_new(0x60000102, "US", 15)
    copy, _, tally = copied(dataset, tmp_path)
    assert np.array_equal(stored_values(copy), values)
    assert copy.pixel_array.max() < 0x1000
    assert copy.pixel_array.min() >= (-0x800 if signed else 0)
    assert tally.stripped == 1


def test_text_anywhere_else_in_the_file_is_left_out(tmp_path):
    dataset = made(tmp_path, picture())
    icon = Dataset()
    icon.Rows, icon.Columns, icon.BitsAllocated = 4, 4, 8
    icon.PixelData = TEXT * 2
    dataset.IconImageSequence = [icon]
    inner = Dataset()
    inner.ImageComments = TEXT.decode()
    inner.add_new(0x00091001, "UN", TEXT)
    dataset.PixelMeasuresSequence = [inner]
    block = dataset.private_block(0x11, "SOMEBODY", create=True)
    block.add_new(1, "OB", TEXT)
    dataset.add_new(0xFFFCFFFC, "OB", TEXT)
    dataset.preamble = TEXT * 16
    dataset.file_meta.PrivateInformationCreatorUID = "1.2.3"
    dataset.file_meta.PrivateInformation = TEXT
    path = tmp_path / "in.dcm"
    dataset.save_as(path)
    path.write_bytes(path.read_bytes() + TEXT)
    copy, raw, _ = copied(pydicom.dcmread(path), tmp_path)
    assert TEXT not in raw
    assert copy.preamble == b"\0" * 128
