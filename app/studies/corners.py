"""Study: how wide a window refines a board's corners best, by square, slant, blur and noise.

Rendered checkerboards anywhere before a camera with the lens of OpenCV's sample pictures. Corners
come from the quick finder and are refined in every window; errors are against the projected truth.
"""

from collections.abc import Iterator
from itertools import product
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.studies.findings import Cell, Figure, Findings, Sheet, Survey
from app.tracking.calibration import finders
from app.tracking.calibration.boards import Board, parse_board
from app.tracking.calibration.corners import WINDOW_MAX, WINDOW_SHARE, half_window, refined
from app.tracking.calibration.finders import edge_width
from app.tracking.calibration.grid import extents, local_axes, plane_map
from app.tracking.optics.camera_model import CameraModel
from app.tracking.simulated.board import BoardRenderer

DECLARATION: Final[dict[str, Any]] = {
    "title": "Corners of a board: the window that refines them, by square, slant, edge and noise",
    "question": "How wide a window refines a board's corners best?",
    "reference": "rendered boards with known truth, through a distorted lens",
}

SQUARES: Final = (8.0, 11.0, 14.0, 18.0, 26.0, 40.0)
SLANTS: Final = (0.0, 40.0, 60.0)
BLURS: Final = (0.6, 1.1, 1.8, 2.5)
NOISES: Final = (2.0, 8.0)
WINDOWS: Final = tuple(range(2, WINDOW_MAX + 1))
_PICTURES: Final = 3
_FOCAL: Final = 535.0
_LENS: Final = (-0.28, 0.09, 0.0, 0.0, 0.0)
_SIZE: Final = (640, 480)
_BOARD: Final = "checkerboard:9x6:25mm"
_TOO_FAR: Final = 5.0
"""Error [px] from which the finder took something else for a corner."""


class Tried(NamedTuple):
    """Squared errors of the corners of one kind of picture.

    Attributes:
        square, slant, noise: of the pictures [px, deg, grey].
        short, edge: shortest way across a square, width of the edges; mean [px].
        unrefined: as the finder gave them [px²], (n,).
        refined: in every window [px²], (windows, n).
        chosen, usual: what the rule chooses for each corner, and a third of the square [px²], (n,).
        half: the rule's window, mean [px].
    """

    square: float
    slant: float
    noise: float
    short: float
    edge: float
    unrefined: FloatArray
    refined: FloatArray
    chosen: FloatArray
    usual: FloatArray
    half: float


def tried(progress: Progress | None = None, pictures: int = _PICTURES) -> list[Tried]:
    """Render and refine every kind of picture; what the finder does not find is left out."""
    watch = progress or Progress()
    board = parse_board(_BOARD)
    camera = CameraModel(
        "camera",
        np.array([_FOCAL, _FOCAL, 340.0, 236.0]),
        np.array(_LENS),
        _SIZE,
        RigidTransform.identity(),
    )
    kinds = list(product(SQUARES, SLANTS, BLURS, NOISES))
    found = []
    for number, (square, slant, blur, noise) in enumerate(kinds):
        watch.report(number / len(kinds), sentence("squares of {square:g} px", square=square))
        rng = np.random.default_rng(1000 + number)
        shots = list(
            _shots(BoardRenderer(camera, board, 2), square, slant, blur, noise, rng, pictures)
        )
        if shots:
            short, edge, half, *errors = zip(*shots, strict=True)
            unrefined, chosen, usual = (np.concatenate(part) for part in (errors[0], *errors[2:]))
            found.append(
                Tried(
                    square,
                    slant,
                    noise,
                    float(np.mean(short)),
                    float(np.mean(edge)),
                    unrefined,
                    np.concatenate(errors[1], axis=1),
                    chosen,
                    usual,
                    float(np.mean(half)),
                )
            )
    return found


Shot = tuple[float, float, int, FloatArray, FloatArray, FloatArray, FloatArray]


def _shots(
    renderer: BoardRenderer,
    square: float,
    slant: float,
    blur: float,
    noise: float,
    rng: np.random.Generator,
    pictures: int,
) -> Iterator[Shot]:
    """Short way, edge, the rule's window and squared errors of pictures of one kind."""
    board, camera = renderer.board, renderer.model
    for _ in range(pictures):
        T = _pose(board, square, slant, rng)
        truth, seen = camera.project(T @ board.points)
        if not seen.all():
            continue
        grey = renderer.render(T, blur, noise, rng)
        pixels = finders.checkerboard(grey, board, thorough=False)
        if pixels is None:
            continue
        start = min((pixels, pixels[::-1]), key=lambda p: float(_squares(p, truth).max()))
        homography = plane_map(board, np.arange(board.count), start)
        if homography is None or _squares(start, truth).max() > _TOO_FAR**2:
            continue
        xy = board.points[:, :2] / board.square
        short = float(extents(local_axes(homography, xy))[0].min())
        edge = edge_width(grey, board, homography, xy)
        errors = np.array([_squares(refined(grey, start, half), truth) for half in WINDOWS])
        half = half_window(board, short, edge)
        third = int(np.clip(np.floor(WINDOW_SHARE * short), 2, WINDOW_MAX))
        chosen, usual = (errors[WINDOWS.index(one)] for one in (half, third))
        yield short, edge, half, _squares(start, truth), errors, chosen, usual


