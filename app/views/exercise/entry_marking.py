"""Marking the entry on the skin: table position, grid line, and what the needle's angles are.

The grid's lines stand on the planning CT as numbered dots, the laser as a line at the table
position. What is marked becomes the entry: the patient is placed so that it lies on the fulcrum.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QLineF, QObject, QPointF, QSignalBlocker, Qt, Signal, SignalInstance
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QPushButton, QWidget

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.exercises.schema import Exercise
from app.imaging.scan_order import ScanOrder, middle_of
from app.imaging.skin_grid import GridPlace, GridSpec, SkinGrid
from app.planning.entry_mark import (
    EntryMark,
    NeedleAngles,
    bore_room_mm,
    direction_of,
    needle_angles,
)
from app.planning.patient import Patient
from app.planning.plan import Plan
from app.views.exercise.scan_view import FARTHEST_MM
from app.views.kit.form import Form
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr, translated
from app.views.plan.editor import PlanEditor
from app.views.scene.guides import LASER, WIRE
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.pane import SlicePane
from app.views.slices.plane import SlicePlane
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool

DOT_MM = 1.0
NUMBER_PX = QPointF(-4.0, -7.0)
APART_PX = 20.0
"""Numbers nearer to each other than this would run into one; each that fits is written."""

SAME_MM = 1.5
"""An entry so near to the marked one is it: a mark is moved onto the skin next to it."""


class EntryMarkPanel(Form):
    """Table, line and offset of the entry; hidden where the exercise has no grid.

    Signals:
        moved(): another place is set.
        wanted(): the place shall be the entry.
        dialled(): the needle shall point as the angles say.
    """

    moved = Signal()
    wanted = Signal()
    dialled = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent=parent, spacing=4)
        heading = PlainLabel(tr("Entry on the skin"), self)
        heading.setProperty("role", "heading")
        self.wide(heading)
        self._add_place()
        self._add_angles()
        self.set_locked(False)
        self.hide()

    def set_spec(self, spec: GridSpec | None) -> None:
        """Offer the lines of a grid, or nothing."""
        self.setVisible(spec is not None)
        if spec is None:
            return
        with QSignalBlocker(self.line), QSignalBlocker(self.table), QSignalBlocker(self.offset):
            self.line.setRange(1, spec.lines)
            self.line.setValue((spec.lines + 1) // 2)
            self.table.setValue(round(spec.centre_mm[2]))
            self.offset.setRange(-spec.spacing_mm, spec.spacing_mm)
            self.offset.setValue(0.0)

    def set_locked(self, locked: bool) -> None:
        """Offer the mark before an attempt, the needle's angles in it; what is said stays."""
        for name in ("table", "line", "offset"):
            self.show_row(not locked, name)
        for name in ("plane", "head"):
            self.show_row(locked, name)
        self.mark.setVisible(not locked)
        self.dial.setVisible(locked)

    @property
    def angles(self) -> NeedleAngles:
        """Return the angles that are dialled."""
        return NeedleAngles(self.plane.value(), self.head.value())

    def set_dials(self, dials: bool) -> None:
        """Say whether there is a simulated needle to be pointed now."""
        self.dial.setEnabled(dials)

    @property
    def place(self) -> GridPlace:
        """Return the place that is set."""
        return GridPlace(self.table.value(), self.line.value(), self.offset.value())

    def _add_place(self) -> None:
        far = (-FARTHEST_MM, FARTHEST_MM, 0.0)
        self.table = self.number("table", title=tr("Table"), unit="mm", within=far, decimals=1)
        self.table.setToolTip(tr("Table position at which the laser meets the entry (z)"))
        self.line = self.count("line", title=tr("Grid line"), within=(0, 99, 0))
        self.line.setToolTip(tr("From the patient's right; each fifth is thick"))
        within = (0.0, 99.0, 0.0)
        self.offset = self.number(
            "offset", title=tr("Beside it"), unit="mm", within=within, decimals=1
        )
        self.offset.setToolTip(tr("Along the skin, + towards the next number"))
        for widget in (self.table, self.line, self.offset):
            widget.valueChanged.connect(lambda _: self.moved.emit())
        self.mark = self._button(tr("Mark the entry"), self.wanted)
        self.mark.setToolTip(
            tr(
                "Makes this place the entry: the patient is placed so that it lies on the fulcrum; "
                "how far it is from the entry that you planned is scored"
            )
        )
        self.words = PlainLabel(self)
        self.words.setWordWrap(True)
        self.wide(self.words)

    def _add_angles(self) -> None:
        title, within = tr("In the slice"), (-80.0, 80.0, 0.0)
        self.plane = self.number("plane", title=title, unit="°", within=within, decimals=1)
        self.plane.setToolTip(tr("From straight down, + towards higher numbers"))
        title = tr("Out of it")
        self.head = self.number("head", title=title, unit="°", within=within, decimals=1)
        self.head.setToolTip(tr("Cranio-caudal: + towards the head"))
        self.dial = self._button(tr("Point the needle"), self.dialled)
        self.dial.setToolTip(
            tr(
                "Lets the simulated hand point the needle by these two angles, as by a protractor; "
                "a needle in your own hand you turn yourself"
            )
        )
        for field in self.fields.values():
            field.setFocusPolicy(Qt.FocusPolicy.StrongFocus)  # no wheel by chance

    def _button(self, text: str, wanted: SignalInstance) -> QPushButton:
        button = QPushButton(text, self)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        button.clicked.connect(wanted)
        self.wide(button)
        return button


