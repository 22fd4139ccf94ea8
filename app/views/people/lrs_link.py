"""The learning record store in the window: told of attempts while nobody practises."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

from PySide6.QtCore import QObject, QTime, QTimer, Signal

from app.core.errors import AcusError
from app.core.messages import sentence_of
from app.core.progress import Progress
from app.exchange.lrs import (
    Backoff,
    Delivered,
    Lrs,
    LrsPlace,
    UnreachableLrsError,
    deliver,
    place_of_lrs,
    put_lrs,
    tell_attempts,
)
from app.exchange.results import Results
from app.session.audit import PROGRAM
from app.session.board import board_of
from app.session.statement_queue import FOLDER, StatementQueue
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.text import tr, tr_n, translated
from app.views.people.dialogs import EntryDialog
from app.views.people.stations import StationDoors

EVERY_MS: Final = 60_000
"""So often what waits is looked at [ms]; after a failure later, as `Backoff` says."""

_SOON_MS: Final = 4_000


@dataclass(frozen=True)
class _NotSent:
    error: AcusError
    waiting: int

    @property
    def asked(self) -> float:
        return self.error.wait if isinstance(self.error, UnreachableLrsError) else 0.0


class LrsLink(QObject):
    """Tells a record store of attempts, quietly, and on request aloud.

    Nothing is sent by a station that was not told where its record store is.

    Signals:
        told(str): how it stands, for a line on the board; empty for a station without one.

    Args:
        doors: of the page of people.
        titles: returns those of exercises, by id.
        busy: returns whether an attempt runs, which nothing may disturb.
        parent: the window's object that it lives with.
        backoff: when to try again after a failure.
    """

    told = Signal(str)

    def __init__(
        self,
        doors: StationDoors,
        titles: Callable[[], Mapping[str, str]],
        busy: Callable[[], bool],
        parent: QObject,
        backoff: Backoff | None = None,
    ) -> None:
        super().__init__(parent)
        self._doors, self._titles, self._busy = doors, titles, busy
        self._backoff, self._not_before = backoff or Backoff(), 0.0
        self._queue = StatementQueue(doors.people.folder / FOLDER)
        self._look = True
        self._task: BackgroundTask | None = None
        self._timer = QTimer(self, interval=EVERY_MS)
        self._timer.timeout.connect(self.quietly)
        self._timer.start()
        QTimer.singleShot(_SOON_MS, self, self.quietly)

    def soon(self) -> None:
        """Look for new attempts in a moment: one has ended, or something was said of one."""
        self._look = True
        QTimer.singleShot(_SOON_MS, self, self.quietly)

    def quietly(self) -> None:
        """Send what is new, unless an attempt runs, it is being done, or it is too early."""
        if self._busy() or self._task is not None or time.monotonic() < self._not_before:
            return
        place = self._place()
        if place is None:
            self.told.emit("")
            return
        self._task = run_in_background(
            self, self._work(place, PROGRAM), self._done_quietly, self._failed
        )
        self._task.finished.connect(self._ended)

    def now(self) -> None:
        """Send what is new, with progress, and say what came of it."""
        if not self._doors.may():
            return
        place = self._place()
        if place is None:
            self.connect_lrs()
            return
        self._look = True

        def done(result: Delivered | _NotSent) -> None:
            self._done_quietly(result)
            title = tr("Record store")
            if isinstance(result, _NotSent):
                self._doors.tell(title, translated(result.error), _waiting(result.waiting))
                return
            words = tr_n("{n} statement sent.", "{n} statements sent.", result.sent)
            self._doors.tell(title, words, "\n".join(map(translated, result.refused)))

        self._doors.beside(self._work(place), done, tr("Telling the record store"))

    def connect_lrs(self) -> None:
        """Ask where the record store is, and as whom it is told; empty ends it."""
        if self._doors.may():
            self._ask(self._place() or LrsPlace("", ""))

    def close(self) -> None:
        """Send no more, and wait a moment for what runs; idempotent."""
        self._timer.stop()
        if self._task is not None:
            self._task.close()

    # --- inside -----------------------------------------------------------------------------------
    def _ask(self, known: LrsPlace, trouble: str = "") -> None:
        words = tr(
            "A learning record store (LRS) is told who, by pseudonym, passed which exercise, with "
            "the score. Its address stands before /statements; empty: nothing is told. Ids begin "
            "with an address that you own."
        )

        def take(endpoint: str, home: str, user: str, password: str) -> None:
            place = LrsPlace(endpoint.strip(), home.strip(), user.strip(), password)
            self._take_place(place.checked() if place.endpoint else None)

        fields = (
            (tr("Address"), False),
            (tr("Ids begin with"), False),
            (tr("User"), False),
            (tr("Password"), True),
        )
        parent = self._doors.parent()
        dialog = EntryDialog(tr("Record store"), fields, take, words, parent)
        texts = (known.endpoint, known.home, known.user, known.password)
        for line, text in zip(dialog.lines, texts, strict=True):
            line.setText(text)
        self._doors.open(dialog)
        if trouble:
            dialog.say(trouble)

    def _take_place(self, place: LrsPlace | None) -> None:
        folder = self._doors.people.folder

        def work(_: Progress) -> str:
            if place is not None:
                try:
                    Lrs(place).about()
                except AcusError as error:
                    return sentence_of(error)
            put_lrs(place, folder)
            return ""

        def done(trouble: str) -> None:
            self._not_before = 0.0
            if trouble and place is not None:
                self._ask(place, translated(trouble))
            elif place is not None:
                self.now()
            else:
                self.told.emit("")

        self._doors.beside(work, done, tr("Asking the record store"))

    def _place(self) -> LrsPlace | None:
        try:
            return place_of_lrs(self._doors.people.folder)
        except AcusError as error:
            self.told.emit(translated(error))
            return None

    def _work(self, place: LrsPlace, by: str = "") -> Callable[[Progress], Delivered | _NotSent]:
        titles, look = dict(self._titles()), self._look
        self._look = False

        def work(progress: Progress) -> Delivered | _NotSent:
            try:
                if look:
                    tell_attempts(self._results(titles, progress), place, self._queue)
                return deliver(place, self._queue, progress, by)
            except AcusError as error:
                self._look = self._look or look  # what was not looked at is looked at again
                return _NotSent(error, len(self._queue.waiting()))

        return work

    def _results(self, titles: Mapping[str, str], progress: Progress) -> Results:
        """Return all attempts of this station; called beside the window."""
        folder, people = self._doors.folder, self._doors.people
        board, attempts = board_of(folder, people, None, "", None, progress)
        known = {person.key: person for person in people.everybody()}
        return Results(board, attempts, known, people.remarks(), {}, titles=titles)

    def _done_quietly(self, result: Delivered | _NotSent) -> None:
        if isinstance(result, _NotSent):
            self._not_before = time.monotonic() + self._backoff.failed(result.asked)
            line = translated(result.error)
            parts = (f"{line[:1].upper()}{line[1:]}.", _waiting(result.waiting))
            self.told.emit(" ".join(filter(None, parts)))
            return
        if result.refused:
            self._not_before = time.monotonic() + self._backoff.failed()
        else:
            self._backoff.worked()
            self._not_before = 0.0
        clock = QTime.currentTime().toString("HH:mm")
        told = tr("Record store: told at {time}", time=clock)
        self.told.emit(" · ".join((told, *map(translated, result.refused[:1]))))

    def _failed(self, error: Exception) -> None:
        self._not_before = time.monotonic() + self._backoff.failed()
        self.told.emit(translated(error))

    def _ended(self) -> None:
        self._task = None


def _waiting(number: int) -> str:
    """Return how many statements wait; empty where none does."""
    if not number:
        return ""
    return tr_n("{n} statement waits to be sent.", "{n} statements wait to be sent.", number)
