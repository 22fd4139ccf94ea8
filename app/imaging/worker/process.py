"""One child process, seen from the program: tasks out, answers in, and a watchdog."""

import contextlib
import signal
import subprocess
import time
from collections import deque
from collections.abc import Iterator, Sequence
from typing import Any

from app.core.messages import sentence
from app.imaging.worker.answers import DONE, PROGRESS, outcome
from app.imaging.worker.channel import VOLUME, ChannelError, WorkerChannel
from app.imaging.worker.jobs import Task
from app.imaging.worker.lent_memory import LentMemory
from app.imaging.worker.limits import processor_seconds
from app.imaging.worker.starting import started
from app.imaging.worker.values import reader

ENTRY = "app.imaging.worker"
"""Module that a child runs."""

READY_SECONDS = 60.0
"""A child that is not ready by then is given up [s]; a machine may be slow."""

_GRACE = 0.2
"""Nobody is looked at more closely before that [s]."""

_WHY = {
    "SIGABRT": sentence(": it gave itself up, out of memory or in a state that cannot be"),
    "SIGSEGV": sentence(": it crashed"),
    "SIGBUS": sentence(": it crashed"),
    "SIGFPE": sentence(": it crashed"),
    "SIGILL": sentence(": it crashed"),
    "SIGKILL": sentence(": by the system when memory ran out, or by somebody"),
    "SIGXCPU": sentence(": it computed for longer than any file may"),
}
"""What a signal says of whoever it ended."""


class Lost(Exception):  # noqa: N818  (an event; who waits turns it into an error)
    """The child crashed, hung or talks nonsense; the text says which."""


class Child:
    """A running child. Tasks are answered in their order; the first one open is worked on.

    Args:
        module: what it runs; it is told where its end of the connection is.

    Attributes:
        open: number of each task that is not answered yet, oldest first.
        ready: whether it has come up.
        progress: how far the task is that it is at, and in what words; 0 and none if it is silent.

    Raises:
        WorkerError: if it cannot be started.
    """

    def __init__(self, module: str = ENTRY) -> None:
        self.open: deque[int] = deque()
        self._tasks: deque[tuple[Task, LentMemory | None]] = deque()
        self._process, end = started(module)
        self._channel = WorkerChannel(end)
        self.ready, self.progress = False, (0.0, "")
        self._used: float | None = None
        self._mark()

    @property
    def alive(self) -> bool:
        """Return whether the process runs."""
        return self._process.poll() is None

    def fileno(self) -> int:
        """File descriptor, for `select`: readable when an answer has come."""
        return self._channel.fileno()

    def send(self, task: Task, number: int) -> None:
        """Give it a task; its number joins `open`.

        Raises:
            Lost: if it is gone.
            OSError: if there is no memory for the arrays of the task.
        """
        memory = task.attachments.memory() if task.attachments else None
        if not self.open:
            self._mark()
        self.open.append(number)
        self._tasks.append((task, memory))
        self._send(task.message, memory)
        reader(task.job.gives)  # made while the child comes up: 20 ms, once for each type

    def give(self, memory: LentMemory) -> None:
        """Give it the memory that slices are written to.

        Raises:
            Lost: if it is gone.
        """
        self._send([VOLUME], memory)

    def _send(self, task: Sequence[Any], memory: LentMemory | None = None) -> None:
        try:
            self._channel.send(task, memory)
        except OSError:
            raise Lost(self._end_of_it()) from None

    def listen(self) -> None:
        """Take in what it says, after `select` said that there is something.

        Raises:
            Lost: if it is gone.
        """
        try:
            if not self._channel.fill():
                raise Lost(self._end_of_it())
        except OSError:  # reset: it left without reading what it was sent
            raise Lost(self._end_of_it()) from None

    def answers(self) -> Iterator[tuple[int, Any]]:
        """Yield number and outcome of tasks, of what was taken in.

        Raises:
            Lost: if what it says is no answer.
        """
        try:
            while (message := self._channel.take()) is not None:
                self._mark()
                if not self.ready:
                    self.ready = True
                elif self.open and _is_progress(message):
                    self.progress = message[1], message[2]
                elif self.open and _is_answer(message):
                    yield self._answered(message)
                else:
                    raise ChannelError(sentence("no answer"))
        except ChannelError as error:
            raise Lost(sentence("talked nonsense ({error})", error=error)) from None

    def _answered(self, message: list[Any]) -> tuple[int, Any]:
        has_arrays = message[0] == DONE and message[-1] is True
        memory = self._channel.take_memory() if has_arrays else None
        self.progress = 0.0, ""
        task, lent = self._tasks.popleft()
        if lent is not None:
            lent.close()
        return self.open.popleft(), outcome(task.job.gives, message, memory)

    def check(self) -> None:
        """Look whether it still gets on with its task.

        Raises:
            Lost: if it has worked or waited too long on one file.
        """
        waited = time.monotonic() - self._since
        computed = self._computed()
        if waited < _GRACE:
            return
        if not self.ready:
            if waited > READY_SECONDS:
                raise Lost(
                    sentence(
                        "was not ready within {ready_seconds:.0f} s", ready_seconds=READY_SECONDS
                    )
                )
            self._mark(self._since)
        elif self.open:
            allowed = self._tasks[0][0].allowed
            if computed > allowed.seconds:
                raise Lost(
                    sentence(
                        "took longer than {allowed_seconds:.1f} s of computing",
                        allowed_seconds=allowed.seconds,
                    )
                )
            if waited > allowed.clock_seconds:
                raise Lost(
                    sentence(
                        "waited longer than {allowed_clock_seconds:.0f} s for it",
                        allowed_clock_seconds=allowed.clock_seconds,
                    )
                )

    def close(self) -> None:
        """End it at once; idempotent."""
        self._channel.close()
        for _, lent in self._tasks:
            if lent is not None:
                lent.close()
        if self._process.poll() is None:
            self._process.kill()
        with contextlib.suppress(subprocess.TimeoutExpired):  # a disk that stalls keeps it
            self._process.wait(1.0)

    def _computed(self) -> float:
        """Processor time since the first look after the last sign of it."""
        now = processor_seconds(self._process.pid)
        if self._used is None:
            self._used = now
        return now - self._used

    def _mark(self, since: float | None = None) -> None:
        self._since = time.monotonic() if since is None else since
        self._used = None  # asking the system at every answer takes its time

    def _end_of_it(self) -> str:
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(1.0)
        code = self._process.returncode
        if code is None:
            return sentence("closed its connection")
        if code >= 0:
            return sentence("ended with code {code}", code=code)
        try:
            name = signal.Signals(-code).name
        except ValueError:
            name = f"signal {-code}"
        why = _WHY.get(name, "")
        return sentence("was ended by {name}{reason}", name=name, reason=why)


def _is_progress(message: Any) -> bool:
    """Return whether a message tells how far a task is: a fraction and a few words."""
    if not isinstance(message, list) or [type(part) for part in message] != [str, float, str]:
        return False
    return bool(message[0] == PROGRESS and 0.0 <= message[1] <= 1.0)


def _is_answer(message: Any) -> bool:
    return isinstance(message, list) and bool(message) and isinstance(message[0], str)
