"""The brush: a drag in a slice paints, erases or grows the chosen structure."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPen

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.imaging.structures.structure import free_name
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.slices.canvas import SliceCanvas
from app.views.slices.drawing import Shape
from app.views.structures.book import StructureBook


class Mode(StrEnum):
    """What a drag does."""

    OFF = "off"
    PAINT = "paint"
    ERASE = "erase"
    GROW = "grow"


@dataclass(frozen=True, slots=True)
class Settings:
    """Of the brush.

    Attributes:
        mode: what a drag does.
        radius_mm: of the ball that it paints with.
        low, high: limits of what is grown, and painted where `limited` [HU].
        limited: whether painting keeps to the limits.
    """

    mode: Mode = Mode.OFF
    radius_mm: float = 6.0
    low: float = -50.0
    high: float = 250.0
    limited: bool = False


class Brush(QObject):
    """The settings, shared by all panes.

    Signals:
        changed(): other settings.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.settings = Settings()

    def set(self, **fields: object) -> None:
        """Change settings."""
        self.settings = replace(self.settings, **fields)  # type: ignore[arg-type]
        self.changed.emit()


class Ring(Shape):
    """The brush's size round the mouse."""

    smooth = False

    def __init__(self) -> None:
        super().__init__(6.0, visible=False)
        self._middle, self._radius_mm = QPointF(), 0.0
        self._pen = QPen(QColor(theme.IMAGE_TEXT), 1.5)
        self._pen.setCosmetic(True)

    def place(self, x: float, y: float, radius_mm: float) -> None:
        """Stand round (x, y) [mm]."""
        self._middle, self._radius_mm = QPointF(x, y), radius_mm
        self.touch()

    def paint(self, painter: QPainter) -> None:
        """Draw the ring."""
        painter.setPen(self._pen)
        painter.drawEllipse(self._middle, self._radius_mm, self._radius_mm)


class BrushGrip:
    """Takes the left button of one pane while the brush is on; one drag is one step to undo."""

    def __init__(self, canvas: SliceCanvas, book: StructureBook, brush: Brush) -> None:
        self._canvas, self._book, self._brush = canvas, book, brush
        self._name, self._fresh = "", False
        self._last: FloatArray | None = None
        self._ring = Ring()
        canvas.drawing.add(self._ring)
        canvas.left.connect(lambda: self._ring.setVisible(False))

    def grab(self, position: QPointF, event: QMouseEvent) -> bool:
        """Begin a stroke while the brush is on; grow at once."""
        mode, book = self._brush.settings.mode, self._book
        if mode is Mode.OFF or book.volume is None or book.locked:
            return False
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            return False
        selected = book.selected
        names = [one.name for one in book.structures]
        self._name = selected.name if selected is not None else free_name(tr("new"), names)
        self._fresh, self._last = True, None
        self._work(position)
        return True

    def drag(self, position: QPointF) -> None:
        """Go on painting."""
        self.hover(position)
        if self._brush.settings.mode is not Mode.GROW:
            self._work(position)

    def drop(self, position: QPointF) -> None:
        """End the stroke."""
        self._last = None

    def hover(self, position: QPointF) -> bool:
        """Show how large the brush is."""
        settings = self._brush.settings
        shown = settings.mode in (Mode.PAINT, Mode.ERASE) and not self._book.locked
        self._ring.setVisible(shown)
        if shown:
            self._ring.place(*self._canvas.plane_at(position), settings.radius_mm)
        return shown

    def _work(self, position: QPointF) -> None:
        at = self._canvas.lps_at(position)
        try:
            if self._brush.settings.mode is Mode.GROW:
                self._grow(at)
            else:
                self._paint(at)
        except AcusError as error:
            self._book.refused.emit(error)

    def _grow(self, at: FloatArray) -> None:
        from app.imaging.structures.edit import grown  # scipy: loaded since there is a volume

        volume, settings = self._book.volume, self._brush.settings
        if volume is None:
            return
        mask, corner = grown(volume, at, settings.low, settings.high)
        selected = self._book.selected
        if selected is not None:
            whole = selected.full(volume.hu.shape)
            i, j, k = corner
            depth, height, width = mask.shape
            whole[k : k + depth, j : j + height, i : i + width] |= mask
            from app.imaging.structures.structure import cropped

            mask, corner = cropped(whole)
        self._book.put(self._name, mask, corner)

    def _paint(self, at: FloatArray) -> None:
        """Paint from the last place to this one, in steps of half the radius."""
        from app.imaging.structures.edit import brushed  # scipy: loaded since there is a volume

        volume, settings = self._book.volume, self._brush.settings
        if volume is None:
            return
        start = at if self._last is None else self._last
        far = float(np.linalg.norm(at - start))
        if self._last is not None and far < 0.25 * settings.radius_mm:
            return
        steps = max(1, int(np.ceil(2.0 * far / settings.radius_mm)))
        centres = start + np.outer(np.arange(1, steps + 1) / steps, at - start)
        limits = (settings.low, settings.high) if settings.limited else None
        old = next((one for one in self._book.structures if one.name == self._name), None)
        new = brushed(old, volume, centres, settings.radius_mm, settings.mode is Mode.PAINT, limits)
        if new is None:
            if old is not None:
                self._book.remove(self._name)
        elif old is None or new[0] is not old.mask:
            self._book.put(self._name, *new, starts_step=self._fresh)
            self._fresh = False
        self._last = at
