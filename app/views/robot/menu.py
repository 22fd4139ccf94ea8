"""The menu Robot."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from app.views.exercise.enable_key import key_name
from app.views.exercise.energy_gauge import GaugeMode
from app.views.kit.text import tr
from app.views.robot.desk import RobotDesk


class RobotMenu:
    """Fills a menu with what `RobotDesk` does.

    Args:
        menu: to fill.
        desk: that does it.
        show_health: brings the panel to the front.
        open_pen: opens the page of the pen that stands in for a robot.
    """

    def __init__(
        self,
        menu: QMenu,
        desk: RobotDesk,
        show_health: Callable[[], object],
        open_pen: Callable[[], object],
    ) -> None:
        self._desk, self._open_pen = desk, open_pen
        self.robots = menu.addMenu(tr("Use"))
        self.robots.aboutToShow.connect(self._fill_robots)
        self._add(menu, tr("Robot's health"), show_health, "F8")
        self._add(menu, tr("Commissioning…"), desk.commission)
        menu.addSeparator()
        self.holding = menu.addAction(tr("Arm the simulated robot by a held key too"))
        self.holding.setCheckable(True)
        self.holding.triggered.connect(desk.set_practise_holding)
        self.key = self._add(menu, "", desk.ask_key)
        self.gauge = self._gauge(menu.addMenu(tr("Energy gauge")))
        desk.changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show what is chosen."""
        settings = self._desk.settings
        self.holding.setChecked(settings.practise_holding)
        self.key.setText(tr("Key for the forces: {key}…", key=key_name(settings.enable_key)))
        for mode, action in self.gauge.items():
            action.setChecked(mode is settings.gauge)

    def _fill_robots(self) -> None:
        self.robots.clear()
        chosen = self._desk.port
        choices = [("", tr("Simulated robot"))]
        choices += [(robot.port, robot.title) for robot in self._desk.ports()]
        for port, title in choices:
            action = self.robots.addAction(title)
            action.setCheckable(True)
            action.setChecked(port == chosen and not self._desk.pen)
            action.triggered.connect(lambda _=False, port=port: self._desk.choose(port))
        if len(choices) == 1:
            self.robots.addAction(tr("no other robot is plugged in")).setEnabled(False)
        self.robots.addSeparator()
        self._add(self.robots, tr("Other port…"), self._desk.ask_port)
        pen = self._add(self.robots, tr("No robot: pen and webcam…"), self._open_pen)
        pen.setCheckable(True)
        pen.setChecked(bool(self._desk.pen))

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
            action.triggered.connect(lambda _=False, mode=mode: self._desk.set_gauge(mode))
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
