"""Pictures from files as the camera's sensor delivered them."""

import struct
from pathlib import Path
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app import MOST_PIXELS
from app.core.files import read_at_most
from app.core.messages import sentence
from app.tracking.errors import TrackingError

LARGEST_PICTURE: Final = 1 << 28
"""No file of a picture is larger [bytes]; one of the most pixels, not compressed, fits."""

_AS_STORED: Final = cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION
"""A lens bends the sensor's pixels. A turn that a file's EXIF orientation asks for, for people to
look at, would move them away from the calibration; it changes with how the camera was held."""


def read_pixels(path: Path) -> NDArray[np.uint8]:
    """Return the pixels of a picture file as they are stored, in colour.

    What its header says to have more pixels than a picture may have is not decoded.

    Raises:
        OSError: if it cannot be read; with EFBIG if it is larger than `LARGEST_PICTURE`.
        TrackingError: if it is no picture, is damaged, or has more pixels than `MOST_PIXELS`; what
            is wrong follows the name of the file.
    """
    raw = np.frombuffer(_as_stored(read_at_most(path, LARGEST_PICTURE)), dtype=np.uint8)
    try:
        image = cv2.imdecode(raw, _AS_STORED) if raw.size else None
    except cv2.error as error:
        if "CV_IO_MAX_IMAGE" in error.err:
            raise TrackingError(_TOO_MANY) from error
        raise TrackingError(sentence("is no picture: {error_err}", error_err=error.err)) from error
    if image is None:
        raise TrackingError(sentence("is no picture or is damaged"))
    check_size(image.shape[1], image.shape[0])  # somebody may have loaded OpenCV before us
    return np.asarray(image, dtype=np.uint8)


_SIDE: Final = round(MOST_PIXELS**0.5)
_TOO_MANY: Final = sentence(
    "has more than {side} x {side} pixels, which are the most: make it smaller, or take it out "
    "of the folder",
    side=_SIDE,
)


def check_size(width: int, height: int) -> None:
    """Raise `TrackingError` for a picture of more pixels than any that is read."""
    if width * height > MOST_PIXELS:
        raise TrackingError(_TOO_MANY)


_ORIENTATION: Final = 274
"""Tag of TIFF 6.0; OpenCV's decoder of TIFF turns the picture by it, whatever the flags."""

_SHORT: Final = 3
"""Type of that tag's value: 16 bits."""


def _as_stored(data: bytes) -> bytes:
    """Return a TIFF file with the orientation of its first picture taken out; others as they are.

    Classic (42) and BigTIFF (43): a header, then a list of entries: tag, type, count, value.
    """
    order = {b"II": "<", b"MM": ">"}.get(data[:2])
    if order is None or len(data) < 16:
        return data
    try:
        version = struct.unpack_from(f"{order}H", data, 2)[0]
        if version not in (42, 43):
            return data
        big = version == 43
        at = struct.unpack_from(f"{order}{'Q' if big else 'I'}", data, 8 if big else 4)[0]
        entries = struct.unpack_from(f"{order}{'Q' if big else 'H'}", data, at)[0]
        size, value = (20, 12) if big else (12, 8)
        first = at + (8 if big else 2)
        for place in range(first, first + size * min(entries, 1000), size):
            tag, kind = struct.unpack_from(f"{order}HH", data, place)
            if tag == _ORIENTATION and kind == _SHORT:
                changed = bytearray(data)
                struct.pack_into(f"{order}H", changed, place + value, 1)
                return bytes(changed)
    except struct.error:  # cut off: the decoder will say so
        return data
    return data


def no_folder(path: Path) -> str:
    """Say that a path is no folder: a file, or not there."""
    return (
        f"{path} is a file" if path.is_file() else sentence("there is no folder {path}", path=path)
    )
