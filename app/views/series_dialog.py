"""Which series of a folder: those that can be used, and why the others cannot."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QDialogButtonBox,
    QLabel,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.imaging.series import Listing, Series
from app.views import theme
from app.views.text import tr

COLUMN_WIDTHS = (230, 90, 150, 170)


class SeriesDialog(QDialog):
    """Lists the series of a folder.

    Signals:
        chosen(object): the series to open.
    """

    chosen = Signal(object)

    def __init__(self, listing: Listing, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Choose a CT series"))
        self.resize(960, 420)
        self.tree = QTreeWidget(self)
        self.tree.setHeaderLabels(
            [tr("Series"), tr("Modality"), tr("Size"), tr("Spacing [mm]"), tr("Usable")]
        )
        self.tree.setRootIsDecorated(False)
        self.tree.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        for series in sorted(listing.series, key=lambda s: not s.usable):
            self.tree.addTopLevelItem(_row(series))
        for number, width in enumerate(COLUMN_WIDTHS):
            self.tree.setColumnWidth(number, width)
        buttons = QDialogButtonBox.StandardButton
        self._buttons = QDialogButtonBox(buttons.Open | buttons.Cancel, parent=self)
        note = tr("{count} other files are not part of any series.", count=len(listing.ignored))
        self._ignored = QLabel(note if listing.ignored else "", self)
        self._ignored.setProperty("role", "dim")
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        for widget in (self.tree, self._ignored, self._buttons):
            column.addWidget(widget)
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)
        self.tree.itemDoubleClicked.connect(lambda *_: self.accept())
        self.tree.itemSelectionChanged.connect(self._enable)
        first = self.tree.topLevelItem(0)
        if first is not None:
            self.tree.setCurrentItem(first)
        self._enable()

    def selected(self) -> Series | None:
        """Usable series that is marked."""
        item = self.tree.currentItem()
        series = None if item is None else item.data(0, Qt.ItemDataRole.UserRole)
        return series if series is not None and series.usable else None

    def accept(self) -> None:
        """Open the marked series."""
        series = self.selected()
        if series is not None:
            super().accept()
            self.chosen.emit(series)

    def _enable(self) -> None:
        button = self._buttons.button(QDialogButtonBox.StandardButton.Open)
        button.setEnabled(self.selected() is not None)


def _row(series: Series) -> QTreeWidgetItem:
    size = " × ".join(str(count) for count in series.size)
    spacing = series.spacing_mm
    spaced = "–" if spacing is None else " × ".join(f"{value:.3g}" for value in spacing)
    usable = "✔" if series.usable else f"✖  {series.reason}"
    item = QTreeWidgetItem([series.label, series.modality, size, spaced, usable])
    item.setData(0, Qt.ItemDataRole.UserRole, series)
    item.setToolTip(4, series.reason)
    if not series.usable:
        item.setFlags(item.flags() & ~Qt.ItemFlag.ItemIsEnabled)
    return item
