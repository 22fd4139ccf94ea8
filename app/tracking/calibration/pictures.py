"""Pictures on disk: listed, read, and searched for a board on all cores."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from os import cpu_count
from pathlib import Path
from typing import Final

import cv2

from app.core.messages import sentence
from app.core.progress import Progress
from app.tracking.calibration.boards import Board
from app.tracking.calibration.corners import find_corners
from app.tracking.calibration.views import BoardView, Rejection, RejectionReason
from app.tracking.errors import CalibrationError, TrackingError
from app.tracking.picture_file import no_folder, read_pixels

SUFFIXES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".webp")

MOST_PICTURES: Final = 2000
"""A folder of more is no set of calibration pictures: 20 to 200 are one."""


def list_pictures(folder: Path, pattern: str = "*") -> list[Path]:
    """Pictures of a folder by name; other files are passed over.

    Raises:
        CalibrationError: if there is no such folder, no picture in it, or more than
            `MOST_PICTURES`.
    """
    if not folder.is_dir():
        raise CalibrationError(
            sentence("{no_folder}; give the folder of the pictures", no_folder=no_folder(folder))
        )
    found = sorted(
        path for path in folder.glob(pattern) if path.is_file() and path.suffix.lower() in SUFFIXES
    )
    if not found:
        named = "" if pattern == "*" else f" named {pattern}"
        raise CalibrationError(
            sentence(
                "no picture{named} in {folder}; choose the folder of the pictures "
                "({suffixes} are read)",
                named=named,
                folder=folder,
                suffixes=", ".join(SUFFIXES),
            )
        )
    if len(found) > MOST_PICTURES:
        raise CalibrationError(
            sentence(
                "{count} pictures in {folder}, {most_pictures} are the most: put 20 to 200 of "
                "them, of different views, into a folder of their own",
                count=len(found),
                folder=folder,
                most_pictures=MOST_PICTURES,
            )
        )
    return found


def list_matching(text: str) -> list[Path]:
    """Pictures of a folder, or those that a pattern such as `frames/camera0_*.png` names.

    Raises:
        CalibrationError: as `list_pictures`.
    """
    path = Path(text)
    return list_pictures(path) if path.is_dir() else list_pictures(path.parent, path.name)


def has_pictures(folder: Path) -> bool:
    """Return whether pictures lie in a folder itself."""
    return any(path.suffix.lower() in SUFFIXES for path in folder.glob("*") if path.is_file())


def strange_files(folder: Path) -> list[Path]:
    """Files in a folder that are no pictures by their names; hidden ones do not count."""
    return sorted(
        path
        for path in folder.glob("*")
        if path.is_file() and path.suffix.lower() not in SUFFIXES and path.name[0] != "."
    )


def read_view(
    path: Path, board: Board, thorough: bool = True, window: int | None = None
) -> BoardView | Rejection:
    """Read a picture and find the board; a file that is none, or too large, is a rejection."""
    try:
        image = read_pixels(path)
    except OSError as error:
        why = sentence("cannot be read: {error_strerror}", error_strerror=error.strerror or error)
        return Rejection(RejectionReason.UNREADABLE, why, path.name)
    except TrackingError as error:
        return Rejection(RejectionReason.UNREADABLE, _short(error), path.name)
    try:
        found = find_corners(image, board, thorough, window)
    except (CalibrationError, cv2.error) as error:
        return Rejection(
            RejectionReason.UNREADABLE,
            sentence("cannot be used: {short}", short=_short(error)),
            path.name,
        )
    if isinstance(found, Rejection):
        return Rejection(found.reason, found.text, path.name)
    return found.called(path.name)


def read_views(
    paths: Sequence[Path],
    board: Board,
    progress: Progress | None = None,
    window: int | None = None,
) -> list[BoardView | Rejection]:
    """Find the board in many pictures, in the order given; OpenCV works outside the lock.

    Raises:
        Cancelled: if `progress` was cancelled; pictures being searched are finished first.
    """
    progress = progress or Progress()
    progress.report(0.0, sentence("looking for the board"))
    with ThreadPoolExecutor(max_workers=max(1, cpu_count() or 1)) as pool:
        jobs = {pool.submit(read_view, path, board, True, window): path for path in paths}
        try:
            for count, job in enumerate(as_completed(jobs), 1):
                progress.report(count / len(jobs), sentence("read at {name}", name=jobs[job].name))
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
        return [job.result() for job in jobs]


def _short(error: Exception) -> str:
    return " ".join(str(error).split())[:200]
