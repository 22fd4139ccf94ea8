"""Writes an attempt to disk on a thread of its own; nothing that is lost goes uncounted."""

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from app.core import state_vector as slots
from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.core.errors import AcusError
from app.core.events import Event
from app.core.transform import RigidTransform
from app.device.checkpoint import Checkpoint
from app.session import blocks, checkpoint_file, sample
from app.session.errors import RecordingError
from app.session.header import Attachment, SessionHeader
from app.session.mcap_file import McapFile
from app.session.sample import Sample

Rows = Callable[[int], FloatArray]
"""`Loop.rows`: rows of the history ring after a tick, shape (n, SLOTS)."""


class TickWriter:
    """Pulls the loop's rows and counts those that it came too late for.

    Args:
        rows: where ticks come from; None writes nothing.
        since_tick: last tick that does not belong to the record.
        start: the loop at that tick; None makes a record that cannot be replayed.

    Attributes:
        written: ticks written.
        lost: ticks overwritten in the ring before they were read.
    """

    def __init__(
        self, rows: Rows | None, since_tick: int = 0, start: Checkpoint | None = None
    ) -> None:
        self._rows = rows
        self._start = start
        self._tick = start.tick if start is not None else since_tick
        self.written = 0
        self.lost = 0

    def begin(self, file: McapFile, header: SessionHeader) -> None:
        """Write the checkpoint that the first row follows on."""
        if self._rows is not None and self._start is not None:
            message, self._start = checkpoint_file.pack(self._start), None
            file.message("/loop/checkpoint", header.nanoseconds(header.origin), message)

    def write(self, file: McapFile, header: SessionHeader) -> None:
        """Write the rows after the last one written; a gap in the tick numbers is a loss."""
        if self._rows is None:
            return
        self.begin(file, header)
        rows = self._rows(self._tick)
        rows = rows[rows[:, slots.TICK] > self._tick]
        if not len(rows):
            return
        lost = int(rows[0, slots.TICK]) - self._tick - 1
        file.message(
            "/loop/inputs",
            header.nanoseconds(float(rows[0, slots.TIME])),
            blocks.pack(rows, lost),
        )
        self._tick = int(rows[-1, slots.TICK])
        self.written += len(rows)
        self.lost += lost


DRAIN_PERIOD: Final = 0.04
"""The thread empties the queue and the ring this often [s]."""

BLOCK_PERIOD: Final = 0.1
"""A block of inputs is written this often [s]."""

FLUSH_PERIOD: Final = 0.5
"""Everything is on the disk after this long [s]."""

EAGER: Final = 2.0
"""So long after the beginning [s] every block is handed to the system at once: a program that is
killed early leaves ticks."""

_LAST_WORDS: Final = 256 * 1024
"""What follows an attachment on a full disk needs no more than this [bytes]."""

QUEUE_LENGTH: Final = 20_000
"""Samples and events that may wait for a slow disk."""


@dataclass(frozen=True, slots=True)
class RecordingStatus:
    """How the record stands.

    Attributes:
        path: the file.
        active: whether it is being written.
        failure: why it is not recorded (any more); empty if all is well.
        rows: ticks of the loop written.
        lost_rows: ticks overwritten in the ring before they were read.
        lost_samples: samples and events that a full queue or a full disk had to drop.
        full: since when the disk is full; empty if it is not. The score will be recorded.
        published: whether the file at `path` is this record.
    """

    path: Path
    active: bool
    failure: str
    rows: int
    lost_rows: int
    lost_samples: int
    full: str = ""
    published: bool = False


