"""The buttons of the registration check, and their rows."""

from __future__ import annotations

from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from app.views.kit.text import tr

_BUTTONS = {
    "touch": tr("Touch now"),
    "move": tr("Bring the simulated tip there"),
    "pick": tr("Pick the bead at the crosshair"),
    "forget": tr("Forget"),
    "undo": tr("Undo"),
    "redo": tr("Redo"),
    "place": tr("Use the measured place"),
    "save": tr("Save"),
}


def make_buttons(parent: QWidget) -> dict[str, QPushButton]:
    """Return the buttons by name."""
    buttons = {name: QPushButton(title, parent) for name, title in _BUTTONS.items()}
    buttons["save"].setProperty("role", "primary")
    return buttons


def row_of(buttons: dict[str, QPushButton], *names: str | None) -> QHBoxLayout:
    """Return a row of some of them; None is where the room is left, the end without one."""
    row = QHBoxLayout()
    for name in names:
        if name is None:
            row.addStretch(1)
        else:
            row.addWidget(buttons[name])
    if None not in names:
        row.addStretch(1)
    return row
