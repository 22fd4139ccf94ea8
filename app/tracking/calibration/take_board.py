"""Opens both cameras and takes a few pictures of a board that lies still, beside the window."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from typing import Final

from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.tracking.calibration.boards import Board
from app.tracking.calibration.camera_pair import OpenPair, close_all
from app.tracking.calibration.capture import LiveShots
from app.tracking.calibration.corners import find_corners
from app.tracking.calibration.placed_board import PlacedBoard
from app.tracking.calibration.views import BoardView, Rejection
from app.tracking.errors import CalibrationError

_PICTURES: Final = 3
"""Live pictures that are averaged at one place."""

_LIVE_TIMEOUT: Final = 10.0


def take_board(
    open_pair: OpenPair, board: Board, names: Sequence[str], at: RigidTransform, progress: Progress
) -> PlacedBoard:
    """Open the cameras, take a few pictures in which one sees the board, close them.

    Raises:
        CalibrationError: if the board is not seen within ten seconds; says why.
    """
    cameras = open_pair(progress)
    stop, end = threading.Event(), time.monotonic() + _LIVE_TIMEOUT
    pairs: list[tuple[BoardView | None, BoardView | None]] = []
    why = ""
    try:
        for shot in LiveShots(cameras, names, end).shots(stop):
            found = [
                find_corners(image, board, thorough=False) if image is not None else None
                for image in shot.images
            ]
            left, right = (
                one.called(name) if isinstance(one, BoardView) else None
                for one, name in zip(found, shot.names, strict=True)
            )
            why = next((one.text for one in found if isinstance(one, Rejection)), why)
            if left is not None or right is not None:
                pairs.append((left, right))
            progress.report(len(pairs) / _PICTURES, "looking for the board")
            if len(pairs) == _PICTURES:
                break
    finally:
        close_all(cameras)
    if not pairs:
        raise CalibrationError(
            f"the board was not seen within {_LIVE_TIMEOUT:.0f} s: "
            f"{why or 'the cameras deliver no pictures of one moment'}"
        )
    return PlacedBoard(at, tuple(pairs))
