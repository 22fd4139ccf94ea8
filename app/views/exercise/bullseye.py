"""The view `bullseye`: pad, depth bar, corrections in words; and the simulated hand."""

from dataclasses import replace
from enum import IntEnum, auto
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import (
    QFont,
    QFontMetrics,
    QResizeEvent,
)
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.core.arrays import FloatArray
from app.planning.off_path import Offset
from app.session.pad.geometry import PathFrame
from app.session.pad.hand import HandPose, PadHand
from app.session.pad.view import NeedleLine, PadScene
from app.session.snapshot import NextStep, StepKind
from app.views.exercise.depth_bar import DepthBar
from app.views.exercise.hands.chooser import HandChooser
from app.views.exercise.hands.feed import FeedButton
from app.views.exercise.hands.source import HandChange
from app.views.exercise.pad_canvas import PadCanvas
from app.views.exercise.steps import amount
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, number, tr

STRAIGHT_DEG = 0.1
"""Corrections below this [°] are not asked for: five encoder counts."""


def towards(letters: str) -> str:
    """Patient direction of a letter group in words: `L` → "patient left (L)".

    Only the largest share is spelt out: the pad's edges show the rest.
    """
    words = {
        "L": tr("patient left"),
        "R": tr("patient right"),
        "A": tr("front"),
        "P": tr("back"),
        "S": tr("head"),
        "I": tr("feet"),
    }
    return f"{words[letters[0]]} ({letters})"


def corrections(
    frame: PathFrame, needle_tilts: ArrayLike, short: bool = False, hub: bool = False
) -> tuple[str, str]:
    """Return how to turn the needle onto the path: in the plane of the slice, and out of it.

    Args:
        frame: axes of the pad.
        needle_tilts: the needle's tilts against the path [rad], shape (2,).
        short: with the letters of a direction only.
        hub: whether it is said where the hub goes, not the tip.
    """
    right, up = np.degrees(np.asarray(needle_tilts, dtype=np.float64)).tolist()
    if hub:
        right, up = -right, -up
    left_letters, right_letters, top, bottom = frame.letters
    first, second = (
        (tr("In plane"), tr("Out of plane")) if frame.axial else (tr("Sideways"), tr("Up / down"))
    )
    return (
        _correction(first, -right, right_letters, left_letters, short, hub),
        _correction(second, -up, top, bottom, short, hub),
    )


def _correction(
    name: str, angle_deg: float, positive: str, negative: str, short: bool, hub: bool
) -> str:
    if abs(angle_deg) < STRAIGHT_DEG:
        return tr("{name}: ✔ on path", name=name)
    letters = positive if angle_deg > 0.0 else negative
    if short:
        return tr("{name}: {angle:.1f}° to {to}", name=name, angle=abs(angle_deg), to=letters)
    where = towards(letters)
    values = {"name": name, "angle": abs(angle_deg), "where": where}
    if hub:
        return tr("{name}: tilt the hub {angle:.1f}° towards {where}", **values)
    return tr("{name}: tilt the tip {angle:.1f}° towards {where}", **values)


def lateral(offset: Offset, short: bool = False) -> str:
    """Return how far the tip is off the path; not to which side: before the skin it is on the other
    one than the needle leads to, and would speak against the dot.
    """
    length = 1e3 * offset.lateral
    if short:
        return tr("{length:.1f} mm off path", length=length)
    return tr("off the path: {length:.1f} mm", length=length)


STEEPEST_DEG: Final = 85.0
"""Out of plane by more than this [°], a needle has no angle in the axial slice."""


