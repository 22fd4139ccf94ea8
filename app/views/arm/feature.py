"""*Watch the arm do my plan*: asks for it, says why not, and the bar by which it is led."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final

from PySide6.QtCore import Qt, SignalInstance
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QSizePolicy, QWidget

from app.exercises.guidance import Purpose
from app.planning.placement import PlacedPlan
from app.views.arm.play import ArmPlay, PlayState
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.parts import PlainLabel, button
from app.views.kit.text import literal, tr
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.simulation.arm.performance import ArmPerformance

KEYS: Final = {"pause": "Space", "step": "F10", "skip": "F3", "take": "F12", "stop": "Esc"}
"""Button of the bar -> its key, while the bar is there."""


_LED: Final = (PlayState.FETCHING, PlayState.INSERTING, PlayState.HOLDING)


class ArmBar(QFrame):
    """Says what the arm does, in place of the next step, and leads it.

    Attributes:
        words: what goes on.
        pause, step, skip, take, stop: its buttons.
        offer: lets the arm stand elsewhere, where that was refused for its place.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self.setProperty("role", "panel")
        self.words = PlainLabel(self)
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.words.setWordWrap(True)
        self.words.setAccessibleName(tr("What the arm does"))
        self.pause, self.step = button(tr("Pause (Space)")), button(tr("Step (F10)"))
        self.skip, self.take = button(tr("To the entry (F3)")), button(tr("Take over (F12)"))
        self.stop, self.offer = button(tr("Stop (Esc)"), "primary"), button("")
        for one, tip in (
            (self.pause, tr("The arm stands still, the needle where it is; or it goes on")),
            (self.step, tr("The arm goes on for half a second, then stands still")),
            (self.skip, tr("Leave out the rest of the fetching: the arm stands over the entry")),
            (self.take, tr("You go on with mouse or keys from where the needle is now")),
            (self.stop, tr("The attempt is broken off; everything is as it was before")),
        ):
            one.setToolTip(literal(tip))
        row = QHBoxLayout(self)
        row.setContentsMargins(theme.MARGIN, 2, theme.SPACING, 2)
        row.addWidget(self.words, 1)
        for one in self.buttons:
            one.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            row.addWidget(one)
        self.suit_room()
        self.hide()

    @property
    def buttons(self) -> tuple[QPushButton, ...]:
        """All buttons, from the left."""
        return self.offer, self.pause, self.step, self.skip, self.take, self.stop

    def suit_room(self) -> None:
        """Take another size of text or other colours."""
        self.words.setStyleSheet(f"font-size: {theme.FONT_PX}px; font-weight: 600;")
        self.setMinimumHeight(self.stop.sizeHint().height() + 6)  # with and without buttons

    def tell(self, words: str, *shown: QPushButton) -> None:
        """Say this, and offer these buttons."""
        if words != self.words.text():
            self.words.setText(words)
            self.words.setToolTip(literal(f"{words}\n{only_simulated()}"))
        for one in self.buttons:
            one.setVisible(one in shown)

    def show_play(self, play: ArmPlay) -> None:
        """Say what a play does, and offer what can be done about it."""
        self.pause.setText(tr("Pause (Space)") if play.playing else tr("Go on (Space)"))
        if play.state is PlayState.WAITING:
            self.tell(tr("Simulated arm: robot and cameras are coming …"), self.stop)
            return
        if play.state is PlayState.STOPPING:
            self.tell(tr("Simulated arm: stopping …"))
            return
        holds = play.state is PlayState.HOLDING
        what = tr("holds still at your target") if holds else phase_words(play.phase)
        words = (
            tr("Simulated arm: {what}  ·  {now:.0f}/{all:.0f} s")
            if play.playing
            else tr("Simulated arm  ‖  {what}  ·  {now:.0f}/{all:.0f} s")
        ).format(what=what, now=play.t, all=play.duration)
        fetching = play.state is PlayState.FETCHING
        self.tell(words, self.pause, self.step, self.skip if fetching else self.take, self.stop)
        self.take.setEnabled(play.may_take_over)


def only_simulated() -> str:
    """Say what this is not."""
    return tr("A simulation only: it drives no real arm and no real robot.")


def phase_words(name: str) -> str:
    """Say what the arm does in a phase."""
    return {
        "approach": tr("reaches for the needle guide"),
        "grasp": tr("closes its hand"),
        "lift": tr("lifts the guide off the tray"),
        "transfer": tr("brings it to the entry"),
        "align": tr("stands it over the entry"),
        "pivot": tr("turns the needle to your path"),
        "insert": tr("inserts along your path"),
    }.get(name, name)


