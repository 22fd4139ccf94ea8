"""Attempts that are over: the debrief of one, the list of all, their reports, tables and past
scans.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Final

from PySide6.QtCore import QObject, QStandardPaths, QTimer, Signal, SignalInstance
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QApplication,
    QDialog,
    QFileDialog,
    QMenu,
    QMessageBox,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.core.files import write_atomically
from app.core.loading import turn
from app.core.progress import Progress
from app.exchange.csv_export import score_table, trajectory_table, write_csv
from app.exercises.drill import ROUNDS, DrillKind
from app.exercises.drilled import drilled
from app.exercises.schema import Exercise
from app.imaging.volume import Volume
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.scoring.conditions import DeviceKind
from app.session.conditions import POINTERS
from app.session.control_scan import ControlScan
from app.session.errors import SessionError
from app.session.expert_beside import expert_beside
from app.session.interrupted import interrupted
from app.session.motion import ShownMotion, show_expert
from app.session.next_exercise import Around, around, held_by
from app.session.people import People
from app.session.recording import open_recording
from app.session.result import AttemptResult
from app.session.review import Review, review, review_of_result
from app.session.roster import looks_like_a_key
from app.session.store import computed, find, verdict_of
from app.session.summary import Summary
from app.views.debrief.gathering import Gathering
from app.views.debrief.page import DebriefPage
from app.views.debrief.replay import Ghost
from app.views.debrief.report import report_bytes
from app.views.debrief.score_words import hand_word
from app.views.debrief.sessions import SessionsPage
from app.views.exercise.conductor import Conductor
from app.views.exercise.readouts import clock_text
from app.views.exercise.scan_view import ScanView, caption
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.names import NAMES
from app.views.kit.parts import message_box, size_dialog
from app.views.kit.roles import EVERYBODY, STAFF, Role
from app.views.kit.text import date_text, declared, tr, tr_n, translated
from app.views.shell.feature import Context, Feature
from app.views.structures.layer import draw_in

if TYPE_CHECKING:
    from app.session.index import Indexed

AskPath = Callable[[QWidget, str, str, str], str]
"""Asks where to save: parent, title, suggested path, filter; an empty answer means no."""


class DebriefController(QObject):
    """Connects debrief page and sessions page with the folder of records.

    Signals:
        shown(): the debrief page shows an attempt; bring it to the front.
        replayed(): it can be replayed; its CT is to be found.
        saved(str): a file was written there.
        noted(str): something else worked.
        failed(str): something did not work, in one line.
    """

    shown = Signal()
    replayed = Signal()
    saved = Signal(str)
    noted = Signal(str)
    failed = Signal(str)

    def __init__(
        self,
        page: DebriefPage,
        sessions: SessionsPage,
        folder: Path,
        ask_path: AskPath | None = None,
        parent: QObject | None = None,
        exercises: Callable[[], Sequence[Exercise]] = tuple,
        indicator: Indicator | None = None,
        held_at_hub: Callable[[], bool] = lambda: False,
    ) -> None:
        super().__init__(parent)
        self._page = page
        self._sessions = sessions
        self._folder = folder
        self._ask_path = ask_path or ask_path_in_dialog
        self._exercises, self._indicator, self._held_at_hub = exercises, indicator, held_at_hub
        self._reading: BackgroundTask | None = None
        self._shown: Review | None = None
        self._asked = self._asked_ghost = 0
        self.exercise = ""
        page.report_requested.connect(self.save_report)
        page.export_requested.connect(self.export_one)
        page.ghost_wanted.connect(self.show_ghost)
        sessions.open_requested.connect(lambda summary: self.open_session(summary.id))
        sessions.export_requested.connect(self.export_list)
        sessions.failed.connect(self.failed)
        page.remarks.failed.connect(self._fail)
        for speaks in (page.remarks, sessions):
            speaks.noted.connect(self.noted)
        page.said.connect(self.look_again)

    def show_result(self, result: AttemptResult) -> None:
        """Show an attempt that has just finished."""
        self._read(lambda: review_of_result(result))

    def go_on(self, other: DebriefController) -> None:
        """Show the attempt that another window's debrief shows, if it shows one."""
        shown, self.exercise = other._shown, other.exercise
        if shown is not None:
            self._read(lambda: shown)

    def open_session(self, session_id: str) -> None:
        """Show a recorded session."""
        self._read(lambda: review(open_recording(find(self._folder, session_id))))

    def show_ghost(self, key: object) -> None:
        """Let the ideal path, another attempt or nothing stand beside the one that is shown."""
        self._asked_ghost += 1
        asked, own = self._asked_ghost, self._page.review
        if key is None or own is None:
            self._page.show_ghost(None)
            return
        if key == IDEAL:
            self._page.show_ghost(Ghost(tr("ideal")))
            return
        if key == EXPERT:
            self._show_expert(own, asked)
            return

        def take(other: Review) -> None:
            if asked == self._asked_ghost and self._page.review is own:
                self._page.show_ghost(Ghost(points_text(other), other))

        run_in_background(
            self,
            lambda _: review(open_recording(find(self._folder, str(key)))),
            take,
            self._fail,
            title=tr("Reading the other attempt"),
            indicator=self._indicator,
        )

    def _show_expert(self, own: Review, asked: int) -> None:
        """Let the expert's way along the same plan stand beside the attempt."""

        def take(expert: Review | None) -> None:
            if expert is not None and asked == self._asked_ghost and self._page.review is own:
                self._page.show_ghost(Ghost(tr("expert"), expert))

        run_in_background(self, lambda _: expert_beside(own), take, self._fail)

    # --- drills -----------------------------------------------------------------------------------
    def wanted_drill(self, rounds: int = 0) -> DrillKind | None:
        """Return the drill that the attempt which is shown calls for; None where none may be begun.

        Args:
            rounds: of a drill that is repeated, how many are done today.
        """
        shown = self._shown
        if shown is None or shown is not self._page.review or self._whole() is None:
            return None
        if shown.drill is None:
            return shown.practise
        is_over = shown.score is not None and shown.score.passed
        if shown.drill.kind is DrillKind.REPEAT:
            is_over = rounds >= ROUNDS
        return None if is_over else shown.drill.kind

    def drill(self, kind: DrillKind) -> Exercise | None:
        """Return the exercise of the attempt as a drill on its plan; None where that cannot be."""
        shown, whole = self._shown, self._whole()
        return None if shown is None or whole is None else drilled(whole, kind, shown.placed)

    def _is_by_pointer(self) -> bool:
        """Return whether a simulated hand led the needle, and leads it here now."""
        under = None if self._shown is None else self._shown.conditions
        if under is None or under.kind is not DeviceKind.SIMULATED or self._held_at_hub():
            return False
        return under.hand in POINTERS

    def _whole(self) -> Exercise | None:
        """Return the exercise that was attempted, as it is today; None where it is another, or none
        that may be practised.
        """
        shown = self._shown
        under = None if shown is None else shown.conditions
        if shown is None or under is None or ACCESS.drill_refusal(self.whole):
            return None
        version = under.version if shown.drill is None else shown.drill.version
        there = (one for one in self._exercises() if one.id == self.whole)
        return next((one for one in there if one.version == version), None)

    @property
    def whole(self) -> str:
        """Return the exercise that was attempted, or that a drill is of; empty without one."""
        drill = None if self._shown is None else self._shown.drill
        return self.exercise if drill is None else drill.of

    def save_report(self, shown: Review) -> None:
        """Ask where, and write the report."""
        path = self._ask(tr("Save report"), f"acus-{shown.id}.pdf", tr("PDF (*.pdf)"), ".pdf")
        if path is not None:
            shown = self._with_verdict(shown)
            data = report_bytes(shown)  # Qt draws it, so it is drawn on the window's thread
            self._save(path, lambda: write_atomically(path, data))

    def _with_verdict(self, shown: Review) -> Review:
        """Let a report say where this station does not vouch for the record."""
        try:
            verdict = verdict_of(find(self._folder, shown.id))
        except SessionError:
            return shown  # the record has gone: what is shown is from memory
        if verdict.partition(" (")[0] == "verified":
            return shown
        words = tr("not verified: the record is {verdict}", verdict=verdict)
        return replace(shown, problems=(words, *shown.problems))

    def export_one(self, shown: Review) -> None:
        """Ask where, and write one attempt over time as a table."""
        path = self._ask(tr("Export attempt"), f"acus-{shown.id}.csv", tr("CSV (*.csv)"), ".csv")
        if path is not None:
            self._save(path, lambda: write_csv(path, self._trajectory(shown.id)))

    def export_list(self, summaries: Sequence[Summary]) -> None:
        """Ask where, and write the scores of these sessions as a table."""
        path = self._ask(tr("Export sessions"), "acus-sessions.csv", tr("CSV (*.csv)"), ".csv")
        if path is not None:
            self._save(path, lambda: write_csv(path, self._scores(summaries)))

    # --- inside -----------------------------------------------------------------------------------
    def _read(self, operation: Callable[[], Review]) -> None:
        """Read an attempt beside the window, and show it; a newer wish replaces one under way."""
        if self._reading is not None and self._reading.is_running():
            self._reading.drop()

        manages = ACCESS.may_manage

        def read(progress: Progress) -> tuple[Review, str, str]:
            progress.report(0.1, "")
            found = operation()
            progress.report(0.9, "")
            return with_remarks(found), *_for(manages, held_by(found))

        self._reading = task = BackgroundTask(
            self, read, lambda found: self._show(*found), self._fail
        )
        if self._indicator is not None:
            self._indicator.show_task(task, tr("Reading the attempt"))
        task.open()

    def follow_access(self) -> None:
        """Somebody else is here: show the attempt only as far as he may see it."""
        shown = self._shown
        if shown is None:
            return
        if not ACCESS.may_see(shown.student):
            self._asked += 1
            self._page.show_held(
                shown,
                tr("This attempt is another one's: sign in as who made it, or as the instructor."),
            )
            return
        self._page.follow_access()

        def take(held: str) -> None:
            if self._shown is shown and ACCESS.may_see(shown.student):
                self._put(shown, *_for(ACCESS.may_manage, held))

        run_in_background(self, lambda _: held_by(shown), take, self._fail)

    def look_again(self) -> None:
        """Look what the instructor says now of the attempt that is shown."""
        shown = self._shown
        if shown is None:
            return

        def take(both: tuple[Review, str]) -> None:
            found, held = both
            if self._shown is shown:
                self._shown = found
                if self._page.review is not None:
                    self._page.show_said(found, held)

        run_in_background(self, lambda _: (with_remarks(shown), held_by(shown)), take, self._fail)

    def _show(self, shown: Review, held: str, waits: str = "") -> None:
        self._reading, self._shown = None, shown
        self.exercise = shown.conditions.exercise if shown.conditions is not None else ""
        self._put(shown, held, waits)
        self.shown.emit()

    def _put(self, shown: Review, held: str, waits: str = "") -> None:
        """Put an attempt on the page, or say who releases its result.

        Args:
            shown: the attempt.
            held: title of the course that holds its result back from who is here.
            waits: of the one that holds it back from others.
        """
        if held:
            self._page.show_held(
                shown,
                tr(
                    "This attempt is an assessment (course: {course}). The instructor releases its "
                    "result; until then neither score nor replay is shown here.",
                    course=held,
                ),
            )
        else:
            if self._page.review is not shown:
                self._page.show_review(shown)
                self.replayed.emit()
            self._page.show_said(shown, waits)
        self._look_around(shown, bool(held))

    def _look_around(self, shown: Review, held: bool) -> None:
        """Find beside the window what comes next, and what may stand beside the attempt."""
        self._asked += 1
        asked, exercises, may_see = self._asked, tuple(self._exercises()), ACCESS.may_see
        manages, refusal = ACCESS.may_manage, ACCESS.refusal

        def look(_: Progress) -> Around:
            return around(self._folder, shown, held, exercises, manages, may_see, refusal)

        def take(result: Around) -> None:
            if asked != self._asked:
                return  # another attempt by now
            self._page.show_proposal(result.proposal)
            if not held:
                rounds = result.proposal.tries if shown.drill is not None else 0
                self._page.offer_drill(self.wanted_drill(rounds), rounds, self._is_by_pointer())
                self._page.offer_ghosts(ghost_words(result.rivals, shown), EXPERT)

        run_in_background(self, look, take, self._fail)

    def _ask(self, title: str, name: str, kind: str, suffix: str) -> Path | None:
        documents = QStandardPaths.StandardLocation.DocumentsLocation
        start = Path(QStandardPaths.writableLocation(documents)) / name
        answer = self._ask_path(self._page, title, str(start), kind)
        if not answer:
            return None
        path = Path(answer)
        return path if path.suffix else path.with_suffix(suffix)

    def _trajectory(self, session_id: str) -> str:
        return trajectory_table(open_recording(find(self._folder, session_id)))

    def _scores(self, summaries: Sequence[Summary]) -> str:
        """Table of scores, each computed from its record; what has gone stays as it was listed."""
        return score_table([self._computed(summary) for summary in summaries])

    def _computed(self, summary: Summary) -> Summary:
        try:
            return computed(self._folder, [summary.id])[0]
        except SessionError:
            return summary

    def _save(self, path: Path, write: Callable[[], None]) -> None:
        run_in_background(self, lambda _: write(), lambda _: self.saved.emit(str(path)), self._fail)

    def _fail(self, error: Exception) -> None:
        if isinstance(error, OSError):
            self.failed.emit(
                tr(
                    "Cannot write {file}: {why}",
                    file=error.filename or "",
                    why=error.strerror or "",
                )
            )
        else:
            self.failed.emit(translated(error))


