"""The next step of an attempt as an order, and the one line that says it."""

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QFontMetrics, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.units import MILLIMETRE
from app.session.procedure import ProcedureState, ToolInHand
from app.session.snapshot import BreathHold, NextStep, NextSteps, Snapshot, StepKind
from app.session.touching import TouchState
from app.session.transitions import PauseCause
from app.views.exercise.run import ExerciseRun
from app.views.exercise.step_panel import first_of, shared_words
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import listing, literal, number, tr
from app.views.slices.pace import Unhurried


def side_word(letter: str) -> str:
    """Name of a side of the patient."""
    return {
        "L": tr("the patient's left"),
        "R": tr("the patient's right"),
        "A": tr("the front"),
        "P": tr("the back"),
        "S": tr("the head"),
        "I": tr("the feet"),
    }[letter]


OTHER_SIDE: Final = str.maketrans("LRAPSI", "RLPAIS")


def amount(value: float) -> str:
    """Write a way to go: whole numbers, and below one tenths, so that nobody overshoots by them."""
    return number(value, ".0f") if value >= 0.95 else number(max(value, 0.1), ".1f")


ASIDE: Final = frozenset(
    {StepKind.START, StepKind.WITHDRAW, StepKind.MOVE, StepKind.WAIT, StepKind.AWAY}
)
"""What comes before the attempt's own steps, or stops them: no breath is held for it."""


def step_words(
    step: NextStep, by_mouse: bool, tip: bool = False, numbers: bool = True, told_by: str = ""
) -> str:
    """Say what is to be done next, as an order.

    Args:
        step: what.
        by_mouse: whether mouse or keys move the needle.
        tip: whether it is said where the tip goes, as the hand of mouse or keys does, not the hub.
        numbers: whether it is said how far.
        told_by: who tells the needle where no camera looks at it.
    """
    if step.touch is not None:
        return touch_words(step, step.touch)
    if step.procedure is not None:
        words = procedure_words(step.procedure, step.inside)
        if step.kind is StepKind.MOVE and step.procedure.checks_left:
            return tr("Ready: the clock starts when you move, or with this: {step}", step=words)
        if step.kind is StepKind.MOVE:
            return tr("Ready: the clock starts when you move. Then: {step}", step=words)
        moves = not (step.procedure.checks_left or step.procedure.rolled)
        blind = step.inside is None and step.procedure.tool in _MOVED and moves
        return tr("By the scans (S): {step}", step=words) if blind else words
    mm = step.distance / MILLIMETRE
    inwards = tr(" (wheel away from you)") if by_mouse else ""
    outwards = tr(" (wheel towards you)") if by_mouse else ""
    towards = step.towards.translate(OTHER_SIDE) if tip else step.towards
    sides = listing(side_word(letter) for letter in towards)
    across = amount(step.across / MILLIMETRE)
    tilt = (
        tr("Aim {mm} mm further towards {sides}", mm=across, sides=sides)
        if tip
        else tr("Tilt the hub towards {sides}: {mm} mm off the target", mm=across, sides=sides)
    )
    if not numbers and step.kind in (StepKind.TILT, StepKind.DEEPER, StepKind.BACK):
        return _without_numbers(step.kind, sides, inwards, outwards, tip)
    if told_by and step.kind is StepKind.SEE:
        return tr("One moment: {source} does not tell how deep the needle is", source=told_by)
    return {
        StepKind.START: tr("Press F5 to start the attempt"),
        StepKind.WITHDRAW: (
            tr("One moment: the needle goes to its start")
            if by_mouse
            else tr("Pull the needle out of the skin")
        ),
        StepKind.MOVE: tr("Ready: the clock starts when you move"),
        StepKind.SEE: tr("Let both cameras see the marker"),
        StepKind.WAIT: _pause_words(step.pause),
        StepKind.AWAY: tr("Out of the room: {s:.0f} s", s=step.left),
        StepKind.SCAN: tr("Push by the scans: S takes one, Enter ends the attempt"),
        StepKind.LOOK: tr("Steer by the CT: S takes a scan, Enter ends the attempt"),
        StepKind.TILT: tilt,
        StepKind.INSERT: tr("Push the needle in{how}", how=inwards),
        StepKind.FEEL: tr("Push slowly{how}: nobody tells the depth", how=inwards)
        if told_by
        else tr("Push slowly{how}: the cameras do not see the depth", how=inwards),
        StepKind.BONE: tr("The tip stands on bone: do not push, pull back{how}", how=outwards),
        StepKind.DEEPER: tr("Push {mm} mm deeper{how}", mm=amount(mm), how=inwards),
        StepKind.BACK: tr("Pull back {mm} mm{how}", mm=amount(mm), how=outwards),
        StepKind.HOLD: tr("Hold still"),
        StepKind.PROCEDURE: tr("Next step (J)"),
        StepKind.TOUCH: tr("Bring the tip to the target"),
        StepKind.STAY: tr("Stay on the target"),
        StepKind.FINISH: tr("Press Enter: the tip is at the target"),
    }[step.kind]


