"""A backup brought back in the window: chosen, asked about, checked whole, and told."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QStandardPaths
from PySide6.QtWidgets import QCheckBox, QFileDialog

from app.core.progress import Progress
from app.session.backup_folder import is_encrypted, opened_backup
from app.session.restoring import Restored, restore_backup
from app.views.kit.text import tr, tr_n, translated
from app.views.people.dialogs import EntryDialog
from app.views.people.stations import StationDoors


class BackupRestorer:
    """Brings back what a backup holds and is missing here.

    Args:
        doors: of the page of people.
    """

    def __init__(self, doors: StationDoors) -> None:
        self._doors = doors

    def choose(self) -> None:
        """Ask for a backup, and how it is brought back."""
        if not self._doors.may():
            return
        documents = QStandardPaths.StandardLocation.DocumentsLocation
        start = QStandardPaths.writableLocation(documents)
        kind = tr("Backup of Acus (*.acusbackup)")
        title = tr("Restore a backup")
        path = QFileDialog.getOpenFileName(self._doors.parent(), title, start, kind)[0]
        if path:
            self.ask(Path(path))

    def ask(self, path: Path) -> None:
        """Ask for the recovery key, and whose students are taken."""
        words = tr(
            "Attempts that are missing here are brought back from {name}; none that is here is "
            "changed, and nobody who was erased comes back. The recovery key brings the station's "
            "key back too, for another computer: leave it empty else.",
            name=path.name,
        )
        locked = is_encrypted(path)
        instead = QCheckBox(tr("Students and courses of the backup in place of those here"))

        def take(recovery: str, passphrase: str = "") -> None:
            if locked:
                with opened_backup(path, passphrase):  # said while it can be typed again
                    pass
            self.restore(path, recovery.strip(), instead.isChecked(), passphrase)

        fields = [(tr("Recovery key"), False), (tr("Passphrase of the backup"), True)]
        fields = fields if locked else fields[:1]
        parent = self._doors.parent()
        dialog = EntryDialog(tr("Restore a backup"), fields, take, words, parent)
        instead.setParent(dialog)
        dialog.form.wide(instead)
        self._doors.open(dialog)

    def restore(
        self,
        path: Path,
        recovery: str = "",
        replace_people: bool = False,
        passphrase: str = "",
    ) -> None:
        """Bring a backup back beside the window, all of it or nothing; it can be cancelled.

        Args:
            path: of the backup.
            recovery: the printed key; empty leaves the station's key alone.
            replace_people: take students and courses of the backup although there are some here.
            passphrase: of an encrypted backup.
        """
        if not self._doors.may():
            return
        folder, people = self._doors.folder, self._doors.people

        def work(progress: Progress) -> Restored:
            return restore_backup(
                path, folder, recovery, replace_people, people, progress, passphrase
            )

        self._doors.beside(work, self._show, tr("Restoring a backup"))

    def _show(self, done: Restored) -> None:
        self._doors.changed()
        words = tr_n("{n} attempt brought back", "{n} attempts brought back", done.records)
        self._doors.tell(tr("Restore a backup"), words, restored_words(done))


def restored_words(done: Restored) -> str:
    """Return what came of a backup, a line for each thing."""
    lines = [
        tr_n("{n} attempt was here already.", "{n} attempts were here already.", done.kept),
        {
            "restored": tr("Students and courses are those of the backup."),
            "kept": tr("Students and courses here stay as they are."),
            "none": tr("There are no students in the backup."),
        }[done.people],
        {
            "restored": tr("The station's key is that of the backup."),
            "same": tr("The station's key was this one already."),
            "not asked": tr("The station's key here stays; the one in the backup was not asked."),
            "none": tr("There is no station's key in the backup."),
        }[done.key],
    ]
    if done.erased:
        lines.append(
            tr_n(
                "{n} attempt left out: its student was erased.",
                "{n} attempts left out: their students were erased.",
                done.erased,
            )
        )
    if done.different:
        names = ", ".join(done.different)
        lines.append(tr("Another file here, which stays: {names}", names=names))
    lines += [
        tr("A CT lies in {folder}: its exercise names another place.", folder=one)
        for one in done.cts
    ]
    lines += [tr("Not taken: {what}", what=translated(line)) for line in done.not_taken]
    return "\n".join(lines)