def _for(manages: bool, held: str) -> tuple[str, str]:
    """Return the title of a course that holds a result back from who is here, and from others."""
    return ("", held) if manages else (held, "")


def with_remarks(result: Review) -> Review:
    """Return an attempt with what the instructor says of it; called beside the window.

    Raises:
        SessionError: if the list of people cannot be read.
    """
    said = People().remarks().get(result.id, result.said)
    return result if said == result.said else replace(result, said=said)


def ask_path_in_dialog(parent: QWidget, title: str, start: str, kind: str) -> str:
    """Ask with Qt's file dialog; it asks before it overwrites."""
    return QFileDialog.getSaveFileName(parent, title, start, kind)[0]


EXPERT: Final = "expert"
"""Key of the expert's way; it stands beside an attempt until somebody chooses otherwise."""

IDEAL: Final = "ideal"
"""Key of the ideal path among what may stand beside an attempt."""


def ghost_words(result: Sequence[tuple[Indexed, bool]], shown: Review) -> list[tuple[object, str]]:
    """Name what may stand beside an attempt: the ideal path, the own best, the others."""
    choices: list[tuple[object, str]] = []
    if shown.motion is not None and not shown.touches:
        choices.append((EXPERT, tr("the expert, along your plan")))
    if shown.motion is not None:
        choices.append((IDEAL, tr("the ideal path")))
    best = True
    for one, own in result:
        total, date = f"{one.total or 0.0:.0f}", date_text(one.started)
        if not one.conditions.by_person:
            who = hand_word(one.conditions)
            words = tr("{who}: {total} ({date})", who=who, total=total, date=date)
        elif own and best:
            words, best = tr("own best: {total} ({date})", total=total, date=date), False
        elif own:
            words = tr("own: {total} ({date})", total=total, date=date)
        else:
            who = NAMES.shown(ACCESS.shown(one.student))
            words = tr("{who}: {total} ({date})", who=who, total=total, date=date)
        choices.append((one.id, words))
    return choices


