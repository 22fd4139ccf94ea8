"""For whom each part of the window is, and the one place where what a role does not have goes.

What is added within `made_for` belongs to these roles: menu entries, keys, panels, pages, single
widgets. What a role does not have is taken out of its menu, so that neither the entry is there nor
its shortcut; it comes back to its place. Nothing is built anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QStackedWidget, QWidget
from shiboken6 import isValid

from app.views.kit.roles import EVERYBODY, STAFF, Role
from app.views.kit.side_panel import SidePanel


class Owned:
    """Parts of the window with their roles.

    Attributes:
        role: for which it is shown.
        leave: goes to another page where the role does not have the present one.
    """

    def __init__(self, pages: QStackedWidget, side: SidePanel) -> None:
        self._pages, self._side = pages, side
        self.role = Role.TECHNICIAN
        self.leave: Callable[[], object] = lambda: None
        self._now = EVERYBODY
        self._roles: dict[QAction, frozenset[Role]] = {}
        self._order: dict[QWidget, list[QAction]] = {}  # of what holds actions that several share
        self._menus: dict[QMenu, frozenset[Role]] = {}
        self._widgets: dict[QWidget, frozenset[Role]] = {}
        self._page_roles: dict[QWidget, frozenset[Role]] = {}
        self._panels: list[frozenset[Role]] = []

    # --- what is added --------------------------------------------------------------------------
    @contextmanager
    def made_for(self, roles: frozenset[Role]) -> Iterator[None]:
        """Let everything that is added meanwhile be for these roles; what is inside says more."""
        self._take_new(self._now)
        outer, self._now = self._now, roles & self._now
        try:
            yield
        finally:
            self._take_new(self._now)
            self._now = outer

    def holds(self, holder: QWidget) -> None:
        """Watch the actions of a menu, a menu bar or a window that several share."""
        self._order.setdefault(holder, [])

    def keep_menu(self, menu: QMenu) -> None:
        """Show a menu to the roles for whom things are made now, whatever is in it."""
        self._menus[menu] = self._now

    def add_panel(self) -> None:
        """Remember for whom the panel is that was added last."""
        self._panels.append(self._now)

    def add_page(self, page: QWidget, roles: frozenset[Role] | None = None) -> None:
        """Remember for whom a page is; `roles` where it is added later than its feature."""
        self._page_roles[page] = self._now if roles is None else roles

    def keep(self, widget: QWidget) -> None:
        """Show a widget to the roles for whom things are made now, and to nobody else."""
        self._widgets[widget] = self._now
        widget.setVisible(self.role in self._now)

    # --- who has what ---------------------------------------------------------------------------
    def has_page(self, page: QWidget) -> bool:
        """Return whether the present role has a page; one that nobody added is everybody's."""
        return self.role in self._page_roles.get(page, EVERYBODY)

    def show(self, role: Role) -> None:
        """Show what a role has, and nothing else."""
        self.role = role
        self._take_new(STAFF)  # whatever was added later by somebody who does not say for whom
        for holder, order in self._order.items():
            wanted = [action for action in order if self._has(action)]
            if wanted != holder.actions():
                for action in holder.actions():
                    holder.removeAction(action)
                holder.addActions(wanted)
        for widget, roles in self._widgets.items():
            if isValid(widget):
                widget.setVisible(role in roles)
        there = [index for index, roles in enumerate(self._panels) if role in roles]
        self._side.set_there(there, named=role is not Role.STUDENT)
        page = self._pages.currentWidget()
        if page is not None and not self.has_page(page):
            self.leave()

    def _has(self, action: QAction) -> bool:
        """Return whether the role has an action; a shared menu where it has anything in it."""
        menu = action.menu()
        if isinstance(menu, QMenu) and menu in self._order:
            if self.role not in self._menus.get(menu, EVERYBODY):
                return False
            return any(self._has(one) for one in self._order[menu] if not one.isSeparator())
        return self.role in self._roles.get(action, STAFF)

    def _take_new(self, roles: frozenset[Role]) -> None:
        """Give actions that are not known yet a place in the order, and these roles."""
        for holder, order in self._order.items():
            order[:] = [action for action in order if isValid(action)]
            place = 0
            for action in holder.actions():
                if action in order:
                    place = order.index(action) + 1
                    continue
                order.insert(place, action)
                self._roles[action] = roles
                place += 1
