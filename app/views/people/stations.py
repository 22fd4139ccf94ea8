"""Results of several stations in the window: written for others, and brought together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from PySide6.QtCore import QStandardPaths
from PySide6.QtWidgets import QDialog, QFileDialog, QMenu, QMessageBox, QPushButton, QWidget

from app.core.errors import AcusError
from app.core.progress import Cancelled, Progress
from app.session.gathering import GatheredFile, gather_file, told_of
from app.session.people import People
from app.session.results_file import WrittenFile, write_course, write_results
from app.session.school_file import UnknownStationError
from app.session.station import StationKey
from app.session.stations import fingerprint, name_of_station
from app.views.kit.parts import message_box
from app.views.kit.text import tr, tr_n, translated


@dataclass(frozen=True)
class StationDoors:
    """What the page of people lends.

    Attributes:
        folder: of the records.
        people: of this station.
        may: returns whether who is here may do this; else it is said.
        beside: does work beside the window, then calls what follows with its result.
        note: says what was done.
        tell: shows a text to read: title, words, text.
        open: shows a dialog.
        changed: reads people and attempts anew.
        parent: returns the window of dialogs.
    """

    folder: Path
    people: People
    may: Callable[[], bool]
    beside: Callable[[Callable[[Progress], Any], Callable[[Any], object], str], None]
    note: Callable[[str], object]
    tell: Callable[[str, str, str], None]
    open: Callable[[QDialog], None]
    changed: Callable[[], None]
    parent: Callable[[], QWidget]


@dataclass(frozen=True)
class Gathered:
    """What came of several files.

    Attributes:
        taken: what each brought that was taken.
        refused: why each of the others was not.
        unknown: those of them whose stations are not known here.
    """

    taken: tuple[GatheredFile, ...]
    refused: tuple[AcusError, ...]
    unknown: tuple[Path, ...]


class StoreLink(Protocol):
    """What the menu asks of the school's store."""

    def now(self) -> None:
        """Exchange what is new with it."""
        ...

    def connect_store(self) -> None:
        """Ask where it is."""
        ...


class RecordStoreLink(Protocol):
    """What the menu asks of the learning record store."""

    def now(self) -> None:
        """Tell it what is new."""
        ...

    def connect_lrs(self) -> None:
        """Ask where it is."""
        ...


