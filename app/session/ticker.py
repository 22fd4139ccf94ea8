"""A thread that calls a function at a steady rate, on absolute deadlines."""

import threading
import time
from collections.abc import Callable


class Ticker:
    """Calls `tick` every `period` [s] until closed; a late call is not caught up.

    If `tick` raises, the thread ends after it has told `on_error`, and `failed` is True.
    """

    def __init__(
        self, tick: Callable[[], object], period: float, on_error: Callable[[Exception], None]
    ) -> None:
        self._tick = tick
        self._period = period
        self._on_error = on_error
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self.failed = False

    def open(self) -> None:
        """Start the thread; idempotent."""
        if self._thread is None:
            self._stop.clear()
            self._thread = threading.Thread(target=self._run, name="acus-ticker", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Stop and wait for the last call; idempotent; may be called from the tick itself."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join()

    def _run(self) -> None:
        deadline = time.monotonic()
        while not self._stop.is_set():
            try:
                self._tick()
            except Exception as error:
                self.failed = True
                self._on_error(error)
                raise
            deadline = max(deadline + self._period, time.monotonic())
            self._stop.wait(deadline - time.monotonic())
