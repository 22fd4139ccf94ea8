"""A control scan over the whole main view: its slices side by side, the scan before it below.

Each slice is zoomed on the path, because there the needle is looked for; what is seen of it is the
scan's own picture, without a mark of ours.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QImage,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
    QTransform,
    QWheelEvent,
)
from PySide6.QtWidgets import QGridLayout, QSizePolicy, QWidget

from app.core.arrays import FloatArray
from app.imaging.orthogonal import letters
from app.imaging.scan_order import ScanOrder
from app.imaging.volume import Volume
from app.imaging.window import WindowLevel, to_grey
from app.planning.draft import DraftPlan
from app.views.kit import theme
from app.views.kit.coordinates import axis_words
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, tr
from app.views.slices.edges import EdgeWords, window_line
from app.views.slices.words import PLATE, Worth

ROUND_MM: Final = 30.0
"""What is seen round the path on every side."""

LEAST_PX: Final = 200
"""Width of a slice below which fewer stand side by side."""

_NOTCH: Final = 120

_EDGES: Final = ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0))
"""Directions (LPS) to the left, right, upper and lower edge: `to_pixels` turns nothing."""

_SAME_MM: Final = 1e-3
"""Places along the patient that differ by less are one."""


@dataclass(frozen=True, slots=True, eq=False)
class ScanPicture:
    """A control scan as it is shown.

    Attributes:
        picture: of its slices.
        caption: which it is, in words.
        order: which they are; None for straight ones, which say it themselves.
    """

    picture: Volume
    caption: str
    order: ScanOrder | None = None

    def heights(self) -> FloatArray:
        """Return the slices' places along the patient [mm], shape (n,); of the table if tilted."""
        if self.order is not None:
            return self.order.middles_mm
        number = self.picture.size[2]
        return np.array([self.picture.lps_mm((0, 0, k))[2] for k in range(number)])


class ScanTile(QWidget):
    """One slice, its place along the patient in its corner.

    Signals:
        clicked(): somebody wants to see it larger.

    Args:
        opens: whether a click opens the slice; else there is nothing to click.
    """

    clicked = Signal()

    def __init__(self, parent: QWidget | None = None, opens: bool = True) -> None:
        super().__init__(parent)
        self._opens = opens
        self._image: QImage | None = None
        self._to_mm = QTransform()
        self._box = QRectF(-50.0, -50.0, 100.0, 100.0)
        self._edges = EdgeWords(self)
        self.words = ""
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
        if opens:
            self.setCursor(Qt.CursorShape.PointingHandCursor)
            self.setToolTip(literal(tr("Click: this slice alone, with all that a slice can do")))

    def show_slice(
        self, shot: ScanPicture | None, number: int, window: WindowLevel, box: QRectF
    ) -> None:
        """Show a slice of a scan; None, or a number that it does not have, leaves it black.

        Args:
            shot: the scan.
            number: of the slice, from the feet.
            window: that its grey levels are shown by.
            box: what is to be seen [mm, LPS x and y].
        """
        self._box = box
        if shot is None or not 0 <= number < shot.picture.size[2]:
            self._image, self.words = None, ""
            self.setAccessibleName("")
            for written in self._edges.texts:
                written.set_lines()
            self._arrange()
            return
        volume = shot.picture
        grey = np.ascontiguousarray(to_grey(volume.hu[number], window))
        rows, columns = grey.shape
        borrowed = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        self._image = borrowed.copy()
        first = volume.lps_mm((0, 0, number))
        right, down = volume.lps_mm((1, 0, number)) - first, volume.lps_mm((0, 1, number)) - first
        if shot.order is not None:  # a tilted slice is looked at from across
            first, right, down = (
                shot.order.in_gantry(first),
                right,
                np.array([0.0, np.linalg.norm(down), 0.0]),
            )
        self._to_mm = QTransform(right[0], right[1], down[0], down[1], first[0], first[1])
        self.words = axis_words(2, float(shot.heights()[number]))
        self.setAccessibleName(self.words)
        self._edges.title.set_lines((self.words, Worth.TITLE))
        self._edges.window.set_lines(window_line(window))
        self._edges.set_letters(letters(way) for way in _EDGES)
        self._arrange()

    def to_pixels(self) -> QTransform:
        """Return what takes millimetres of the patient to the tile's pixels: the box in its
        middle.
        """
        box = self._box
        scale = min(self.width() / box.width(), self.height() / box.height())
        middle = box.center()
        made = QTransform()
        made.translate(self.width() / 2.0, self.height() / 2.0)
        made.scale(scale, scale)
        made.translate(-middle.x(), -middle.y())
        return made

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the slice, its place, window and directions, and the ruler."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        if self._image is None:
            return
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.setTransform(self._to_mm * self.to_pixels())
        painter.drawImage(QPointF(-0.5, -0.5), self._image)
        painter.resetTransform()
        title = self._edges.title.geometry().adjusted(-4, -2, 4, 2)
        painter.fillRect(title, PLATE)
        self._edges.paint(painter)
        painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.0))
        painter.drawRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5))

    @property
    def readouts(self) -> EdgeWords:
        """Return the words over the slice."""
        return self._edges

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Find the words their places in the new size."""
        super().resizeEvent(event)
        self._arrange()

    def _arrange(self) -> None:
        self._edges.ruler.set_scale(self.to_pixels().m11())
        self._edges.arrange(ruled=self._image is not None)
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Ask for the slice alone."""
        if self._opens and event.button() == Qt.MouseButton.LeftButton:
            self.clicked.emit()


