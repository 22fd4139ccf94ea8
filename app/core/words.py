"""Words that leave the program: with nothing in them that steers a terminal."""

import re

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
