"""The robot's menu: which one, by which key it is armed, what is shown of its energy."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from app.views.exercise.enable_switch import key_name
from app.views.exercise.energy_gauge import GaugeMode
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.views.robot.feature import RobotFeature


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
