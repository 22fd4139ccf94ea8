"""The panel's live read-outs: large numbers that do not move their neighbours."""

from math import degrees
from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QFontDatabase
from PySide6.QtWidgets import QGridLayout, QLabel, QWidget

from app.views.exercise.force_bar import ForceBar
from app.views.exercise.live import LiveFigures
from app.views.kit import theme
from app.views.kit.text import tr

_EMPTY = "–"

OFFSETS: Final = frozenset({"angle", "lateral", "to_target"})
"""Read-outs that say what the bull's-eye shows."""


class AttemptReadouts(QWidget):
    """Time, depth, angle, distances, scans and force."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._values: dict[str, QLabel] = {}
        self._titles: dict[str, QLabel] = {}
        self.force = ForceBar(self)
        self._telling: frozenset[str] | None = None
        self._offsets = self._forceful = True
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setVerticalSpacing(3)
        # The values take the free room: a text that grows is never cut, not even for one picture.
        self._grid.setColumnStretch(1, 1)
        for key, (name, help_text) in _rows().items():
            self._add(key, name, help_text)
        row = self._grid.rowCount()
        self._force_title = QLabel(tr("Force felt"), self)
        self._grid.addWidget(self._force_title, row, 0, 1, 2)
        self._grid.addWidget(self.force, row + 1, 0, 1, 2)

    def show_figures(self, figures: LiveFigures | None) -> None:
        """Show a moment; None empties the read-outs."""
        texts = dict.fromkeys(self._values, _EMPTY) if figures is None else _texts(figures)
        for key, text in texts.items():
            if self._values[key].text() != text:
                self._values[key].setText(text)
        if figures is None:
            self.force.show_force(0.0, 5.0)
        else:
            self.force.show_force(
                figures.force,
                figures.force_limit,
                figures.force_measured,
                figures.guidance,
                figures.force_at_most,
            )

    def set_telling(self, keys: frozenset[str] | None) -> None:
        """Leave only these read-outs, None for all with the force: the rest would tell too much."""
        self._telling = keys
        self._show_rows()
        self._show_force_bar()

    def set_offsets(self, shown: bool) -> None:
        """Say how far the needle is off the path, or not."""
        self._offsets = shown
        self._show_rows()

    def _show_rows(self) -> None:
        for key, value in self._values.items():
            told = self._telling is None or key in self._telling
            for label in (value, self._titles[key]):
                label.setVisible(told and (self._offsets or key not in OFFSETS))

    def set_forceful(self, forceful: bool) -> None:
        """Show the force felt, or not where nothing can push."""
        self._forceful = forceful
        self._show_force_bar()

    def _show_force_bar(self) -> None:
        for widget in (self._force_title, self.force):
            widget.setVisible(self._telling is None and self._forceful)

    def text(self, key: str) -> str:
        """Text of one read-out: `elapsed`, `depth`, `angle`, `lateral`, `to_target`, `scans`."""
        return self._values[key].text()

    def _add(self, key: str, name: str, help_text: str) -> None:
        row = self._grid.rowCount()
        title, value = QLabel(name, self), QLabel(_EMPTY, self)
        value.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        value.setStyleSheet(f"font-size: {theme.FONT_PX + 3}px; font-weight: 600;")
        value.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        for label in (title, value):
            label.setToolTip(help_text)
        self._grid.addWidget(title, row, 0)
        self._grid.addWidget(value, row, 1)
        self._values[key], self._titles[key] = value, title


def _rows() -> dict[str, tuple[str, str]]:
    return {
        "elapsed": (tr("Time"), tr("Since the start of the attempt")),
        "depth": (
            tr("Depth"),
            tr("Tip beyond the entry, along the needle; ◇ when it is not measured now"),
        ),
        "angle": (tr("Angle error"), tr("Between the needle and the planned path")),
        "lateral": (tr("Off the path"), tr("Tip from the line of the planned path")),
        "to_target": (tr("To target"), tr("Along the path; negative when the tip is too deep")),
        "radius": (
            tr("Tip known to"),
            tr("Radius round the tip that holds the true one with 95 %, as it is shown now"),
        ),
        "bending": (
            tr("Bending"),
            tr("Tip off the straight needle, by tissue or cameras; less than chance is shown as <"),
        ),
        "scans": (tr("Control scans"), tr("Scans taken in this attempt")),
    }


def _texts(figures: LiveFigures) -> dict[str, str]:
    if figures.hidden:
        said = {"elapsed": clock_text(figures.elapsed), "scans": str(figures.scans)}
        return dict.fromkeys(_rows(), _EMPTY) | said

    def measured_mm(value: float) -> str:  # a guess is never said as if it were known
        return tr("{mm:.1f} mm", mm=1e3 * value) if figures.measured else "– ◇"

    return {
        "elapsed": clock_text(figures.elapsed),
        "depth": measured_mm(figures.depth),
        "angle": tr("{deg:.1f}°", deg=degrees(figures.angle_error)),
        "lateral": measured_mm(figures.lateral),
        "to_target": measured_mm(figures.to_target),
        "radius": radius_text(figures.radius),
        "bending": bending_text(figures.deflection, figures.deflection_sigma),
        "scans": str(figures.scans),
    }


def radius_text(radius: float | None) -> str:
    """Radius that holds the true tip with 95 % [m]; a dash while the tip is not measured."""
    return _EMPTY if radius is None else tr("± {mm:.1f} mm", mm=1e3 * radius)


def bending_text(deflection: float | None, sigma: float) -> str:
    """Say how far the tip is off the straight needle [m]; below three sigma, the bound."""
    if deflection is None:
        return _EMPTY
    if deflection > 3.0 * sigma:
        return tr("{mm:.1f} mm", mm=1e3 * deflection)
    return tr("< {mm:.1f} mm", mm=3e3 * sigma)


def clock_text(seconds: float) -> str:
    """Seconds as minutes and seconds: `1:07`."""
    whole = int(max(0.0, seconds))
    return f"{whole // 60}:{whole % 60:02d}"
