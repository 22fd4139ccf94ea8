"""Texts of the lower rooms that stay translatable: an English template and its values.

Nothing here knows Qt. `tools.translations` collects the templates, and `core.texts.Texts` shows
them in the user's language, in the window and on the command line. As a text, a sentence is just
the English one: it is compared, searched, logged and written to JSON like any other.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import date, datetime
from functools import lru_cache
from numbers import Integral, Real
from string import Formatter
from types import MappingProxyType
from typing import Any

_IMMUTABLE = (str, int, float, bool, type(None), date, datetime)


class Formatted(str):
    """A value that is text already: a template's conversion and format leave it as it is."""

    __slots__ = ()

    def __format__(self, form: str) -> str:
        return str(self)

    def __repr__(self) -> str:
        return str(self)


class Sentence(str):
    """An English text that remembers what it was made of.

    Attributes:
        template: the text with its `{names}`, as a translator sees it.
        values: what the names stand for: numbers, texts, and sentences for parts of their own.
        single: the English text for one thing, in place of `template`; None if nothing is counted.
        things: how many are counted; other languages choose their form by it.
    """

    __slots__ = ("single", "template", "things", "values")
    template: str
    values: Mapping[str, Any]
    single: str | None
    things: int

    def __new__(
        cls, template: str, values: Mapping[str, Any], single: str | None = None, things: int = -1
    ) -> Sentence:
        """Fill the template now; of a value that could change only its text is remembered."""
        english = template if single is None or things != 1 else single
        text = super().__new__(cls, english.format(**values))
        object.__setattr__(text, "template", template)
        object.__setattr__(text, "single", single)
        object.__setattr__(text, "things", things)
        object.__setattr__(text, "values", MappingProxyType(_remembered(template, values)))
        return text

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(name)

    def __reduce__(self) -> tuple[Any, ...]:
        return Sentence, (self.template, dict(self.values), self.single, self.things)

    @property
    def pattern(self) -> str:
        """The English text before its names are filled."""
        return self.template if self.single is None or self.things != 1 else self.single

    def __add__(self, other: str) -> Sentence:
        return joined("", (self, other))

    def __radd__(self, other: str) -> Sentence:
        return joined("", (other, self))


def sentence(template: str, /, **values: object) -> Sentence:
    """Return a text for people: a template, which must be a literal, and its values.

    Args:
        template: as of `str.format`; braces that are meant are doubled.
        values: by their names in the template. An exception stands for its message.
    """
    return Sentence(template, values)


def counted(single: str, several: str, /, n: int, **values: object) -> Sentence:
    """Return a text for people about `n` things, in the form that is right for so many.

    Args:
        single: literal template for one thing, in English.
        several: literal template for every other number; it has the field `{n}`, and translators
            see it alone, with as many forms as their language has.
        n: how many.
        values: as of `sentence`.
    """
    return Sentence(several, {**values, "n": n}, single, n)


def listed(parts: Iterable[str]) -> str:
    """Return parts as people list them: "a, b and c"; each stays a sentence of its own."""
    *most, last = tuple(parts) or ("",)
    if not most:
        return last
    items = most[0]
    for item in most[1:]:
        items = sentence("{items}, {next}", items=items, next=item)
    return sentence("{items} and {last}", items=items, last=last)


def sentence_of(error: BaseException) -> str:
    """Return an error's message: `str(error)`, as the Sentence that it was raised with if so."""
    text = str(error)
    first = error.args[0] if error.args else None
    return first if isinstance(first, Sentence) and first == text else text


def joined(separator: str, parts: Iterable[str]) -> Sentence:
    """Return `separator.join(parts)`, of which each part stays a sentence of its own."""
    values = {f"part_{number}": part for number, part in enumerate(parts)}
    between = separator.replace("{", "{{").replace("}", "}}")
    return Sentence(between.join(f"{{{name}}}" for name in values), values)


def _remembered(template: str, values: Mapping[str, Any]) -> dict[str, Any]:
    remembered: dict[str, Any] = {}
    for name, form, conversion in _fields(template):
        if name not in remembered:  # of two, the first counts
            remembered[name] = _plain(values[name], conversion, form)
    return remembered


def _plain(value: Any, conversion: str, form: str) -> Any:
    if isinstance(value, BaseException) and not conversion and not form:
        value = sentence_of(value)
    is_plain = type(value) in _IMMUTABLE
    if not is_plain and not conversion and isinstance(value, Real):
        # numpy's: its decimal point is the language's
        value = int(value) if isinstance(value, Integral) else float(value)
    if type(value) in _IMMUTABLE or isinstance(value, Sentence | Formatted):
        return value
    return Formatted(f"{{0{'!' * bool(conversion)}{conversion}:{form}}}".format(value))


@lru_cache(maxsize=4096)
def _fields(template: str) -> tuple[tuple[str, str, str], ...]:
    """Return name, format and conversion of each field."""
    return tuple(
        (name, form or "", conversion or "")
        for _, name, form, conversion in Formatter().parse(template)
        if name is not None
    )