def _without_numbers(kind: StepKind, sides: str, inwards: str, outwards: str, tip: bool) -> str:
    """Say which way the needle is to be moved, and not how far."""
    if kind is StepKind.DEEPER:
        return tr("Push deeper{how}", how=inwards)
    if kind is StepKind.BACK:
        return tr("Pull back{how}", how=outwards)
    if tip:
        return tr("Aim further towards {sides}", sides=sides)
    return tr("Tilt the hub towards {sides}", sides=sides)


def _pause_words(cause: PauseCause | None) -> str:
    """Say what an attempt waits for that no movement of the needle mends."""
    if cause is PauseCause.WINDOW:
        return tr("Paused: the window stood still. This computer is busy: close other programs.")
    if cause is PauseCause.HAND:
        return tr("Paused: the needle swings in the simulated hand; it goes on by itself.")
    if cause is PauseCause.CAMERAS:
        return tr(
            "Paused: the simulated cameras do not see the needle there. Move it back a little."
        )
    if cause is None:
        return tr(
            "One moment: this computer is busy and its pictures come late. Close other programs."
        )
    return tr("Paused: this computer is too busy. Close other programs to go on.")


def ending_words() -> str:
    """Say that the attempt is over and its score is to come."""
    return tr("Ended: the score is being worked out")


def waiting_words() -> str:
    """Say that there is a moment to wait."""
    return tr("One moment: the robot is starting")


NEAR: Final = 1.5 * MILLIMETRE
"""A way of the tip below this is not asked for on the way to a target [m]."""


def touch_words(step: NextStep, touch: TouchState) -> str:
    """Say how the tip comes to the target that is to be touched next: where it is to go, and the
    hand the other way.
    """
    number, of = touch.number, len(touch.task)
    if step.kind is StepKind.FINISH:
        return tr("✔ All {n} targets are touched: press Enter", n=of)
    if step.kind is StepKind.STAY:
        return tr("Stay on target {n} of {of}", n=number, of=of)
    said = []
    if step.across >= NEAR:
        sides = listing(side_word(letter) for letter in step.towards)
        said.append(
            tr(
                "tip {mm} mm towards {sides} (hand the other way)",
                mm=amount(step.across / MILLIMETRE),
                sides=sides,
            )
        )
    if abs(step.distance) >= NEAR:
        mm = amount(abs(step.distance) / MILLIMETRE)
        said.append(tr("push {mm} mm", mm=mm) if step.distance > 0.0 else tr("pull {mm} mm", mm=mm))
    way = ", ".join(said) or tr("a little nearer")
    return tr("Target {n} of {of}: {way}", n=number, of=of, way=way)


_MOVED: Final = (ToolInHand.ANAESTHETIC, ToolInHand.STYLET, ToolInHand.ELECTRODE)
"""What is moved before its step can be done."""


