"""Lines typed into a command that goes on running."""

import queue
import stat
import sys
import threading
from os import fstat


class Orders:
    """Lines of the standard input, read by a thread.

    `ended` becomes true when a pipe ends: whoever gave orders through it has gone. The end of a
    terminal or of /dev/null means nothing.
    """

    def __init__(self) -> None:
        self.ended = False
        self._lines: queue.SimpleQueue[str] = queue.SimpleQueue()
        threading.Thread(target=self._read, name="acus orders", daemon=True).start()

    def waiting(self) -> list[str]:
        """Take the lines that have come, without blanks."""
        lines = []
        while not self._lines.empty():
            lines.append(self._lines.get())
        return lines

    def _read(self) -> None:
        for line in sys.stdin:
            if line.strip():
                self._lines.put(line.strip())
        self.ended = stat.S_ISFIFO(fstat(sys.stdin.fileno()).st_mode)
