"""Measuring in the window: brings editor, panes, list, menu and files together."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import ClassVar

import numpy as np
from PySide6.QtCore import QEvent, QObject, Qt, SignalInstance
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QFileDialog, QMenu

from app.core.errors import AcusError
from app.exchange.csv_export import write_measurements
from app.planning.measurements import Measurement
from app.views.kit.menu_entries import add_entries
from app.views.kit.text import tr
from app.views.measure.editor import MeasureEditor, MeasureTool
from app.views.measure.layer import MeasureGrip, MeasureLayer
from app.views.measure.panel import TOOLS, MeasurePanel, tool_help, tool_title
from app.views.shell.feature import Context, Feature
from app.views.slices.pane import SlicePane
from app.views.slices.viewing import Tool

KINDS = "Table (*.csv);;3D Slicer markups (*.mrk.json)"


class MeasureFeature(Feature):
    """Tools in the panes, the list as a panel, its files."""

    topic: ClassVar[str] = "measure"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.editor, self._viewing = context.editors.measures, context.views.viewing
        self._window, editor, viewing = context.shell.dialog_parent, self.editor, self._viewing
        self.panel = panel = MeasurePanel(editor)
        context.shell.add_panel(panel, tr("Measure"), scrolls=False)
        self.attach(context.views.slices)
        viewing.volume_changed.connect(lambda: editor.set_volume(viewing.volume))
        viewing.tool_changed.connect(self._plan_tool_taken)
        editor.tool_changed.connect(self._measure_tool_taken)
        panel.jump_wanted.connect(self._jump)
        panel.export_wanted.connect(self.export)
        self.menu = MeasureMenu(context.shell.menu(tr("&Measure")), self)
        slicer = context.shell.menu(tr("&File"), tr("3D Slicer"))
        add_entries(slicer, [(tr("Export measurements (.mrk.json)…"), "", self.export)])

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.noted,)

    def forget(self) -> None:
        """Let go of the measurements of the patient who leaves."""
        self.editor.set_volume(None)

    def show(self) -> None:
        """Bring the list to the front."""
        self.context.shell.show_panel(self.panel)

    def attach(self, panes: Sequence[SlicePane]) -> None:
        """Let these panes draw and take measurements."""
        for pane in panes:
            attach(pane, self.editor)

    def export(self) -> None:
        """Ask where, and write the list."""
        name, kind = QFileDialog.getSaveFileName(
            self._window, tr("Export measurements"), str(Path.home() / "measurements.csv"),
            tr(KINDS),
        )  # fmt: skip
        if name:
            path = Path(name)
            if not path.suffix:
                path = path.with_name(path.name + (".csv" if "csv" in kind else ".mrk.json"))
            self.write(path)

    def write(self, path: Path) -> None:
        """Write the list to a file; its name says how."""
        volume = self.editor.volume
        try:
            if volume is not None:
                write_measurements(path, self.editor.items, volume)
                self.noted.emit(tr("Saved {name}", name=str(path)))
        except AcusError as error:
            self.failed.emit(error)

    def _jump(self, item: Measurement) -> None:
        self._viewing.set_cursor(np.mean(item.points, axis=0))

    def _plan_tool_taken(self) -> None:
        if self._viewing.tool is not Tool.NAVIGATE:
            self.editor.set_tool(MeasureTool.NONE)

    def _measure_tool_taken(self) -> None:
        if self.editor.tool is not MeasureTool.NONE:
            self._viewing.set_tool(Tool.NAVIGATE)


class _Escape(QObject):
    """Lays the tool down when Esc is pressed in a pane."""

    def __init__(self, editor: MeasureEditor, parent: QObject) -> None:
        super().__init__(parent)
        self._editor = editor

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take Esc while a tool is in hand; leave all else."""
        if event.type() is not QEvent.Type.KeyPress or self._editor.tool is MeasureTool.NONE:
            return False
        if not isinstance(event, QKeyEvent) or event.key() != Qt.Key.Key_Escape:
            return False
        self._editor.set_tool(MeasureTool.NONE)
        return True


def attach(pane: SlicePane, editor: MeasureEditor) -> MeasureLayer:
    """Let a pane draw and take the measurements of an editor."""
    canvas = pane.canvas
    layer = MeasureLayer(canvas.drawing, editor)
    canvas.add_layer(layer)
    pane.gestures.add_grip(MeasureGrip(canvas, editor))
    editor.changed.connect(canvas.refresh)

    def show_tool() -> None:
        armed = editor.tool is not MeasureTool.NONE
        shape = Qt.CursorShape.CrossCursor if armed else Qt.CursorShape.ArrowCursor
        canvas.setCursor(shape)

    editor.tool_changed.connect(show_tool)
    pane.installEventFilter(_Escape(editor, pane))
    return layer


class MeasureMenu:
    """Fills a menu: tools, the list, export."""

    def __init__(self, menu: QMenu, measure: MeasureFeature) -> None:
        self._viewing, editor = measure.context.views.viewing, measure.editor
        self.tools = {}
        for tool in TOOLS:
            action = menu.addAction(tool_title(tool))
            action.setToolTip(tool_help(tool))
            action.triggered.connect(lambda _=False, tool=tool: editor.set_tool(tool))
            self.tools[tool] = action
        menu.setToolTipsVisible(True)
        self._viewing.scheme_changed.connect(self.refresh)
        self.refresh()
        menu.addSeparator()
        add_entries(menu, [
            (tr("List of measurements"), "", measure.show),
            (tr("Export measurements…"), "", measure.export),
        ])  # fmt: skip

    def refresh(self) -> None:
        """Take the keys of the scheme that is chosen."""
        for tool, action in self.tools.items():
            action.setShortcut(QKeySequence(self._viewing.scheme.menu_keys[tool.value]))