class ArmFeature(Feature):
    """Lets the simulated arm carry out the student's plan, in the same views, recorded and scored.

    Attributes:
        bar: leads it.
        play: what is being played; None while nothing is.
    """

    topic: ClassVar[str] = "arm"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._conductor, self._shell = context.conductor, context.shell
        self._editor = context.editors.plan
        self.bar = ArmBar(context.shell.dialog_parent)
        self.play: ArmPlay | None = None
        self._task: BackgroundTask | None = None
        self._asked: PlacedPlan | None = None
        self._stands_deg, self._could_deg = 0.0, 0.0
        self._exercise = ""
        self._keys: list[QShortcut] = []
        self._kept: tuple[object, ArmPerformance] | None = None
        menu = self._shell.menu(tr("&Sessions"))
        menu.setToolTipsVisible(True)
        (entry,) = add_entries(
            menu,
            [(tr("Watch the arm do my plan"), "Ctrl+Shift+F5", self.watch)],
        )
        entry.setToolTip(
            literal(
                tr("A simulated arm carries out the plan on screen. {only}", only=only_simulated())
            )
        )
        self._connect()

    def _connect(self) -> None:
        bar, window = self.bar, self._shell.dialog_parent
        for name, one in (
            ("pause", bar.pause),
            ("step", bar.step),
            ("skip", bar.skip),
            ("take", bar.take),
            ("stop", bar.stop),
        ):
            one.clicked.connect(lambda _=False, name=name: self._press(name))
            key = QShortcut(QKeySequence(KEYS[name]), window)
            key.setAutoRepeat(False)
            key.setEnabled(False)
            key.activated.connect(one.click)  # a disabled button ignores it
            self._keys.append(key)
        bar.offer.clicked.connect(self._stand_elsewhere)
        self._conductor.arm_wanted.connect(self.watch)
        self._conductor.exercise_taken.connect(self._another_exercise)
        self._conductor.runs.failed.connect(lambda _: self.stop())
        self._conductor.controller.beginning.connect(self._give_way)
        self._shell.page_changed.connect(lambda _: self._look_away())
        self._editor.changed.connect(self._another_plan)

    @property
    def is_busy(self) -> bool:
        """Whether the arm works out its way, or is being watched."""
        return self._task is not None or self.play is not None

    # --- asked for ----------------------------------------------------------------------------
    def watch(self) -> None:
        """Let the arm carry out the plan, or say why it does not."""
        if self.is_busy:
            self.noted.emit(tr("The arm is at it already; Esc stops it."))
            return
        why = self._why_not()
        if why:
            self.failed.emit(why)
            return
        self._stands_deg = 0.0
        self._ask()

    def _why_not(self) -> str:
        """Say why the arm cannot be watched now, and what to do; empty where it can."""
        conductor, exercise = self._conductor, self._conductor.exercise
        if exercise is None or conductor.patient is None:
            return tr("Choose an exercise first: File ▸ Start page.")
        if conductor.controller.is_running:
            return tr("An attempt is running: end it first, then let the arm do your plan.")
        if exercise.purpose is Purpose.ASSESSMENT:
            return tr("This is an assessment: you do it yourself, the arm cannot do it for you.")
        if exercise.touch is not None:
            return tr(
                "Here targets are touched: the arm inserts along a path and leaves them to you."
            )
        refused = ACCESS.refusal(exercise.id)
        if refused:
            return tr("The arm does not do what you may not begin: {why}.", why=refused)
        if not self._editor.edit.draft.complete:
            return tr("Place entry and target first (E, T): the arm follows your plan.")
        if self._editor.verdict.placed is None:
            return tr("Finish a plan that the robot can follow first; the panel Plan says why not.")
        return ""

    def _ask(self) -> None:
        """Work the arm's way out beside the window."""
        exercise, placed = self._conductor.exercise, self._editor.verdict.placed
        if exercise is None or placed is None:
            return
        services, stands, self._asked = self.context.services, self._stands_deg, placed
        seed, self._exercise = exercise.seed, exercise.id
        key = placed.plan, placed.placement, placed.p_entry.tolist(), seed, stands
        self._shell.show_workspace()
        self._shell.messages.forget(self.topic)
        self._conductor.show_arm(self.bar)
        self._listen(True)
        if self._kept is not None and self._kept[0] == key:
            self._play(self._kept[1], placed)  # the same as the last time
            return
        self.bar.tell(
            tr("Simulated arm: works out its way …  {only}", only=only_simulated()), self.bar.stop
        )

        def take(found: ArmPerformance) -> None:
            self._kept = key, found
            self._take(found, placed)

        self._task = run_in_background(
            self,
            lambda progress: services.carry_out(placed, seed, stands, progress),
            take,
            self._refused,
            self._put_away,
        )
        self._task.progressed.connect(self._show_progress)

    def _show_progress(self, share: float, words: str) -> None:
        if self._task is not None:
            said = tr("Simulated arm: works out its way, {n:.0f} %", n=100.0 * share)
            self.bar.tell("  ·  ".join(filter(None, (said, words))), self.bar.stop)

    def _take(self, performance: ArmPerformance, placed: PlacedPlan) -> None:
        self._task = None
        why = self._why_not()
        if why:
            self._put_away()
            self.failed.emit(why)
            return
        self._play(performance, placed)

    def _play(self, performance: ArmPerformance, placed: PlacedPlan) -> None:
        student = ACCESS.recorded_as(self._conductor.views.panel.student.text().strip())
        self.play = play = ArmPlay(
            self._conductor, self.context.views.scene, performance, placed, student, self
        )
        play.changed.connect(self._show_play)
        play.taken.connect(self._taken)
        play.over.connect(self._over)
        self.noted.emit(only_simulated())
        play.start()

    def _refused(self, error: Exception) -> None:
        """Say why the arm cannot do it; offer another place for it, where that would do."""
        self._task = None
        could = getattr(error, "could_stand_deg", None)
        if could is None:
            self._put_away()
            self.failed.emit(error)
            return
        self._could_deg = float(could)
        turn = (self._could_deg - self._stands_deg + 180.0) % 360.0 - 180.0
        self.bar.offer.setText(
            tr("Let it stand {angle:.0f}° further round, and try again", angle=abs(turn))
        )
        self.bar.tell(str(error), self.bar.offer, self.bar.stop)

    def _stand_elsewhere(self) -> None:
        if self._task is None and self.play is None:
            self._stands_deg = self._could_deg
            why = self._why_not()
            if why:
                self._put_away()
                self.failed.emit(why)
            else:
                self._ask()

    # --- while it plays -----------------------------------------------------------------------
    def _press(self, name: str) -> None:
        """Do what a button of the bar stands for; a hidden one stands for nothing."""
        play = self.play
        if name == "stop":
            self.stop()
        elif play is not None and play.state in (
            PlayState.FETCHING,
            PlayState.INSERTING,
            PlayState.HOLDING,
        ):
            commands = {
                "pause": play.pause,
                "step": play.step,
                "skip": play.skip,
                "take": play.take_over,
            }
            commands[name]()

    def stop(self) -> None:
        """Stop whatever the arm is at; everything is as before."""
        if self._task is not None:
            self._task.drop()
            self._task = None
            self._put_away()
        elif self.play is not None:
            self.play.stop()
        elif not self.bar.isHidden():
            self._put_away()  # an offer that is not taken

    def _look_away(self) -> None:
        """Let nothing happen that nobody sees: another page is shown."""
        if self._shell.is_working:
            return
        if self.play is not None and self.play.state is not PlayState.TAKEN:
            if self.play.may_take_over:
                if self.play.playing:
                    self.play.pause()
            else:
                self.play.stop()
        elif self.play is None:
            self.stop()

    def _give_way(self) -> None:
        """Stop working out a way: the student begins by himself."""
        if self.play is None:
            self.stop()

    def _another_exercise(self, identifier: str) -> None:
        if identifier != self._exercise and self.play is None:
            self.stop()

    def _another_plan(self) -> None:
        """Work no longer for a plan that is another one now, nor offer a place for it."""
        now, asked = self._editor.verdict.placed, self._asked
        if now is not None and self.play is None:
            self._shell.messages.forget(self.topic)  # there is a plan that can be followed
        same = (
            now is not None
            and asked is not None
            and (now.plan, now.placement) == (asked.plan, asked.placement)
        )
        if self.play is None and not self.bar.isHidden() and not same:
            self.stop()
            self.noted.emit(tr("The plan was changed meanwhile: ask again for the new one."))

    def _show_play(self) -> None:
        if self.play is not None and self.play.state is not PlayState.OVER:
            self.bar.show_play(self.play)

    def _taken(self) -> None:
        self._listen(False)
        self.noted.emit(
            tr("You have the needle: go on with mouse or keys. This attempt counts for nobody.")
        )

    def _over(self, why: str) -> None:
        play, self.play = self.play, None
        if play is not None:
            play.deleteLater()
        self._listen(False)
        if why:
            self.failed.emit(why)

    def _put_away(self) -> None:
        self._task = None
        self._conductor.show_arm(None)
        self._listen(False)

    def _listen(self, on: bool) -> None:
        for key in self._keys:
            key.setEnabled(on)

    # --- as a feature -------------------------------------------------------------------------
    def forget(self) -> None:
        """Stop: another patient is coming."""
        self.close()
        self._kept = None

    def over(self) -> tuple[SignalInstance, ...]:
        """After these, why the arm did not do it is true no more."""
        conductor = self._conductor
        controller = conductor.controller
        return conductor.exercise_taken, controller.began, controller.finished

    def suit_room(self) -> None:
        """Take another size of text or other colours."""
        self.bar.suit_room()

    def close(self) -> None:
        """Stop everything at once; idempotent."""
        if self._task is not None:
            self._task.close(0.0)
            self._put_away()
        if self.play is not None:
            self.play.forget()
        elif not self.bar.isHidden():
            self._put_away()
