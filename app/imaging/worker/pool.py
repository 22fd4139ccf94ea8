"""The program's side of the worker: warm children, and who may use them."""

import atexit
import os
import threading
from collections import deque
from collections.abc import Generator, Sequence
from contextlib import closing
from typing import Any

from app.core.progress import Progress
from app.imaging.worker.crew import Crew
from app.imaging.worker.jobs import Job, Result, Task
from app.imaging.worker.limits import Allowance
from app.imaging.worker.process import ENTRY, Child

MOST_CHILDREN = 2
_LOOK = 0.1
"""How long [s] one waits for a child at most before looking again whether that was cancelled."""


class ImagingWorker:
    """Children that read foreign files. Starts them when they are needed and keeps them warm.

    Any thread may use it; those that come while all children are busy wait.

    Args:
        most: children at work at once; as many as there are processors, two at most, if left out.
        module: what a child runs.
    """

    def __init__(self, most: int = 0, module: str = ENTRY) -> None:
        self._module = module
        self._most = most or min(MOST_CHILDREN, os.cpu_count() or 1)
        self._idle: list[Child] = []
        self._leased = 0
        self._free = threading.Condition()

    def warm(self) -> None:
        """Start a child now, so that the first folder need not wait for it; at once back.

        Raises:
            WorkerError: if it cannot be started.
        """
        with self._free:
            if not self._idle and not self._leased:
                self._idle.append(Child(self._module))

    def close(self) -> None:
        """End the children that are not at work; idempotent. The next task starts new ones."""
        with self._free:
            idle, self._idle = self._idle, []
        for child in idle:
            child.close()

    def run(
        self,
        tasks: Sequence[Task],
        progress: Progress,
        descriptor: int | None = None,
        is_long: bool = False,
    ) -> Generator[tuple[int, Any], None, None]:
        """Do tasks, in any order. Close what is returned: an error leaves children at work.

        Args:
            tasks: what to do.
            progress: cancels within a tenth of a second, and is told of tasks that tell how far
                they are or take over a second; who asked tells it of each that is done.
            descriptor: memory that slices are written to.
            is_long: whether a second child is worth starting at once, and not only when the first
                answers say so.

        Yields:
            The task's number and its outcome: the result of its job, or an error, made and not
            raised: `WorkerLostError` for one that crashed or hung its child, which is replaced.

        Raises:
            WorkerError: if no child can be started.
            Cancelled: if `progress` was cancelled.
        """
        crew = Crew(self, descriptor, tasks, progress, is_long)
        waiting = deque(range(len(tasks)))
        try:
            while waiting or crew.busy:
                progress.check()
                crew.hire(len(waiting))
                yield from crew.feed(waiting)
                yield from crew.collect(waiting)
                crew.tell()
        finally:
            crew.dismiss()

    def call(
        self, job: Job[Result], arguments: Sequence[Any], allowed: Allowance, progress: Progress
    ) -> Result:
        """Do one job and return its result.

        Raises:
            WorkerLostError: if it crashed or hung its child.
            WorkerError: if no child can be started.
            Cancelled: if `progress` was cancelled.
            AcusError, OSError: what the job itself ended in.
        """
        with closing(self.run([Task.of(job, arguments, allowed)], progress)) as run:
            _, outcome = next(run)
        if isinstance(outcome, Exception):
            raise outcome
        result: Result = outcome
        return result

    def lease(self, start: bool = True) -> Child | None:
        """Take a child for oneself; None if all are taken. For `Crew`.

        Args:
            start: start one if none is up and free.

        Raises:
            WorkerError: if it cannot be started.
        """
        with self._free:
            if self._leased >= self._most:
                return None
            self._leased += 1
            while self._idle:
                if (child := self._idle.pop()).alive:
                    return child
                child.close()
            if not start:
                self._leased -= 1
                return None
        try:
            return Child(self._module)
        except BaseException:
            self.give_back(None)
            raise

    def give_back(self, child: Child | None) -> None:
        """Return a child that has nothing left to do, or None for one that was lost."""
        with self._free:
            self._leased -= 1
            if child is not None:
                self._idle.append(child)
            self._free.notify_all()

    def wait(self) -> None:
        """Wait a moment for a child to become free."""
        with self._free:
            if self._leased >= self._most:
                self._free.wait(_LOOK)


_SHARED = ImagingWorker()
atexit.register(_SHARED.close)


def shared_worker() -> ImagingWorker:
    """Return the worker that all of the program shares; it starts nothing before it is used."""
    return _SHARED
