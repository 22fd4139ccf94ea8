"""Both camera pictures with the found marker, and how well they agree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.views import theme
from app.views.exercise.camera_view import CameraView
from app.views.exercise.status_items import StatusItem
from app.views.text import tr

if TYPE_CHECKING:
    from app.tracking.tracker import TrackedPicture

REFRESH: Final = 1.0 / 15.0
"""Shortest time between two refreshes [s]."""


@dataclass(frozen=True, slots=True)
class TrackerFigures:
    """How the tracker is.

    Attributes:
        rate: stereo pairs per second.
        residual_px: distance from the epipolar geometry [px]; None without a fix.
        item: its line in the status strip.
    """

    rate: float
    residual_px: float | None
    item: StatusItem


class TrackerPanel(QWidget):
    """Two pictures, one above the other, and two lines of figures."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.cameras = (CameraView(self), CameraView(self))
        self._verdict, self._figures = QLabel(self), QLabel(self)
        self._shown = -1e9
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.SPACING, theme.SPACING, theme.SPACING, theme.SPACING)
        for camera in self.cameras:
            column.addWidget(camera, 1)
        for line in (self._verdict, self._figures):
            line.setWordWrap(True)
            column.addWidget(line)

    def due(self, now: float) -> bool:
        """Whether the pictures may be refreshed at `now` [s] and anybody would see it."""
        return self.isVisible() and now - self._shown >= REFRESH

    def show_tracker(
        self, pictures: Sequence[TrackedPicture], figures: TrackerFigures, now: float
    ) -> None:
        """Show the newest pictures and figures."""
        self._shown = now
        for i, camera in enumerate(self.cameras):
            camera.show_picture(pictures[i] if i < len(pictures) else None)
        colour, symbol = figures.item.verdict.look
        self._verdict.setStyleSheet(f"color: {colour};")
        self._verdict.setText(f"{symbol} {figures.item.text}")
        self._verdict.setToolTip(figures.item.help)
        residual = (
            tr("epipolar residual –")
            if figures.residual_px is None
            else tr("epipolar residual {px:.2f} px", px=figures.residual_px)
        )
        self._figures.setText(tr("{rate:.0f} pairs/s", rate=figures.rate) + "  ·  " + residual)
        self._figures.setToolTip(
            tr("How far the two pictures disagree; above 1 px the calibration should be checked")
        )
