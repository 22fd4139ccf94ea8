"""Names in the order in which people look for them, where no table of a language is at hand.

Letters with signs stand at their base letter (ü at u, ó at o, ł at l), case counts last, and
numbers go by value, much as the Unicode Collation Algorithm orders Latin letters where no language
tailors it (UTS #10). Languages that count å or ł as a letter of its own need their own table: the
window has Qt's.
"""

from __future__ import annotations

import re
import unicodedata
from typing import Final, TypeAlias

NameOrder: TypeAlias = "tuple[tuple[tuple[int, int, str], ...], str]"

_BASE: Final = str.maketrans(
    {"ł": "l", "đ": "d", "ð": "d", "ø": "o", "ħ": "h", "ı": "i", "æ": "ae", "œ": "oe", "þ": "th"}
)
"""Letters that Unicode does not take apart, each with what it stands at."""

_DIGITS: Final = re.compile(r"(\d+)")


def name_order(text: str) -> NameOrder:
    """Return the key by which names are sorted."""
    taken_apart = unicodedata.normalize("NFKD", text.casefold())
    base = "".join(c for c in taken_apart if not unicodedata.combining(c)).translate(_BASE)
    parts = (
        (0, int(part), "") if part.isdecimal() else (1, 0, part)
        for part in _DIGITS.split(base)
        if part
    )
    return tuple(parts), text
