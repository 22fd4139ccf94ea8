"""The calibrations kept so far, as rows of a table."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QTableWidget, QTableWidgetItem

from app.core.errors import AcusError
from app.tracking.calibration.history import CalibrationHistory, Entry
from app.views.kit import theme
from app.views.kit.text import tr

Details = tuple[str, str, str]
"""Figures, place and problem of a calibration, in words."""


def show_entry(table: QTableWidget, row: int, entry: Entry, shown: Details) -> None:
    """Fill a row; the entry's id is the first cell's data."""
    figures, world, problem = shown
    colour, state = theme.TEXT_DIM, ""
    if entry.active:
        colour, state = theme.GOOD, tr("✔ in use")
    if problem:
        colour, state = theme.BAD, tr("✖ unreadable: {why}", why=problem)
    if entry.condemned is not None:
        colour, state = theme.BAD, tr("✖ found bad: {why}", why=entry.condemned.reason)
    for k, text in enumerate((entry.id, figures, world, state)):
        item = QTableWidgetItem(text)
        item.setToolTip(text)
        if k == 3:
            item.setForeground(QColor(colour))
        if k == 0:
            item.setData(Qt.ItemDataRole.UserRole, entry.id)
        table.setItem(row, k, item)


def details(history: CalibrationHistory, calibration_id: str) -> Details:
    """Read a calibration and say what it is."""
    try:
        calibration = history.load(calibration_id)
    except AcusError as error:
        return "", "", str(error)
    checked = calibration.validation
    figures = tr("{px:.2f} px", px=calibration.rms_px)
    if checked is not None:
        figures += tr(", {mm:.3f} mm held back", mm=checked.rms_mm)
    if not calibration.uncertainty_known:
        figures += tr(", own uncertainty not known")
    return figures, tr("placed") if calibration.world is not None else tr("no place"), ""
