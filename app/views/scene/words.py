"""What is written over the 3D picture: its name, the scale of errors, a legend, a note."""

from __future__ import annotations

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter

from app.views.kit import theme
from app.views.kit.text import tr

Entry = tuple[tuple[int, int, int], str]
"""Colour, and what has it."""

LEFT, TOP, GAP = 8, 4, 2
COMPASS_PX = 100
"""Height of the compass at the bottom left, which nothing is written over."""


def draw_words(
    painter: QPainter, pane: QRect, error_scale: float, legend: tuple[Entry, ...], note: str
) -> None:
    """Write into a pane.

    Args:
        painter: of the pane.
        pane: its rectangle.
        error_scale: how much larger than true the tip's error is drawn; 0 where it is not.
        legend: of the structures, as many as there is room for; then says how many more.
        note: at the bottom.
    """
    height = QFontMetrics(painter.font()).height() + GAP
    line = QRect(LEFT, TOP, pane.width() - 2 * LEFT, height)
    _write(painter, line, theme.IMAGE_TEXT, tr("3D"))
    if error_scale > 0.0:
        line.translate(0, height)
        _write(painter, line, theme.NEEDLE_TIP.colour, error_note(error_scale))
    room = max(0, (pane.height() - COMPASS_PX - line.bottom()) // height)
    for rgb, text in fitted(legend, room):
        line.translate(0, height)
        _write(painter, line, QColor(*rgb).lighter(125).name(), text)
    painter.setPen(QColor(theme.IMAGE_TEXT))
    flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignBottom
    painter.drawText(pane.adjusted(110, 0, -8, -6), flags | Qt.TextFlag.TextWordWrap, note)


def fitted(legend: tuple[Entry, ...], room: int) -> tuple[Entry, ...]:
    """Return as many lines as there is room for, the last one saying how many are left out."""
    if len(legend) <= room:
        return legend
    if room < 1:
        return ()
    kept = legend[: room - 1]
    grey = QColor(theme.IMAGE_DIM)
    rest = tr("and {count} more", count=len(legend) - len(kept))
    return (*kept, ((grey.red(), grey.green(), grey.blue()), rest))


def error_note(scale: float) -> str:
    """Say how large the tip's error is drawn."""
    if scale == 1.0:
        return tr("Tip error 95 %, true to scale")
    return tr("Tip error 95 %, {scale:.0f}× enlarged", scale=scale)


def _write(painter: QPainter, line: QRect, colour: str, text: str) -> None:
    flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
    shown = QFontMetrics(painter.font()).elidedText(text, Qt.TextElideMode.ElideRight, line.width())
    for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.setPen(QColor(theme.IMAGE_BACKGROUND))
        painter.drawText(line.translated(dx, dy), flags, shown)
    painter.setPen(QColor(colour))
    painter.drawText(line, flags, shown)
