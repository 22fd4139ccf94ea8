"""The layers over one slice, and when each of them is placed anew."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet
from enum import IntEnum, auto
from itertools import pairwise
from typing import Protocol

import numpy as np
from PySide6.QtCore import QPointF

from app.views.slices.drawing import Drawing
from app.views.slices.error_layer import ErrorLayer
from app.views.slices.items import MarkItem
from app.views.slices.layers import CrosshairLayer, Labels, NeedleLayer, PlanLayer
from app.views.slices.needle_traces import NeedleTraces
from app.views.slices.panes import NEEDLE_PANES, PaneId
from app.views.slices.plane import SlicePlane
from app.views.slices.target_disc import TargetDisc
from app.views.slices.ticks import TickLayer
from app.views.slices.viewing import Viewing


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

WAITED_FOR = frozenset({Due.CAMERA, Due.GREYS, Due.PLAN, Due.ADDED})
"""What somebody does and looks at: its words are written at once."""


UNSEEN_PX = 0.1
"""What moves by less is not placed and painted anew."""


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
        crosshair, plan, needle, errors, disc: its own layers.
        ticks: the line ahead of the tip; None in panes that are not the needle's.
        traces: the needle's planes; None in the needle's own panes.
        traced: panes whose traces are shown.
    """

    def __init__(self, drawing: Drawing, viewing: Viewing, pane: PaneId) -> None:
        self._viewing, self._pane = viewing, pane
        self.crosshair = CrosshairLayer(drawing, viewing, pane)
        self.plan, self.needle = PlanLayer(drawing), NeedleLayer(drawing)
        self.errors = ErrorLayer(drawing)
        self.disc = TargetDisc(drawing, viewing)
        self.ticks = TickLayer(drawing, viewing) if pane.is_needle else None
        self.traces = None if pane.is_needle else NeedleTraces(drawing, viewing)
        self._labels = Labels((self.plan.target, self.plan.entry, self.needle.tip))
        self._added: list[Layer] = []
        own = self.crosshair.traced
        self.traced = own if self.traces is None else own.union(NEEDLE_PANES)

    def add(self, layer: Layer, marks: Sequence[MarkItem] = ()) -> None:
        """Take another layer; names of its `marks` are arranged after those already there."""
        self._added.append(layer)
        self._labels.add(marks)

    def hide(self) -> None:
        """Show nothing."""
        self.crosshair.hide()
        self.plan.hide()
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
        self.plan.place(viewing.shown_draft, plane, index, error is not None)
        self.errors.place_target(error, plane, index)
        self.disc.place(plane, index, scale)

    def _place_needle(self, plane: SlicePlane, index: float) -> None:
        needle = self._viewing.needle
        self.needle.place(needle, plane, index)
        error = needle.error if needle is not None and self._viewing.shows_errors else None
        self.errors.place_tip(error, plane, index)

    def _stands(self, scale: float) -> bool:
        """Whether the needle has moved less than can be seen since it was placed last."""
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
    ) -> None:
        """Put the names of the marks where they cover nothing and nothing cuts them."""
        draft, needle = self._viewing.shown_draft, self._viewing.needle
        lines = [] if needle is None else list(pairwise(needle.points_mm))
        if draft.entry_mm is not None and draft.target_mm is not None:
            lines.append((np.asarray(draft.entry_mm), np.asarray(draft.target_mm)))
        places = [[plane.point(point, index) for point in line] for line in lines]
        ends = [(pixel_at(a.x, a.y), pixel_at(b.x, b.y)) for a, b in places]
        self._labels.arrange(size_px, pixel_at, ends)
