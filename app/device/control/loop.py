"""The control loop: a table of stages at a fixed rate, in a thread of its own."""

from __future__ import annotations

import atexit
import sys
import threading
import time
from collections.abc import Callable, Iterable, Mapping
from enum import StrEnum
from typing import Any

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock, VirtualClock
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.checkpoint import Checkpoint
from app.device.control import kernel
from app.device.control.checkpoints import CheckpointRequests
from app.device.control.kernel import EXCHANGE, MISSED, RUNNING, STOP, ArrayList, StageList
from app.device.control.shared import Inbox, TickHistory
from app.device.control.table import Table
from app.device.control.timing import TickWatch, Timing, measure
from app.device.errors import LoopError
from app.device.lifetime import Lifetime
from app.device.links.link import DeviceLink
from app.device.state import DeviceState

THREAD_RATE_HZ = 250.0
"""Highest rate that the plain thread promises, where the compiled loop does not exist."""


class Host(StrEnum):
    """What runs the ticks.

    `COMPILED`: a compiled kernel with absolute deadlines, without the interpreter lock (Linux).
    `THREAD`: a plain thread, at most `THREAD_RATE_HZ`. `STEPPED`: `Loop.step` on a virtual clock.
    """

    COMPILED = "compiled"
    THREAD = "thread"
    STEPPED = "stepped"


class Priority(StrEnum):
    """Priority of the compiled loop's thread. `REALTIME` is done without where it is refused."""

    REALTIME = "realtime"
    NORMAL = "normal"


def default_host(clock: Clock) -> Host:
    """Host for a clock on this platform."""
    if isinstance(clock, VirtualClock):
        return Host.STEPPED
    return Host.COMPILED if sys.platform == "linux" else Host.THREAD


_STOP_TIMEOUT = 5.0
_EXCHANGE_TIMEOUT = 1.0
_POLL = 0.02


class _Exchange:
    """Another table for a running loop: packed by who asks, taken by the loop between two ticks."""

    def __init__(self, table: Table, carry: Callable[[], None]) -> None:
        self.table, self.carry = table, carry
        self.packed, self.packed_write = _pack(table), _pack(table.write)
        self.taken = threading.Event()
        self.first_tick = 0
        self.error: BaseException | None = None


