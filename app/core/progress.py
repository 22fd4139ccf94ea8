"""Progress and cancel for anything that can last over half a second."""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from math import exp

from app.core.errors import AcusError

USUAL_S = 20.0
"""A bar of work that cannot tell how far it is has two thirds of its way behind it by then."""

LOOK_S = 0.25
"""So often such a bar is moved [s]."""


class Cancelled(AcusError):  # noqa: N818  (a request, not an error)
    """The user asked to stop; nothing was kept half-done."""


class Progress:
    """Handed down into long work: the work reports, whoever started it listens and may cancel.

    Attributes:
        listener: called as `listener(fraction, text)` with a fraction in [0, 1], from the thread
            that does the work.
    """

    def __init__(self, listener: Callable[[float, str], None] | None = None) -> None:
        self._listener = listener
        self._cancelled = threading.Event()

    def cancel(self) -> None:
        """Ask the work to stop at its next report; callable from any thread."""
        self._cancelled.set()

    def report(self, fraction: float, text: str = "") -> None:
        """Tell how far the work is.

        Raises:
            Cancelled: if `cancel` was called.
        """
        self.check()
        if self._listener is not None:
            self._listener(min(1.0, max(0.0, fraction)), text)

    def check(self) -> None:
        """Stop here if that was asked for; tells nobody anything.

        Raises:
            Cancelled: if `cancel` was called.
        """
        if self._cancelled.is_set():
            raise Cancelled("cancelled")

    def part(self, start: float, end: float) -> "Progress":
        """Progress of a part of the work, mapped onto [start, end] of this one."""
        part = Progress(lambda fraction, text: self.report(start + (end - start) * fraction, text))
        part._cancelled = self._cancelled
        return part


def elapsed_share(waited: float) -> float:
    """Return where a bar stands after a time [s]: it always moves on, and never arrives."""
    return 1.0 - exp(-max(0.0, waited) / USUAL_S)


@contextmanager
def moving(progress: Progress, words: Callable[[float], str]) -> Iterator[None]:
    """Let a bar move by time while work goes on that cannot tell how far it is.

    Args:
        progress: of that work; told from another thread, four times a second.
        words: returns what is said after so many seconds.

    Raises:
        Cancelled: if `progress` was cancelled before.
    """
    begin, over = time.monotonic(), threading.Event()
    progress.report(0.0, words(0.0))

    def move() -> None:
        with suppress(Cancelled):  # the work itself ends where it can
            while not over.wait(LOOK_S):
                waited = time.monotonic() - begin
                progress.report(elapsed_share(waited), words(waited))

    mover = threading.Thread(target=move, name="acus-progress", daemon=True)
    mover.start()
    try:
        yield
    finally:
        over.set()
        mover.join()
