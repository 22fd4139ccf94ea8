"""Chooses what moves the simulated hand, and how far; says how it works."""

from collections.abc import Callable
from typing import Final

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QComboBox, QSizePolicy, QVBoxLayout, QWidget

from app.core.errors import AcusError
from app.session.pad.hand import GAINS
from app.views.exercise.hands.source import GamepadHand, HandSource, MouseHand, TabletHand
from app.views.exercise.pad_canvas import PadCanvas
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, tr, translated

SOURCES: Final[dict[str, Callable[[PadCanvas], HandSource]]] = {
    source.name: source for source in (MouseHand, TabletHand, GamepadHand)
}
"""Name in settings and records -> how it is made."""


NARROWEST: Final = 64
"""Least width of a choice [px]: its words are cut before the pad has no room."""


def source_title(name: str) -> str:
    """Name of a source for people."""
    return {
        "mouse": tr("mouse, keys"),
        "tablet": tr("pen tablet"),
        "gamepad": tr("gamepad"),
    }.get(name, name)


def source_help(name: str, handle: bool = False) -> str:
    """Say in one line how a source moves the hand; `handle`: of a long tool, held by its handle."""
    if handle and name == "mouse":
        return tr(
            "Drag or arrows: move the handle, and the tip goes the other way  ·  wheel away from "
            "you, Page Down, right button: push; hold: go on  ·  Shift: finer"
        )
    return {
        "mouse": tr(
            "Drag or arrows: tilt  ·  wheel away from you, Page Down, right button: push; "
            "hold: go on  ·  Shift: finer  ·  Home: hand to needle"
        ),
        "tablet": tr(
            "Hold the pen like the needle, its point on the pad: lean it to tilt  ·  press: "
            "push in, with the side button: pull  ·  wheel or Page keys: 1 mm"
        ),
        "gamepad": tr(
            "Left stick: tilt  ·  right stick away from you: push in, towards you: pull  ·  "
            "A: hand to needle"
        ),
    }.get(name, "")


def depth_help() -> str:
    """Say in one line what is left to move where a person holds a real robot's needle."""
    return tr(
        "You hold the needle. The simulated cameras cannot see how deep it is: say it by "
        "wheel or Page keys, 1 mm  ·  Shift: finer"
    )


