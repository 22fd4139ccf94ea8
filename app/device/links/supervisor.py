"""The thread that notices when a board falls silent, and asks for it to be found again."""

import threading
from collections.abc import Callable

from app.core.arrays import FloatArray
from app.device.links import host_end as host
from app.device.links import wire

CHECK_EVERY = 0.02
"""Time between two looks [s]."""

SILENCE = 0.25
"""Without a reply for this long while commands go out, the connection is made anew [s]."""


class Supervisor:
    """Watches one end of a wire.

    Args:
        end: array of the program's end.
        lost: called in the thread when the board is lost; returns once it is found, or when `wait`
            says that the thread shall end.
    """

    def __init__(self, end: FloatArray, lost: Callable[[], None]) -> None:
        self._end = end
        self._lost = lost
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def running(self) -> bool:
        """Whether the thread has been started and not stopped."""
        return self._thread is not None

    def start(self) -> None:
        """Start watching."""
        self._stop.clear()
        self._thread = threading.Thread(target=self._run, name="acus link", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Stop watching and wait for the thread. Idempotent."""
        thread, self._thread = self._thread, None
        self._stop.set()
        if thread is not None and thread is not threading.current_thread():
            thread.join()

    def wait(self, seconds: float) -> bool:
        """Wait; return True at once if the thread shall end."""
        return self._stop.wait(seconds)

    def _run(self) -> None:
        silence, replies, ticks = 0.0, -1.0, -1.0
        while not self._stop.wait(CHECK_EVERY):
            end = self._end
            if end[host.REPLIES] != replies or end[host.TICKS] == ticks:
                silence = 0.0  # it answers, or nobody asks
            else:
                silence += CHECK_EVERY
            replies, ticks = end[host.REPLIES], end[host.TICKS]
            if end[wire.DEAD] != 0.0 or end[host.ESTRANGED] != 0.0 or silence > SILENCE:
                self._lost()
                silence = 0.0
