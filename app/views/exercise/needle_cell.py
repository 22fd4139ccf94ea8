"""The cell that tells of the needle: the bull's-eye, or where scans guide, the last scan."""

from PySide6.QtWidgets import QHBoxLayout, QWidget

from app.views.exercise.bullseye import Bullseye
from app.views.exercise.scan_view import ScanView


class NeedleCell(QWidget):
    """Holds both; the bull's-eye stays beside the scan where it moves a simulated hand."""

    def __init__(self, bullseye: Bullseye, scan: ScanView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._bullseye, self._scan = bullseye, scan
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(scan, 2)
        row.addWidget(bullseye, 1)
        self.set_scanning(False)

    def set_scanning(self, scanning: bool, has_hand: bool = True) -> None:
        """Show the scan, and with it the bull's-eye only if it moves a hand."""
        self._scan.setVisible(scanning)
        self._bullseye.setVisible(not scanning or has_hand)
