"""What the user changes of a patient: three editors, and one undo, the last step first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QObject, Signal, SignalInstance

from app.views.measure.editor import MeasureEditor
from app.views.plan.editor import PlanEditor
from app.views.structures.book import StructureBook


class Undoable(Protocol):
    """An editor with a history of its own."""

    changed: SignalInstance
    stepped: SignalInstance

    @property
    def can_undo(self) -> bool:
        """Return whether there is a step to take back."""

    @property
    def can_redo(self) -> bool:
        """Return whether there is a step to take again."""

    def undo(self) -> None:
        """Take the last step back."""

    def redo(self) -> None:
        """Take it again."""


class UndoOrder(QObject):
    """Remembers in which order the editors made their steps.

    An editor that cannot undo just now (its plan is locked by an attempt, or was begun anew) is
    passed over and keeps its place.

    Signals:
        changed(): what can be undone or redone is another.
    """

    changed = Signal()

    def __init__(self, editors: Sequence[Undoable], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._past: list[Undoable] = []
        self._future: list[Undoable] = []
        for editor in editors:
            editor.stepped.connect(self._note)
            editor.changed.connect(self.changed)

    def clear(self) -> None:
        """Forget every step: what they changed is gone."""
        self._past, self._future = [], []
        self.changed.emit()

    @property
    def can_undo(self) -> bool:
        """Return whether an editor has a step to take back."""
        return any(editor.can_undo for editor in self._past)

    @property
    def can_redo(self) -> bool:
        """Return whether an editor has a step to take again."""
        return any(editor.can_redo for editor in self._future)

    def undo(self) -> None:
        """Take the last step back."""
        number = _last(self._past, lambda editor: editor.can_undo)
        if number is not None:
            editor = self._past.pop(number)
            self._future.append(editor)
            editor.undo()
            self.changed.emit()

    def redo(self) -> None:
        """Take the step again that was taken back last."""
        number = _last(self._future, lambda editor: editor.can_redo)
        if number is not None:
            editor = self._future.pop(number)
            self._past.append(editor)
            editor.redo()
            self.changed.emit()

    def _note(self, editor: Undoable) -> None:
        self._past.append(editor)
        self._future = [other for other in self._future if other is not editor]
        self.changed.emit()


def _last(editors: list[Undoable], able: Callable[[Undoable], bool]) -> int | None:
    return next((i for i in reversed(range(len(editors))) if able(editors[i])), None)


@dataclass(frozen=True, slots=True, eq=False)
class Editors:
    """The editors, each with a history of its own (`shell.undo.UndoOrder` puts them in order).

    Attributes:
        plan: entry, target and position of the patient.
        measures: distances, angles, regions.
        structures: organs and risks: files, and what was marked by hand.
    """

    plan: PlanEditor
    measures: MeasureEditor
    structures: StructureBook
