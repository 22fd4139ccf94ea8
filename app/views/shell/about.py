"""What this is and what it is not, and the parts that it is built of."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, qVersion
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app import __version__
from app.core.parts import Part, parts
from app.views.kit.background import run_in_background
from app.views.kit.text import disclaimer, tr
from app.views.shell.application import icon

_ICON_PX = 96


def about(parent: QWidget) -> QDialog:
    """Return the dialog that says what this is and what it is not."""
    dialog = AboutDialog(parent)
    dialog.finished.connect(dialog.deleteLater)
    return dialog


class AboutDialog(QDialog):
    """Version, disclaimer, licence, and the libraries with their versions and licences."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("About Acus"))
        layout = QVBoxLayout(self)
        head = QHBoxLayout()
        picture = QLabel()
        picture.setPixmap(icon().pixmap(QSize(_ICON_PX, _ICON_PX), self.devicePixelRatioF()))
        head.addWidget(picture, 0, Qt.AlignmentFlag.AlignTop)
        words = QVBoxLayout()
        for text in (f"<h2>{tr('Acus {version}', version=__version__)}</h2>", *_sentences()):
            label = QLabel(text)
            label.setWordWrap(True)
            words.addWidget(label)
        head.addLayout(words, 1)
        layout.addLayout(head)
        self._head = QLabel(tr("Libraries, as installed (being read):"))
        layout.addWidget(self._head)
        self.table = _table()
        layout.addWidget(self.table, 1)
        # The metadata of every library take a good part of a second.
        run_in_background(self, lambda _: parts(), self._show_parts, self._not_read)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        layout.addWidget(buttons)
        self.resize(680, 620)

    def _show_parts(self, rows: Sequence[Part]) -> None:
        self._head.setText(tr("Libraries, as installed:"))
        self.table.setRowCount(len(rows))
        for row, part in enumerate(rows):
            for column, text in enumerate((part.name, part.version, part.licence)):
                item = QTableWidgetItem(text)
                item.setToolTip(text)
                self.table.setItem(row, column, item)
        self.table.resizeColumnsToContents()
        self.table.horizontalHeader().setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)

    def _not_read(self, error: Exception) -> None:
        self._head.setText(tr("The libraries cannot be listed: {error}", error=error))


def _sentences() -> tuple[str, ...]:
    return (
        disclaimer(),
        tr("Acus is under the Apache License 2.0 (LICENSE, NOTICE)."),
        tr(
            "Qt {version} and PySide6 are used under the GNU Lesser General Public License (LGPL), "
            "version 3: they lie beside the program as libraries of their own, and you may replace "
            "them by versions that you have changed.",
            version=qVersion(),
        ),
    )


def _table() -> QTableWidget:
    table = QTableWidget(0, 3)
    table.setHorizontalHeaderLabels([tr("Library"), tr("Version"), tr("Licence")])
    table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
    table.verticalHeader().hide()
    table.setFocusPolicy(Qt.FocusPolicy.ClickFocus)  # no row is chosen until somebody does
    return table