def points_text(other: Review) -> str:
    """Say which attempt a ghost is, in short."""
    total = other.score.total if other.score is not None else None
    return tr("ghost") if total is None else tr("ghost, {total:.0f} points", total=total)


class AttemptCt(QObject):
    """Finds the CT of the attempt that is shown: the open one if it is the same, else none.

    It is known by the digest in the record, of older records by pseudonym and frame of reference.
    """

    def __init__(self, page: DebriefPage, context: Context, exercise: Callable[[], str]) -> None:
        super().__init__(page)
        self._page, self._context, self._exercise = page, context, exercise
        self._task: BackgroundTask | None = None
        self._come_back = False
        page.views.open_wanted.connect(self.open)
        context.conductor.patient_changed.connect(self._take_patient)
        for pane in page.views.panes:
            draw_in(pane.canvas, context.editors.structures)
        context.views.scene.surfaces_changed.connect(self._take_surfaces)
        context.patients.given_up.connect(self._stay)
        context.patients.failed.connect(lambda _: self._stay())

    def find(self) -> None:
        """Look whether the open CT is that of the attempt, beside the window."""
        self._drop()
        review, patient = self._page.review, self._context.conductor.patient
        views = self._page.views
        if review is None:
            return
        if patient is None:
            views.show_missing(
                tr("The CT of this attempt is not open: no slices, no 3D."), offer=True
            )
            return
        views.show_missing(tr("Looking whether the open CT is that of the attempt…"), offer=False)
        volume, facts = patient.volume, review.ct

        def look(progress: Progress) -> Volume | None:
            if facts.is_of(volume):
                return volume
            recipe, own = facts.recipe, volume.series.pseudonym
            if recipe is None or recipe == volume.recipe or facts.pseudonym != own:
                return None
            with turn(progress, "app.imaging.reading"):  # compiled parts: beside the window
                from app.imaging.reading import read_again
            again = read_again(volume.series, recipe, progress)
            return again if facts.is_of(again) else None

        self._task = run_in_background(
            self,
            look,
            self._show,
            self._fail,
            lambda: self._show(None),
            title=tr("Looking at the CT of the attempt"),
            indicator=self._context.shell.progress,
        )

    def open(self) -> None:
        """Open the CT of the attempt: where its exercise has it, else wherever the user says."""
        patients = self._context.patients
        wanted = self._exercise()
        known = {one.id: one for one in self._context.services.exercises()}
        self._come_back = True
        ct = known[wanted].ct if wanted in known else None
        if ct is not None and ct.phantom is not None:
            patients.open_phantom(ct.phantom.seed)
        elif ct is not None and ct.folder is not None:
            patients.open_folder(ct.folder, ct.series, ct.remedy)
        else:
            patients.ask()

    def forget(self) -> None:
        """Let go of the patient who leaves."""
        self._drop()
        self._page.views.forget()
        self._page.views.show_missing(
            tr("The CT of this attempt is not open: no slices, no 3D."), offer=True
        )

    def close(self) -> None:
        """End what runs; idempotent."""
        self._drop()
        self._page.views.close_views()

    # --- inside -----------------------------------------------------------------------------------
    def _show(self, volume: Volume | None) -> None:
        self._task = None
        views, review = self._page.views, self._page.review
        if review is None:
            return
        if volume is None:
            views.show_missing(
                tr("The CT that is open is not the one of this attempt: no slices, no 3D."),
                offer=True,
            )
            return
        views.viewing.set_window(self._context.views.viewing.window)
        views.show_ct(volume)
        views.show_surfaces_of(self._context.views.scene)

    def _fail(self, error: Exception) -> None:
        self._task = None
        self._page.views.show_missing(translated(error), offer=True)

    def _take_patient(self) -> None:
        if self._page.review is not None:
            self.find()
        if self._come_back:  # the workspace comes to the front with a patient
            self._come_back = False
            QTimer.singleShot(0, self, lambda: self._context.shell.show_page(self._page))

    def _take_surfaces(self) -> None:
        self._page.views.show_surfaces_of(self._context.views.scene)

    def _stay(self) -> None:
        self._come_back = False

    def _drop(self) -> None:
        if self._task is not None and self._task.is_running():
            self._task.drop()
        self._task = None


