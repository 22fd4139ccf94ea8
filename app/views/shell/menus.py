"""The menus: every command of the window with its key, in one table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu

from app.views.cameras.menu import CamerasMenu
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.measure.menu import MeasureMenu
from app.views.pen.menu import PenMenu
from app.views.plan.position_files import PositionFiles
from app.views.robot.menu import RobotMenu
from app.views.series.library_desk import LibraryDesk
from app.views.shell.view_menu import ViewMenu
from app.views.slices.viewing import Tool

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow

Entry = tuple[str, str, Callable[[], object]]


class Menus:
    """Builds the menu bar of a window and keeps what changes in it up to date."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        self.library = LibraryDesk(window.progress, window)
        self.position = PositionFiles(window)
        self.recent_cts, self.recent_plans = self._file()
        self.undo, self.redo = self._edit()
        self.view = ViewMenu(self._menu(tr("&View")), window)
        self.follow, self.bullseye = self.view.follow, self.view.bullseye
        self.measure = MeasureMenu(self._menu(tr("&Measure")), window)
        self.robot = RobotMenu(self._menu(tr("&Robot")), window.robot, self._show_health,
                               window.pen.open)  # fmt: skip
        self.cameras = CamerasMenu(self._menu(tr("&Cameras")), window.cameras)
        self.pen = PenMenu(self._menu(tr("&Pen")), window.pen)
        self.errors = self._checks()
        self._sessions()
        self._help()

    def _menu(self, title: str) -> QMenu:
        return self._window.menuBar().addMenu(title)

    def _add(self, menu: QMenu, entries: Sequence[Entry | None]) -> list[QAction]:
        actions = []
        for entry in entries:
            if entry is None:
                menu.addSeparator()
                continue
            text, keys, command = entry
            action = menu.addAction(text)
            if keys:
                action.setShortcuts([QKeySequence(key) for key in keys.split(" | ")])
            action.triggered.connect(lambda _=False, command=command: command())
            actions.append(action)
        return actions

    def _file(self) -> tuple[QMenu, QMenu]:
        window, files = self._window, self._window.plan_files
        menu = self._menu(tr("&File"))
        self._add(menu, [
            (tr("Start page"), "", window.show_start),
            (tr("Open CT folder…"), "Ctrl+O", window.open_ct.ask),
            (tr("Open CT archive or file…"), "", window.open_ct.ask_file),
            (tr("Series of the folder…"), "", window.open_ct.browse),
        ])  # fmt: skip
        recent_cts = menu.addMenu(tr("Recent CTs"))
        self._library(menu.addMenu(tr("Library of CTs")))
        self._add(menu, [(tr("Phantom patient"), "", window.open_phantom), None])
        self._add(menu, [
            (tr("New plan"), "Ctrl+N", files.new),
            (tr("Open plan…"), "Ctrl+Shift+O", files.ask_open),
        ])  # fmt: skip
        recent_plans = menu.addMenu(tr("Recent plans"))
        self._add(menu, [
            (tr("Save plan"), "Ctrl+S", files.save),
            (tr("Save plan as…"), "Ctrl+Shift+S", files.save_as),
        ])  # fmt: skip
        self._slicer(menu.addMenu(tr("3D Slicer")))
        self._add(menu, [
            None,
            (tr("Quit"), "Ctrl+Q", window.close),
        ])  # fmt: skip
        recent_cts.aboutToShow.connect(
            lambda: self._fill(recent_cts, window.recent_cts.paths(), window.open_ct.open_folder)
        )
        recent_plans.aboutToShow.connect(
            lambda: self._fill(recent_plans, window.recent_plans.paths(), files.open)
        )
        return recent_cts, recent_plans

    def _slicer(self, menu: QMenu) -> None:
        """Fill in what goes to and comes from 3D Slicer, in one place."""
        window, files = self._window, self._window.plan_files
        self._add(menu, [
            (tr("Open plan (.mrk.json)…"), "", files.ask_open),
            (tr("Save plan as (.mrk.json)…"), "", files.save_as),
            (tr("Export measurements (.mrk.json)…"), "", window.measuring.export),
            None,
            (tr("Import position of the patient (.tfm)…"), "", self.position.ask_open),
            (tr("Export position of the patient (.tfm)…"), "", self.position.ask_export),
        ])  # fmt: skip

    def _library(self, menu: QMenu) -> None:
        """CTs that were taken in de-identified, and the ways in."""
        window, desk = self._window, self.library

        def fill() -> None:
            menu.clear()
            self._add(menu, [
                (tr("Import CT folder, de-identified…"), "", desk.ask),
                (tr("Import CT archive or file, de-identified…"), "", desk.ask_file),
                (tr("From the PACS…"), "", desk.ask_pacs),
                (tr("Configure PACS…"), "", desk.configure_pacs),
                None,
            ])  # fmt: skip
            for name, folder in desk.entries():
                action = menu.addAction(NAMES.shown(name))
                action.triggered.connect(lambda _=False, f=folder: window.open_ct.open_folder(f))

        menu.aboutToShow.connect(fill)
        desk.open_wanted.connect(window.open_ct.open_folder)
        desk.failed.connect(window.open_ct.failed)

    def _fill(self, menu: QMenu, paths: Sequence[Path], command: Callable[[Path], object]) -> None:
        menu.clear()
        for path in paths:
            action = menu.addAction(NAMES.shown(path.name))
            action.setToolTip(NAMES.shown(str(path)))
            action.triggered.connect(lambda _=False, path=path: command(path))
        menu.setToolTipsVisible(True)
        if not paths:
            menu.addAction(tr("none yet")).setEnabled(False)

    def _edit(self) -> tuple[QAction, QAction]:
        window, viewing = self._window, self._window.workspace.viewing
        undo, redo, *_ = self._add(self._menu(tr("&Edit")), [
            (tr("Undo"), "Ctrl+Z", window.undo.undo),
            (tr("Redo"), "Ctrl+Y | Ctrl+Shift+Z", window.undo.redo),
            None,
            (tr("Place entry"), "E", lambda: viewing.set_tool(Tool.ENTRY)),
            (tr("Place target"), "T", lambda: viewing.set_tool(Tool.TARGET)),
        ])  # fmt: skip
        return undo, redo

    def _show_health(self) -> None:
        self._window.show_workspace()
        self._window.workspace.show_health()

    def _checks(self) -> QAction:
        window = self._window
        *_, errors = self._add(self._menu(tr("&Checks")), [
            (tr("Morning check…"), "F9", window.checks.open_morning),
            (tr("Registration check…"), "", window.checks.open_registration),
            None,
            (tr("Draw errors of target and tip"), "", lambda: None),
        ])  # fmt: skip
        errors.setCheckable(True)
        errors.setChecked(True)
        errors.toggled.connect(window.workspace.viewing.set_shows_errors)
        return errors

    def _sessions(self) -> None:
        window = self._window
        self._add(self._menu(tr("&Sessions")), [
            (tr("Workspace"), "F6", window.show_workspace),
            (tr("Past sessions"), "F7", window.show_sessions),
        ])  # fmt: skip

    def _help(self) -> None:
        self._add(self._menu(tr("&Help")), [
            (tr("Keys and mouse"), "F1 | ?", self._window.show_shortcuts),
            (tr("Report a problem…"), "", self._window.report_problem),
            (tr("About Acus"), "", self._window.show_about),
        ])  # fmt: skip
