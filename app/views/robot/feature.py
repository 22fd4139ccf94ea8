"""The robot in the window: which one, how it is armed and by which key, its health, its
commissioning.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from PySide6.QtCore import Qt, Signal, SignalInstance
from PySide6.QtGui import QAction, QActionGroup, QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QInputDialog,
    QMenu,
    QVBoxLayout,
    QWidget,
)

from app.core.progress import Progress
from app.session.snapshot import Snapshot
from app.views.exercise.enable_switch import DEFAULT_KEY, key_name
from app.views.exercise.energy_gauge import GaugeMode
from app.views.kit import theme
from app.views.kit.background import run_in_background
from app.views.kit.parts import PlainLabel
from app.views.kit.roles import TECHNICIANS, Role
from app.views.kit.text import tr
from app.views.robot.health_panel import HealthPanel
from app.views.robot.settings import RobotSettings
from app.views.robot.wizard import CommissioningWizard
from app.views.shell.feature import Context, Feature
from app.views.shell.services import RobotPort

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench


MODIFIERS = (
    Qt.Key.Key_Shift,
    Qt.Key.Key_Control,
    Qt.Key.Key_Alt,
    Qt.Key.Key_AltGr,
    Qt.Key.Key_Meta,
    Qt.Key.Key_CapsLock,
    Qt.Key.Key_NumLock,
    Qt.Key.Key_unknown,
)
MOVING = (
    Qt.Key.Key_Escape,
    Qt.Key.Key_Return,
    Qt.Key.Key_Enter,
    Qt.Key.Key_Tab,
    Qt.Key.Key_Backtab,
    Qt.Key.Key_Left,
    Qt.Key.Key_Right,
    Qt.Key.Key_Up,
    Qt.Key.Key_Down,
    Qt.Key.Key_PageUp,
    Qt.Key.Key_PageDown,
    Qt.Key.Key_Home,
    Qt.Key.Key_End,
    Qt.Key.Key_S,
    Qt.Key.Key_A,
    Qt.Key.Key_F5,
)
"""Keys that mean something during an attempt."""


def refusal(key: Qt.Key, taken: Iterable[QKeySequence]) -> str:
    """Say why a key cannot be the one; empty if it can."""
    if key in MODIFIERS:
        return tr("this key is a modifier; take another one")
    if key in MOVING or any(QKeySequence(key) == sequence for sequence in taken):
        return tr("{key} has another meaning in the window; take another one", key=key_name(key))
    return ""


class KeyDialog(QDialog):
    """Takes the next key that is pressed.

    Signals:
        chosen(Qt.Key): the user pressed a key that is free, and confirmed.
    """

    chosen = Signal(object)

    def __init__(
        self, present: Qt.Key, taken: Iterable[QKeySequence], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Key for the forces"))
        self._key, self._taken = present, tuple(taken)
        self._shown, self._note = PlainLabel(self), PlainLabel(self)
        self._shown.setStyleSheet(f"font-size: {theme.TITLE_PX + 8}px; font-weight: 600;")
        self._shown.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._note.setWordWrap(True)
        self._note.setMinimumHeight(3 * theme.FONT_PX)
        words = PlainLabel(
            tr(
                "Press the key or pedal that shall switch the forces on while it is held. A pedal "
                "on USB counts as a keyboard."
            )
        )
        words.setWordWrap(True)
        kinds = QDialogButtonBox.StandardButton
        buttons = QDialogButtonBox(kinds.Ok | kinds.Cancel | kinds.RestoreDefaults, parent=self)
        for button in buttons.buttons():
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # keys go to the dialog
        buttons.accepted.connect(self._take)
        buttons.rejected.connect(self.reject)
        restore = buttons.button(kinds.RestoreDefaults)
        restore.clicked.connect(lambda: self.show_key(DEFAULT_KEY))
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        for widget in (words, self._shown, self._note, buttons):
            column.addWidget(widget)
        self.setMinimumWidth(380)
        self.show_key(present)

    def show_key(self, key: Qt.Key) -> None:
        """Show a key, or why it cannot be taken."""
        reason = refusal(key, self._taken)
        if not reason:
            self._key = key
            self._shown.setText(key_name(key))
        colour, symbol = theme.VERDICTS["bad"]
        self._note.setText(f"{symbol} {reason}" if reason else "")
        self._note.setStyleSheet(f"color: {colour};")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take the key; Esc closes as everywhere."""
        if event.key() == Qt.Key.Key_Escape:
            self.reject()
        elif not event.isAutoRepeat():
            self.show_key(Qt.Key(event.key()))

    def _take(self) -> None:
        self.chosen.emit(self._key)
        self.accept()


