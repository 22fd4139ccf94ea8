"""What the three slice panes share: one volume, one crosshair, one window, one tool."""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QObject, Signal

from app.core.arrays import FloatArray, frozen
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.volume import Volume
from app.imaging.window import WindowLevel
from app.planning.draft import DraftPlan
from app.views.error_overlay import ErrorOverlay
from app.views.needle_overlay import NeedleOverlay

FOLLOW_DEAD_BAND_MM = 0.3
"""Slices that follow the tip stay while it moves less than this, so that they do not tremble."""


class Tool(StrEnum):
    """What the left button does in a slice."""

    NAVIGATE = "navigate"
    ENTRY = "entry"
    TARGET = "target"


class Viewing(QObject):
    """State of the slice views; panes draw it and change it through its methods.

    The crosshair is the one point that all slices pass through: scrolling a pane moves it along
    that pane's normal, so slices and crosshairs cannot disagree.

    Signals:
        volume_changed, cursor_changed, window_changed, tool_changed, plan_changed, needle_changed.
        point_placed(Tool, tuple, bool): entry or target was clicked or dragged to an LPS point
            [mm]; the flag is True for the first event of a gesture, a new step to undo.
    """

    volume_changed = Signal()
    cursor_changed = Signal()
    window_changed = Signal()
    tool_changed = Signal()
    plan_changed = Signal()
    needle_changed = Signal()
    point_placed = Signal(object, object, bool)

    def __init__(self, window: WindowLevel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.volume: Volume | None = None
        self.slicer: OrthogonalSlicer | None = None
        self.cursor_mm: FloatArray = frozen(np.zeros(3))
        self.window = window
        self.tool = Tool.NAVIGATE
        self.draft = DraftPlan()
        self.needle: NeedleOverlay | None = None
        self.target_error: ErrorOverlay | None = None
        self.shows_errors = True
        self.follows_tip = False
        self.point_refused = False

    def set_volume(self, volume: Volume) -> None:
        """Show another volume; the crosshair goes to its middle."""
        self.volume, self.slicer = volume, OrthogonalSlicer(volume)
        middle = [(count - 1) / 2 for count in volume.size]
        self.cursor_mm = frozen(volume.lps_mm(middle))
        self.volume_changed.emit()

    def set_cursor(self, lps_mm: ArrayLike) -> None:
        """Move the crosshair to an LPS point [mm], kept inside the volume."""
        if self.volume is None:
            return
        last = np.asarray(self.volume.size) - 1.0
        voxel = np.clip(self.volume.voxel(lps_mm), 0.0, last)
        self.cursor_mm = frozen(self.volume.lps_mm(voxel))
        self.cursor_changed.emit()

    def index(self, view: View) -> int:
        """Slice shown in `view`: the one nearest to the crosshair."""
        return 0 if self.slicer is None else self.slicer.nearest_index(view, self.cursor_mm)

    def show_slice(self, view: View, index: int) -> None:
        """Move the crosshair along the normal of `view` onto slice `index`, kept in range."""
        if self.slicer is None:
            return
        _, column, row = self.slicer.from_lps_mm(view, self.cursor_mm)
        index = min(max(index, 0), self.slicer.count(view) - 1)
        self.cursor_mm = frozen(self.slicer.to_lps_mm(view, index, column, row))
        self.cursor_changed.emit()

    def set_window(self, window: WindowLevel) -> None:
        """Change width and level of all panes."""
        if window != self.window:
            self.window = window
            self.window_changed.emit()

    def set_tool(self, tool: Tool) -> None:
        """Choose what the left button does."""
        if tool is not self.tool:
            self.tool = tool
            self.tool_changed.emit()

    def refuse_point(self) -> None:
        """Note that the point just placed was not taken: the tool stays for another try."""
        self.point_refused = True

    def set_draft(self, draft: DraftPlan) -> None:
        """Show entry and target."""
        self.draft = draft
        self.plan_changed.emit()

    def set_needle(self, needle: NeedleOverlay | None) -> None:
        """Show the live needle (None hides it); the image is not touched unless slices follow."""
        self.needle = needle
        self.needle_changed.emit()
        if needle is None or not needle.valid or not self.follows_tip:
            return
        if np.linalg.norm(needle.tip_mm - self.cursor_mm) > FOLLOW_DEAD_BAND_MM:
            self.set_cursor(needle.tip_mm)

    def set_target_error(self, error: ErrorOverlay | None) -> None:
        """Show how far the target may be from where the CT has it; None where nobody checked."""
        self.target_error = error
        self.plan_changed.emit()

    def set_shows_errors(self, shown: bool) -> None:
        """Draw error ellipses round target and tip, or none."""
        self.shows_errors = shown
        self.plan_changed.emit()
        self.needle_changed.emit()

    def set_follows_tip(self, follows: bool) -> None:
        """Let the slices pass through the needle's tip from now on, or stay."""
        self.follows_tip = follows
        self.set_needle(self.needle)
