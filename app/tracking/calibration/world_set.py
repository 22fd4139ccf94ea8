"""Pictures on disk of boards at known places: looked at, for the world frame."""

from collections.abc import Sequence
from pathlib import Path

from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.tracking.calibration.board_pose import Pair
from app.tracking.calibration.boards import Board
from app.tracking.calibration.pairing import pair_folder
from app.tracking.calibration.pictures import look_at_all
from app.tracking.calibration.placed_board import PlacedBoard
from app.tracking.calibration.sets import Seen, none_seen
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError


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
            f"{len(folders)} folders and {len(places)} places were given; each folder needs the "
            "place of its board: --images DIR --at x,y,z[,rx,ry,rz]"
        )
    progress = progress or Progress()
    boards, looked = [], []
    for i, (folder, place) in enumerate(zip(folders, places, strict=True)):
        part = progress.part(i / len(folders), (i + 1) / len(folders))
        pairs = pair_folder(folder).pairs
        found = look_at_all([p for pair in pairs for p in (pair.left, pair.right)], board, part)
        looked += found
        views = [view if isinstance(view, BoardView) else None for view in found]
        seen: list[Pair] = [
            pair for pair in zip(views[0::2], views[1::2], strict=True) if any(pair)
        ]
        if not seen:
            raise CalibrationError(f"{folder}: {none_seen(found)}")
        boards.append(PlacedBoard(place, tuple(seen)))
    return boards, looked
