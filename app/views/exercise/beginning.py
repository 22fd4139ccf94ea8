"""From the wish to begin an exercise to its attempt: briefing, demonstration, begin.

Whoever wants to begin (start page, menu, F5, course, debrief) comes to the briefing first. There
one begins, looks around before, has the exercise shown, or goes back. A scripted expert shows it,
or the movement of an attempt that the instructor chose. A demonstration runs in the same views on a
simulated robot; nothing of it is kept or counted.
"""

from __future__ import annotations

import datetime
from collections.abc import Callable, Mapping
from enum import Enum, auto
from pathlib import Path
from typing import Final

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QFrame, QHBoxLayout, QWidget

from app.core import state_vector as sv
from app.exercises.guidance import Purpose
from app.exercises.portrait import Portrait, kept_portrait
from app.exercises.schema import Exercise
from app.session.course import attempts_used, courses, not_void, refusals, why_not
from app.session.index import Index
from app.session.motion import ShownMotion
from app.session.people import Person
from app.views.exercise.briefing import AttemptsLeft, BriefingPage
from app.views.exercise.offer import BriefingOffer
from app.views.exercise.run import ExerciseRun
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.background import run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.parts import button, label
from app.views.kit.text import declared, tr
from app.views.shell.feature import Context
from app.views.shell.message_bar import ATTEMPT_RUNS

TRAINEE_DONE: Final = 9.0
"""Phase of the scripted hand that has done its part (`simulation.trainee.ScriptPhase`)."""

PERIOD_MS: Final = 100

LINGER_S: Final = 2.5
"""So long the needle is seen at the target before a demonstration ends [s]."""

GUARD_MS: Final = 1200
"""So long after an attempt began from the briefing Enter does not end it."""

SCAN_AT: Final = (0.45, 1.0)
"""Where control scans guide, the expert takes one at these shares of the way in."""

SCAN_S: Final = 3.0
"""So long the slices of a scan are looked at [s]."""


class BeginWish(Enum):
    """What is on its way."""

    NOTHING = auto()
    LOOK = auto()
    ATTEMPT = auto()
    SHOW = auto()
    WATCH = auto()


