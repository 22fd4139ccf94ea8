"""What the window gives its features: places for menus, panels and pages, a voice, dialogs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QBoxLayout,
    QMainWindow,
    QMenu,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from app.views.kit.background import Indicator
from app.views.kit.menu_entries import Entry, keyed
from app.views.kit.roles import Role
from app.views.kit.side_panel import SidePanel
from app.views.kit.text import tr
from app.views.shell.message_bar import MessageBar
from app.views.shell.owned import Owned

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings


def menu_titles() -> tuple[str, ...]:
    """Return the titles of the menu bar in their order; others stand before the last."""
    return (
        tr("&File"),
        tr("&Edit"),
        tr("&View"),
        tr("&Measure"),
        tr("&Robot"),
        tr("&Cameras"),
        tr("&Pen"),
        tr("&Checks"),
        tr("&Sessions"),
        tr("&Help"),
    )


class Shell:
    """The only way from a feature to the window.

    Attributes:
        settings: what is remembered between runs, in one ini file of the user.
        progress: shows what goes on beside the window.
        messages: the line at the top: `show_error`, `show_note`.
        page_changed: signal: another page is shown.
        may_go: asks about everything that is unsaved; whether it may go.
        owned: for whom everything of the window is.
    """

    def __init__(
        self,
        window: QMainWindow,
        settings: QSettings,
        pages: QStackedWidget,
        workspace: QWidget,
        side: SidePanel,
        messages: MessageBar,
        progress: Indicator,
        may_go: Callable[[], bool],
    ) -> None:
        self._window, self._pages = window, pages
        self.settings, self.messages, self.progress = settings, messages, progress
        self._workspace, self._side = workspace, side
        self.page_changed, self.may_go = pages.currentChanged, may_go
        self._panels: dict[str, QWidget] = {}
        self.owned = Owned(pages, side)
        self._menus = {title: window.menuBar().addMenu(title) for title in menu_titles()}
        for holder in (window, window.menuBar(), *self._menus.values()):
            self.owned.holds(holder)

    @property
    def dialog_parent(self) -> QWidget:
        """Owner of dialogs: they stand over it and close with it."""
        return self._window

    # --- places ---------------------------------------------------------------------------------
    def menu(self, title: str, *below: str) -> QMenu:
        """Return a menu of the bar by its title, or one in it; made where there is none.

        Args:
            title: in the bar, with its `&`.
            below: titles of menus in it, from outside to inside.
        """
        if title not in self._menus:
            menu, bar = QMenu(title, self._window), self._window.menuBar()
            bar.insertMenu(self._menus[menu_titles()[-1]].menuAction(), menu)
            self._menus[title] = menu
            self.owned.holds(menu)
        menu = self._menus[title]
        for name in below:
            found = [action.menu() for action in menu.actions() if action.text() == name]
            inner = found[0] if found else None
            menu = inner if isinstance(inner, QMenu) else menu.addMenu(name)
            self.owned.holds(menu)
        return menu

    def made_for(self, roles: frozenset[Role]) -> AbstractContextManager[None]:
        """Let what is added meanwhile exist for these roles only: entries, keys, panels, pages."""
        return self.owned.made_for(roles)

    def add_keys(self, entries: Sequence[Entry]) -> list[QAction]:
        """Let keys do what a button of a panel or page does; return their actions."""
        actions = [keyed(QAction(entry[0], self._window), entry) for entry in entries]
        self._window.addActions(actions)
        return actions

    def add_panel(
        self, panel: QWidget, title: str = "", scrolls: bool = True, below: str = ""
    ) -> None:
        """Give a panel its name beside the panes, after those that are there.

        Args:
            panel: to add.
            title: its name.
            below: title of the panel at whose end this one stands, without a name of its own.
            scrolls: whether it scrolls up and down where there is too little room; a panel that
                does so by itself, such as a table, does not need it.
        """
        if below:
            column = self._panels[below].layout()
            if isinstance(column, QBoxLayout):
                place = QWidget()  # what the panel itself shows and hides stays its own
                inside = QVBoxLayout(place)
                inside.setContentsMargins(0, 0, 0, 0)
                inside.addWidget(panel)
                column.insertWidget(column.count() - 1, place)  # before the stretch at its end
                self.owned.keep(place)
            return
        self._panels[title] = panel
        self._side.addTab(panel, title, scrolls)
        self.owned.add_panel()

    def show_panel(self, panel: QWidget) -> None:
        """Bring a panel that was added, and the page with it, to the front."""
        self.show_workspace()
        self._side.setCurrentWidget(panel)

    def add_page(self, page: QWidget, roles: frozenset[Role] | None = None) -> None:
        """Add a page that fills the window while it is shown.

        Args:
            page: to add.
            roles: who has it; a page that is made once it is wanted says so.
        """
        self._pages.addWidget(page)
        self.owned.add_page(page, roles)

    def show_page(self, page: QWidget) -> None:
        """Bring a page that was added to the front, where the role has it."""
        if self.owned.has_page(page):
            self._pages.setCurrentWidget(page)

    @property
    def is_working(self) -> bool:
        """Return whether the panes are shown, and no other page."""
        return self._pages.currentWidget() is self._workspace

    def show_workspace(self) -> None:
        """Go to the panes."""
        self._pages.setCurrentWidget(self._workspace)
        self._workspace.setFocus()
