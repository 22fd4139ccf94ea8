"""The program's side of the worker: warm children, tasks spread over them, lost ones replaced."""

import atexit
import os
import select
import threading
import time
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from app.core.progress import Progress
from app.imaging.errors import WorkerError
from app.imaging.worker.process import ENTRY, Child, Lost

MOST_CHILDREN = 2
_AHEAD = 8
"""Tasks that a child has before it, so that it need not wait for the program."""

_WORTH_STARTING = 1.0
"""Seconds of work left for which a second child is started; one that is up helps at once."""

_LOOK = 0.1
"""How often [s] the watchdog looks, and the user may cancel."""

Answer = list[Any]


@dataclass(frozen=True, slots=True)
class Task:
    """Something for a child to do.

    Attributes:
        message: see `child.Tasks`.
        seconds: processor time that it may take.
    """

    message: list[Any]
    seconds: float


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
        self, tasks: Sequence[Task], progress: Progress, descriptor: int | None = None
    ) -> Generator[tuple[int, Answer], None, None]:
        """Do tasks, in any order. Close what is returned: an error leaves children at work.

        Args:
            tasks: what to do.
            progress: cancels; it is not told how far the work is.
            descriptor: memory that slices are written to.

        Yields:
            The task's number and its answer; for one that crashed or hung the child, that is
            `["lost", what happened]`. A child that was lost is replaced.

        Raises:
            WorkerError: if no child can be started.
            Cancelled: if `progress` was cancelled.
        """
        crew = _Crew(self, descriptor)
        waiting = deque(range(len(tasks)))
        try:
            while waiting or crew.busy:
                progress.check()
                crew.hire(len(waiting), progress)
                yield from crew.feed(tasks, waiting)
                yield from crew.collect(waiting)
        finally:
            crew.dismiss()

    def lease(self, start: bool = True) -> Child | None:
        """Take a child for oneself; None if all are taken. For `_Crew`.

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


class _Crew:
    """The children that work for one call of `run`."""

    def __init__(self, worker: ImagingWorker, descriptor: int | None) -> None:
        self._worker, self._descriptor = worker, descriptor
        self._children: list[Child] = []
        self._first, self._answered = 0.0, 0

    @property
    def busy(self) -> bool:
        return any(child.open for child in self._children)

    def hire(self, waiting: int, progress: Progress) -> None:
        """Take a child, and a second one where that pays."""
        if len(self._children) == 1 and waiting > _AHEAD:
            self._take(self._seconds_left(waiting) > _WORTH_STARTING)
        while not self._children:
            if not self._take(True):
                progress.check()
                self._worker.wait()

    def _take(self, start: bool) -> bool:
        child = self._worker.lease(start)
        if child is None:
            return False
        self._children.append(child)
        self._prepare(child)
        return True

    def _seconds_left(self, waiting: int) -> float:
        """Work that is left, at the pace so far; nothing is known before the first answers."""
        if not self._answered:
            return 0.0
        return (time.monotonic() - self._first) / self._answered * waiting

    def _prepare(self, child: Child) -> None:
        try:
            if self._descriptor is not None:
                child.give(self._descriptor)
        except Lost as lost:
            raise WorkerError(f"the process that reads foreign files {lost}") from lost

    def feed(self, tasks: Sequence[Task], waiting: "deque[int]") -> Iterator[tuple[int, Answer]]:
        for child in tuple(self._children):
            try:
                while waiting and len(child.open) < _AHEAD:
                    number = waiting.popleft()
                    child.send(tasks[number].message, number, tasks[number].seconds)
            except Lost as lost:
                yield from self._replace(child, lost, waiting)

    def collect(self, waiting: "deque[int]") -> Iterator[tuple[int, Answer]]:
        working = [child for child in self._children if child.open]
        ready = select.select(working, [], [], _LOOK)[0]
        for child in working:
            try:
                if child in ready:
                    child.listen()
                    yield from self._counted(child.answers())
                else:
                    child.check()
            except Lost as lost:
                yield from self._replace(child, lost, waiting)

    def _counted(self, answers: Iterator[tuple[int, Answer]]) -> Iterator[tuple[int, Answer]]:
        for found in answers:
            self._first = self._first or time.monotonic()
            self._answered += 1
            yield found

    def _replace(
        self, child: Child, lost: Lost, waiting: "deque[int]"
    ) -> Iterator[tuple[int, Answer]]:
        """Answer for the task that the child was lost on; the others wait for the next child."""
        self._children.remove(child)
        child.close()
        self._worker.give_back(None)
        if not child.ready:
            raise WorkerError(
                f"the process that reads foreign files {lost} before it was ready; its memory "
                "or its installation may fail: see `acus check`, or install the program again"
            )
        if child.open:
            first, *others = child.open
            waiting.extendleft(reversed(others))
            yield first, ["lost", str(lost)]

    def dismiss(self) -> None:
        """Give the children back; what they are in the middle of is for nobody any more."""
        for child in self._children:
            if _finished(child):
                self._worker.give_back(child)
            else:
                child.close()
                self._worker.give_back(None)
        self._children = []


def _finished(child: Child) -> bool:
    """Whether a child is done with its open tasks within a moment."""
    deadline = time.monotonic() + _LOOK
    try:
        deque(child.answers(), maxlen=0)  # what has come already is for nobody either
        while child.open and (left := deadline - time.monotonic()) > 0.0:
            if select.select([child], [], [], left)[0]:
                child.listen()
                deque(child.answers(), maxlen=0)
    except Lost:
        return False
    return not child.open


_SHARED = ImagingWorker()
atexit.register(_SHARED.close)


def shared_worker() -> ImagingWorker:
    """Return the worker that all of the program shares; it starts nothing before it is used."""
    return _SHARED
