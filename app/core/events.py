"""Events are a queue: each is seen once by whoever drains it, none is lost silently."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened at a moment.

    Attributes:
        time: monotonic time [s].
        kind: what happened, e.g. `state`, `scan`, `fault`, `plan`.
        message: one line for people.
        data: numbers and names that belong to it, JSON-ready.
    """

    time: float
    kind: str
    message: str
    data: Mapping[str, object] = field(default_factory=dict)


class EventQueue:
    """Bounded first-in first-out queue; when full, the oldest goes and the loss is counted."""

    def __init__(self, capacity: int = 1024) -> None:
        self._events: deque[Event] = deque(maxlen=capacity)
        self._lock = threading.Lock()
        self._followers: tuple[EventQueue, ...] = ()
        self.lost = 0

    def follow(self, capacity: int = 256) -> EventQueue:
        """Return a queue of its own that gets every event from now on."""
        follower = EventQueue(capacity)
        with self._lock:
            self._followers += (follower,)
        return follower

    def put(self, event: Event) -> None:
        """Append an event; never blocks."""
        with self._lock:
            self.lost += len(self._events) == self._events.maxlen
            self._events.append(event)
        for follower in self._followers:
            follower.put(event)

    def drain(self) -> list[Event]:
        """Take all waiting events, oldest first."""
        with self._lock:
            events = list(self._events)
            self._events.clear()
            return events
