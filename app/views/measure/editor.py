"""The measurements of one CT while they are taken and changed, with undo."""

from __future__ import annotations

from dataclasses import replace
from enum import StrEnum

from PySide6.QtCore import QObject, Signal

from app.core.errors import AcusError
from app.imaging.volume import Volume
from app.planning.history import UndoHistory
from app.planning.measurements import Measurement, checked
from app.planning.measuring import Measured, measured

Items = tuple[Measurement, ...]


class MeasureTool(StrEnum):
    """What the left button measures."""

    NONE = "none"
    DISTANCE = "distance"
    ANGLE = "angle"
    PROBE = "probe"
    REGION = "region"


class MeasureEditor(QObject):
    """Holds the history; one drag is one step to undo.

    Signals:
        changed(): another list, another draft.
        stepped(object): this editor has made a step that can be undone.
        tool_changed(): another tool.
    """

    changed = Signal()
    stepped = Signal(object)
    tool_changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._history: UndoHistory[Items] = UndoHistory(())
        self._measured: dict[Measurement, Measured] = {}
        self._fresh = True
        self.volume: Volume | None = None
        self.tool = MeasureTool.NONE
        self.draft: Measurement | None = None

    # --- what is there ----------------------------------------------------------------------------
    @property
    def items(self) -> Items:
        """Measurements in the order in which they were taken."""
        return self._history.present

    @property
    def shown(self) -> Items:
        """Those, and the one that is being drawn."""
        return self.items if self.draft is None else (*self.items, self.draft)

    @property
    def can_undo(self) -> bool:
        """Return whether there is a step to take back."""
        return self._history.can_undo

    @property
    def can_redo(self) -> bool:
        """Return whether there is a step to take again."""
        return self._history.can_redo

    def measured(self, item: Measurement) -> Measured:
        """Return what a measurement came to in the present volume."""
        if self.volume is None:
            return Measured((), "no CT")
        if item not in self._measured:
            if len(self._measured) > 256:  # drags leave many behind
                self._measured.clear()
            self._measured[item] = measured(item, self.volume)
        return self._measured[item]

    # --- changes ----------------------------------------------------------------------------------
    def set_volume(self, volume: Volume | None) -> None:
        """Begin anew with another CT: what was measured in the last one is gone."""
        self.volume, self.draft = volume, None
        self._history, self._measured = UndoHistory(()), {}
        self.changed.emit()

    def set_tool(self, tool: MeasureTool) -> None:
        """Choose what the left button measures; a draft is dropped."""
        if tool is not self.tool or self.draft is not None:
            self.tool, self.draft = tool, None
            self.tool_changed.emit()
            self.changed.emit()

    def set_draft(self, item: Measurement | None) -> None:
        """Show a measurement that is being drawn."""
        self.draft = item
        self.changed.emit()

    def add(self, item: Measurement) -> None:
        """Take a measurement; one that measures nothing is dropped. The tool is laid down."""
        self.draft = None
        try:
            self._do((*self.items, checked(item)))
        except AcusError:
            self.changed.emit()
        self.set_tool(MeasureTool.NONE)

    def begin_move(self) -> None:
        """Make the next `move` a new step to undo."""
        self._fresh = True

    def move(self, number: int, item: Measurement) -> None:
        """Replace a measurement while one of its handles is dragged."""
        try:
            items = (*self.items[:number], checked(item), *self.items[number + 1 :])
        except AcusError:
            return
        if items == self.items:
            return
        if self._fresh:
            self._fresh = False
            self._do(items)
        else:
            self._history = self._history.amend(items)
            self.changed.emit()

    def rename(self, number: int, name: str) -> None:
        """Give a measurement a name."""
        named = replace(self.items[number], name=" ".join(name.split()))
        self._do((*self.items[:number], named, *self.items[number + 1 :]))

    def remove(self, number: int) -> None:
        """Take a measurement away."""
        self._do((*self.items[:number], *self.items[number + 1 :]))

    def clear(self) -> None:
        """Take all away, as one step to undo."""
        self._do(())

    def undo(self) -> None:
        """Take the last step back."""
        self.draft, self._history = None, self._history.undo()
        self.changed.emit()

    def redo(self) -> None:
        """Take it again."""
        self._history = self._history.redo()
        self.changed.emit()

    def _do(self, items: Items) -> None:
        if items != self.items:
            self._history = self._history.do(items)
            self.stepped.emit(self)
        self.changed.emit()
