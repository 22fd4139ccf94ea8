"""CTs in the window: the ways in, those of before, the library of de-identified ones, the PACS."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from PySide6.QtCore import SignalInstance
from PySide6.QtWidgets import QMenu

from app.views.kit.menu_entries import add_entries, add_recent
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.series.library_import import LibraryImport
from app.views.shell.feature import Context, Feature


class SeriesFeature(Feature):
    """Menu entries that open patients, and take CTs into the library."""

    topic: ClassVar[str] = "ct"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        shell, self._patients = context.shell, context.patients
        self.library = LibraryImport(shell.progress, shell.dialog_parent)
        self.library.open_wanted.connect(self._patients.open_folder)
        self.library.failed.connect(self._patients.failed)
        self._patients.failed.connect(self.failed)
        menu = shell.menu(tr("&File"))
        add_entries(menu, [
            (tr("Open CT folder…"), "Ctrl+O", self._patients.ask),
            (tr("Open CT archive or file…"), "", self._patients.ask_file),
            (tr("Series of the folder…"), "", self._patients.browse),
        ])  # fmt: skip
        add_recent(menu, tr("Recent CTs"), self._patients.recents.paths, self._patients.open_folder)
        self._library_menu = menu.addMenu(tr("Library of CTs"))
        self._library_menu.aboutToShow.connect(lambda: self._fill(self._library_menu))
        add_entries(menu, [(tr("Phantom patient"), "", self.open_phantom), None])

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._patients.opened,)

    def opens(self, path: Path) -> bool:
        """Open what was dropped, whatever it is: this feature is asked last."""
        self._patients.open_folder(path)
        return True

    def open_phantom(self) -> None:
        """Open the phantom of the present exercise, or the first."""
        exercise = self.context.conductor.exercise
        phantom = exercise.ct.phantom if exercise is not None else None
        self._patients.open_phantom(phantom.seed if phantom is not None else 1)

    def close(self) -> None:
        """Stop reading; idempotent."""
        self._patients.close()

    def _fill(self, menu: QMenu) -> None:
        """Offer the ways into the library, and what it holds."""
        menu.clear()
        library = self.library
        add_entries(menu, [
            (tr("Import CT folder, de-identified…"), "", library.ask),
            (tr("Import CT archive or file, de-identified…"), "", library.ask_file),
            (tr("From the PACS…"), "", library.ask_pacs),
            (tr("Configure PACS…"), "", library.configure_pacs),
            None,
        ])  # fmt: skip
        for name, folder in library.entries():
            action = menu.addAction(NAMES.shown(name))
            action.triggered.connect(lambda _=False, f=folder: self._patients.open_folder(f))