class EntryMarking(QObject):
    """Connects the panel, the plan that is edited, and what the panes show of grid and laser.

    Signals:
        failed(object): why a place cannot be marked.
        shown(object, object): the grid that is shown and the laser's table position [mm]; None for
            none.

    Attributes:
        mark: of the entry that stands; None while none is marked.
    """

    failed = Signal(object)
    shown = Signal(object, object)

    def __init__(
        self,
        panel: EntryMarkPanel,
        editor: PlanEditor,
        panes: tuple[SlicePane, ...],
        patient: Callable[[], Patient | None],
        exercise: Callable[[], Exercise | None],
        tilt_deg: Callable[[], float],
        parent: QObject,
    ) -> None:
        super().__init__(parent)
        self._panel, self._editor, self._panes = panel, editor, panes
        self._patient, self._exercise, self._tilt_deg = patient, exercise, tilt_deg
        self.mark: EntryMark | None = None
        self._grid: SkinGrid | None = None
        self._planned: Plan | None = None
        self._needle_mm = 150.0
        self.layers = tuple(_GridLayer(pane.canvas.drawing) for pane in panes)
        for pane, layer in zip(panes, self.layers, strict=True):
            pane.canvas.add_layer(layer)
        panel.moved.connect(self._show)
        panel.wanted.connect(self._mark)
        editor.changed.connect(self.look)

    def set_needle(self, length_mm: float) -> None:
        """Say how long the needle is that stands on the skin [mm]."""
        self._needle_mm = length_mm

    def show_words(self) -> None:
        """Say the angles anew: the gantry is tilted otherwise."""
        self._show()

    def direction(self) -> FloatArray | None:
        """Return the direction that is dialled, LPS, unit, shape (3,); None without a grid."""
        if self._grid is None:
            return None
        return direction_of(self._panel.angles, self._grid.spec.up, self._tilt_deg())

    def look(self) -> None:
        """Look at what is planned: an entry that was not marked is the planned one."""
        spec = self._spec()
        self._panel.set_locked(self._editor.locked)
        known = None if self._grid is None else self._grid.spec
        if spec != known:
            patient = self._patient()
            self._grid = None
            if spec is not None and patient is not None:
                self._grid = SkinGrid(patient.body, spec)
            self.mark = self._planned = None
            self._panel.set_spec(spec)
        draft = self._editor.edit.draft
        if self._grid is not None and draft.complete and not self._is_marked(draft.plan()):
            self._planned, self.mark = draft.plan(), None
        self._show()

    def _is_marked(self, plan: Plan) -> bool:
        mark = self.mark
        return mark is not None and bool(np.linalg.norm(plan.entry_mm - mark.marked_mm) <= SAME_MM)

    def _spec(self) -> GridSpec | None:
        exercise, edit = self._exercise(), self._editor.edit
        if exercise is None or exercise.procedure is None or exercise.procedure.grid is None:
            return None
        if edit.draft.target_mm is None or self._patient() is None:
            return None
        return exercise.procedure.grid.spec(np.asarray(edit.draft.target_mm), edit.placement)

    def _mark(self) -> None:
        grid, planned = self._grid, self._planned
        if grid is None:
            return
        if planned is None:
            self.failed.emit(tr("Plan the entry on the CT first: the mark is compared with it"))
            return
        try:
            self.mark = EntryMark.of(grid, self._panel.place, planned)
        except AcusError as error:
            self.failed.emit(translated(error))
            return
        self._editor.place(Tool.ENTRY, as_point(self.mark.marked_mm), True)
        self._show()

    def _show(self) -> None:
        grid = self._grid
        table = None if grid is None else float(self._panel.table.value())
        for pane, layer in zip(self._panes, self.layers, strict=True):
            layer.set_grid(grid, table)
            pane.canvas.refresh()
        self.shown.emit(grid, table)
        self._panel.words.setText("" if grid is None else self._words())

    def _words(self) -> str:
        """Say the angles of the path from the entry, the room in the bore, and what was marked."""
        draft, patient = self._editor.edit.draft, self._patient()
        if self._planned is None or self._grid is None or patient is None:
            return tr("Plan the entry on the CT first")
        plan = draft.plan() if draft.complete else self._planned
        tilt, middle = self._tilt_deg(), middle_of(patient.volume)
        angles = needle_angles(plan, self._grid.spec.up, tilt)
        order = ScanOrder(self._panel.table.value(), tilt_deg=tilt, pivot_mm=float(middle[1]))
        lines = [
            tr(
                "Needle: {plane:+.1f}° in the slice (+ towards higher numbers), {head:+.1f}° out "
                "of it (+ towards the head)",
                plane=round(angles.in_plane_deg, 1) + 0.0,  # no −0.0
                head=round(angles.cranio_caudal_deg, 1) + 0.0,
            ),
            tr(
                "Room between hub and bore: {mm:.0f} mm",
                mm=bore_room_mm(order, middle, plan, self._needle_mm),
            ),
        ]
        if self.mark is not None:
            lines.append(
                tr(
                    "Marked at table {table:.1f} mm, line {line} {offset:+.1f} mm",
                    table=self.mark.place.table_mm,
                    line=self.mark.place.line,
                    offset=self.mark.place.offset_mm,
                )
            )
        return "\n".join(lines)


