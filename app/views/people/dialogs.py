"""Small dialogs of people: lines that are taken together, and text that is shown once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QLineEdit,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.views.kit.form import Form
from app.views.kit.parts import button, label
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict, tell


def lead(dialog: QDialog, *fields: QWidget) -> None:
    """Let a dialog open with the cursor in the first of its fields, and Tab go through them."""
    for one, following in pairwise(fields):
        QWidget.setTabOrder(one, following)
    for first in fields[:1]:
        first.setFocus()


class EntryDialog(SettingsDialog):
    """A form of lines that are taken together; what is wrong is said below.

    Args:
        title: of the dialog.
        fields: name, and whether it is hidden while it is typed.
        take: takes the entries; raises an AcusError if they cannot be.
        words: what is to be known, above the form.
        parent: window.
    """

    def __init__(
        self,
        title: str,
        fields: Sequence[tuple[str, bool]],
        take: Callable[..., object],
        words: str = "",
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(title, (460, 0), QDialogButtonBox.StandardButton.Ok, parent)
        self._take = take
        self.form = Form(parent=self)
        self.lines = [self.form.text(name, title=name, secret=hidden) for name, hidden in fields]
        self.names = [name for name, _ in fields]
        lead(self, *self.lines)
        column = QVBoxLayout(self)
        if words:
            column.addWidget(label(words, "dim"))
        column.addWidget(self.form)
        column.addWidget(self.note)
        column.addWidget(self.buttons)

    def check(self) -> None:
        """Everything is checked when it is taken."""

    def keep(self) -> None:
        """Take the entries; where one was wrong the cursor stands in it, and nothing is lost."""
        try:
            self._take(*(line.text() for line in self.lines))
        except AcusError as error:
            wrong = self._wrong(translated(error))
            wrong.setFocus()
            wrong.selectAll()
            raise

    def _wrong(self, message: str) -> QLineEdit:
        """Return the line that a message names, secrets first, else the first secret, or line."""
        ordered = sorted(
            zip(self.names, self.lines, strict=True),
            key=lambda one: one[1].echoMode() is not QLineEdit.EchoMode.Password,
        )
        named = (line for name, line in ordered if name.casefold() in message.casefold())
        return next(named, ordered[0][1])


class OnceDialog(QDialog):
    """Something that is shown once only: it closes when somebody says that it is written down.

    Attributes:
        written: says so.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.written = QCheckBox(tr("I have written it down"), self)
        self.asked = label()

    def reject(self) -> None:
        """Close, unless nobody has said that it is written down: then ask."""
        if self.written.isChecked():
            super().reject()
            return
        why = tr("It is shown this once only: write it down, tick the box, then close.")
        tell(self.asked, Verdict.WARNING, why)
        self.written.setFocus()


def text_dialog(title: str, words: str, text: str, parent: QWidget, once: bool = False) -> QDialog:
    """Return a dialog with text to copy or write down: a recovery key, PINs, errors.

    Args:
        title: of the dialog.
        words: what it is.
        text: to be copied.
        parent: window.
        once: whether it is shown this once only, so that it closes only when it is written down.
    """
    dialog = OnceDialog(parent) if once else QDialog(parent)
    dialog.setWindowTitle(title)
    dialog.resize(560, 360)
    shown = QPlainTextEdit(text)
    shown.setReadOnly(True)
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    copied = button(tr("Copy"))
    copied.setToolTip(tr("Copy the text, to print it or to keep it elsewhere"))
    copied.clicked.connect(lambda: QGuiApplication.clipboard().setText(text))
    buttons.addButton(copied, QDialogButtonBox.ButtonRole.ActionRole)
    buttons.rejected.connect(dialog.reject)
    column = QVBoxLayout(dialog)
    column.addWidget(label(words))
    column.addWidget(shown, 1)
    if isinstance(dialog, OnceDialog):
        column.addWidget(dialog.written)
        column.addWidget(dialog.asked)
    column.addWidget(buttons)
    return dialog
