"""Names that are hidden while many people look at the screen: pseudonyms, folders, students."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

HIDDEN = "•••"


class Names(QObject):
    """Says whether names are shown.

    Signals:
        changed(): they are hidden now, or shown again.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._hidden = False

    @property
    def are_hidden(self) -> bool:
        """Whether names are hidden."""
        return self._hidden

    def hide(self, hidden: bool) -> None:
        """Hide names, or show them again."""
        if hidden != self._hidden:
            self._hidden = hidden
            self.changed.emit()

    def shown(self, name: str) -> str:
        """Return a name, or dots in its place; nothing stays nothing."""
        return HIDDEN if self._hidden and name else name


NAMES = Names()
"""The one switch of the window: every part that writes a name asks it."""
