"""The patient beside the needle: what the monitor shows, and what is answered to a complication."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QComboBox, QPushButton, QVBoxLayout, QWidget

from app.scoring.complications.answers import ANSWER_WORDS, Reaction
from app.session.complications import ComplicationsState
from app.views.kit import theme
from app.views.kit.parts import FittingButton, PlainLabel
from app.views.kit.text import literal, tr, translated


class ComplicationPanel(QWidget):
    """Shows the patient's vital signs and offers the answers; hidden where nothing can happen.

    Signals:
        noticed(): something is wrong.
        answered(Reaction): this is done about it.
    """

    noticed = Signal()
    answered = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: tuple[ComplicationsState | None, bool] = None, False
        self.vitals, self.given = PlainLabel(self), PlainLabel(self)
        self.notice, self.answer = _button(), _button()
        self.choice = QComboBox(self)
        self._keys: list[tuple[QShortcut, QPushButton]] = []
        self._prepare()
        self._lay_out()
        self.hide()

    def listen(self, page: QWidget) -> None:
        """Let the keys work wherever `page` is shown."""
        for shortcut, _ in self._keys:
            shortcut.setParent(page)

    def show_patient(self, state: ComplicationsState | None, commands: bool) -> None:
        """Show how the patient is, or nothing.

        Args:
            state: what can be seen of him; None where nothing can happen.
            commands: whether something can be answered now.
        """
        self.setVisible(state is not None)
        if (state, commands) == self._shown:
            return
        self._shown = state, commands
        self._enable(state is not None and commands)
        if state is None:
            return
        self.vitals.setText(translated(state.vitals.sentence))
        self.given.setText("\n".join(translated(answer) for answer in state.answers))
        self.given.setVisible(bool(state.answers))

    def _enable(self, can_be: bool) -> None:
        for widget in (self.notice, self.answer, self.choice):
            widget.setEnabled(can_be)
        for shortcut, _ in self._keys:
            shortcut.setEnabled(can_be)

    def _prepare(self) -> None:
        self.vitals.setWordWrap(True)
        self.given.setWordWrap(True)
        self.vitals.setToolTip(tr("What the monitor shows, and what the patient says"))
        self.notice.setText(tr("Something is wrong (Shift+J)"))
        self.notice.setToolTip(literal(tr("Say it as soon as you see it: the time counts")))
        self.answer.setText(tr("Do this (Ctrl+Shift+J)"))
        self.answer.setToolTip(literal(tr("Do what is chosen here")))
        self.choice.setAccessibleName(tr("What is to be done"))
        self.choice.setToolTip(tr("What is to be done about a complication, by its size"))
        self.choice.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        # A rail is narrower than the longest answer; the open list shows it whole.
        self.choice.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.choice.setMinimumContentsLength(8)
        for answer in Reaction:
            self.choice.addItem(translated(ANSWER_WORDS[answer]), answer)
        self.notice.clicked.connect(self.noticed)
        self.answer.clicked.connect(lambda: self.answered.emit(self.choice.currentData()))
        for key, button in (("Shift+J", self.notice), ("Ctrl+Shift+J", self.answer)):
            shortcut = QShortcut(QKeySequence(key), self)
            shortcut.setAutoRepeat(False)
            shortcut.activated.connect(button.click)
            self._keys.append((shortcut, button))
        self._enable(False)

    def _lay_out(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        title = PlainLabel(tr("Patient"), self)
        title.setProperty("role", "heading")
        for widget in (title, self.vitals, self.notice, self.choice, self.answer, self.given):
            column.addWidget(widget)


def _button() -> QPushButton:
    button = FittingButton("")
    # A button that keeps the focus would swallow the pad's keys.
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    button.setMinimumHeight(theme.CONTROL_HEIGHT)
    return button
