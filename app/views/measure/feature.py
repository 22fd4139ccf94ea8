"""Measuring in the window: tools, the list of measurements, panes, menu and files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import ClassVar

import numpy as np
from PySide6.QtCore import QEvent, QObject, QSignalBlocker, Qt, Signal, SignalInstance
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QButtonGroup,
    QFileDialog,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QMenu,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.exchange.csv_export import write_measurements
from app.planning.measurements import KINDS, Measurement
from app.views.kit import theme
from app.views.kit.menu_entries import add_entries
from app.views.kit.parts import FittingButton
from app.views.kit.roles import STAFF, Role
from app.views.kit.text import literal, number, tr
from app.views.measure.editor import MeasureEditor, MeasureTool
from app.views.measure.layer import MeasureGrip, MeasureLayer
from app.views.shell.feature import Context, Feature
from app.views.slices.pane import SlicePane
from app.views.slices.viewing import Tool


def tool_title(tool: MeasureTool) -> str:
    """Name of a tool."""
    return {
        MeasureTool.DISTANCE: tr("Distance"),
        MeasureTool.ANGLE: tr("Angle"),
        MeasureTool.PROBE: tr("HU probe"),
        MeasureTool.REGION: tr("Region (mean)"),
    }.get(tool, "")


def tool_help(tool: MeasureTool) -> str:
    """Say how a tool is used."""
    return {
        MeasureTool.DISTANCE: tr("Drag from point to point"),
        MeasureTool.ANGLE: tr("Drag along one side to the vertex, then click the other side"),
        MeasureTool.PROBE: tr("Click: the value of that voxel"),
        MeasureTool.REGION: tr(
            "Drag from corner to corner: mean ± deviation and area of the ellipse"
        ),
    }.get(tool, "")


def kind_word(item: Measurement) -> str:
    """Name of a measurement's kind."""
    return tool_title(MeasureTool(KINDS[type(item)]))


TOOLS = (MeasureTool.DISTANCE, MeasureTool.ANGLE, MeasureTool.PROBE, MeasureTool.REGION)