def ct_words(frame: PathFrame, direction: ArrayLike, rest: PathFrame | None = None) -> str:
    """Angles of the needle against the axial slices, and those of the path.

    Args:
        frame: of the path to the target as it is now.
        direction: of the needle, in world, shape (3,).
        rest: of the path to the target at rest: its angle is the one that the others are read by,
            so that none of them jumps.
    """
    near, _ = (rest or frame).ct_angles((rest or frame).axis)
    path = frame.ct_angles(frame.axis, near)
    needle = frame.ct_angles(direction, path[0])
    return tr(
        "CT angles: in plane {a} (path {b})\nout of plane {c:+.1f}° (path {d:+.1f}°)",
        a=_in_plane(*needle),
        b=_in_plane(*path),
        c=needle[1],
        d=path[1],
    )


def _in_plane(angle_deg: float, out_of_plane_deg: float) -> str:
    return "–" if abs(out_of_plane_deg) > STEEPEST_DEG else number(angle_deg, "+.1f") + "°"


def remaining(offset: Offset, across: float, along: float) -> str:
    """Say how far to push or pull; at the target only within both tolerances [m]."""
    gap_mm = 1e3 * offset.remaining
    if offset.arrived(across, along):
        return tr("✔ at target: hold ({gap:+.1f} mm)", gap=-gap_mm)
    if abs(offset.remaining) <= along:
        return tr("beside the target")
    if gap_mm > 0.0:
        return tr("▼ push {gap:.1f} mm", gap=gap_mm)
    return tr("▲ too deep: pull {gap:.1f} mm", gap=-gap_mm)


DECLARATION: Final[dict[str, Any]] = {
    "view": "bullseye",
    "title": "Bull's-eye",
    "reads": ("tip_offset",),
}

INTENT_MS: Final = 10
"""Shortest time between two hand intents: 100 Hz."""

MOVING_MS: Final = 200
"""So long after a movement the loop may not show it yet [ms]."""


TALL: Final = 29
"""Height, in heights of the small letters, from which every word has its place."""

ROOMY_PAD: Final = 230
USUAL_PAD: Final = 180
SMALL_PAD: Final = 150
SMALLEST_PAD: Final = 130
"""Least width and height of the pad [px]: beside its words, smaller before words are cut short."""

NARROW_WIDTH: Final = 250
"""Widest that an empty pad needs to be [px]."""

QWIDGETSIZE_MAX: Final = 16777215
"""Qt's own constant for no limit, which PySide does not export."""


TURNS: Final = 3
DISTANCES: Final = 2
"""Shares of the width that the words on turns and those on distances have."""


_GAP: Final = 4
"""Between the rows of pad, words and hand [px]."""


def marks_words() -> str:
    """Say what the pad's marks mean."""
    return tr(
        "The dot is where the needle will pass the target: bring it into the middle. "
        "Rings: how far off, the inner two are the tolerance"
    )


def _legend_button(parent: QWidget) -> QToolButton:
    button = QToolButton(parent)
    button.setText("?")
    button.setCheckable(True)
    button.setChecked(True)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    button.setAccessibleName(tr("Legend"))
    button.setStyleSheet("padding: 1px 6px;")
    return button


class Brevity(IntEnum):
    """How much is said beside the pad, and in what letters: as much as there is room for."""

    LEGEND = auto()
    FULL = auto()
    WITHOUT_ANGLES = auto()
    SMALL = auto()
    SMALL_PAD = auto()
    SHORT = auto()


