"""Who sits at the window: the switch at its top right, and what follows from it.

Where no password is set the switch is free and remembered. Where one is, nobody signed in is a
student, and the other roles ask for the password, a technician's also whom the hospital signed in
as an instructor. It is refused while an attempt runs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import QObject, QSettings, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QDialog, QMenu, QMenuBar, QToolButton

from app.views.exercise.controller import ExerciseController
from app.views.kit.access import ACCESS
from app.views.kit.roles import (
    EVERYBODY,
    EVERYBODYS,
    STAFF,
    Role,
    first_role,
    role_named,
    role_title,
    role_words,
)
from app.views.kit.text import keys_text, literal, tr
from app.views.shell.message_bar import ATTEMPT_RUNS
from app.views.shell.shell import Shell
from app.views.shell.shortcuts import ROLE_KEY

_ROLE: Final = "role"


class RoleSwitch(QObject):
    """Shows the role, changes it, and lets the window show what the role has.

    Signals:
        changed(): another role.

    Attributes:
        button: at the right of the menu bar; its menu offers the roles.
        actions: the roles in it.
    """

    changed = Signal()

    def __init__(
        self,
        bar: QMenuBar,
        shell: Shell,
        controller: ExerciseController,
        sign_in: Callable[[], object],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._shell, self._controller, self._sign_in = shell, controller, sign_in
        self._bar = bar
        self._settings: QSettings = shell.settings
        self._wanted = role_named(self._settings.value(_ROLE), first_role())
        self._asked: Role | None = None
        self._was_open = _most_open()
        self.button = QToolButton(bar)
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        self.button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.button.setAutoRaise(True)
        self.button.setProperty("role", "menu")
        self._menu = QMenu(self.button)
        self._group = QActionGroup(self)
        self.actions = {role: self._entry(role) for role in Role}
        self.button.setMenu(self._menu)
        bar.setCornerWidget(self.button, Qt.Corner.TopRightCorner)
        with shell.made_for(EVERYBODY):
            shell.add_keys([(tr("Role"), ROLE_KEY, self.button.showMenu)])
        ACCESS.changed.connect(self.follow)
        controller.finished.connect(lambda _: QTimer.singleShot(0, self, self.follow))
        self._apply(self._now())

    @property
    def role(self) -> Role:
        """Return the role for which the window is shown."""
        return self._shell.owned.role

    def choose(self, role: Role) -> None:
        """Change the role; asks for the password where one is set, refused while an attempt runs.

        A student who is signed in is signed out by another role, and the instructor by a student's:
        what the password opened is closed again before somebody else sits down.
        """
        self._show_chosen()
        if role is self.role:
            return
        if self._controller.is_running:
            self._shell.messages.show_until(
                ATTEMPT_RUNS, tr("An attempt is running: end it before the role is changed")
            )
            return
        self._asked = role
        if role in STAFF and ACCESS.guarded and not ACCESS.opens(role):
            self._sign_in()
            return
        self._keep(role)
        if (role is Role.STUDENT and ACCESS.instructor) or ACCESS.student is not None:
            ACCESS.sign_in(None)
        if role is Role.STUDENT:
            self._shell.messages.clear()  # what was said to whoever sat here before
        self.follow()

    def follow(self) -> None:
        """Take the role that fits who is signed in; an attempt that runs keeps its own."""
        before, self._was_open = self._was_open, _most_open()
        if self._was_open > before:
            asked = self._asked if self._asked in STAFF else None
            wanted = asked or (self._wanted if self._wanted in STAFF else Role.INSTRUCTOR)
            self._keep(wanted if ACCESS.opens(wanted) else Role.INSTRUCTOR)
        role = self._now()
        if role is not self.role and not self._controller.is_running:
            self._apply(role)
        ACCESS.take_role(self.role)

    # --- inside -----------------------------------------------------------------------------------
    def _entry(self, role: Role) -> QAction:
        action = self._menu.addAction(f"{role_title(role)}: {role_words(role)}")
        action.setCheckable(True)
        action.triggered.connect(lambda _=False: self.choose(role))
        return self._group.addAction(action)

    def _keep(self, role: Role) -> None:
        self._asked, self._wanted = None, role
        self._settings.setValue(_ROLE, role.value)

    def _now(self) -> Role:
        closed = ACCESS.guarded and not ACCESS.instructor
        if ACCESS.student is not None or closed:
            return Role.STUDENT
        beyond = ACCESS.instructor and not ACCESS.opens(self._wanted)
        return Role.INSTRUCTOR if beyond else self._wanted

    def _apply(self, role: Role) -> None:
        self._close_dialogs()
        self._shell.owned.show(role)
        ACCESS.take_role(role)
        self._show_chosen()
        self.changed.emit()

    def _close_dialogs(self) -> None:
        """Close what the role before had open beside the window; a page of help is everybody's."""
        for dialog in self._bar.window().findChildren(QDialog):
            if dialog.isVisible() and not dialog.isModal() and not dialog.property(EVERYBODYS):
                dialog.close()

    def _show_chosen(self) -> None:
        title = role_title(self.role)
        self.actions[self.role].setChecked(True)
        self.button.setText(title)
        # Set once more, it gets the width of its new text.
        self._bar.setCornerWidget(self.button, Qt.Corner.TopRightCorner)
        self.button.setAccessibleName(tr("Role: {role}", role=title))
        self.button.setToolTip(
            literal(
                tr("Who sits here: it decides what the window has ({key})", key=keys_text(ROLE_KEY))
            )
        )


def _most_open() -> int:
    """Return the rank of the highest role that who is signed in opens; 0 for who opens none."""
    return max((role.rank for role in STAFF if ACCESS.opens(role)), default=0)
