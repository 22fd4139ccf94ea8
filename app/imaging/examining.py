"""What one file holds: the headers of its images, or why it belongs to no series."""

import importlib
import os
import stat
import struct
import sys
from pathlib import Path
from typing import BinaryIO

from app.core.progress import Progress
from app.imaging.element_walk import OddError
from app.imaging.errors import FileDamagedError
from app.imaging.header import SliceHeader
from app.imaging.header_reading import read_headers
from app.imaging.series import Ignored

_WITH_PYDICOM = ("app.imaging.odd_elements", "app.imaging.enhanced")
"""What reads headers with pydicom, which takes half a second to load."""

_PREAMBLE = 132
_FIRST_GROUPS = (0x0002, 0x0008)
_DICOMDIR = b"1.2.840.10008.1.3.10"


def headers_in(path: Path, settings: Path, progress: Progress) -> tuple[SliceHeader, ...] | Ignored:
    """Job of the worker: `examine` with the key of the pseudonyms of these settings."""
    os.environ["ACUS_SETTINGS"] = str(settings)
    if all(module in sys.modules for module in _WITH_PYDICOM):
        return examine(path)
    try:
        return examine(path, sound=True)
    except OddError:
        for module in _WITH_PYDICOM:
            importlib.import_module(module)
        progress.report(0.0, "pydicom is loaded")  # its time is not the file's
        return examine(path)


def examine(path: Path, sound: bool = False) -> tuple[SliceHeader, ...] | Ignored:
    """Read the headers of one file: an image, or each frame of it; or why it holds none.

    Whatever stands in the file ends in one of the two; nothing else is raised.

    Args:
        path: the file.
        sound: only if it can be done without pydicom.

    Raises:
        OddError: if only what is sound was asked for, and this is not.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):  # opening a pipe would wait for ever
            return Ignored(path, "not a regular file")
        with path.open("rb") as stream:
            return _read(path, stream, sound)
    except OSError as error:
        return Ignored(path, f"cannot be read: {_why(error)}")
    except FileDamagedError as error:
        return Ignored(path, f"damaged DICOM file: {error}")


def _read(path: Path, stream: BinaryIO, sound: bool) -> tuple[SliceHeader, ...] | Ignored:
    head = stream.read(512)
    preamble = head[_PREAMBLE - 4 : _PREAMBLE] == b"DICM"
    if not preamble and not starts_like_dicom(head):
        return Ignored(path, "empty file" if not head else "not a DICOM file")
    if _DICOMDIR in head:
        return Ignored(path, "DICOM directory (DICOMDIR), not an image")
    stream.seek(0)
    headers = read_headers(path, stream, forced=not preamble, sound=sound)
    if not headers:
        what = "DICOM, but truncated or of no series (no SeriesInstanceUID)"
        return Ignored(path, what if preamble else "not a DICOM file")
    return headers


def starts_like_dicom(head: bytes) -> bool:
    """Whether bytes without a preamble start like a data set: a low group, a VR or a length."""
    if len(head) < 16:
        return False
    for order in "<>":
        group, element, length = struct.unpack_from(order + "HHL", head)
        if group in _FIRST_GROUPS and element <= 0x0100:
            explicit = head[4:6].isalpha() and head[4:6].isupper()
            if explicit or length < 4096:
                return True
    return False


def _why(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error)
