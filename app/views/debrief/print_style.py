"""Fonts and colours for paper: dark ink on white, symbols beside every colour."""

from typing import Final

from PySide6.QtGui import QFont

from app.scoring.tolerance import Band

INK: Final = "#111111"
DIM: Final = "#555555"
LINE: Final = "#0b5394"
RULE: Final = "#999999"
BAND_INKS: Final = {
    Band.EXPERT: "#1b6e43",
    Band.GOOD: "#1b6e43",
    Band.PASS: "#8a5a00",
    Band.FAIL: "#b3261e",
}


def font(points: float, bold: bool = False) -> QFont:
    """Font of a size in points of the page, without hinting: paper has no pixels."""
    result = QFont("DejaVu Sans")
    result.setStyleHint(QFont.StyleHint.SansSerif)
    result.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    result.setPointSizeF(points)
    result.setBold(bold)
    return result
