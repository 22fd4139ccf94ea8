"""The tracker's thread: it repeats one step until it is told to stop."""

import threading
from collections.abc import Callable
from typing import Final

_PAUSE: Final = 0.1
"""Time [s] to wait after an error inside a step."""

_PATIENCE: Final = 2.0
"""Time [s] that closing waits for the thread."""

Stopped = Callable[[], bool]
"""Whether the thread that asks was told to stop."""


class Worker:
    """Runs a step again and again in a thread of its own.

    Args:
        step: the work; asks whether it was told to stop before it publishes anything.
        report: takes (kind, message) when steps begin to fail, and when the thread outlives its
            end.

    Attributes:
        fault: what the last step failed with; a step that succeeds empties it.
    """

    def __init__(self, step: Callable[[Stopped], None], report: Callable[[str, str], None]) -> None:
        self.fault = ""
        self._step = step
        self._report = report
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()

    @property
    def is_open(self) -> bool:
        """Whether the thread was started and not stopped."""
        return self._thread is not None

    def open(self) -> None:
        """Start; a thread that an earlier end has left behind stays stopped."""
        self._stop = threading.Event()
        self._thread = threading.Thread(
            target=self._run, args=(self._stop,), name="tracker", daemon=True
        )
        self._thread.start()

    def stop(self) -> None:
        """Tell the thread to stop, without waiting."""
        self._stop.set()

    def join(self, patience: float = _PATIENCE) -> None:
        """Wait for its end; one that does not come in time is told of.

        Args:
            patience: how long [s].
        """
        thread, self._thread = self._thread, None
        if thread is None:
            return
        thread.join(timeout=patience)
        if thread.is_alive():
            self._report(
                "tracker",
                f"the tracker has not ended within {patience:.1f} s of being closed: it is still "
                "at its last pictures; what it finds in them does not count",
            )

    def _run(self, stop: threading.Event) -> None:
        while not stop.is_set():
            try:
                self._step(stop.is_set)
            except Exception as error:  # shown as a fault; the next pictures are looked at
                if not stop.is_set():
                    self._fail(f"{type(error).__name__}: {error}")
                stop.wait(_PAUSE)

    def _fail(self, message: str) -> None:
        if message != self.fault:
            self._report("fault", f"the tracker failed: {message}")
        self.fault = message
