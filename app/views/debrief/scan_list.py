"""The control scans of an attempt: when, which slices, what they showed, what they cost."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from app.imaging.scan_order import Seen
from app.session.control_scan import TEACHING_ESTIMATE, ControlScan
from app.session.review import Review
from app.views.exercise.readouts import clock_text
from app.views.kit import theme
from app.views.kit.coordinates import axis_words
from app.views.kit.text import tr

_ROW_HEIGHT = 24
_COLUMNS = 5


class ScanList(QTableWidget):
    """One row for each scan; hidden where the attempt has none with slices.

    Signals:
        scan_wanted(ControlScan): a row was activated: its picture is asked for.
    """

    scan_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, _COLUMNS, parent)
        self._scans: tuple[ControlScan, ...] = ()
        estimate = tr(TEACHING_ESTIMATE).replace(" ", "\n")
        dosed = tr("mGy·cm\n{estimate}", estimate=estimate)
        titles = (tr("Scan"), tr("Time"), tr("Slices"), tr("Shows"), dosed)
        for column, title in enumerate(titles):
            self.setHorizontalHeaderItem(column, QTableWidgetItem(title))
        dose = self.horizontalHeaderItem(_COLUMNS - 1)
        if dose is not None:
            dose.setToolTip(tr(TEACHING_ESTIMATE))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setShowGrid(False)
        self.setAccessibleName(tr("Control scans"))
        self.setToolTip(tr("Enter or a double click shows its slices, if the CT is open"))
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        small = f"font-size: {theme.SMALL_PX}px;"  # all five columns fit beside the curves
        self.setStyleSheet(f"{small} QHeaderView::section {{ {small} padding: 3px 4px; }}")
        header = self.horizontalHeader()
        header.setMinimumSectionSize(24)
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(3, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)
        self.cellActivated.connect(lambda row, _: self.scan_wanted.emit(self._scans[row]))
        self.hide()

    def show_review(self, review: Review) -> None:
        """Fill the table."""
        self._scans = review.control_scans
        self.setRowCount(len(self._scans))
        self.setVisible(bool(self._scans))
        for row, scan in enumerate(self._scans):
            for column, text in enumerate(cells(scan, review.origin)):
                item = QTableWidgetItem(text)
                if column == _COLUMNS - 1:
                    item.setTextAlignment(
                        Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    )
                    item.setToolTip(tr(TEACHING_ESTIMATE))
                self.setItem(row, column, item)


def cells(scan: ControlScan, origin: float) -> tuple[str, ...]:
    """Words of one row."""
    low, high = scan.order.range_mm
    slices = tr(
        "{n} × {mm:g} mm, {low} to {high}", n=scan.order.slices, mm=scan.order.slice_mm,
        low=axis_words(2, low), high=axis_words(2, high),
    )  # fmt: skip
    shows = {
        Seen.TIP: tr("● tip"),
        Seen.SHAFT: tr("▲ shaft only"),
        Seen.NOTHING: tr("✖ no needle"),
    }
    time = clock_text(scan.time - origin)
    return str(scan.number), time, slices, shows[scan.seen], f"{scan.dose:.1f}"
