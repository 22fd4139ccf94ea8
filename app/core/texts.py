"""Texts for people in one language: looked up, filled, and with its numbers, dates and lists.

Where the translations come from is told by whoever makes `Texts`: Qt for the window, a file of
`core.language` for the command line. What a language writes otherwise than English stands among
its translations: of `0.5` (the decimal point), `%Y-%m-%d %H:%M` and `%Y-%m-%d` (dates, as of
`strftime`), `{items}, {next}` and `{items} and {last}` (`core.messages.listed`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import date, datetime
from string import Formatter
from typing import Any, TypeAlias

from app.core.library_words import system_words
from app.core.messages import Sentence, sentence, sentence_of

Lookup: TypeAlias = Callable[[str, int], str]
"""English text, and the count that chooses its form or -1 -> translation, or the same text."""

_HALF = "0.5"
_MOMENT, _DAY = "%Y-%m-%d %H:%M", "%Y-%m-%d"


class Texts(Formatter):
    """The texts of one language.

    Args:
        lookup: of one text.

    Attributes:
        is_english: whether nothing is written otherwise than in the source.
    """

    def __init__(self, lookup: Lookup) -> None:
        self._lookup = lookup
        self._point = "."
        self.is_english = True

    def begin(self, english: bool) -> Texts:
        """Take the language's own decimal point and dates, or those of English."""
        self.is_english = english
        self._point = "." if english else self._lookup(_HALF, -1).strip("05") or "."
        return self

    def text(self, english: str, values: Mapping[str, object] | None = None) -> str:
        """Return a text, its `{names}` filled; English where the values fit no translation."""
        pattern = self._lookup(english, -1)
        return pattern if not values else self._fitted(pattern, english, self._shown(values))

    def counted(self, single: str, several: str, n: int, values: Mapping[str, object]) -> str:
        """Return the form of a text that is right for `n` things; `{n}` in it is that number."""
        return self.translated(Sentence(several, {**values, "n": n}, single, n))

    def translated(self, message: str | BaseException) -> str:
        """Return a sentence, or an error raised with one, in this language; else what it is."""
        text = sentence_of(message) if isinstance(message, BaseException) else message
        if not isinstance(text, Sentence):
            return str(text)
        pattern = self._lookup(text.template, -1 if text.single is None else text.things)
        english = text.pattern
        if pattern == text.template:
            pattern = english
        return self._fitted(pattern, english, self._shown(text.values))

    def number(self, value: float, form: str) -> str:
        """Return a number by a format such as `.1f`, with the language's own decimal point."""
        return format(value, form).replace(".", self._point)

    def moment(self, when: datetime) -> str:
        """Return a date with hour and minute as this language writes them."""
        return when.strftime(self._lookup(_MOMENT, -1))

    def day(self, when: date) -> str:
        """Return a date as this language writes it."""
        return when.strftime(self._lookup(_DAY, -1))

    def format_field(self, value: Any, format_spec: str) -> Any:
        """Format one value of a text."""
        if isinstance(value, date):
            return value.strftime(self._lookup(format_spec or _DAY, -1))
        text = super().format_field(value, format_spec)
        return text.replace(".", self._point) if isinstance(value, float) else text

    def _fitted(self, pattern: str, english: str, values: Mapping[str, object]) -> str:
        try:
            return self._filled(pattern, values)
        except (LookupError, ValueError, TypeError, AttributeError):
            if pattern == english:
                raise
            return self._filled(english, values)  # the translation names other values

    def _filled(self, pattern: str, values: Mapping[str, object]) -> str:
        if self.is_english:
            return pattern.format(**values)
        return self.vformat(pattern, (), values)

    def _sentence(self, value: object) -> object:
        """Return a value as the sentence that it is, or that it stands for."""
        text = sentence_of(value) if isinstance(value, BaseException) else value
        if self.is_english or isinstance(text, Sentence) or not isinstance(text, str):
            return text
        return system_words(text)

    def _shown(self, values: Mapping[str, object]) -> dict[str, object]:
        sentences = {name: self._sentence(value) for name, value in values.items()}
        parts = {name: part for name, part in sentences.items() if isinstance(part, Sentence)}
        return {**values, **{name: self.translated(part) for name, part in parts.items()}}


def declared_forms() -> tuple[Sentence, ...]:
    """Return what a language writes otherwise than English, for its file to say how."""
    return sentence("0.5"), sentence("%Y-%m-%d %H:%M"), sentence("%Y-%m-%d")
