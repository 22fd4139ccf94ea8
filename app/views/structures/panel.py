"""The panel of structures: what is drawn, of which kind, when it warns, how far the path is."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.planning.clearance import Clearance, Nearness
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.structures.book import StructureBook
from app.views.structures.brush import Brush, Mode
from app.views.structures.looks import LOOKS
from app.views.structures.table import StructureTable, spin_box
from app.views.structures.watch import StructureWatch


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
        self.note = QLabel(self)
        self.note.setWordWrap(True)
        self.note.setProperty("role", "dim")
        self.note.setTextFormat(Qt.TextFormat.PlainText)
        self.live = QLabel(self)
        self.live.setWordWrap(True)
        self.live.setTextFormat(Qt.TextFormat.PlainText)
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
        hint = tr("No structures. Open a DICOM SEG, RTSTRUCT, .seg.nrrd or NIfTI label file, or "
                  "mark one with the brush.")  # fmt: skip
        if not len(structures):
            self.note.setText(hint)
        elif self.note.text() == hint:
            self.note.setText("")

    def set_note(self, text: str) -> None:
        """Say what happened to what was read or written last."""
        self.note.setText(NAMES.without_names(text))

    def show_needle(self, clearance: Clearance | None, text: str) -> None:
        """Show what the live needle is too near to."""
        look, sign = LOOKS[clearance.nearness if clearance is not None else Nearness.FREE]
        self.live.setText(f"{sign}  {text}" if text else "")
        self.live.setStyleSheet(f"color: {look}; font-weight: 600;")

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
        for row, (text, widget) in enumerate((
            (tr("Radius"), self.radius), (tr("From"), self.low), (tr("To"), self.high),
        )):  # fmt: skip
            grid.addWidget(QLabel(text), row, 0)
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
    label = QLabel(text)
    label.setProperty("role", "heading")
    return label
