"""Names that are hidden while many people look at the screen: pseudonyms, folders, students."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from app.core.identifiers import HIDDEN, without_identifiers

SHORTEST = 3
"""Shorter names are not looked for in other texts: they would be found within words."""


class Names(QObject):
    """Says whether names are shown, and takes them out of texts that may hold them.

    Signals:
        changed(): they are hidden now, or shown again.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._hidden = False
        self._known: set[str] = set()

    @property
    def are_hidden(self) -> bool:
        """Return whether names are hidden."""
        return self._hidden

    def hide(self, hidden: bool) -> None:
        """Hide names, or show them again."""
        if hidden != self._hidden:
            self._hidden = hidden
            self.changed.emit()

    def shown(self, name: str) -> str:
        """Return a name, or dots in its place; nothing stays nothing."""
        return HIDDEN if self._hidden and name else name

    def learn(self, *names: str | Path) -> None:
        """Know names that may stand in texts from now on; of a path also its last part."""
        for name in names:
            parts = (str(name), name.name) if isinstance(name, Path) else (name.strip(),)
            self._known.update(part for part in parts if len(part) >= SHORTEST)

    @property
    def known(self) -> frozenset[str]:
        """Names that were learnt in this run."""
        return frozenset(self._known)

    def without_names(self, text: str, files: bool = False) -> str:
        """Return a text, or while names are hidden the text with dots for every name in it.

        Names are those that were learnt, pseudonyms, and whatever looks like a path or a file.

        Args:
            text: that may hold names.
            files: whether it speaks of files of a folder: all with a slash in it is one then.
        """
        if not self._hidden or not text:
            return text
        return without_identifiers(text, self._known, files)

    def folder(self, wanted: Path) -> Path:
        """Return where a file dialog begins: the home folder while names are hidden."""
        return Path.home() if self._hidden else wanted


NAMES = Names()
"""The one switch of the window: every part that writes a name asks it."""
