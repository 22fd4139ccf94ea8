"""What the needle's panes are laid along: the live needle, the planned path, or two points."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QMenu

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.planning.needle_planes import (
    NeedleFrame,
    follow,
    frame_of,
    in_plane,
    in_plane_90,
    probe,
    through,
)
from app.views.kit.text import tr, translated
from app.views.slices.panes import NEEDLE_PANES, PaneId
from app.views.slices.viewing import Tool, Viewing

_VIEWS = {PaneId.IN_PLANE: in_plane, PaneId.IN_PLANE_90: in_plane_90, PaneId.PROBE: probe}


class Along(StrEnum):
    """What the needle's panes go by."""

    NEEDLE = "needle"
    HELD = "held"
    PATH = "path"
    POINTS = "points"


class NeedlePlanes(QObject):
    """Lays the three panes along the needle, beyond dead bands, and keeps them when held.

    While there is no needle to follow, the panes show the planned path.

    Attributes:
        along: what they go by.
        frame: needle, path or points as the panes show them; None while there is nothing.
        laid_along: what that is: needle, path or points.

    Signals:
        changed(): another source, or the panes are laid anew.
        refused(object): why points give no plane, as text.
    """

    changed = Signal()
    refused = Signal(object)

    def __init__(self, viewing: Viewing, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._viewing = viewing
        self.along = Along.NEEDLE
        self.frame: NeedleFrame | None = None
        self.laid_along = Along.NEEDLE
        self._watched = False
        viewing.needle_changed.connect(self._follow)
        viewing.plan_changed.connect(self._follow)
        viewing.volume_changed.connect(self._start)

    def set_watched(self, watched: bool) -> None:
        """Tell whether anybody sees the panes: unseen they cost nothing."""
        self._watched = watched
        if watched:
            self._follow()

    def follow_needle(self) -> None:
        """Go with the live needle from now on."""
        self._set(Along.NEEDLE)

    def hold(self) -> None:
        """Stay where the panes are, whatever the needle does."""
        if self.frame is not None:
            self._set(Along.HELD)

    def show_path(self) -> None:
        """Go along the planned path, with its target in the middle."""
        self._set(Along.PATH)

    def show_points(self, a_mm: ArrayLike, b_mm: ArrayLike, normal: ArrayLike) -> None:
        """Lay the in-plane view through two points and a direction, without any needle."""
        try:
            frame = through(a_mm, b_mm, normal)
        except AcusError as error:
            self.refused.emit(translated(error))
            return
        self.along = self.laid_along = Along.POINTS
        self._lay(frame)
        self.changed.emit()

    @property
    def shows_path(self) -> bool:
        """Return whether the panes lie along the planned path."""
        return self.laid_along is Along.PATH

    def words(self) -> str:
        """Say what the panes show."""
        if self.frame is None:
            return tr("no needle, no path")
        if self.along is Along.HELD:
            return tr("held")
        if self.along is Along.POINTS:
            return tr("through two points")
        return tr("planned path") if self.shows_path else tr("follows the needle")

    def _set(self, along: Along) -> None:
        self.along = along
        if along is Along.NEEDLE:
            self.frame = None  # nothing of what was held is carried along
        self._follow()
        self.changed.emit()

    def _start(self) -> None:
        self.along, self.frame, self.laid_along = Along.NEEDLE, None, Along.NEEDLE
        self._follow()

    def _follow(self) -> None:
        if not self._watched or self._viewing.volume is None:
            return
        if self.along in (Along.HELD, Along.POINTS):
            return
        needle = self._viewing.needle
        if self.along is Along.NEEDLE and needle is not None:
            if needle.valid:  # else the last good pose stays
                last = None if self.shows_path else self.frame
                self.laid_along = Along.NEEDLE
                self._take(last, needle.tip_mm, needle.tip_mm - needle.start_mm)
            return
        self._show_path()

    def _show_path(self) -> None:
        ends = self.path_mm
        self.laid_along = Along.NEEDLE if ends is None else Along.PATH
        if ends is None:
            self._lay(None)
            return
        entry, target = ends
        exact, last = frame_of(target, target - entry), self.frame
        if last is None or not _alike(last, exact):
            self._lay(exact)

    @property
    def path_mm(self) -> tuple[FloatArray, FloatArray] | None:
        """Entry and target, if both are there and apart."""
        draft = self._viewing.draft
        if draft.entry_mm is None or draft.target_mm is None:
            return None
        entry, target = np.asarray(draft.entry_mm), np.asarray(draft.target_mm)
        return (entry, target) if np.linalg.norm(target - entry) > 1.0 else None

    def _take(self, last: NeedleFrame | None, tip_mm: FloatArray, axis: FloatArray) -> None:
        frame = follow(last, tip_mm, axis)
        if frame is not last:
            self._lay(frame)

    def _lay(self, frame: NeedleFrame | None) -> None:
        if frame is None and self.frame is None:
            return
        self.frame = frame
        for pane in NEEDLE_PANES:
            self._viewing.set_frame(pane, None if frame is None else _VIEWS[pane](frame))
        self.changed.emit()


def _alike(item: NeedleFrame, other: NeedleFrame) -> bool:
    pairs = ((item.tip_mm, other.tip_mm), (item.axis, other.axis), (item.y, other.y))
    return all(np.abs(a - b).max() < 1e-9 for a, b in pairs)


def fill_needle_menu(menu: QMenu, planes: NeedlePlanes, viewing: Viewing) -> None:
    """Add the choices, the present one checked."""
    entries: tuple[tuple[str, Along, Callable[[], object], bool], ...] = (
        (tr("Follow the needle"), Along.NEEDLE, planes.follow_needle, True),
        (tr("Hold here"), Along.HELD, planes.hold, planes.frame is not None),
        (tr("Along the planned path"), Along.PATH, planes.show_path, planes.path_mm is not None),
        (
            tr("Through two points…"),
            Along.POINTS,
            lambda: viewing.set_tool(Tool.PLANE),
            viewing.volume is not None,
        ),
    )
    menu.addSeparator()
    for text, along, command, enabled in entries:
        action = menu.addAction(text)
        action.setCheckable(True)
        action.setChecked(planes.along is along)
        action.setEnabled(enabled)
        action.triggered.connect(lambda _=False, command=command: command())
    menu.addSeparator()
    traces = menu.addAction(tr("Lines in the patient views"))
    traces.setCheckable(True)
    traces.setChecked(viewing.shows_traces)
    traces.triggered.connect(viewing.set_shows_traces)