def procedure_words(state: ProcedureState, inside: bool | None) -> str:
    """Say which step of a procedure is next.

    Args:
        state: how the attempt stands with them.
        inside: whether the tip is in the body; None where nobody is told.
    """
    if (check := _check_words(state)) and not inside:
        return check
    if state.rolled:
        return tr("The patient is turned: Enter ends the attempt")
    if state.ablation is not None and state.ablation.reached is not None:
        return tr("Needle out: turn the patient (J)")
    if state.ablation is not None and state.tool is ToolInHand.ELECTRODE:
        if state.ablation.all_placed:
            return tr("Start the generator (J)")
        if inside is None:
            return tr("Push to its place, then leave electrode {n} (J)", n=state.ablation.number)
        if not inside:
            return tr("Draw the needle out of the skin, turn it to {n}", n=state.ablation.number)
        return tr("Leave electrode {n} here (J)", n=state.ablation.number)
    if state.tool is ToolInHand.ANAESTHETIC and state.deposits:
        if inside is None:
            return tr("Draw the needle out, then take the next one (J); or give more (Alt+J)")
        if inside:
            return tr("Draw the needle out, or give more (J)")
        return tr("Take the outer needle (J)")
    if state.tool is ToolInHand.STYLET and state.samples and state.part.rollover is not None:
        if inside is None:
            return tr("Stylet out (J) for another; or draw out and turn the patient (Alt+J)")
        if inside:
            return tr("Stylet out (J) for another; or draw the needle out")
        return tr("Turn the patient puncture side down (J)")
    if state.tool is ToolInHand.STYLET and state.samples:
        return tr("Another sample: stylet out (J). Enter ends the attempt")
    return {
        ToolInHand.ANAESTHETIC: tr(
            "Push to just before pleura or capsule, then give local anaesthetic (J)"
        ),
        ToolInHand.STYLET: tr("Stop with the tip at the lesion's near edge, then stylet out (J)"),
        ToolInHand.OPEN: tr("The hub is open: gun in, or stylet in (J)"),
        ToolInHand.GUN: tr("Hold still and fire (Ctrl+J)"),
        ToolInHand.FIRED: tr("Gun out (J)"),
    }[state.tool]


def _check_words(state: ProcedureState) -> str:
    """Say what of the checklist is next; empty once it is done, or too late."""
    step = first_of(state, state.possible)
    return "" if step is None else shared_words(step)


def breath_words(breath: BreathHold, words: str, commands: bool) -> str:
    """Say how the breath-hold stands before `words`, or what is to be done about it instead.

    Args:
        breath: of the patient.
        words: the next step, as the needle has it.
        commands: whether who reads it tells the patient.
    """
    if breath.held:
        return tr("Held, {s:.0f} s left: ", s=breath.left) + words
    if breath.spent:
        return (
            tr("The patient breathes freely (A releases, A asks again): {step}", step=words)
            if commands
            else tr("He breathes by himself: {step}", step=words)
        )
    if breath.asked:
        return tr("Wait: he breathes out and holds")
    return tr("Have the breath held (A): {step}", step=words) if commands else words


TOLD_MS: Final = 900
"""So long the line says that a target was touched, in another colour, before it goes on [ms]."""

PADDING: Final = theme.SPACING // 2
"""Round the words of the line [px]."""