class Bullseye(QWidget):
    """Shows where the needle is against the path, and moves the simulated hand.

    Signals:
        hand_moved(HandPose): where the hand wants the needle; at most every `INTENT_MS`.
    """

    hand_moved = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._scene: PadScene | None = None
        self._view: NeedleLine | None = None
        self._hand: PadHand | None = None
        self._interactive = self._depth_only = self._hides_needle = self._held_at_hub = False
        self.pad = PadCanvas(self)
        self.depth_bar = DepthBar(self)
        self._remaining = _label(theme.FONT_PX + 6)
        self._in_plane = _label(theme.FONT_PX + 1)
        self._out_of_plane = _label(theme.FONT_PX + 1)
        self._source = _label(theme.SMALL_PX, theme.WARNING)
        self._figure = _label(theme.TITLE_PX)
        self._figure.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._figure.hide()
        self._plain = False
        self._lateral, self._angles = _label(theme.SMALL_PX), _label(theme.SMALL_PX)
        self._words = (
            self._remaining,
            self._in_plane,
            self._out_of_plane,
            self._source,
            self._lateral,
            self._angles,
        )
        self.source = HandChooser(self.pad, self)
        self._pull = FeedButton(self.pad.feed, False, self)
        self._push = FeedButton(self.pad.feed, True, self)
        self._marks = _label(theme.SMALL_PX, theme.TEXT_DIM)
        self._marks.setText(marks_words())
        self.legend = _legend_button(self)
        self._brevity = Brevity.FULL
        self._intent = QTimer(self, interval=INTENT_MS, singleShot=True)
        self._intent.timeout.connect(self._emit_hand)
        self._moving = QTimer(self, interval=MOVING_MS, singleShot=True)
        self._lay_out()
        self._connect_source()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Say no more than there is room for: the pad keeps its size, and nothing is cut."""
        super().resizeEvent(event)
        self._fit_words()

    def suit_text(self) -> None:
        """Take another size of text."""
        self.source.suit_text()
        self._fit_words()

    def set_plain(self, plain: bool) -> None:
        """Show pad, depth bar and one figure alone, as in an attempt, or all words again."""
        if plain is self._plain:
            return
        self._plain = plain
        self.depth_bar.set_narrow(plain)
        for button in (self._pull, self._push):
            button.set_brief(plain)
        self.source.setVisible(not plain)
        self.legend.setVisible(not plain)
        self._figure.setVisible(plain and not self._hides_needle)
        for label in self._words:
            label.setVisible(not (plain or self._hides_needle))
        self._fit_words()

    def show_step(self, step: NextStep, numbers: bool = True) -> None:
        """Say the one figure that belongs to the order: nothing here speaks for itself.

        `numbers`: whether the order itself says how far.
        """
        words = figure_of(step, numbers)
        if words != self._figure.text():
            self._figure.setText(words)

    def _fit_plain(self) -> None:
        self._marks.hide()
        beside = self.depth_bar, *(one for one in (self._pull, self._push) if not one.isHidden())
        aside = max(one.sizeHint().width() for one in beside) + 3 * theme.SPACING
        pad = max(SMALLEST_PAD // 2, min(SMALLEST_PAD, self.width() - aside))
        self.pad.setMinimumSize(pad, pad)  # in a narrower pane its letters would lie under the bar
        self.depth_bar.setMinimumHeight(SMALLEST_PAD // 2)
        self._figure.setStyleSheet(_label_style(theme.TITLE_PX, theme.TEXT))
        self._figure.setFixedHeight(
            QFontMetrics(theme.font_of(theme.TITLE_PX)).height() + theme.SPACING
        )

    def _fit_words(self) -> None:
        """Say as much as there is room for: in full, without the legend, without the angles,
        smaller, or in short.
        """
        if self._plain:
            self._fit_plain()
            return
        for brevity in Brevity:
            if brevity is Brevity.LEGEND and not self.legend.isChecked():
                continue
            self._show_legend(brevity is Brevity.LEGEND)
            self._take_brevity(brevity)
            spare = self.height() - self._needed_height()
            if brevity is Brevity.LEGEND:  # it takes hardly anything from the pad
                aside = self.depth_bar.sizeHint().width() + 3 * theme.SPACING
                spare -= max(0, (self.width() - aside) * 9 // 10 - self.pad.minimumHeight())
            if spare >= 0:
                break
        if self._scene is not None and self._view is not None:
            self._write(self._scene, self._view)

    def _show_legend(self, shown: bool) -> None:
        """Write what the marks mean and how the hand moves, or keep it in the button's tooltip."""
        self._marks.setVisible(shown and not self._hides_needle)
        self.source.set_wordy(shown)
        self.legend.setToolTip(
            literal(tr("Legend, shown or hidden") + f"\n\n{marks_words()}\n\n{self.source.words}")
        )

    def _take_brevity(self, brevity: Brevity) -> None:
        """Take fonts, and reserve the lines that the longest words take in them."""
        self._brevity = brevity
        small, short = brevity >= Brevity.SMALL, brevity >= Brevity.SHORT
        width = max(self.width() - 4 * theme.SPACING, 2)
        across, beside = (
            width * TURNS // (TURNS + DISTANCES),
            width * DISTANCES // (TURNS + DISTANCES),
        )
        turn = theme.SMALL_PX if small else theme.FONT_PX + 1
        distance = theme.FONT_PX if small else theme.FONT_PX + 6
        for label, pixels, longest, room in (
            (self._in_plane, turn, 26 if short else 46, across),
            (self._out_of_plane, turn, 26 if short else 46, across),
            (self._remaining, distance, 16, beside),
            (self._lateral, theme.SMALL_PX, 14 if short else 40, beside),
            (self._source, theme.SMALL_PX, 14 if short else 28, beside),
        ):
            colour = theme.WARNING if label is self._source else theme.TEXT
            style = _label_style(pixels, colour)
            if label.styleSheet() != style:
                label.setStyleSheet(style)
            font = QFont(label.font())
            font.setPixelSize(pixels)
            metrics = QFontMetrics(font)
            lines = -(-longest * metrics.averageCharWidth() // room)
            label.setMinimumHeight(min(lines, 3) * metrics.lineSpacing())
        tall = self.height() >= TALL * theme.SMALL_PX and brevity <= Brevity.FULL
        self._angles.setVisible(not self._hides_needle and tall)
        pad = ROOMY_PAD if brevity <= Brevity.WITHOUT_ANGLES else USUAL_PAD
        pad = SMALLEST_PAD if short else SMALL_PAD if brevity >= Brevity.SMALL_PAD else pad
        self.pad.setMinimumSize(pad, pad)
        buttons = 0 if self._push.isHidden() else 2 * (self._push.sizeHint().height() + 2)
        self.depth_bar.setMinimumHeight(pad - 20 - buttons)

    def _needed_height(self) -> int:
        """Height that pad, words and chooser take [px], with the longest words."""
        self._grid.invalidate()
        return self._grid.minimumHeightForWidth(self.width())

    # --- what the controller calls ----------------------------------------------------------------
    def set_scene(
        self,
        scene: PadScene | None,
        interactive: bool,
        depth_only: bool = False,
        held_at_hub: bool = False,
    ) -> None:
        """Take a new path.

        Args:
            scene: of the path; None clears everything.
            interactive: whether there is a simulated hand to move.
            depth_only: whether it moves the depth alone, because a person holds a real robot's
                needle and simulated cameras cannot see how deep it is.
            held_at_hub: whether a person holds the needle itself: orders are then for its hub.
        """
        self._scene, self._view, self._hand = scene, None, None
        self._interactive, self._depth_only = interactive, depth_only
        self._held_at_hub = held_at_hub
        self._intent.stop()
        self.pad.set_scene(scene)
        self.depth_bar.set_scene(scene)
        self.source.set_interactive(interactive, depth_only)
        for button in (self._pull, self._push):
            button.setVisible(interactive)
        for label in (*self._words, self._figure):
            label.clear()
        self._fit_words()

    def retarget(self, scene: PadScene) -> None:
        """Take the path to another target in the middle of an attempt: the hand goes on."""
        self._scene = scene
        self.pad.retarget(scene)
        self.depth_bar.retarget(scene)
        if self._hand is not None:
            self._hand = scene.hand(self._hand.pose)

    def hide_needle(self, hidden: bool, beside_scan: bool = True) -> None:
        """Show nothing of needle, hand and path from the next scene on; the hand still moves.

        `beside_scan`: whether an empty pad leaves the room to a control scan.
        """
        self._hides_needle = hidden
        self.pad.hide_needle(hidden)
        self.source.set_compact(hidden and beside_scan)
        self.setMaximumWidth(NARROW_WIDTH if hidden and beside_scan else QWIDGETSIZE_MAX)
        self.depth_bar.setVisible(not hidden)
        for label in self._words:
            label.setVisible(not (hidden or self._plain))
        self._figure.setVisible(self._plain and not hidden)
        self._fit_words()

    def show_view(self, view: NeedleLine) -> None:
        """Draw a new moment. Without a hand so far, the first measured one gives it the needle."""
        if self._scene is None or self._hides_needle:
            return
        self._view = view
        if self._hand is None and view.measured:
            # Never a depth that is only the model's: the hand would push the needle there.
            self.take_hand(HandPose(view.direction, view.depth, True))
        self._show(self._scene, view)

    def take_hand(self, pose: HandPose) -> None:
        """Go on from where the simulated hand is, without a jump."""
        if self._scene is not None and self._interactive:
            self._hand = self._scene.hand(pose)
            self._intent.start()

    def point(self, direction: FloatArray) -> None:
        """Let the simulated hand point the needle, in world, unit, shape (3,): its depth stays."""
        if self._scene is not None and self._hand is not None and self._interactive:
            self.take_hand(replace(self._hand.pose, direction=direction))
            self._moving.start()

    def let_go(self) -> None:
        """Move the hand no further with what is held now; pressed anew it moves again."""
        self.pad.let_go()
        self.source.let_go()

    @property
    def hand(self) -> HandPose | None:
        """Return where the simulated hand wants the needle; None without one."""
        return self._hand.pose if self._hand else None

    @property
    def is_moving(self) -> bool:
        """Return whether the user moved the hand so late that the loop may not show it yet."""
        return self._moving.isActive()

    # --- inside -----------------------------------------------------------------------------------
    def _show(self, scene: PadScene, view: NeedleLine) -> None:
        hand = self._hand
        # A tool's tip goes against the hand: that is what is learnt, and the dot is the tip.
        hub = scene.handle is None and (self.source.moves_hub or self._held_at_hub)
        self.pad.show_view(view, hub)
        self.depth_bar.show_depth(view.depth, view.measured, hand.pose.depth if hand else None)
        if not self._plain:  # nobody sees them in an attempt; afterwards they are written anew
            self._write(scene, view)

    def _write(self, scene: PadScene, view: NeedleLine) -> None:
        """Say in words what the pad shows; what is said in short stands in full in the tooltip."""
        frame, short = view.frame(scene), self._brevity >= Brevity.SHORT
        tilts = frame.tilts(view.direction)
        turns = (self._in_plane, self._out_of_plane)
        hub = self.source.moves_hub or self._held_at_hub
        whole, said = corrections(frame, tilts, hub=hub), corrections(frame, tilts, short, hub)
        for label, text, words in zip(turns, said, whole, strict=True):
            label.setText(text)
            label.setToolTip(literal(words if short else ""))
        self._angles.setText(ct_words(frame, view.direction, scene.frame))
        distance = remaining(view.offset, scene.rings[0], scene.depth_tolerance)
        # A guess is never said as if it were known.
        self._remaining.setText(distance if view.measured else "–")
        beside = lateral(view.offset)
        said_beside = lateral(view.offset, short)
        self._lateral.setText(said_beside if view.measured else "–")
        self._lateral.setToolTip(literal(beside if view.measured and short else ""))
        guessed = tr("◇ depth not measured now")
        said_guessed = tr("◇ not measured") if short else guessed
        self._source.setText("" if view.measured else said_guessed)
        self._source.setToolTip(literal(guessed if not view.measured and short else ""))

    def _connect_source(self) -> None:
        self.source.moved.connect(self._move)
        self.source.homed.connect(self._home)
        self.source.turned.connect(self._fit_words)
        self.legend.toggled.connect(self._fit_words)

    def _home(self) -> None:
        view = self._view
        if view is not None:
            depth = view.depth if view.measured else None
            self._move(lambda hand: hand.follow(view.direction, depth))

    def _move(self, change: HandChange) -> None:
        if (
            self._hand is None
            or self._scene is None
            or (self._view is None and not self._hides_needle)
        ):
            return
        change(self._hand)
        self._moving.start()
        if self._view is not None:
            self._show(self._scene, self._view)
        if not self._intent.isActive():
            self._intent.start()

    def _emit_hand(self) -> None:
        if self._hand is not None:
            self.hand_moved.emit(self._hand.pose)

    def _lay_out(self) -> None:
        words = QVBoxLayout()
        words.setSpacing(2)
        for label in (self._in_plane, self._out_of_plane, self._angles):
            words.addWidget(label)
        side = QVBoxLayout()
        side.setSpacing(2)
        for label in (self._remaining, self._lateral, self._source):
            side.addWidget(label)
        said = QHBoxLayout()
        said.setSpacing(2 * theme.SPACING)  # what turns is not read on into what is to be pushed
        said.addLayout(words, TURNS)
        said.addLayout(side, DISTANCES)
        depth = QVBoxLayout()
        depth.setSpacing(2)
        depth.addWidget(self._pull)
        depth.addWidget(self.depth_bar, 1)
        depth.addWidget(self._push)
        hand = QHBoxLayout()
        hand.addWidget(self.source, 1)
        hand.addWidget(self.legend, 0, Qt.AlignmentFlag.AlignBottom)
        self._grid = grid = QGridLayout(self)
        grid.setSizeConstraint(QGridLayout.SizeConstraint.SetNoConstraint)  # words give way
        grid.setContentsMargins(theme.SPACING, theme.SPACING, theme.SPACING, theme.SPACING)
        grid.setVerticalSpacing(_GAP)
        grid.addWidget(self.pad, 0, 0)
        grid.addLayout(depth, 0, 1)
        grid.addLayout(said, 1, 0, 1, 2)
        grid.addWidget(self._figure, 2, 0, 1, 2)
        grid.addWidget(self._marks, 3, 0, 1, 2)
        grid.addLayout(hand, 4, 0, 1, 2)
        grid.setRowStretch(0, 1)
        grid.setColumnStretch(0, 1)


_TICKED: Final = (StepKind.HOLD, StepKind.STAY, StepKind.FINISH)


def figure_of(step: NextStep, numbers: bool = True) -> str:
    """Return the one figure of an order, in millimetres; a tick where there is nothing to do.

    Empty where there is a way to go and `numbers` are not to be said.
    """
    if step.kind in _TICKED:
        return tr("✔ hold")
    if not numbers:
        return ""
    across, along = 1e3 * step.across, 1e3 * abs(step.distance)
    return {
        StepKind.TILT: tr("{mm} mm off", mm=amount(across)),
        StepKind.TOUCH: tr("{mm} mm off", mm=amount(across)),
        StepKind.INSERT: tr("▼ {mm} mm", mm=amount(along)),
        StepKind.DEEPER: tr("▼ {mm} mm", mm=amount(along)),
        StepKind.BACK: tr("▲ {mm} mm", mm=amount(along)),
    }.get(step.kind, "")


def _label(pixels: int, colour: str = "") -> QLabel:
    label, colour = PlainLabel(), colour or theme.TEXT
    label.setStyleSheet(_label_style(pixels, colour))
    label.setWordWrap(True)  # in a small cell with large text nothing is cut
    return label


def _label_style(pixels: int, colour: str) -> str:
    return f"font-size: {pixels}px; color: {colour};"
