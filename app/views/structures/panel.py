"""The panel of structures: what is drawn, of which kind, when it warns, how far the path is."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPixmap
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QGridLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.imaging.structures.structure import Structure, StructureKind
from app.planning.clearance import Nearness, PathClearance
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, number, tr
from app.views.kit.wheel import wheel_scrolls
from app.views.structures.book import StructureBook
from app.views.structures.brush import Brush, Mode
from app.views.structures.layer import NEARNESS_STYLES, SIGNS, kind_names
from app.views.structures.watch import StructureWatch

NAME, KIND, WARN, PATH = range(4)


class StructureTable(QTableWidget):
    """Shows the book, one structure a row, and turns clicks into changes of it."""

    def __init__(
        self, book: StructureBook, watch: StructureWatch, parent: QWidget | None = None
    ) -> None:
        super().__init__(0, 4, parent)
        self.setTabKeyNavigation(False)
        self._book, self._watch = book, watch
        self._style()
        self.itemChanged.connect(self._edited)
        self.itemSelectionChanged.connect(self._chosen)
        watch.path_changed.connect(self.refresh_path)

    def refresh(self) -> None:
        """Show the book's present state."""
        book, structures = self._book, self._book.structures
        with QSignalBlocker(self):
            self.setRowCount(len(structures))
            for row, structure in enumerate(structures):
                self._show_row(row, structure)
            selected = next((n for n, s in enumerate(structures) if s.name == book.chosen), -1)
            self.setCurrentCell(selected, NAME)
        self.refresh_path()

    def refresh_path(self) -> None:
        """Show the distances of the planned path."""
        for row, structure in enumerate(self._book.structures):
            self._show_path(row, self._watch.path.get(structure.name))

    def _show_row(self, row: int, structure: Structure) -> None:
        item = QTableWidgetItem(structure.name)
        visible = self._book.is_visible(structure.name)
        item.setCheckState(Qt.CheckState.Checked if visible else Qt.CheckState.Unchecked)
        item.setIcon(_swatch(structure))
        item.setToolTip(
            literal(tr("{ml:.2f} ml. Tick: drawn. Double click: rename.", ml=structure.millilitres))
        )
        self.setItem(row, NAME, item)
        box = self.cellWidget(row, KIND)
        spin = self.cellWidget(row, WARN)
        if not isinstance(box, QComboBox) or not isinstance(spin, QDoubleSpinBox):
            box, spin = self._row_widgets(row)
        with QSignalBlocker(box), QSignalBlocker(spin):
            box.setCurrentIndex(box.findData(structure.kind.value))
            box.setAccessibleName(tr("Kind of {name}", name=structure.name))
            spin.setValue(structure.warn_mm)
            spin.setAccessibleName(tr("Warning distance of {name}", name=structure.name))

    def _row_widgets(self, row: int) -> tuple[QComboBox, QDoubleSpinBox]:
        box = QComboBox()
        for kind, name in kind_names().items():
            box.addItem(f"{SIGNS[kind]} {name}", kind.value)
        box.activated.connect(lambda _: self._set_kind(row, StructureKind(box.currentData())))
        spin = spin_box(0.0, 50.0, 0.0, "", 0.5)
        spin.setToolTip(tr("Warn within so many mm; 0 never"))
        spin.valueChanged.connect(lambda value: self._set_warn(row, value))
        # As wide as its words are in this language.
        self.setColumnWidth(KIND, max(self.columnWidth(KIND), box.sizeHint().width()))
        self.setCellWidget(row, KIND, box)
        self.setCellWidget(row, WARN, spin)
        for one in (box, spin):
            wheel_scrolls(one)
        return box, spin

    def _show_path(self, row: int, clearance: PathClearance | None) -> None:
        item = QTableWidgetItem("–")
        if clearance is not None:
            colour, sign = NEARNESS_STYLES[clearance.nearness]
            item.setText(f"{sign} {number(clearance.distance_mm, 'z.1f')}")
            item.setForeground(QColor(theme.now(colour)))
            item.setToolTip(
                literal(
                    tr(
                        "The path comes nearest {depth:.0f} mm behind its entry",
                        depth=clearance.depth_mm,
                    )
                )
            )
        item.setFlags(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable)
        with QSignalBlocker(self):
            self.setItem(row, PATH, item)

    def _set_kind(self, row: int, kind: StructureKind) -> None:
        name = self._book.structures.structures[row].name
        self._book.change(name, kind=kind, warn_mm=kind.warn_mm)

    def _set_warn(self, row: int, warn_mm: float) -> None:
        self._book.change(self._book.structures.structures[row].name, warn_mm=warn_mm)

    def _edited(self, item: QTableWidgetItem) -> None:
        if item.column() != NAME or item.row() >= len(self._book.structures):
            return
        structure = self._book.structures.structures[item.row()]
        visible = item.checkState() is Qt.CheckState.Checked
        if item.text() != structure.name:
            self._book.change(structure.name, name=item.text())
        elif visible != self._book.is_visible(structure.name):
            self._book.set_visible(structure.name, visible)

    def _chosen(self) -> None:
        row = self.currentRow()
        if 0 <= row < len(self._book.structures):
            self._book.choose(self._book.structures.structures[row].name)

    def _style(self) -> None:
        self.setHorizontalHeaderLabels([tr("Name"), tr("Kind"), tr("Warn\n[mm]"), tr("Path\n[mm]")])
        self.verticalHeader().setVisible(False)
        self.verticalHeader().setDefaultSectionSize(theme.CONTROL_HEIGHT + 2)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setMinimumHeight(180)
        header = self.horizontalHeader()
        header.setSectionResizeMode(NAME, QHeaderView.ResizeMode.Stretch)
        for column, width in ((KIND, 92), (WARN, 68), (PATH, 66)):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            self.setColumnWidth(column, width)
        self.setAccessibleName(tr("Structures"))


