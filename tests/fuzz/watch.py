"""Looks at every child of the worker: what it has cost, what memory it had at most."""

import time
from pathlib import Path
from types import TracebackType

from app.imaging.worker import process


class Watch:
    """Counts the processor time of this process and of all children from `begin` to `end`.

    Attributes:
        most_bytes: most memory that a child ever had.
    """

    def __init__(self) -> None:
        self.most_bytes = 0
        self._init, self._close = process.Child.__init__, process.Child.close
        self._children: set[process.Child] = set()
        self._own, self._before, self._gone = 0.0, {}, 0.0

    def __enter__(self) -> "Watch":
        watch = self

        def init(child: process.Child, *arguments: str) -> None:
            watch._init(child, *arguments)
            watch._children.add(child)

        def close(child: process.Child) -> None:
            if child in watch._children:
                watch._children.discard(child)
                watch._gone += watch._used(child) - watch._before.get(child, 0.0)
            watch._close(child)

        from app.imaging.worker.pool import shared_worker

        self._children.update(shared_worker()._idle)
        process.Child.__init__, process.Child.close = init, close
        return self

    def __exit__(
        self, kind: type | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        process.Child.__init__, process.Child.close = self._init, self._close

    def begin(self) -> None:
        """Count from now."""
        self._before = {child: self._used(child) for child in self._children}
        self._own, self._gone = time.process_time(), 0.0

    def end(self) -> float:
        """Processor time since `begin` [s]; that of starting a child in place of a lost one too."""
        there = sum(self._used(child) - self._before.get(child, 0.0) for child in self._children)
        return time.process_time() - self._own + self._gone + there

    def _used(self, child: process.Child) -> float:
        folder = Path(f"/proc/{child._process.pid}")
        try:
            for line in (folder / "status").read_text().splitlines():
                if line.startswith("VmHWM"):
                    self.most_bytes = max(self.most_bytes, int(line.split()[1]) << 10)
            return int((folder / "schedstat").read_text().split()[0]) * 1e-9
        except (OSError, IndexError):  # gone already: what it cost last is not known
            return self._before.get(child, 0.0)
