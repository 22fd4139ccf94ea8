"""Identifiers in texts: what must not leave the computer, or be seen by a room, is taken out.

Names cannot be told from other words; they are taken out where somebody has told them. Pseudonyms,
paths and files are told by their form.
"""

import re
from collections.abc import Iterable
from typing import Final

HIDDEN: Final = "•••"

_PSEUDONYM = re.compile(r"\b(?:CT|P)-[0-9A-Z]{6,}\b")
_PATH = re.compile(r"(?<![\w/\\])(?:[A-Za-z]:)?[/\\](?:[^/\\:\n'\"]+[/\\])*[^\s/\\:,;'\"()]+")
_RELATIVE = re.compile(r"[^\s:,;'\"()]+[/\\][^\s:,;'\"()]+")
_FILE = re.compile(
    r"[^\s/\\:,;'\"()]+\.(?:dcm|ima|nii|gz|zip|nrrd|json|csv|pdf|yaml|mcap)\b", re.IGNORECASE
)


def without_identifiers(text: str, names: Iterable[str] = (), files: bool = False) -> str:
    """Return a text with dots in the place of names, paths, files and pseudonyms.

    Args:
        text: that may hold some.
        names: that are known, as whole words.
        files: whether all with a slash in it is a file.
    """
    for name in sorted(names, key=len, reverse=True):
        text = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", HIDDEN, text)
    for pattern in (_PATH, *((_RELATIVE,) if files else ()), _FILE, _PSEUDONYM):
        text = pattern.sub(HIDDEN, text)
    return text
