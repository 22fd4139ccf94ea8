"""Every string the user sees passes through here to Qt's translation."""

from collections.abc import Mapping
from html import escape
from string import Formatter
from typing import Any

from PySide6.QtCore import QCoreApplication
from PySide6.QtGui import Qt

from app.core.messages import Sentence, sentence_of

CONTEXT = ""
"""The one translation context, as `lupdate` writes it for a plain function: the same English text
has the same meaning everywhere."""


def tr(text: str, **values: object) -> str:
    """Return `text` in the user's language, its `{names}` filled with `values`.

    Called when the string is needed, never at import: the translation is loaded after the modules.
    `pyside6-lupdate -tr-function-alias tr` finds the calls; the text must therefore be a literal.
    Values that are sentences or errors of the lower rooms come in the user's language as well. A
    translation that the values do not fit is not shown: the text is English then.
    """
    pattern = QCoreApplication.translate(CONTEXT, text)
    return _fitted(pattern, text, _shown(values)) if values else pattern


def declared(text: str) -> str:
    """Return a text of a declaration or of an exercise that ships in the user's language.

    `tools.translations` collects these from their files; what somebody else wrote stays as it is.
    """
    return QCoreApplication.translate(CONTEXT, text) if text else ""


def translated(message: str | BaseException) -> str:
    """Return a message of the lower rooms in the user's language.

    Args:
        message: a `core.messages.Sentence`, or an error raised with one, is translated, and so are
            the sentences among its values; every other text and error comes as it is.
    """
    text = sentence_of(message) if isinstance(message, BaseException) else message
    if not isinstance(text, Sentence):
        return str(text)
    pattern = QCoreApplication.translate(CONTEXT, text.template)
    return _fitted(pattern, text.template, _shown(text.values))


def begun(message: str | BaseException) -> str:
    """Return a message of the lower rooms in the user's language, begun with a capital."""
    text = translated(message)
    return text[:1].upper() + text[1:]


class _Local(Formatter):
    """Fills a pattern, decimal numbers with the language's own point."""

    point = "."

    def format_field(self, value: Any, format_spec: str) -> Any:
        """Format one value."""
        text = super().format_field(value, format_spec)
        return text.replace(".", self.point) if isinstance(value, float) else text


_LOCAL = _Local()


def use_decimal_point(point: str) -> None:
    """Write decimal numbers of all texts from now on with this point."""
    _LOCAL.point = point


def number(value: float, form: str) -> str:
    """Return a number by a format such as `.1f`, with the language's own decimal point."""
    return format(value, form).replace(".", _LOCAL.point)


def _fitted(pattern: str, english: str, values: Mapping[str, object]) -> str:
    try:
        return _filled(pattern, values)
    except (LookupError, ValueError, TypeError, AttributeError):
        if pattern == english:
            raise
        return _filled(english, values)  # the translation names other values


def _filled(pattern: str, values: Mapping[str, object]) -> str:
    if _LOCAL.point == ".":
        return pattern.format(**values)
    return _LOCAL.vformat(pattern, (), values)


def _shown(values: Mapping[str, object]) -> dict[str, object]:
    sentences = {
        name: value if isinstance(value, Sentence) else sentence_of(value)
        for name, value in values.items()
        if isinstance(value, Sentence | BaseException)
    }
    parts = {name: part for name, part in sentences.items() if isinstance(part, Sentence)}
    return {**values, **{name: translated(part) for name, part in parts.items()}}


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
