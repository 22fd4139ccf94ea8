"""The form that the value of a kept attribute must have: numbers, words of a list, no free text."""

import math
import re
from typing import Any

from pydicom.multival import MultiValue

from app.imaging.privacy.known_words import is_kernel
from app.imaging.privacy.profile import KeptAttribute

_STANDARD_UID = re.compile(r"1\.2\.840\.10008\.[0-9.]{1,50}")
_LONGEST_NUMBER = 16


def values(value: Any) -> list[Any]:
    """Return the values of an element, one or many, as a list."""
    if isinstance(value, MultiValue | list | tuple):
        return list(value)
    return [] if value is None or value == "" or value == b"" else [value]


def fits(stored: KeptAttribute, value: Any) -> bool:
    """Return whether a value has the form in which its attribute may be kept; dates and ages
    aside.
    """
    found = values(value)
    if stored.kind == "number":
        return all(_is_number(item) for item in found)
    if stored.kind == "uid":
        return all(_STANDARD_UID.fullmatch(str(item)) for item in found)
    if stored.kind == "words":
        return all(str(item).strip() in stored.words for item in found)
    if stored.kind == "kernel":
        return all(is_kernel(str(item)) for item in found)
    return stored.kind == "tag" and all(int(item) >> 16 & 1 == 0 for item in found)


def _is_number(value: Any) -> bool:
    text = str(getattr(value, "original_string", value)).strip()
    try:
        return math.isfinite(float(text)) and (
            len(text) <= _LONGEST_NUMBER or isinstance(value, float)
        )
    except ValueError:
        return False
