"""Boards as OpenCV projects them through lenses of any model; still, bent or moving."""

import cv2
import numpy as np

from app.core.rotation import rotation_exp
from app.tracking.calibration.boards import Board, parse_board
from app.tracking.calibration.views import BoardView

SIZE = (640, 480)
FIVE = ("pinhole", (-0.29, 0.11, 3e-4, -2e-4, 0.0), 534.0)
RATIONAL = ("pinhole", (0.3, -0.07, 2e-4, -1e-4, -0.003, 0.66, -0.05, -0.017), 260.0)
FISHEYE = ("fisheye", (-0.02, 0.004, -0.003, 0.0005), 215.0)

Lens = tuple[str, tuple[float, ...], float]


def projected(lens: Lens, points: np.ndarray) -> np.ndarray:
    """Pixels of points in the camera's frame, by OpenCV."""
    kind, coefficients, focal = lens
    matrix = np.array([[focal, 0.0, 322.5], [0.0, 1.001 * focal, 235.5], [0.0, 0.0, 1.0]])
    nothing, d = np.zeros(3), np.array(coefficients)
    if kind == "fisheye":
        return cv2.fisheye.projectPoints(points[:, None], nothing, nothing, matrix, d)[0][:, 0]
    return cv2.projectPoints(points, nothing, nothing, matrix, d)[0][:, 0]


def lens_views(
    lens: Lens,
    count: int,
    seed: int,
    *,
    board: str = "checkerboard:9x6:25mm",
    distance: float = 0.3,
    noise: float = 0.1,
    share: float = 1.0,
    bowl: float = 0.0,
    speed: float = 0.0,
    readout: float = 0.02,
) -> list[BoardView]:
    """Views of a board in the middle `share` of the picture's area.

    The board is bent by `bowl` [m] and moves by about `speed` [m/s] while the rows are read.
    """
    rng, known = np.random.default_rng(seed), parse_board(board)
    edge = np.maximum(5.0, 0.5 * (1.0 - np.sqrt(share)) * np.array(SIZE))
    angle = np.arctan(320.0 / lens[2]) * np.array([1.0, 0.75])
    found: list[BoardView] = []
    while len(found) < count:
        turn = rotation_exp(np.deg2rad(35.0) * rng.uniform(-1.0, 1.0, 3))
        place = np.append(np.tan(rng.uniform(-angle, angle)), 1.0)
        place *= distance * rng.uniform(0.7, 1.4) / np.linalg.norm(place)
        velocity = speed * rng.standard_normal(3) / np.sqrt(3.0)
        spin = 2.0 * speed / 0.15 * rng.standard_normal(3) / np.sqrt(3.0)
        uv = _picture(lens, known, turn, place, bowl, velocity * readout, spin * readout)
        if uv is None:
            continue
        uv += noise * rng.standard_normal(uv.shape)
        if (uv > edge).all() and (uv < np.array(SIZE) - edge).all():
            found.append(
                BoardView(known, np.arange(known.count), uv, SIZE, name=f"view {len(found)}")
            )
    return found


def _picture(
    lens: Lens,
    board: Board,
    turn: np.ndarray,
    place: np.ndarray,
    bowl: float,
    moved: np.ndarray,
    turned: np.ndarray,
) -> np.ndarray | None:
    """Pixels of the corners, each at the time at which its row is read."""
    about = board.points - board.points.mean(axis=0)
    part = about / np.abs(about).max()
    about[:, 2] += bowl * (1.0 - (part**2).sum(axis=1))
    late = np.zeros(len(about))
    for _ in range(1 if not moved.any() else 6):
        turns = [rotation_exp(t * turned) @ turn for t in late]
        at = np.array([R @ p for R, p in zip(turns, about, strict=True)])
        at += place + late[:, None] * moved
        if at[:, 2].min() < 0.02:
            return None
        uv = projected(lens, at)
        late = uv[:, 1] / SIZE[1] - 0.5
    return uv