class ScanPictures(QObject):
    """Opens a scan of the debrief, if the CT that it was taken of is open."""

    def __init__(self, page: DebriefPage, conductor: Conductor, indicator: Indicator) -> None:
        super().__init__(page)
        self._page, self._conductor, self._indicator = page, conductor, indicator
        self.dialog: QDialog | None = None
        page.scans.scan_wanted.connect(self.open)

    def open(self, scan: ControlScan) -> None:
        """Make the picture beside the window, then show it."""
        patient, review = self._conductor.patient, self._page.review
        if review is None:
            return
        pseudonym = review.ct.pseudonym
        known = patient is not None and pseudonym in ("", patient.volume.series.pseudonym)
        if patient is None or not known:
            self._conductor.failed.emit(
                tr(
                    "The slices are made of the CT that was scanned, {ct}: open it first",
                    ct=pseudonym or tr("which is not open"),
                )
            )
            return
        volume, recipe, tissue = patient.volume, review.ct.recipe, review.tissue

        def make(progress: Progress) -> Volume:
            with turn(progress, "app.imaging.reading", "app.imaging.scanned"):
                from app.imaging.field import from_bytes
                from app.imaging.reading import read_again
            ct = volume
            if recipe is not None and recipe != volume.recipe:  # the scan was of a mended one
                ct = read_again(volume.series, recipe, progress)
            field = from_bytes(tissue) if scan.inside is not None and tissue else None
            return scan.picture(ct, field)

        run_in_background(
            self,
            make,
            lambda picture: self._show(picture, scan),
            self._conductor.failed.emit,
            title=tr("Making the slices again"),
            indicator=self._indicator,
        )

    def _show(self, picture: Volume, scan: ControlScan) -> None:
        review = self._page.review
        if review is None:
            return
        self.dialog = dialog = QDialog(self._page)
        dialog.setWindowTitle(caption(scan, review.clock_at(scan.time)))
        size_dialog(dialog, 900, 700)
        view = ScanView(self._conductor.planning, dialog)
        view.show_scan(picture, scan, review.clock_at(scan.time))
        view.viewing.set_draft(DraftPlan.of(review.placed.plan))
        needle = scan.needle
        view.viewing.set_needle(
            NeedleOverlay(needle.hub_mm, needle.tip_mm, curve_mm=needle.corners_mm)
        )
        column = QVBoxLayout(dialog)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(view)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()


