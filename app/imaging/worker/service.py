"""What the program asks of the worker: headers of files, and slices of Hounsfield values."""

import os
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from app.core import paths as paths_of_user
from app.core.messages import sentence, sentence_of
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, NotExactError, WorkerLostError
from app.imaging.header import SliceHeader
from app.imaging.pixel_data import DECODERS, RLE
from app.imaging.privacy.key import installation_key
from app.imaging.series import Ignored
from app.imaging.worker.jobs import FILL, LOAD_DECODERS, READ_HEADERS, Task
from app.imaging.worker.lent_memory import LentMemory
from app.imaging.worker.limits import Allowance, for_file, size_of
from app.imaging.worker.pool import ImagingWorker, shared_worker
from app.imaging.worker.values import reader

_LONG = 10_000_000
"""Pixels that take so long to decode that two do it sooner, though the second must come up first:
a third of a second of JPEG-LS, more than one of JPEG 2000."""

_LOADING = Allowance(60.0)

FileHeaders = tuple[SliceHeader, ...] | Ignored


def load_decoders(progress: Progress, worker: ImagingWorker | None = None) -> None:
    """Let the worker load what decodes now, so that the first compressed series need not wait.

    Args:
        progress: cancels.
        worker: which one; the shared one if left out.

    Raises:
        WorkerError: if the process cannot be started.
        WorkerLostError: if a decoder ends it.
        Cancelled: if `progress` was cancelled.
    """
    (worker or shared_worker()).call(LOAD_DECODERS, (), _LOADING, progress)
    reader(READ_HEADERS.gives)


def read_headers(
    paths: Sequence[Path], progress: Progress, worker: ImagingWorker | None = None
) -> list[FileHeaders]:
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
    settings = paths_of_user.settings().absolute()
    tasks = [
        Task.of(READ_HEADERS, (os.path.abspath(path), settings), for_file(size_of(path)))
        for path in paths
    ]
    found: list[FileHeaders] = [Ignored(path, "not examined") for path in paths]
    with closing((worker or shared_worker()).run(tasks, progress)) as run:
        for done, (number, outcome) in enumerate(run, 1):
            found[number] = _headers_or_reason(paths[number], outcome)
            progress.report(
                done / len(paths),
                sentence("{ready} of {count} files", ready=done, count=len(paths)),
            )
    return found


def _headers_or_reason(path: Path, outcome: Any) -> FileHeaders:
    """Headers or why not, with the program's own name of the file, whatever came back."""
    if isinstance(outcome, Exception):
        return Ignored(path, sentence_of(outcome))
    if isinstance(outcome, Ignored):
        return Ignored(path, outcome.reason)
    return tuple(replace(header, path=path) for header in outcome)


def fill_slices(
    headers: Sequence[SliceHeader],
    places: Sequence[int],
    dtype: np.dtype[Any],
    memory: LentMemory,
    progress: Progress,
    worker: ImagingWorker | None = None,
) -> None:
    """Decode slices in the worker process, straight into the memory of a volume.

    Args:
        headers: of the slices, all of one size.
        places: where in the volume each belongs.
        dtype: int16 or float32.
        memory: of the volume.
        progress: told how far it is; cancels.
        worker: which one; the shared one if left out.

    Raises:
        NotExactError: if a value does not fit 16 bits and int16 was asked for.
        FileDamagedError: if a file cannot be decoded; names it.
        WorkerLostError: if a file crashed or hung the process that read it; names it, and what
            decoded it.
        WorkerError: if the process cannot be started.
        Cancelled: if `progress` was cancelled.
    """
    tasks = [
        _filling(header, place, dtype.name) for header, place in zip(headers, places, strict=True)
    ]
    is_long = sum(map(_work, headers)) > _LONG
    run_all = (worker or shared_worker()).run(tasks, progress, memory, is_long)
    with closing(run_all) as run:
        for done, (number, outcome) in enumerate(run, 1):
            if outcome is not None:
                raise _named(headers[number], outcome)
            progress.report(
                done / len(headers),
                sentence("slice {ready} of {count}", ready=done, count=len(headers)),
            )


def _work(header: SliceHeader) -> int:
    """Pixels of a slice that take their time to decode; RLE hardly takes any."""
    return 0 if header.pixels.syntax == RLE else header.format.rows * header.format.columns


def _filling(header: SliceHeader, place: int, dtype: str) -> Task:
    there = replace(header, path=header.path.absolute())
    pixels = header.format.rows * header.format.columns
    return Task.of(FILL, (there, place, dtype), for_file(size_of(header.path), pixels))


def _named(header: SliceHeader, outcome: Exception) -> Exception:
    """Error with the file's name in it, and the decoder's where that was lost."""
    path, text = header.path, sentence_of(outcome)
    if isinstance(outcome, NotExactError):
        return outcome
    if isinstance(outcome, WorkerLostError):
        decoder = DECODERS.get(header.pixels.syntax, ("inflating",))[0]
        return WorkerLostError(
            sentence(
                "{path}: {fault} (decoder {decoder}); leave it out",
                path=path,
                fault=text,
                decoder=decoder,
            )
        )
    return FileDamagedError(
        text if str(path) in text else sentence("{path}: {fault}", path=path, fault=text)
    )
