"""The last control scan: its slices, one large and all small, and nothing live."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QIcon, QImage, QPixmap, QResizeEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QHBoxLayout,
    QLabel,
    QStackedLayout,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.imaging.volume import Volume
from app.imaging.window import to_grey
from app.session.control_scan import TEACHING_ESTIMATE, ControlScan
from app.views.kit import theme
from app.views.kit.coordinates import axis_words
from app.views.kit.text import tr
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.viewing import Viewing

THUMB_PX, LEAST_THUMB_PX = 76, 28
"""Width of a small slice where there is room, and the least."""

WORDS_PX = 30
"""Height that a small slice needs beside its picture."""


class ScanView(QWidget):
    """Shows a scan until the next one; scrolling, zoom, window and read-outs as in every slice."""

    def __init__(self, planning: Viewing, parent: QWidget | None = None) -> None:
        """Make an empty view; its window follows that of the `planning` CT, and leads it."""
        super().__init__(parent)
        self.viewing = Viewing(planning.window, self)
        self.pane = SlicePane(self.viewing, PaneId.AXIAL, self)
        self.pane.canvas.layers.crosshair.ends_only = True  # a line would lie on the needle
        self.scan: ControlScan | None = None
        self._planning = planning
        self._caption, self._nothing = QLabel(self), QLabel(self)
        self._strip = QVBoxLayout()
        self._thumbs = QButtonGroup(self)
        self._thumbs.idClicked.connect(self._go_to)
        self._lay_out()
        planning.window_changed.connect(lambda: self.viewing.set_window(planning.window))
        planning.cursor_changed.connect(self._follow_crosshair)
        self.viewing.window_changed.connect(lambda: planning.set_window(self.viewing.window))
        self.viewing.window_changed.connect(self._draw_thumbs)
        self.viewing.cursor_changed.connect(self._check_thumb)
        self.clear()

    def clear(self) -> None:
        """Show that there is no scan yet; nothing of the last one is kept."""
        self.scan = None
        self._caption.clear()
        self._drop_thumbs()
        self._stack.setCurrentIndex(0)

    def show_scan(self, picture: Volume, scan: ControlScan, origin: float) -> None:
        """Show a scan's slices, the middle one large.

        Args:
            picture: of `imaging.scanned`.
            scan: what was ordered.
            origin: moment that its time is told from [s].
        """
        self.scan = scan
        self.viewing.set_volume(picture)
        self._caption.setText(caption(scan, origin))
        self._make_thumbs(picture)
        self._follow_crosshair()
        self._go_to(picture.size[2] // 2)
        self._stack.setCurrentIndex(1)
        self.pane.canvas.fit()

    # --- inside -----------------------------------------------------------------------------------
    def _go_to(self, number: int) -> None:
        self.viewing.show_slice(PaneId.AXIAL, float(number))

    def _follow_crosshair(self) -> None:
        """Stand at the planning CT's crosshair across, and in the scan's own slice."""
        if self.viewing.volume is not None:
            x, y, _ = self._planning.cursor_mm
            self.viewing.set_cursor((x, y, self.viewing.cursor_mm[2]))

    def _drop_thumbs(self) -> None:
        for button in self._thumbs.buttons():
            self._thumbs.removeButton(button)
            self._strip.removeWidget(button)
            button.setParent(None)
            button.deleteLater()

    def _make_thumbs(self, picture: Volume) -> None:
        self._drop_thumbs()
        for number in reversed(range(picture.size[2])):  # the head is up
            button = QToolButton(self)
            button.setCheckable(True)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextUnderIcon)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.setText(axis_words(2, float(picture.lps_mm((0, 0, number))[2])))
            button.setStyleSheet(f"font-size: {theme.SMALL_PX}px; padding: 1px;")
            self._thumbs.addButton(button, number)
            self._strip.insertWidget(self._strip.count() - 1, button)
        self._draw_thumbs()
        self._size_thumbs()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let all small slices fit beside the large one, with their places below them."""
        super().resizeEvent(event)
        self._size_thumbs()

    def _size_thumbs(self) -> None:
        buttons = self._thumbs.buttons()
        room = (self.height() - 2 * WORDS_PX) // max(1, len(buttons)) - WORDS_PX
        side = min(THUMB_PX, max(LEAST_THUMB_PX, room))
        for button in buttons:
            button.setIconSize(QSize(side, side))

    def _draw_thumbs(self) -> None:
        volume = self.viewing.volume
        if volume is None:
            return
        for number, hu in enumerate(volume.hu):
            grey = np.ascontiguousarray(to_grey(hu, self.viewing.window))
            rows, columns = grey.shape
            borrowed = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
            picture = QPixmap.fromImage(borrowed.copy()).scaled(
                THUMB_PX, THUMB_PX, Qt.AspectRatioMode.KeepAspectRatio,
                Qt.TransformationMode.SmoothTransformation,
            )  # fmt: skip
            button = self._thumbs.button(number)
            if button is not None:
                button.setIcon(QIcon(picture))

    def _check_thumb(self) -> None:
        button = self._thumbs.button(round(self.viewing.index(PaneId.AXIAL)))
        if button is not None:
            button.setChecked(True)

    def _lay_out(self) -> None:
        self._nothing.setText(
            tr("No control scan yet.\nSet table and slices, then press the pedal (S).")
        )
        self._nothing.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._nothing.setWordWrap(True)
        self._nothing.setProperty("role", "dim")
        self._caption.setStyleSheet(f"font-size: {theme.SMALL_PX}px; color: {theme.TEXT};")
        self._caption.setWordWrap(True)
        self._strip.setContentsMargins(2, 0, 2, 0)
        self._strip.setSpacing(2)
        self._strip.addStretch(1)
        row = QHBoxLayout()
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.pane, 1)
        row.addLayout(self._strip)
        page = QWidget(self)
        column = QVBoxLayout(page)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addLayout(row, 1)
        column.addWidget(self._caption)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self._nothing)
        self._stack.addWidget(page)


def caption(scan: ControlScan, origin: float) -> str:
    """Say which scan it is; what it shows of the needle is for the eyes."""
    order = scan.order
    return tr(
        "Control scan {n} at {time:.0f} s · {slices} × {mm:g} mm · {dose:.1f} mGy·cm ({estimate})",
        n=scan.number, time=scan.time - origin, slices=order.slices, mm=order.slice_mm,
        dose=scan.dose, estimate=tr(TEACHING_ESTIMATE),
    )  # fmt: skip