LOOK_AGAIN_MS: Final = 20_000
"""After this long it is looked once more whether a record was cut off that had just grown."""

_NAMED: Final = 5


class Interruptions(QObject):
    """Offers at the start of the program to recover attempts that were cut off.

    Args:
        sessions: the list, which recovers or discards.
        folder: of the records.
        parent: window; the question stands over it.
        busy: whether nobody may be asked now.

    Attributes:
        box: the question; None while there is none.
    """

    def __init__(
        self, sessions: SessionsPage, folder: Path, parent: QWidget, busy: Callable[[], bool]
    ) -> None:
        super().__init__(parent)
        self._sessions, self._folder, self._window, self._busy = sessions, folder, parent, busy
        self._looks, self._offered = 0, set[str]()
        self.box: QMessageBox | None = None

    def look(self) -> None:
        """Look beside the window; once more later where a record had just grown."""
        if self._looks:
            return
        self._look()

    def close(self) -> None:
        """Ask nothing more."""
        self._looks = 9
        if self.box is not None:
            self.box.close()

    def _look(self) -> None:
        if self._looks > 1:
            return
        self._looks += 1
        run_in_background(self, lambda _: interrupted(self._folder), self._take, self._nothing)

    def _nothing(self, _: Exception) -> None:
        """Say nothing: the list says what cannot be read."""

    def _take(self, both: tuple[list[Summary], bool]) -> None:
        found, fresh = both
        if fresh:
            QTimer.singleShot(LOOK_AGAIN_MS, self, self._look)
        self._offer([one for one in found if one.id not in self._offered])

    def _who(self, item: Summary) -> str:
        """Name who did an attempt, as far as who is here may know it, and it is known by now."""
        known = ACCESS.shown(item.student)
        if not ACCESS.may_see(item.student) or looks_like_a_key(known):
            return tr("a student")
        return NAMES.shown(known)

    def _offer(self, result: list[Summary]) -> None:
        """Ask what becomes of attempts; later, while somebody does one or is asked something."""
        if not result or self._looks == 9:
            return
        if self._busy() or self.box is not None:
            QTimer.singleShot(LOOK_AGAIN_MS, self, lambda: self._offer(result))
            return
        self._offered |= {one.id for one in result}
        lines = [
            "  ·  ".join(
                (
                    self._who(one),
                    declared(one.exercise_title) or one.exercise_id,
                    date_text(one.started),
                    clock_text(one.duration),
                )
            )
            for one in result[:_NAMED]
        ]
        if len(result) > _NAMED:
            lines.append(tr("and {n} more", n=len(result) - _NAMED))
        ended_in = tr_n(
            "The program ended in the middle of {n} attempt:",
            "The program ended in the middle of {n} attempts:",
            len(result),
        )
        keeps = tr(
            "Recover keeps what was recorded: it stays in the list as unfinished, without a score. "
            "Later changes nothing; the list of sessions offers it too."
        )
        more = "\n".join([*lines, "", keeps])
        self.box = box = message_box(self._window, tr("Interrupted attempts"), ended_in, more)
        box.setIcon(QMessageBox.Icon.Information)
        roles = QMessageBox.ButtonRole
        recovers = box.addButton(tr("Recover"), roles.AcceptRole)
        discards = box.addButton(tr("Discard"), roles.DestructiveRole)
        discards.setToolTip(tr("To the deleted ones; the instructor can bring it back"))
        discards.setVisible(ACCESS.may_manage)
        box.setEscapeButton(box.addButton(tr("Later"), roles.RejectRole))
        box.setDefaultButton(recovers)
        ids = [one.id for one in result]

        def answered(clicked: object) -> None:
            if clicked is recovers:
                self._sessions.recover_these(ids)
            elif clicked is discards:
                self._sessions.discard_these(ids)

        def ended() -> None:
            self.box = None
            box.deleteLater()

        box.buttonClicked.connect(answered)
        box.finished.connect(ended)
        box.open()


