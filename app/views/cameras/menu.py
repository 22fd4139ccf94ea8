"""The menu Cameras."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from app.views.cameras.desk import CamerasDesk
from app.views.kit.text import tr


class CamerasMenu:
    """Fills a menu with what `CamerasDesk` does."""

    def __init__(self, menu: QMenu, desk: CamerasDesk) -> None:
        self._desk = desk
        group = QActionGroup(menu)
        self.simulated = self._choice(menu, group, tr("Simulated cameras"), False)
        self.real = self._choice(menu, group, "", True)
        menu.addSeparator()
        self.set_up = self._add(menu, tr("Set up…"), desk.set_up)
        self.aim = self._add(menu, tr("Aim…"), desk.aim)
        self.calibrate = self._add(menu, tr("Calibrate…"), desk.calibrate)
        latency = menu.addMenu(tr("Latency"))
        menu.setToolTipsVisible(True)
        latency.menuAction().setToolTip(tr(
            "How late a picture comes: a patch blinks, the camera looks at it, the delay is kept"
        ))  # fmt: skip
        for action, help_ in (
            (self.set_up, tr("Which cameras there are: size, rate, exposure, live pictures")),
            (self.aim, tr("Where the needle can be, drawn into both live pictures")),
            (self.calibrate, tr("Lenses and places of the cameras, from pictures of a board")),
        ):
            action.setToolTip(help_)
        self._add(latency, tr("Left camera…"), lambda: desk.measure_latency("left"))
        self._add(latency, tr("Right camera…"), lambda: desk.measure_latency("right"))
        desk.changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show what is chosen."""
        chosen = self._desk.chosen
        text = tr("Real cameras: choose…")
        if not chosen.simulated:
            left, right = (camera.source for camera in chosen.cameras)
            text = tr("Real cameras: {left}, {right}", left=_short(left), right=_short(right))
        self.real.setText(text)
        self.real.setChecked(self._desk.real)
        self.simulated.setChecked(not self._desk.real)

    def _choice(self, menu: QMenu, group: QActionGroup, text: str, real: bool) -> QAction:
        action = menu.addAction(text)
        action.setCheckable(True)
        group.addAction(action)
        action.triggered.connect(lambda _=False: self._desk.use_real(real))
        return action

    @staticmethod
    def _add(menu: QMenu, text: str, command: Callable[[], object]) -> QAction:
        action = menu.addAction(text)
        action.triggered.connect(lambda _=False: command())
        return action


def _short(source: str) -> str:
    """Return a source without the folders of its path, to fit into a menu."""
    kind, colon, place = source.partition(":")
    return f"{kind}{colon}{place.rsplit('/', 1)[-1]}"
