"""What the menu Robot does: which robot, how it is armed, the hand, and its commissioning."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QInputDialog, QWidget

from app.core.progress import Progress
from app.session.machine import RUNNING
from app.session.snapshot import Snapshot
from app.views.exercise.conductor import Conductor
from app.views.exercise.energy_gauge import GaugeMode
from app.views.exercise.runs import Runs
from app.views.kit.background import Indicator, run_in_background
from app.views.kit.text import tr
from app.views.reading.workspace import Workspace
from app.views.robot.bench import BenchPort
from app.views.robot.key_dialog import KeyDialog
from app.views.robot.settings import RobotSettings
from app.views.robot.wizard import Wizard
from app.views.shell.services import RobotChoice, RobotPort, Services

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings


class RobotDesk(QObject):
    """Applies what was remembered, and remembers what the user chooses.

    Signals:
        failed(object): an error to show.
        accepted(): what the user wants is not refused: what was refused before is over.
        changed(): another robot, key or mode was chosen.
    """

    failed = Signal(object)
    accepted = Signal()
    changed = Signal()

    def __init__(
        self,
        services: Services,
        settings: QSettings,
        conductor: Conductor,
        runs: Runs,
        workspace: Workspace,
        indicator: Indicator,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.settings = RobotSettings(settings)
        self._services, self._conductor, self._runs = services, conductor, runs
        self._workspace, self._indicator, self._window = workspace, indicator, parent
        self._opening = False
        self._taken: str | None = None
        self._taken_pen: str | None = None
        self.wizard: Wizard | None = None
        self._connect()
        self._apply()

    # --- which robot ------------------------------------------------------------------------------
    @property
    def port(self) -> str:
        """Port of the robot that is used; empty for the simulated one."""
        return self.settings.port if self._taken is None else self._taken

    def take(self, port: str) -> None:
        """Take a robot until another one is chosen, without remembering it."""
        self._taken, self._taken_pen = port, ""
        self._apply()

    @property
    def pen(self) -> str:
        """Source of the webcam of a pen that is used in place of a robot; empty without one."""
        return self.settings.pen if self._taken_pen is None else self._taken_pen

    def use_pen(self, source: str) -> bool:
        """Use a pen before a webcam in place of the robot, and remember it.

        Args:
            source: of the webcam's pictures; empty to use the robot again.

        Returns whether it is done: it is refused while an attempt runs.
        """
        if self._refused_in_attempt():
            return False
        self.settings.pen, self._taken, self._taken_pen = source, None, None
        self._apply()
        return True

    def take_pen(self, source: str) -> None:
        """Take a pen before a webcam in place of the robot, until a robot is chosen.

        Refused while an attempt runs.
        """
        if not self._refused_in_attempt():
            self._taken, self._taken_pen = "", source
            self._apply()

    def ports(self) -> tuple[RobotPort, ...]:
        """Ports at which a robot may be; the chosen one is always among them.

        The system lists no pseudo-terminals, and a port whose robot is unplugged no more.
        """
        found = self._services.robots()
        chosen = self.port
        if chosen and chosen not in [robot.port for robot in found]:
            there = Path(chosen).exists()
            title = chosen if there else tr("{port} – not plugged in", port=chosen)
            found = (*found, RobotPort(chosen, title))
        return found

    def choose(self, port: str) -> None:
        """Take another robot; empty for the simulated one. Refused while an attempt runs."""
        if self._refused_in_attempt():
            return
        self.settings.port, self.settings.pen = port, ""
        self._taken = self._taken_pen = None
        self._apply()
        if not self._opening:
            self._conductor.take_again()  # one that failed before may be there now

    def ask_port(self) -> None:
        """Ask for a port that the system does not list, such as an emulated robot's."""
        dialog = QInputDialog(self._window)
        dialog.setWindowTitle(tr("Other port"))
        dialog.setLabelText(tr(
            "Port of the robot, for example /dev/ttyUSB0, or what `acus device emulate` has printed"
        ))  # fmt: skip
        dialog.setTextValue(self.port)
        dialog.textValueSelected.connect(self._choose_typed)
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def set_practise_holding(self, wanted: bool) -> None:
        """Arm the simulated robot by a held key as well, or by the attempt's beginning."""
        if not self._refused_in_attempt():
            self.settings.practise_holding = wanted
        self._apply()

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
        if self._opening or self.wizard is not None or self._refused_in_attempt():
            return
        port, profile = self.port, self._conductor.profile
        if not port:
            self.failed.emit(tr(
                "The simulated robot needs no commissioning: choose the robot's port in the menu "
                "Robot, Use. `acus device emulate` brings one to practise on."
            ))  # fmt: skip
            return
        if profile is None:
            self.failed.emit(tr("Choose an exercise first: it names the device."))
            return
        self._opening = True
        self._conductor.let_go()
        closed, services = self._runs.closed(), self._services

        def operation(progress: Progress) -> BenchPort:
            closed()  # the wire has one end only
            return services.open_robot(port, profile, progress)

        run_in_background(
            self, operation, self._commission, self._not_opened, lambda: self._not_opened(None),
            title=tr("Opening the robot"), indicator=self._indicator,
        )  # fmt: skip

    def _commission(self, bench: BenchPort) -> None:
        self._opening = False
        self.wizard = Wizard(bench, self._window)
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
        controller, health = self._conductor.controller, self._workspace.health_panel
        controller.snapshot_taken.connect(self._show_health)
        self._runs.gone.connect(health.clear)
        self._runs.starting.connect(health.set_starting)
        health.commissioning_wanted.connect(self.commission)
        self._workspace.bullseye.source.chosen.connect(self._remember_hand)
        self._workspace.exercise_panel.enable.key.watch(self._window)

    def _apply(self) -> None:
        """Bring everything in line with what is remembered."""
        remembered, panel = self.settings, self._workspace.exercise_panel
        panel.enable.set_key(remembered.enable_key)
        panel.energy.set_mode(remembered.gauge)
        source = self._workspace.bullseye.source
        if remembered.hand and remembered.hand != source.name:
            source.set_source(remembered.hand)
        held = not self.pen and (bool(self.port) or remembered.practise_holding)
        self._conductor.set_robot(RobotChoice("" if self.pen else self.port, held, self.pen))
        self.changed.emit()

    def _choose_typed(self, text: str) -> None:
        if text.strip():
            self.choose(text.strip())

    def _show_health(self, snapshot: Snapshot) -> None:
        run = self._runs.run  # asked each time: another power cycle of the board is told at once
        if run is not None:
            self._workspace.health_panel.show_snapshot(
                run, snapshot, self._conductor.controller.rates, snapshot.time
            )

    def _remember_hand(self, name: str) -> None:
        self.settings.hand = name

    def _take_key(self, key: Qt.Key) -> None:
        self.settings.enable_key = key
        self._apply()

    def _taken_keys(self) -> list[QKeySequence]:
        actions = self._window.findChildren(QAction)
        return [key for action in actions for key in action.shortcuts()]

    def _refused_in_attempt(self) -> bool:
        run = self._conductor.controller.run
        if run is None or run.trainer.snapshot().state not in RUNNING:
            self.accepted.emit()
            return False
        self.failed.emit(tr("An attempt is running: end it first, then change the robot."))
        return True
