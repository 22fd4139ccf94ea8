"""Two failure rates of a course, as fields, with the attempts that it takes to tell them apart."""

from __future__ import annotations

from pydantic import ValidationError
from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QWidget

from app.scoring.competence import RULE, CompetenceError, CompetenceRule, design
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr
from app.views.kit.wheel import wheel_scrolls


class CompetenceRates(QWidget):
    """Acceptable and unacceptable failure rate [%]; what else a rule says stays as it was.

    Attributes:
        acceptable, unacceptable: fields.
        note: says how many attempts it takes, or that it cannot be.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._rule = RULE
        self.acceptable, self.unacceptable = QDoubleSpinBox(self), QDoubleSpinBox(self)
        self.note = PlainLabel("", self)
        names = (tr("Acceptable failures"), tr("Unacceptable failures"))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        for name, field in zip(names, (self.acceptable, self.unacceptable), strict=True):
            field.setRange(0.1, 99.0)
            field.setDecimals(1)
            field.setSuffix(" %")
            field.setAccessibleName(name)
            wheel_scrolls(field)
            row.addWidget(PlainLabel(name, self))
            row.addWidget(field)
            field.editingFinished.connect(self._tell)
        row.addWidget(self.note, 1)
        self.show_rule(RULE)

    def show_rule(self, rule: CompetenceRule) -> None:
        """Show a rule."""
        self._rule = rule
        self.acceptable.setValue(100.0 * rule.acceptable)
        self.unacceptable.setValue(100.0 * rule.unacceptable)
        self._tell()

    def document(self) -> dict[str, float]:
        """Return the rule as the fields say, unchecked; rates nobody changed are as they were."""
        document: dict[str, float] = self._rule.model_dump()
        for name, field in (("acceptable", self.acceptable), ("unacceptable", self.unacceptable)):
            if field.value() != round(100.0 * document[name], field.decimals()):
                document[name] = round(field.value() / 100.0, 3)
        return document

    def _tell(self) -> None:
        try:
            plan = design(CompetenceRule(**self.document()))
        except (ValidationError, CompetenceError):
            self.note.setText(tr("no number of attempts tells these apart"))
            return
        self.note.setText(tr("told apart in {n} attempts", n=plan.attempts))
