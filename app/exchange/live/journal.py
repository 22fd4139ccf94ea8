"""What a link has to say: one line for each thing, kept for the technician, bounded.

A flood of the same thing is one line with a count.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from dataclasses import dataclass
from enum import StrEnum

KEPT = 50
"""Lines that are kept."""

QUIET = 5.0
"""The same thing is said again after so long [s] at the earliest."""


class LinkHealth(StrEnum):
    """How a link is."""

    WAITING = "waiting"
    CONNECTED = "connected"
    TROUBLED = "troubled"


@dataclass(frozen=True, slots=True)
class LinkReport:
    """A link as the technician sees it.

    Attributes:
        title: what it is.
        address: where it listens, or to whom it speaks.
        peers: how many are connected.
        rate: messages a second, both ways.
        health: how it is.
        line: what was said last; empty for nothing.
    """

    title: str
    address: str
    peers: int
    rate: float
    health: LinkHealth
    line: str


class LinkJournal:
    """Takes lines from any thread; `say` never waits."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._lines: deque[str] = deque(maxlen=KEPT)
        self._spoken: dict[str, tuple[float, int]] = {}

    def say(self, line: str, about: str = "") -> None:
        """Keep a line.

        Args:
            line: one line for people.
            about: what it is about, without numbers of this once; lines about the same are one
                within `QUIET`.
        """
        key, now = about or line, time.monotonic()
        with self._lock:
            since, left_out = self._spoken.get(key, (-QUIET, 0))
            if now - since < QUIET:
                self._spoken[key] = since, left_out + 1
                return
            if len(self._spoken) > KEPT:
                self._spoken.clear()
            self._spoken[key] = now, 0
            more = f" (and {left_out} times more)" if left_out else ""
            self._lines.append(f"{line}{more}"[:400])

    @property
    def lines(self) -> tuple[str, ...]:
        """Everything that is kept, oldest first."""
        with self._lock:
            return tuple(self._lines)

    @property
    def last(self) -> str:
        """The newest line; empty for none."""
        lines = self.lines
        return lines[-1] if lines else ""
