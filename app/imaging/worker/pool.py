"""The program's side of the worker: warm children, who may use them, and what they do for a call.

The children of one call are fed, listened to, watched, replaced and given back.
"""

import atexit
import os
import select
import threading
import time
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from contextlib import closing
from typing import Any

from app.core.messages import sentence, sentence_of
from app.core.progress import Progress
from app.imaging.errors import WorkerError
from app.imaging.worker.answers import lost as lost_error
from app.imaging.worker.channel import MOST_OPEN
from app.imaging.worker.jobs import Job, Result, Task
from app.imaging.worker.lent_memory import LentMemory
from app.imaging.worker.limits import Allowance
from app.imaging.worker.process import ENTRY, Child, Lost

_WORTH_STARTING = 0.6
"""Seconds of work left for which a second child is started; one that is up helps at once."""

_CHECK_S = 0.1
"""How often [s] the watchdog looks, and the user may cancel."""

_TELL_AFTER = 1.0
"""Seconds without an answer after which somebody who waits is told that it goes on."""

Found = tuple[int, Any]


class CallChildren:
    """The children that work for one call of `ImagingWorker.run`.

    Args:
        lender: where they come from.
        memory: that slices are written to.
        tasks: all that is to be done.
        progress: of whoever asked.
        is_long: whether a second child is worth starting at once.
    """

    def __init__(
        self,
        lender: "ImagingWorker",
        memory: LentMemory | None,
        tasks: Sequence[Task],
        progress: Progress,
        is_long: bool = False,
    ) -> None:
        self._is_long = is_long
        self._lender, self._memory = lender, memory
        self._tasks, self._progress = tasks, progress
        self._children: list[Child] = []
        self._first, self._answered = 0.0, 0
        self._heard, self._told = time.monotonic(), (0.0, "")

    @property
    def busy(self) -> bool:
        """Return whether a task is with a child."""
        return any(child.open for child in self._children)

    def take(self, waiting: int) -> None:
        """Take a child, and a second one where that pays."""
        if len(self._children) == 1 and waiting > MOST_OPEN:
            self._take(self._is_long or self._seconds_left(waiting) > _WORTH_STARTING)
        while not self._children:
            if not self._take(True):
                self._lender.wait()
                self._tell_quiet("waiting until other files are read: {:.0f} s")

    def tell(self) -> None:
        """Tell how far the only task is, or that one takes long."""
        told = next((child.progress for child in self._children if child.progress[1]), None)
        count = len(self._tasks)
        if told and told != self._told:
            self._told = told
            self._progress.report((self._answered + told[0]) / count, told[1])
        elif not told:
            number = min(self._answered + 1, count)
            self._tell_quiet(f"{number} of {count}: {{:.0f}} s so far")

    def _tell_quiet(self, text: str) -> None:
        """Tell somebody who has heard nothing for a second how long that has been."""
        self._progress.check()
        if (quiet := time.monotonic() - self._heard) > _TELL_AFTER:
            self._progress.report(self._answered / len(self._tasks), text.format(quiet))

    def _take(self, start: bool) -> bool:
        child = self._lender.lease(start)
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
            if self._memory is not None:
                child.give(self._memory)
        except Lost as lost:
            raise WorkerError(
                sentence("the process that reads foreign files {lost}", lost=lost)
            ) from lost

    def feed(self, waiting: "deque[int]") -> Iterator[Found]:
        """Give each child something to do."""
        for child in tuple(self._children):
            try:
                while waiting and len(child.open) < MOST_OPEN:
                    number = waiting.popleft()
                    child.send(self._tasks[number], number)
            except Lost as lost:
                yield from self._replace(child, lost, waiting)

    def collect(self, waiting: "deque[int]") -> Iterator[Found]:
        """Wait a moment for answers, and look after those that give none."""
        working = [child for child in self._children if child.open]
        ready = select.select(working, [], [], _CHECK_S)[0]
        for child in working:
            try:
                if child in ready:
                    child.listen()
                    yield from self._counted(child.answers())
                else:
                    child.check()
            except Lost as lost:
                yield from self._replace(child, lost, waiting)

    def _counted(self, answers: Iterator[Found]) -> Iterator[Found]:
        for found in answers:
            self._heard = time.monotonic()
            self._first = self._first or self._heard
            self._answered += 1
            yield found

    def _replace(self, child: Child, lost: Lost, waiting: "deque[int]") -> Iterator[Found]:
        """Answer for the task that the child was lost on; the others wait for the next child."""
        self._children.remove(child)
        child.close()
        self._lender.give_back(None)
        if not child.ready:
            raise WorkerError(
                sentence(
                    "the process that reads foreign files {lost} before it was ready; its memory "
                    "or its installation may fail: see `acus check`, or install the program again",
                    lost=lost,
                )
            )
        if child.open:
            first, *others = child.open
            waiting.extendleft(reversed(others))
            yield from self._counted(iter([(first, lost_error(sentence_of(lost)))]))

    def release(self) -> None:
        """Give the children back; what they are in the middle of is for nobody any more."""
        for child in self._children:
            if _finished(child):
                self._lender.give_back(child)
            else:
                child.close()
                self._lender.give_back(None)
        self._children = []


def _finished(child: Child) -> bool:
    """Return whether a child is done with its open tasks within a moment."""
    deadline = time.monotonic() + _CHECK_S
    try:
        deque(child.answers(), maxlen=0)  # what has come already is for nobody either
        while child.open and (left := deadline - time.monotonic()) > 0.0:
            if select.select([child], [], [], left)[0]:
                child.listen()
                deque(child.answers(), maxlen=0)
    except Lost:
        return False
    return not child.open


MOST_CHILDREN = 2
_WAIT_S = 0.1
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

    def warm(self, count: int = 1) -> None:
        """Start children now, so that the first folder need not wait for them; at once back.

        Args:
            count: how many shall be up, at most as many as may work at once.

        Raises:
            WorkerError: if it cannot be started.
        """
        with self._free:
            while len(self._idle) + self._leased < min(count, self._most):
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
        memory: LentMemory | None = None,
        is_long: bool = False,
    ) -> Generator[tuple[int, Any], None, None]:
        """Do tasks, in any order. Close what is returned: an error leaves children at work.

        Args:
            tasks: what to do.
            progress: cancels within a tenth of a second, and is told of tasks that tell how far
                they are or take over a second; who asked tells it of each that is done.
            memory: that slices are written to.
            is_long: whether a second child is worth starting at once, and not only when the first
                answers say so.

        Yields:
            The task's number and its outcome: the result of its job, or an error, made and not
            raised: `WorkerLostError` for one that crashed or hung its child, which is replaced.

        Raises:
            WorkerError: if no child can be started.
            Cancelled: if `progress` was cancelled.
        """
        children = CallChildren(self, memory, tasks, progress, is_long)
        waiting = deque(range(len(tasks)))
        try:
            while waiting or children.busy:
                progress.check()
                children.take(len(waiting))
                yield from children.feed(waiting)
                yield from children.collect(waiting)
                children.tell()
        finally:
            children.release()

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
        """Take a child for oneself; None if all are taken. For `CallChildren`.

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
                self._free.wait(_WAIT_S)


_SHARED = ImagingWorker()
atexit.register(_SHARED.close)


def shared_worker() -> ImagingWorker:
    """Return the worker that all of the program shares; it starts nothing before it is used."""
    return _SHARED
