"""Progress and cancel for anything that can last over half a second."""

import threading
from collections.abc import Callable

from app.core.errors import AcusError


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