class DemonstrationBar(QFrame):
    """Says over the views that this is a demonstration, and stops it."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.setProperty("role", "panel")
        self.words, self.stop = label(), button(tr("Stop (Esc)"), "primary")
        self.words.setWordWrap(False)
        row = QHBoxLayout(self)
        row.setContentsMargins(theme.MARGIN, theme.SPACING // 2, theme.SPACING, theme.SPACING // 2)
        row.addWidget(self.words)
        row.addWidget(self.stop)
        self.hide()

    def tell(self, words: str) -> None:
        """Say what goes on, in the window's lower right corner: nothing else is said there."""
        self.words.setText(words)
        self.adjustSize()
        around = self.parentWidget()
        if around is not None:
            x, y = around.width() - self.width(), around.height() - self.height()
            self.move(x - theme.SPACING // 2, y - 2)
        self.show()
        self.raise_()


class EnterGuard(QObject):
    """Keeps an Enter that is pressed twice from ending the attempt that the first one began."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._timer = QTimer(self, interval=GUARD_MS, singleShot=True)
        self._timer.timeout.connect(self._let_go)

    def hold(self) -> None:
        """Swallow Enter for a moment."""
        application = QCoreApplication.instance()
        if application is not None:
            application.installEventFilter(self)
            self._timer.start()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Swallow Enter, as a key and as a shortcut."""
        if isinstance(event, QKeyEvent) and event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            event.accept()
            return True
        return False

    def _let_go(self) -> None:
        application = QCoreApplication.instance()
        if application is not None:
            application.removeEventFilter(self)


class Beginning(QObject):
    """Leads from the wish to the attempt.

    Args:
        context: of the feature that owns it.
        take: takes an exercise and opens its patient, unless it is shown already.
        exercises: all that may be begun, by identifier.

    Attributes:
        page: the briefing.
        exercise: that the briefing is of; None before the first.
        wish: what is on its way: it comes as soon as patient and robot are there.
    """

    def __init__(
        self,
        context: Context,
        take: Callable[[Exercise], None],
        exercises: Callable[[], Mapping[str, Exercise]],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._context, self._take, self._exercises = context, take, exercises
        self._conductor, self._shell = context.conductor, context.shell
        self.page = BriefingPage()
        self.exercise: Exercise | None = None
        self.bar = DemonstrationBar(context.shell.dialog_parent)
        self.wish = BeginWish.NOTHING
        self._offer: BriefingOffer | None = None
        self._briefed: tuple[str, int] | None = None
        self._asked, self._waited, self._scans = 0, 0.0, 0
        self._untaken = self._arrived = self._was_working = self._recorded = False
        self._guard = EnterGuard(self)
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self._poll)
        self._shell.add_page(self.page)
        self._escape = QShortcut(
            QKeySequence(Qt.Key.Key_Escape), context.shell.dialog_parent, self.stop
        )
        self._escape.setEnabled(False)
        self._connect()

    @property
    def is_showing(self) -> bool:
        """Return whether a demonstration is on its way or under way."""
        return self.wish is BeginWish.SHOW

    # --- briefing -----------------------------------------------------------------------------
    def brief(self, identifier: str) -> None:
        """Show the briefing of an exercise; begin at once where the student knows it."""
        exercise = self._exercises().get(identifier)
        if exercise is None:
            words = tr("There is no exercise {name} any more.", name=identifier)
            self._shell.messages.show_error(words)
            return
        if self._refuse_running():
            return
        self._end_wish()
        self.exercise, self._was_working = exercise, self._shell.is_working
        if self._is_known(exercise):
            self.begin()
        else:
            self._show_page(exercise)

    def go_on(self, identifier: str) -> None:
        """Begin again what was briefed already, at once; else show the briefing."""
        exercise = self._exercises().get(identifier)
        if exercise is None or not self.is_briefed(exercise):
            self.brief(identifier)
        else:
            self._begin_now(exercise)

    def practise(self, drill: Exercise) -> None:
        """Begin a drill of an exercise that was attempted, at once: its patient and plan stay."""
        if not self._refuse_running():
            self._begin_now(drill)

    def _refuse_running(self) -> bool:
        """Say that an attempt is running, where one is; return whether one is."""
        if not self._conductor.controller.is_running:
            return False
        self._shell.messages.show_until(
            ATTEMPT_RUNS, tr("An attempt is running: end it before another exercise is begun")
        )
        return True

    def _begin_now(self, exercise: Exercise) -> None:
        self._end_wish()
        self.exercise, self._was_working = exercise, True
        self.begin()

    def is_briefed(self, exercise: Exercise) -> bool:
        """Return whether an exercise was begun from its briefing last."""
        return self._briefed == _key(exercise)

    def trust(self, identifier: str) -> None:
        """Let an exercise be begun without its briefing: somebody else has told what it says."""
        exercise = self._exercises().get(identifier)
        self._briefed = None if exercise is None else _key(exercise)

    def again(self) -> None:
        """Show the briefing of the exercise that is prepared, else the start page's first."""
        taken = self._conductor.exercise
        if taken is None or taken.id not in self._exercises():
            self._shell.messages.show_error(tr("Choose an exercise first: File ▸ Start page."))
        else:
            self._end_wish()
            self.exercise, self._was_working = self._exercises()[taken.id], self._shell.is_working
            self._show_page(self.exercise)

    def _show_page(self, exercise: Exercise) -> None:
        self.page.show_exercise(exercise, kept_portrait(exercise))
        self.page.set_allowance(AttemptsLeft(refusal=ACCESS.refusal(exercise.id)))
        self._shell.show_page(self.page)
        self.page.begin.setFocus()
        self._asked += 1
        number, services, student = self._asked, self._context.services, ACCESS.student
        patient = self._conductor.patient
        fits = patient is not None and self._conductor.fits(patient, exercise)
        volume = patient.volume if fits and patient is not None else None
        folder = services.sessions()
        titles = {name: declared(one.title) for name, one in self._exercises().items()}

        def show(portrait: Portrait | None) -> None:
            if number == self._asked and portrait is not None:
                self.page.show_portrait(portrait)

        def allow(allowance: AttemptsLeft) -> None:
            if number == self._asked:
                self.page.set_allowance(allowance)

        def nothing(_: Exception) -> None:
            """Leave the page without the picture: begin tells what is wrong."""

        run_in_background(self, lambda p: services.portrait(exercise, volume, p), show, nothing)
        if student is not None:
            run_in_background(
                self, lambda _: attempts_left(folder, student, exercise, titles), allow, nothing
            )

    def _is_known(self, exercise: Exercise) -> bool:
        """Return whether the student wants no briefing; an assessment always has one."""
        if exercise.purpose is Purpose.ASSESSMENT:
            return False
        return str(self._shell.settings.value(_skip(exercise), "")) == "true"

    def _intercepted(self) -> bool:
        """Return whether the briefing comes before the attempt that somebody wants to begin now."""
        taken, patient = self._conductor.exercise, self._conductor.patient
        if taken is None or patient is None or not self._conductor.fits(patient):
            return False  # a CT of one's own: the exercise lends its device and tolerances only
        exercise = self._exercises().get(taken.id)
        known = exercise is None or self.is_briefed(exercise) or self._is_known(exercise)
        if exercise is None or known:
            return False
        self.exercise, self._was_working = exercise, self._shell.is_working
        self._show_page(exercise)
        return True

    # --- what is wanted -----------------------------------------------------------------------
    def begin(self) -> None:
        """Begin the attempt, as soon as patient and robot are there."""
        self._go(BeginWish.ATTEMPT)

    def look(self) -> None:
        """Go to the patient; the attempt is begun from there."""
        self._go(BeginWish.LOOK)

    def show_me(self) -> None:
        """Let the exercise be shown."""
        self._go(BeginWish.SHOW)

    def take_offer(self, offer: BriefingOffer) -> None:
        """Let the exercise be shown as a feature offers it, along its plan."""
        self._offer = offer
        self._go(BeginWish.WATCH)

    def show_taken(self) -> None:
        """Let the scripted expert do the exercise that is prepared."""
        taken = self._conductor.exercise
        if taken is None or self._conductor.patient is None:
            self._shell.messages.show_error(tr("Choose an exercise first: File ▸ Start page."))
        elif self._conductor.controller.is_running:
            self._shell.messages.show_until(
                ATTEMPT_RUNS, tr("An attempt is running: end it first.")
            )
        elif not self._context.editors.plan.edit.draft.complete:
            self._shell.messages.show_error(
                tr("Place entry and target first: the expert follows your plan.")
            )
        else:
            self.exercise = taken
            self._wait_for(BeginWish.SHOW)

    def back(self) -> None:
        """Leave the briefing for where one came from."""
        self._asked += 1
        if self.wish is not BeginWish.NOTHING and self._context.patients.is_reading:
            self._context.patients.close()
            self._context.patients.given_up.emit()
        self._end_wish()
        if self._was_working:
            self._shell.show_workspace()
        else:
            self._conductor.start_wanted.emit()

    def stop(self) -> None:
        """End a demonstration, at any time; the briefing is there again."""
        if not self.is_showing:
            return
        self._end_wish()
        if self.exercise is not None and self.exercise.id in self._exercises():
            self._show_page(self.exercise)

    def forget(self) -> None:
        """End what is on its way: another patient comes. A wish for that one stays."""
        if self._arrived:
            self._end_wish()

    def give_up(self) -> None:
        """Stay: the patient of the exercise did not come."""
        if self.wish is not BeginWish.NOTHING:
            self._end_wish()

    def _go(self, wish: BeginWish) -> None:
        exercise = self.exercise
        if exercise is None:
            return
        skips = self.page.isVisible() and self.page.skip.isChecked()
        if skips and exercise.purpose is Purpose.PRACTICE:
            self._shell.settings.setValue(_skip(exercise), "true")
        self._briefed = _key(exercise)
        self._asked += 1  # pictures that are still being made come too late
        on_its_way = self.wish is not BeginWish.NOTHING and self._context.patients.is_reading
        self._wait_for(wish)
        self._untaken = not on_its_way  # pressed twice: the patient comes once
        self._poll()

    def _wait_for(self, wish: BeginWish) -> None:
        one = self.exercise if wish is BeginWish.SHOW else None
        self._recorded = one is not None and ShownMotion.kept(one.id, one.version) is not None
        self.wish, self._waited, self._scans = wish, 0.0, 0
        self._untaken = self._arrived = False
        self._timer.start()

    def _take_now(self, exercise: Exercise) -> None:
        controller, plan = self._conductor.controller, self._context.editors.plan
        shows = controller.run is not None and controller.run.demonstrates
        if shows and (controller.is_running or plan.locked):
            return  # the expert is being stopped
        self._untaken = False
        self._take(exercise)
        if not self._context.patients.is_reading and not self._shell.is_working:
            self._end_wish()  # it was refused: whoever did has said why

    def _end_wish(self) -> None:
        """Let nothing be on its way any more, and take the needle back from the expert."""
        self.wish, self._arrived = BeginWish.NOTHING, False
        self._timer.stop()
        self.bar.hide()
        self._escape.setEnabled(False)
        controller = self._conductor.controller
        if controller.run is not None and controller.run.demonstrates and controller.is_running:
            controller.abort()  # `demonstrated` follows, and gives the needle back
        else:
            self._conductor.set_demonstrating(False)

    def _demonstrated(self) -> None:
        """Take the needle back once the attempt of a demonstration is over, whoever ended it."""
        self._context.editors.plan.set_locked(False)
        self._conductor.set_demonstrating(False)
        if self.is_showing:
            self.stop()

    # --- as soon as all is there --------------------------------------------------------------
    def _poll(self) -> None:
        exercise, patient = self.exercise, self._conductor.patient
        if exercise is not None and self._untaken:
            self._take_now(exercise)
            return
        taken = self._conductor.exercise
        if exercise is None or taken is None or taken.id != exercise.id or patient is None:
            return  # still being opened
        if not self._conductor.fits(patient) and self.wish is not BeginWish.SHOW:
            return
        if not self._shell.is_working:
            if self._arrived:  # somebody has gone elsewhere meanwhile
                self._end_wish()
            return
        self._arrived = True
        self._waited += 1e-3 * PERIOD_MS
        step = {
            BeginWish.LOOK: self._end_wish,
            BeginWish.ATTEMPT: self._start,
            BeginWish.SHOW: self._show,
            BeginWish.WATCH: self._watch,
        }.get(self.wish)
        if step is not None:
            step()

    def _start(self) -> None:
        """Begin the attempt; what is missing, or a robot's needle in the hand, comes first.

        There F5 begins, as the line over the views says.
        """
        run = self._conductor.controller.run
        if self._conductor.why_not_start() or (run is not None and run.is_real):
            self._end_wish()
            return
        start = self._conductor.views.panel.buttons.start
        if run is not None and not run.demonstrates and start.isEnabled():
            self._end_wish()
            start.click()
            self._guard.hold()

    def _watch(self) -> None:
        self._end_wish()
        if self._offer is not None:
            self._offer.watch()

    def _show(self) -> None:
        self._escape.setEnabled(True)
        self._conductor.set_demonstrating(True)
        controller, run = self._conductor.controller, self._conductor.controller.run
        if run is None or not run.demonstrates:
            self.bar.tell(tr("The demonstration is coming …"))
            return
        self.bar.tell(
            tr("Demonstration: a recorded attempt is led again")
            if self._recorded
            else tr("Demonstration: a scripted expert has the needle")
        )
        if controller.is_running:
            self._follow(run)
        elif self._conductor.views.panel.buttons.start.isEnabled():
            self._waited = 0.0
            controller.begin("")

    def _follow(self, run: ExerciseRun) -> None:
        """Take the scans of an expert who is guided by them; end when he has done his part."""
        snapshot = run.trainer.snapshot()
        if snapshot.device is None:
            return
        done = snapshot.device.row[sv.TRAINEE_PHASE] == TRAINEE_DONE
        way = 1.0 - snapshot.offset.remaining / run.placed.length
        due = self._scans < len(SCAN_AT) and (done or way >= SCAN_AT[self._scans])
        if not run.shown.live and due:
            self._scans = len(SCAN_AT) if done else self._scans + 1
            self._waited = 0.0
            self._conductor.views.panel.scan.here.click()
            self._conductor.controller.scan()
        elif not done:
            self._waited = 0.0
        elif self._waited >= (LINGER_S if run.shown.live else SCAN_S):
            self._waited = -1e9  # asked once
            self._conductor.controller.end()

    def _connect(self) -> None:
        page, controller = self.page, self._conductor.controller
        page.begin_wanted.connect(self.begin)
        page.show_wanted.connect(self.show_me)
        page.look_wanted.connect(self.look)
        page.offer_wanted.connect(self.take_offer)
        page.back_wanted.connect(self.back)
        self.bar.stop.clicked.connect(self.stop)
        controller.intercepted = self._intercepted
        controller.demonstrated.connect(self._demonstrated)
        controller.began.connect(lambda _: self._is_begun())
        controller.finished.connect(lambda _: self._forget_assessment())
        self._conductor.exercise_wanted.connect(self.brief)
        self._conductor.offered.connect(page.add_offer)
        self._conductor.runs.failed.connect(lambda _: self.give_up())
        briefing = (tr("Briefing of this exercise"), "Shift+F5", self.again)
        add_entries(self._shell.menu(tr("&Sessions")), [briefing])
        self._shell.add_keys([(tr("Show me this exercise"), "Ctrl+F5", self.show_taken)])

    def _is_begun(self) -> None:
        """Want nothing more: whoever was faster has begun it, with F5 or Start."""
        if self.wish in (BeginWish.ATTEMPT, BeginWish.LOOK):
            self._end_wish()

    def _forget_assessment(self) -> None:
        """Let every attempt of an assessment have its briefing."""
        taken = self._conductor.exercise
        if taken is not None and taken.purpose is Purpose.ASSESSMENT:
            self._briefed = None


def attempts_left(
    folder: Path, student: Person, exercise: Exercise, titles: Mapping[str, str]
) -> AttemptsLeft:
    """Return how many attempts a student has by his courses; called beside the window.

    Args:
        folder: of the records.
        student: who.
        exercise: that he wants to begin.
        titles: of all exercises, by identifier.

    Raises:
        AcusError: if the records cannot be read.
    """
    from app.session.people import People

    item, known = None, courses()[0]
    for course in known:
        found = [one for one in course.items if one.exercise == exercise.id]
        if found and course.takes(student):
            item = found[0]
            break
    today = datetime.datetime.now().astimezone().date()
    if item is None:
        return AttemptsLeft(refusal=refusals(known, student, (), today).get(exercise.id, ""))
    index = Index(folder)
    index.refresh()
    people = People()
    own = not_void(index.attempts([student.key]), people.remarks())
    refusal = why_not(course, exercise.id, own, today, titles)
    return AttemptsLeft(item.attempts, len(attempts_used(own, item)), course.title, refusal)


def _key(exercise: Exercise) -> tuple[str, int]:
    """Name what a briefing is of: of a drill it is the whole exercise, which was briefed."""
    drill = exercise.drill
    return (exercise.id, exercise.version) if drill is None else (drill.of, drill.version)


def _skip(exercise: Exercise) -> str:
    return f"briefing/skip/{exercise.id}"
