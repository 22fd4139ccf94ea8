"""Control scans: ordered in the scanner's panel, shown as one large slice and all small."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QIcon, QImage, QPixmap, QResizeEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QDoubleSpinBox,
    QGridLayout,
    QHBoxLayout,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QStackedLayout,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.core.arrays import FloatArray
from app.exercises.guidance import GuidancePart, ScanChoice
from app.imaging.scan_order import FEWEST, MOST, ScanOrder, Seen
from app.imaging.volume import Volume
from app.imaging.window import to_grey
from app.planning.plan import Plan
from app.session.control_scan import TEACHING_ESTIMATE, ControlScan
from app.views.exercise.readouts import clock_text
from app.views.exercise.scan_choices import ScanChoices
from app.views.exercise.scan_wall import ScanPicture, ScanWall
from app.views.kit import theme
from app.views.kit.coordinates import axis_words
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr, translated
from app.views.slices.pane import SlicePane
from app.views.slices.panes import PaneId
from app.views.slices.viewing import Viewing

FARTHEST_MM = 1e5


class ScanPanel(QWidget):
    """Sets the next control scan; hidden where the needle is shown live.

    Signals:
        order_changed(): another range.
        crosshair_wanted(): the table shall go to the crosshair's slice.
    """

    order_changed = Signal()
    crosshair_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._guidance = GuidancePart()
        self._plan: Plan | None = None
        self._dose, self._hand, self._pivot = 0.0, 0.0, 0.0
        self.choices = ScanChoices(self)
        self.table, self.slices = QDoubleSpinBox(self), QSpinBox(self)
        self.feet, self.head = self._step("−", -1), self._step("+", 1)
        self.here = QToolButton(self)
        self.range, self.count = PlainLabel(self), PlainLabel(self)
        self.progress = QProgressBar(self)
        self._prepare()
        self._lay_out()
        self.hide()

    # --- what the panel around it calls -----------------------------------------------------------
    def set_guidance(self, guidance: GuidancePart | None, plan: Plan | None) -> None:
        """Propose what the exercise does; the table stays where it is for the plan it knows."""
        self.setVisible(guidance is not None)
        if guidance is None or plan is None:
            return
        if plan == self._plan and guidance == self._guidance:
            return
        self._guidance, self._plan = guidance, plan
        self.choices.set_guidance(guidance)
        middle = 0.5 * float(plan.entry_mm[2] + plan.target_mm[2])
        with QSignalBlocker(self.table), QSignalBlocker(self.slices):
            self.table.setValue(round(middle))
            self.table.setSingleStep(guidance.order(0.0).step_mm)
            self.slices.setValue(guidance.slices)
        self._show_order()

    @property
    def order(self) -> ScanOrder:
        """The scan that the pedal takes."""
        like = self._guidance.order(self.table.value(), self._pivot)
        return replace(like, slices=self.slices.value(), tilt_deg=self.choices.tilt_deg)

    @property
    def choice(self) -> ScanChoice:
        """Return what is chosen for it beside its slices."""
        return self.choices.choice

    def go_to(self, place_mm: FloatArray) -> None:
        """Move the table so that the middle slice passes through a place, LPS [mm], shape (3,)."""
        lean = np.tan(np.radians(self.choices.tilt_deg))
        self.table.setValue(float(place_mm[2] + lean * (place_mm[1] - self._pivot)))

    def set_isocentre(self, place_mm: FloatArray) -> None:
        """Say where on the patient the gantry's axis lies, LPS [mm], shape (3,)."""
        self._pivot = float(place_mm[1])

    def begin(self) -> None:
        """Begin to count anew."""
        self._dose, self._hand = 0.0, 0.0
        self._show_count(0)

    def forget(self) -> None:
        """Count anew, the table where no patient has put it."""
        self.begin()
        self._plan = None
        with QSignalBlocker(self.table):
            self.table.setValue(0.0)
        self._show_order()

    def add(self, scan: ControlScan) -> None:
        """Count a scan that was taken."""
        self._dose += scan.dose
        self._hand += scan.hand_usv or 0.0
        self._show_count(scan.number)

    def set_busy(self, busy: bool) -> None:
        """Say that the slices are being made."""
        self.progress.setRange(0, 0 if busy else 1)
        self.progress.setValue(0)
        self.progress.setVisible(busy)
        self.progress.setFormat(tr("scanning…") if busy else "")

    # --- inside -----------------------------------------------------------------------------------
    def _show_order(self) -> None:
        low, high = self.order.range_mm
        self.range.setText(tr("{low} to {high}", low=axis_words(2, low), high=axis_words(2, high)))
        self.order_changed.emit()

    def _show_count(self, number: int) -> None:
        if self._guidance.hand_dose(ScanChoice()) is None:
            told = tr(
                "Scans: {n} · {dose:.1f} mGy·cm ({estimate})",
                n=number,
                dose=self._dose,
                estimate=tr(TEACHING_ESTIMATE),
            )
        else:
            told = tr(
                "Scans: {n} · {dose:.1f} mGy·cm · hand {hand:.0f} µSv ({estimate})",
                n=number,
                dose=self._dose,
                hand=self._hand,
                estimate=tr(TEACHING_ESTIMATE),
            )
        self.count.setText(told)

    def _step(self, text: str, way: int) -> QToolButton:
        button = QToolButton(self)
        button.setText(text)
        button.setAutoRepeat(True)
        button.setFixedSize(theme.CONTROL_HEIGHT, theme.CONTROL_HEIGHT)
        button.clicked.connect(lambda: self._move_table(way))
        return button

    def _move_table(self, slices: int) -> None:
        self.table.stepBy(slices)
        self.table.lineEdit().deselect()  # a step selects the number, as if it were to be typed

    def _prepare(self) -> None:
        self.table.setRange(-FARTHEST_MM, FARTHEST_MM)
        self.table.setDecimals(1)
        self.table.setMinimumWidth(theme.px(84))  # its range would ask for more than any patient
        self.table.setSuffix(tr(" mm"))
        self.table.setButtonSymbols(QDoubleSpinBox.ButtonSymbols.NoButtons)
        self.table.setToolTip(tr("Middle of the scan along the patient (z of LPS): + is headwards"))
        self.table.setAccessibleName(tr("Table position"))
        self.feet.setToolTip(tr("One slice towards the feet"))
        self.head.setToolTip(tr("One slice towards the head"))
        self.here.setText(tr("At crosshair"))
        self.here.setToolTip(tr("Move the table to the axial slice that is shown"))
        self.slices.setRange(FEWEST, MOST)
        self.slices.setAccessibleName(tr("Slices"))
        self.count.setToolTip(
            tr(
                "Dose-length product as the exercise sets it: a teaching estimate, no dose of any "
                "scanner"
            )
        )
        self.progress.setTextVisible(True)
        self.progress.setFixedHeight(14)
        kept = self.progress.sizePolicy()
        kept.setRetainSizeWhenHidden(True)  # nothing below it jumps
        self.progress.setSizePolicy(kept)
        for widget in (self.table, self.slices):
            widget.setFocusPolicy(Qt.FocusPolicy.StrongFocus)  # no wheel by chance
        for button in (self.feet, self.head, self.here):
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.table.valueChanged.connect(lambda _: self._show_order())
        self.slices.valueChanged.connect(lambda _: self._show_order())
        self.choices.changed.connect(self._show_order)
        self.here.clicked.connect(self.crosshair_wanted)
        self.set_busy(False)
        self._show_count(0)

    def set_narrow(self, narrow: bool) -> None:
        """Suit a rail, or a panel of the usual width."""
        grid = self._grid
        grid.removeItem(self._table_row)
        self._table_row.setParent(None)
        grid.addLayout(self._table_row, *((2, 0, 1, 3) if narrow else (1, 1, 1, 1)))
        grid.addWidget(self.here, *((1, 1, 1, 2) if narrow else (1, 2, 1, 1)))
        for label in (self.range, self.count):
            label.setWordWrap(narrow)

    def _lay_out(self) -> None:
        self._table_row = table = QHBoxLayout()
        table.setSpacing(4)
        for widget, stretch in ((self.feet, 0), (self.table, 1), (self.head, 0)):
            table.addWidget(widget, stretch)
        self._grid = grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(4)
        title = PlainLabel(tr("Control scan"), self)
        title.setProperty("role", "heading")
        grid.addWidget(title, 0, 0, 1, 3)
        grid.addWidget(PlainLabel(tr("Table"), self), 1, 0)
        grid.addWidget(PlainLabel(tr("Slices"), self), 3, 0)
        grid.addWidget(self.slices, 3, 1, 1, 2)
        grid.addWidget(self.range, 4, 0, 1, 3)
        grid.addWidget(self.choices, 5, 0, 1, 3)
        grid.addWidget(self.count, 6, 0, 1, 3)
        grid.addWidget(self.progress, 7, 0, 1, 3)
        grid.setColumnStretch(1, 1)
        grid.addLayout(table, 1, 1)
        self.set_narrow(False)


