"""Lines to type into: one that is searched by, one for the name under which somebody practises."""

from __future__ import annotations

import re
from typing import Final

from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent, QValidator
from PySide6.QtWidgets import QLineEdit, QToolTip, QWidget

from app.views.kit.text import literal, tr

_ALLOWED: Final = re.compile(r"([A-Za-z0-9][A-Za-z0-9._-]{0,31})?")
_SPACE: Final = re.compile(r"\s")


class SearchLine(QLineEdit):
    """What is searched for; Esc clears it."""

    def __init__(self, words: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setPlaceholderText(words)
        self.setAccessibleName(words)
        self.setClearButtonEnabled(True)

    def event(self, event: QEvent) -> bool:
        """Keep Esc from whoever has it as a shortcut while there is something to clear."""
        if event.type() == QEvent.Type.ShortcutOverride and self._clears(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Clear by Esc; an empty line leaves it to the page."""
        if self._clears(event):
            self.clear()
        else:
            super().keyPressEvent(event)

    def _clears(self, event: QEvent) -> bool:
        escape = isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape
        return escape and bool(self.text())


class PseudonymLine(QLineEdit):
    """A name that goes into records: a space becomes an underscore, what is refused is said."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._rule = _Pseudonym(self)
        self.setValidator(self._rule)
        self.setToolTip(
            literal(
                tr("A pseudonym, never a name: it goes into every record. Letters, digits, . _ -")
            )
        )
        self.inputRejected.connect(self._say)

    def show_known(self, name: str) -> None:
        """Show the name of somebody who is on a list already, as it is."""
        self.setValidator(None)  # type: ignore[arg-type]
        self.setText(name)
        self.setValidator(self._rule)

    def _say(self) -> None:
        words = tr(
            "Up to 32 letters (A to Z), digits, . _ - are taken, first a letter or digit; a space "
            "becomes _."
        )
        QToolTip.showText(self.mapToGlobal(QPoint(0, self.height())), literal(words), self)


class _Pseudonym(QValidator):
    def validate(self, text: str, place: int) -> tuple[QValidator.State, str, int]:
        """Take what records take; spaces within, pasted ones too, as underscores."""
        lead = len(text) - len(text.lstrip())
        written, place = _SPACE.sub("_", text[lead:]), max(0, place - lead)
        fits = _ALLOWED.fullmatch(written) is not None and not (lead and not written)
        if not fits:
            return QValidator.State.Invalid, written, place
        same = written == text  # what stands there with a space is only on its way
        return (
            QValidator.State.Acceptable if same else QValidator.State.Intermediate,
            written,
            place,
        )
