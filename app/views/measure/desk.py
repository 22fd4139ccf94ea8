"""Measuring in the window: brings editor, panes, list, menu and files together."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFileDialog

from app.core.errors import AcusError
from app.exchange.measurements import write_measurements
from app.planning.measurements import Measurement
from app.views.kit.text import tr
from app.views.measure.editor import MeasureEditor, MeasureTool
from app.views.measure.grip import MeasureGrip
from app.views.measure.layer import MeasureLayer
from app.views.slices.pane import SlicePane
from app.views.slices.viewing import Tool

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow

KINDS = "Table (*.csv);;3D Slicer markups (*.mrk.json)"


class MeasureDesk(QObject):
    """Owns nothing but the connections.

    Signals:
        failed(object): why the list was not written.
        noted(str): what was written.
    """

    failed = Signal(object)
    noted = Signal(str)

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        workspace = window.workspace
        editor, panel, viewing = workspace.measure, workspace.measure_panel, workspace.viewing
        self._editor, self._viewing, self._window = editor, viewing, window
        self.attach(workspace.slices)
        viewing.volume_changed.connect(lambda: editor.set_volume(viewing.volume))
        viewing.tool_changed.connect(self._plan_tool_taken)
        editor.tool_changed.connect(self._measure_tool_taken)
        panel.jump_wanted.connect(self._jump)
        panel.export_wanted.connect(self.export)

    def attach(self, panes: Sequence[SlicePane]) -> None:
        """Let these panes draw and take measurements."""
        for pane in panes:
            attach(pane, self._editor)

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
        volume = self._editor.volume
        try:
            if volume is not None:
                write_measurements(path, self._editor.items, volume)
                self.noted.emit(tr("Saved {name}", name=str(path)))
        except AcusError as error:
            self.failed.emit(error)

    def _jump(self, item: Measurement) -> None:
        self._viewing.set_cursor(np.mean(item.points, axis=0))

    def _plan_tool_taken(self) -> None:
        if self._viewing.tool is not Tool.NAVIGATE:
            self._editor.set_tool(MeasureTool.NONE)

    def _measure_tool_taken(self) -> None:
        if self._editor.tool is not MeasureTool.NONE:
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
