"""The cell that tells of the needle: bull's-eye or last scan, and the force along the needle."""

from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from app.views.exercise.axial_gauge import AxialGauge
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.scan_view import ScanView


class NeedleCell(QWidget):
    """Holds all three; the bull's-eye stays where it moves a simulated hand, whatever it shows.

    Attributes:
        gauge: of the force along the needle, above the rest.
    """

    def __init__(self, bullseye: Bullseye, scan: ScanView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._bullseye, self._scan = bullseye, scan
        self.gauge = AxialGauge(self)
        row = QHBoxLayout()
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(scan, 2)
        row.addWidget(bullseye, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.gauge)
        column.addLayout(row, 1)
        self.gauge.hide()
        self.set_shown(scanning=False)

    def set_shown(
        self, scanning: bool, has_hand: bool = True, pad: bool = True, gauge: bool = False
    ) -> None:
        """Show what the exercise shows.

        Args:
            scanning: the control scan.
            has_hand: whether the bull's-eye moves a simulated hand: then it is there, if empty.
            pad: the bull's-eye.
            gauge: the force along the needle.
        """
        self._scan.setVisible(scanning)
        self._bullseye.setVisible((pad and not scanning) or has_hand)
        self.gauge.setVisible(gauge)