class RobotFeature(Feature):
    """Menu, panel and wizard of the robot.

    Signals:
        changed(): another robot, key or mode was chosen.
        served(): services of this computer answer for other robots than before.
    """

    changed = Signal()
    served = Signal()
    topic: ClassVar[str] = "robot"
    place: ClassVar[int] = 70
    roles: ClassVar[frozenset[Role]] = TECHNICIANS

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._equipment, self._conductor = context.equipment, context.conductor
        self._runs, self._attempt = context.runs, context.conductor.views
        self._window = context.shell.dialog_parent
        self._opening = self._asking = False
        self._served: tuple[RobotPort, ...] = ()
        self.wizard: CommissioningWizard | None = None
        self.panel = HealthPanel()
        context.shell.add_panel(self.panel, tr("Robot"), scrolls=False)
        self._connect()
        self._apply()
        self.menu = RobotMenu(context.shell.menu(tr("&Robot")), self)

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._equipment.accepted, self._conductor.controller.finished)

    def forget(self) -> None:
        """Show no health of a run that has ended."""
        self.panel.clear()

    @property
    def settings(self) -> RobotSettings:
        """Return what is remembered of robot and hand."""
        return self._equipment.remembered

    # --- which robot ------------------------------------------------------------------------------
    @property
    def port(self) -> str:
        """Port of the robot that is used; empty for the simulated one."""
        return self._equipment.port

    @property
    def pen(self) -> str:
        """Source of the webcam of a pen that is used in place of a robot; empty without one."""
        return self._equipment.pen

    def ports(self) -> tuple[RobotPort, ...]:
        """Ports at which a robot may be; the chosen one is always among them.

        The system lists no pseudo-terminals, and a port whose robot is unplugged no more.
        """
        found = (*self.context.services.robots(), *self._served)
        chosen = self.port
        if chosen and chosen not in [robot.port for robot in found]:
            there = Path(chosen).exists() or not Path(chosen).is_absolute()  # is no name of a file
            title = chosen if there else tr("{port} – not plugged in", port=chosen)
            found = (*found, RobotPort(chosen, title))
        return found

    def look_for_served(self) -> None:
        """Ask, beside the window, for robots that a service answers for: `served` says so.

        Not while one is used: the service is left alone then.
        """
        used = self.port and not Path(self.port).is_absolute()
        if self._asking or used:
            return
        self._asking, services = True, self.context.services
        run_in_background(
            self,
            lambda _: services.served_robots(),
            self._take_served,
            lambda _: self._take_served(()),
        )

    def _take_served(self, robots: tuple[RobotPort, ...]) -> None:
        self._asking = False
        if robots != self._served:
            self._served = robots
            self.served.emit()

    def choose(self, port: str) -> None:
        """Take another robot; empty for the simulated one. Refused while an attempt runs."""
        if self._equipment.choose(port) and not self._opening:
            self._conductor.take_again()  # one that failed before may be there now

    @property
    def offers_pen(self) -> bool:
        """Return whether there is a pen that could be used in place of a robot."""
        return self._equipment.offers_pen

    def ask_pen(self) -> None:
        """Ask for a pen that stands in for the robot."""
        self._equipment.pen_wanted.emit()

    def show_health(self) -> None:
        """Bring the robot's health to the front."""
        self.context.shell.show_panel(self.panel)

    def ask_port(self) -> None:
        """Ask for a port that the system does not list, such as an emulated robot's."""
        dialog = QInputDialog(self._window)
        dialog.setWindowTitle(tr("Other port"))
        dialog.setLabelText(
            tr(
                "Port of the robot, for example /dev/ttyUSB0, or what `acus device emulate` has "
                "printed;\nhaply: is a Haply Inverse3"
            )
        )
        dialog.setTextValue(self.port)
        dialog.textValueSelected.connect(self._choose_typed)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def set_practise_holding(self, wanted: bool) -> None:
        """Arm the simulated robot by a held key as well, or by the attempt's beginning."""
        if not self._refused():
            self.settings.practise_holding = wanted
        self._equipment.apply()

    def set_gauge(self, mode: GaugeMode) -> None:
        """Say when the energy gauge is on the page."""
        self.settings.gauge = mode
        self._apply()

    def ask_key(self) -> None:
        """Ask for the key that arms while it is held."""
        dialog = KeyDialog(self.settings.enable_key, self._taken_keys(), self._window)
        dialog.chosen.connect(self._take_key)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    # --- commissioning ----------------------------------------------------------------------------
    def commission(self) -> None:
        """Let the run go and open the chosen robot for the wizard."""
        if self._opening or self.wizard is not None or self._refused():
            return
        port, profile = self.port, self._conductor.profile
        if not port:
            self.failed.emit(
                tr(
                    "The simulated robot needs no commissioning: choose the robot's port in the "
                    "menu Robot, Use. `acus device emulate` brings one to practise on."
                )
            )
            return
        if profile is None:
            self.failed.emit(tr("Choose an exercise first: it names the device."))
            return
        self._opening = True
        self._conductor.let_go()
        closed, services = self._runs.closed(), self.context.services

        def operation(progress: Progress) -> Bench:
            closed()  # the wire has one end only
            return services.open_robot(port, profile, progress)

        run_in_background(
            self,
            operation,
            self._commission,
            self._not_opened,
            lambda: self._not_opened(None),
            title=tr("Opening the robot"),
            indicator=self.context.shell.progress,
        )

    def _commission(self, bench: Bench) -> None:
        self._opening = False
        self.wizard = CommissioningWizard(bench, self._window)
        self.wizard.finished.connect(self._commissioned)
        self.wizard.open()

    def _commissioned(self) -> None:
        wizard, self.wizard = self.wizard, None
        if wizard is not None:
            wizard.deleteLater()
        self._conductor.take_again()

    def _not_opened(self, error: Exception | None) -> None:
        self._opening = False
        if error is not None:
            self.failed.emit(error)
        self._conductor.take_again()

    def close(self) -> None:
        """End the wizard, with the forces off; idempotent."""
        if self.wizard is not None:
            self.wizard.close()

    # --- inside -----------------------------------------------------------------------------------
    def _connect(self) -> None:
        health = self.panel
        self._conductor.controller.snapshot_taken.connect(self._show_health)
        self._conductor.controller.rester.watched.append(health.isVisible)
        self._runs.gone.connect(health.clear)
        self._runs.starting.connect(health.set_starting)
        health.commissioning_wanted.connect(self.commission)
        self._attempt.bullseye.source.chosen.connect(self._remember_hand)
        self._attempt.panel.enable.key.watch(self._window)
        self._equipment.changed.connect(self._apply)

    def _apply(self) -> None:
        """Bring panel and hand in line with what is remembered."""
        remembered, panel = self.settings, self._attempt.panel
        panel.enable.set_key(remembered.enable_key)
        panel.energy.set_mode(remembered.gauge)
        source = self._attempt.bullseye.source
        if remembered.hand and remembered.hand != source.name:
            source.set_source(remembered.hand)
        self.changed.emit()

    def _choose_typed(self, text: str) -> None:
        if text.strip():
            self.choose(text.strip())

    def _show_health(self, snapshot: Snapshot) -> None:
        seen = self.panel.isVisible()  # asked anew then: another power cycle is told at once
        run = self._runs.run if seen else self._conductor.controller.run
        if run is not None:
            self.panel.show_snapshot(run, snapshot, self._conductor.controller.rates, snapshot.time)

    def _remember_hand(self, name: str) -> None:
        self.settings.hand = name

    def _take_key(self, key: Qt.Key) -> None:
        self.settings.enable_key = key
        self._apply()

    def _taken_keys(self) -> list[QKeySequence]:
        actions = self._window.findChildren(QAction)
        return [key for action in actions for key in action.shortcuts()]

    def _refused(self) -> bool:
        return self._equipment.refused(tr("the robot"))