class StationExchange:
    """The button of stations on the board, and what its menu does.

    Args:
        button: that gets the menu.
        doors: of the page.
        link: to the school's store.
        lrs: to the learning record store.
    """

    def __init__(
        self, button: QPushButton, doors: StationDoors, link: StoreLink, lrs: RecordStoreLink
    ) -> None:
        self._doors = doors
        menu = QMenu(button)
        self._actions = []
        for title, action in (
            (tr("Exchange with the school's store now"), link.now),
            (tr("Connect to the school's store…"), link.connect_store),
            (tr("Tell the record store now"), lrs.now),
            (tr("Connect to a record store (xAPI)…"), lrs.connect_lrs),
            (tr("Bring results of stations together…"), self.choose_files),
            (tr("Write this station's results…"), self.choose_results),
            (tr("Write the course for a station…"), self.choose_course),
            (tr("This station…"), self.show_station),
        ):
            entry = menu.addAction(title)
            entry.triggered.connect(lambda *_, action=action: action())
            self._actions.append(entry)
        button.setMenu(menu)

    def set_managing(self, may: bool) -> None:
        """Offer what the menu does, or nothing of it."""
        for entry in self._actions:
            entry.setEnabled(may)

    def show_station(self) -> None:
        """Show what this station is called, and what others compare of its key."""
        if not self._doors.may():
            return
        key = StationKey.of(self._doors.people.folder)
        name = name_of_station(self._doors.people, key)
        words = tr("Others compare this before they let it in:")
        self._doors.tell(tr("This station"), words, f"{name}\n{fingerprint(key.public)}")

    # --- bringing together ------------------------------------------------------------------------
    def choose_files(self) -> None:
        """Ask for files of other stations, and take them in."""
        if not self._doors.may():
            return
        title, start = tr("Results of stations"), str(_documents())
        found = QFileDialog.getOpenFileNames(self._doors.parent(), title, start, _kind())[0]
        if found:
            self.gather([Path(name) for name in found])

    def gather(self, files: Sequence[Path], trust: bool = False) -> None:
        """Take in files beside the window, each whole or not at all; it can be cancelled.

        Args:
            files: of other stations.
            trust: let stations in that are not known here; else it is asked.
        """
        if not self._doors.may():
            return

        def work(progress: Progress) -> Gathered:
            taken, refused, unknown = [], [], []
            for number, file in enumerate(files):
                part = progress.part(number / len(files), (number + 1) / len(files))
                try:
                    folder, people = self._doors.folder, self._doors.people
                    taken.append(gather_file(file, folder, trust, people=people, progress=part))
                except Cancelled:
                    raise
                except AcusError as error:
                    refused.append(error)
                    unknown += [file] if isinstance(error, UnknownStationError) else []
            return Gathered(tuple(taken), tuple(refused), tuple(unknown))

        self._doors.beside(work, self._show, tr("Bringing stations together"))

    def _show(self, gathered: Gathered) -> None:
        """Say in plain words what came of it, and ask about stations that are not known."""
        if gathered.taken:
            self._doors.changed()
        if gathered.unknown:
            self._ask(gathered)
            return
        words = tr_n("{n} file taken in", "{n} files taken in", len(gathered.taken))
        self._doors.tell(tr("Results of stations"), words, summary_words(gathered))

    def _ask(self, gathered: Gathered) -> None:
        box = message_box(
            self._doors.parent(),
            tr("Results of stations"),
            tr("Let these stations in?"),
            summary_words(gathered),
        )
        accept = box.addButton(tr("Let them in"), QMessageBox.ButtonRole.AcceptRole)
        box.setDefaultButton(box.addButton(QMessageBox.StandardButton.Cancel))

        def answered(clicked: object) -> None:
            if clicked is accept:
                self.gather(gathered.unknown, trust=True)

        box.buttonClicked.connect(answered)
        self._doors.open(box)

    # --- writing ----------------------------------------------------------------------------------
    def choose_results(self) -> None:
        """Ask where the results of this station go, and write them."""
        if path := self._place(tr("Write this station's results"), "acus-results.acus"):
            self.write_results(path)

    def write_results(self, path: Path) -> None:
        """Write the results of this station, beside the window; it can be cancelled."""
        if not self._doors.may():
            return
        folder, people = self._doors.folder, self._doors.people

        def done(written: WrittenFile) -> None:
            words = tr_n(
                "{n} attempt saved in {name}",
                "{n} attempts saved in {name}",
                written.attempts,
                name=str(path),
            )
            left = written.left_out
            lost = tr("left out, altered: {names}", names=", ".join(left)) if left else ""
            self._doors.note(". ".join(filter(None, (words, lost))))

        self._doors.beside(
            lambda progress: write_results(path, folder, None, people, progress),
            done,
            tr("Writing the results"),
        )

    def choose_course(self) -> None:
        """Ask where the course for a station goes, and write it without names and PINs."""
        if path := self._place(tr("Write the course for a station"), "acus-course.acus"):
            self.write_course(path)

    def write_course(self, path: Path) -> None:
        """Write people, courses and exercises for another station, beside the window."""
        if not self._doors.may():
            return
        folder, people = self._doors.folder, self._doors.people
        saved = tr("Saved {name}", name=str(path))
        self._doors.beside(
            lambda progress: write_course(path, folder, people=people, progress=progress),
            lambda _: self._doors.note(saved),
            tr("Writing the course for a station"),
        )

    def _place(self, title: str, name: str) -> Path | None:
        if not self._doors.may():
            return None
        start = str(_documents() / name)
        path = QFileDialog.getSaveFileName(self._doors.parent(), title, start, _kind())[0]
        return Path(path) if path else None


def summary_words(gathered: Gathered) -> str:
    """Return what came of files, a line for each thing."""
    lines: list[str] = []
    for one in gathered.taken:
        lines.append(
            tr_n(
                "{station}: {n} attempt added, {m} here already",
                "{station}: {n} attempts added, {m} here already",
                one.attempts,
                station=one.station,
                m=one.present,
            )
        )
        counts = (
            (tr("remarks: {n}", n=one.remarks), one.remarks),
            (tr("new students: {n}", n=one.people), one.people),
            (tr("new courses: {n}", n=one.courses), one.courses),
            (tr("persons erased: {n}", n=one.erased), one.erased),
            (tr("left out as erased: {n}", n=one.left_out), one.left_out),
        )
        more = ", ".join(words for words, count in counts if count)
        lines += [f"  {more}"] if more else []
        lines += [f"  {tr('left out: {line}', line=line)}" for line in one.different]
    lines += [translated(line) for line in told_of(gathered.taken)]
    lines += [translated(error) for error in gathered.refused]
    return "\n".join(lines)


def _kind() -> str:
    return tr("Files of stations (*.acus)")


def _documents() -> Path:
    documents = QStandardPaths.StandardLocation.DocumentsLocation
    return Path(QStandardPaths.writableLocation(documents))
