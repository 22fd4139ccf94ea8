"""The plan in the window: panel, menu, 3D Slicer markups files; nothing lost without a question."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from PySide6.QtCore import SignalInstance

from app.views.kit.menu_entries import add_entries, add_recent
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.plan.editor import PlanFiles
from app.views.plan.panel import PlanPanel
from app.views.shell.feature import Context, Feature
from app.views.shell.settings import Recents
from app.views.slices.viewing import Tool

SUFFIX = ".mrk.json"


class PlanFeature(Feature):
    """Panel, menu entries and files of the plan."""

    topic: ClassVar[str] = "plan"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._editor, viewing, shell = context.editors.plan, context.views.viewing, context.shell
        recents = Recents(shell.settings, "recent/plans")
        self.files = files = PlanFiles(self._editor, recents, shell.dialog_parent)
        files.failed.connect(self.failed)
        files.noted.connect(self.noted)
        self.panel = PlanPanel(self._editor, viewing)
        shell.add_panel(self.panel, tr("Plan"))
        for signal, command in (
            (self.panel.new_wanted, files.new), (self.panel.open_wanted, files.ask_open),
            (self.panel.save_wanted, files.save), (self.panel.save_as_wanted, files.save_as),
        ):  # fmt: skip
            signal.connect(command)
        menu = shell.menu(tr("&File"))
        add_entries(menu, [
            (tr("New plan"), "Ctrl+N", files.new),
            (tr("Open plan…"), "Ctrl+Shift+O", files.ask_open),
        ])  # fmt: skip
        add_recent(menu, tr("Recent plans"), recents.paths, files.open)
        add_entries(menu, [
            (tr("Save plan"), "Ctrl+S", files.save),
            (tr("Save plan as…"), "Ctrl+Shift+S", files.save_as),
        ])  # fmt: skip
        add_entries(shell.menu(tr("&File"), tr("3D Slicer")), [
            (tr("Open plan (.mrk.json)…"), "", files.ask_open),
            (tr("Save plan as (.mrk.json)…"), "", files.save_as),
        ])  # fmt: skip
        add_entries(shell.menu(tr("&Edit")), [
            (tr("Place entry"), "E", lambda: viewing.set_tool(Tool.ENTRY)),
            (tr("Place target"), "T", lambda: viewing.set_tool(Tool.TARGET)),
        ])  # fmt: skip

    # --- what the window asks -----------------------------------------------------------------
    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.noted,)

    def suit_room(self) -> None:
        """Write the panel anew: names are hidden, or shown again."""
        self.panel.refresh()

    def unsaved(self) -> str:
        """Say that the plan has unsaved changes; empty where it has none."""
        if not self._editor.dirty:
            return ""
        name = NAMES.shown(self._editor.edit.draft.name)
        return tr("the plan “{name}”, which has unsaved changes", name=name)

    def save(self) -> bool:
        """Write the plan to its file, or ask for one; return whether it was written."""
        return self.files.save()

    def opens(self, path: Path) -> bool:
        """Open a dropped plan."""
        if path.suffix != ".json":
            return False
        self.files.open(path)
        return True

    def may_go(self) -> bool:
        """Ask whether unsaved changes may go, or save them; True where there are none."""
        return self.files.after_question(lambda: None)