class MeasurePanel(QWidget):
    """Shows an editor's list; the name of a row can be typed over.

    Signals:
        jump_wanted(Measurement): the slices shall go to it.
        export_wanted(): the list shall be written to a file.
    """

    jump_wanted = Signal(object)
    export_wanted = Signal()

    def __init__(self, editor: MeasureEditor, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._editor = editor
        self._group = QButtonGroup(self)
        self._group.setExclusive(False)
        self.buttons = {tool: self._tool_button(tool) for tool in TOOLS}
        self.table = QTableWidget(0, 2, self)
        self.table.setTabKeyNavigation(False)
        self.remove = FittingButton(tr("Remove"), self)
        self.clear = FittingButton(tr("Remove all"), self)
        self.export = FittingButton(tr("Export…"), self)
        self._prepare()
        self._lay_out()
        editor.changed.connect(self.refresh)
        editor.tool_changed.connect(self._show_tool)
        self.refresh()

    def refresh(self) -> None:
        """Fill the list."""
        items = self._editor.items
        with QSignalBlocker(self.table):
            self.table.setRowCount(len(items))
            for row, item in enumerate(items):
                self._show_row(row, item)
            self.table.resizeRowsToContents()
        self._enable()

    # --- inside -----------------------------------------------------------------------------------
    def _show_row(self, row: int, item: Measurement) -> None:
        found = self._editor.measured(item)
        name = QTableWidgetItem(item.name)
        name.setToolTip(literal(tr("{kind}: type to name it", kind=kind_word(item))))
        if not item.name:
            name.setText(kind_word(item))
            name.setForeground(Qt.GlobalColor.lightGray)
        value = QTableWidgetItem(found.text)
        value.setFlags(value.flags() & ~Qt.ItemFlag.ItemIsEditable)
        value.setToolTip(
            literal(
                "\n".join(
                    f"{q.name}: {number(q.value, '.2f')} {q.unit}"
                    for q in found
                    if q.value is not None
                )
            )
        )
        self.table.setItem(row, 0, name)
        self.table.setItem(row, 1, value)

    def _rename(self, cell: QTableWidgetItem) -> None:
        if cell.column() == 0 and cell.row() < len(self._editor.items):
            item, text = self._editor.items[cell.row()], cell.text().strip()
            if text != item.name and not (not item.name and text == kind_word(item)):
                self._editor.rename(cell.row(), text)

    def _remove(self) -> None:
        row = self.table.currentRow()
        if 0 <= row < len(self._editor.items):
            self._editor.remove(row)

    def _jump(self, row: int, column: int) -> None:
        if column == 1 and row < len(self._editor.items):
            self.jump_wanted.emit(self._editor.items[row])

    def _choose(self, tool: MeasureTool) -> None:
        armed = self._editor.tool is tool
        self._editor.set_tool(MeasureTool.NONE if armed else tool)
        self._show_tool()

    def _show_tool(self) -> None:
        for tool, button in self.buttons.items():
            button.setChecked(self._editor.tool is tool)

    def _enable(self) -> None:
        some = bool(self._editor.items)
        for button in (self.remove, self.clear, self.export):
            button.setEnabled(some)

    def _tool_button(self, tool: MeasureTool) -> QPushButton:
        button = QPushButton(tool_title(tool), self)
        button.setCheckable(True)
        button.setToolTip(literal(tool_help(tool)))
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.clicked.connect(lambda _=False, tool=tool: self._choose(tool))
        self._group.addButton(button)
        return button

    def _prepare(self) -> None:
        table = self.table
        table.setHorizontalHeaderLabels([tr("Name"), tr("Value")])
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        table.setShowGrid(False)
        table.setAccessibleName(tr("Measurements"))
        table.setToolTip(tr("Double click on a value: the slices go there"))
        table.verticalHeader().hide()
        table.setWordWrap(True)
        header = table.horizontalHeader()
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Interactive)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.Stretch)
        header.resizeSection(0, 120)
        table.itemChanged.connect(self._rename)
        table.cellDoubleClicked.connect(self._jump)
        self.remove.clicked.connect(self._remove)
        self.clear.clicked.connect(self._editor.clear)
        self.export.clicked.connect(self.export_wanted)

    def _lay_out(self) -> None:
        tools = QGridLayout()
        tools.setSpacing(4)
        for place, button in enumerate(self.buttons.values()):
            tools.addWidget(button, *divmod(place, 2))
        row = QHBoxLayout()
        for button in (self.remove, self.clear, self.export):
            row.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        column.addLayout(tools)
        column.addWidget(self.table, 1)
        column.addLayout(row)


FILE_KINDS = "Table (*.csv);;3D Slicer markups (*.mrk.json)"


class MeasureFeature(Feature):
    """Tools in the panes, the list as a panel, its files."""

    topic: ClassVar[str] = "measure"
    place: ClassVar[int] = 110
    roles: ClassVar[frozenset[Role]] = STAFF

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
            self._window,
            tr("Export measurements"),
            str(Path.home() / "measurements.csv"),
            tr(FILE_KINDS),
        )
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
            action.setToolTip(literal(tool_help(tool)))
            action.triggered.connect(lambda _=False, tool=tool: editor.set_tool(tool))
            self.tools[tool] = action
        menu.setToolTipsVisible(True)
        self._viewing.scheme_changed.connect(self.refresh)
        self.refresh()
        menu.addSeparator()
        add_entries(
            menu,
            [
                (tr("List of measurements"), "", measure.show),
                (tr("Export measurements…"), "", measure.export),
            ],
        )

    def refresh(self) -> None:
        """Take the keys of the scheme that is chosen."""
        for tool, action in self.tools.items():
            action.setShortcut(QKeySequence(self._viewing.scheme.menu_keys[tool.value]))