class _GridLayer:
    """Dots where the grid's lines pass through an axial slice, and the laser's line in others."""

    def __init__(self, drawing: Drawing) -> None:
        self._grid: SkinGrid | None = None
        self._table: float | None = None
        self._item = _GridShape()
        drawing.add(self._item)

    def set_grid(self, grid: SkinGrid | None, table_mm: float | None) -> None:
        """Show this grid and laser from the next refresh on; None shows nothing."""
        self._grid, self._table = grid, table_mm

    @property
    def dots(self) -> tuple[tuple[QPointF, str], ...]:
        """Return what is drawn of the grid, in plane millimetres, with numbers."""
        return self._item.dots

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Draw them."""
        dots: list[tuple[QPointF, str]] = []
        if self._grid is not None and plane.normal_axis == 2:
            z = float(plane.lps_mm(0.0, 0.0, index)[2])
            low, high = self._grid.range_mm
            if low <= z <= high:
                dots = self._dots(self._grid, plane, index, z)
        self._item.set_dots(tuple(dots), self._on_table(plane, index))

    def _dots(
        self, grid: SkinGrid, plane: SlicePlane, index: float, z: float
    ) -> list[tuple[QPointF, str]]:
        made = []
        for line in range(1, grid.spec.lines + 1):
            try:
                at = plane.point(grid.point(GridPlace(z, line)), index)
            except AcusError:
                continue  # no skin under it here
            made.append((QPointF(at.x, at.y), str(line)))
        return made

    def _on_table(self, plane: SlicePlane, index: float) -> tuple[QPointF, QPointF] | None:
        if self._table is None or self._grid is None or plane.normal_axis == 2:
            return None
        width, _ = plane.extent_mm
        middle: FloatArray = plane.lps_mm(0.0, 0.0, index)
        at = plane.point((middle[0], middle[1], self._table), index)
        return QPointF(0.0, at.y), QPointF(width, at.y)

    def hide(self) -> None:
        """Show nothing."""
        self._item.set_dots((), None)


class _GridShape(Shape):
    def __init__(self) -> None:
        super().__init__(1.0)
        self.dots: tuple[tuple[QPointF, str], ...] = ()
        self.laser: tuple[QPointF, QPointF] | None = None

    def set_dots(
        self,
        dots: tuple[tuple[QPointF, str], ...],
        laser: tuple[QPointF, QPointF] | None,
    ) -> None:
        if (dots, laser) != (self.dots, self.laser):
            self.dots, self.laser = dots, laser
            self.touch()

    def paint(self, painter: QPainter) -> None:
        painter.setPen(WIRE.pen())
        for at, _ in self.dots:
            painter.drawEllipse(at, DOT_MM, DOT_MM)
        to_pixels = painter.transform()
        painter.save()
        painter.resetTransform()
        last: QPointF | None = None
        for at, number in self.dots:
            place = to_pixels.map(at)
            if last is None or QLineF(last, place).length() >= APART_PX:
                painter.drawText(place + NUMBER_PX, number)
                last = place
        painter.restore()
        if self.laser is not None:
            painter.setPen(LASER.pen())
            painter.drawLine(*self.laser)
