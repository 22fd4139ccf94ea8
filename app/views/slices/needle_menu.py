"""What the needle's panes can be laid along, as entries of a menu."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtWidgets import QMenu

from app.views.kit.text import tr
from app.views.slices.needle_source import Along, NeedlePlanes
from app.views.slices.viewing import Tool, Viewing


def fill_needle_menu(menu: QMenu, planes: NeedlePlanes, viewing: Viewing) -> None:
    """Add the choices, the present one checked."""
    entries: tuple[tuple[str, Along, Callable[[], object], bool], ...] = (
        (tr("Follow the needle"), Along.NEEDLE, planes.follow_needle, True),
        (tr("Hold here"), Along.HELD, planes.hold, planes.frame is not None),
        (tr("Along the planned path"), Along.PATH, planes.show_path, planes.path_mm is not None),
        (tr("Through two points…"), Along.POINTS, lambda: viewing.set_tool(Tool.PLANE),
         viewing.volume is not None),
    )  # fmt: skip
    menu.addSeparator()
    for text, along, command, enabled in entries:
        action = menu.addAction(text)
        action.setCheckable(True)
        action.setChecked(planes.along is along)
        action.setEnabled(enabled)
        action.triggered.connect(lambda _=False, command=command: command())
    menu.addSeparator()
    traces = menu.addAction(tr("Lines in the patient views"))
    traces.setCheckable(True)
    traces.setChecked(viewing.shows_traces)
    traces.triggered.connect(viewing.set_shows_traces)
