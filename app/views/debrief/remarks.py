"""What the instructor says of attempts, as actions: comment, void with a reason, release a result.

The list and the debrief hold the same actions. What is said stands in the list of people, by id of
the attempt; the record stays as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QAction, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QDialogButtonBox,
    QMenu,
    QPlainTextEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.session.admission import admit
from app.session.errors import PeopleError
from app.session.people import NOTHING_SAID, People, Remarks
from app.views.kit.access import ACCESS
from app.views.kit.parts import label
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import keys_text, literal, tr, tr_n


def said_words(answer: Remarks, held: str = "") -> list[str]:
    """Say what the instructor said of an attempt, and whether a course holds its result: lines.

    Args:
        answer: of the attempt.
        held: title of the course that holds its result; empty if none does.
    """
    lines = []
    if answer.void:
        lines.append(tr("Declared void by the instructor: {why}", why=answer.void))
    if answer.comment:
        lines.append(tr("The instructor says: {words}", words=answer.comment))
    if held:
        lines.append(tr("Not released: the student sees no result yet (course {name})", name=held))
    return lines


class SayingDialog(SettingsDialog):
    """A text of some lines that is taken as it stands.

    Args:
        title: of the dialog.
        words: what is to be known, above the text.
        text: that stands there already.
        take: takes the text; raises an AcusError if it cannot be.
        parent: window.
    """

    def __init__(
        self, title: str, words: str, text: str, take: Callable[[str], object], parent: QWidget
    ) -> None:
        super().__init__(title, (480, 260), QDialogButtonBox.StandardButton.Ok, parent)
        self._take = take
        self.text = QPlainTextEdit(text, self)
        self.text.setAccessibleName(title)
        self.text.setTabChangesFocus(True)
        column = QVBoxLayout(self)
        column.addWidget(label(words, "dim"))
        column.addWidget(self.text, 1)
        column.addWidget(self.note)
        column.addWidget(self.buttons)
        self.text.setFocus()

    def check(self) -> None:
        """Everything is checked when it is taken."""

    def keep(self) -> None:
        """Hand the text on, on its lines but without blanks around them."""
        self._take("\n".join(line.strip() for line in self.text.toPlainText().strip().split("\n")))


class RemarkActions(QObject):
    """The actions of one page, for whichever attempts are chosen there; the instructor's only.

    Args:
        page: whose keys they are, while the keyboard is in it.
        chosen: ids of the attempts that they are about.
        record: the file of one; without it nothing is admitted here.

    Signals:
        changed(): something was said.
        noted(str): what was said, for the message line.
        failed(object): why it could not be.

    Attributes:
        all: the actions in their order.
        button: opens them as a menu.
        dialog: the one that was opened last; None once it is closed.
    """

    changed = Signal()
    noted = Signal(str)
    failed = Signal(object)

    def __init__(
        self,
        page: QWidget,
        chosen: Callable[[], Sequence[str]],
        record: Callable[[str], Path] | None = None,
    ) -> None:
        super().__init__(page)
        self._page, self._chosen, self._record = page, chosen, record
        self._unsigned: frozenset[str] = frozenset()
        self._said: Mapping[str, Remarks] = {}
        self._held: Mapping[str, str] = {}
        self.dialog: SayingDialog | None = None
        self.button = QPushButton(tr("Instructor"), page)
        self.button.setAutoDefault(False)
        self.button.setToolTip(
            tr("Comment on the selected attempts, declare them void, release their results")
        )
        menu = QMenu(self.button)
        menu.setToolTipsVisible(True)
        self.button.setMenu(menu)
        self.comment = self._add(
            tr("Comment…"), "Ctrl+K", tr("Say something that the student reads in the debrief")
        )
        self.void = self._add(
            tr("Declare void…"),
            "Ctrl+Shift+V",
            tr("It stays in the list but does not count; the student can read the reason"),
        )
        self.count = self._add(
            tr("Let it count again"), "", tr("Take back that it was declared void")
        )
        self.release = self._add(
            tr("Release the result"), "Ctrl+R", tr("Let the student see score and replay")
        )
        self.hold = self._add(
            tr("Hold the result back"), "", tr("Hide it again until it is released")
        )
        self.admit = self._add(
            tr("Admit…"),
            "",
            tr("Let an attempt count that this station has not signed; the reason is sealed"),
        )
        self.admit.setVisible(record is not None)
        self.all = (self.comment, self.void, self.count, self.release, self.hold, self.admit)
        menu.addActions(self.all)
        self.comment.triggered.connect(lambda: self.ask_comment())
        self.void.triggered.connect(lambda: self.ask_void())
        self.count.triggered.connect(lambda: self._say(tr("It counts again"), void=""))
        self.release.triggered.connect(lambda: self._say(tr("Released"), released=True))
        self.hold.triggered.connect(lambda: self._say(tr("Held back"), released=False))
        self.admit.triggered.connect(lambda: self.ask_admission())
        self.follow({}, {})

    def follow(
        self,
        message: Mapping[str, Remarks],
        held: Mapping[str, str],
        unsigned: frozenset[str] = frozenset(),
    ) -> None:
        """Offer what can be said now.

        Args:
            message: what the instructor said, by attempt.
            held: courses that hold a result back, by attempt.
            unsigned: attempts that this station has not signed, and nobody has admitted.
        """
        self._said, self._held, self._unsigned = message, held, unsigned
        ids = list(self._chosen()) if ACCESS.may_manage else []
        self.button.setVisible(ACCESS.may_manage)
        self.button.setEnabled(bool(ids))
        self.comment.setEnabled(bool(ids))
        self.void.setEnabled(any(not self._of(name).void for name in ids))
        self.count.setEnabled(any(self._of(name).void for name in ids))
        self.release.setEnabled(any(name in held for name in ids))
        self.hold.setEnabled(any(self._of(name).released for name in ids))
        self.admit.setEnabled(any(name in unsigned for name in ids))

    def ask_comment(self) -> None:
        """Ask for a comment; an empty one takes it away."""
        ids = self._ids()
        if ids:
            known = {self._of(name).comment for name in ids}
            text = known.pop() if len(known) == 1 else ""
            words = tr("The student reads this in the debrief and in the list. Empty: none.")
            self._ask(tr("Comment"), words, text, lambda text: self._comment(ids, text))

    def ask_void(self) -> None:
        """Ask why the attempts do not count."""
        ids = self._ids()
        if ids:
            words = tr(
                "It will not count: not on the board, in any curve or for any course. The "
                "record stays, and this can be undone. Why? The student can read the "
                "reason."
            )
            known = {self._of(name).void for name in ids}
            text = known.pop() if len(known) == 1 else ""
            self._ask(tr("Declare void"), words, text, lambda why: self._void(ids, why))

    def ask_admission(self) -> None:
        """Ask why attempts that are not signed here count all the same."""
        ids = [name for name in self._ids() if name in self._unsigned]
        if ids:
            words = tr(
                "This station did not sign it: it counts on no board and for no course. Why is it "
                "to count all the same? The reason is sealed with the record as it is now."
            )
            self._ask(tr("Admit"), words, "", lambda why: self._admit(ids, why))

    # --- inside -----------------------------------------------------------------------------------
    def _add(self, text: str, keys: str, tip: str) -> QAction:
        """Make an action whose keys are this page's: another page has actions of the same."""
        action = QAction(f"{text}\t{keys_text(keys)}" if keys else text, self._page)
        if keys:
            shortcut = QShortcut(QKeySequence(keys), self._page, lambda: self._press(action))
            shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        action.setToolTip(literal(tip))
        return action

    def _press(self, action: QAction) -> None:
        if action.isEnabled():
            action.trigger()

    def _of(self, name: str) -> Remarks:
        return self._said.get(name, NOTHING_SAID)

    def _ids(self) -> list[str]:
        return list(self._chosen()) if ACCESS.may_manage else []

    def _comment(self, ids: Sequence[str], text: str) -> None:
        self._write(ids, comment=text)
        self.noted.emit(tr("Comment kept") if text else tr("Comment removed"))

    def _void(self, ids: Sequence[str], reason: str) -> None:
        if not reason:
            raise PeopleError(tr("Say why: the student reads it in the list and in the debrief."))
        self._write(ids, void=reason)
        self.noted.emit(tr_n("{n} attempt declared void", "{n} attempts declared void", len(ids)))

    def _admit(self, ids: Sequence[str], reason: str) -> None:
        if not ACCESS.may_manage or self._record is None:
            raise PeopleError(tr("Only the instructor does that: Sessions ▸ Sign in."))
        admit([self._record(name) for name in ids], reason)
        self.changed.emit()
        self.noted.emit(tr_n("{n} attempt admitted", "{n} attempts admitted", len(ids)))

    def _say(self, done: str, **message: str | bool) -> None:
        ids = self._ids()
        if message.get("released"):
            ids = [name for name in ids if name in self._held]
        if not ids:
            return
        try:
            self._write(ids, **message)
        except AcusError as error:
            self.failed.emit(error)
        else:
            self.noted.emit(
                tr_n("{done}: {n} attempt", "{done}: {n} attempts", len(ids), done=done)
            )

    def _write(self, ids: Sequence[str], **message: str | bool) -> None:
        if not ACCESS.may_manage:
            raise PeopleError(tr("Only the instructor does that: Sessions ▸ Sign in."))
        People().remark_all(ids, **message)
        self.changed.emit()

    def _ask(self, title: str, words: str, text: str, take: Callable[[str], object]) -> None:
        self.dialog = dialog = SayingDialog(title, words, text, take, self._page.window())

        def ended() -> None:
            if self.dialog is dialog:
                self.dialog = None
            dialog.deleteLater()

        dialog.finished.connect(ended)
        dialog.open()
