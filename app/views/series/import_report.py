"""What an import removed, and a way to open what it left."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QLabel,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.imaging.library import Imported


class ImportReport(QDialog):
    """Shows the report of an import; it holds no value of the files.

    Signals:
        open_wanted(Path): open the CT that was taken in.
    """

    open_wanted = Signal(object)

    def __init__(self, imported: Imported, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Taken into the library"))
        self.resize(760, 460)
        entry, report = imported.entry, imported.report
        words = _words(imported)
        heading = QLabel(f"{NAMES.shown(entry.name)}\n{NAMES.without_names(words)}", self)
        heading.setProperty("role", "heading")
        self.warning = QLabel("\n".join(f"⚠  {text}" for text in report.warnings), self)
        self.warning.setWordWrap(True)
        self.warning.setVisible(bool(report.warnings))
        lines = [line for line in report.lines() if not line.startswith("look at this")]
        self.text = QPlainTextEdit(NAMES.without_names("\n\n".join(lines)), self)
        self.text.setReadOnly(True)
        kinds = QDialogButtonBox.StandardButton
        self.buttons = QDialogButtonBox(kinds.Open | kinds.Close, parent=self)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self.accepted.connect(lambda: self.open_wanted.emit(entry.folder))
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        for widget in (heading, self.warning, self.text, self.buttons):
            column.addWidget(widget)


def _words(imported: Imported) -> str:
    """Say what became of it."""
    label, before, given = imported.entry.label, imported.before, imported.given
    if imported.again and given < before:
        return tr(
            "{label}: all {before} images are in the library already; the {given} given are a part",
            label=label, before=before, given=given,
        )  # fmt: skip
    if imported.again:
        return tr("{label}: it was in the library already", label=label)
    words = tr("{label}: {count} files, de-identified and checked", label=label,
               count=imported.entry.files)  # fmt: skip
    if 0 < before < given:
        words += tr("; they replace the {before} of them that lay there", before=before)
    return words
