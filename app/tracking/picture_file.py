"""Pictures from files as the camera's sensor delivered them."""

import struct
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

_AS_STORED: Final = cv2.IMREAD_COLOR | cv2.IMREAD_IGNORE_ORIENTATION
"""A lens bends the sensor's pixels. A turn that a file's EXIF orientation asks for, for people to
look at, would move them away from the calibration; it changes with how the camera was held."""


def decoded(data: bytes) -> NDArray[np.uint8] | None:
    """Return the pixels of a picture file as they are stored, in colour; None if it is none.

    Raises:
        cv2.error: if the decoder refuses it.
    """
    raw = np.frombuffer(_as_stored(data), dtype=np.uint8)
    image = cv2.imdecode(raw, _AS_STORED) if raw.size else None
    return None if image is None else np.asarray(image, dtype=np.uint8)


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
