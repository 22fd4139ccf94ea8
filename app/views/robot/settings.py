"""What the window remembers about robot and hand."""

from __future__ import annotations

from PySide6.QtCore import QSettings, Qt

from app.views.exercise.enable_switch import DEFAULT_KEY
from app.views.exercise.energy_gauge import GaugeMode


class RobotSettings:
    """Named values of the window's settings file; what is unusable there counts as not set."""

    def __init__(self, settings: QSettings) -> None:
        self._settings = settings

    @property
    def port(self) -> str:
        """Port of the robot; empty for the simulated one."""
        return str(self._settings.value("robot/port") or "")

    @port.setter
    def port(self, port: str) -> None:
        self._settings.setValue("robot/port", port)

    @property
    def pen(self) -> str:
        """Source of the webcam of the pen that is used in place of a robot; empty for a robot."""
        return str(self._settings.value("robot/pen") or "")

    @pen.setter
    def pen(self, source: str) -> None:
        self._settings.setValue("robot/pen", source)

    @property
    def hand(self) -> str:
        """Source of the simulated hand by name; empty for the default."""
        return str(self._settings.value("robot/hand") or "")

    @hand.setter
    def hand(self, name: str) -> None:
        self._settings.setValue("robot/hand", name)

    @property
    def practise_holding(self) -> bool:
        """Return whether the simulated robot is armed by a held key as well."""
        return str(self._settings.value("robot/held-arming")).lower() == "true"

    @practise_holding.setter
    def practise_holding(self, wanted: bool) -> None:
        self._settings.setValue("robot/held-arming", wanted)

    @property
    def enable_key(self) -> Qt.Key:
        """Key or pedal that arms while it is held."""
        try:
            return Qt.Key(int(str(self._settings.value("robot/enable-key"))))
        except ValueError:
            return DEFAULT_KEY

    @enable_key.setter
    def enable_key(self, key: Qt.Key) -> None:
        self._settings.setValue("robot/enable-key", int(key))

    @property
    def gauge(self) -> GaugeMode:
        """Return when the energy gauge is on the page."""
        try:
            return GaugeMode(str(self._settings.value("robot/energy-gauge")))
        except ValueError:
            return GaugeMode.AUTO

    @gauge.setter
    def gauge(self, mode: GaugeMode) -> None:
        self._settings.setValue("robot/energy-gauge", mode.value)
