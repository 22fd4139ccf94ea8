"""What panels of steps have in common: what is held, the next step, another one, the results."""

from __future__ import annotations

from collections.abc import Sequence
from time import monotonic
from typing import Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from app.session.procedure import CHECKS, ProcedureState, Step, check_words
from app.views.kit import theme
from app.views.kit.parts import FittingButton, PlainLabel
from app.views.kit.text import literal, tr, translated


def step_button() -> QPushButton:
    """Make a button of a step."""
    button = FittingButton("")
    # A button that keeps the focus would swallow the pad's keys.
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    button.setMinimumHeight(theme.CONTROL_HEIGHT)
    return button


class KeyedPanel(QWidget):
    """A panel whose buttons have keys that work wherever its page is shown."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._keys: list[tuple[QShortcut, QPushButton]] = []
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        self._column = column

    def listen(self, page: QWidget) -> None:
        """Let the keys work wherever `page` is shown."""
        for shortcut, _ in self._keys:
            shortcut.setParent(page)

    def _key(self, key: str, button: QPushButton) -> None:
        shortcut = QShortcut(QKeySequence(key), self)
        shortcut.setAutoRepeat(False)
        shortcut.activated.connect(button.click)
        self._keys.append((shortcut, button))

    def _follow_buttons(self) -> None:
        """Let each key do something where its button does."""
        for shortcut, button in self._keys:
            shortcut.setEnabled(button.isEnabled() and not button.isHidden())


OTHER_KEY: Final = "Alt+J"

ANSWERED_S: Final = 0.5
"""A step that was asked for shows in the state, or is refused, within this time [s]."""

_NEWEST: Final = 3
"""Lines of what was done that are shown."""


class StepPanel(KeyedPanel):
    """Offers the step that follows (J), and beside it another that may follow as well (Alt+J).

    Signals:
        asked(Step, int, float): do this, by this setting, the notch turned so [°].
    """

    asked = Signal(object, int, float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state: ProcedureState | None = None
        self._step: Step | None = None
        self._beside: Step | None = None
        self._asked: tuple[Step | None, ProcedureState | None] = None, None
        self._asked_at = 0.0
        self.held, self.results = PlainLabel(self), PlainLabel(self)
        self.next, self.other = step_button(), step_button()
        self.held.setWordWrap(True)
        self.results.setWordWrap(True)
        self.next.setToolTip(literal(tr("What follows in the usual order")))
        self.other.setToolTip(literal(tr("What may be done in its place")))
        self.next.clicked.connect(lambda: self._ask(self._step))
        self.other.clicked.connect(lambda: self._ask(self._beside))
        self._key("J", self.next)
        self._key(OTHER_KEY, self.other)

    def _ask(self, step: Step | None) -> None:
        """Ask for a step: whoever presses faster than its state comes back asks once."""
        now, asked = monotonic(), (step, self._state)
        again = step is self._asked[0] and self._state is self._asked[1]
        if step is None or (again and now - self._asked_at < ANSWERED_S):
            return
        self._asked, self._asked_at = asked, now
        self.asked.emit(step, *self._setting())

    def _setting(self) -> tuple[int, float]:
        """Return the setting that is chosen, and how the notch is turned [°]."""
        raise NotImplementedError

    def _show_results(self, warnings: Sequence[str], done: Sequence[str]) -> None:
        """Show what is warned of and what was done last; the tip has all of it.

        All lines of a long procedure would push the attempt's own buttons off a small screen.
        """
        self.results.setText("\n".join((*warnings, *done[-_NEWEST:])))
        self.results.setToolTip(literal("\n".join((*warnings, *done))))
        self.results.setVisible(bool(self.results.text()))

    def _offer_other(self, step: Step | None) -> None:
        """Show another step beside the next one; None for none."""
        self._beside = step
        self.other.setText(other_words(step))
        self.other.setVisible(step is not None)
        self.other.setEnabled(step is not None)


def first_of(state: ProcedureState, possible: set[Step] | tuple[Step, ...]) -> Step | None:
    """Return what of the checklist comes next, before all else; None where nothing does."""
    if not state.checks_left:
        return None
    return next((step for step in CHECKS if step in possible), None)


def other_step(
    state: ProcedureState, possible: set[Step] | tuple[Step, ...], inside: bool | None
) -> Step | None:
    """Return what may be done in place of the next step where nobody tells where the tip is.

    More local anaesthetic, where the key takes the needle; the patient turned, where the key would
    go on with another sample.
    """
    if inside is None and state.deposits and Step.INJECT in possible:
        return Step.INJECT
    if inside is None and Step.ROLL_OVER in possible and Step.STYLET_OUT in possible:
        return Step.ROLL_OVER
    return None


def other_words(step: Step | None) -> str:
    """Say what the button of another step does."""
    if step is Step.INJECT:
        return tr("Give more (Alt+J)")
    return "" if step is None else tr("Turn the patient (Alt+J)")


def shared_words(step: Step | None) -> str:
    """Say what the button of a step does that every procedure may have; empty for another."""
    return {
        Step.INJECT: tr("Give local anaesthetic (J)"),
        Step.CONSENT: tr("Ask for consent (J)"),
        Step.COAGULATION: tr("Check coagulation (J)"),
        Step.ROLL_OVER: tr("Turn the patient (J)"),
    }.get(step or Step.FIRE, "")


def shared_results(state: ProcedureState) -> list[str]:
    """Say what of checklist and turning was done, a line each."""
    done = [*state.checked, *([Step.ROLL_OVER] if state.rolled else [])]
    return [f"✔ {translated(check_words(state.part, step))}" for step in done]
