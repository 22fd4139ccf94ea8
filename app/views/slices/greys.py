"""How values become grey in the panes: one window or each its own, locked or not, inverted."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from app.imaging.window import WindowLevel
from app.views.slices.panes import PaneId


class Greys(QObject):
    """Window and level of every pane.

    Signals:
        changed(): some pane is to be drawn with other greys.
        refused(): somebody wished another window while it is locked.

    Attributes:
        common: window of the panes that have none of their own.
        is_linked: whether all panes share one window.
        is_locked: whether window and level stay as they are.
        is_fixed: whether the exercise has locked them: nobody else can unlock them then.
        is_inverted: whether what is dense is dark.
        kept: windows that the user has named.
    """

    changed = Signal()
    refused = Signal()

    def __init__(self, window: WindowLevel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.common = window
        self.is_linked, self.is_locked, self.is_inverted = True, False, False
        self.is_fixed = False
        self.kept: dict[str, WindowLevel] = {}
        self._own: dict[PaneId, WindowLevel] = {}

    def of(self, pane: PaneId) -> WindowLevel:
        """Window of a pane."""
        return self._own.get(pane, self.common)

    def set(self, window: WindowLevel, pane: PaneId | None = None) -> None:
        """Take a window for all panes, or for one if each has its own."""
        if self.is_locked:
            self.refused.emit()
            return
        if self.is_linked or pane is None:
            changed = window != self.common or bool(self._own)
            self.common = window
            self._own.clear()
        else:
            changed = window != self.of(pane)
            self._own[pane] = window
        if changed:
            self.changed.emit()

    def set_linked(self, linked: bool) -> None:
        """Let all panes share one window from now on, or let each have its own."""
        self.is_linked = linked
        if linked and self._own:
            self._own.clear()
        self.changed.emit()

    def set_locked(self, locked: bool) -> None:
        """Keep window and level from being changed by a slip; not what the exercise has fixed."""
        if self.is_fixed:
            self.refused.emit()
        else:
            self.is_locked = locked
        self.changed.emit()

    def fix(self, fixed: bool) -> None:
        """Lock window and level for an exercise, or end that lock."""
        if fixed or self.is_fixed:
            self.is_fixed = self.is_locked = fixed
            self.changed.emit()

    def set_inverted(self, inverted: bool) -> None:
        """Show what is dense dark, or bright again."""
        self.is_inverted = inverted
        self.changed.emit()

    def keep(self, name: str, window: WindowLevel) -> None:
        """Give a window a name; one of this name that there was is replaced."""
        self.kept[name] = window
        self.changed.emit()

    def forget(self, name: str) -> None:
        """Take a name away."""
        self.kept.pop(name, None)
        self.changed.emit()
