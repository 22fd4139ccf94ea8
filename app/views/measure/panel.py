"""The list of measurements: tools, names, values, and what to do with them."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QButtonGroup,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.planning.measurements import KINDS, Measurement
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.measure.editor import MeasureEditor, MeasureTool


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
        MeasureTool.REGION: tr("Drag from corner to corner: mean ± deviation and area of the "
                               "ellipse"),
    }.get(tool, "")  # fmt: skip


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
        self.remove = QPushButton(tr("Remove"), self)
        self.clear = QPushButton(tr("Remove all"), self)
        self.export = QPushButton(tr("Export…"), self)
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
        name.setToolTip(tr("{kind}: type to name it", kind=kind_word(item)))
        if not item.name:
            name.setText(kind_word(item))
            name.setForeground(Qt.GlobalColor.lightGray)
        value = QTableWidgetItem(found.text)
        value.setFlags(value.flags() & ~Qt.ItemFlag.ItemIsEditable)
        value.setToolTip("\n".join(
            f"{q.name}: {q.value:.2f} {q.unit}" for q in found if q.value is not None
        ))  # fmt: skip
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
        button.setToolTip(tool_help(tool))
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
        for number, button in enumerate(self.buttons.values()):
            tools.addWidget(button, *divmod(number, 2))
        row = QHBoxLayout()
        for button in (self.remove, self.clear, self.export):
            row.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        column.addLayout(tools)
        column.addWidget(self.table, 1)
        column.addLayout(row)
