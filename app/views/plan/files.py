"""New, open, save: plans as 3D Slicer markups files, and nothing lost without a question."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from app.core.errors import AcusError
from app.exchange.markups import read_plan, write_plan
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.plan.editor import PlanEditor
from app.views.shell.settings import Recents

SUFFIX = ".mrk.json"


class PlanFiles(QObject):
    """Reads and writes the editor's plan.

    Signals:
        failed(object): an error that kept a file from being read or written.
        noted(str): what was done.
    """

    failed = Signal(object)
    noted = Signal(str)

    def __init__(self, editor: PlanEditor, recents: Recents, window: QWidget) -> None:
        super().__init__(window)
        self._editor, self._recents, self._window = editor, recents, window

    def new(self) -> None:
        """Start an empty plan, unless an attempt keeps the present one."""
        if not self._editor.refuse_locked():
            self.after_question(lambda: self._editor.start(None))

    def ask_open(self) -> None:
        """Ask for a file and open it, unless an attempt keeps the present plan."""
        if not self._editor.refuse_locked():
            self.after_question(self._ask_open)

    def open(self, path: Path) -> None:
        """Open this file, after the question about unsaved changes."""
        self.after_question(lambda: self._open(path))

    def save(self) -> bool:
        """Write to the plan's file, or ask for one; return whether it was written."""
        path = self._editor.path
        return self._write(path) if path is not None else self.save_as()

    def save_as(self) -> bool:
        """Ask where to write; return whether it was written."""
        own = self._editor.path or Path.home() / f"{self._editor.edit.draft.name}{SUFFIX}"
        start = str(NAMES.folder(own))
        name, _ = QFileDialog.getSaveFileName(
            self._window, tr("Save plan"), start, tr("Plans (*{suffix})", suffix=SUFFIX)
        )
        if not name:
            return False
        path = Path(name if name.endswith(".json") else name + SUFFIX)
        return self._write(path)

    def after_question(self, action: Callable[[], object]) -> bool:
        """Do `action` unless the user wants to keep unsaved changes; return whether it was done."""
        if self._editor.dirty and not self._may_go():
            return False
        action()
        return True

    def _may_go(self) -> bool:
        buttons = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self._window,
            tr("Unsaved plan"),
            tr("The plan has unsaved changes. Save them first?"),
            buttons.Save | buttons.Discard | buttons.Cancel,
            buttons.Save,
        )
        if answer == buttons.Save:
            return self.save()
        return answer == buttons.Discard

    def _ask_open(self) -> None:
        own = self._editor.path.parent if self._editor.path else Path.home()
        start = str(NAMES.folder(own))
        kinds = tr("Plans (*{suffix} *.json)", suffix=SUFFIX)
        name, _ = QFileDialog.getOpenFileName(self._window, tr("Open plan"), start, kinds)
        if name:
            self._open(Path(name))

    def _open(self, path: Path) -> None:
        NAMES.learn(path)
        try:
            plan = read_plan(path)
        except AcusError as error:
            self.failed.emit(error)
            return
        self._editor.opened(path, plan)
        self._recents.add(path)
        self.noted.emit(tr("Opened {name}", name=path.name))

    def _write(self, path: Path) -> bool:
        NAMES.learn(path)
        try:
            write_plan(path, self._editor.edit.draft.plan())
        except AcusError as error:
            self.failed.emit(error)
            return False
        self._editor.saved(path)
        self._recents.add(path)
        self.noted.emit(tr("Saved {name}", name=path.name))
        return True
