"""The table of a plate's fiducials: where each was touched and picked, and its residual."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from app.core.confidence import covariance_radius
from app.core.units import MILLIMETRE
from app.planning.registration.check import RegistrationCheck
from app.planning.registration.draft import CheckDraft
from app.planning.registration.record import points_of
from app.views.kit.text import tr

_STRETCHED = (1, 3)


class FiducialTable(QTableWidget):
    """One row per fiducial; the chosen row is the next to be touched or picked."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        titles = [
            tr("Fiducial"), tr("Tip: x  y  z [mm]"), tr("± 95 % [mm]"), tr("CT: L  P  S [mm]"),
            tr("Residual [mm]"),
        ]  # fmt: skip
        self.setColumnCount(len(titles))
        self.setHorizontalHeaderLabels(titles)
        self.verticalHeader().hide()
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        for column in _STRETCHED:
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)

    def show_points(
        self, names: tuple[str, ...], draft: CheckDraft, check: RegistrationCheck | None
    ) -> None:
        """Show what was found; the chosen row stays."""
        row = max(0, self.currentRow())
        self.setRowCount(len(names))
        for i, name in enumerate(names):
            for column, text in enumerate(_cells(draft, check, name)):
                item = QTableWidgetItem(text)
                if column:
                    right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    item.setTextAlignment(right)
                self.setItem(i, column, item)
        self.selectRow(min(row, self.rowCount() - 1))


def _cells(draft: CheckDraft, check: RegistrationCheck | None, name: str) -> tuple[str, ...]:
    touched = next((one for one in draft.touched if one.name == name), None)
    picked = next((one for one in draft.picked if one.name == name), None)
    radius = ""
    if touched is not None:
        spread = points_of((touched,)).covariances[0]
        radius = f"{covariance_radius(spread) / MILLIMETRE:.2f}" if spread.any() else "–"
    residual = ""
    if check is not None and name in check.world.names:
        row = check.world.fit.residuals[check.world.names.index(name)]
        residual = f"{float(np.linalg.norm(row)) / MILLIMETRE:.2f}"
    return (
        name,
        _coordinates(touched.point_mm) if touched is not None else "",
        radius,
        _coordinates(picked.point_mm) if picked is not None else "",
        residual,
    )


def _coordinates(point_mm: tuple[float, float, float]) -> str:
    return "  ".join(f"{value:.1f}" for value in point_mm)
