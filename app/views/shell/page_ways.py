"""The ways between the window's pages: what leads from which to which."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QLineEdit

from app.views.kit import theme
from app.views.reading.workspace import SIDE_WIDTH

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow


def connect_pages(window: MainWindow) -> None:
    """Connect the pages of a window whose parts are all there."""
    controller = window.conductor.controller
    controller.began.connect(lambda _: window.workspace.show_exercise())
    controller.finished.connect(window.show_result)
    window.workspace.exercise_panel.exercise_chosen.connect(window.begin_exercise)
    start, debrief = window.start_page, window.debrief_page
    start.exercise_chosen.connect(window.begin_exercise)
    start.open_wanted.connect(window.open_ct.ask)
    start.recent_chosen.connect(window.open_ct.open_folder)
    start.sessions_wanted.connect(window.show_sessions)
    window.debrief.shown.connect(window.show_debrief)
    debrief.retry_requested.connect(window.show_workspace)
    debrief.sessions_requested.connect(window.show_sessions)
    window.sessions_page.closed.connect(window.show_workspace)
    window.projector.changed.connect(lambda: suit_room(window))


def suit_room(window: MainWindow) -> None:
    """Give panel and names what text size and room ask for."""
    workspace = window.workspace
    workspace.side.setFixedWidth(round(SIDE_WIDTH * theme.scale()))
    hidden = window.projector.hides_names
    mode = QLineEdit.EchoMode.Password if hidden else QLineEdit.EchoMode.Normal
    workspace.exercise_panel.student.setEchoMode(mode)
    workspace.bullseye.source.suit_text()
    workspace.viewing.plan_changed.emit()  # names of marks are as large as the text
    workspace.viewing.needle_changed.emit()
    window.start_page.set_recents(window.recent_cts.paths())
    window.sessions_page.table.viewport().update()
    window.debrief_page.suit_room()
    window.structures.panel.refresh()
    window.paths.panel.suit_text()
    workspace.messages.suit_room()
    workspace.plan_panel.refresh()
    window.refresh()
