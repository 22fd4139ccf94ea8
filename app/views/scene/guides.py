"""What an exercise asks for beside needle and plan, as it stands in 3D: the grid on the skin, the
electrodes left in place, the zones that they ablate, the margins on the lesion's surface.

Colours are those of the slices. A planned zone is dashed, an ablated one a surface; a margin has a
colour and a size, so that neither stands alone. Everything is in patient LPS millimetres.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from PySide6.QtGui import QColor

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.imaging.skin_grid import SkinGrid
from app.planning.ablation.zone import Zone
from app.session.ablation_shown import AblationShown
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.theme import Mark
from app.views.scene.words import Entry
from app.views.slices.zones import BARE, ENOUGH, LITTLE, ZONE, mark_of

WIRE: Final = Mark("#f2c14e", width=1.5)
LASER: Final = Mark("#e0523f", width=1.5)
"""Lines of the grid on the skin, and of the laser at the table position."""

GRID: Final = "grid"
ABLATION: Final = "ablation"
"""Parts of an exercise that have something to show."""

ELECTRODE: Final = Mark(theme.TEXT)
"""As white as that of the slices, and dark on a light background."""

OUTLINE: Final = Mark(ZONE, width=1.6)

THICK: Final = 2.0
"""Each fifth line of the grid is so many times as wide: one counts by them."""

DOTS_MM: Final = {ENOUGH: 0.45, LITTLE: 0.7, BARE: 1.0}
"""Radii of the dots of a margin: the less there is, the larger."""

LEAST_RING_MM: Final = 3.0
"""Radius of the ring about the place with the least margin."""

_STEP_MM: Final = 6.0  # along a line of the grid
_CORNERS: Final = 96  # of an ellipse: every other piece of it is drawn


@dataclass(frozen=True, slots=True, eq=False)
class GuideLine:
    """A line through points.

    Attributes:
        points_mm: shape (n, 3), n ≥ 2.
        mark: its colour, and its width on the screen.
    """

    points_mm: FloatArray
    mark: Mark


@dataclass(frozen=True, slots=True, eq=False)
class Dots:
    """Balls of one size at points of shape (n, 3)."""

    points_mm: FloatArray
    mark: Mark
    radius_mm: float


@dataclass(frozen=True, slots=True, eq=False)
class Guides:
    """What one part of an exercise has to show.

    Attributes:
        lines: on the skin, or about a zone.
        shafts_mm: electrodes in place, from skin to tip, shape (n, 2, 3).
        zones: what they have ablated; their union is one surface.
        dots: margins on the lesion's surface.
        least: where the margin is least, which way is out of the lesion there, how it is marked;
            None for none.
        legend: says what the colours mean, so short that it stays beside the body.
    """

    lines: tuple[GuideLine, ...] = ()
    shafts_mm: FloatArray | None = None
    zones: tuple[Zone, ...] = ()
    dots: tuple[Dots, ...] = ()
    least: tuple[FloatArray, FloatArray, Mark] | None = None
    legend: tuple[Entry, ...] = ()


def grid_guides(grid: SkinGrid, table_mm: float | None = None) -> Guides:
    """Lay a grid's lines on the skin, and the laser's across them; looks for the skin: seconds.

    Args:
        grid: of a CT.
        table_mm: table position of the laser, LPS z; None for none.
    """
    thick = Mark(WIRE.colour, width=THICK * WIRE.width)
    lines = [
        GuideLine(points, thick if number % 5 == 0 else WIRE)
        for number in range(1, grid.spec.lines + 1)
        for points in grid.line_mm(number, _STEP_MM)
    ]
    legend = [_entry(WIRE, tr("grid on the skin"))]
    try:
        laser = None if table_mm is None else grid.across_mm(table_mm)
    except AcusError:  # no skin at that table position
        laser = None
    if laser is not None:
        lines.append(GuideLine(laser, LASER))
        legend.append(_entry(LASER, tr("laser {mm:.1f} mm", mm=table_mm)))
    return Guides(tuple(lines), legend=tuple(legend))


def ablation_guides(shown: AblationShown) -> Guides:
    """Show zones, electrodes and margins as an ablation has them: as planned, until it is done."""
    margins, wanted = shown.newest, shown.wanted_mm
    marks = [mark_of(margin, wanted) for margin in margins.margin_mm.tolist()]
    dots = tuple(
        Dots(margins.at_mm[chosen], mark, radius)
        for mark, radius in DOTS_MM.items()
        if (chosen := np.array([one is mark for one in marks])).any()
    )
    place = margins.at_mm[margins.least_at]
    least = mark_of(margins.least_mm, wanted)
    classes = {
        ENOUGH: tr("margin ≥ {mm:g} mm", mm=wanted),
        LITTLE: tr("margin less"),
        BARE: tr("not covered"),
    }
    words = tr("least {mm:.1f} mm", mm=margins.least_mm)
    zones = tr("ablated zones") if shown.reached else tr("planned zones")
    legend = [
        _entry(least, words),
        *(_entry(one.mark, classes[one.mark]) for one in dots),
        _entry(OUTLINE, zones),
    ]
    if count := len(shown.shafts_mm):
        legend.insert(1, _entry(ELECTRODE, tr("electrodes: {n}", n=count)))
    return Guides(
        tuple(line for zone in shown.planned.zones for line in outlines(zone)),
        shown.shafts_mm,
        () if shown.reached is None else shown.reached.zones,
        dots,
        (place, place - margins.at_mm.mean(axis=0), least),
        tuple(legend),
    )


def outlines(zone: Zone) -> list[GuideLine]:
    """Return dashes of three ellipses about a zone: two along the needle, one across it."""
    first, second = zone.across()
    along = zone.half_long_mm * zone.axis
    first, second = zone.half_short_mm * first, zone.half_short_mm * second
    turns = np.linspace(0.0, 2.0 * np.pi, _CORNERS + 1)
    return [
        GuideLine(zone.centre_mm + np.cos(pair)[:, None] * a + np.sin(pair)[:, None] * b, OUTLINE)
        for a, b in ((along, first), (along, second), (first, second))
        for pair in (turns[at : at + 2] for at in range(0, _CORNERS, 2))
    ]


def rgb_255(mark: Mark) -> tuple[int, int, int]:
    """Return a mark's colour."""
    colour = QColor(mark.colour)
    return colour.red(), colour.green(), colour.blue()


def _entry(mark: Mark, words: str) -> Entry:
    return rgb_255(mark), words