class Recorder:
    """The record of one attempt.

    `sample` and `event` only queue and never block or raise. With `start` a thread drains; without
    it (virtual time) whoever steps calls `drain`. After a failure of the disk everything goes on
    and `status` says why nothing is recorded.
    """

    def __init__(
        self,
        folder: Path,
        header: SessionHeader,
        rows: Rows | None = None,
        since_tick: int = 0,
        T_world_patient: RigidTransform | None = None,
        clock: Clock | None = None,
        start: Checkpoint | None = None,
    ) -> None:
        """Keep the parts; `rows`, `since_tick` and `start` are those of a `TickWriter`."""
        self.header = header
        self._file = McapFile(folder / f"{header.id}.mcap", header)
        self._ticks = TickWriter(rows, since_tick, start)
        self._T_world_patient = T_world_patient
        self._clock = clock or SystemClock()
        self._queue: deque[Sample | Event] = deque()
        self._lock = threading.Lock()
        self._writing = threading.RLock()
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._active = False
        self._failure = ""
        self._full = ""
        self._lost_samples = 0
        self._last_block = self._last_flush = -np.inf

    def open(self) -> None:
        """Create the file: when this returns, head and checkpoint are on the disk.

        Raises:
            RecordingError: if it cannot be created; nothing is recorded then.
        """
        try:
            self._file.open()
            self._ticks.begin(self._file, self.header)
            self._file.publish()
        except RecordingError as error:
            self._failure = str(error)
            raise
        self._active = True
        self._last_block = self._last_flush = self._clock.now()

    def start(self) -> None:
        """Start the thread that drains."""
        if self._active and self._thread is None:
            self._thread = threading.Thread(target=self._run, name="acus-recorder", daemon=True)
            self._thread.start()

    def sample(self, sample: Sample) -> None:
        """Queue a sample; `samples.History` thins them to 100 Hz."""
        self._put(sample)

    def event(self, event: Event) -> None:
        """Queue an event."""
        self._put(event)

    def drain(self) -> None:
        """Write what waits; on the thread, or by whoever steps virtual time."""
        with self._writing:
            if not self._active:
                return
            try:
                self._write()
            except (OSError, AcusError) as error:
                self._fail(error)

    def finish(
        self,
        attachments: tuple[Attachment, ...] = (),
        result: dict[str, str] | None = None,
        sealed: Callable[[str], object] | None = None,
    ) -> None:
        """Write the rest, the attachments and the result, and close the file; idempotent.

        Args:
            attachments: that stand at its end.
            result: what became of the attempt.
            sealed: told the SHA-256 of the whole record before its end is written; does not raise.
        """
        self._stop.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None
        with self._writing:
            if not self._active:
                return
            try:
                self._last_block = -np.inf
                self._write()
                self._write_end(attachments, result)
                self._file.close(sealed)
            except (OSError, AcusError) as error:
                self._fail(error)
            self._active = False

    def status(self) -> RecordingStatus:
        """Return how the record stands now."""
        return RecordingStatus(
            self._file.path,
            self._active,
            self._failure,
            self._ticks.written,
            self._ticks.lost,
            self._lost_samples,
            self._full,
            self._file.published,
        )

    def _run(self) -> None:
        try:
            while not self._stop.wait(DRAIN_PERIOD):
                self.drain()
        except Exception as error:  # a fault of the program: said like any other, then raised
            self._fail(error)
            raise

    def _put(self, item: Sample | Event) -> None:
        with self._lock:
            if not self._active:
                return
            if len(self._queue) >= QUEUE_LENGTH:
                self._lost_samples += 1
            else:
                self._queue.append(item)

    def _write(self) -> None:
        now = self._clock.now()
        with self._lock:
            items, self._queue = self._queue, deque()
            if self._full:  # what is left of the disk is for the end
                self._lost_samples += len(items)
                return
        for item in items:
            self._write_event(item) if isinstance(item, Event) else self._write_sample(item)
        if now - self._last_block >= BLOCK_PERIOD - 1e-9:
            self._ticks.write(self._file, self.header)
            self._last_block = now
            if now - self.header.origin < EAGER:
                self._flush(now, sync=False)
        if now - self._last_flush >= FLUSH_PERIOD - 1e-9:
            self._write_patient(now)
            self._flush(now)
            self._last_flush = now

    def _flush(self, now: float, sync: bool = True) -> None:
        self._file.flush(sync)
        if self._file.full and not self._full:
            after = now - self.header.origin
            self._full = (
                f"the disk is full since {after:.1f} s after the beginning: what followed is not "
                "recorded, the score is"
            )

    def _write_sample(self, item: Sample) -> None:
        nanoseconds = self.header.nanoseconds(item.time)
        for topic, data in sample.messages(item, sample.timestamp(nanoseconds)):
            self._file.message(topic, nanoseconds, data)

    def _write_event(self, event: Event) -> None:
        nanoseconds = self.header.nanoseconds(event.time)
        self._file.message("/events", nanoseconds, sample.log(event, sample.timestamp(nanoseconds)))

    def _write_patient(self, now: float) -> None:
        if self._T_world_patient is None:
            return
        nanoseconds = self.header.nanoseconds(now)
        data = sample.patient_transform(self._T_world_patient, sample.timestamp(nanoseconds))
        self._file.message("/tf", nanoseconds, data)

    def _write_end(
        self, attachments: tuple[Attachment, ...], result: dict[str, str] | None
    ) -> None:
        if not self._full:
            self._write_patient(self._clock.now())
        self._flush(
            self._clock.now()
        )  # the result stands behind the data that it sums up, never before
        for attachment in attachments:
            if len(attachment.data) + _LAST_WORDS < self._file.room:
                self._file.attach(attachment, self.header.nanoseconds(self._clock.now()))
        counts = {
            "rows": str(self._ticks.written),
            "lost_rows": str(self._ticks.lost),
            "lost_samples": str(self._lost_samples),
        }
        full = {"full": self._full} if self._full else {}
        self._file.metadata("result", {**(result or {}), **counts, **full})

    def _fail(self, error: Exception) -> None:
        """Stop recording and say so; the file keeps what is on the disk already."""
        text = (error.strerror if isinstance(error, OSError) else None) or str(error)
        self._failure = f"not recorded any more: {text} ({self._file.path})"
        self._active = False
        self._file.abandon()
        with self._lock:
            self._lost_samples += len(self._queue)
            self._queue.clear()
