"""The target's tolerance in true size: rings round the place that the needle shall reach."""

from __future__ import annotations

from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing
from app.views.slices.error_layer import EllipseItem
from app.views.slices.items import MarkItem
from app.views.slices.plane import SlicePlane
from app.views.slices.viewing import Viewing

INNER = Mark(theme.TARGET.colour, width=2.0)
OUTER = Mark(theme.TARGET.colour, dash=(5.0, 3.0), width=1.5)
SMALLEST_PX = MarkItem.RADIUS + 2.0
"""Rings that would lie under the target's own mark are not drawn."""


class TargetDisc:
    """Rings of the viewing's tolerances: the inner one solid, the outer one dashed."""

    def __init__(self, drawing: Drawing, viewing: Viewing) -> None:
        self._viewing = viewing
        self.rings = (EllipseItem(INNER, 3.4), EllipseItem(OUTER, 3.3))
        for ring in self.rings:
            drawing.add(ring)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show the rings; faded where the target is not in the slice."""
        target = self._viewing.shown_draft.target_mm
        if target is None:
            self.hide()
            return
        at = plane.point(target, index)
        near = abs(at.distance) <= plane.half_slab_mm
        radii = (*self._viewing.tolerances_mm, 0.0, 0.0)
        for ring, radius in zip(self.rings, radii, strict=False):
            if radius * scale >= SMALLEST_PX:
                ring.place(at.x, at.y, (radius, radius), near)
            else:
                ring.setVisible(False)

    def hide(self) -> None:
        """Show nothing."""
        for ring in self.rings:
            ring.setVisible(False)
