"""The view `control_scan`: its range, and from the pedal to the picture, made beside the window."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from PySide6.QtCore import QObject, QPointF, Signal
from PySide6.QtGui import QPainter

from app.core.events import Event
from app.core.progress import Progress
from app.imaging.scan_order import ScanOrder, middle_of
from app.imaging.volume import Volume
from app.planning.patient import Patient
from app.session.attempt_clock import AttemptClock
from app.session.control_scan import ControlScan
from app.views.exercise.controller import ExerciseController
from app.views.kit.background import run_in_background
from app.views.kit.theme import Mark
from app.views.reading.workspace import WorkspacePage
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.pane import SlicePane
from app.views.slices.plane import SlicePlane

RANGE = Mark("#c9ced3", dash=(1.0, 3.0), width=1.5)


class ScanRange:
    """Two dotted lines where the faces of the scan cut a slice; none in slices along them."""

    def __init__(self, drawing: Drawing) -> None:
        self._order: ScanOrder | None = None
        self._item = _RangeLines()
        drawing.add(self._item)

    def set_order(self, order: ScanOrder | None) -> None:
        """Show this range from the next refresh on; None shows nothing."""
        self._order = order

    @property
    def lines(self) -> tuple[tuple[QPointF, QPointF], ...]:
        """Return what is drawn, in plane millimetres."""
        return self._item.lines

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Draw the lines."""
        found = (
            []
            if self._order is None
            else [
                line
                for z in self._order.range_mm
                for line in [_cut(plane, index, self._order, z)]
                if line is not None
            ]
        )
        self._item.set_lines(tuple(found))

    def hide(self) -> None:
        """Show nothing."""
        self._item.set_lines(())


def attach(pane: SlicePane) -> ScanRange:
    """Let a pane show the range."""
    layer = ScanRange(pane.canvas.drawing)
    pane.canvas.add_layer(layer)
    return layer


def _cut(
    plane: SlicePlane, index: float, order: ScanOrder, z_mm: float
) -> tuple[QPointF, QPointF] | None:
    """Return the ends of the line in which a face of a scan cuts a slice, on its edges.

    `z_mm` is the face's place across the gantry.
    """
    width, height = plane.extent_mm
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    places = [order.in_gantry(np.asarray(plane.lps_mm(x, y, index))) for x, y in corners]
    heights = [float(place[2]) - z_mm for place in places]
    ends = []
    for i, (x, y) in enumerate(corners):
        (u, v), a, b = corners[(i + 1) % 4], heights[i], heights[(i + 1) % 4]
        if (a > 0.0) != (b > 0.0):
            share = a / (a - b)
            ends.append(QPointF(x + share * (u - x), y + share * (v - y)))
    return (ends[0], ends[1]) if len(ends) == 2 else None


class _RangeLines(Shape):
    smooth = False

    def __init__(self) -> None:
        super().__init__(1.0)
        self.lines: tuple[tuple[QPointF, QPointF], ...] = ()

    def set_lines(self, lines: tuple[tuple[QPointF, QPointF], ...]) -> None:
        if lines != self.lines:
            self.lines = lines
            self.touch()

    def paint(self, painter: QPainter) -> None:
        painter.setPen(RANGE.pen())
        for start, end in self.lines:
            painter.drawLine(start, end)


DECLARATION: Final[dict[str, Any]] = {
    "view": "control_scan",
    "title": "Control scans",
    "reads": ("target_shift", "tip_offset"),
}
"""The slices show the patient where breathing has him, the target too."""


class ScanSource(QObject):
    """Connects controller, scan panel and scan view; the newest scan wins.

    Signals:
        failed(object): why a picture could not be made.
    """

    failed = Signal(object)

    def __init__(
        self,
        controller: ExerciseController,
        workspace: WorkspacePage,
        patient: Callable[[], Patient | None],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._controller, self._workspace, self._patient = controller, workspace, patient
        self._panel, self._view = workspace.exercise_panel.scan, workspace.scan_view
        self._panes = workspace.panes
        self.ranges = tuple(attach(pane) for pane in self._panes)
        self._busy, self._waiting = False, False
        self._newest: ControlScan | None = None
        self._clock = AttemptClock()
        controller.event_seen.connect(self._take)
        controller.began.connect(self._begin)
        controller.attached.connect(self._attached)
        self._panel.order_changed.connect(self._show_range)
        self._panel.crosshair_wanted.connect(
            lambda: self._panel.go_to(np.asarray(self._workspace.viewing.cursor_mm))
        )

    @property
    def is_busy(self) -> bool:
        """Return whether a picture is being made."""
        return self._busy

    def _attached(self) -> None:
        run = self._controller.run
        scanning = run is not None and not run.shown.live
        patient = self._patient()
        if patient is not None:
            self._panel.set_isocentre(middle_of(patient.volume))
        self._show_range()
        if not scanning:
            self._view.clear()

    def _show_range(self) -> None:
        run = self._controller.run
        scanning = run is not None and not run.shown.live
        for pane, layer in zip(self._panes, self.ranges, strict=True):
            layer.set_order(self._panel.order if scanning else None)
            pane.canvas.refresh()

    def forget(self) -> None:
        """Let go of scans and their count; a picture that is still being made is not shown."""
        self._begin()

    def _begin(self) -> None:
        self._waiting = False
        self._newest, self._clock = None, AttemptClock()
        self._panel.begin()
        self._view.clear()

    def _take(self, event: Event) -> None:
        run = self._controller.run
        self._clock = self._clock.after(event)
        scan = ControlScan.of(event)
        if scan is None or run is None:
            return
        self._newest = scan
        self._panel.add(scan)
        if self._busy:
            self._waiting = True
        else:
            self._make(scan)

    def _make(self, scan: ControlScan) -> None:
        patient, run = self._patient(), self._controller.run
        if patient is None or run is None:
            return
        self._busy, self._waiting = True, False
        self._panel.set_busy(True)
        volume = patient.volume
        field = None if scan.inside is None else run.trainer.tissues

        def make(_: Progress) -> Volume:
            return scan.picture(volume, field)

        run_in_background(self, make, lambda picture: self._show(picture, scan), self._fail)

    def _show(self, picture: Volume, scan: ControlScan) -> None:
        self._done()
        if scan is self._newest:
            self._view.show_scan(picture, scan, self._clock.at(scan.time))

    def _fail(self, error: Exception) -> None:
        self._done()
        self.failed.emit(error)

    def _done(self) -> None:
        self._busy = False
        self._panel.set_busy(False)
        if self._waiting and self._newest is not None:
            self._make(self._newest)
