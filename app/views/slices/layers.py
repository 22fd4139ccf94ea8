"""Layers over the image: crosshair, plan and needle, placed anew when what they show changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QPointF

from app.imaging.reformat import Frame, trace
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.theme import Mark
from app.views.slices.cross_line import CrossLine
from app.views.slices.drawing import Drawing, Ink
from app.views.slices.items import MarkItem, SegmentItem
from app.views.slices.labels import arrange
from app.views.slices.panes import PANE_MARKS, PaneId, crossing_panes
from app.views.slices.plane import SlicePlane
from app.views.slices.slab import PlanePoint, crossing, pieces
from app.views.slices.viewing import Viewing

FADED, FAINTEST = 0.75, 0.25
FAINTEST_MM = 50.0
"""A segment is faintest so far off the slice [mm]."""

_SHARES = np.linspace(0.0, 1.0, 24)[:, None]
"""Points on a line, near enough to each other that no label slips between them."""


class CrosshairLayer:
    """The traces of the two other panes of the family, in their colours.

    Attributes:
        ends_only: draw their ends alone, so that they cover nothing of the picture.
    """

    def __init__(self, drawing: Drawing, viewing: Viewing, pane: PaneId) -> None:
        self._viewing = viewing
        self.ends_only = False
        self._lines = {other: CrossLine(PANE_MARKS[other]) for other in crossing_panes(pane)}
        for line in self._lines.values():
            line.setVisible(False)
            drawing.add(line)

    @property
    def traced(self) -> frozenset[PaneId]:
        """Panes whose traces it shows."""
        return frozenset(self._lines)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Cross where the three planes meet."""
        this = plane.frame(index)
        traces = {other: self._trace(this, other) for other in self._lines}
        cuts = [cut for cut in traces.values() if cut is not None]
        meeting = crossing(cuts[0], cuts[1]) if len(cuts) == 2 else None
        for other, line in self._lines.items():
            cut = traces[other]
            if cut is None:
                line.setVisible(False)
                continue
            at = meeting or cut[:2]
            line.place(at, cut[2:], plane.bounds_mm, scale, self.ends_only)

    def hide(self) -> None:
        """Show nothing."""
        for line in self._lines.values():
            line.setVisible(False)

    def _trace(self, this: Frame, other: PaneId) -> tuple[float, float, float, float] | None:
        frame = self._viewing.frame(other)
        return None if frame is None else trace(this, frame)


def fading(distance_mm: float, half_mm: float) -> float:
    """Opacity of what lies so far off a slice of this half thickness, outside it."""
    share = (distance_mm - half_mm) / (FAINTEST_MM - half_mm)
    return FADED + (FAINTEST - FADED) * min(max(share, 0.0), 1.0)


class SegmentLayer:
    """A segment in space: solid in the slab, outside dashed and the fainter the farther off."""

    def __init__(self, drawing: Drawing, mark: Mark, z: float) -> None:
        self._solid, self._broken = Ink.of(mark), Ink.of(mark, dash=(4.0, 3.0))
        self._items = [SegmentItem(z) for _ in range(3)]
        for item in self._items:
            drawing.add(item)

    def place(self, start: PlanePoint, end: PlanePoint, half_mm: float) -> None:
        """Run from `start` to `end`."""
        parts = pieces(start, end, half_mm)
        for item, part in zip(self._items, parts, strict=False):
            near, far = (fading(distance, half_mm) for distance in part.distances)
            alphas = (1.0, 1.0) if part.inside else (near, far)
            ink = self._solid if part.inside else self._broken
            item.place(part.start, part.end, ink, alphas)
        for number, item in enumerate(self._items):
            item.setVisible(number < len(parts))

    def hide(self) -> None:
        """Show nothing."""
        for item in self._items:
            item.setVisible(False)


class PlanLayer:
    """Entry ring, target disc and the path between them.

    Attributes:
        entry, target: their marks.
    """

    def __init__(self, drawing: Drawing) -> None:
        self._path = SegmentLayer(drawing, theme.PATH, 2)
        self.entry = MarkItem(theme.ENTRY, 4)
        self.target = MarkItem(theme.TARGET, 4)
        for item in (self.entry, self.target):
            item.setVisible(False)
            drawing.add(item)

    def place(
        self,
        draft: DraftPlan,
        plane: SlicePlane,
        index: float,
        with_error: bool = False,
    ) -> None:
        """Show what the draft has; `with_error` says what the ellipse round the target is."""
        entry = None if draft.entry_mm is None else plane.point(draft.entry_mm, index)
        target = None if draft.target_mm is None else plane.point(draft.target_mm, index)
        place_mark(self.entry, entry, tr("Entry"), plane)
        name = tr("Target, TRE 95 %") if with_error else tr("Target")
        place_mark(self.target, target, name, plane)
        if entry is None or target is None:
            self._path.hide()
        else:
            self._path.place(entry, target, plane.half_slab_mm)

    def hide(self) -> None:
        """Show nothing."""
        self._path.hide()
        self.entry.setVisible(False)
        self.target.setVisible(False)


