"""The margin about a lesion as a map of its surface: planned beside reached, and both in figures.

The surface is unrolled about the lesion's middle: from right over front to left and back along,
head above, feet below. Each field has its margin in millimetres, a colour, and, where it is less
than wanted, a hatching: neither stands alone.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QFontMetrics, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import (
    QHeaderView,
    QSizePolicy,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.arrays import FloatArray
from app.session.ablation_shown import AblationShown, MarginsShown
from app.views.exercise.ablation_panel import warnings
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import number, tr
from app.views.slices.items import label_font
from app.views.slices.zones import BARE, ENOUGH, LITTLE, legend, mark_of

AROUND: Final = 12
UP: Final = 6
"""Fields of the map about the lesion and from feet to head."""

_ROW_HEIGHT: Final = 26
_HATCHED: Final = {
    ENOUGH.colour: None,
    LITTLE.colour: Qt.BrushStyle.BDiagPattern,
    BARE.colour: Qt.BrushStyle.DiagCrossPattern,
}


def fields(margins: MarginsShown) -> FloatArray:
    """Return the least margin of each field [mm], shape (UP, AROUND), head first; NaN for none.

    Columns run from the patient's right over front and left to the back.
    """
    away = margins.at_mm - margins.at_mm.mean(axis=0)
    left, back, head = away.T / np.maximum(np.linalg.norm(away, axis=1), 1e-9)
    turn = (np.arctan2(-back, -left) + np.pi / AROUND) % (2.0 * np.pi)  # 0 right, π/2 front
    column = np.minimum((turn / (2.0 * np.pi) * AROUND).astype(int), AROUND - 1)
    # Equal heights of a sphere have equal areas.
    row = np.clip(((1.0 - head) / 2.0 * UP).astype(int), 0, UP - 1)
    found = np.full((UP, AROUND), np.inf)
    np.minimum.at(found, (row, column), margins.margin_mm)
    return np.where(np.isfinite(found), found, np.nan)


class MarginMap(QWidget):
    """One map."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.title = ""
        self._fields: FloatArray | None = None
        self._wanted = 0.0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setToolTip(
            tr("The lesion's surface unrolled: margin in mm; hatched where less than wanted")
        )

    def sizeHint(self) -> QSize:
        """Return room for figures in every field."""
        height = QFontMetrics(label_font()).height()
        return QSize(300, (UP + 2) * (height + 3) + 4)

    def minimumSizeHint(self) -> QSize:
        """Return the same height, and as little width as figures need."""
        return QSize(220, self.sizeHint().height())

    def show_margins(self, title: str, margins: MarginsShown | None, wanted_mm: float) -> None:
        """Draw other margins."""
        self.title, self._wanted = title, wanted_mm
        self._fields = None if margins is None else fields(margins)
        self.setAccessibleName(title)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the fields with their figures."""
        if self._fields is None:
            return
        painter = QPainter(self)
        painter.setFont(label_font())
        line = QFontMetrics(painter.font()).height() + 3
        painter.setPen(QColor(theme.TEXT))
        flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(QRectF(0, 0, self.width(), line), flags, self.title)
        wide = self.width() / AROUND
        for (row, column), margin in np.ndenumerate(self._fields):
            box = QRectF(column * wide, (row + 1) * line, wide, line)
            self._field(painter, box, float(margin))
        self._sides(painter, line, wide)

    def _field(self, painter: QPainter, box: QRectF, margin: float) -> None:
        painter.setPen(QPen(QColor(theme.IMAGE_GROUND), 1.0))
        if not np.isfinite(margin):
            painter.fillRect(box, QColor(theme.IMAGE_GROUND))
            return
        mark = mark_of(margin, self._wanted)
        painter.fillRect(box, QColor(mark.colour))
        pattern = _HATCHED[mark.colour]
        if pattern is not None:
            painter.fillRect(box, QBrush(QColor("#000000"), pattern))
        painter.drawRect(box)
        words = tr("<0") if margin < 0.0 and round(margin) == 0 else number(margin, ".0f")
        room = QFontMetrics(painter.font()).boundingRect(words).adjusted(-2, -1, 2, 1)
        plate = QRectF(room)
        plate.moveCenter(box.center())
        painter.fillRect(plate, QColor(mark.colour))
        painter.setPen(QColor("#000000"))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, words)

    def _sides(self, painter: QPainter, line: int, wide: float) -> None:
        painter.setPen(QColor(theme.TEXT))
        top = (UP + 1) * line
        for turn, words in enumerate((tr("right"), tr("front"), tr("left"), tr("back"))):
            left = turn * AROUND / 4 * wide
            box = QRectF(left, top, AROUND / 4 * wide, line)
            painter.drawText(box, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, words)


class AblationReview(QWidget):
    """Planned against reached: two maps, a table, and what is to be warned of."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.planned, self.reached = MarginMap(self), MarginMap(self)
        self.table = QTableWidget(0, 3, self)
        self.notes, self.key = PlainLabel(self), PlainLabel(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        for widget in (self.planned, self.reached, self.table, self.notes, self.key):
            column.addWidget(widget)
        self.notes.setWordWrap(True)
        self.key.setWordWrap(True)
        self.key.setStyleSheet(f"color: {theme.TEXT_DIM}; font-size: {theme.SMALL_PX}px;")
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.table.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        self.table.setWordWrap(False)
        self.table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.table.setSelectionMode(QTableWidget.SelectionMode.NoSelection)
        self.table.setTabKeyNavigation(False)
        self.table.setShowGrid(False)
        self.table.setAccessibleName(tr("Ablation: planned against reached"))
        self.table.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.table.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(header.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(0, header.ResizeMode.Stretch)
        self.hide()

    def show_ablation(self, shown: AblationShown | None) -> None:
        """Show an ablation, or nothing."""
        self.setVisible(shown is not None)
        if shown is None or shown.reached is None:
            self.hide()
            return
        self.planned.show_margins(tr("Margin planned [mm]"), shown.planned, shown.wanted_mm)
        self.reached.show_margins(tr("Margin reached [mm]"), shown.reached, shown.wanted_mm)
        rows = table_rows(shown)
        for column, title in enumerate((tr("Ablation"), tr("Planned"), tr("Reached"))):
            self.table.setHorizontalHeaderItem(column, QTableWidgetItem(title))
        self.table.setRowCount(len(rows))
        for row, cells in enumerate(rows):
            for column, text in enumerate(cells):
                self.table.setItem(row, column, QTableWidgetItem(text))
        height = self.table.horizontalHeader().sizeHint().height() + 8
        self.table.setFixedHeight(height + _ROW_HEIGHT * len(rows))
        lines = warnings(shown.reached)
        if shown.ex_vivo:
            lines.append(tr("▲ Zones ex vivo: without blood, larger than in a patient"))
        self.notes.setText("\n".join(lines))
        self.notes.setVisible(bool(lines))
        self.key.setText(legend())


def table_rows(shown: AblationShown) -> list[tuple[str, str, str]]:
    """Return the rows of the table: name, planned, reached."""
    reached = shown.reached or shown.planned
    rows = [
        (
            tr("Least margin (wanted {mm:g} mm)", mm=shown.wanted_mm),
            tr("{mm:.1f} mm", mm=shown.planned.least_mm),
            tr("{mm:.1f} mm", mm=reached.least_mm),
        ),
        (
            tr("Lesion ablated"),
            tr("{share:.1f} %", share=100.0 * shown.planned.share),
            tr("{share:.1f} %", share=100.0 * reached.share),
        ),
    ]
    rows += [
        (tr("Electrode {n}, off its place", n=n), "–", tr("{mm:.1f} mm", mm=off))
        for n, off in enumerate(shown.off_mm, start=1)
    ]
    if shown.setting is not None:
        power, minutes = shown.setting
        words = tr("{power:g} W, {minutes:g} min", power=power, minutes=minutes)
        rows.append((tr("Generator"), "", words))
    return rows