class RobotMenu:
    """Fills a menu with what the feature does."""

    def __init__(self, menu: QMenu, robot: RobotFeature) -> None:
        self._robot = robot
        self.robots = menu.addMenu(tr("Use"))
        self.robots.aboutToShow.connect(self._fill_robots)
        self.robots.aboutToShow.connect(robot.look_for_served)
        robot.served.connect(self._fill_robots)
        self._add(menu, tr("Robot's health"), robot.show_health, "F8")
        self._add(menu, tr("Commissioning…"), robot.commission)
        menu.addSeparator()
        self.holding = menu.addAction(tr("Arm the simulated robot by a held key too"))
        self.holding.setCheckable(True)
        self.holding.triggered.connect(robot.set_practise_holding)
        self.key = self._add(menu, "", robot.ask_key)
        self.gauge = self._gauge(menu.addMenu(tr("Energy gauge")))
        robot.changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show what is chosen."""
        settings = self._robot.settings
        self.holding.setChecked(settings.practise_holding)
        self.key.setText(tr("Key for the forces: {key}…", key=key_name(settings.enable_key)))
        for mode, action in self.gauge.items():
            action.setChecked(mode is settings.gauge)

    def _fill_robots(self) -> None:
        self.robots.clear()
        chosen = self._robot.port
        choices = [("", tr("Simulated robot"))]
        choices += [(robot.port, robot.title) for robot in self._robot.ports()]
        for port, title in choices:
            action = self.robots.addAction(title)
            action.setCheckable(True)
            action.setChecked(port == chosen and not self._robot.pen)
            action.triggered.connect(lambda _=False, port=port: self._robot.choose(port))
        if len(choices) == 1:
            self.robots.addAction(tr("no other robot is plugged in")).setEnabled(False)
        self.robots.addSeparator()
        self._add(self.robots, tr("Other port…"), self._robot.ask_port)
        if not self._robot.offers_pen:
            return
        pen = self._add(self.robots, tr("No robot: pen and webcam…"), self._robot.ask_pen)
        pen.setCheckable(True)
        pen.setChecked(bool(self._robot.pen))

    def _gauge(self, menu: QMenu) -> dict[GaugeMode, QAction]:
        group = QActionGroup(menu)
        titles = {
            GaugeMode.AUTO: tr("With a real robot, and when the guard acts"),
            GaugeMode.SHOWN: tr("Always"),
            GaugeMode.HIDDEN: tr("Never"),
        }
        actions = {}
        for mode, title in titles.items():
            action = menu.addAction(title)
            action.setCheckable(True)
            action.triggered.connect(lambda _=False, mode=mode: self._robot.set_gauge(mode))
            group.addAction(action)
            actions[mode] = action
        return actions

    @staticmethod
    def _add(menu: QMenu, text: str, command: Callable[[], object], key: str = "") -> QAction:
        action = menu.addAction(text)
        if key:
            action.setShortcut(key)
        action.triggered.connect(lambda _=False: command())
        return action
