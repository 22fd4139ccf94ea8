"""The bar by which the watched arm is led: it says what the arm does, and has the buttons."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QSizePolicy, QWidget

from app.arm.views.play import ArmPlay, PlayState
from app.views.kit import theme
from app.views.kit.parts import PlainLabel, button
from app.views.kit.text import literal, tr


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
        values = {"what": what, "now": play.t, "all": play.duration}
        words = (
            tr("Simulated arm: {what}  ·  {now:.0f}/{all:.0f} s", **values)
            if play.playing
            else tr("Simulated arm  ‖  {what}  ·  {now:.0f}/{all:.0f} s", **values)
        )
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
