"""Attempts told to a learning record store (LRS), which an LMS or a school keeps.

What waits in `session.statement_queue` is posted by the Experience API (xAPI 1.0.3, part three).
A statement leaves the queue once the store has said that it holds it, not before: whatever happens
in between, it is posted again under the same id, and a store takes no second one.

The door: `LrsPlace`, where the store is; `deliver`, which sends; `Backoff`, when to try again.
"""

from app.exchange.lrs.client import Lrs
from app.exchange.lrs.delivery import Backoff, Delivered, deliver, tell_attempts
from app.exchange.lrs.errors import LrsError, UnreachableLrsError
from app.exchange.lrs.place import LrsPlace, place_of_lrs, put_lrs

__all__ = [
    "Backoff",
    "Delivered",
    "Lrs",
    "LrsError",
    "LrsPlace",
    "UnreachableLrsError",
    "deliver",
    "place_of_lrs",
    "put_lrs",
    "tell_attempts",
]
