"""The pen in the window: a pen before a webcam in place of the robot, and back.

Its page: choose and print it, see what the webcam sees, measure the tip, use it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Final

from PySide6.QtCore import QTimer, Signal, SignalInstance
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import (
    QDialog,
    QGroupBox,
    QHBoxLayout,
    QMenu,
    QMessageBox,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.tracking.pen.settings import PenSettings
from app.views.cameras.live import LivePreview
from app.views.cameras.settings_dialog import QUIET_MS
from app.views.kit import theme
from app.views.kit.parts import button
from app.views.kit.text import tr
from app.views.kit.verdict import Verdict
from app.views.pen.choice import PenChoice
from app.views.pen.status import PenStatus
from app.views.pen.tip_step import TipStep
from app.views.pen.words import Line, accuracy_line, status_lines
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.tracking.pen.body import PenProfile
    from app.tracking.pen.settings import PenSettings
    from app.views.pen.port import PenPort
    from app.views.shell.services import Services


LOOK_MS: Final = 200
_SIDE: Final = 470
"""Width of the right column [px]."""


class PenDialog(QDialog):
    """Everything about the pen on one page; nothing in it blocks the window.

    Args:
        settings: the present ones.
        services: lists webcams, opens the pen.
        free: waits, in another thread, until nobody else has the webcam.
        used: whether the pen is the needle now.
        parent: the window.

    Signals:
        left(PenSettings, bool): the page was left with these; whether the pen is to be used.
    """

    left = Signal(object, bool)

    def __init__(
        self,
        settings: PenSettings,
        services: Services,
        free: Callable[[], object],
        used: bool,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Pen and webcam: a needle without a robot"))
        self._services, self._free, self._used = services, free, used
        self._pen: PenProfile | None = None
        self._live: PenPort | None = None
        self._opened: PenSettings | None = None
        self._refused = False
        self.preview, self.status, self.tip = LivePreview(self), PenStatus(self), TipStep(self)
        self.choice = PenChoice(settings, services.camera_sources(), self)
        self.use = button(tr("&Use the pen as needle"), "primary")
        self.back = button(tr("Back to the &robot"))
        self.again = button(tr("&Try again"))
        self.close_button = button(tr("Close"))
        self._quiet = QTimer(self, interval=QUIET_MS, singleShot=True)
        self._quiet.timeout.connect(self.reopen)
        self._timer = QTimer(self, interval=LOOK_MS)
        self._timer.timeout.connect(self.poll)
        self._lay_out()
        self._connect()
        self.reopen()
        self._timer.start()

    # --- what is seen -----------------------------------------------------------------------------
    def reopen(self) -> None:
        """Look at what is chosen now, beside the window."""
        self._quiet.stop()
        self.preview.stop()
        self._live, self._pen, self._refused = None, None, False
        try:
            settings = self.choice.settings()
            self._pen = settings.profile()
        except AcusError as error:
            self.tip.set_pen(None, None)
            self.status.show_status(Line(Verdict.BAD, str(error)), ())
            self.use.setEnabled(False)
            return
        self.use.setEnabled(True)
        self._opened = settings
        self.tip.set_pen(settings, None)
        free, services = self._free, self._services

        def operation(progress: Progress) -> PenPort:
            free()
            return services.open_pen(settings, progress)

        self.preview.open(operation)
        self.poll()

    def poll(self) -> None:
        """Show how the pen is."""
        live, pen = self._live, self._pen
        if pen is None:
            return
        if live is None or self.preview.camera is None:
            why = tr("the webcam could not be opened") if self._refused else ""
            self.status.show_status(accuracy_line(None, why), status_lines(None, pen, None, 0.0))
            return
        seen, trouble = live.observed(), _trouble(live)
        lines = status_lines(None if trouble else seen, pen, live.webcam(), live.speed())
        self.status.show_status(accuracy_line(seen, trouble), lines)

    def closed(self) -> Callable[[], object]:
        """Return what waits until the webcam is closed; for other threads."""
        return self.preview.closed()

    # --- leaving ----------------------------------------------------------------------------------
    def reject(self) -> None:
        """Escape stops a measurement that runs; else the page is left, the choice remembered."""
        if self.tip.running:
            self.tip.end(tr("stopped, nothing is changed"))
            return
        self._after_question(lambda: self._leave(self._used))

    def done(self, result: int) -> None:
        """Let go of the webcam, whichever way it ends."""
        self._quiet.stop()
        self._timer.stop()
        self.tip.set_pen(None, None)
        self.preview.stop()
        super().done(result)

    def _leave(self, use: bool) -> None:
        try:
            settings = self.choice.settings()
        except AcusError:
            settings = None  # what cannot be used is not remembered
        super().reject()
        if settings is not None:
            self.left.emit(settings, use)

    def _after_question(self, go_on: Callable[[], object]) -> None:
        """Ask about a tip that is measured and not saved, then go on."""
        found, opened = self.tip.found, self._opened
        if found is None or opened is None or opened.simulated:
            go_on()
            return
        buttons = QMessageBox.StandardButton
        box = QMessageBox(
            QMessageBox.Icon.NoIcon, tr("Measured tip"), tr("Save the measured tip?"),
            buttons.Save | buttons.Discard | buttons.Cancel, self,
        )  # fmt: skip

        def answered(answer: int) -> None:
            box.deleteLater()
            if answer == buttons.Save:
                self.tip.keep()
            if answer == buttons.Discard or (answer == buttons.Save and self.tip.found is None):
                go_on()

        box.finished.connect(answered)
        box.open()

    # --- inside -----------------------------------------------------------------------------------
    def _take(self, live: PenPort) -> None:
        self._live = live
        self.tip.set_pen(self._opened, live)
        self.poll()

    def _refuse(self) -> None:
        self._refused = True
        self.poll()

    def _lay_out(self) -> None:
        self.use.setToolTip(tr("The next attempts are made with the pen, without a robot"))
        self.back.setToolTip(tr("The robot, or the simulated one, holds the needle again"))
        self.back.setVisible(self._used)
        self.use.setText(tr("&Use this pen") if self._used else tr("&Use the pen as needle"))
        self.use.setDefault(True)
        self.again.setToolTip(tr("Open the webcam anew, for instance once it is plugged in"))
        seen = QVBoxLayout()
        seen.setSpacing(theme.SPACING)
        seen.addWidget(self.preview, 1)
        seen.addWidget(self.status)
        side = QVBoxLayout()
        side.setSpacing(theme.SPACING)
        for title, part in ((tr("Which pen"), self.choice), (tr("Its tip"), self.tip)):
            box = QGroupBox(title, self)
            QVBoxLayout(box).addWidget(part)
            box.setFixedWidth(_SIDE)
            side.addWidget(box)
        side.addStretch(1)
        pair = QHBoxLayout()
        pair.setSpacing(theme.MARGIN)
        pair.addLayout(seen, 1)
        pair.addLayout(side)
        buttons = QHBoxLayout()
        buttons.addWidget(self.again)
        buttons.addStretch(1)
        for one in (self.back, self.use, self.close_button):
            buttons.addWidget(one)
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addLayout(pair, 1)
        column.addLayout(buttons)
        self.resize(1160, 690)

    def _connect(self) -> None:
        self.preview.opened.connect(self._take)
        self.preview.failed.connect(lambda _: self._refuse())
        self.choice.changed.connect(self._quiet.start)
        self.tip.kept.connect(self.reopen)
        self.again.clicked.connect(lambda _=False: self.reopen())
        self.use.clicked.connect(lambda _=False: self._after_question(lambda: self._leave(True)))
        self.back.clicked.connect(lambda _=False: self._after_question(lambda: self._leave(False)))
        self.close_button.clicked.connect(lambda _=False: self.reject())


def _trouble(live: PenPort) -> str:
    """Return what is wrong with webcam or tracker; empty without."""
    statistics = live.statistics()
    wrong = [one for one in statistics.cameras if one.state.value not in ("live", "waiting")]
    return statistics.fault or (wrong[0].text if wrong else "")


class PenFeature(Feature):
    """Opens the page of the pen; lets the run have its webcam back afterwards.

    Which pen and webcam stands in `pen.yaml` (`tracking.pen.settings`); whether they are used, in
    the window's settings (`Equipment`).

    Signals:
        changed(): pen or robot was chosen.
    """

    changed = Signal()
    topic: ClassVar[str] = "pen"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._equipment, self._conductor = context.equipment, context.conductor
        self._services, self._window = context.services, context.shell.dialog_parent
        self.dialog: PenDialog | None = None
        self._last = self._equipment.pen
        self._equipment.changed.connect(self._note_change)
        self._equipment.pen_wanted.connect(self.open)
        self.menu = PenMenu(context.shell.menu(tr("&Pen")), self)

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.changed, self._conductor.controller.finished)

    @property
    def used(self) -> bool:
        """Whether a pen stands in for the robot."""
        return bool(self._equipment.pen)

    @property
    def source(self) -> str:
        """Source of the webcam's pictures, the one used last; empty before there was one."""
        return self._last

    def open(self) -> None:
        """Show the page."""
        if self._equipment.is_lent():
            return
        from app.views.pen.feature import PenDialog  # OpenCV: not before the window

        dialog = PenDialog(
            self._settings(),
            self._services,
            self._equipment.lend(self.used),
            self.used,
            self._window,
        )
        dialog.left.connect(self._left)
        dialog.finished.connect(lambda _: self._closed())
        self.dialog = dialog
        self._equipment.show(dialog)

    def use_last(self) -> None:
        """Use the pen of last time; without one the page asks."""
        if not self._last:
            self.changed.emit()
            self.open()
        elif self._equipment.use_pen(self._last):
            self._conductor.take_again()  # one that failed before may be plugged in now
            self._tell_used()
        else:
            self.changed.emit()

    def use_robot(self) -> None:
        """Let the robot hold the needle again."""
        if self._equipment.use_pen(""):
            self._conductor.take_again()
        else:
            self.changed.emit()

    # --- inside -----------------------------------------------------------------------------------
    def _settings(self) -> PenSettings:
        from app.tracking.pen.settings import PenSettings, load_settings, with_source

        try:
            settings = load_settings()
            return with_source(settings, self._equipment.pen) if self.used else settings
        except AcusError as error:
            self.failed.emit(error)
            return PenSettings()

    def _left(self, settings: PenSettings, use: bool) -> None:
        """Remember what the page chose, and use it if that was wanted."""
        from app.tracking.pen.settings import save_settings

        try:
            save_settings(settings)
        except (AcusError, OSError) as error:
            self.failed.emit(error)
        if not use and not self.used:
            return
        self._conductor.let_go()  # until the page's webcam is closed: `Equipment.show`
        another = use and settings.source != self._equipment.pen
        if self._equipment.use_pen(settings.source if use else "") and another:
            self._tell_used()

    def _tell_used(self) -> None:
        patient = self._conductor.patient is not None and self._conductor.exercise is not None
        self.noted.emit(
            tr("The pen is the needle now: {source}", source=self._equipment.pen)
            if patient
            else tr("The pen is the needle now. Choose an exercise: it runs on the pen")
        )

    def _closed(self) -> None:
        self.dialog = None

    def _note_change(self) -> None:
        self._last = self._equipment.pen or self._last
        self.changed.emit()


