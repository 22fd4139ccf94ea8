"""Words that leave the program: with nothing in them that steers a terminal.

Names in the order in which people look for them, where no table of a language is at hand.

Letters with signs stand at their base letter (ü at u, ó at o, ł at l), case counts last, and
numbers go by value, much as the Unicode Collation Algorithm orders Latin letters where no language
tailors it (UTS #10). Languages that count å or ł as a letter of its own need their own table: the
window has Qt's.
"""

from __future__ import annotations

import re
import unicodedata
from typing import Final, TypeAlias

_STEERING = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069]"
)


def printable(text: str) -> str:
    r"""Return the text with each character that steers a terminal as ``\u001b``; lines stay.

    Names of patients, pupils, files and peers come from elsewhere. A control character among them
    could move the cursor, hide a line or set the window's title (ECMA-48), and a bidirectional
    override lets a line read otherwise than it stands (UAX #9).
    """
    return _STEERING.sub(lambda match: f"\\u{ord(match[0]):04x}", text)


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
