"""The quick reader of standard headers: it says what pydicom says, or leaves the file to it."""

import io
import random
import subprocess
import sys
import warnings
from pathlib import Path

import pydicom
import pytest
from pydicom.data import DATA_ROOT
from pydicom.dataset import Dataset

from app.imaging import element_reading
from app.imaging.element_reading import (
    NotStandardError,
    Walk,
    read_by_pydicom,
    read_elements,
    read_standard,
)
from app.imaging.elements import TAG_LIST
from app.imaging.errors import FileDamagedError
from tests.imaging.dicom_factory import Slices

FILES = [
    file
    for file in sorted(Path(DATA_ROOT, "test_files").rglob("*"))
    if file.is_file() and file.stat().st_size < 1 << 20
]
_PREAMBLE = 132


def both(data):
    """What the quick reader says, None where it does not vouch for it, and what pydicom says."""
    stream, other = io.BytesIO(data), io.BytesIO(data)
    try:
        quick = said(read_standard(stream, frozenset(TAG_LIST)), stream)
    except NotStandardError:
        return None, None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return quick, said(read_by_pydicom(other, TAG_LIST, False), other)


def said(found, stream):
    values = {
        int(tag): (element.VR, element.value or b"")
        for tag, element in found.values.items()
        if tag in TAG_LIST
    }
    return values, found.syntax, found.start, (found.inflated or stream).tell()


def test_a_sound_header_is_read_as_pydicom_reads_it():
    sound = 0
    for file in FILES:
        data = file.read_bytes()
        if data[_PREAMBLE - 4 : _PREAMBLE] == b"DICM":
            quick, slow = both(data)
            assert quick == slow, file.name
            sound += quick is not None
    assert sound > 80


def test_a_spoilt_header_is_read_as_pydicom_reads_it_or_left_to_it():
    """Where pydicom stumbles over an element that nobody wants, the quick reader may pass it."""
    draw = random.Random(5)
    names = ("CT_small.dcm", "MR_small_implicit.dcm", "693_J2KR.dcm", "JPEG2000.dcm")
    files = [file.read_bytes() for file in FILES if file.name in names]
    vouched = 0
    for _ in range(800):
        data = bytearray(draw.choice(files))
        at = draw.randrange(_PREAMBLE, min(len(data), 3000))
        if draw.random() < 0.6:
            data[at] ^= 1 << draw.randrange(8)
        else:
            data[at : at + draw.randrange(4)] = draw.randbytes(draw.randrange(4))
        try:
            quick, slow = both(bytes(data))
        except ValueError:
            continue
        assert quick == slow
        vouched += quick is not None
    assert vouched > 100


def test_what_is_nested_in_sequences_is_passed_over_whatever_marks_its_end(tmp_path):
    inner = Dataset()
    inner.Rows = 77
    inner.SeriesInstanceUID = "1.2.3"
    middle = Dataset()
    middle.RequestAttributesSequence = [inner, inner]
    middle.is_undefined_length_sequence_item = True
    (path,) = Slices(offsets=(0.0,)).write(tmp_path)
    for explicit in (True, False):
        data = pydicom.dcmread(path)
        data.ReferencedStudySequence = [middle, inner]
        data["ReferencedStudySequence"].is_undefined_length = True
        data.file_meta.TransferSyntaxUID = f"1.2.840.10008.1.2{'.1' if explicit else ''}"
        whole = io.BytesIO()
        pydicom.dcmwrite(whole, data, enforce_file_format=True, implicit_vr=not explicit)
        quick, slow = both(whole.getvalue())
        assert quick == slow
        assert quick is not None
        assert quick[0][0x0020000E][1].rstrip(b"\0").decode() == data.SeriesInstanceUID


@pytest.mark.parametrize("cut", [140, 300, 700])
def test_a_header_that_ends_too_early_is_not_vouched_for(tmp_path, cut):
    (path,) = Slices(offsets=(0.0,)).write(tmp_path)
    with pytest.raises(NotStandardError):
        read_standard(io.BytesIO(path.read_bytes()[:cut]), frozenset(TAG_LIST))


def test_values_across_the_borders_of_what_is_read_at_once_are_whole(tmp_path, monkeypatch):
    (path,) = Slices(offsets=(0.0,)).write(tmp_path)
    whole, _ = both(path.read_bytes())
    for chunk in (12, 13, 29, 64):
        monkeypatch.setattr(element_reading, "_CHUNK", chunk)
        assert both(path.read_bytes())[0] == whole


def test_sequences_nested_without_end_are_given_up():
    item = b"\xfe\xff\x00\xe0\xff\xff\xff\xff"
    nested = b"\x08\x00\x10\x11SQ\0\0\xff\xff\xff\xff" + item
    walk = Walk(io.BytesIO(nested * 200_000), 0)
    with pytest.raises(NotStandardError):
        walk.take(frozenset((0x00080018,)), False, 0x00080000, 0x7FE00008)


def test_what_pydicom_cannot_read_either_is_damaged(tmp_path):
    file = tmp_path / "file"
    file.write_bytes(bytes(128) + b"DICM" + b"\x08\0\x16\0SQ" + b"\0\0" + b"\xff" * 40)
    with file.open("rb") as stream, pytest.raises(FileDamagedError, match="header cannot be read"):
        read_elements(stream, TAG_LIST, forced=False)


def test_sound_headers_need_neither_pydicom_nor_numpy(tmp_path):
    (file,) = Slices(offsets=(0.0,)).write(tmp_path)
    program = (
        "import sys; from pathlib import Path; import app.imaging.worker.child;"
        "from app.core.progress import Progress; from app.imaging.header_reading import headers_in;"
        "found = headers_in(Path(sys.argv[1]), Path(sys.argv[2]), Progress());"
        "heavy = ('pydicom', 'numpy', 'pydantic', 'yaml', 'scipy', 'nibabel', 'highdicom', 'gdcm');"
        "print(len(found), [name for name in heavy if name in sys.modules])"
    )
    command = [sys.executable, "-c", program, str(file), str(tmp_path / "settings")]
    root = Path(__file__).resolve().parents[2]
    done = subprocess.run(command, capture_output=True, cwd=root, text=True, check=True)
    assert done.stdout.strip() == "1 []"
