"""The exercise panel: what is practised, by whom, with how much help, and how it goes."""

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QRegularExpression, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QRegularExpressionValidator
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QSizePolicy,
    QSlider,
    QVBoxLayout,
    QWidget,
)

from app.session.machine import RUNNING, State
from app.views import theme
from app.views.exercise.actions import AttemptActions
from app.views.exercise.live import LiveFigures
from app.views.exercise.readouts import Readouts
from app.views.exercise.steps import Steps
from app.views.text import tr

PSEUDONYM: Final = r"([A-Za-z0-9][A-Za-z0-9._-]{0,31})?"
"""What a pseudonym may look like; empty for an anonymous attempt."""


class ExercisePanel(QWidget):
    """Everything around the pad; holds no state of the attempt.

    The signals of the other buttons are those of `buttons`.

    Signals:
        exercise_chosen(str): identifier of the exercise.
        start_requested(str): pseudonym of the student.
        assistance_changed(float): 0 off … 1 full guidance.
    """

    exercise_chosen = Signal(str)
    start_requested = Signal(str)
    assistance_changed = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._ready = False
        self._state: State | None = None
        self.exercise = QComboBox(self)
        self.student = QLineEdit(self)
        self.assistance = QSlider(Qt.Orientation.Horizontal, self)
        self._assistance_text = QLabel(self)
        self._note = QLabel(self)
        self.steps = Steps(self)
        self.buttons = AttemptActions(self)
        self.readouts = Readouts(self)
        self.exercise.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._prepare_inputs()
        self._lay_out()
        self._connect()
        self._show_assistance(self.assistance.value())

    # --- what the controller and the window call --------------------------------------------------
    def set_exercises(
        self, exercises: Sequence[tuple[str, str]], chosen: str | None = None
    ) -> None:
        """Offer exercises as (identifier, title)."""
        with QSignalBlocker(self.exercise):
            self.exercise.clear()
            for identifier, title in exercises:
                self.exercise.addItem(title, identifier)
            self.exercise.setCurrentIndex(max(0, self.exercise.findData(chosen)))

    def set_student(self, pseudonym: str) -> None:
        """Fill in the pseudonym."""
        self.student.setText(pseudonym)

    def set_assistance(self, share: float) -> None:
        """Show an assistance that came from elsewhere, 0…1; emits nothing."""
        with QSignalBlocker(self.assistance):
            self.assistance.setValue(round(100 * share))
        self._show_assistance(self.assistance.value())

    def set_ready(self, ready: bool, note: str = "") -> None:
        """Say whether an attempt can start, and if not, why not."""
        self._ready = ready
        self._note.setText(note)
        self._note.setVisible(bool(note))
        self._enable()

    def show_figures(self, figures: LiveFigures | None) -> None:
        """Show a moment of the attempt; None without one."""
        self.readouts.show_figures(figures)
        state = figures.state if figures else None
        self.steps.show_state(state)
        if state is not self._state:
            self._state = state
            self._enable()

    # --- inside -----------------------------------------------------------------------------------
    def _enable(self) -> None:
        running = self._state in RUNNING
        self.exercise.setEnabled(not running)
        self.student.setEnabled(not running)
        self.buttons.show_state(self._state, self._ready)

    def _show_assistance(self, percent: int) -> None:
        words = {0: tr("off"), 100: tr("full guidance")}
        text = tr("{percent} %", percent=percent)
        self._assistance_text.setText(f"{text} {words[percent]}" if percent in words else text)

    def _prepare_inputs(self) -> None:
        pattern = QRegularExpression(f"^{PSEUDONYM}$")
        self.student.setValidator(QRegularExpressionValidator(pattern, self.student))
        self.student.setPlaceholderText(tr("anonymous"))
        self.student.setToolTip(
            tr("A pseudonym, never a name: it goes into every record. Letters, digits, . _ -")
        )
        self.assistance.setRange(0, 100)
        self.assistance.setPageStep(10)
        self.assistance.setValue(100)
        self.assistance.setToolTip(
            tr("How strongly the robot guides the needle back to the planned path")
        )
        self.assistance.setAccessibleName(tr("Assistance"))
        self._assistance_text.setMinimumWidth(120)
        self._note.setWordWrap(True)
        self._note.setStyleSheet(f"color: {theme.WARNING};")
        self._note.hide()

    def _lay_out(self) -> None:
        form = QFormLayout()
        form.setContentsMargins(0, 0, 0, 0)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.ExpandingFieldsGrow)
        form.addRow(tr("Exercise"), self.exercise)
        form.addRow(tr("Student"), self.student)
        dial = QHBoxLayout()
        dial.addWidget(self.assistance, 1)
        dial.addWidget(self._assistance_text)
        form.addRow(tr("Assistance"), dial)
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        column.setSpacing(theme.SPACING)
        column.addLayout(form)
        for widget in (self.steps, self._note, self.buttons, _line(), self.readouts):
            column.addWidget(widget)
        column.addStretch(1)

    def _connect(self) -> None:
        self.exercise.activated.connect(
            lambda index: self.exercise_chosen.emit(self.exercise.itemData(index))
        )
        self.assistance.valueChanged.connect(self._show_assistance)
        self.assistance.valueChanged.connect(
            lambda percent: self.assistance_changed.emit(percent / 100)
        )
        self.buttons.start_requested.connect(
            lambda: self.start_requested.emit(self.student.text().strip())
        )


def _line() -> QFrame:
    line = QFrame()
    line.setFrameShape(QFrame.Shape.HLine)
    line.setStyleSheet(f"color: {theme.BORDER};")
    return line
