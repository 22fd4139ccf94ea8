"""The view `bullseye`: pad, depth bar, corrections in words; and the simulated hand."""

from typing import Any, Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QGridLayout, QLabel, QVBoxLayout, QWidget

from app.session.pad.hand import HandPose, PadHand
from app.session.pad.view import PadScene, PadView
from app.views.exercise.depth_bar import DepthBar
from app.views.exercise.hands.chooser import HandChooser
from app.views.exercise.hands.source import HandChange
from app.views.exercise.pad_canvas import PadCanvas
from app.views.exercise.words import corrections, ct_words, lateral, remaining
from app.views.kit import theme
from app.views.kit.text import tr

DECLARATION: Final[dict[str, Any]] = {
    "view": "bullseye",
    "title": "Bull's-eye",
    "reads": ("tip_offset_x", "tip_offset_y", "tip_offset_z"),
}

INTENT_MS: Final = 10
"""Shortest time between two hand intents: 100 Hz."""


WIDE: Final = 42
TALL: Final = 29
"""Width and height, in heights of the small letters, from which every word has its place."""

NARROW_WIDTH: Final = 250
"""Widest that an empty pad needs to be [px]."""

QWIDGETSIZE_MAX: Final = 16777215
"""Qt's own constant for no limit, which PySide does not export."""


class Bullseye(QWidget):
    """Shows where the needle is against the path, and moves the simulated hand.

    Signals:
        hand_moved(HandPose): where the hand wants the needle; at most every `INTENT_MS`.
    """

    hand_moved = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._scene: PadScene | None = None
        self._view: PadView | None = None
        self._hand: PadHand | None = None
        self._interactive = self._depth_only = self._hides_needle = False
        self.pad = PadCanvas(self)
        self.depth_bar = DepthBar(self)
        self._remaining = _label(theme.FONT_PX + 6)
        self._in_plane = _label(theme.FONT_PX + 1)
        self._out_of_plane = _label(theme.FONT_PX + 1)
        self._source = _label(theme.SMALL_PX, theme.WARNING)
        self._lateral, self._angles = _label(theme.SMALL_PX), _label(theme.SMALL_PX)
        self._words = (self._remaining, self._in_plane, self._out_of_plane, self._source,
                       self._lateral, self._angles)  # fmt: skip
        self.source = HandChooser(self.pad, self)
        self._intent = QTimer(self, interval=INTENT_MS, singleShot=True)
        self._intent.timeout.connect(self._emit_hand)
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

    def _fit_words(self) -> None:
        """Reserve the lines that the longest words take; leave out what can be done without."""
        across = max(self.width() // 2 - 2 * theme.SPACING, 1)
        beside = max(min(across, self.depth_bar.width()), 1)
        for label, longest, room in (
            (self._in_plane, 46, across), (self._out_of_plane, 46, across),
            (self._remaining, 16, beside), (self._lateral, 40, beside), (self._source, 28, beside),
        ):  # fmt: skip
            metrics = label.fontMetrics()
            lines = -(-longest * metrics.averageCharWidth() // room)
            label.setMinimumHeight(min(lines, 3) * metrics.lineSpacing())
        self._angles.setVisible(not self._hides_needle and self.height() >= TALL * theme.SMALL_PX)
        if not self._hides_needle:
            self.source.set_brief(self.width() < WIDE * theme.SMALL_PX)

    # --- what the controller calls ----------------------------------------------------------------
    def set_scene(
        self, scene: PadScene | None, interactive: bool, depth_only: bool = False
    ) -> None:
        """Take a new path.

        Args:
            scene: of the path; None clears everything.
            interactive: whether there is a simulated hand to move.
            depth_only: whether it moves the depth alone, because a person holds a real robot's
                needle and simulated cameras cannot see how deep it is.
        """
        self._scene, self._view, self._hand = scene, None, None
        self._interactive, self._depth_only = interactive, depth_only
        self._intent.stop()
        self.pad.set_scene(scene)
        self.depth_bar.set_scene(scene)
        self.source.set_interactive(interactive, depth_only)
        for label in self._words:
            label.clear()

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
            label.setVisible(not hidden)
        self._fit_words()

    def show_view(self, view: PadView) -> None:
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
            self._hand = PadHand(self._scene.frame, self._scene.scale, self._scene.limits, pose)
            self._intent.start()

    @property
    def hand(self) -> HandPose | None:
        """Where the simulated hand wants the needle; None without one."""
        return self._hand.pose if self._hand else None

    # --- inside -----------------------------------------------------------------------------------
    def _show(self, scene: PadScene, view: PadView) -> None:
        hand = self._hand
        self.pad.show_view(view, hand.tilts if hand and not self._depth_only else None)
        self.depth_bar.show_depth(view.depth, view.measured, hand.pose.depth if hand else None)
        frame = view.frame(scene)
        in_plane, out_of_plane = corrections(frame, frame.tilts(view.direction))
        self._in_plane.setText(in_plane)
        self._out_of_plane.setText(out_of_plane)
        self._angles.setText(ct_words(frame, view.direction))
        distance = remaining(view.offset, scene.rings[0], scene.depth_tolerance)
        # A guess is never said as if it were known.
        self._remaining.setText(distance if view.measured else "–")
        beside = lateral(frame, view.offset)
        self._lateral.setText(beside if view.measured else "–")
        self._source.setText("" if view.measured else tr("◇ depth not measured now"))

    def _connect_source(self) -> None:
        self.source.moved.connect(self._move)
        self.source.homed.connect(self._home)

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
        grid = QGridLayout(self)
        grid.setContentsMargins(theme.SPACING, theme.SPACING, theme.SPACING, theme.SPACING)
        grid.addWidget(self.pad, 0, 0)
        grid.addWidget(self.depth_bar, 0, 1)
        grid.addLayout(words, 1, 0)
        side = QVBoxLayout()
        side.addWidget(self._remaining)
        side.addWidget(self._lateral)
        side.addWidget(self._source)
        grid.addLayout(side, 1, 1)
        grid.addWidget(self.source, 2, 0, 1, 2)
        grid.setRowStretch(0, 1)
        grid.setColumnStretch(0, 1)
        grid.setColumnStretch(1, 1)


def _label(pixels: int, colour: str = "") -> QLabel:
    label, colour = QLabel(), colour or theme.TEXT
    label.setStyleSheet(f"font-size: {pixels}px; color: {colour};")
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)  # in a small cell with large text nothing is cut
    return label
