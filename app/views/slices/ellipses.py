"""Ellipses of true size over a slice: errors of target and tip, and the tolerance of the target."""

from __future__ import annotations

from math import cos, hypot, sin

from PySide6.QtCore import QRectF

from app.planning.error_overlay import ErrorOverlay
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Ink, Strokes, ellipse
from app.views.slices.items import MarkItem
from app.views.slices.plane import SlicePlane
from app.views.slices.viewing import Viewing

TARGET_ERROR = Mark(theme.TARGET.colour, dash=(3.0, 2.0), width=1.5)
TIP_ERROR = Mark(theme.NEEDLE_TIP.colour, width=1.5)


class EllipseItem(Strokes):
    """An ellipse with a dark rim, of true size in the plane."""

    def __init__(self, mark: Mark, z: float) -> None:
        super().__init__(z, visible=False)
        self._at, self._axes, self._angle = (0.0, 0.0), (0.0, 0.0), 0.0
        line = Ink.of(mark)
        rim = Ink(line.width + 2.0, (0.0, 0.0, 0.0), 0.5)
        self._inks = {True: (rim, line), False: (rim, line._replace(opacity=0.6))}

    def place(
        self, x: float, y: float, axes: tuple[float, float], near: bool, angle: float = 0.0
    ) -> None:
        """Stand round (x, y) [mm] with these half axes [mm], the first turned by `angle` [rad].

        Where the slice is not `near` it is faded.
        """
        self.setVisible(True)
        self._at, self._axes, self._angle = (x, y), axes, angle
        rim, line = self._inks[near]
        self.set_rows([*ellipse((x, y), axes, rim, angle), *ellipse((x, y), axes, line, angle)])

    def boundingRect(self) -> QRectF:
        """Return the ellipse's rectangle [mm]."""
        (x, y), (a, b), angle = self._at, self._axes, self._angle
        width, height = hypot(a * cos(angle), b * sin(angle)), hypot(a * sin(angle), b * cos(angle))
        return QRectF(x - width, y - height, 2.0 * width, 2.0 * height)


class ErrorLayer:
    """Ellipses of the target and of the tip."""

    def __init__(self, drawing: Drawing) -> None:
        self.target, self.tip = EllipseItem(TARGET_ERROR, 3.5), EllipseItem(TIP_ERROR, 3.6)
        for item in (self.target, self.tip):
            drawing.add(item)

    def place_target(self, error: ErrorOverlay | None, plane: SlicePlane, index: float) -> None:
        """Show the target's, or none."""
        _place(self.target, error, plane, index)

    def place_tip(self, error: ErrorOverlay | None, plane: SlicePlane, index: float) -> None:
        """Show the tip's, or none."""
        _place(self.tip, error, plane, index)

    def hide(self) -> None:
        """Show nothing."""
        self.target.setVisible(False)
        self.tip.setVisible(False)


def _place(item: EllipseItem, error: ErrorOverlay | None, plane: SlicePlane, index: float) -> None:
    if error is None:
        item.setVisible(False)
        return
    at = plane.point(error.centre_mm, index)
    near = abs(at.distance) <= plane.half_slab_mm
    *axes, angle = error.ellipse_mm(plane.first.right, plane.first.down)
    item.place(at.x, at.y, (axes[0], axes[1]), near, angle)


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
