"""How a structure looks: colour of its own, hatching and dash of its kind, so that neither stands
alone.
"""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPen

from app.imaging.structures.structure import Kind, Structure
from app.planning.clearance import Nearness
from app.views.kit import theme
from app.views.kit.text import tr

HATCHES = {
    Kind.RISK: Qt.BrushStyle.DiagCrossPattern,
    Kind.VESSEL: Qt.BrushStyle.BDiagPattern,
    Kind.BONE: Qt.BrushStyle.Dense6Pattern,
    Kind.TARGET: Qt.BrushStyle.NoBrush,
    Kind.OTHER: Qt.BrushStyle.NoBrush,
}
DASHES: dict[Kind, tuple[float, ...]] = {Kind.OTHER: (2.0, 2.0), Kind.TARGET: (6.0, 3.0)}
SIGNS = {Kind.RISK: "▩", Kind.VESSEL: "▨", Kind.BONE: "▒", Kind.TARGET: "◎", Kind.OTHER: "□"}

LOOKS = {
    Nearness.FREE: (theme.TEXT, "✔"),
    Nearness.NEAR: (theme.WARNING, "▲"),
    Nearness.HIT: (theme.BAD, "✖"),
}
"""Colour and sign of a distance."""


def kind_names() -> dict[Kind, str]:
    """Names of the kinds for people."""
    return {
        Kind.RISK: tr("risk"), Kind.VESSEL: tr("vessel"), Kind.BONE: tr("bone"),
        Kind.TARGET: tr("target"), Kind.OTHER: tr("other"),
    }  # fmt: skip


def colour(structure: Structure, alpha: float = 1.0) -> QColor:
    """Return its colour as Qt's."""
    result = QColor(*structure.colour)
    result.setAlphaF(alpha)
    return result


def pen(structure: Structure, width: float = 2.0) -> QPen:
    """Return the pen of its outline, of the same width at every zoom."""
    result = QPen(colour(structure), width)
    result.setCosmetic(True)
    if structure.kind in DASHES:
        result.setDashPattern(list(DASHES[structure.kind]))
    return result


def named(structure: Structure) -> str:
    """Return its name with the sign of its kind."""
    return f"{SIGNS[structure.kind]} {structure.name}"