class NeedleLayer:
    """Shaft and tip of the live needle.

    Attributes:
        shown: the needle that was placed last; None for none.
        tip: its mark; its label is left out where there is no room beside those of the plan.
    """

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self._shaft = [SegmentLayer(drawing, theme.NEEDLE, 3)]
        self._doubtful = SegmentLayer(drawing, Mark(theme.IMAGE_DIM, width=2.0), 3)
        self.tip = MarkItem(theme.NEEDLE_TIP, 5, optional=True)
        self.tip.setVisible(False)
        self.shown: NeedleOverlay | None = None
        drawing.add(self.tip)

    def place(self, needle: NeedleOverlay | None, plane: SlicePlane, index: float) -> None:
        """Show the needle, grey where its pose is not valid."""
        self.shown = needle
        if needle is None:
            self.hide()
            return
        self._hide_shaft()
        corners = [plane.point(corner, index) for corner in needle.points_mm]
        tip = corners[-1]
        if needle.valid:
            self._reserve(len(corners) - 1)
            for part, (start, end) in zip(self._shaft, pairwise(corners), strict=False):
                part.place(start, end, plane.half_slab_mm)
        else:
            self._doubtful.place(corners[0], tip, plane.half_slab_mm)
        place_mark(self.tip, tip, "" if needle.valid else tr("not tracked"), plane)

    def hide(self) -> None:
        """Show nothing."""
        self._hide_shaft()
        self.tip.setVisible(False)

    def _hide_shaft(self) -> None:
        for part in (*self._shaft, self._doubtful):
            part.hide()

    def _reserve(self, parts: int) -> None:
        """Have as many pieces as a bent shaft needs."""
        while len(self._shaft) < parts:
            self._shaft.append(SegmentLayer(self._drawing, theme.NEEDLE, 3))


class Labels:
    """The names of several marks, the most important first; pure arrangement is in `labels`."""

    def __init__(self, marks: tuple[MarkItem, ...]) -> None:
        self._marks = marks
        self._arranged: tuple[object, ...] = ()

    def add(self, marks: Sequence[MarkItem]) -> None:
        """Take more marks, less important than those already there."""
        self._marks = (*self._marks, *marks)

    def arrange(
        self,
        size_px: tuple[float, float],
        pixel_at: Callable[[float, float], QPointF],
        lines: Sequence[tuple[QPointF, QPointF]],
    ) -> None:
        """Give every label its place, unless nothing has moved by a pixel.

        Args:
            size_px: of the pane.
            pixel_at: pixel of a plane point [mm].
            lines: ends [px] of lines that labels keep off.
        """
        shown = [
            (mark, at, want)
            for mark in self._marks
            for at in [pixel_at(mark.x(), mark.y())]
            for want in [mark.wanted(at)]
            if want is not None
        ]
        state = (size_px, [end.toPoint() for line in lines for end in line],
                 [(mark, at.toPoint(), want.width) for mark, at, want in shown])  # fmt: skip
        if state == self._arranged:
            return
        self._arranged = state
        points = np.array([(end.x(), end.y()) for line in lines for end in line]).reshape(-1, 2, 2)
        along = points[:, :1] + _SHARES * (points[:, 1:] - points[:, :1])
        places = arrange([want for _, _, want in shown], size_px, along)
        for (mark, at, _), place in zip(shown, places, strict=True):
            mark.place_label(at, place)


def place_mark(item: MarkItem, at: PlanePoint | None, name: str, plane: SlicePlane) -> None:
    """Show a mark with its name and its distance from the slice; None hides it."""
    item.setVisible(at is not None)
    if at is None:
        return
    near = abs(at.distance) <= plane.half_slab_mm
    item.place(at.x, at.y, partial(_words, name, at.distance, near, plane), near)


def _words(name: str, distance: float, near: bool, plane: SlicePlane) -> str:
    if near:
        return name
    side = plane.towards(distance)
    return f"{name} {tr('{distance:.0f} mm {side}', distance=abs(distance), side=side)}".strip()
