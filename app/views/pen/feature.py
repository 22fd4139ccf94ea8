"""The pen in the window: a pen before a webcam in place of the robot, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from PySide6.QtCore import Signal, SignalInstance
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from app.core.errors import AcusError
from app.views.kit.roles import TECHNICIANS, Role
from app.views.kit.text import tr
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.tracking.pen.settings import PenSettings
    from app.views.pen.dialog import PenDialog


class PenFeature(Feature):
    """Opens the page of the pen; lets the run have its webcam back afterwards.

    Which pen and webcam stands in `pen.yaml` (`tracking.pen.settings`); whether they are used, in
    the window's settings (`Equipment`).

    Signals:
        changed(): pen or robot was chosen.
    """

    changed = Signal()
    topic: ClassVar[str] = "pen"
    place: ClassVar[int] = 90
    roles: ClassVar[frozenset[Role]] = TECHNICIANS
    help: ClassVar[str] = "pen.md#in-the-window"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._equipment, self._conductor = context.equipment, context.conductor
        self._services, self._window = context.services, context.shell.dialog_parent
        self.dialog: PenDialog | None = None
        self._last = self._equipment.pen
        self._equipment.changed.connect(self._note_change)
        self._equipment.pen_wanted.connect(self.open)
        self._equipment.offers_pen = True
        self.menu = PenMenu(context.shell.menu(tr("&Pen")), self)

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.changed, self._conductor.controller.finished)

    @property
    def used(self) -> bool:
        """Return whether a pen stands in for the robot."""
        return bool(self._equipment.pen)

    @property
    def source(self) -> str:
        """Source of the webcam's pictures, the one used last; empty before there was one."""
        return self._last

    def open(self) -> None:
        """Show the page."""
        if self._equipment.is_lent():
            return
        from app.views.pen.dialog import PenDialog  # OpenCV: not before the window

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
        text = (
            tr("A pen before a webcam: {source}", source=source)
            if source
            else tr("A pen before a webcam: choose…")
        )
        self.pen.setText(text)
        self.pen.setChecked(self._pen.used)
        self.robot.setChecked(not self._pen.used)

    @staticmethod
    def _choice(menu: QMenu, group: QActionGroup, text: str) -> QAction:
        action = menu.addAction(text)
        action.setCheckable(True)
        group.addAction(action)
        return action
