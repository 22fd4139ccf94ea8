"""What waits goes to the store in batches, and leaves the queue once the store has said so.

| the store says to a batch | then |
|---|---|
| 200 and ids | these are delivered, the others as after 409; none by another body |
| 409, it has one of them | each is asked for: delivered if it is alike there, else posted |
| 400, it refuses one of them; 413, too much | halves, down to the one that it refuses |
| anything else, or nothing | all stays as it is |

One that is refused stays in the queue and is named; the others go on.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any, Final

from app.core.messages import sentence
from app.core.progress import Progress
from app.exchange.lrs.client import Lrs, Reply
from app.exchange.lrs.errors import UnreachableLrsError
from app.exchange.lrs.place import LrsPlace
from app.exchange.results import Results
from app.exchange.xapi import statements, voiding_statements
from app.session.audit import note
from app.session.statement_queue import QueuedStatement, StatementQueue

_FREE: Final = frozenset({"display", "definition", "objectType", "contextActivities"})
"""Parts of a statement that a store may change or that may differ (xAPI-Data 2.3.1)."""


@dataclass(frozen=True, slots=True)
class Delivered:
    """What came of a sending.

    Attributes:
        sent: statements that left the queue.
        waiting: those that are still in it.
        refused: why each that the store refuses stays.
    """

    sent: int
    waiting: int
    refused: tuple[str, ...]


def tell_attempts(
    results: Results,
    place: LrsPlace,
    queue: StatementQueue,
    course: str = "",
    progress: Progress | None = None,
) -> int:
    """Put what is new of these attempts into the queue; return how many that were.

    Raises:
        SessionError: if the queue cannot be read or written.
        Cancelled: if that was asked for.
    """
    told = statements(results, place.home, course, progress)
    return queue.take_back(voiding_statements(results, place.home)) + queue.put(told)


def deliver(
    place: LrsPlace,
    queue: StatementQueue,
    progress: Progress | None = None,
    by: str = "",
) -> Delivered:
    """Send what waits.

    Args:
        place: of the store.
        queue: that is emptied.
        progress: reports, and may cancel between two batches.
        by: who is told to do so in the audit trail; whoever acts without.

    Raises:
        LrsError: if the store does not answer or lets nobody in; what it has said before that has
            left the queue.
        SessionError: if the queue cannot be read or written.
        Cancelled: if that was asked for.
    """
    waiting, progress = queue.waiting(), progress or Progress()
    sending = _Sending(Lrs(place), queue)
    try:
        for begin in range(0, len(waiting), place.batch):
            progress.report(begin / len(waiting), place.name)
            sending.batch(waiting[begin : begin + place.batch])
    finally:
        if sending.sent:
            note("statements sent", folder=queue.folder.parent, who=by)
    return Delivered(sending.sent, len(waiting) - sending.sent, tuple(sending.refused))


@dataclass
class _Sending:
    lrs: Lrs
    queue: StatementQueue
    sent: int = 0
    refused: list[str] = field(default_factory=list)

    def batch(self, some: Sequence[QueuedStatement]) -> None:
        reply = self.lrs.post([one.statement for one in some])
        if reply.status == 200:
            self._take_off(some, reply)
        elif reply.status in (204, 409):
            self._compare(some)
        elif len(some) > 1:
            half = len(some) // 2
            self.batch(some[:half])
            self.batch(some[half:])
        else:
            self._refuse(some[0], reply)

    def _take_off(self, some: Sequence[QueuedStatement], reply: Reply) -> None:
        if not isinstance(reply.document, list):
            raise UnreachableLrsError(
                sentence(
                    "{name} does not say which statements it took: nothing is lost, it is sent "
                    "later; if that stays so, its address is not a record store's",
                    name=self.lrs.place.name,
                )
            )
        ids = {str(name).lower() for name in reply.document}
        self._sent([one for one in some if one.id in ids])
        self._compare([one for one in some if one.id not in ids])

    def _compare(self, some: Sequence[QueuedStatement]) -> None:
        """Take off what the store holds already, and post the rest one by one."""
        for one in some:
            held = self.lrs.held(one.id)
            if held is None and len(some) > 1:
                self.batch([one])
            elif held is not None and agrees(one.statement, held):
                self._sent([one])
            else:
                self.refused.append(
                    sentence(
                        "{name} has another statement by the id {id}: this one stays here; ask who "
                        "runs the record store to void that one",
                        name=self.lrs.place.name,
                        id=one.id,
                    )
                    if held is not None
                    else sentence(
                        "{name} says that it has {id}, and does not show it: it stays here; ask "
                        "who runs the record store",
                        name=self.lrs.place.name,
                        id=one.id,
                    )
                )

    def _refuse(self, statement: QueuedStatement, reply: Reply) -> None:
        self.refused.append(
            sentence(
                "{name} refuses {id} ({status} {said}): it stays here; ask who runs the record "
                "store",
                name=self.lrs.place.name,
                id=statement.id,
                status=reply.status,
                said=reply.excerpt,
            )
        )

    def _sent(self, some: Sequence[QueuedStatement]) -> None:
        if some:
            self.queue.sent([one.id for one in some])
        self.sent += len(some)


def agrees(ours: Any, held: Any, name: str = "") -> bool:
    """Return whether a store holds what we say: all of it, apart from what it may change.

    What it adds (`stored`, `authority`, `version`) does not matter; times are equal as moments.
    """
    if isinstance(ours, Mapping):
        return isinstance(held, Mapping) and all(
            key in _FREE or (key in held and agrees(value, held[key], key))
            for key, value in ours.items()
        )
    if name == "timestamp":
        try:
            return datetime.fromisoformat(ours) == datetime.fromisoformat(str(held))
        except (ValueError, TypeError):
            return False
    return bool(ours == held)


class Backoff:
    """When to try again: each time in vain twice as long, at most `longest`, half of it by chance.

    So a store that comes back is not met by all stations at one moment.

    Args:
        first: seconds after the first failure.
        longest: seconds.
        rng: that chance comes from.
    """

    def __init__(
        self, first: float = 60.0, longest: float = 3600.0, rng: random.Random | None = None
    ) -> None:
        self._first, self._longest = first, longest
        self._rng, self._failures = rng or random.Random(), 0

    def failed(self, asked: float = 0.0) -> float:
        """Return how long to wait now [s], at least as long as the store asked for."""
        whole = min(self._longest, self._first * 2.0 ** min(self._failures, 20))
        self._failures += 1
        return max(asked, whole * self._rng.uniform(0.5, 1.0))

    def worked(self) -> None:
        """Begin anew: the store answers."""
        self._failures = 0
