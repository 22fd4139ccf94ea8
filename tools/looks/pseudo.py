"""A language that nobody speaks: English with words 40 % longer, to see what is cut."""

from __future__ import annotations

import math
import re
from typing import Final

from PySide6.QtCore import QTranslator

LONGER: Final = 0.4
_KEPT: Final = re.compile(
    r"\{[^}]*\}|<[^>]*>|`[^`]*`|&\w+;|%\w|\b(?:Ctrl|Shift|Alt|Esc|Enter|F\d+)\b\S*"
)
_WORD: Final = re.compile(r"[^\W\d_]{3,}")


def longer(text: str) -> str:
    """Return a text whose words are 40 % longer; places for values, markup and keys stay."""
    parts, at = [], 0
    for kept in _KEPT.finditer(text):
        parts += [_stretched(text[at : kept.start()]), kept.group()]
        at = kept.end()
    return "".join([*parts, _stretched(text[at:])])


def _stretched(text: str) -> str:
    return _WORD.sub(lambda word: word.group() + _more(word.group()), text)


def _more(word: str) -> str:
    return ("õ" if word.islower() else "o") * math.ceil(LONGER * len(word))


class Longer(QTranslator):
    """Answers every text with the longer one."""

    def translate(
        self, context: str, source: str, disambiguation: str | None = None, n: int = -1
    ) -> str:
        """Return the longer text."""
        return longer(source) if source else ""

    def isEmpty(self) -> bool:
        """Return False: Qt takes no empty ones."""
        return False