class PenMenu:
    """Fills a menu with what the feature does."""

    def __init__(self, menu: QMenu, pen: PenFeature) -> None:
        self._pen = pen
        group = QActionGroup(menu)
        self.robot = self._choice(menu, group, tr("The robot holds the needle"))
        self.robot.triggered.connect(lambda _=False: pen.use_robot())
        self.pen = self._choice(menu, group, "")
        self.pen.triggered.connect(lambda _=False: pen.use_last())
        menu.addSeparator()
        self.page = menu.addAction(tr("Pen and webcam: set up, measure, print…"))
        self.page.setShortcut("F4")
        self.page.setToolTip(tr("A needle without a robot: docs/pen.md"))
        self.page.triggered.connect(lambda _=False: pen.open())
        pen.changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show what is chosen."""
        source = self._pen.source
        text = tr("A pen before a webcam: {source}", source=source) if source else tr(
            "A pen before a webcam: choose…"
        )  # fmt: skip
        self.pen.setText(text)
        self.pen.setChecked(self._pen.used)
        self.robot.setChecked(not self._pen.used)

    @staticmethod
    def _choice(menu: QMenu, group: QActionGroup, text: str) -> QAction:
        action = menu.addAction(text)
        action.setCheckable(True)
        group.addAction(action)
        return action
