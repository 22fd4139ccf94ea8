"""Every string the user sees passes through here to Qt's translation."""

import re
from collections.abc import Iterable
from datetime import date, datetime
from html import escape

from PySide6.QtCore import QCoreApplication
from PySide6.QtGui import Qt

from app.core.messages import listed
from app.core.texts import Texts

CONTEXT = ""
"""The one translation context, as `lupdate` writes it for a plain function: the same English text
has the same meaning everywhere."""

_TEXTS = Texts(lambda english, n: QCoreApplication.translate(CONTEXT, english, None, n))


def tr(text: str, **values: object) -> str:
    """Return `text` in the user's language, its `{names}` filled with `values`.

    Called when the string is needed, never at import: the translation is loaded after the modules.
    `tools.translations` collects the calls; the text must therefore be a literal. Values that are
    sentences or errors of the lower rooms come in the user's language as well. A translation that
    the values do not fit is not shown: the text is English then.
    """
    return _TEXTS.text(text, values)


def tr_n(single: str, several: str, n: int, **values: object) -> str:
    """Return what is said of `n` things in the user's language; `{n}` in it is that number.

    Args:
        single: in English of one thing; a literal.
        several: in English of any other number; a literal, which translators see.
        n: how many.
        values: as of `tr`.
    """
    return _TEXTS.counted(single, several, n, values)


def declared(text: str) -> str:
    """Return a text of a declaration or of an exercise that ships in the user's language.

    `tools.translations` collects these from their files; what somebody else wrote stays as it is.
    """
    return _TEXTS.text(text) if text else ""


def translated(message: str | BaseException) -> str:
    """Return a message of the lower rooms in the user's language.

    Args:
        message: a `core.messages.Sentence`, or an error raised with one, is translated, and so are
            the sentences among its values; every other text and error comes as it is.
    """
    return _TEXTS.translated(message)


def kept_text(text: str) -> str:
    """Return a message that a file or another process held as English text in the user's language.

    That is possible for messages without values; every other one stays as it is.
    """
    shown = translated(text)
    return declared(shown) if shown == text else shown


def begun(message: str | BaseException) -> str:
    """Return a message of the lower rooms in the user's language, begun with a capital."""
    text = translated(message)
    return text[:1].upper() + text[1:]


def begin_language(english: bool) -> None:
    """Write numbers and dates of all texts from now on as the language that is loaded does."""
    _TEXTS.begin(english)


def in_english() -> bool:
    """Return whether the texts are those of the source."""
    return _TEXTS.is_english


def number(value: float, form: str) -> str:
    """Return a number by a format such as `.1f`, with the language's own decimal point."""
    return _TEXTS.number(value, form)


def moment(when: datetime) -> str:
    """Return a date with hour and minute as the user's language writes them."""
    return _TEXTS.moment(when)


def date_text(started: str) -> str:
    """Return a wall-clock time (ISO 8601) as local time; as it stands if it is no time."""
    try:
        return moment(datetime.fromisoformat(started).astimezone())
    except ValueError:
        return started


def listing(parts: Iterable[str]) -> str:
    """Return parts as the user's language lists them: "a, b and c"."""
    return translated(listed(parts))


def day(when: date) -> str:
    """Return a date as the user's language writes it."""
    return _TEXTS.day(when)


_KEYS = re.compile(
    r"\b(Ctrl|Shift|Alt|Esc|Return|Enter|Space|Backspace|Del|Home|End|PgUp|PgDown)\b"
)


def keys_text(keys: str) -> str:
    """Return keys as the keyboards of the user's language name them: `Ctrl+B` is `Strg+B`.

    Qt has the names among its own translations.
    """
    return _KEYS.sub(lambda key: QCoreApplication.translate("QShortcut", key[0]), keys)


def literal(text: str) -> str:
    """Return what lets Qt show a text as it stands where it would look for markup itself.

    Tips, boxes of messages and of progress do: a name such as `<b>` would steer them. A text that
    holds none comes back as it is.
    """
    if not Qt.mightBeRichText(text):
        return text
    return f"<qt>{escape(text, quote=False)}</qt>".replace("\n", "<br>")


def disclaimer() -> str:
    """Return `core.disclaimer.DISCLAIMER` in the user's language.

    It stands here once more, in full, because `lupdate` finds literals only; a test compares them.
    """
    return tr("Training only. Not a medical device; not for diagnosis or patient care.")