THUMB_PX, LEAST_THUMB_PX = 76, 28
"""Width of a small slice where there is room, and the least."""

WORDS_PX = 30
"""Height that a small slice needs beside its picture."""


class ScanView(QWidget):
    """Shows a scan until the next one: all slices side by side, or one as every slice is shown.

    Signals:
        arrived(): a new scan is shown.

    Attributes:
        wall: the slices side by side, the scan before them below.
        pane: one slice alone; scrolling, zoom, window and read-outs as everywhere.
    """

    arrived = Signal()

    def __init__(self, planning: Viewing, parent: QWidget | None = None) -> None:
        """Make an empty view; its window follows that of the `planning` CT, and leads it."""
        super().__init__(parent)
        self.viewing = Viewing(planning.window, self)
        self.pane = SlicePane(self.viewing, PaneId.AXIAL, self)
        self.pane.canvas.layers.crosshair.ends_only = True  # a line would lie on the needle
        self.scan: ControlScan | None = None
        self._planning = planning
        self._caption, self._nothing = PlainLabel(self), PlainLabel(self)
        self.wall = ScanWall(self)
        self.wall.slice_wanted.connect(self._show_alone)
        self._all = QPushButton(tr("All slices"))
        self._all.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._all.clicked.connect(self.show_all)
        self._strip = QVBoxLayout()
        self._thumbs = QButtonGroup(self)
        self._thumbs.idClicked.connect(self._go_to)
        self._lay_out()
        planning.window_changed.connect(lambda: self.viewing.set_window(planning.window))
        planning.cursor_changed.connect(self._follow_crosshair)
        self.viewing.window_changed.connect(lambda: planning.set_window(self.viewing.window))
        self.viewing.window_changed.connect(self._draw_thumbs)
        self.viewing.window_changed.connect(lambda: self.wall.set_window(self.viewing.window))
        self.viewing.cursor_changed.connect(self._check_thumb)
        self.clear()

    def clear(self) -> None:
        """Show that there is no scan yet; nothing of the last one is kept."""
        self.scan = None
        self.wall.clear()
        self._caption.clear()
        self._drop_thumbs()
        self._stack.setCurrentIndex(0)

    def show_scan(self, picture: Volume, scan: ControlScan, shown: float) -> None:
        """Show a scan's slices, the middle one large.

        Args:
            picture: of `imaging.scanned`.
            scan: what was ordered.
            shown: on the student's clock as it was taken [s].
        """
        self.scan = scan
        self.viewing.set_volume(picture)
        self._caption.setText(caption(scan, shown))
        self._make_thumbs(picture)
        self._follow_crosshair()
        self._go_to(picture.size[2] // 2)
        self.wall.set_window(self.viewing.window)
        self.wall.look_at(self._planning.draft)
        self.wall.add(ScanPicture(picture, caption(scan, shown), scan.order), _nearest_tip(scan))
        self.show_all()
        self.pane.canvas.fit()
        self.arrived.emit()

    def show_all(self) -> None:
        """Show all slices side by side, if there is a scan."""
        if self.scan is not None:
            self._stack.setCurrentWidget(self.wall)

    def _show_alone(self, number: int) -> None:
        self._go_to(number)
        self._stack.setCurrentWidget(self._page)

    # --- inside -----------------------------------------------------------------------------------
    def _go_to(self, number: int) -> None:
        self.viewing.show_slice(PaneId.AXIAL, float(number))

    def _follow_crosshair(self) -> None:
        """Stand at the planning CT's crosshair across, and in the scan's own slice."""
        if self.viewing.volume is not None:
            x, y, _ = self._planning.cursor_mm
            self.viewing.set_cursor((x, y, self.viewing.cursor_mm[2]))

    def _drop_thumbs(self) -> None:
        for button in self._thumbs.buttons():
            self._thumbs.removeButton(button)
            self._strip.removeWidget(button)
            button.setParent(None)
            button.deleteLater()

    def _make_thumbs(self, picture: Volume) -> None:
        self._drop_thumbs()
        if self.scan is None:
            return
        for number in reversed(range(picture.size[2])):  # the head is up
            button = QToolButton(self)
            button.setCheckable(True)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextUnderIcon)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.setText(axis_words(2, float(self.scan.order.middles_mm[number])))
            button.setStyleSheet(f"font-size: {theme.SMALL_PX}px; padding: 1px;")
            self._thumbs.addButton(button, number)
            self._strip.insertWidget(self._strip.count() - 1, button)
        self._draw_thumbs()
        self._size_thumbs()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Let all small slices fit beside the large one, with their places below them."""
        super().resizeEvent(event)
        self._size_thumbs()

    def _size_thumbs(self) -> None:
        buttons = self._thumbs.buttons()
        room = (self.height() - 2 * WORDS_PX) // max(1, len(buttons)) - WORDS_PX
        side = min(THUMB_PX, max(LEAST_THUMB_PX, room))
        for button in buttons:
            button.setIconSize(QSize(side, side))

    def _draw_thumbs(self) -> None:
        volume = self.viewing.volume
        if volume is None:
            return
        for number, hu in enumerate(volume.hu):
            grey = np.ascontiguousarray(to_grey(hu, self.viewing.window))
            rows, columns = grey.shape
            borrowed = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
            picture = QPixmap.fromImage(borrowed.copy()).scaled(
                THUMB_PX,
                THUMB_PX,
                Qt.AspectRatioMode.KeepAspectRatio,
                Qt.TransformationMode.SmoothTransformation,
            )
            button = self._thumbs.button(number)
            if button is not None:
                button.setIcon(QIcon(picture))

    def _check_thumb(self) -> None:
        button = self._thumbs.button(round(self.viewing.index(PaneId.AXIAL)))
        if button is not None:
            button.setChecked(True)

    def _lay_out(self) -> None:
        self._nothing.setText(
            tr("No control scan yet.\nSet table and slices, then press the pedal (S).")
        )
        self._nothing.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._nothing.setWordWrap(True)
        self._nothing.setProperty("role", "dim")
        self._caption.setStyleSheet(f"font-size: {theme.SMALL_PX}px; color: {theme.TEXT};")
        self._caption.setWordWrap(True)
        self._strip.setContentsMargins(2, 0, 2, 0)
        self._strip.setSpacing(2)
        self._strip.addStretch(1)
        row = QHBoxLayout()
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.pane, 1)
        row.addLayout(self._strip)
        self._page = page = QWidget(self)
        column = QVBoxLayout(page)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addLayout(row, 1)
        below = QHBoxLayout()
        below.addWidget(self._caption, 1)
        below.addWidget(self._all)
        column.addLayout(below)
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self._nothing)
        self._stack.addWidget(page)
        self._stack.addWidget(self.wall)


def _nearest_tip(scan: ControlScan) -> int | None:
    """Return the number of the slice nearest to a tip that the scan shows; None for no tip."""
    if scan.seen not in (Seen.TIP, Seen.BETWEEN):
        return None
    tip = float(scan.needle.seen_from(scan.order).tip_mm[2])
    return int(np.argmin(np.abs(scan.order.middles_mm - tip)))


def caption(scan: ControlScan, shown: float) -> str:
    """Say which scan it is; what it shows of the needle is for the eyes."""
    order = scan.order
    told = tr(
        "Control scan {n} at {time} · {slices} × {mm:g} mm · {dose:.1f} mGy·cm",
        n=scan.number,
        time=clock_text(shown),
        slices=order.slices,
        mm=order.slice_mm,
        dose=scan.dose,
    )
    chosen = translated(scan.chosen)
    if scan.hand_usv is None or scan.choice.leaves:  # else the dose of the hand is said to be one
        told += f" ({tr(TEACHING_ESTIMATE)})"
    return f"{told} · {chosen}" if chosen else told
