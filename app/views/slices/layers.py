"""The layers over one slice: plan, needle and what others add, and when each is placed anew."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet
from enum import IntEnum, auto
from functools import partial
from itertools import pairwise
from typing import Protocol

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF

from app.exercises.touching import MOST_TARGETS
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.theme import Mark
from app.views.slices.crosshair import (
    CrosshairLayer,
    ErrorLayer,
    NeedleTraces,
    TargetDisc,
    TickLayer,
)
from app.views.slices.drawing import Drawing, Ink
from app.views.slices.items import MarkItem, SegmentItem
from app.views.slices.labels import arrange
from app.views.slices.panes import NEEDLE_PANES, PaneId
from app.views.slices.plane import SlicePlane
from app.views.slices.slab import PlanePoint, pieces
from app.views.slices.viewing import Viewing

FADED, FAINTEST = 0.75, 0.25
FAINTEST_MM = 50.0
"""A segment is faintest so far off the slice [mm]."""

_SHARES = np.linspace(0.0, 1.0, 24)[:, None]
"""Points on a line, near enough to each other that no label slips between them."""


def fading(distance_mm: float, half_mm: float) -> float:
    """Opacity of what lies so far off a slice of this half thickness, outside it."""
    share = (distance_mm - half_mm) / (FAINTEST_MM - half_mm)
    return FADED + (FAINTEST - FADED) * min(max(share, 0.0), 1.0)


class SegmentLayer:
    """A segment in space: solid in the slab, outside dashed and the fainter the farther off."""

    def __init__(
        self,
        drawing: Drawing,
        mark: Mark,
        z: float,
        broken: tuple[float, ...] = (4.0, 3.0),
    ) -> None:
        self._solid, self._broken = Ink.of(mark), Ink.of(mark, dash=broken)
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
        number: int = 0,
    ) -> None:
        """Show what the draft has.

        Args:
            draft: entry and target.
            plane: of the pane.
            index: of the slice.
            with_error: say what the ellipse round the target is.
            number: of the target, among several; 0 where there is one only.
        """
        entry = None if draft.entry_mm is None else plane.point(draft.entry_mm, index)
        target = None if draft.target_mm is None else plane.point(draft.target_mm, index)
        place_mark(self.entry, entry, tr("Entry"), plane)
        name = tr("Target, TRE 95 %") if with_error else tr("Target")
        if number:
            name = tr("Target {n}", n=number)
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


class TargetsLayer:
    """Targets that are touched one after the other, where they lie in the slice.

    The present one is the plan's target, which `PlanLayer` draws; touched ones are ticked.

    Attributes:
        marks: of those ahead, then of those that were touched, one each for each target.
    """

    def __init__(self, drawing: Drawing, viewing: Viewing) -> None:
        self._viewing = viewing
        self._ahead = [MarkItem(theme.TARGET_AHEAD, 4, optional=True) for _ in range(MOST_TARGETS)]
        self._touched = [
            MarkItem(theme.TARGET_TOUCHED, 4, optional=True) for _ in range(MOST_TARGETS)
        ]
        self.marks = (*self._ahead, *self._touched)
        for item in self.marks:
            item.setVisible(False)
            drawing.add(item)

    def place(self, plane: SlicePlane, index: float) -> None:
        """Show those within their own radius of the slice."""
        self.hide()
        targets = self._viewing.targets
        if targets is None:
            return
        radius = max(self._viewing.tolerances_mm, default=0.0)
        for number, point in enumerate(targets.points_mm[:MOST_TARGETS], start=1):
            was = number <= targets.touched
            at = plane.point(point, index)
            ahead = not was and number != targets.present
            if (was or ahead) and abs(at.distance) <= plane.half_slab_mm + radius:
                item = (self._touched if was else self._ahead)[number - 1]
                name = f"✔ {number}" if was else str(number)
                item.place(at.x, at.y, partial(str, name), True)
                item.setVisible(True)

    def hide(self) -> None:
        """Show nothing."""
        for item in self.marks:
            item.setVisible(False)


class NeedleLayer:
    """Shaft and tip of the live needle, or of a ghost beside it.

    Args:
        drawing: of the pane.
        shaft, tip: how they are drawn.
        z: what lies over what.

    Attributes:
        shown: the needle that was placed last; None for none.
        tip: its mark; its label is left out where there is no room beside those of the plan.
        title: what its tip is called; empty for the live needle.
    """

    def __init__(
        self,
        drawing: Drawing,
        shaft: Mark = theme.NEEDLE,
        tip: Mark = theme.NEEDLE_TIP,
        z: float = 3.0,
    ) -> None:
        self._drawing, self._mark, self._z, self.title = drawing, shaft, z, ""
        self._broken = shaft.dash or (4.0, 3.0)  # a ghost stays dotted
        self._shaft = [SegmentLayer(drawing, shaft, z, self._broken)]
        self._doubtful = SegmentLayer(drawing, Mark(theme.IMAGE_DIM, width=2.0), z)
        self.tip = MarkItem(tip, z + 2.0, optional=True)
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
        place_mark(self.tip, tip, self.title if needle.valid else tr("not tracked"), plane)

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
            self._shaft.append(SegmentLayer(self._drawing, self._mark, self._z, self._broken))


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
        taken: Sequence[QRect],
        names: Sequence[QRect] = (),
    ) -> None:
        """Give every label its place, unless nothing has moved by a pixel.

        Args:
            size_px: of the pane.
            pixel_at: pixel of a plane point [mm].
            lines: ends [px] of lines that labels keep off.
            taken: places of other words [px], which no label covers.
            names: places of words [px] that a label covers only where there is no other place.
        """
        shown = [
            (mark, at, want)
            for mark in self._marks
            for at in [pixel_at(mark.x(), mark.y())]
            for want in [mark.wanted(at)]
            if want is not None
        ]
        state = (
            size_px,
            [end.toPoint() for line in lines for end in line],
            [(mark, at.toPoint(), want.width) for mark, at, want in shown],
            [*taken, *names],
        )
        if state == self._arranged:
            return
        self._arranged = state
        points = np.array([(end.x(), end.y()) for line in lines for end in line]).reshape(-1, 2, 2)
        along = points[:, :1] + _SHARES * (points[:, 1:] - points[:, :1])
        places = arrange(
            [want for _, _, want in shown],
            size_px,
            along,
            [(one.x(), one.y(), one.width(), one.height()) for one in taken],
            [(one.x(), one.y(), one.width(), one.height()) for one in names],
        )
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
    away = tr("{distance:.0f} mm {side}", distance=abs(distance), side=side)
    return f"{name}{': ' if name[-1:].isdigit() else ' '}{away}".strip()


class Due(IntEnum):
    """What of a slice is to be drawn anew; whole numbers are looked up faster than names."""

    CAMERA = auto()
    GREYS = auto()
    WORDS = auto()
    CROSSHAIR = auto()
    PLAN = auto()
    NEEDLE = auto()
    ADDED = auto()


ALL_LAYERS = frozenset({Due.CROSSHAIR, Due.PLAN, Due.NEEDLE, Due.ADDED})
"""What is to be placed where slice, plane or zoom are others."""

WAITED_FOR = frozenset({Due.CAMERA, Due.PLAN, Due.ADDED})
"""What somebody does and looks at: its words are written at once."""

RUNNING_ON = frozenset({Due.GREYS, Due.NEEDLE})
"""What changes again and again: its words are written only as often as they can be read."""


UNSEEN_PX = 0.1
"""What moves by less is not placed and painted anew."""


Names = Callable[[], Sequence[QRectF]]
"""Returns places of words in the plane [mm]."""


class Layer(Protocol):
    """Something drawn over a slice: owns shapes of the pane's `drawing`."""

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Put its shapes where they belong.

        Args:
            plane: of the pane.
            index: of the slice.
            scale: zoom [px/mm].
        """

    def hide(self) -> None:
        """Show nothing: the pane has no plane."""


class LayerStack:
    """Owns the layers of one canvas, and what others add.

    Attributes:
        crosshair, plan, targets, needle, errors, disc: its own layers.
        ticks: the line ahead of the tip; None in panes that are not the needle's.
        traces: the needle's planes; None in the needle's own panes.
        traced: panes whose traces are shown.
    """

    def __init__(self, drawing: Drawing, viewing: Viewing, pane: PaneId) -> None:
        self._viewing, self._pane = viewing, pane
        self.crosshair = CrosshairLayer(drawing, viewing, pane)
        self.plan, self.needle = PlanLayer(drawing), NeedleLayer(drawing)
        self.targets = TargetsLayer(drawing, viewing)
        self.errors = ErrorLayer(drawing)
        self.disc = TargetDisc(drawing, viewing)
        self.ticks = TickLayer(drawing, viewing) if pane.is_needle else None
        self.traces = None if pane.is_needle else NeedleTraces(drawing, viewing)
        named = (self.plan.target, self.plan.entry, self.needle.tip, *self.targets.marks)
        self._labels = Labels(named)
        self._added: list[Layer] = []
        self._names: list[Names] = []
        own = self.crosshair.traced
        self.traced = own if self.traces is None else own.union(NEEDLE_PANES)

    def add(self, layer: Layer, marks: Sequence[MarkItem] = (), names: Names | None = None) -> None:
        """Take another layer; names of its `marks` are arranged after those already there.

        Args:
            layer: placed and hidden with the others.
            marks: its marks with names.
            names: returns the places of words that it writes itself [mm].
        """
        self._added.append(layer)
        if names is not None:
            self._names.append(names)
        self._labels.add(marks)

    def hide(self) -> None:
        """Show nothing."""
        self.crosshair.hide()
        self.plan.hide()
        self.targets.hide()
        self.needle.hide()
        self.errors.hide()
        self.disc.hide()
        for more in (self.ticks, self.traces):
            if more is not None:
                more.hide()
        for layer in self._added:
            layer.hide()

    def place(self, due: AbstractSet[Due], plane: SlicePlane, index: float, scale: float) -> None:
        """Put what has changed where it belongs.

        Args:
            due: what has changed.
            plane: of the pane.
            index: of the slice.
            scale: zoom [px/mm].
        """
        if Due.CROSSHAIR in due:
            self.crosshair.place(plane, index, scale)
            if self.traces is not None:
                self.traces.place(plane, index, scale)
        if Due.PLAN in due:
            self._place_plan(plane, index, scale)
        if Due.NEEDLE in due and due == {Due.NEEDLE} and self._stands(scale):
            due = frozenset()
        if Due.NEEDLE in due:
            self._place_needle(plane, index)
        if self.ticks is not None and (Due.PLAN in due or Due.NEEDLE in due):
            self.ticks.place(plane, index, scale)
        if Due.ADDED in due:
            for layer in self._added:
                layer.place(plane, index, scale)

    def _place_plan(self, plane: SlicePlane, index: float, scale: float) -> None:
        viewing = self._viewing
        error = viewing.target_error if viewing.shows_errors else None
        number = 0 if viewing.targets is None else viewing.targets.present
        self.plan.place(viewing.shown_draft, plane, index, error is not None, number)
        self.targets.place(plane, index)
        self.errors.place_target(error, plane, index)
        self.disc.place(plane, index, scale)

    def _place_needle(self, plane: SlicePlane, index: float) -> None:
        needle = self._viewing.needle
        self.needle.place(needle, plane, index)
        error = needle.error if needle is not None and self._viewing.shows_errors else None
        self.errors.place_tip(error, plane, index)

    def _stands(self, scale: float) -> bool:
        """Return whether the needle has moved less than can be seen since it was placed last."""
        before, now = self.needle.shown, self._viewing.needle
        if before is None or now is None or before is now or before.valid is not now.valid:
            return False
        old, new = before.points_mm, now.points_mm
        if old.shape != new.shape or np.abs(new - old).max() * scale > UNSEEN_PX:
            return False
        if before.error is None or now.error is None:
            return before.error is now.error
        change = np.abs(now.error.covariance_mm2 - before.error.covariance_mm2).max()
        return bool(np.sqrt(change) * scale <= UNSEEN_PX)

    def arrange_labels(
        self,
        plane: SlicePlane,
        index: float,
        size_px: tuple[float, float],
        pixel_at: Callable[[float, float], QPointF],
        taken: Sequence[QRect] = (),
    ) -> None:
        """Put the names of the marks where they cover nothing and nothing cuts them.

        Args:
            plane: of the pane.
            index: of the slice.
            size_px: of the pane.
            pixel_at: pixel of a plane point [mm].
            taken: places of other words [px].
        """
        draft, needle = self._viewing.shown_draft, self._viewing.needle
        lines = [] if needle is None else list(pairwise(needle.points_mm))
        if draft.entry_mm is not None and draft.target_mm is not None:
            lines.append((np.asarray(draft.entry_mm), np.asarray(draft.target_mm)))
        places = [[plane.point(point, index) for point in line] for line in lines]
        ends = [(pixel_at(a.x, a.y), pixel_at(b.x, b.y)) for a, b in places]
        names = [
            QRectF(pixel_at(one.left(), one.top()), pixel_at(one.right(), one.bottom())).toRect()
            for written in self._names
            for one in written()
        ]
        self._labels.arrange(size_px, pixel_at, ends, taken, names)