class HandChooser(QWidget):
    """Keeps one source open while there is a simulated hand.

    A source that cannot be opened is refused with its reason, and the mouse takes over.

    Signals:
        moved(HandChange), homed(): of the source that is open.
        chosen(str): the user chose this source, by name.
        turned(): the user chose whether tip or hub goes where the hand goes.
        refused(str): why a source cannot be used.
    """

    moved = Signal(object)
    homed = Signal()
    chosen = Signal(str)
    turned = Signal()
    refused = Signal(str)

    def __init__(self, pad: PadCanvas, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._pad = pad
        self._source: HandSource | None = None
        self._interactive = self._depth_only = self._busy = self._compact = False
        self._why, self._own = "", ("mouse", "direct")
        self._turn_why, self._own_turn = "", False
        self._note = ""
        self.box, self.gain, self._help = _source_box(), _gain_box(), PlainLabel(self)
        self.sense = _sense_box()
        self._boxes = self.box, self.gain, self.sense
        self._help.setWordWrap(True)
        # Its words keep three lines: the pad keeps its size whatever is chosen.
        self._help.setFixedHeight(4 * theme.SMALL_PX)
        self._help.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._help.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self._title = title = PlainLabel(tr("Hand"), self)
        title.setProperty("role", "dim")
        self._row = row = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        row.addWidget(title)
        for widget in self._boxes:
            widget.setMinimumWidth(NARROWEST)
            row.addWidget(widget)
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self._help)
        column.addLayout(row)
        self._wordy = True
        self.box.activated.connect(self._choose)
        self.gain.currentIndexChanged.connect(self._pass_gain)
        self.sense.currentIndexChanged.connect(self._pass_sense)
        self.set_interactive(False)

    @property
    def name(self) -> str:
        """Source that is chosen."""
        return str(self.box.currentData())

    @property
    def source(self) -> HandSource | None:
        """Source that is open; None without a simulated hand."""
        return self._source

    @property
    def moves_hub(self) -> bool:
        """Return whether the hub goes where the hand goes, and so the tip the other way."""
        return bool(self.sense.currentData())

    @property
    def own_moves_hub(self) -> bool:
        """Return whether the user has it so, whatever an exercise has fixed: what is remembered."""
        return self._own_turn if self._turn_why else self.moves_hub

    @property
    def why_sense_stays(self) -> str:
        """Return why the exercise keeps which end goes where the hand goes; empty where it does
        not.
        """
        return self._turn_why

    def set_moves_hub(self, hub: bool) -> None:
        """Let the hub go where the hand goes, or the tip; kept for later where that is fixed."""
        if self._turn_why:
            self._own_turn = hub
        else:
            self._turn(hub)

    def _turn(self, hub: bool) -> None:
        self.sense.setCurrentIndex(self.sense.findData(hub))

    def let_go(self) -> None:
        """Move no further with what is held now."""
        if self._source is not None:
            self._source.let_go()

    def set_source(self, name: str) -> None:
        """Choose a source by name, as if the user had; an unknown one is the mouse. Where an
        exercise has fixed another, it is kept for later.
        """
        if self._why:
            self._own = name, self._own[1]
            return
        self._take(name)

    def fix(self, name: str, reason: str) -> None:
        """Use this source at the usual gain, because of `reason`, until `release`."""
        if not self._why:
            self._own = self.name, str(self.gain.currentData())
        self._why = reason
        self.gain.setCurrentIndex(max(0, self.gain.findData("direct")))
        self._take(name)
        self._enable()

    def release(self) -> None:
        """Leave source and gain to the user again, as they were; idempotent."""
        if self._why:
            self._why = ""
            name, gain = self._own
            self.gain.setCurrentIndex(max(0, self.gain.findData(gain)))
            self._take(name)
            self._enable()

    def fix_sense(self, hub: bool, reason: str) -> None:
        """Let the hub go where the hand goes, or the tip, because of `reason`, until released.

        The hub is then the handle of a long tool, and the help says so.
        """
        if not self._turn_why:
            self._own_turn = self.moves_hub
        self._turn_why = reason
        self._turn(hub)
        self._enable()
        self._show_note(self._note)

    def release_sense(self) -> None:
        """Leave it to the user again, as it was; idempotent."""
        if self._turn_why:
            self._turn_why = ""
            self.set_moves_hub(self._own_turn)
            self._enable()
            self._show_note(self._note)

    def _take(self, name: str) -> None:
        with QSignalBlocker(self.box):
            self.box.setCurrentIndex(max(0, self.box.findData(name)))
        self._reopen()

    def set_interactive(self, interactive: bool, depth_only: bool = False) -> None:
        """Say whether there is a simulated hand to move; without one nothing listens.

        With `depth_only` it is the mouse whatever is chosen, and its wheel and Page keys count.
        """
        self._interactive, self._depth_only = interactive, depth_only
        self._enable()
        self._reopen()

    def set_compact(self, compact: bool) -> None:
        """Leave only the two choices, one below the other; their help says how the hand moves."""
        ways = QBoxLayout.Direction
        self._row.setDirection(ways.TopToBottom if compact else ways.LeftToRight)
        self._compact = compact
        self._share_row()
        self._show_help()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share the row anew."""
        super().resizeEvent(event)
        self._share_row()

    def _share_row(self) -> None:
        """Give each choice the room that its words need, and leave the title out before they do."""
        wanted = [box.sizeHint().width() for box in self._boxes]
        for place, width in enumerate(wanted, 1):
            self._row.setStretch(place, width)
        shown = [w for w, box in zip(wanted, self._boxes, strict=True) if not box.isHidden()]
        gaps = len(shown) * max(0, self._row.spacing())
        needed = sum(shown) + gaps + self._title.sizeHint().width()
        self._title.setVisible(not self._compact and needed <= self.width())

    def set_wordy(self, wordy: bool) -> None:
        """Say how the hand moves, or only what the user must know now."""
        self._wordy = wordy
        self._show_help()

    @property
    def words(self) -> str:
        """Return how the hand moves; empty without one."""
        return self._words() if self._interactive else ""

    def _show_help(self) -> None:
        said = self._interactive and (self._wordy or bool(self._note))
        self._help.setVisible(said and not self._compact)
        self._column.invalidate()  # at once: who holds this asks for its height
        self.updateGeometry()

    def set_locked(self, locked: bool) -> None:
        """Keep the source while an attempt runs: it is recorded with it."""
        self._busy = locked
        self._enable()

    def _enable(self) -> None:
        usable = self._interactive and not self._depth_only and not self._why
        self.gain.setEnabled(usable)
        self.sense.setEnabled(self._interactive and not self._depth_only and not self._turn_why)
        self.sense.setVisible(not self._turn_why)  # the help says it: the others have its room
        self._share_row()
        self.box.setEnabled(usable and not self._busy)
        self.gain.setToolTip(literal(self._why or gain_help()))
        self.box.setToolTip(literal(self._why or self._words()))

    def _choose(self) -> None:
        self._reopen()
        self.chosen.emit(self.name)

    def _reopen(self) -> None:
        source, self._source = self._source, None
        if source is not None:
            source.close()
            source.deleteLater()
        self._show_note("")
        if self._interactive:
            try:
                self._open("mouse" if self._depth_only else self.name)
            except AcusError as error:
                self.refused.emit(translated(error))
                self._take("mouse")

    def _open(self, name: str) -> None:
        source = SOURCES[name](self._pad)
        source.gain = GAINS[self.gain.currentData()]
        source.sense = -1.0 if self.moves_hub else 1.0
        source.moved.connect(self.moved)
        source.homed.connect(self.homed)
        source.noted.connect(self._show_note)
        try:
            source.open()
        except AcusError:
            source.deleteLater()
            raise
        self._source = source

    def _pass_gain(self) -> None:
        if self._source is not None:
            self._source.gain = GAINS[self.gain.currentData()]

    def _pass_sense(self) -> None:
        if self._source is not None:
            self._source.sense = -1.0 if self.moves_hub else 1.0
        self.turned.emit()

    def suit_text(self) -> None:
        """Take another size of the text."""
        self._help.setFixedHeight(4 * theme.SMALL_PX)
        self._share_row()
        self._show_note(self._note)

    def _show_note(self, note: str) -> None:
        self._note = note
        colour = theme.WARNING if note else theme.TEXT_DIM
        self._help.setStyleSheet(f"font-size: {theme.SMALL_PX}px; color: {colour};")
        text = f"▲ {note}" if note else self._words()
        self._help.setText(text if self._interactive else "")
        self._show_help()
        self.box.setToolTip(literal(self._why or self._words()))

    def _words(self) -> str:
        if self._depth_only:
            return depth_help()
        return source_help(self.name, bool(self._turn_why))


def _source_box() -> QComboBox:
    box = QComboBox()
    for name in SOURCES:
        box.addItem(source_title(name), name)
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    box.setAccessibleName(tr("Hand"))
    return box


def sense_help() -> str:
    """Say what the choice of the end that is moved means."""
    return tr(
        "Which end goes where mouse, keys or stick go, as the bull's-eye shows it. The tip: to "
        "the right is to the right. The hub: as the real needle turns about the skin, hub to "
        "the right brings the tip to the left."
    )


def _sense_box() -> QComboBox:
    box = QComboBox()
    box.addItem(tr("moves the tip"), False)
    box.addItem(tr("moves the hub"), True)
    box.setToolTip(literal(sense_help()))
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    box.setAccessibleName(tr("The hand moves"))
    return box


def gain_help() -> str:
    """Say what the gain is."""
    return tr("How far the hand moves when mouse, pen or stick moves")


def _gain_box() -> QComboBox:
    box = QComboBox()
    names = {"fine": tr("fine"), "normal": tr("normal"), "direct": tr("direct")}
    for key in GAINS:
        box.addItem(f"{names[key]} ×{GAINS[key]:g}", key)
    box.setCurrentIndex(list(GAINS).index("direct"))
    box.setToolTip(literal(gain_help()))
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return box
