"""Attempts that are over: the debrief of one, the list of all, their reports and tables."""

from __future__ import annotations

from typing import ClassVar

from PySide6.QtCore import SignalInstance

from app.session.result import AttemptResult
from app.views.debrief.controller import DebriefController
from app.views.debrief.page import DebriefPage
from app.views.debrief.scan_picture import ScanPictures
from app.views.debrief.sessions import SessionsPage
from app.views.kit.menu_entries import add_entries
from app.views.kit.text import tr
from app.views.shell.feature import Context, Feature


class DebriefFeature(Feature):
    """Two pages: shown when an attempt ends, and from the menu.

    Attributes:
        page: the debrief.
        sessions: the list of past attempts.
    """

    topic: ClassVar[str] = "debrief"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        shell, folder = context.shell, context.services.sessions()
        self.page, self.sessions = DebriefPage(), SessionsPage(folder)
        for page in (self.page, self.sessions):
            shell.add_page(page)
        self._controller = DebriefController(self.page, self.sessions, folder, parent=self)
        self.scan_pictures = ScanPictures(self.page, context.conductor, shell.progress)
        self._controller.failed.connect(lambda why: self.failed.emit(why))
        self._controller.saved.connect(lambda path: self.noted.emit(tr("Saved {name}", name=path)))
        self._controller.shown.connect(self.show)
        self.page.retry_requested.connect(shell.show_workspace)
        self.page.sessions_requested.connect(self.show_sessions)
        self.sessions.closed.connect(shell.show_workspace)
        context.conductor.controller.finished.connect(self.show_result)
        menu = shell.menu(tr("&Sessions"))
        add_entries(menu, [(tr("Past sessions"), "F7", self.show_sessions)])

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._controller.saved, self.context.shell.page_changed)

    def suit_room(self) -> None:
        """Take other colours and sizes; names are hidden, or shown again."""
        self.sessions.table.viewport().update()
        self.page.suit_room()

    def show(self) -> None:
        """Go to the attempt that the debrief shows."""
        self.context.shell.show_page(self.page)

    def show_sessions(self) -> None:
        """Go to the past attempts."""
        self.sessions.refresh()
        self.context.shell.show_page(self.sessions)

    def show_result(self, result: AttemptResult) -> None:
        """Show the debrief of an attempt that ended."""
        self.context.editors.plan.set_locked(False)
        self._controller.show_result(result)
