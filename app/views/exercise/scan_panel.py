"""The scanner's panel: where the table stands, which slices, how many scans so far, what dose."""

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QDoubleSpinBox,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QSpinBox,
    QToolButton,
    QWidget,
)

from app.exercises.guidance import GuidancePart
from app.imaging.scan_order import FEWEST, MOST, ScanOrder
from app.planning.plan import Plan
from app.session.control_scan import TEACHING_ESTIMATE, ControlScan
from app.views.kit import theme
from app.views.kit.coordinates import axis_words
from app.views.kit.text import tr

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
        self._dose = 0.0
        self.table, self.slices = QDoubleSpinBox(self), QSpinBox(self)
        self.feet, self.head = self._step("−", -1), self._step("+", 1)
        self.here = QToolButton(self)
        self.range, self.count = QLabel(self), QLabel(self)
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
        middle = 0.5 * float(plan.entry_mm[2] + plan.target_mm[2])
        with QSignalBlocker(self.table), QSignalBlocker(self.slices):
            self.table.setValue(round(middle))
            self.table.setSingleStep(guidance.slice_mm)
            self.slices.setValue(guidance.slices)
        self._show_order()

    @property
    def order(self) -> ScanOrder:
        """The scan that the pedal takes."""
        return ScanOrder(self.table.value(), self.slices.value(), self._guidance.slice_mm)

    def set_table(self, centre_mm: float) -> None:
        """Move the table so that this place along the patient is in the middle [mm]."""
        self.table.setValue(centre_mm)

    def begin(self) -> None:
        """Begin to count anew."""
        self._dose = 0.0
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
        self.count.setText(
            tr("Scans: {n} · {dose:.1f} mGy·cm ({estimate})", n=number, dose=self._dose,
               estimate=tr(TEACHING_ESTIMATE))
        )  # fmt: skip

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
            tr("Dose-length product as the exercise sets it: a teaching estimate, no dose of any "
               "scanner")
        )  # fmt: skip
        self.progress.setTextVisible(True)
        self.progress.setFixedHeight(14)
        kept = self.progress.sizePolicy()
        kept.setRetainSizeWhenHidden(True)  # nothing below it jumps
        self.progress.setSizePolicy(kept)
        for widget in (self.table, self.slices):
            widget.setFocusPolicy(Qt.FocusPolicy.ClickFocus)  # S stays the pedal
        for button in (self.feet, self.head, self.here):
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.table.valueChanged.connect(lambda _: self._show_order())
        self.slices.valueChanged.connect(lambda _: self._show_order())
        self.here.clicked.connect(self.crosshair_wanted)
        self.set_busy(False)
        self._show_count(0)

    def _lay_out(self) -> None:
        table = QHBoxLayout()
        table.setSpacing(4)
        for widget, stretch in ((self.feet, 0), (self.table, 1), (self.head, 0), (self.here, 0)):
            table.addWidget(widget, stretch)
        title = QLabel(tr("Control scan"), self)
        title.setProperty("role", "heading")
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(4)
        grid.addWidget(title, 0, 0, 1, 3)
        grid.addWidget(QLabel(tr("Table"), self), 1, 0)
        grid.addLayout(table, 1, 1, 1, 2)
        grid.addWidget(QLabel(tr("Slices"), self), 2, 0)
        grid.addWidget(self.slices, 2, 1)
        grid.addWidget(self.range, 2, 2)
        grid.addWidget(self.count, 3, 0, 1, 3)
        grid.addWidget(self.progress, 4, 0, 1, 3)
        grid.setColumnStretch(2, 1)
