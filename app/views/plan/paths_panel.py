"""Planning help: map of entries for the target, its legend, and a table of paths to choose from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme
from app.views.kit.text import tr
from app.views.plan.entry_map import legend

if TYPE_CHECKING:
    from app.planning.paths import PathScores


_WIDTHS = 58, 64, 58
"""Of the columns before the last [px]."""


class PathsPanel(QWidget):
    """Shows what the map found; who chooses is the user.

    Signals:
        map_wanted(), clear_wanted().
        shown(int): look at the candidate of this number.
        taken(int): make it the plan.
    """

    map_wanted = Signal()
    clear_wanted = Signal()
    shown = Signal(int)
    taken = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.make = QPushButton(tr("Map entries for this target"))
        self.clear = QPushButton(tr("Clear"))
        self.take = QPushButton(tr("Take this path"))
        self.note = QLabel(self)
        self.note.setWordWrap(True)
        self.note.setProperty("role", "dim")
        self.note.setTextFormat(Qt.TextFormat.PlainText)
        self.table = _table()
        self._numbers: tuple[int, ...] = ()
        self._key = QWidget(self)
        self._lay_out()
        self.make.clicked.connect(self.map_wanted)
        self.clear.clicked.connect(self.clear_wanted)
        self.take.clicked.connect(self._take)
        self.table.itemSelectionChanged.connect(self._look)
        self.suit_text()
        self.show_scores(None, ())

    def show_scores(self, scores: PathScores | None, numbers: tuple[int, ...]) -> None:
        """List candidates of scored paths by their numbers; nothing is chosen."""
        self._numbers = numbers
        self._key.setVisible(scores is not None)
        self.table.setVisible(scores is not None)
        self.take.setVisible(scores is not None)
        self.clear.setEnabled(scores is not None)
        self.table.clearSelection()
        self.table.setCurrentCell(-1, -1)
        self.table.setRowCount(len(numbers))
        self.take.setEnabled(False)
        if scores is None:
            self.note.setText(
                tr("Scores straight paths to the target from all over the skin: length, angle to "
                   "the skin, bone, distance to structures that warn, and the robot's reach.")
            )  # fmt: skip
            return
        for row, number in enumerate(numbers):
            self._show_row(row, scores, number)
        free = int(scores.free.sum())
        words = tr("{free} of {all} entries are possible.", free=free, all=len(scores))
        if not free:
            words = tr("No entry is possible: turn the patient, or choose another target.")
        if not scores.names:
            words += " " + tr("No structure warns: the scores know only bone and reach.")
        self.note.setText(words)

    def suit_text(self) -> None:
        """Give the columns room for the present size of the text."""
        for column, width in enumerate(_WIDTHS):
            self.table.setColumnWidth(column, theme.px(width))
        for label, (rgb, _) in zip(self._key.findChildren(QLabel), legend(), strict=True):
            label.setStyleSheet(f"color: {readable(rgb)};")

    def _show_row(self, row: int, scores: PathScores, number: int) -> None:
        nearest = tr("none")
        if scores.nearest[number] >= 0:
            name = scores.names[int(scores.nearest[number])]
            nearest = f"{scores.nearest_mm[number]:.0f} {name}"
        texts = (f"{scores.score[number]:.0f}", f"{scores.length_mm[number]:.0f}",
                 f"{scores.angle_deg[number]:.0f}", nearest)  # fmt: skip
        for column, text in enumerate(texts):
            item = QTableWidgetItem(text)
            item.setToolTip(text)
            self.table.setItem(row, column, item)

    def _look(self) -> None:
        row = self.table.currentRow() if self.table.selectedItems() else -1
        self.take.setEnabled(0 <= row < len(self._numbers))
        if 0 <= row < len(self._numbers):
            self.shown.emit(self._numbers[row])

    def _take(self) -> None:
        row = self.table.currentRow()
        if 0 <= row < len(self._numbers):
            self.taken.emit(self._numbers[row])

    def _lay_out(self) -> None:
        heading = QLabel(tr("Planning help"))
        heading.setProperty("role", "heading")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, theme.SPACING, 0, 0)
        column.setSpacing(theme.SPACING)
        column.addWidget(heading)
        row = QHBoxLayout()
        row.addWidget(self.make, 1)
        row.addWidget(self.clear)
        column.addLayout(row)
        column.addWidget(self.note)
        grid = QGridLayout(self._key)
        grid.setContentsMargins(0, 0, 0, 0)
        for place, (_, text) in enumerate(legend()):
            label = QLabel(text)
            grid.addWidget(label, place // 3, place % 3)
        column.addWidget(self._key)
        column.addWidget(self.table)
        column.addWidget(self.take)


def _table() -> QTableWidget:
    table = QTableWidget(0, 4)
    table.setHorizontalHeaderLabels(
        [tr("Score"), tr("Length\n[mm]"), tr("Angle\n[°]"), tr("Nearest\n[mm]")]
    )
    table.verticalHeader().setVisible(False)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setMinimumHeight(230)
    header = table.horizontalHeader()
    for column in range(len(_WIDTHS)):
        header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
    header.setSectionResizeMode(3, QHeaderView.ResizeMode.Stretch)
    table.setAccessibleName(tr("Candidate paths"))
    return table


def readable(rgb: tuple[int, int, int]) -> str:
    """Return a colour of the map as words can have it: lighter on dark, darker on light."""
    colour, ground = QColor(*rgb), QColor(theme.BACKGROUND)
    if ground.lightnessF() > 0.5:
        return QColor.fromHslF(colour.hslHueF() % 1.0, colour.hslSaturationF(), 0.27).name()
    return colour.lighter(125).name()
