"""Sign-in by the hospital in the window: the browser asks, the window waits, the station links."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QObject, QUrl
from PySide6.QtGui import QDesktopServices, QGuiApplication, QShowEvent
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QProgressBar, QVBoxLayout, QWidget

from app.core.errors import AcusError
from app.core.progress import Cancelled, Progress
from app.exchange.openid import (
    PATIENCE,
    Entered,
    HospitalIdentity,
    Question,
    ask,
    enter,
    give_role,
    is_configured,
    link,
    place_of_openid,
)
from app.session.errors import PeopleError
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.parts import button, label, size_dialog
from app.views.kit.roles import Role, role_title
from app.views.kit.settings_dialog import make_room
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict, tell
from app.views.people.dialogs import EntryDialog
from app.views.people.stations import StationDoors


class WaitingDialog(QDialog):
    """Stands while the browser asks; says how it goes, and ends it.

    Attributes:
        again: opens the page once more; after a fault, asks anew.
        copy: puts the page's address into the clipboard, where no browser opened it.
        note: what went wrong.
    """

    def __init__(self, hospital: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Sign in by the hospital"))
        size_dialog(self, 480, 0)
        self.words = label(
            tr(
                "The browser shows the sign-in page of {hospital}. Sign in there, then come back "
                "here: this ends by itself.",
                hospital=hospital,
            )
        )
        self._bar = QProgressBar(self)
        self._bar.setRange(0, 0)
        self._bar.setTextVisible(False)
        self._bar.setAccessibleName(tr("Waiting for the browser"))
        self.note = label()
        self.again, self.copy = button(tr("Open the page again")), button(tr("Copy its address"))
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel, parent=self)
        for shown in (self.again, self.copy):
            self.buttons.addButton(shown, QDialogButtonBox.ButtonRole.ActionRole)
            shown.setEnabled(False)
        self.buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        for widget in (self.words, self._bar, self.note, self.buttons):
            column.addWidget(widget)

    def showEvent(self, event: QShowEvent) -> None:
        """Begin with room for the words."""
        super().showEvent(event)
        make_room(self)

    def show_asked(self, opened: bool) -> None:
        """Offer the page again; say so where no browser opened."""
        self.again.setEnabled(True)
        self.copy.setEnabled(True)
        if not opened:
            self.warn(tr("No browser opened: copy the address into one on this computer."))

    def show_fault(self, message: str) -> None:
        """Say why nobody was signed in, and offer to ask anew."""
        self._bar.hide()
        self.words.setText(tr("Nobody was signed in. Pseudonym and PIN work as before."))
        tell(self.note, Verdict.BAD, message)
        self.again.setText(tr("Try again"))
        self.again.setEnabled(True)
        self.copy.hide()
        make_room(self)

    def warn(self, message: str) -> None:
        """Say what is to be done otherwise."""
        tell(self.note, Verdict.WARNING, message)
        make_room(self)


class HospitalSignIn(QObject):
    """Lets the provider say who is here; one sign-in at a time.

    Attributes:
        patience: so long the browser's answer is waited for [s].

    Args:
        doors: of the page of people.
        let_in: takes who was signed in.
        parent: the window's object that it lives with.
        browse: opens an address in the system's browser; returns whether one opened.
    """

    def __init__(
        self,
        doors: StationDoors,
        let_in: Callable[[Entered], object],
        parent: QObject,
        browse: Callable[[str], bool] | None = None,
    ) -> None:
        super().__init__(parent)
        self._doors, self._let_in, self._browse = doors, let_in, browse or _browse
        self._task: BackgroundTask | None = None
        self._question: Question | None = None
        self._dialog: WaitingDialog | None = None
        self._closed = False
        self.patience = PATIENCE

    @property
    def configured(self) -> bool:
        """Return whether this station was told of a provider."""
        return is_configured(self._doors.people.folder)

    def offer(self, dialog: EntryDialog) -> None:
        """Put a button into a dialog of signing in, where a provider is configured."""
        if not self.configured:
            return
        shown = button(tr("Sign in by the hospital…"))
        shown.setAutoDefault(False)
        dialog.buttons.addButton(shown, QDialogButtonBox.ButtonRole.ResetRole)

        def begin() -> None:
            dialog.reject()
            self.begin()

        shown.clicked.connect(begin)

    def begin(self) -> None:
        """Ask the provider, unless it is being asked."""
        if self._dialog is not None:
            self._dialog.raise_()
            self._dialog.activateWindow()
            return
        try:
            place = place_of_openid(self._doors.people.folder)
        except AcusError as error:
            self._doors.tell(tr("Sign in by the hospital"), translated(error), "")
            return
        if place is None:
            return
        dialog = WaitingDialog(place.name, self._doors.parent())
        self._dialog = dialog
        dialog.again.clicked.connect(lambda: self._again(dialog))
        dialog.copy.clicked.connect(self._copy)
        self._doors.open(dialog)
        done = tr("That is all here: go back to Acus, and close this page.")
        wrong = tr("This is no answer to a sign-in that Acus waits for. Go back to Acus.")
        asked: list[Question] = []

        def work(progress: Progress) -> Question:
            question = ask(place, done, wrong)
            asked.append(question)  # so that one of the two ends it, whenever the dialog goes
            try:
                progress.check()
            except Cancelled:
                question.close()
                raise
            return question

        dialog.finished.connect(lambda _: self._end(dialog, asked))
        self._run(dialog, work, self._asked)

    def close(self) -> None:
        """Wait for nobody any more; idempotent."""
        self._closed = True
        if self._dialog is not None:
            self._dialog.reject()

    # --- inside -----------------------------------------------------------------------------------
    def _run(
        self,
        dialog: WaitingDialog,
        work: Callable[[Progress], object],
        done: Callable[..., object],
    ) -> None:
        def then(result: object) -> None:
            if dialog is self._dialog:
                done(result)

        def failed(error: Exception) -> None:
            if dialog is self._dialog:
                self._stop()
                dialog.show_fault(translated(error))

        self._task = run_in_background(self, work, then, failed)

    def _asked(self, question: Question) -> None:
        """Show the page, and wait for what comes of it."""
        dialog = self._dialog
        if dialog is None:
            question.close()
            return
        self._question = question
        people, patience = self._doors.people, self.patience

        def work(progress: Progress) -> tuple[HospitalIdentity, Entered | None]:
            identity = question.identity(progress, patience)
            return identity, enter(people, identity)

        def done(result: tuple[HospitalIdentity, Entered | None]) -> None:
            identity, entered = result
            dialog.accept()
            window = self._doors.parent().window()
            window.raise_()
            window.activateWindow()
            if entered is None:
                self._link(identity)
            else:
                self._go_on(entered)

        self._run(dialog, work, done)
        dialog.show_asked(self._browse(question.address))

    def _link(self, identity: HospitalIdentity) -> None:
        """Let somebody who is new here choose pseudonym and PIN, once."""
        words = tr(
            "The hospital knows you, this station does not yet. Choose a pseudonym, which screens "
            "show, and a PIN; if you have both here already, give those. It is asked once; no "
            "name and no address of the hospital is kept."
        )

        def take(pseudonym: str, pin: str, again: str) -> None:
            if pin != again:
                raise PeopleError(tr("the two PINs are not the same: type them again"))
            entered = link(self._doors.people, identity, pseudonym, pin)
            self._go_on(entered)

        fields = ((tr("Pseudonym"), False), (tr("PIN"), True), (tr("PIN again"), True))
        title = tr("Your pseudonym at this station")
        self._doors.open(EntryDialog(title, fields, take, words, self._doors.parent()))

    def _go_on(self, entered: Entered) -> None:
        """Let in; before, ask for a role that the groups allow and this station has not given."""
        if not entered.may_be_more:
            self._let_in(entered)
            return
        role = role_title(Role(entered.allowed.value))
        words = tr(
            "The hospital's groups allow you the role {role}. This station gives it once, by the "
            "instructor's password.",
            role=role,
        )

        def take(password: str) -> None:
            self._let_in(give_role(self._doors.people, entered, password))

        title = tr("Role: {role}", role=role)
        fields = ((tr("Instructor's password"), True),)
        dialog = EntryDialog(title, fields, take, words, self._doors.parent())
        cancel = dialog.buttons.button(QDialogButtonBox.StandardButton.Cancel)
        cancel.setText(tr("Go on without it"))
        dialog.rejected.connect(lambda: None if self._closed else self._let_in(entered))
        self._doors.open(dialog)

    def _again(self, dialog: WaitingDialog) -> None:
        """Open the page once more, or ask anew where it went wrong."""
        if self._question is not None:
            dialog.show_asked(self._browse(self._question.address))
            return
        dialog.reject()
        self.begin()

    def _copy(self) -> None:
        if self._question is not None:
            QGuiApplication.clipboard().setText(self._question.address)

    def _stop(self) -> None:
        """Wait for no answer any more."""
        task, question = self._task, self._question
        self._task = self._question = None
        if task is not None:
            task.drop()
        if question is not None:
            question.close()

    def _end(self, dialog: WaitingDialog, asked: Sequence[Question]) -> None:
        for question in asked:
            question.close()
        if dialog is self._dialog:
            self._dialog = None
            self._stop()


def _browse(address: str) -> bool:
    return QDesktopServices.openUrl(QUrl(address))
