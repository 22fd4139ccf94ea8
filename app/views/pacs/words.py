"""Names and dates of a PACS as people write them, both ways (DICOM PS3.5, 6.2: PN and DA)."""

from __future__ import annotations

import re
from datetime import date, datetime
from typing import Final

from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.views.kit.text import day

_FORMS: Final = ("%Y%m%d", "%Y-%m-%d", "%d.%m.%Y", "%d/%m/%Y")
"""Ways to write a date that everybody may use; none of them can be taken for another."""

_DAY: Final = r"(?:\d{8}|\d{4}-\d{1,2}-\d{1,2}|\d{1,2}[./]\d{1,2}[./]\d{4})"
_RANGE: Final = re.compile(rf"({_DAY})?\s*(?:([-\u2013\u2014])\s*({_DAY})?)?")


def name_words(name: str) -> str:
    """Return a patient's name as "Family, Given Middle, Prefix, Suffix"; as it stands without `^`.

    Of a name in several scripts the first one is shown.
    """
    family, *given = (part.strip() for part in name.split("=")[0].split("^"))
    first = " ".join(part for part in given[:2] if part)
    return ", ".join(part for part in (family, first, *given[2:]) if part)


def name_asked(text: str) -> str:
    """Return what a PACS is asked for where somebody writes "Family, Given Middle"."""
    if "^" in text:
        return text.strip()
    family, _, given = (part.strip() for part in text.partition(","))
    return "^".join([family, *given.split()]) if given else family


def date_words(stored: str) -> str:
    """Return a date `YYYYMMDD` as the user's language writes it; as it stands if it is none."""
    try:
        return day(datetime.strptime(stored, "%Y%m%d").date())
    except ValueError:
        return stored


def dates_asked(text: str) -> str:
    """Return the dates that a PACS is asked for, `YYYYMMDD` or a range open at either end.

    Args:
        text: a day, or two with a dash between; `2024-02-01`, `1.2.2024`, `01/02/2024` (the day
            first) and `20240201` are all the same.

    Raises:
        ConfigurationError: if it is no date.
    """
    parts = _RANGE.fullmatch(text.strip())
    if parts is None:
        raise _no_date(text)
    first, dash, last = parts.groups()
    return (
        (_stored(first) if first else "") + ("-" if dash else "") + (_stored(last) if last else "")
    )


def _stored(text: str) -> str:
    for form in _FORMS:
        try:
            return datetime.strptime(text, form).strftime("%Y%m%d")
        except ValueError:
            continue
    raise _no_date(text)


def _no_date(text: str) -> ConfigurationError:
    example = day(date(2024, 2, 1))
    return ConfigurationError(
        sentence(
            "{text!r} is no date: write {day}, or two days with a dash", text=text, day=example
        )
    )
