"""Actions that nobody declares belong to instructor and technician, whenever they were added."""

import pytest
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QStackedWidget

from app.views.kit.roles import STAFF, Role
from app.views.kit.side_panel import SidePanel
from app.views.shell.owned import Owned


@pytest.fixture
def owned(application, destroy):
    pages, side, menu = QStackedWidget(), SidePanel(), QMenu()
    for widget in (pages, side, menu):
        destroy(widget)
    result = Owned(pages, side)
    result.holds(menu)
    result.menu = menu
    return result


@pytest.mark.parametrize("role", list(Role))
def test_what_is_added_later_by_who_does_not_say_for_whom_is_not_a_students(owned, role):
    owned.show(Role.TECHNICIAN)
    action = owned.menu.addAction("Later")
    owned.show(role)
    assert (action in owned.menu.actions()) == (role in STAFF)


@pytest.mark.parametrize("role", list(Role))
def test_an_action_of_which_nothing_is_known_is_not_a_students(owned, role):
    owned.role = role
    assert owned._has(QAction("unknown")) == (role in STAFF)
