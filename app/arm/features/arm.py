"""*Watch the arm do my plan*: asks for it, says why not, and leads it by its bar."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Final

from PySide6.QtCore import Qt, SignalInstance
from PySide6.QtGui import QKeySequence, QShortcut

from app.arm.views.bar import ArmBar, only_simulated
from app.arm.views.play import ArmPlay, PlayState
from app.core.loading import turn
from app.core.progress import Progress
from app.exercises.guidance import Purpose
from app.planning.placement import PlacedPlan
from app.views.exercise.offer import BriefingOffer
from app.views.kit.access import ACCESS
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import literal, tr, translated
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.arm.scene.performance import ArmPerformance

DECLARATION: Final[dict[str, Any]] = {
    "title": "Watch the arm do my plan",
    "after": "exercise",
    "help": "arm.md#watch-the-arm-do-your-plan",
}

KEYS: Final = {"pause": "Space", "step": "F10", "skip": "F3", "take": "F12", "stop": "Esc"}
"""Button of the bar -> its key, while the bar is there."""


class ArmFeature(Feature):
    """Lets the simulated arm carry out the student's plan, in the same views, recorded and scored.

    Attributes:
        bar: leads it.
        play: what is being played; None while nothing is.
    """

    topic: ClassVar[str] = "arm"
    roles: ClassVar[frozenset[Role]] = STAFF

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
        self._conductor.offered.emit(self._offer())
        self._conductor.exercise_taken.connect(self._another_exercise)
        self._conductor.runs.failed.connect(lambda _: self.stop())
        self._conductor.controller.beginning.connect(self._give_way)
        self._shell.page_changed.connect(lambda _: self._look_away())
        self._editor.changed.connect(self._another_plan)

    def _offer(self) -> BriefingOffer:
        """Return the button of the briefing."""
        return BriefingOffer(
            name=self.topic,
            title=tr("Watch the arm (W)"),
            tip=tr(
                "A simulated arm carries out the plan; it counts for nobody, and drives no real arm"
            ),
            key=Qt.Key.Key_W,
            suits=lambda one: one.purpose is Purpose.PRACTICE and one.touch is None,
            watch=self.watch,
            roles=self.roles,
        )

    @property
    def is_busy(self) -> bool:
        """Return whether the arm works out its way, or is being watched."""
        return self._task is not None or self.play is not None

    @staticmethod
    def carry_out(
        placed: PlacedPlan, seed: int, stands_deg: float, progress: Progress
    ) -> ArmPerformance:
        """Let the simulated arm carry out a plan; called beside the window, takes seconds.

        Args:
            placed: the plan.
            seed: of where the tool lies and of the pictures' noise.
            stands_deg: turn of the arm's place about the vertical through the entry [°].
            progress: told what is being done; may cancel.

        Raises:
            AcusError: if it cannot; says why; its `could_stand_deg`, where it has one that is not
                None, is a place from which the arm could. If a package is missing: names the extra.
            Cancelled: if `progress` was cancelled.
        """
        with turn(progress):  # kernels, MuJoCo and planners: behind the window, not before it
            from app.arm.run import carry_out
        return carry_out(placed, seed, stands_deg, progress)

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
        stands, self._asked = self._stands_deg, placed
        seed, self._exercise = exercise.seed, exercise.id
        key = placed.plan, placed.placement, placed.p_entry.tolist(), seed, stands
        self._shell.show_workspace()
        self._shell.messages.forget(self.topic)
        self._conductor.show_leader(self.bar)
        self._listen(True)
        if self._kept is not None and self._kept[0] == key:
            self._play(self._kept[1], placed)  # the same as the last time
            return
        self.bar.tell(
            tr("Simulated arm: works out its way …  {only}", only=only_simulated()), self.bar.stop
        )

        def take(result: ArmPerformance) -> None:
            self._kept = key, result
            self._take(result, placed)

        self._task = run_in_background(
            self,
            lambda progress: self.carry_out(placed, seed, stands, progress),
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
        self.bar.tell(translated(error), self.bar.offer, self.bar.stop)

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

    def _over(self, reason: str) -> None:
        play, self.play = self.play, None
        if play is not None:
            play.deleteLater()
        self._listen(False)
        if reason:
            self.failed.emit(reason)

    def _put_away(self) -> None:
        self._task = None
        self._conductor.show_leader(None)
        self._listen(False)

    def _listen(self, on: bool) -> None:
        for key in self._keys:
            key.setEnabled(on)

    # --- as a feature -------------------------------------------------------------------------
    def watching(self) -> Mapping[str, str]:
        """Return the key by which the arm is asked for."""
        return {"Ctrl+Shift+F5": tr("the arm does it")}

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


FEATURE: Final = ArmFeature
