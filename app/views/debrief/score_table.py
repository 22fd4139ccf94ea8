"""The score as a table: metric, value, band, points, weight."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from app.scoring.result import Score
from app.views.debrief.score_words import counting, row_texts, shown_only
from app.views.kit import theme
from app.views.kit.text import tr

_ROW_HEIGHT, _WEIGHT = 26, 4


class ScoreTable(QTableWidget):
    """Rows that count first, then those shown for information, dimmed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, 5, parent)
        titles = (tr("Metric"), tr("Value"), tr("Band"), tr("Points"), tr("Weight"))
        for column, title in enumerate(titles):
            self.setHorizontalHeaderItem(column, _cell(title, column))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setShowGrid(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)

    def show_score(self, score: Score | None) -> None:
        """Fill the table; None empties it."""
        self.setRowCount(0)
        self.verticalHeader().setDefaultSectionSize(theme.px(_ROW_HEIGHT))
        self.setColumnHidden(_WEIGHT, theme.scale() > 1.0)  # the points say it too
        if score is None:
            return
        for row in (*counting(score), *shown_only(score)):
            texts = row_texts(row, score)
            index = self.rowCount()
            self.insertRow(index)
            dim = row.tolerance is None
            cells = (texts.label, texts.value, texts.band, texts.points, texts.weight)
            for column, text in enumerate(cells):
                item = _cell(text, column)
                colour = texts.colour if column == 2 else theme.TEXT_DIM if dim else theme.TEXT
                item.setForeground(QColor(theme.now(colour)))
                item.setToolTip(texts.help)
                self.setItem(index, column, item)


def _cell(text: str, column: int) -> QTableWidgetItem:
    """Cell aligned as its column: words to the left, numbers to the right."""
    item = QTableWidgetItem(text)
    side = Qt.AlignmentFlag.AlignLeft if column in (0, 2) else Qt.AlignmentFlag.AlignRight
    item.setTextAlignment(side | Qt.AlignmentFlag.AlignVCenter)
    return item
