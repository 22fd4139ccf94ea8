"""The menu of measuring."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QMenu

from app.views.kit.text import tr
from app.views.measure.panel import TOOLS
from app.views.measure.words import tool_help, tool_title

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow


class MeasureMenu:
    """Fills a menu: tools, the list, export.

    Attributes:
        menu: that was filled.
    """

    def __init__(self, menu: QMenu, window: MainWindow) -> None:
        self.menu = menu
        workspace = window.workspace
        self._viewing = workspace.viewing
        self.tools = {}
        for tool in TOOLS:
            action = menu.addAction(tool_title(tool))
            action.setToolTip(tool_help(tool))
            action.triggered.connect(lambda _=False, tool=tool: workspace.measure.set_tool(tool))
            self.tools[tool] = action
        menu.setToolTipsVisible(True)
        self._viewing.scheme_changed.connect(self.refresh)
        self.refresh()
        menu.addSeparator()
        menu.addAction(tr("List of measurements")).triggered.connect(workspace.show_measurements)
        menu.addAction(tr("Export measurements…")).triggered.connect(window.measuring.export)

    def refresh(self) -> None:
        """Take the keys of the scheme that is chosen."""
        for tool, action in self.tools.items():
            action.setShortcut(QKeySequence(self._viewing.scheme.menu_keys[tool.value]))
