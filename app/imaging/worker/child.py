"""The child's side: takes a task, does it, answers; ends when the program is gone.

It is started while somebody waits for a folder, so it loads what reads standard headers, no more:
numpy, pydicom and the decoders come with the first file that needs them.
"""

import importlib
import logging
import socket
import warnings
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, get_type_hints

from app.core.progress import Progress
from app.imaging.worker.answers import PROGRESS, Answer, done, failed
from app.imaging.worker.attachments import Attachments, opened
from app.imaging.worker.channel import VOLUME, WorkerChannel
from app.imaging.worker.limits import MemoryLimit, limit_time
from app.imaging.worker.values import Convert, reader

READY = "ready"

_AT_START = ("app.imaging.header_reading:headers_in",)
"""Imported before the child is ready: every folder needs it."""


def main(descriptor: int) -> None:
    """Work until the other end is closed.

    Args:
        descriptor: this end of the socket pair.
    """
    channel = WorkerChannel(socket.socket(fileno=descriptor))
    warnings.simplefilter("ignore")  # what packages say of a file quotes its header
    logging.disable(logging.CRITICAL)
    for place in _AT_START:
        _job(place)
    memory = MemoryLimit()
    channel.send(READY)
    while True:
        while (message := channel.take()) is None:
            if not channel.fill():
                return
        limit_time()
        if message[0] == VOLUME:
            _take_volume(channel.take_descriptor())
        else:
            _do(channel, memory, message)


def _take_volume(descriptor: int) -> None:
    from app.imaging import rescaling

    rescaling.take_volume(descriptor)


def _do(channel: WorkerChannel, memory: MemoryLimit, message: list[Any]) -> None:
    place, allowed, arguments, has_arrays = message
    if has_arrays:
        arguments = opened(arguments, channel.take_descriptor())
    memory.set(allowed)
    attachments = Attachments()
    answer = _answer(place, arguments, _progress(channel), attachments, allowed)
    try:
        descriptor = attachments.descriptor() if attachments else None
    except (OSError, MemoryError):
        answer, descriptor = failed(MemoryError(), allowed), None
    channel.send(answer, descriptor)


def _answer(
    place: str, arguments: Sequence[Any], progress: Progress, attachments: Attachments, allowed: int
) -> Answer:
    """Do one task: its result, or why there is none."""
    try:
        work, converts = _job(place)
        given = [convert(value) for convert, value in zip(converts, arguments, strict=True)]
        return done(work(*given, progress), attachments)
    except (KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:  # parsers raise nearly anything; Rust's panics are no Exception
        attachments.clear()
        return failed(error, allowed)


@cache
def _job(place: str) -> tuple[Callable[..., Any], tuple[Convert, ...]]:
    """Find the function of a job, and what makes its arguments of JSON; the progress comes last."""
    module, name = place.split(":")
    work = getattr(importlib.import_module(module), name)
    hints = get_type_hints(work, include_extras=True)
    kinds = [hints[argument] for argument in hints if argument not in ("progress", "return")]
    return work, tuple(Path if kind is Path else reader(kind) for kind in kinds)


def _progress(channel: WorkerChannel) -> Progress:
    """Progress that the program hears of."""

    def tell(fraction: float, text: str) -> None:
        limit_time()
        channel.send([PROGRESS, float(fraction), text[:200]])

    return Progress(tell)
