"""What people must say of files that leave it out: the unit of lengths, the size of pictures."""

import re
from typing import Final

from app.tracking.calibration.boards import UNITS
from app.tracking.errors import CalibrationError

_UNITS: Final = UNITS | {"in": 0.0254}


def length(text: str) -> float:
    """Metres of a length with its unit, such as `1cm`.

    Raises:
        CalibrationError: if it is none.
    """
    found = re.fullmatch(r"(\d+(?:\.\d*)?|\.\d+)\s*(mm|cm|m|in)", text.strip())
    if found is None:
        raise CalibrationError(
            f"--unit {text}: a length with its unit is needed, e.g. 1cm or 25.4mm"
        )
    return float(found[1]) * _UNITS[found[2]]


def picture_size(text: str) -> tuple[int, int]:
    """Width and height [px] of `1280x720`.

    Raises:
        CalibrationError: if it is none.
    """
    found = re.fullmatch(r"(\d{2,5})[xX×](\d{2,5})", text.strip())
    if found is None:
        raise CalibrationError(f"--size {text}: WIDTHxHEIGHT in pixels is needed, e.g. 1280x720")
    return int(found[1]), int(found[2])
