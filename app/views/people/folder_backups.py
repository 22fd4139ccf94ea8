"""A backup into a folder from the window: the folder, a passphrase, and what came of it."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QStandardPaths
from PySide6.QtWidgets import QCheckBox, QFileDialog

from app.core.progress import Progress
from app.session.archive import Saved, backup_into
from app.session.backup_folder import backups_of, is_encrypted, pieces_for
from app.session.errors import PeopleError
from app.views.kit.text import tr, tr_n
from app.views.people.dialogs import EntryDialog
from app.views.people.stations import StationDoors


class FolderBackups:
    """Adds backups to a folder, in which what is alike in several lies once.

    Args:
        doors: of the page of people.
    """

    def __init__(self, doors: StationDoors) -> None:
        self._doors = doors

    def choose(self) -> None:
        """Ask for the folder, then how it is written."""
        if not self._doors.may():
            return
        documents = QStandardPaths.StandardLocation.DocumentsLocation
        start = QStandardPaths.writableLocation(documents)
        title = tr("Back up into a folder")
        path = QFileDialog.getExistingDirectory(self._doors.parent(), title, start)
        if path:
            self.ask(Path(path))

    def ask(self, folder: Path) -> None:
        """Ask for the passphrase that holds in the folder, or for one to begin with."""
        fresh, locked = not backups_of(folder), is_encrypted(folder)
        if fresh:
            words = tr(
                "The first backup in {name}; later ones there write only what is new. It holds "
                "names: without its passphrase an encrypted one cannot be read again.",
                name=folder.name,
            )
        else:
            words = tr(
                "What is new since the last backup in {name} is added. It holds names.",
                name=folder.name,
            )
            if not locked:
                words += " " + tr("The backups there are not encrypted.")
        cts = QCheckBox(tr("The CTs of own exercises too"))

        def take(passphrase: str = "", again: str = "") -> None:
            if fresh and passphrase != again:
                raise PeopleError(tr("the two passphrases are not the same: type them again"))
            if locked:
                pieces_for(folder, passphrase)  # another one is said while it can be typed again
            self.write(folder, passphrase, cts.isChecked())

        fields = [(tr("Passphrase"), True)] if locked else []
        if fresh:
            fields = [(tr("Passphrase (empty: not encrypted)"), True), (tr("Again"), True)]
        title, parent = tr("Back up into a folder"), self._doors.parent()
        dialog = EntryDialog(title, fields, take, words, parent)
        dialog.form.wide(cts)
        self._doors.open(dialog)

    def write(self, folder: Path, passphrase: str = "", with_cts: bool = False) -> None:
        """Add a backup beside the window; it can be cancelled."""
        if not self._doors.may():
            return
        records, people = self._doors.folder, self._doors.people

        def work(progress: Progress) -> Saved:
            return backup_into(folder, records, people, progress, passphrase, with_cts)

        def tell(saved: Saved) -> None:
            words = tr_n(
                "{n} attempt saved in {name}, {new:.1f} MB were new",
                "{n} attempts saved in {name}, {new:.1f} MB were new",
                saved.records,
                name=saved.path,
                new=saved.new / 1e6,
            )
            left = saved.left_out
            without = tr("Not in it: {what}", what="; ".join(left)) if left else ""
            self._doors.note(". ".join(filter(None, (words, without))))

        self._doors.beside(work, tell, tr("Backing up"))
