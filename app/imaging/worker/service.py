"""What the program asks of the worker: headers of files, and slices of Hounsfield values."""

import os
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from app.core import paths as paths_of_user
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, WorkerLostError
from app.imaging.header import SliceHeader
from app.imaging.privacy.key import installation_key
from app.imaging.rescaling import NotExactError
from app.imaging.series import Ignored
from app.imaging.worker.limits import (
    FILE_SECONDS,
    MOST_SECONDS,
    SECONDS_PER_BYTE,
    SECONDS_PER_PIXEL,
)
from app.imaging.worker.pool import ImagingWorker, Task, shared_worker
from app.imaging.worker.values import ForeignValueError, plain, reader

Examined = tuple[SliceHeader, ...] | Ignored


def examine_files(
    paths: Sequence[Path], progress: Progress, worker: ImagingWorker | None = None
) -> list[Examined]:
    """Read the headers of files in the worker process.

    Args:
        paths: the files.
        progress: told how far it is; cancels.
        worker: which one; the shared one if left out.

    Returns:
        For each file the headers of its images, or why it has none: damaged, or it crashed or hung
        the process that read it.

    Raises:
        WorkerError: if the process cannot be started.
        KeyDamagedError: if the key of the pseudonyms cannot be read or made.
        Cancelled: if `progress` was cancelled.
    """
    installation_key()  # what is wrong with it is told here, not once for each file
    settings = str(paths_of_user.settings().absolute())
    tasks = [
        Task(["examine", os.path.abspath(path), settings], _seconds(_size(path))) for path in paths
    ]
    found: list[Examined] = [Ignored(path, "not examined") for path in paths]
    with closing((worker or shared_worker()).run(tasks, progress)) as run:
        for done, (number, answer) in enumerate(run, 1):
            found[number] = _examined(paths[number], answer)
            progress.report(done / len(paths), f"{done} of {len(paths)} files")
    return found


def _examined(path: Path, answer: list[Any]) -> Examined:
    word, *values = answer
    try:
        if word == "headers":
            headers: tuple[SliceHeader, ...] = reader(tuple[SliceHeader, ...])(values[0])
            return tuple(replace(header, path=path) for header in headers)
        reason: str = reader(str)(values[0])
    except (ForeignValueError, IndexError):
        return Ignored(path, "damaged or hostile file: the process that read it talked nonsense")
    if word == "lost":
        return Ignored(path, f"damaged or hostile file: the process that read it {reason}")
    return Ignored(path, reason)


def fill_slices(
    headers: Sequence[SliceHeader],
    places: Sequence[int],
    dtype: np.dtype[Any],
    descriptor: int,
    progress: Progress,
    worker: ImagingWorker | None = None,
) -> None:
    """Decode slices in the worker process, straight into the memory of a volume.

    Args:
        headers: of the slices, all of one size.
        places: where in the volume each belongs.
        dtype: int16 or float32.
        descriptor: of that memory.
        progress: told how far it is; cancels.
        worker: which one; the shared one if left out.

    Raises:
        NotExactError: if a value does not fit 16 bits and int16 was asked for.
        FileDamagedError: if a file cannot be decoded; names it.
        WorkerLostError: if a file crashed or hung the process that read it; names it.
        WorkerError: if the process cannot be started.
        Cancelled: if `progress` was cancelled.
    """
    tasks = [
        _filling(header, place, dtype.name) for header, place in zip(headers, places, strict=True)
    ]
    with closing((worker or shared_worker()).run(tasks, progress, descriptor)) as run:
        for done, (number, answer) in enumerate(run, 1):
            _check_filled(headers[number].path, answer)
            progress.report(done / len(headers), f"slice {done} of {len(headers)}")


def _filling(header: SliceHeader, place: int, dtype: str) -> Task:
    there = plain(replace(header, path=header.path.absolute()))
    pixels = header.format.rows * header.format.columns
    return Task(["fill", there, place, dtype], _seconds(_size(header.path), pixels))


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:  # the child says what is wrong with it
        return 0


def _seconds(size: int, pixels: int = 0) -> float:
    """Processor time that reading a file may take."""
    return min(MOST_SECONDS, FILE_SECONDS + size * SECONDS_PER_BYTE + pixels * SECONDS_PER_PIXEL)


def _check_filled(path: Path, answer: list[Any]) -> None:
    word, *values = answer
    if word == "filled":
        return
    if word == "inexact":
        raise NotExactError
    reason = values[0] if values and isinstance(values[0], str) else "gave no reason"
    if word == "lost":
        raise WorkerLostError(
            f"{path} is damaged or hostile: the process that read it {reason}; leave it out"
        )
    raise FileDamagedError(reason if str(path) in reason else f"{path}: {reason}")
