"""What is written over the 3D picture: name, legend, notes, which way one looks."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPen

from app.core.arrays import FloatArray
from app.session.touching import TargetMarks
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.themes import LIGHT
from app.views.scene.display import Display
from app.views.scene.orbit import Orbit

Entry = tuple[tuple[int, int, int], str]
"""Colour, and what has it."""

PRESENT_PX, NUMBER_PX = 12.0, 9.0
"""Radii of the number of the present target, and of another one."""

LEFT, TOP, GAP = 8, 4, 2
COMPASS_PX = 100
"""Height of the compass at the bottom left, which nothing is written over."""


def draw_targets(
    painter: QPainter, places: FloatArray, targets: TargetMarks, display: Display
) -> None:
    """Draw the targets' numbers: on a disc the present one, in rings those ahead, else a tick.

    Args:
        painter: of the pane.
        places: of the targets in it [px], shape (n, 2).
        targets: how they stand.
        display: on which background.
    """
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    order = sorted(range(1, len(places) + 1), key=lambda number: number == targets.present)
    for number in order:  # the present one lies over the others
        at = QPointF(*places[number - 1].tolist())
        was = number <= targets.touched
        present = number == targets.present and not was
        radius = PRESENT_PX if present else NUMBER_PX
        mark = theme.TARGET_TOUCHED if was else theme.TARGET if present else theme.TARGET_AHEAD
        colour = QColor(display.colour(mark.colour))
        ground = QColor(display.background)
        painter.setPen(QPen(colour, 2.5 if present else 1.6))
        painter.setBrush(colour if present else ground)
        painter.drawEllipse(at, radius, radius)
        font = QFont(painter.font())
        font.setPixelSize(round(1.3 * radius))
        font.setBold(True)
        painter.setFont(font)
        painter.setPen(ground if present else colour)
        box = QRectF(at.x() - 2 * radius, at.y() - radius, 4 * radius, 2 * radius)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, "✔" if was else str(number))
    painter.restore()


def draw_words(
    painter: QPainter,
    pane: QRect,
    display: Display,
    error_scale: float,
    legend: tuple[Entry, ...],
    note: str,
    taken: QRect | None = None,
) -> None:
    """Write into a pane.

    Args:
        painter: of the pane.
        pane: its rectangle.
        display: what the picture shows, and on which background.
        error_scale: how much larger than true the tip's error is drawn; 0 where it is not.
        legend: of the structures, as many as there is room for; then says how many more.
        note: at the bottom.
        taken: place at the upper right, such as a button's, which no line covers.
    """
    height = QFontMetrics(painter.font()).height() + GAP
    line = QRect(LEFT, TOP, pane.width() - 2 * LEFT, height)

    def beside() -> QRect:
        """Return the line as far as nothing else stands there."""
        if taken is None or not line.intersects(taken):
            return line
        return QRect(line.topLeft(), QSize(max(0, taken.left() - LEFT - line.left()), height))

    _write(painter, beside(), display, display.text, title(display))
    if error_scale > 0.0:
        line.translate(0, height)
        tip = display.colour(theme.NEEDLE_TIP.colour)
        place, letters = beside(), QFontMetrics(painter.font())
        notes = error_note(error_scale), error_note(error_scale, short=True)
        fitting = [text for text in notes if letters.horizontalAdvance(text) <= place.width()]
        _write(painter, place, display, tip, (*fitting, notes[-1])[0])
    room = max(0, (pane.height() - COMPASS_PX - line.bottom()) // height)
    for rgb, text in fitted(legend, room):
        line.translate(0, height)
        shade = QColor(*rgb)
        _write(
            painter,
            beside(),
            display,
            (shade.darker(150) if display.light else shade.lighter(125)).name(),
            text,
        )
    painter.setPen(QColor(display.text))
    flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignBottom
    letters = QFontMetrics(painter.font())
    place = note_place(pane, max(map(letters.horizontalAdvance, note.split()), default=0))
    painter.drawText(place, flags | Qt.TextFlag.TextWordWrap, note)


def note_place(pane: QRect, longest: int) -> QRect:
    """Return where a note stands: beside the compass, or over it where a word has no room there.

    Args:
        pane: its rectangle.
        longest: width of the longest word [px].
    """
    beside = pane.adjusted(110, 0, -8, -6)
    return beside if longest <= beside.width() else pane.adjusted(LEFT, 0, -LEFT, -COMPASS_PX)


def title(display: Display) -> str:
    """Say what the pane shows."""
    how = (
        (display.xray, tr("x-ray")),
        (display.cut, tr("cut along the needle")),
        (display.slices, tr("with slices")),
    )
    return ", ".join([tr("3D"), *(words for on, words in how if on)])


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


def error_note(scale: float, short: bool = False) -> str:
    """Say how large the tip's error is drawn, in short where there is little room."""
    if short:
        return tr("Error 95 %, {scale:.0f}×", scale=scale)
    if scale == 1.0:
        return tr("Tip error 95 %, true to scale")
    return tr("Tip error 95 %, {scale:.0f}× enlarged", scale=scale)


def _write(painter: QPainter, line: QRect, display: Display, colour: str, text: str) -> None:
    flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
    shown = QFontMetrics(painter.font()).elidedText(text, Qt.TextElideMode.ElideRight, line.width())
    for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.setPen(QColor(display.background))
        painter.drawText(line.translated(dx, dy), flags, shown)
    painter.setPen(QColor(colour))
    painter.drawText(line, flags, shown)


LENGTH_PX = 26.0
_ENDS = (
    ("L", (1, 0, 0)),
    ("R", (-1, 0, 0)),
    ("P", (0, 1, 0)),
    ("A", (0, -1, 0)),
    ("S", (0, 0, 1)),
    ("I", (0, 0, -1)),
)


def compass_ends(orbit: Orbit) -> list[tuple[str, FloatArray]]:
    """Letters and screen vectors (right, down, towards the eye) of the six ends, farthest first."""
    screen = np.array([orbit.right, -np.asarray(orbit.up), orbit.backwards])
    ends = [(letter, screen @ np.asarray(axis, dtype=np.float64)) for letter, axis in _ENDS]
    return sorted(ends, key=lambda end: float(end[1][2]))


def draw_compass(painter: QPainter, orbit: Orbit, middle: QPointF, display: Display) -> None:
    """Draw the axes around `middle`; what points at the viewer is bright and on top."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    font = QFont(painter.font())
    font.setPixelSize(theme.SMALL_PX)
    font.setBold(True)
    painter.setFont(font)
    for letter, (right, down, near) in compass_ends(orbit):
        colour = QColor(LIGHT.warning if display.light else theme.IMAGE_WARNING)
        colour.setAlphaF(0.62 + 0.38 * float(np.clip(near, -1.0, 1.0)))
        painter.setPen(QPen(colour, 1.5))
        tip = middle + QPointF(right, down) * LENGTH_PX
        painter.drawLine(middle, tip)
        place = middle + QPointF(right, down) * (LENGTH_PX + 9.0)
        box = QRectF(place.x() - 10, place.y() - 10, 20, 20)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, letter)
    painter.restore()
