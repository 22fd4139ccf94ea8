"""A questionnaire to be answered in the window, by the student, an item after the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QButtonGroup,
    QDialogButtonBox,
    QFrame,
    QHBoxLayout,
    QRadioButton,
    QScrollArea,
    QSlider,
    QVBoxLayout,
    QWidget,
)

from app.views.kit.parts import PlainLabel, label
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import literal, number, tr
from app.views.kit.wheel import wheel_scrolls

if TYPE_CHECKING:
    from app.research.questionnaires import Item, Questionnaire

_MOST_BUTTONS: Final = 11
"""A scale of more steps is a slider."""
_STEPS: Final = 20
"""Steps of a slider, as on the sheet of NASA-TLX."""


class ItemRow(QFrame):
    """One item: its wording, and a scale that stands nowhere until it was touched.

    Attributes:
        answer: None until there is one.
    """

    def __init__(self, item: Item, asked: Questionnaire, place: int) -> None:
        super().__init__()
        self.item, self._low, self._high = item, asked.low, asked.high
        self.answer: float | None = None
        wording = label(f"{place}. {item.wording}")
        wording.setTextFormat(Qt.TextFormat.PlainText)
        steps = asked.high - asked.low
        row = QHBoxLayout()
        begin, end = item.ends or asked.ends
        self._shown = PlainLabel("")
        row.addWidget(PlainLabel(begin))
        if steps == int(steps) and steps < _MOST_BUTTONS:
            self.first: QWidget = self._add_buttons(row, int(steps) + 1)
        else:
            self.first = self._add_slider(row)
        row.addWidget(PlainLabel(end))
        row.addWidget(self._shown)
        row.addStretch(1)
        column = QVBoxLayout(self)
        column.addWidget(wording)
        column.addLayout(row)

    def _add_buttons(self, row: QHBoxLayout, count: int) -> QWidget:
        self._group = QButtonGroup(self)
        for step in range(count):
            value = self._low + step
            choice = QRadioButton(number(value, "g"), self)
            choice.setAccessibleName(f"{self.item.wording} {number(value, 'g')}")
            choice.toggled.connect(lambda on, value=value: self._take(value) if on else None)
            self._group.addButton(choice)
            row.addWidget(choice)
        return self._group.buttons()[0]

    def _add_slider(self, row: QHBoxLayout) -> QWidget:
        slider = QSlider(Qt.Orientation.Horizontal, self)
        self._shown.setText("–")
        slider.setRange(0, _STEPS)
        slider.setValue(_STEPS // 2)
        slider.setPageStep(2)
        slider.setTickPosition(QSlider.TickPosition.TicksBelow)
        slider.setTickInterval(1)
        slider.setMinimumWidth(260)
        slider.setAccessibleName(self.item.wording)
        wheel_scrolls(slider)

        def take() -> None:
            self._take(self._low + (self._high - self._low) * slider.value() / _STEPS)
            self._shown.setText(number(self.answer or 0.0, "g"))

        slider.valueChanged.connect(take)
        slider.sliderPressed.connect(take)  # who means the middle presses there
        row.addWidget(slider)
        return slider

    def _take(self, value: float) -> None:
        self.answer = float(value)


class QuestionnaireDialog(SettingsDialog):
    """All items of a questionnaire; it is kept when each is answered.

    Args:
        asked: the questionnaire.
        who: whose answers, and of which visit; shown above the items.
        take: takes the answers by item; raises an AcusError if they cannot be kept.
        parent: window.
    """

    def __init__(
        self,
        asked: Questionnaire,
        who: str,
        take: Callable[[Mapping[str, float]], object],
        parent: QWidget,
    ) -> None:
        super().__init__(asked.title, (720, 640), QDialogButtonBox.StandardButton.Save, parent)
        self._asked, self._take = asked, take
        self.rows = [ItemRow(item, asked, n) for n, item in enumerate(asked.items, 1)]
        inside = QWidget()
        items = QVBoxLayout(inside)
        for row in self.rows:
            items.addWidget(row)
        items.addStretch(1)
        self.area = QScrollArea()
        self.area.setWidgetResizable(True)
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setWidget(inside)
        column = QVBoxLayout(self)
        column.addWidget(label(literal(who), "dim"))
        column.addWidget(self.area, 1)
        column.addWidget(self.note)
        column.addWidget(self.buttons)
        self.rows[0].first.setFocus()

    @property
    def answers(self) -> dict[str, float]:
        """Return what is answered so far, by item."""
        return {row.item.name: row.answer for row in self.rows if row.answer is not None}

    def check(self) -> None:
        """Show the first item without an answer; raise a ResearchError where there is one."""
        from app.research.errors import ResearchError

        open_rows = [n for n, row in enumerate(self.rows, 1) if row.answer is None]
        if open_rows:
            row = self.rows[open_rows[0] - 1]
            self.area.ensureWidgetVisible(row)
            row.first.setFocus()
            left = ", ".join(map(str, open_rows))
            raise ResearchError(tr("Without an answer: {items}.", items=left))

    def keep(self) -> None:
        """Hand the answers over."""
        self._take(self.answers)

    def reject(self) -> None:
        """Close; answers that are given already are asked about first, in the line below."""
        if self.answers and not self.note.property("asked"):
            self.note.setProperty("asked", True)
            self.say(tr("The answers are not kept yet. Cancel once more to leave without them."))
            return
        super().reject()