UNFOLDED: Final = "debrief/metrics"
"""Setting: whether the table of metrics is unfolded."""


class DebriefFeature(Feature):
    """Two pages: shown when an attempt ends, and from the menu.

    Signals:
        begin_wanted(str): begin this exercise: again, or as proposed.
        drill_wanted(Exercise): begin this drill.

    Attributes:
        page: the debrief.
        sessions: the list of past attempts.
        ct: finds the CT of the attempt that is shown.
        interruptions: offers to recover attempts that were cut off.
        gathering: offers attempts that lie in the source tree.
    """

    topic: ClassVar[str] = "debrief"
    place: ClassVar[int] = 170
    roles: ClassVar[frozenset[Role]] = EVERYBODY
    begin_wanted = Signal(str)
    drill_wanted = Signal(object)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        shell, folder = context.shell, context.services.sessions()
        self.page, self.sessions = DebriefPage(), SessionsPage(folder)
        for page in (self.page, self.sessions):
            shell.add_page(page)
        self._controller = DebriefController(
            self.page,
            self.sessions,
            folder,
            parent=self,
            exercises=context.services.exercises,
            indicator=shell.progress,
            held_at_hub=lambda: (run := context.runs.run) is not None and run.held_at_hub,
        )
        self.ct = AttemptCt(self.page, context, lambda: self._controller.exercise)
        self.scan_pictures = ScanPictures(self.page, context.conductor, shell.progress)
        self.interruptions = Interruptions(
            self.sessions,
            folder,
            shell.dialog_parent,
            lambda: (
                context.conductor.controller.is_running
                or QApplication.activeModalWidget() is not None
            ),
        )
        self._controller.failed.connect(lambda why: self.failed.emit(why))
        self._controller.noted.connect(self.noted)
        self._controller.saved.connect(lambda path: self.noted.emit(tr("Saved {name}", name=path)))
        self._controller.shown.connect(self.show)
        self._controller.replayed.connect(self.ct.find)
        ACCESS.changed.connect(self._controller.follow_access)
        self.page.retry_requested.connect(self.begin_again)
        self.page.next_requested.connect(self.begin_wanted)
        self.page.drill_wanted.connect(self.begin_drill)
        self.page.sessions_requested.connect(self._show_list)
        self.page.fold.setChecked(str(shell.settings.value(UNFOLDED, "")) == "true")
        self.page.fold.toggled.connect(
            lambda on: shell.settings.setValue(UNFOLDED, "true" if on else "false")
        )
        self._back: Callable[[], object] = context.leave_page
        self.sessions.closed.connect(self._leave_list)
        context.conductor.controller.finished.connect(self.show_result)
        menu = shell.menu(tr("&Sessions"))
        add_entries(menu, [(tr("Past sessions"), "F7", self.show_sessions)])
        with shell.made_for(STAFF):
            self.gathering = Gathering(menu, folder, shell.dialog_parent, self.sessions.refresh)
            self._choices = self._add_choices(menu)
        self.gathering.noted.connect(self.noted)
        self.gathering.failed.connect(self.failed)
        menu.aboutToShow.connect(self._offer_choices)
        for signal in (ACCESS.changed, self._controller.shown):
            signal.connect(self._offer_choices)
        self._offer_choices()

    def _add_choices(self, menu: QMenu) -> list[QAction]:
        return add_entries(
            menu,
            [
                (tr("Show this attempt as the demonstration"), "", self.choose_demonstration),
                (tr("Let the scripted expert show it again"), "", self.choose_expert),
            ],
        )

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._controller.saved, self.context.shell.page_changed)

    def forget(self) -> None:
        """Let go of the patient who leaves; the attempt stays."""
        self.ct.forget()

    def close(self) -> None:
        """End what runs; idempotent."""
        self.interruptions.close()
        self.ct.close()

    def begin_again(self) -> None:
        """Begin the exercise of the attempt once more; one that is not kept is still prepared."""
        shown = self.page.review
        if shown is not None and shown.drill is not None:
            self.begin_drill(shown.drill.kind)
            return
        taken, wanted = self.context.conductor.exercise, self._controller.exercise
        kept = {one.id for one in self.context.services.exercises()}
        if not wanted or (wanted not in kept and taken is not None and taken.id == wanted):
            self.context.shell.show_workspace()
        else:
            self.begin_wanted.emit(wanted)

    def begin_drill(self, kind: DrillKind) -> None:
        """Begin a drill of the exercise that was attempted, on the same plan."""
        drill, why = self._controller.drill(kind), ACCESS.drill_refusal(self._controller.whole)
        if drill is None:
            self.failed.emit(
                tr("It cannot be begun: {why}.", why=why)
                if why
                else tr("This exercise is no more what it was: begin it from the start page.")
            )
        else:
            self.drill_wanted.emit(drill)

    def choose_demonstration(self) -> None:
        """Let the attempt that the debrief shows be the demonstration of its exercise."""
        shown = self._demonstrable()
        if shown is None or shown.motion is None or shown.conditions is None:
            return
        under = shown.conditions
        try:
            ShownMotion.of(shown.motion, under.exercise, under.version).save()
        except (OSError, AcusError) as error:
            self.failed.emit(translated(error))
            return
        self.noted.emit(
            tr(
                "Show me now shows this attempt in {title}: its movement, without a name or score.",
                title=shown.exercise,
            )
        )

    def choose_expert(self) -> None:
        """Let the scripted expert show the exercise of the attempt again."""
        shown = self._demonstrable()
        if shown is None or shown.conditions is None:
            return
        try:
            show_expert(shown.conditions.exercise)
        except (OSError, AcusError) as error:
            self.failed.emit(translated(error))
            return
        self.noted.emit(tr("Show me shows the scripted expert in {title}.", title=shown.exercise))

    def _demonstrable(self) -> Review | None:
        """Return the attempt on the page, where who is here may choose what is shown."""
        return self.page.review if ACCESS.may_manage else None

    def _offer_choices(self) -> None:
        shown = self._demonstrable()
        take, expert = self._choices
        under = None if shown is None else shown.conditions
        take.setEnabled(shown is not None and shown.motion is not None and under is not None)
        kept = None if under is None else ShownMotion.kept(under.exercise, under.version)
        expert.setEnabled(kept is not None)

    def suit_room(self) -> None:
        """Take other colours and sizes; names are hidden, or shown again."""
        self.sessions.table.viewport().update()
        self.page.suit_room()

    def show(self) -> None:
        """Go to the attempt that the debrief shows; the keyboard replays it."""
        self.context.shell.show_page(self.page)
        self.page.bar.slider.setFocus()

    def go_on(self, other: DebriefFeature, page: QWidget | None) -> None:
        """Show what another window showed on `page`, where that is one of this feature's."""
        if page is other.page:
            self._controller.go_on(other._controller)
            self.show()
        elif page is other.sessions:
            self.show_sessions()

    def show_sessions(self) -> None:
        """Go to the past attempts."""
        self._back = self.context.leave_page
        self.sessions.show_only(None)
        self._show_list()

    def show_attempts(self, key: str, exercise: str, words: str, back: Callable[[], None]) -> None:
        """Go to the attempts of one student.

        Args:
            key: of the student.
            exercise: id; empty for all.
            words: say which attempts these are.
            back: where *Back* leads.
        """

        def only(item: Summary) -> bool:
            return ACCESS.owner(item.student) == key and exercise in ("", item.exercise_id)

        self._back = back
        self.sessions.show_only(only, words)
        self._show_list()

    def open_attempt(self, session_id: str) -> None:
        """Read an attempt, and show its debrief."""
        self._controller.open_session(session_id)

    def _leave_list(self) -> None:
        """Go back to where one came from; to the panes where that is closed by now."""
        self._back()
        if self.sessions.isVisible():
            self.context.leave_page()

    def _show_list(self) -> None:
        self.sessions.refresh()
        self.context.shell.show_page(self.sessions)
        self.sessions.table.setFocus()

    def show_result(self, result: AttemptResult) -> None:
        """Show the debrief of an attempt that ended."""
        self.context.editors.plan.set_locked(False)
        if self.sessions.isVisible():  # it lists the attempt as being recorded
            self.sessions.refresh()
        self._controller.show_result(result)
