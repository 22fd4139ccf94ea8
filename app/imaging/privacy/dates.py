"""Dates moved by one offset per patient, ages capped: intervals stay, days do not."""

import re
from datetime import date, timedelta

from app.imaging.privacy.key import derived

_LONGEST = 3650
_SHORTEST = 30
_DATE = re.compile(r"(\d{4})[.]?(\d{2})[.]?(\d{2})")
_AGE = re.compile(r"(\d{3})([DWMY])")
OLDEST = 89
"""Years; who is older is one of few (the limit that HIPAA's safe harbour sets)."""


def shift_of(key: bytes, patient_id: str, study_uid: str) -> timedelta:
    """Offset of a patient's dates: 30 to 3650 days back, the same at every import."""
    digest = derived(key, "dates", patient_id or f"study {study_uid}")
    span = _LONGEST - _SHORTEST + 1
    return -timedelta(days=_SHORTEST + int.from_bytes(digest[:8], "big") % span)


def shifted(value: str, shift: timedelta) -> str:
    """Return the moved DICOM date (PS3.5 DA); empty for one that is empty or cannot be read."""
    match = _DATE.fullmatch(value.strip())
    if match is None:
        return ""
    try:
        moved = date(*(int(part) for part in match.groups())) + shift
    except (ValueError, OverflowError):
        return ""
    return f"{moved.year:04d}{moved.month:02d}{moved.day:02d}"


def capped_age(value: str) -> str:
    """DICOM age (PS3.5 AS), above 89 years written as `090Y`; empty for one that is none."""
    match = _AGE.fullmatch(value.strip())
    if match is None:
        return ""
    days = {"D": 1.0, "W": 7.0, "M": 30.44, "Y": 365.25}[match[2]]
    years = int(match[1]) * days / 365.25
    return "090Y" if years > OLDEST else match[0]
