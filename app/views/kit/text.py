"""Every string the user sees passes through here to Qt's translation."""

from collections.abc import Mapping
from html import escape
from pathlib import Path

from PySide6.QtCore import QCoreApplication, QLocale, QTranslator
from PySide6.QtGui import Qt

from app.core import paths
from app.core.messages import Sentence, sentence_of

CONTEXT = ""
"""The one translation context, as `lupdate` writes it for a plain function: the same English text
has the same meaning everywhere."""


def tr(text: str, **values: object) -> str:
    """Return `text` in the user's language, its `{names}` filled with `values`.

    Called when the string is needed, never at import: the translation is loaded after the modules.
    `pyside6-lupdate -tr-function-alias tr` finds the calls; the text must therefore be a literal.
    Values that are sentences or errors of the lower rooms come in the user's language as well.
    """
    pattern = QCoreApplication.translate(CONTEXT, text)
    return pattern.format(**_shown(values)) if values else pattern


def translated(message: str | BaseException) -> str:
    """Return a message of the lower rooms in the user's language.

    Args:
        message: a `core.messages.Sentence`, or an error raised with one, is translated, and so are
            the sentences among its values; every other text and error comes as it is.
    """
    text = sentence_of(message) if isinstance(message, BaseException) else message
    if not isinstance(text, Sentence):
        return str(text)
    values = _shown(text.values)
    try:
        return QCoreApplication.translate(CONTEXT, text.template).format(**values)
    except (LookupError, ValueError):  # a translation that names other values
        return text.template.format(**values)


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


def translations_folder() -> Path:
    """Folder of the shipped `acus_<language>.qm` files."""
    return paths.resources() / "translations"


def install_translation(
    application: QCoreApplication, locale: QLocale | None = None, folder: Path | None = None
) -> bool:
    """Load the translation of a locale (the system's by default) into the application.

    Returns:
        Whether one was found; English, the language of the source, needs none.
    """
    translator = QTranslator(application)
    found = translator.load(
        locale or QLocale.system(), "acus", "_", str(folder or translations_folder())
    )
    return found and application.installTranslator(translator)