def _pose(board: Board, square: float, slant: float, rng: np.random.Generator) -> RigidTransform:
    """Board whose squares are `square` px large where it faces the camera, turned by `slant`."""
    to, roll = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(-0.5, 0.5)
    tilt = rotation_exp(np.radians(slant) * np.array([np.cos(to), np.sin(to), 0.0]))
    rotation = tilt @ rotation_exp([0.0, 0.0, roll])
    distance = _FOCAL * board.square / square
    spare = np.maximum(0.0, 0.38 - 0.5 * np.array(board.size)[::-1].max() / distance)
    aside = rng.uniform(-1.0, 1.0, 2) * spare * distance
    return RigidTransform(rotation, [*aside, distance] - rotation @ board.points.mean(axis=0))


def _squares(pixels: FloatArray, truth: FloatArray) -> FloatArray:
    result: FloatArray = ((pixels - truth) ** 2).sum(axis=1)
    return result


def _rms(squares: FloatArray) -> float:
    return round(float(np.sqrt(np.mean(squares))), 3)


def _row(item: Tried) -> tuple[Cell, ...]:
    best = int(np.argmin(item.refined.mean(axis=1)))
    return (
        f"{item.square:g}",
        f"{item.slant:g}",
        f"{item.noise:g}",
        round(item.short, 1),
        round(item.edge, 1),
        _rms(item.unrefined),
        _rms(item.usual),
        _rms(item.chosen),
        round(item.half, 1),
        _rms(item.refined[best]),
        WINDOWS[best],
    )


def _summary(kinds: list[Tried]) -> list[tuple[Cell, ...]]:
    """Rows by the edge's share of the square."""
    rows: list[tuple[Cell, ...]] = []
    for low, high in ((0.0, 0.1), (0.1, 0.2), (0.2, 0.3), (0.3, 0.4), (0.4, 0.6)):
        chosen = [one for one in kinds if low <= one.edge / one.short < high]
        if not chosen:
            continue
        parts = [
            np.concatenate([getattr(one, name) for one in chosen])
            for name in ("unrefined", "usual", "chosen")
        ]
        worse = [
            sum(_rms(getattr(one, name)) > _rms(one.unrefined) for one in chosen)
            for name in ("usual", "chosen")
        ]
        best = np.concatenate([one.refined[one.refined.mean(axis=1).argmin()] for one in chosen])
        rows.append((f"{low:g} to {high:g}", len(chosen), *map(_rms, parts), _rms(best), *worse))
    return rows


def _quick(progress: Progress | None = None) -> Findings:
    return _measure(progress, 1)


def _measure(progress: Progress | None = None, pictures: int = _PICTURES) -> Findings:
    kinds = tried(progress, pictures)
    sheets = (
        Sheet(
            "share",
            "Error of the corners by the edge's share of the square [px RMS]",
            (
                "edge / square",
                "kinds",
                "unrefined",
                "a third of the square",
                "the rule",
                "best window",
                "third worse than unrefined",
                "rule worse than unrefined",
            ),
            tuple(_summary(kinds)),
        ),
        Sheet(
            "kinds",
            "Error of the corners [px RMS] and the window that gives it",
            (
                "square [px]",
                "slant [°]",
                "noise [grey]",
                "short way [px]",
                "edge [px]",
                "unrefined",
                "a third",
                "the rule",
                "± [px]",
                "best",
                "± best [px]",
            ),
            tuple(_row(one) for one in kinds),
        ),
    )
    lines = (
        "The rule: half the window is a third of the shortest way across a square; where edges "
        "are wide 1.5 times their width, up to half the square; at most 11 px.",
        "Where a picture's corners fit its camera better unrefined, the calibration takes those.",
    )
    return Findings(sheets, (Figure("window", lambda figure: _draw(figure, kinds)),), lines)


def _draw(figure: Any, kinds: list[Tried]) -> None:
    shares: NDArray[np.float64] = np.array(WINDOWS, dtype=np.float64)
    for place, noise in enumerate(NOISES):
        axes = figure.add_subplot(1, len(NOISES), place + 1)
        for one in kinds:
            if one.noise == noise:
                errors = np.sqrt(one.refined.mean(axis=1))
                tint = min(1.0, one.edge / one.short / 0.5)
                axes.plot(shares / one.short, errors, color=(tint, 0.2, 1.0 - tint), linewidth=0.7)
        axes.axvline(WINDOW_SHARE, color="black", linewidth=0.8)
        axes.set(
            title=f"noise {noise:g} grey",
            xlabel="half the window / shortest way across a square",
            yscale="log",
            xlim=(0.0, 1.0),
            ylabel="error of the corners [px RMS]",
        )
    figure.suptitle("blue: sharp edges, red: edges half as wide as the square")
    figure.tight_layout()


STUDY: Final = Survey(
    measure=_measure,
    quick=_quick,
)
"""Corner error against window, edge and square."""
