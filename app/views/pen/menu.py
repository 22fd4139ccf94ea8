"""The menu Pen."""

from __future__ import annotations

from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from app.views.kit.text import tr
from app.views.pen.desk import PenDesk


class PenMenu:
    """Fills a menu with what `PenDesk` does."""

    def __init__(self, menu: QMenu, desk: PenDesk) -> None:
        self._desk = desk
        group = QActionGroup(menu)
        self.robot = self._choice(menu, group, tr("The robot holds the needle"))
        self.robot.triggered.connect(lambda _=False: desk.use_robot())
        self.pen = self._choice(menu, group, "")
        self.pen.triggered.connect(lambda _=False: desk.use_last())
        menu.addSeparator()
        self.page = menu.addAction(tr("Pen and webcam: set up, measure, print…"))
        self.page.setShortcut("F4")
        self.page.setToolTip(tr("A needle without a robot: docs/pen.md"))
        self.page.triggered.connect(lambda _=False: desk.open())
        desk.changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show what is chosen."""
        source = self._desk.source
        text = tr("A pen before a webcam: {source}", source=source) if source else tr(
            "A pen before a webcam: choose…"
        )  # fmt: skip
        self.pen.setText(text)
        self.pen.setChecked(self._desk.used)
        self.robot.setChecked(not self._desk.used)

    @staticmethod
    def _choice(menu: QMenu, group: QActionGroup, text: str) -> QAction:
        action = menu.addAction(text)
        action.setCheckable(True)
        group.addAction(action)
        return action