def spin_box(low: float, high: float, value: float, suffix: str, step: float) -> QDoubleSpinBox:
    """Return a box for a number; a step of 1 or more shows whole ones."""
    box = QDoubleSpinBox()
    box.setRange(low, high)
    box.setDecimals(0 if step >= 1.0 else 1)
    box.setSingleStep(step)
    box.setValue(value)
    box.setSuffix(suffix)
    box.setKeyboardTracking(False)
    return box


def _swatch(structure: Structure) -> QIcon:
    pixmap = QPixmap(14, 14)
    pixmap.fill(QColor(*structure.colour))
    return QIcon(pixmap)


class StructurePanel(QWidget):
    """Shows the book and turns clicks into changes of it.

    Signals:
        import_wanted(), export_wanted(), threshold_wanted().
    """

    import_wanted = Signal()
    export_wanted = Signal()
    threshold_wanted = Signal()

    def __init__(
        self,
        book: StructureBook,
        watch: StructureWatch,
        brush: Brush,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._book, self._brush = book, brush
        self.open, self.save = QPushButton(tr("Open…")), QPushButton(tr("Save…"))
        self.remove = QPushButton(tr("Delete"))
        self.table = StructureTable(book, watch, self)
        self.note = PlainLabel(self)
        self.note.setWordWrap(True)
        self.note.setProperty("role", "dim")
        self.live = PlainLabel(self)
        self.live.setWordWrap(True)
        self.modes = {mode: QPushButton(text) for mode, text in _mode_names().items()}
        self.radius = spin_box(1.0, 40.0, 6.0, tr(" mm"), 0.5)
        self.low = spin_box(-1024.0, 3071.0, -50.0, tr(" HU"), 10.0)
        self.high = spin_box(-1024.0, 3071.0, 250.0, tr(" HU"), 10.0)
        self.limited = QCheckBox(tr("Paint only these values"))
        self.threshold = QPushButton(tr("All of these values in the body"))
        self._lay_out()
        self._connect()
        self.refresh()

    # --- shown --------------------------------------------------------------------------------
    def refresh(self) -> None:
        """Show the book's present state."""
        book, structures = self._book, self._book.structures
        self.table.refresh()
        self.save.setEnabled(len(structures) > 0)
        self.remove.setEnabled(book.selected is not None and not book.locked)
        for widget in (self.open, self.threshold, *self.modes.values()):
            widget.setEnabled(book.volume is not None and not book.locked)
        hint = tr(
            "No structures. Open a DICOM SEG, RTSTRUCT, .seg.nrrd or NIfTI label file, or "
            "mark one with the brush."
        )
        if not len(structures):
            self.note.setText(hint)
        elif self.note.text() == hint:
            self.note.setText("")

    def set_note(self, text: str) -> None:
        """Say what happened to what was read or written last."""
        self.note.setText(NAMES.without_names(text))

    def show_needle(self, clearance: PathClearance | None, text: str) -> None:
        """Show what the live needle is too near to."""
        nearness = clearance.nearness if clearance is not None else Nearness.FREE
        colour, sign = NEARNESS_STYLES[nearness]
        self.live.setText(f"{sign}  {text}" if text else "")
        self.live.setStyleSheet(f"color: {colour}; font-weight: 600;")

    # --- wanted -------------------------------------------------------------------------------
    def _mode_wanted(self, mode: Mode, on: bool) -> None:
        self._brush.set(mode=mode if on else Mode.OFF)

    def _show_mode(self) -> None:
        for mode, button in self.modes.items():
            button.setChecked(self._brush.settings.mode is mode)

    def _connect(self) -> None:
        book, brush = self._book, self._brush
        book.changed.connect(self.refresh)
        brush.changed.connect(self._show_mode)
        self.open.clicked.connect(self.import_wanted)
        self.save.clicked.connect(self.export_wanted)
        self.remove.clicked.connect(lambda: book.remove(book.chosen))
        self.threshold.clicked.connect(self.threshold_wanted)
        for mode, button in self.modes.items():
            button.clicked.connect(lambda on, m=mode: self._mode_wanted(m, on))
        self.radius.valueChanged.connect(lambda value: brush.set(radius_mm=value))
        self.low.valueChanged.connect(lambda value: brush.set(low=value))
        self.high.valueChanged.connect(lambda value: brush.set(high=value))
        self.limited.toggled.connect(lambda on: brush.set(limited=on))

    # --- layout -------------------------------------------------------------------------------
    def _lay_out(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        column.setSpacing(theme.SPACING)
        column.addWidget(_heading(tr("Structures")))
        column.addLayout(_row(self.open, self.save, self.remove))
        column.addWidget(self.table, 1)
        column.addWidget(self.live)
        column.addWidget(self.note)
        column.addWidget(_heading(tr("Mark the chosen one, or a new one")))
        column.addLayout(_row(*self.modes.values()))
        grid = QGridLayout()
        for row, (text, widget) in enumerate(
            (
                (tr("Radius"), self.radius),
                (tr("From"), self.low),
                (tr("To"), self.high),
            )
        ):
            widget.setAccessibleName(text)
            grid.addWidget(PlainLabel(text), row, 0)
            grid.addWidget(widget, row, 1)
        grid.addWidget(self.limited, 3, 0, 1, 2)
        grid.addWidget(self.threshold, 4, 0, 1, 2)
        column.addLayout(grid)


def _mode_names() -> dict[Mode, str]:
    return {Mode.PAINT: tr("● Paint"), Mode.ERASE: tr("○ Erase"), Mode.GROW: tr("✱ Grow")}


def _row(*widgets: QWidget) -> QHBoxLayout:
    row = QHBoxLayout()
    row.setSpacing(4)
    for widget in widgets:
        widget.setStyleSheet("padding: 4px 5px;")
        widget.setMinimumWidth(44)
        if isinstance(widget, QPushButton) and widget.text()[:1] in "●○✱":
            widget.setCheckable(True)
        row.addWidget(widget)
    return row


def _heading(text: str) -> QLabel:
    label = PlainLabel(text)
    label.setProperty("role", "heading")
    return label
