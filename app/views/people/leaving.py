"""Form of what leaves: which attempts make a mark, by what Moodle knows students, and the place."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from PySide6.QtWidgets import QDialogButtonBox, QVBoxLayout, QWidget

from app.exchange.moodle import GradeFrom, GradeRule, MoodleChoice, chance_words, identifiers
from app.session.accounts import Account
from app.session.board import ProgressBoard
from app.views.kit.form import Form
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
        self._board, self._accounts, self._place, self._take = board, accounts, place, take
        self.form = form = Form(parent=self)
        marks = (
            (GradeFrom.BEST.value, tr("the best attempt")),
            (GradeFrom.FIRST.value, tr("the first attempt")),
            (GradeFrom.LAST.value, tr("the last attempt")),
            (GradeFrom.MEAN.value, tr("the mean of the last attempts")),
        )
        form.choice("rule", title=tr("A mark is"), among=marks)
        self._last = form.count("last", title=tr("How many"), within=(2, 100, 3))
        if accounts is None:
            hint = tr("empty: a line to fill in by hand")
            form.text("place", title=tr("Venue"), hint=hint, read=str.strip)
            form.show_values({"place": place})
        else:
            kinds = (
                (Account.USERNAME.value, tr("user name (else the pseudonym)")),
                (Account.EMAIL.value, tr("e-mail address")),
                (Account.IDNUMBER.value, tr("ID number")),
            )
            form.choice("identifier", title=tr("Moodle knows students by"), among=kinds)
            form.check("feedback", title=tr("A column of feedback too"), indented=True)
        column = QVBoxLayout(self)
        column.addWidget(form)
        column.addStretch(1)
        column.addWidget(self.note)
        column.addWidget(self.buttons)
        form.edited.connect(lambda *_: self._show_chance())
        self._show_chance()

    def choice(self) -> LeavingChoice:
        """Return what is chosen."""
        found = self.form.values()
        rule = GradeFrom(found["rule"])
        grades = GradeRule(rule, found["last"] if rule is GradeFrom.MEAN else 0)
        kind = Account(found.get("identifier", Account.USERNAME))
        gradebook = MoodleChoice(kind, grades, found.get("feedback", False))
        return LeavingChoice(gradebook, found.get("place", self._place))

    def check(self) -> None:
        """Refuse an identifier that a student lacks, or two share."""
        if self._accounts is not None:
            kind = self.choice().gradebook.identifier
            identifiers(self._board.students, kind, self._accounts)

    def keep(self) -> None:
        """Hand the choice on."""
        self._take(self.choice())

    def _show_chance(self) -> None:
        """Say what chance does to marks by the rule that is chosen."""
        rule = self.choice().gradebook.rule
        self._last.setEnabled(rule.rule is GradeFrom.MEAN)
        words = translated(chance_words(self._board, rule))
        self.say(words[:1].upper() + words[1:])
