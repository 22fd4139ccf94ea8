"""A dialog of settings: they are taken when they can be used; else a line below says why not."""

from __future__ import annotations

from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QWidget

from app.core.errors import AcusError
from app.views.kit import theme
from app.views.kit.parts import label, size_dialog
from app.views.kit.text import translated
from app.views.kit.verdict import Verdict, tell


class SettingsDialog(QDialog):
    """The frame of a form: what is in it, whether it can be used, and keeping it are a subclass'.

    A subclass lays `note` and `buttons` out below its fields.

    Args:
        title: of the dialog.
        size: of the dialog [px].
        confirm: the button that takes what was entered, beside Cancel.
        parent: window.
    """

    def __init__(
        self,
        title: str,
        size: tuple[int, int],
        confirm: QDialogButtonBox.StandardButton,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        size_dialog(self, *size)
        self.note = label()
        self.note.setMinimumHeight(3 * theme.FONT_PX)
        self.buttons = QDialogButtonBox(
            confirm | QDialogButtonBox.StandardButton.Cancel, parent=self
        )
        self.buttons.accepted.connect(self.save)
        self.buttons.rejected.connect(self.reject)

    # --- what a subclass says -------------------------------------------------------------------
    def check(self) -> None:
        """Do nothing where what is entered can be used.

        Raises:
            AcusError: where it cannot; says why.
        """
        raise NotImplementedError

    def keep(self) -> None:
        """Keep what is entered; called before the dialog closes.

        Raises:
            AcusError: if it cannot be written; says why.
        """

    # --- what all do ----------------------------------------------------------------------------
    def save(self) -> bool:
        """Check, keep and close; return whether that was done."""
        if not self.show_check():
            return False
        try:
            self.keep()
        except AcusError as error:
            self.say(translated(error), Verdict.BAD)
            return False
        self.accept()
        return True

    def show_check(self) -> bool:
        """Say below why what is entered cannot be used; return whether it can."""
        try:
            self.check()
        except AcusError as error:
            self.say(translated(error), Verdict.BAD)
            return False
        self.say("")
        return True

    def say(self, text: str, verdict: Verdict | None = None) -> None:
        """Write the line below the form."""
        if verdict is not None:
            tell(self.note, verdict, text)
        else:
            self.note.setStyleSheet(f"color: {theme.TEXT};")
            self.note.setText(text)
        self._make_room()

    def showEvent(self, event: QShowEvent) -> None:
        """Begin with room for what is said already."""
        super().showEvent(event)
        self._make_room()

    def _make_room(self) -> None:
        make_room(self)


def make_room(dialog: QDialog) -> None:
    """Let a dialog grow where lines that wrap need more height: else they are cut, or overlap."""
    layout = dialog.layout()
    if layout is None:
        return
    layout.activate()
    needed = layout.totalMinimumHeightForWidth(dialog.width())
    if needed > dialog.height():
        size_dialog(dialog, dialog.width(), needed)
