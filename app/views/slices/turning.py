"""The three patient views turned about the crosshair, by dragging its lines, and straight again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, hypot

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QPointF
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QMenu

from app.core.arrays import FloatArray, unit
from app.core.rotation import rotation_exp
from app.imaging.reformat import Frame, trace
from app.views.kit.text import tr
from app.views.slices.canvas import SliceCanvas
from app.views.slices.panes import MPR_PANES, PaneId, others
from app.views.slices.slab import PlanePoint
from app.views.slices.viewing import Tool, Viewing

SNAP_RAD = 0.012
"""A turn that ends nearer than this to where it began goes back there exactly."""


@dataclass(frozen=True, slots=True, eq=False)
class StartingPlanes:
    """Planes as they were when a turn began: turned from here, small steps do not add up errors.

    Attributes:
        frames: of the panes that turn, and the directions in which their slices count up.
        straight: whether each of them was the volume's own.
    """

    frames: dict[PaneId, tuple[Frame, FloatArray]]
    straight: dict[PaneId, bool]

    @classmethod
    def of(cls, viewing: Viewing, panes: Sequence[PaneId]) -> StartingPlanes:
        """Remember the planes of these panes."""
        own = {pane: viewing.own(pane) for pane in panes}
        known = {pane: plane for pane, plane in own.items() if plane is not None}
        return cls(
            {pane: (plane.frame(0.0), plane.ahead) for pane, plane in known.items()},
            {pane: not viewing.is_oblique(pane) for pane in known},
        )


def turn_planes(viewing: Viewing, start: StartingPlanes, axis: ArrayLike, angle: float) -> None:
    """Turn planes about the crosshair, away from where they were.

    Args:
        viewing: whose planes.
        start: as they were.
        axis: in LPS, shape (3,).
        angle: by the right-hand rule [rad].
    """
    turn = rotation_exp(angle * unit(axis, "axis"))
    back = abs(np.arctan2(np.sin(angle), np.cos(angle))) < SNAP_RAD
    for pane, (frame, ahead) in start.frames.items():
        if back and start.straight[pane]:
            viewing.set_frame(pane, None)
        else:
            turned = frame.turned(axis, angle, viewing.cursor_mm)
            viewing.set_frame(pane, turned, turn @ ahead)


def is_turned(viewing: Viewing) -> bool:
    """Return whether any of the three patient views is oblique."""
    return any(viewing.is_oblique(pane) for pane in MPR_PANES)


def straighten(viewing: Viewing) -> None:
    """Go back to the volume's own slices in all three views; the crosshair stays."""
    for pane in MPR_PANES:
        if viewing.is_oblique(pane):
            viewing.set_frame(pane, None)


GRAB_PX = 6.0
FREE_PX = 48.0
"""So near to the crosshair a line is not grabbed: there one looks and places marks."""

MARK_PX = 14.0
"""Marks go before lines."""


class LineGrip:
    """Drags the traces of the two other planes in one of the three patient views.

    Both planes turn together about this pane's normal through the crosshair, so that all three stay
    at right angles; this pane's own picture does not change.
    """

    def __init__(self, canvas: SliceCanvas) -> None:
        self._canvas = canvas
        self._start: StartingPlanes | None = None
        self._angle = 0.0

    def grab(self, position: QPointF, event: QMouseEvent) -> bool:
        """Take hold of the line under a pixel of the pane."""
        if not self.hover(position):
            return False
        self._start = StartingPlanes.of(self._canvas.viewing, others(self._canvas.pane))
        self._angle = self._angle_at(position)
        return True

    def drag(self, position: QPointF) -> None:
        """Turn both planes by what the mouse has gone round the crosshair."""
        plane = self._canvas.plane
        if self._start is None or plane is None:
            return
        normal = plane.frame(self._canvas.index).normal  # into the screen: clockwise is positive
        turn_planes(
            self._canvas.viewing, self._start, normal, self._angle_at(position) - self._angle
        )

    def drop(self, position: QPointF) -> None:
        """Leave the planes as they are."""
        self._start = None

    def hover(self, position: QPointF) -> bool:
        """Return whether a line lies under a pixel, away from the crosshair and from marks."""
        viewing, plane = self._canvas.viewing, self._canvas.plane
        if plane is None or viewing.tool is not Tool.NAVIGATE:
            return False
        at = self._canvas.plane_at(position)
        scale = self._canvas.camera.scale
        middle = self._middle()
        if hypot(at[0] - middle.x, at[1] - middle.y) * scale < FREE_PX or self._on_mark(position):
            return False
        this = plane.frame(self._canvas.index)
        return any(
            frame is not None and _distance(this, frame, at) * scale <= GRAB_PX
            for frame in map(viewing.frame, others(self._canvas.pane))
        )

    def _middle(self) -> PlanePoint:
        plane = self._canvas.plane
        if plane is None:
            return PlanePoint(0.0, 0.0, 0.0)
        return plane.point(self._canvas.viewing.cursor_mm, self._canvas.index)

    def _angle_at(self, position: QPointF) -> float:
        x, y = self._canvas.plane_at(position)
        middle = self._middle()
        return atan2(y - middle.y, x - middle.x)

    def _on_mark(self, position: QPointF) -> bool:
        plane, draft = self._canvas.plane, self._canvas.viewing.draft
        for point in (draft.entry_mm, draft.target_mm):
            if point is None or plane is None:
                continue
            at = plane.point(point, self._canvas.index)
            away = self._canvas.pixel_at(at.x, at.y) - position
            if abs(at.distance) <= plane.half_slab_mm and hypot(away.x(), away.y()) <= MARK_PX:
                return True
        return False


def fill_turn_menu(menu: QMenu, viewing: Viewing) -> None:
    """Add the way back to the volume's own slices."""
    menu.addSeparator()
    action = menu.addAction(tr("Straighten all planes"))
    action.setEnabled(is_turned(viewing))
    action.triggered.connect(lambda _=False: straighten(viewing))


def _distance(this: Frame, other: Frame, at: tuple[float, float]) -> float:
    """Distance of a place [mm] from the line in which another plane cuts this one."""
    line = trace(this, other)
    if line is None:
        return float("inf")
    x, y, dx, dy = line
    return abs((at[0] - x) * dy - (at[1] - y) * dx)
