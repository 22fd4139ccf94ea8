"""Form of what leaves: which attempts make a mark, by what Moodle knows students, and the place."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialogButtonBox,
    QFormLayout,
    QLineEdit,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from app.exchange.moodle import GradeFrom, GradeRule, MoodleChoice, chance_words, identifiers
from app.session.accounts import Account
from app.session.board import ProgressBoard
from app.views.kit.parts import add_row
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import tr, translated


@dataclass(frozen=True, slots=True)
class LeavingChoice:
    """What was chosen.

    Attributes:
        gradebook: identifier, rule and feedback; the report has the rule alone.
        place: where the course was.
    """

    gradebook: MoodleChoice = field(default_factory=MoodleChoice)
    place: str = ""


class LeavingDialog(SettingsDialog):
    """The form that comes before a gradebook or the report of a group is written.

    Args:
        board: whose results leave.
        accounts: what other programs call the students; None for the report, which needs none.
        place: that is offered.
        take: is handed the choice.
        parent: window.
    """

    def __init__(
        self,
        board: ProgressBoard,
        accounts: Mapping[str, Mapping[Account, str]] | None,
        place: str,
        take: Callable[[LeavingChoice], object],
        parent: QWidget | None = None,
    ) -> None:
        title = tr("Report of the group") if accounts is None else tr("Gradebook for Moodle")
        super().__init__(title, (560, 320), QDialogButtonBox.StandardButton.Ok, parent)
        self._board, self._accounts, self._take = board, accounts, take
        self.rule, self.last = QComboBox(self), QSpinBox(self)
        for words, rule in (
            (tr("the best attempt"), GradeFrom.BEST),
            (tr("the first attempt"), GradeFrom.FIRST),
            (tr("the last attempt"), GradeFrom.LAST),
            (tr("the mean of the last attempts"), GradeFrom.MEAN),
        ):
            self.rule.addItem(words, rule.value)
        self.last.setRange(2, 100)
        self.last.setValue(3)
        self.identifier, self.feedback = QComboBox(self), QCheckBox(tr("A column of feedback too"))
        for words, kind in (
            (tr("user name (else the pseudonym)"), Account.USERNAME),
            (tr("e-mail address"), Account.EMAIL),
            (tr("ID number"), Account.IDNUMBER),
        ):
            self.identifier.addItem(words, kind.value)
        self.place = QLineEdit(place, self)
        self.place.setPlaceholderText(tr("empty: a line to fill in by hand"))
        form = QFormLayout()
        add_row(form, tr("A mark is"), self.rule)
        add_row(form, tr("How many"), self.last)
        if accounts is None:
            add_row(form, tr("Venue"), self.place)
        else:
            add_row(form, tr("Moodle knows students by"), self.identifier)
            form.addRow("", self.feedback)
        for widget in (self.place,) if accounts is not None else (self.identifier, self.feedback):
            widget.hide()
        column = QVBoxLayout(self)
        column.addLayout(form)
        column.addStretch(1)
        column.addWidget(self.note)
        column.addWidget(self.buttons)
        self.rule.currentIndexChanged.connect(self._show_chance)
        self.last.valueChanged.connect(self._show_chance)
        self._show_chance()

    def choice(self) -> LeavingChoice:
        """Return what is chosen."""
        rule = GradeFrom(self.rule.currentData())
        grades = GradeRule(rule, self.last.value() if rule is GradeFrom.MEAN else 0)
        kind = Account(self.identifier.currentData())
        gradebook = MoodleChoice(kind, grades, self.feedback.isChecked())
        return LeavingChoice(gradebook, self.place.text().strip())

    def check(self) -> None:
        """Refuse an identifier that a student lacks, or two share."""
        if self._accounts is not None:
            kind = Account(self.identifier.currentData())
            identifiers(self._board.students, kind, self._accounts)

    def keep(self) -> None:
        """Hand the choice on."""
        self._take(self.choice())

    def _show_chance(self) -> None:
        """Say what chance does to marks by the rule that is chosen."""
        rule = self.choice().gradebook.rule
        self.last.setEnabled(rule.rule is GradeFrom.MEAN)
        words = translated(chance_words(self._board, rule))
        self.say(words[:1].upper() + words[1:])
