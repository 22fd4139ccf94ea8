"""Where the faces of cube or ring and the markers of the sheet go on paper, in millimetres.

The net is a row of the side faces, for a cube with top and bottom at the first, and glue tabs; read
from outside it folds into what `tracking.pen.body` describes. The shaft goes through the crosses of
top and bottom; a ring is closed round two discs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.calibration.board_layout import EDGE_MM, Paper
from app.tracking.pen.body import BaseProfile, BodyProfile
from app.tracking.pen.errors import PenError

TAB_MM: Final = 9.0
"""Depth of a glue tab."""

FOOT_MM: Final = 22.0
"""Below the print: the ruler and a line of text."""

_SLANT: Final = 0.35
"""How much narrower a tab is at each end, in its depth."""

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Face:
    """One face of the net.

    Attributes:
        id: of its marker.
        x, y: upper left corner on the sheet.
        edge: of the face.
        marker: side of the black square in its middle.
    """

    id: int
    x: float
    y: float
    edge: float
    marker: float

    @property
    def marker_corner(self) -> Point:
        """Upper left corner of the black square."""
        quiet = 0.5 * (self.edge - self.marker)
        return self.x + quiet, self.y + quiet


@dataclass(frozen=True, slots=True)
class Page:
    """One sheet of paper.

    Attributes:
        title: what it is.
        width, height: of the sheet as it lies.
        landscape: whether the long side lies across.
        dictionary: of the markers.
        faces: with markers.
        outline: faces are drawn with their edges, to cut and fold by.
        tabs: glue tabs, four corners each; the first edge is the one that is folded.
        blanks: upper left corner and edge of faces without a marker.
        crosses: middle, half length and radius of the circle of each cross, where the shaft goes
            through.
        across: distance of opposite sides of a ring; 0 for a cube and for the sheet.
        bottom: lower edge of the print; ruler and text come below.
    """

    title: str
    width: float
    height: float
    landscape: bool
    dictionary: str
    faces: tuple[Face, ...]
    outline: bool
    tabs: tuple[tuple[Point, Point, Point, Point], ...]
    blanks: tuple[tuple[float, float, float], ...]
    crosses: tuple[tuple[float, float, float, float], ...]
    across: float
    bottom: float


def body_page(body: BodyProfile, paper: Paper) -> Page:
    """Lay out the net.

    Raises:
        PenError: if it does not fit on the paper; says how much it needs.
    """
    edge = body.edge_mm
    wide = body.sides * edge + TAB_MM
    high = (3.0 if body.top else 1.0) * edge + 2.0 * TAB_MM
    width, height, landscape = _fit(paper, wide, high, body.board().name)
    left, top = 0.5 * (width - wide), EDGE_MM + TAB_MM
    row = top + (edge if body.top else 0.0)
    faces = [
        Face(body.first_id + k, left + k * edge, row, edge, body.marker_mm)
        for k in range(body.sides)
    ]
    tabs = [_tab((left + body.sides * edge, row), (left + body.sides * edge, row + edge))]
    if body.top:
        faces.append(Face(body.first_id + body.sides, left, top, edge, body.marker_mm))
        tabs += [
            _tab((left, top), (left + edge, top)),
            _tab((left, row), (left, top)),
            _tab((left + edge, top), (left + edge, row)),
            _tab((left, row + 2.0 * edge), (left, row + edge)),
            _tab((left + edge, row + 2.0 * edge), (left, row + 2.0 * edge)),
            _tab((left + edge, row + edge), (left + edge, row + 2.0 * edge)),
        ]
    middle = left + 0.5 * edge
    return Page(
        title=body.board().name,
        width=width,
        height=height,
        landscape=landscape,
        dictionary=body.dictionary,
        faces=tuple(faces),
        outline=True,
        tabs=tuple(tabs),
        blanks=((left, row + edge, edge),) if body.top else (),
        crosses=tuple((middle, y, 2.0, 0.0) for y in (row - 0.5 * edge, row + 1.5 * edge))
        if body.top
        else (),
        across=0.0 if body.top else 2.0 * body.apothem / MILLIMETRE,
        bottom=row + (2.0 if body.top else 1.0) * edge + TAB_MM,
    )


def base_page(base: BaseProfile, paper: Paper) -> Page:
    """Lay out the sheet with the cross.

    Raises:
        PenError: if it does not fit on the paper; says how much it needs.
    """
    wide = (base.columns - 1) * base.pitch_mm + base.marker_mm
    high = (base.rows - 1) * base.pitch_mm + base.marker_mm
    width, height, landscape = _fit(paper, wide, high, "sheet")
    x, y = 0.5 * width, EDGE_MM + 0.5 * high
    faces = tuple(
        Face(
            base.first_id + k,
            x + cx - 0.5 * base.marker_mm,
            y - cy - 0.5 * base.marker_mm,
            base.marker_mm,
            base.marker_mm,
        )
        for k, (cx, cy) in enumerate(base.centres_mm.tolist())
    )
    return Page(
        title="sheet",
        width=width,
        height=height,
        landscape=landscape,
        dictionary=base.dictionary,
        faces=faces,
        outline=False,
        tabs=(),
        blanks=(),
        crosses=((x, y, 8.0, 3.0),),
        across=0.0,
        bottom=EDGE_MM + high,
    )


def _fit(paper: Paper, wide: float, high: float, name: str) -> tuple[float, float, bool]:
    """Width and height of the sheet as it lies, and whether across."""
    for landscape in (False, True):
        width, height = paper.width_mm, paper.height_mm
        if landscape:
            width, height = height, width
        if wide + 2.0 * EDGE_MM <= width and high + EDGE_MM + FOOT_MM <= height:
            return width, height, landscape
    raise PenError(
        sentence(
            "the {name} needs {wide:.0f} x {high:.0f} mm and does "
            "not fit on {paper_name}; take larger paper or smaller faces in the pen's profile",
            name=name,
            wide=wide + 2.0 * EDGE_MM,
            high=high + EDGE_MM + FOOT_MM,
            paper_name=paper.name,
        )
    )


def _tab(start: Point, end: Point) -> tuple[Point, Point, Point, Point]:
    """Return a tab to the left of the way from start to end, y down: outside of a clockwise net."""
    (x0, y0), (x1, y1) = start, end
    length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
    ax, ay = (x1 - x0) / length, (y1 - y0) / length
    nx, ny = ay * TAB_MM, -ax * TAB_MM
    slant = _SLANT * TAB_MM
    return (
        start,
        (x0 + ax * slant + nx, y0 + ay * slant + ny),
        (x1 - ax * slant + nx, y1 - ay * slant + ny),
        end,
    )
