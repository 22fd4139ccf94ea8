"""Pictures of boards at known places, for the world frame: read from folders, or taken now."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.tracking.calibration.board_pose import Pair
from app.tracking.calibration.boards import Board
from app.tracking.calibration.camera_pair import OpenPair, close_all
from app.tracking.calibration.capture import LiveShots
from app.tracking.calibration.corners import find_corners
from app.tracking.calibration.pairing import pair_folder
from app.tracking.calibration.pictures import read_views
from app.tracking.calibration.placed_board import PlacedBoard
from app.tracking.calibration.sets import Seen, none_seen
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
            progress.report(len(pairs) / _PICTURES, sentence("looking for the board"))
            if len(pairs) == _PICTURES:
                break
    finally:
        close_all(cameras)
    if not pairs:
        raise CalibrationError(
            sentence(
                "the board was not seen within {live_timeout:.0f} s: {reason}",
                live_timeout=_LIVE_TIMEOUT,
                reason=why or "the cameras deliver no pictures of one moment",
            )
        )
    return PlacedBoard(at, tuple(pairs))


def placed_boards(
    folders: Sequence[Path],
    places: Sequence[RigidTransform],
    board: Board,
    progress: Progress | None = None,
) -> tuple[list[PlacedBoard], list[Seen]]:
    """Find a board in the pairs of pictures of several folders, one folder for each place.

    Args:
        folders: of the pictures; names pair them as for `acus calibrate stereo`.
        places: T_world_board, one for each folder.
        board: which board.
        progress: reports, and may cancel.

    Returns:
        The boards, and every picture as it was seen.

    Raises:
        CalibrationError: if folders and places do not go together, or a folder shows no board.
        Cancelled: through `progress`.
    """
    if len(folders) != len(places) or not folders:
        raise CalibrationError(
            sentence(
                "{folders} folders and {places} places were given; each folder needs "
                "the place of its board: --images DIR --at x,y,z[,rx,ry,rz]",
                folders=len(folders),
                places=len(places),
            )
        )
    progress = progress or Progress()
    boards, read = [], []
    for i, (folder, place) in enumerate(zip(folders, places, strict=True)):
        part = progress.part(i / len(folders), (i + 1) / len(folders))
        pairs = pair_folder(folder).pairs
        found = read_views([p for pair in pairs for p in (pair.left, pair.right)], board, part)
        read += found
        views = [view if isinstance(view, BoardView) else None for view in found]
        seen: list[Pair] = [
            pair for pair in zip(views[0::2], views[1::2], strict=True) if any(pair)
        ]
        if not seen:
            raise CalibrationError(
                sentence("{folder}: {none_seen}", folder=folder, none_seen=none_seen(found))
            )
        boards.append(PlacedBoard(place, tuple(seen)))
    return boards, read
