"""Undo and redo as an immutable value: the window keeps one and replaces it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Generic, TypeVar

V = TypeVar("V")

DEPTH = 200
"""Steps that can be undone; older ones are forgotten."""


@dataclass(frozen=True, slots=True)
class UndoHistory(Generic[V]):
    """The present value between those that can be undone and redone.

    Attributes:
        present: what is shown now.
        past: what `undo` goes back to, oldest first.
        future: what `redo` goes forward to, next first.
    """

    present: V
    past: tuple[V, ...] = ()
    future: tuple[V, ...] = ()

    def do(self, value: V) -> UndoHistory[V]:
        """Make `value` the present; what could be redone is forgotten. Equal values add no step."""
        if value == self.present:
            return self
        return UndoHistory(value, (*self.past, self.present)[-DEPTH:])

    def amend(self, value: V) -> UndoHistory[V]:
        """Replace the present without a new step: the moves of one drag are one step."""
        return replace(self, present=value, future=())

    def newest(self, steps: int) -> UndoHistory[V]:
        """Forget all but the newest steps that can be undone."""
        return replace(self, past=self.past[max(0, len(self.past) - steps) :])

    @property
    def can_undo(self) -> bool:
        """Return whether there is something to go back to."""
        return bool(self.past)

    @property
    def can_redo(self) -> bool:
        """Return whether there is something to go forward to."""
        return bool(self.future)

    def undo(self) -> UndoHistory[V]:
        """Go one step back; at the beginning, the same history."""
        if not self.past:
            return self
        return UndoHistory(self.past[-1], self.past[:-1], (self.present, *self.future))

    def redo(self) -> UndoHistory[V]:
        """Go one step forward; at the end, the same history."""
        if not self.future:
            return self
        return UndoHistory(self.future[0], (*self.past, self.present), self.future[1:])