class NextStepLine(PlainLabel):
    """The one line that always says the next step, over the views, to be read at arm's length.

    Signals:
        spoken(str, bool): what it says, and whether that something was reached; whoever has taken
            its place says the same.
        stepped(NextStep, bool): the step that it says, as a value, and whether it is said how far.
    """

    spoken = Signal(str, bool)
    stepped = Signal(object, bool)

    def __init__(
        self, parent: QWidget | None = None, offers_start: Callable[[], bool] = lambda: True
    ) -> None:
        """Make an empty line.

        Args:
            parent: widget that it stands in.
            offers_start: returns whether the start is to be spoken of; it is not while somebody is
                at another panel, the plan's above all. Who changes it calls `follow_panel`.
        """
        super().__init__(parent)
        self._offers_start = offers_start
        self._steps: NextSteps | None = None
        self._run: ExerciseRun | None = None
        self._snapshot: Snapshot | None = None
        self._moves_hub = self._gives_way = self._aside = False
        self._may_start, self._why_not = False, ""
        self._touched, self._told, self._ends = 0, "", False
        self._tell = QTimer(self, interval=TOLD_MS, singleShot=True)
        self._tell.timeout.connect(self._stop_telling)
        self._written = Unhurried(self._write, self)
        self.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Next step"))
        self.suit_room()
        self.hide()

    def begin(self, run: ExerciseRun | None) -> None:
        """Serve another run; None hides the line."""
        self._run, self._snapshot = run, None
        self._steps, self._touched, self._told = None, 0, ""
        self._tell.stop()
        self._written.forget()
        if run is not None:
            self._steps = NextSteps(run.placed, run.rings[0], run.depth_tolerance)
        self._stand()
        self._say("" if run is None else waiting_words())

    def set_ending(self, ends: bool) -> None:
        """Say that an attempt that was ended is being scored, or give orders again."""
        self._ends = ends
        if ends:
            self._say(ending_words())

    def give_way(self, on: bool) -> None:
        """Be there no more, because another line stands in this place, or be there again."""
        self._gives_way = on
        self._stand()

    def set_aside(self, aside: bool) -> None:
        """Leave the place over the views to the rail, which says the same, or take it again."""
        self._aside = aside
        self._stand()

    def follow_panel(self) -> None:
        """Speak of the start, or no more: another panel is shown."""
        self._ask()

    def _stand(self) -> None:
        self.setVisible(self._run is not None and not (self._gives_way or self._aside))

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Say what comes after this moment."""
        self._snapshot = snapshot
        touched = 0 if snapshot.touch is None else snapshot.touch.touched
        if touched > self._touched and snapshot.touch is not None:
            self._told = tr("✔ Target {n} of {of} touched", n=touched, of=len(snapshot.touch.task))
            self._tell.start()
            self.suit_room()
        self._touched = touched
        self._ask()

    def _stop_telling(self) -> None:
        self._told = ""
        self._tell.stop()
        self.suit_room()
        self._ask()

    def set_moves_hub(self, hub: bool) -> None:
        """Say where the hub goes, or the tip, where mouse or keys move the needle."""
        self._moves_hub = hub
        self._ask()

    def set_start(self, may: bool, why_not: str) -> None:
        """Take whether an attempt can begin now, and what is to be done or waited for before."""
        self._may_start, self._why_not = may, why_not
        self._ask()

    def suit_room(self) -> None:
        """Take another size of text or other colours."""
        ground = theme.now(theme.GOOD if self._told else theme.ACCENT)
        if not self.text():  # the place stays, so that the views below do not move
            ground = theme.now(theme.BACKGROUND)
        ink = theme.now(theme.BACKGROUND)
        style = (
            f"background: {ground}; color: {ink}; font-size: {self._fitting()}px; font-weight: 600;"
            f" padding: {PADDING}px;"
        )
        if style != self.styleSheet():
            self.setStyleSheet(style)
        # As high as for its largest letters: the views below do not move with the words.
        high = QFontMetrics(theme.font_of(theme.TITLE_PX, bold=True)).height()
        self.setFixedHeight(high + 2 * PADDING + 1)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Take letters that fit the new width."""
        super().resizeEvent(event)
        self.suit_room()

    def _fitting(self) -> int:
        """Largest letters with which the whole line can be read; the smallest are small ones [px].

        A line cut off at both ends tells neither what nor how far; that is worse in a room, too.
        """
        room, least = self.width() - 2 * PADDING, round(theme.SMALL_PX / theme.scale())
        for pixels in range(theme.TITLE_PX, least, -1):
            metrics = QFontMetrics(theme.font_of(pixels, bold=True))
            if metrics.horizontalAdvance(self.text()) <= room:
                return pixels
        return least

    def _say(self, words: str) -> None:
        self.setText(words)
        self.setToolTip(literal(words))
        self.suit_room()
        self.spoken.emit(words, bool(self._told))

    def _ask(self) -> None:
        if self._snapshot is not None:  # else there is nothing to say, and the first word waits
            self._written.ask()

    def _write(self) -> None:
        if self._steps is None or self._run is None or self._snapshot is None:
            return
        shown = self._run.shown
        step = self._steps.of(self._snapshot, shown.live, shown.orders)
        self.stepped.emit(step, shown.numbers)
        shows = self._run.demonstrates
        tip = not (self._run.held_at_hub or self._moves_hub)
        tracker = self._snapshot.tracker
        told_by = "" if tracker is None else tracker.told_by
        words = step_words(step, self._run.interactive or shows, tip, shown.numbers, told_by)
        if shows and step.kind is StepKind.START:
            words = tr("The demonstration begins")
        elif step.kind is StepKind.START and not self._may_start:
            words = self._why_not or waiting_words()
        elif step.kind is StepKind.START and not self._offers_start():
            words = ""
        elif self._snapshot.breath is not None and step.kind not in ASIDE:
            words = breath_words(self._snapshot.breath, words, not shows)
        words = ending_words() if self._ends else self._told or words
        if words != self.text():
            self._say(words)
