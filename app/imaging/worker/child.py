"""The child's side: takes a task, does it, answers; ends when the program is gone.

It is started while somebody waits for a folder, so it loads what reads standard headers, no more:
numpy, pydicom and the decoders come with the first file that needs them.
"""

import importlib
import logging
import warnings
from collections import deque
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, get_type_hints

from app.core.progress import Progress
from app.imaging.worker.answers import PROGRESS, Answer, done, failed
from app.imaging.worker.attachments import Attachments, opened
from app.imaging.worker.channel import MOST_OPEN, VOLUME, WorkerChannel
from app.imaging.worker.lent_memory import LentMemory
from app.imaging.worker.limits import MemoryLimit, limit_time
from app.imaging.worker.starting import connected
from app.imaging.worker.values import Convert, reader

READY = "ready"

_NAMED: deque[LentMemory] = deque(maxlen=MOST_OPEN)
"""Memory of the last answers, which the program may not have taken yet."""

_AT_START = ("app.imaging.header_reading:headers_in",)
"""Imported before the child is ready: every folder needs it."""


def main(where: str) -> None:
    """Work until the other end is closed.

    Args:
        where: this end of the connection is: what the program that started this one says.
    """
    channel = WorkerChannel(connected(where))
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
            _take_volume(channel.take_memory())
        else:
            _do(channel, memory, message)


def _take_volume(memory: LentMemory) -> None:
    from app.imaging import rescaling

    rescaling.take_volume(memory)


def _do(channel: WorkerChannel, memory: MemoryLimit, message: list[Any]) -> None:
    place, allowed, arguments, has_arrays = message
    if has_arrays:
        arguments = opened(arguments, channel.take_memory())
    memory.set(allowed)
    attachments = Attachments()
    answer = _answer(place, arguments, _progress(channel), attachments, allowed)
    try:
        lent = attachments.memory() if attachments else None
    except (OSError, MemoryError):
        answer, lent = failed(MemoryError(), allowed), None
    channel.send(answer, lent)
    if lent is not None and lent.name:
        _NAMED.append(lent)  # it is there for as long as somebody has it
    elif lent is not None:
        lent.close()


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
