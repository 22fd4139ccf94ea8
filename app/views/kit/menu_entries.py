"""Entries of menus from a table: text, keys, command."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu

from app.views.kit.names import NAMES
from app.views.kit.text import literal, tr

Entry = tuple[str, str, Callable[[], object]]
"""Text, keys separated by ` | ` (empty for none), and what is done."""


def add_entries(menu: QMenu, entries: Sequence[Entry | None]) -> list[QAction]:
    """Add entries at the end of a menu; None stands for a line between them.

    Returns the actions, without the lines.
    """
    actions = []
    for entry in entries:
        if entry is None:
            menu.addSeparator()
            continue
        actions.append(keyed(menu.addAction(entry[0]), entry))
    return actions


def keyed(action: QAction, entry: Entry) -> QAction:
    """Give an action the keys and the command of an entry."""
    _, keys, command = entry
    if keys:
        action.setShortcuts([QKeySequence(key) for key in keys.split(" | ")])
    action.triggered.connect(lambda _=False: command())
    return action


def add_recent(
    menu: QMenu, title: str, paths: Callable[[], Sequence[Path]], command: Callable[[Path], object]
) -> QMenu:
    """Add a menu of paths, filled each time that it is shown."""
    recent = menu.addMenu(title)
    recent.setToolTipsVisible(True)

    def fill() -> None:
        recent.clear()
        for path in paths():
            action = recent.addAction(NAMES.shown(path.name))
            action.setToolTip(literal(NAMES.shown(str(path))))
            action.triggered.connect(lambda _=False, path=path: command(path))
        if recent.isEmpty():
            recent.addAction(tr("none yet")).setEnabled(False)

    recent.aboutToShow.connect(fill)
    return recent