class Loop(Lifetime):
    """Runs a table of stages at a fixed rate.

    No force leaves before `inbox.write(enabled=1, heartbeat=...)`, and leaving for any reason
    (stop, exception in a `with` block, end of the program) sends zero torque once more.

    Args:
        stages: the table, or (name, function, parameters) triples without a write side.
        rate_hz: ticks per second.
        clock: the machine's clock, or a virtual one for `step`.
        host: what runs the ticks; by default chosen for the clock and the platform.
        initial: starting values of the state by slot name, e.g. of `PLANT_*`.
        priority: what to ask the operating system for.
        link: the robot whose stages are in the table; opened before the first tick, closed when the
            zero torque has gone out. None: the table needs no opening.
    """

    def __init__(
        self,
        stages: Table | Iterable[Stage],
        rate_hz: float = 1000.0,
        clock: Clock | None = None,
        host: Host | None = None,
        initial: Mapping[str, float] | None = None,
        priority: Priority = Priority.REALTIME,
        link: DeviceLink | None = None,
    ) -> None:
        self.table = stages if isinstance(stages, Table) else Table.of(stages)
        self.clock: Clock = clock or SystemClock()
        self.host = host or default_host(self.clock)
        self.rate_hz = min(rate_hz, THREAD_RATE_HZ) if self.host is Host.THREAD else rate_hz
        self.priority = priority
        self.link = link
        self.inbox = Inbox()
        self._history = TickHistory()
        self._state = sv.empty_state()
        self._scratch = sv.empty_state()
        self._requests = CheckpointRequests(self._history.counters, self.table)
        self._watch = TickWatch(self._history.counters, self.table)
        for name, value in (initial or {}).items():
            self._state[_slot(name)] = value
        self._thread: threading.Thread | None = None
        self._is_open = False
        self._realtime = False
        self._failure: BaseException | None = None
        self._exchange: _Exchange | None = None
        self._asking = threading.Lock()

    @property
    def is_open(self) -> bool:
        """Return whether `open` has been called and `close` has not."""
        return self._is_open

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the stages in the order of the tick."""
        return tuple(stage.name for stage in self.table)

    def open(self) -> None:
        """Connect to the robot and start ticking, disarmed. Does nothing if the loop is open.

        Raises:
            LinkError: if the robot cannot be reached; the loop stays closed.
            LoopError: if a tick of this loop never returned; its thread is still there.
        """
        if self._is_open:
            return
        if self._thread is not None:
            raise LoopError(self._watch.reason)
        if self.link is not None:
            self.link.open()
        self._failure = None
        self._history.counters[[STOP, EXCHANGE, RUNNING]] = 0
        self.inbox.write(enabled=0.0)
        self._packed = _pack(self.table)
        self._packed_write = _pack(self.table.write)
        self._requests = CheckpointRequests(self._history.counters, self.table)
        self._watch = TickWatch(self._history.counters, self.table)
        self._is_open = True
        atexit.register(self.close)
        if self.host is not Host.STEPPED:
            self._thread = threading.Thread(target=self._host, name="acus loop", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Stop ticking and send zero torque. Does nothing if the loop is closed.

        A thread whose tick does not return is left alone: `latest` has said so, the board's
        watchdog has ended the torque, and nothing else can be done about compiled code.

        Raises:
            LoopError: if the thread does not end and nobody knows why.
        """
        if not self._is_open:
            return
        self._is_open = False
        atexit.unregister(self.close)
        self._history.counters[STOP] = 1
        self.inbox.write(enabled=0.0)
        if self._thread is None:
            self._release()
            return
        end = time.monotonic() + _STOP_TIMEOUT
        while self._thread.is_alive() and time.monotonic() < end:
            if self._watch.check(self._thread):
                return
            self._thread.join(_POLL)
        if self._thread.is_alive():
            raise LoopError(
                sentence(
                    "the loop did not stop in {stop_timeout:g} s: a stage does not return",
                    stop_timeout=_STOP_TIMEOUT,
                )
            )
        self._thread = None

    def latest(self) -> DeviceState:
        """Return the newest tick; zeros with tick 0 before the first.

        Raises:
            LoopError: if the loop has ended with an error, or its tick does not return; then it
                names the stage.
        """
        self._raise_failure()
        return DeviceState.from_row(self._history.last())

    def rows(self, since_tick: int = 0) -> FloatArray:
        """Return the ticks after `since_tick` that the history still holds, (n, SLOTS).

        The history holds the last 16 383 ticks; a gap shows in the slot `TICK` of the first row.
        """
        return self._history.rows(since_tick)

    def checkpoint(self) -> Checkpoint:
        """Return all that the next tick depends on besides its inputs, between two ticks.

        The loop copies it at the end of a tick and never waits; the caller does, for about a tick.

        Raises:
            LoopError: if the loop is closed, or does not answer within a second.
        """
        if not self._is_open:
            raise LoopError(sentence("the loop is closed; call open() before checkpoint()"))
        with self._asking:
            idle = (self._state, self._packed[1]) if self._thread is None else None
            return self._requests.checkpoint(idle)

    def timing(self, count: int = 10_000) -> Timing:
        """Lateness over the last `count` ticks."""
        return measure(self._history, self.rate_hz, str(self.host), self._realtime, count)

    def step(self, ticks: int = 1) -> None:
        """Run the same ticks on the virtual clock, which advances by one period each.

        Raises:
            LoopError: if the loop is closed, or its clock is not virtual.
        """
        if not isinstance(self.clock, VirtualClock):
            raise LoopError(
                sentence("step needs a loop on a VirtualClock; this one runs by itself")
            )
        if not self._is_open:
            raise LoopError(sentence("the loop is closed; call open() before step()"))
        self._tick(self.clock.now(), ticks)
        self.clock.sleep(ticks / self.rate_hz)

    def swap(self, stages: Table | Iterable[Stage]) -> None:
        """Replace the table of a closed loop; the state stays.

        Raises:
            LoopError: if the loop is open.
        """
        if self._is_open:
            raise LoopError(
                sentence("the table can be swapped only while the loop is closed; close it first")
            )
        self.table = stages if isinstance(stages, Table) else Table.of(stages)

    def exchange(self, table: Table, carry: Callable[[], None] = lambda: None) -> int:
        """Replace the table of an open loop between two ticks; state, inputs and forces go on.

        Arrays that both tables have keep their memory (`Table.continued`). The loop waits for the
        interpreter and for `carry`, some milliseconds; what it misses meanwhile is counted.

        Args:
            table: the new one.
            carry: moves memory from stages that end to those that begin; run between the two
                ticks. If it raises, the loop goes on with the table that it has.

        Returns:
            Number of the first tick of the new table.

        Raises:
            LoopError: if the loop is closed, ends meanwhile, or does not answer within a second.
        """
        if not self._is_open:
            raise LoopError(
                sentence("the loop is closed; a table is exchanged while it runs, see swap()")
            )
        wanted = _Exchange(table, carry)
        with self._asking:
            if self._thread is None:
                self._take(wanted)
            else:
                self._exchange = wanted
                self._history.counters[EXCHANGE] = 1
                self._await(wanted, self._thread)
        if wanted.error is not None:
            raise wanted.error
        return wanted.first_tick

    def _await(self, wanted: _Exchange, thread: threading.Thread) -> None:
        end = time.monotonic() + _EXCHANGE_TIMEOUT
        while not wanted.taken.wait(_POLL):
            if time.monotonic() > end or not thread.is_alive():
                self._history.counters[EXCHANGE] = 0
                self._raise_failure()
                raise LoopError(
                    sentence("the loop does not tick: the way it computes stays as it was")
                )

    def _take(self, wanted: _Exchange) -> None:
        """Go on with another table; called by the loop's host, or while nobody runs it."""
        history = self._history
        try:
            wanted.carry()
        except Exception as error:  # told to who asked; the ticks go on as they were
            wanted.error = error
        else:
            self.table = wanted.table
            self._packed, self._packed_write = wanted.packed, wanted.packed_write
            self._requests = CheckpointRequests(history.counters, self.table)
            self._watch = TickWatch(history.counters, self.table)
            wanted.first_tick = history.head + 1
        self._exchange = None
        history.counters[EXCHANGE] = 0
        wanted.taken.set()

    def _host(self) -> None:
        try:
            if self.host is Host.COMPILED:
                self._run_compiled()
            else:
                self._run_thread()
        except BaseException as error:  # handed on by latest(); the torques go to zero first
            self._failure = error
        finally:
            self._release()

    def _run_compiled(self) -> None:
        from app.device.control import realtime  # exists on Linux only

        realtime.ask_for_precise_timers()
        if self.priority is Priority.REALTIME:
            self._realtime = realtime.ask_for_realtime_priority()
        deadline = 0
        while not self._history.counters[STOP]:
            deadline = realtime.run(*self._arguments(), round(1e9 / self.rate_hz), deadline)
            if self._exchange is not None:
                self._take(self._exchange)

    def _run_thread(self) -> None:
        period, counters = 1.0 / self.rate_hz, self._history.counters
        deadline = self.clock.now() + period
        while not counters[STOP]:
            self.clock.sleep(deadline - self.clock.now())
            now = self.clock.now()
            skipped = max(int((now - deadline) / period), 0)
            counters[MISSED] += skipped
            self._state[sv.LATENESS] = max(now - deadline, 0.0)
            self._tick(now - period, 1)
            deadline += (1 + skipped) * period
            if self._exchange is not None:
                self._take(self._exchange)

    def _tick(self, time: float, ticks: int) -> None:
        kernel.step(*self._arguments(), time, 1.0 / self.rate_hz, ticks)

    def _arguments(self) -> tuple[Any, ...]:
        inbox, history = self.inbox, self._history
        shared = (inbox.values, self._scratch, inbox.sequence, history.ring, history.counters)
        return (self._state, *self._packed, *shared, self._requests.buffer)

    def _release(self) -> None:
        history = self._history
        try:
            kernel.release(
                self._state, *self._packed_write, history.ring, history.counters, self.clock.now()
            )
        finally:
            if self.link is not None:
                self.link.close()

    def _raise_failure(self) -> None:
        if (
            self._is_open
            and self._thread is not None
            and (endless := self._watch.check(self._thread))
        ):
            raise LoopError(endless)
        if self._failure is not None:
            why = self._watch.ended(self._failure)
            raise LoopError(sentence("the loop has ended: {reason}", reason=why)) from self._failure


def _pack(stages: Iterable[Stage]) -> tuple[StageList, ArrayList]:
    functions, parameters = kernel.no_stages(), kernel.no_parameters()
    for _, function, values in stages:
        kernel.append(functions, parameters, function, values)
    return functions, parameters


def _slot(name: str) -> int:
    if name not in sv.INDEX:
        raise LoopError(
            sentence(
                "the state has no slot {name!r}; valid names: {sv_index}",
                name=name,
                sv_index=", ".join(sv.INDEX),
            )
        )
    return sv.INDEX[name]
