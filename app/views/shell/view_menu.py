"""The menu View: layouts, window and level, what follows what, how the screen is used."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu

from app.exercises.locks import Lock
from app.exercises.parts import ViewName
from app.views.exercise.conductor import Conductor
from app.views.kit.roles import EVERYBODY, STAFF
from app.views.kit.text import literal, tr
from app.views.plan.editor import PlanEditor
from app.views.reading.layouts import LAYOUTS, layout_title
from app.views.reading.lock_words import CAMERA_ROLES, view_title, why_locked
from app.views.reading.workspace import WorkspacePage
from app.views.shell.projector import Projector
from app.views.shell.shell import Shell
from app.views.slices.bindings import SCHEMES
from app.views.slices.needle_source import fill_needle_menu
from app.views.slices.pane import SlicePane, fill_windows
from app.views.slices.presentation import OperatorSide, side_name, turns
from app.views.slices.turning import straighten


class ViewMenu:
    """Builds the menu of a window and keeps its check marks true.

    Attributes:
        layouts: the layouts by name.
        follow: slices follow the needle's tip.
        bullseye: the bull's-eye beside the slices.
        schemes: the bindings of mouse and keys by name.
        operator: the places that the slices can be turned to, by name.
    """

    def __init__(
        self,
        shell: Shell,
        workspace: WorkspacePage,
        conductor: Conductor,
        editor: PlanEditor,
        projector: Projector,
    ) -> None:
        self._shell, self._menu = shell, shell.menu(tr("&View"))
        menu = self._menu
        self._workspace, self._conductor = workspace, conductor
        self._editor, self._projector = editor, projector
        menu.setToolTipsVisible(True)
        viewing = workspace.viewing
        self._greys = viewing.greys
        self.layouts = self._layout_menu(menu.addMenu(tr("Layout")))
        presets = menu.addMenu(tr("Window presets"))
        presets.aboutToShow.connect(lambda: self._fill_presets(presets))
        with shell.made_for(STAFF):
            self._linked = self._switch(tr("One window for all panes"), "", self._greys.set_linked)
            self._locked = self._switch(
                tr("Lock window and level"), "Ctrl+L", self._greys.set_locked
            )
        self._inverted = self._switch(tr("Invert grey"), "", self._greys.set_inverted)
        menu.addSeparator()
        self.follow = self._switch(tr("Slices follow the needle tip"), "", viewing.set_follows_tip)
        self.bullseye = self._switch(
            tr("Bull's-eye beside the slices"), "", workspace.show_bullseye
        )
        self.legend = self._switch(
            tr("Legend of the bull's-eye"), "", workspace.bullseye.legend.setChecked
        )
        moves_hub = workspace.bullseye.source.set_moves_hub
        with shell.made_for(STAFF):
            self.hub = self._switch(tr("The hand moves the hub, not the tip"), "", moves_hub)
        self.shown = self._shown_menu(shell)
        self._entry(tr("Crosshair to target"), "", self.cursor_to_target)
        with shell.made_for(STAFF):
            needle = menu.addMenu(tr("Needle's planes"))
            needle.aboutToShow.connect(lambda: self._fill_needle(needle))
            self._entry(tr("Straighten all planes"), "", lambda: straighten(viewing))
            self.operator = self._operator_menu(menu.addMenu(tr("Operator's side")))
        menu.addSeparator()
        self.schemes = self._scheme_menu(menu.addMenu(tr("Mouse and keys")))
        self._screen_entries()
        conductor.views_changed.connect(self.refresh)
        for changed in (
            workspace.arranged,
            viewing.window_changed,
            viewing.scheme_changed,
            workspace.bullseye.legend.toggled,
            workspace.bullseye.source.turned,
        ):
            changed.connect(self.refresh)
        self.refresh()

    def add_menu(self, title: str) -> QMenu:
        """Return another menu at the end of this one, for everybody."""
        with self._shell.made_for(EVERYBODY):
            return self._menu.addMenu(title)

    def _fill_needle(self, menu: QMenu) -> None:
        workspace = self._workspace
        menu.clear()
        fill_needle_menu(menu, workspace.needle_planes, workspace.viewing)

    def _screen_entries(self) -> None:
        """Full screen and what a room asks for."""
        projector, menu = self._projector, self._menu.addMenu(tr("Projector"))
        self._room: list[tuple[QAction, Callable[[], bool]]] = []
        for text, key, is_on, command in (
            (tr("Projector mode: all three"), "Ctrl+P", lambda: projector.is_on, projector.set_all),
            (tr("Light colours"), "", lambda: projector.is_light, projector.set_light),
            (tr("Large text"), "", lambda: projector.is_large, projector.set_large),
            (tr("Hide names"), "", lambda: projector.hides_names, projector.hide_names),
        ):
            action = menu.addAction(text)
            action.setCheckable(True)
            action.setShortcut(QKeySequence(key))
            action.triggered.connect(command)
            self._room.append((action, is_on))
        projector.changed.connect(self.refresh)
        self._entry(tr("Full screen"), "F11", self._toggle_full_screen)

    def cursor_to_target(self) -> None:
        """Let the slices pass through the target."""
        target = self._editor.edit.draft.target_mm
        if target is not None:
            self._workspace.viewing.set_cursor(target)

    def _toggle_full_screen(self) -> None:
        """Fill the screen, or stop doing so."""
        window = self._workspace.window()
        if window.isFullScreen():
            window.showNormal()
        else:
            window.showFullScreen()

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
        # Only what the user does: `refresh` shows a state, and chooses nothing.
        action.triggered.connect(lambda on: command(on))
        return action

    def _layout_menu(self, menu: QMenu) -> dict[str, QAction]:
        workspace, actions = self._workspace, {}
        menu.setToolTipsVisible(True)
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

    def _shown_menu(self, shell: Shell) -> dict[ViewName, QAction]:
        conductor, actions = self._conductor, {}
        menu = shell.menu(tr("&View"), tr("Shown by the exercise"))
        menu.setToolTipsVisible(True)
        for view in ViewName:
            with shell.made_for(CAMERA_ROLES if view is ViewName.CAMERAS else EVERYBODY):
                action = menu.addAction(view_title(view))
            action.setCheckable(True)
            action.triggered.connect(lambda on, view=view: conductor.show_view(view, on))
            actions[view] = action
        return actions

    def _scheme_menu(self, menu: QMenu) -> dict[str, QAction]:
        viewing, actions = self._workspace.viewing, {}
        group = QActionGroup(menu)
        for scheme in SCHEMES.values():
            action = group.addAction(menu.addAction(tr("As in {scheme}", scheme=scheme.title)))
            action.setCheckable(True)
            action.triggered.connect(lambda _=False, scheme=scheme: viewing.set_scheme(scheme))
            actions[scheme.name] = action
        menu.addSeparator()
        self._reversed = menu.addAction(tr("Level the other way round"))
        self._reversed.setCheckable(True)
        self._reversed.toggled.connect(self._reverse_level)
        return actions

    def _operator_menu(self, menu: QMenu) -> dict[str, QAction]:
        actions = {}
        for side in OperatorSide:
            actions[str(side)] = action = menu.addAction(side_name(side))
            action.triggered.connect(lambda _=False, side=side: self._stand(side))
        return actions

    def _stand(self, side: OperatorSide) -> None:
        """Turn the slices to where the operator stands, as the patient lies now."""
        lies = self._editor.edit.placement.orientation
        viewing = self._workspace.viewing
        for pane, turn in turns(side, lies).items():
            viewing.set_presentation(pane, replace(viewing.presentation(pane), turn=turn))

    def _reverse_level(self, reverse: bool) -> None:
        self._workspace.viewing.level_reversed = reverse

    def refresh(self) -> None:
        """Check what is shown; a layout whose panes are not there cannot be chosen."""
        workspace, greys = self._workspace, self._greys
        for name, action in self.layouts.items():
            action.setVisible(name in workspace.layouts)
            action.setEnabled(name in workspace.layouts and not workspace.is_layout_fixed)
            action.setChecked(name == workspace.shown_layout)
        self._locked.setEnabled(not greys.is_fixed)
        why = why_locked(self._conductor.exercise, Lock.READING)
        for action in (*self.layouts.values(), self._locked):
            action.setToolTip(literal("" if action.isEnabled() else why))
        kept = workspace.bullseye.source.why_sense_stays
        self.hub.setEnabled(not kept)
        self.hub.setToolTip(literal(kept))
        self._refresh_views()
        for action, is_on in self._room:
            action.setChecked(is_on())
        scheme = workspace.viewing.scheme
        for name, action in self.schemes.items():
            action.setChecked(name == scheme.name)
        self.follow.setShortcut(QKeySequence(scheme.menu_keys["follow"]))
        self.bullseye.setShortcut(QKeySequence(scheme.menu_keys["bullseye"]))
        for switch, state in (
            (self.bullseye, workspace.has_bullseye),
            (self._left_handed, workspace.is_left_handed),
            (self.legend, workspace.bullseye.legend.isChecked()),
            (self.hub, workspace.bullseye.source.moves_hub),
            (self._linked, greys.is_linked),
            (self._locked, greys.is_locked),
            (self._inverted, greys.is_inverted),
            (self._reversed, workspace.viewing.level_reversed),
        ):
            if switch.isChecked() != state:
                switch.setChecked(state)

    def _refresh_views(self) -> None:
        """Check the views that the exercise shows; say why one cannot be switched."""
        conductor, workspace = self._conductor, self._workspace
        for view, action in self.shown.items():
            why = conductor.why_view_stays(view)
            action.setChecked(conductor.shown.shows(view))
            action.setEnabled(not why)
            action.setToolTip(literal(why))
        why = why_locked(conductor.exercise, Lock.VIEWS)
        self.bullseye.setEnabled(not (workspace.is_cell_fixed and workspace.has_bullseye))
        self.bullseye.setToolTip(literal("" if self.bullseye.isEnabled() else why))

    def _fill_presets(self, menu: QMenu) -> None:
        """Offer windows for the pane that has the keyboard, or had it last."""
        menu.clear()
        fill_windows(menu, self._pane())

    def _pane(self) -> SlicePane:
        panes = self._workspace.panes
        return next((pane for pane in panes if pane.canvas.hasFocus()), panes[0])
