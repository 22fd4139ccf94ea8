"""The child's side: takes a task, does it, answers; ends when the program is gone."""

import os
import socket
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.imaging.decoding import stored_type
from app.imaging.errors import FileDamagedError, SeriesRefusedError
from app.imaging.examining import examine
from app.imaging.header import SliceHeader
from app.imaging.rescaling import NotExactError, fill_slice
from app.imaging.series import Ignored
from app.imaging.worker.channel import Channel
from app.imaging.worker.limits import MEMORY_BYTES, limit_memory, limit_time
from app.imaging.worker.values import plain, reader

READY = "ready"


def main(descriptor: int) -> None:
    """Work until the other end is closed.

    Args:
        descriptor: this end of the socket pair.
    """
    channel = Channel(socket.socket(fileno=descriptor))
    limit_memory()
    channel.send(READY)
    tasks = Tasks()
    while True:
        while (message := channel.take()) is None:
            if not channel.fill():
                return
        limit_time()
        if message[0] == "volume":
            tasks.volume(channel.take_descriptor())
        else:
            channel.send(tasks.answer(message))


class Tasks:
    """What the child can do. A task is a list: its name, then its arguments."""

    def __init__(self) -> None:
        self._volume: int | None = None
        self._scratch: dict[Any, NDArray[Any]] = {}

    def volume(self, descriptor: int) -> None:
        """Take the memory that slices are written to."""
        if self._volume is not None:
            os.close(self._volume)
        self._volume = descriptor

    def answer(self, message: list[Any]) -> list[Any]:
        """Do one task: its result, or why there is none, with a word before it for which."""
        name, *arguments = message
        try:
            return self.examined(*arguments) if name == "examine" else self.filled(*arguments)
        except NotExactError:
            return ["inexact"]
        except (FileDamagedError, SeriesRefusedError) as error:
            return ["damaged", str(error)]
        except MemoryError:
            return ["damaged", f"it needs more than {MEMORY_BYTES >> 20} MB of memory to be read"]
        except Exception as error:  # hostile bytes can make the parsers raise nearly anything
            return ["damaged", f"it cannot be read ({type(error).__name__}: {error})"[:200]]

    def examined(self, path: str, settings: str) -> list[Any]:
        """Answer the headers in a file, or why it has none; pseudonyms need the key in settings."""
        os.environ["ACUS_SETTINGS"] = settings
        found = examine(Path(path))
        if isinstance(found, Ignored):
            return ["ignored", found.reason]
        return ["headers", plain(found)]

    def filled(self, header: list[Any], place: int, dtype: str) -> list[Any]:
        """Write a slice of Hounsfield values to its place in the volume."""
        known: SliceHeader = reader(SliceHeader)(header)
        shape = known.format.rows, known.format.columns
        hu = self._array("hu", shape, np.dtype(dtype))
        fill_slice(known, hu, self._array("stored", shape, stored_type(known.format)))
        if self._volume is None:
            raise FileDamagedError("there is no volume to write to")
        view, at = memoryview(hu.data).cast("B"), place * hu.nbytes
        while view:
            written = os.pwrite(self._volume, view, at)
            view, at = view[written:], at + written
        return ["filled"]

    def _array(self, name: str, shape: tuple[int, int], dtype: np.dtype[Any]) -> NDArray[Any]:
        kept = self._scratch.get(name)
        if kept is None or kept.shape != shape or kept.dtype != dtype:
            kept = self._scratch[name] = np.empty(shape, dtype)
        return kept
