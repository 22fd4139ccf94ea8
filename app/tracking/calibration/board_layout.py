"""Where a board goes on a sheet of paper, in millimetres."""

from dataclasses import dataclass
from typing import Final

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.calibration.boards import Board
from app.tracking.errors import CalibrationError

EDGE_MM: Final = 8.0
"""Rim that printers leave white."""

FOOT_MM: Final = 26.0
"""Below the pattern: white, the ruler, two lines of text."""

RULER_MM: Final = 100.0


@dataclass(frozen=True, slots=True)
class Paper:
    """A paper format in portrait."""

    name: str
    width_mm: float
    height_mm: float


PAPERS: Final = {
    "A4": Paper("A4", 210.0, 297.0),
    "A3": Paper("A3", 297.0, 420.0),
    "Letter": Paper("Letter", 215.9, 279.4),
}


@dataclass(frozen=True, slots=True)
class BoardSheet:
    """A sheet with a board on it.

    Attributes:
        paper: format.
        landscape: whether the long side lies across.
        width_mm, height_mm: of the sheet as it lies.
        x_mm, y_mm: upper left corner of the pattern.
        pattern_mm: width and height of the pattern.
    """

    paper: Paper
    landscape: bool
    width_mm: float
    height_mm: float
    x_mm: float
    y_mm: float
    pattern_mm: tuple[float, float]


def paper_named(name: str) -> Paper:
    """Return a paper by its name, in any case.

    Raises:
        CalibrationError: if there is none; names those that are.
    """
    for known, paper in PAPERS.items():
        if known.casefold() == name.strip().casefold():
            return paper
    raise CalibrationError(
        sentence(
            "no paper is called {name!r}; there are {papers}", name=name, papers=", ".join(PAPERS)
        )
    )


def lay_out(board: Board, paper: Paper) -> BoardSheet:
    """Place a board on paper, upright or across, whichever fits.

    Raises:
        CalibrationError: if it fits neither way; names what would.
    """
    sheet = _placed(board, paper)
    if sheet is not None:
        return sheet
    width, height = (side / MILLIMETRE for side in board.size)
    others = [name for name, other in PAPERS.items() if _placed(board, other) is not None]
    raise CalibrationError(
        sentence(
            "board {board_spec} measures {width:.0f} x {height:.0f} mm and does not fit on "
            "{paper_name}; squares of at most {largest_square:.4g} mm would",
            board_spec=board.spec,
            width=width,
            height=height,
            paper_name=paper.name,
            largest_square=_largest_square(board, paper),
        )
        + (sentence(", or take {others}", others=" or ".join(others)) if others else "")
    )


def _placed(board: Board, paper: Paper) -> BoardSheet | None:
    width, height = (side / MILLIMETRE for side in board.size)
    across = (True, False) if width > height else (False, True)
    for landscape in across:
        w, h = _size(paper, landscape)
        room = w - 2.0 * EDGE_MM, h - EDGE_MM - FOOT_MM
        if width <= room[0] + 1e-9 and height <= room[1] + 1e-9:
            x, y = 0.5 * (w - width), EDGE_MM + 0.5 * (room[1] - height)
            return BoardSheet(paper, landscape, w, h, x, y, (width, height))
    return None


def _size(paper: Paper, landscape: bool) -> tuple[float, float]:
    short, long = paper.width_mm, paper.height_mm
    return (long, short) if landscape else (short, long)


def _largest_square(board: Board, paper: Paper) -> float:
    """Side of the largest square that fits either way [mm], rounded down to a tenth."""
    best = 0.0
    for landscape in (True, False):
        w, h = _size(paper, landscape)
        room = w - 2.0 * EDGE_MM, h - EDGE_MM - FOOT_MM
        best = max(best, min(room[0] / (board.columns + 1), room[1] / (board.rows + 1)))
    return int(10.0 * best) / 10.0
