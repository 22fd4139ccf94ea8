"""The menu View: layouts, window and level, what follows what, how the screen is used."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu

from app.views.layouts import LAYOUTS, layout_title
from app.views.slices.presets import menu_windows
from app.views.text import tr

if TYPE_CHECKING:
    from app.views.window import MainWindow


class ViewMenu:
    """Builds the menu of a window and keeps its check marks true.

    Attributes:
        layouts: the layouts by name.
        follow: slices follow the needle's tip.
        bullseye: the bull's-eye beside the slices.
    """

    def __init__(self, menu: QMenu, window: MainWindow) -> None:
        self._menu, self._window = menu, window
        self.layouts = self._layout_menu(menu.addMenu(tr("Layout")))
        presets = menu.addMenu(tr("Window presets"))
        presets.aboutToShow.connect(lambda: self._fill_presets(presets))
        viewing, workspace = window.workspace.viewing, window.workspace
        self.follow = self._switch(tr("Slices follow the needle tip"), "F", viewing.set_follows_tip)
        self.bullseye = self._switch(
            tr("Bull's-eye beside the slices"), "B", workspace.show_bullseye
        )
        menu.addSeparator()
        self._entry(tr("Crosshair to target"), "", window.cursor_to_target)
        self._entry(tr("Full screen"), "F11", window.toggle_full_screen)
        workspace.arranged.connect(self.refresh)
        self.refresh()

    def _entry(self, text: str, key: str, command: Callable[[], object]) -> QAction:
        action = self._menu.addAction(text)
        if key:
            action.setShortcut(QKeySequence(key))
        action.triggered.connect(lambda _=False: command())
        return action

    def _switch(self, text: str, key: str, command: Callable[[bool], object]) -> QAction:
        action = self._menu.addAction(text)
        action.setCheckable(True)
        if key:
            action.setShortcut(QKeySequence(key))
        action.toggled.connect(command)
        return action

    def _layout_menu(self, menu: QMenu) -> dict[str, QAction]:
        workspace, actions = self._window.workspace, {}
        group = QActionGroup(menu)
        for number, name in enumerate(LAYOUTS, start=1):
            action = group.addAction(menu.addAction(layout_title(name)))
            action.setCheckable(True)
            action.setShortcut(QKeySequence(f"Ctrl+{number}"))
            action.triggered.connect(lambda _=False, name=name: workspace.show_layout(name))
            actions[name] = action
        menu.addSeparator()
        self._left_handed = menu.addAction(tr("Left-handed: panel on the right"))
        self._left_handed.setCheckable(True)
        self._left_handed.toggled.connect(workspace.set_left_handed)
        return actions

    def refresh(self) -> None:
        """Check what is shown; a layout whose panes are not there cannot be chosen."""
        workspace = self._window.workspace
        for name, action in self.layouts.items():
            action.setVisible(name in workspace.layouts)
            action.setEnabled(name in workspace.layouts)
            action.setChecked(name == workspace.layout_name)
        for switch, state in (
            (self.bullseye, workspace.has_bullseye),
            (self._left_handed, workspace.is_left_handed),
        ):
            if switch.isChecked() != state:
                switch.setChecked(state)

    def _fill_presets(self, menu: QMenu) -> None:
        menu.clear()
        viewing = self._window.workspace.viewing
        for name, key, window in menu_windows(viewing.volume):
            action = menu.addAction(f"{name}  {window.width:g} / {window.level:g}\t{key}")
            action.triggered.connect(lambda _=False, w=window: viewing.set_window(w))