class ScanWall(QWidget):
    """The newest scan above, the one before it below; the wheel goes through both.

    Signals:
        slice_wanted(int): a slice of the newest scan is to be seen alone.
    """

    slice_wanted = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shots: list[ScanPicture] = []  # the newest first, two at most
        self._box = QRectF(-50.0, -50.0, 100.0, 100.0)
        self._window = WindowLevel(400.0, 40.0)
        self._first, self._wheel = 0, 0
        self._heads = (PlainLabel(self), PlainLabel(self))
        self._rows: tuple[list[ScanTile], list[ScanTile]] = ([], [])
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(2)
        for head in self._heads:
            head.setWordWrap(True)
            head.setProperty("role", "heading")
            head.setContentsMargins(theme.SPACING, 2, theme.SPACING, 2)

    # --- what the view around it calls ------------------------------------------------------------
    def clear(self) -> None:
        """Show nothing of the scans before."""
        self._shots, self._first = [], 0
        self._draw()

    def add(self, shot: ScanPicture, middle: int | None = None) -> None:
        """Take a new scan above the last one, its middle slices in sight.

        `middle` is the number of the slice that is to stand in the middle, as far as there are
        slices on either side of it.
        """
        self._shots = [shot, *self._shots[:1]]
        self._first = (shot.picture.size[2] - self._columns()) // 2
        if middle is not None:
            self._first = middle - self._columns() // 2
        self._draw()

    def look_at(self, draft: DraftPlan) -> None:
        """Zoom on a path: from entry to target with what lies round it."""
        ends = [np.asarray(end) for end in (draft.entry_mm, draft.target_mm) if end is not None]
        if not ends:
            return
        low, high = np.min(ends, axis=0) - ROUND_MM, np.max(ends, axis=0) + ROUND_MM
        self._box = QRectF(low[0], low[1], high[0] - low[0], high[1] - low[1])
        self._draw()

    def set_window(self, window: WindowLevel) -> None:
        """Show all by another window."""
        self._window = window
        self._draw()

    @property
    def tiles(self) -> tuple[tuple[ScanTile, ...], tuple[ScanTile, ...]]:
        """Slices in sight: of the newest scan, of the one before."""
        return tuple(self._rows[0]), tuple(self._rows[1])

    @property
    def captions(self) -> tuple[str, ...]:
        """Return the captions of the scans in sight, the newest first."""
        return tuple(head.text() for head in self._heads if head.text())

    # --- inside -----------------------------------------------------------------------------------
    def _columns(self) -> int:
        there = self._shots[0].picture.size[2] if self._shots else 0
        fits = max(1, self.width() // LEAST_PX)
        return min(there, fits, 3 if self.width() < 6 * LEAST_PX else 5)

    def _draw(self) -> None:
        columns = self._columns()
        most = (self._shots[0].picture.size[2] if self._shots else 0) - columns
        self._first = max(0, min(self._first, most))
        for row, tiles in enumerate(self._rows):
            shot = self._shots[row] if row < len(self._shots) else None
            self._make(row, tiles, columns if shot is not None else 0)
            head = self._heads[row]
            head.setText("" if shot is None else shot.caption)
            head.setVisible(shot is not None)
            self._grid.addWidget(head, 2 * row, 0, 1, max(1, columns))
            self._grid.setRowStretch(2 * row + 1, 0 if shot is None else 1)
            for column, tile in enumerate(tiles):
                number = self._first + columns - 1 - column  # the head is on the left
                tile.show_slice(shot, self._alike(row, number), self._window, self._box)

    def _alike(self, row: int, number: int) -> int:
        """Return the slice that lies where this one of the newest scan does; -1 if none does.

        No slice does that is farther away than half of its own thickness.
        """
        if row == 0:
            return number
        away = np.abs(self._shots[row].heights() - self._shots[0].heights()[number])
        nearest = int(np.argmin(away))
        half = 0.5 * float(self._shots[row].picture.spacing_mm[2])
        return nearest if away[nearest] <= half + _SAME_MM else -1

    def _make(self, row: int, tiles: list[ScanTile], columns: int) -> None:
        while len(tiles) > columns:
            gone = tiles.pop()
            self._grid.removeWidget(gone)
            gone.setParent(None)
            gone.deleteLater()
        while len(tiles) < columns:
            # Of the scan before no slice can be opened: what is seen alone is the newest one's.
            tile, column = ScanTile(self, opens=row == 0), len(tiles)
            tile.clicked.connect(lambda column=column: self._want(column))
            tiles.append(tile)
            self._grid.addWidget(tile, 2 * row + 1, column)
            tile.show()

    def _want(self, column: int) -> None:
        self.slice_wanted.emit(self._first + self._columns() - 1 - column)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show as many slices as there is room for."""
        super().resizeEvent(event)
        if self._shots and len(self._rows[0]) != self._columns():
            self._draw()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Go through the slices of both scans."""
        self._wheel += event.angleDelta().y()
        steps, self._wheel = int(self._wheel / _NOTCH), int(self._wheel % _NOTCH)
        if steps:
            self._first += steps
            self._draw()
