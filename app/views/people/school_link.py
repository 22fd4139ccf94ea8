"""The school's store in the window: connected to, and kept up to date while nobody practises."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from typing import Final

from PySide6.QtCore import QObject, QTime, QTimer, Signal
from PySide6.QtWidgets import QCheckBox, QMessageBox

from app.core.errors import AcusError
from app.core.messages import sentence_of
from app.core.progress import Progress
from app.session.audit import PROGRAM
from app.session.errors import PeopleError, SessionError
from app.session.school_store import (
    StoreError,
    StorePlace,
    Synchronised,
    place_of_store,
    put_place,
    require_password,
    synchronise,
)
from app.session.school_store.synchronising import waiting
from app.session.station import StationKey
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import message_box
from app.views.kit.text import tr, tr_n, translated
from app.views.people.dialogs import EntryDialog
from app.views.people.stations import Gathered, StationDoors, summary_words

EVERY_MS: Final = 60_000
"""So often the store is looked at [ms]."""

_SOON_MS: Final = 3_000


@dataclass(frozen=True)
class NotReached:
    """Why nothing was exchanged, or not all.

    Attributes:
        error: what the store says, or its silence.
        waiting: attempts that are still to be sent.
    """

    error: SessionError
    waiting: int

    def words(self) -> str:
        """Return both in one line."""
        line = translated(self.error)
        return " ".join(filter(None, (f"{line[:1].upper()}{line[1:]}.", self.waiting_words())))

    def waiting_words(self) -> str:
        """Return how many attempts wait; empty where none does."""
        if not self.waiting:
            return ""
        return tr_n("{n} attempt waits to be sent.", "{n} attempts wait to be sent.", self.waiting)


class SchoolLink(QObject):
    """Keeps this station and the school's store together, quietly, and on request aloud.

    Signals:
        told(str): how it stands, for a line on the board; empty for a station without a store.

    Args:
        doors: of the page of people.
        busy: returns whether an attempt runs, which nothing may disturb.
        parent: the window's object that it lives with.
    """

    told = Signal(str)

    def __init__(self, doors: StationDoors, busy: Callable[[], bool], parent: QObject) -> None:
        super().__init__(parent)
        self._doors, self._busy = doors, busy
        self._task: BackgroundTask | None = None
        self._timer = QTimer(self, interval=EVERY_MS)
        self._timer.timeout.connect(self.quietly)
        self._timer.start()
        QTimer.singleShot(_SOON_MS, self, self.quietly)

    # --- quietly ----------------------------------------------------------------------------------
    def soon(self) -> None:
        """Look at the store in a moment: an attempt has ended, or something was said of one."""
        QTimer.singleShot(_SOON_MS, self, self.quietly)

    def quietly(self) -> None:
        """Exchange what is new, unless an attempt runs or it is being done already."""
        if self._busy() or self._task is not None:
            return
        place = self._place()
        if place is None:
            self.told.emit("")
            return

        def work(progress: Progress) -> Synchronised | NotReached:
            return self._exchange(place, False, progress, PROGRAM)

        self._task = run_in_background(self, work, self._done_quietly, self._failed)
        self._task.finished.connect(self._ended)

    def close(self) -> None:
        """Look no more, and wait a moment for what runs; idempotent."""
        self._timer.stop()
        if self._task is not None:
            self._task.close()

    # --- on request -------------------------------------------------------------------------------
    def connect_store(self) -> None:
        """Ask where the store is, and connect to it."""
        if not self._doors.may():
            return
        try:
            require_password(self._doors.people)
        except StoreError as error:
            self._doors.tell(tr("The school's store"), translated(error), "")
            return
        self._ask(self._place() or StorePlace("", pins=True))

    def _ask(self, known: StorePlace, trouble: str = "") -> None:
        words = tr(
            "The database that the stations of a school share: postgresql+psycopg://user:"
            "password@host/name, or sqlite:////folder/file.sqlite on a share. Empty: none."
        )
        gives = QCheckBox(tr("Students and courses of this station go there"))
        pins = QCheckBox(tr("With their PINs, as hashes"))

        def take(url: str) -> None:
            place = replace(
                known, url=url.strip(), gives_course=gives.isChecked(), pins=pins.isChecked()
            )
            if place.url:
                place.store().name  # noqa: B018 - says what is wrong with a URL
            self._take_place(place)

        parent = self._doors.parent()
        dialog = EntryDialog(tr("The school's store"), ((tr("URL"), False),), take, words, parent)
        for box, on in ((gives, known.gives_course), (pins, known.pins)):
            box.setParent(dialog)
            box.setChecked(on)
            dialog.form.wide(box)
        dialog.lines[0].setText(known.url)
        self._doors.open(dialog)
        if trouble:
            dialog.say(trouble)

    def now(self, trust: bool = False) -> None:
        """Exchange what is new, with progress, and say what came of it.

        Args:
            trust: let stations in that are not known here; else it is asked.
        """
        if not self._doors.may():
            return
        place = self._place()
        if place is None:
            self.connect_store()
            return

        def done(result: Synchronised | NotReached) -> None:
            if isinstance(result, NotReached):
                self.told.emit(result.words())
                words = translated(result.error)
                self._doors.tell(tr("The school's store"), words, result.waiting_words())
            else:
                self._show(result)

        title = tr("Exchanging with the school's store")
        self._doors.beside(lambda progress: self._exchange(place, trust, progress), done, title)

    # --- inside -----------------------------------------------------------------------------------
    def _place(self) -> StorePlace | None:
        try:
            return place_of_store(self._doors.people.folder)
        except AcusError as error:
            self.told.emit(translated(error))
            return None

    def _take_place(self, place: StorePlace) -> None:
        folder = self._doors.people.folder

        def work(_: Progress) -> str:
            if place.url:
                try:
                    with closing(place.store()) as store:
                        store.open()
                except StoreError as error:
                    return sentence_of(error)
            put_place(place if place.url else None, folder)
            return ""

        def done(trouble: str) -> None:
            if trouble:
                self._ask(place, translated(trouble))
            elif place.url:
                self.now()
            else:
                self.told.emit("")

        self._doors.beside(work, done, tr("Connecting to the school's store"))

    def _exchange(
        self, place: StorePlace, trust: bool, progress: Progress, by: str = ""
    ) -> Synchronised | NotReached:
        """Exchange what is new; called beside the window."""
        folder, people = self._doors.folder, self._doors.people
        try:
            return synchronise(place, folder, people, trust, progress, by)
        except SessionError as error:
            number = 0
            with suppress(AcusError):
                number = waiting(people, StationKey.of(people.folder))
            return NotReached(error, number)

    def _done_quietly(self, result: Synchronised | NotReached) -> None:
        if isinstance(result, NotReached):
            self.told.emit(result.words())
            return
        self._tell_state(result)
        got = result.gathered
        if got.attempts or got.remarks or got.people or got.courses or got.erased:
            self._doors.changed()

    def _failed(self, error: Exception) -> None:
        self.told.emit(translated(error))

    def _ended(self) -> None:
        self._task = None

    def _tell_state(self, result: Synchronised) -> None:
        left = len(result.unknown)
        clock = QTime.currentTime().toString("HH:mm")
        parts = [tr("School's store: up to date at {time}", time=clock)]
        if left:
            parts.append(
                tr_n(
                    "{n} station waits to be let in: Stations, Exchange … now",
                    "{n} stations wait to be let in: Stations, Exchange … now",
                    left,
                )
            )
        if result.refused:
            parts.append(tr_n("{n} left out", "{n} left out", len(result.refused)))
        self.told.emit(" · ".join(parts))

    def _show(self, result: Synchronised) -> None:
        self._tell_state(result)
        self._doors.changed()
        got = replace(result.gathered, station=tr("From other stations"))
        lines = summary_words(Gathered((got,), tuple(map(PeopleError, result.refused)), ()))
        if not result.unknown:
            sent = tr("What was new here has been sent.")
            nothing = tr("Nothing was waiting to be sent.")
            self._doors.tell(tr("The school's store"), sent if result.sent else nothing, lines)
            return
        strange = "\n".join(f"{one.name}: {one.fingerprint}" for one in result.unknown)
        words = tr("Compare each with Stations, This station… there.") + f"\n\n{strange}"
        title = tr("The school's store")
        box = message_box(self._doors.parent(), title, tr("Let these stations in?"), words)
        accept = box.addButton(tr("Let them in"), QMessageBox.ButtonRole.AcceptRole)
        box.setDefaultButton(box.addButton(QMessageBox.StandardButton.Cancel))
        box.buttonClicked.connect(
            lambda clicked: self.now(trust=True) if clicked is accept else None
        )
        self._doors.open(box)
