"""The view `cameras`: both pictures with what was found in them, and how well they agree."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from app.core.messages import sentence
from app.views.exercise.camera_view import CameraView, Overlays
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, tr, translated
from app.views.kit.verdict import StatusItem

if TYPE_CHECKING:
    from app.tracking.inspection import Inspection

DECLARATION: Final[dict[str, Any]] = {
    "view": "cameras",
    "title": "Camera pictures",
    "reads": (),
}

REFRESH: Final = 1.0 / 15.0
"""Shortest time between two refreshes [s]."""


@dataclass(frozen=True, slots=True)
class TrackerFigures:
    """How the tracker is.

    Attributes:
        rate: stereo pairs per second.
        residual_px: distance from the epipolar geometry [px]; None without a fix.
        item: its line in the status strip.
        valid_share: share of valid fixes, 0…1.
        latency: from capture to fix [s].
        skew: capture of the second camera after the first [s]; None where nobody knows.
        instead: what stands in place of pictures where there are none; empty where there are.
    """

    rate: float
    residual_px: float | None
    item: StatusItem
    valid_share: float = 0.0
    latency: float = 0.0
    skew: float | None = None
    instead: str = ""


class TrackerPanel(QWidget):
    """Two pictures, one above the other, what is drawn over them, and the figures.

    Signals:
        colour_clicked(str, object): camera and pixel of a click on the marker, while its colour is
            being learned; the button is up again then.
    """

    colour_clicked = Signal(str, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.cameras = (CameraView(self), CameraView(self))
        self._verdict = PlainLabel(self)
        self._verdict.setWordWrap(True)
        self._figures = _Figures(self)
        self._buttons: dict[str, QToolButton] = {}
        self.learn = QToolButton(self)
        self._shown = -1e9
        self.off = ""
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.SPACING, theme.SPACING, theme.SPACING, theme.SPACING)
        column.setSpacing(4)
        for camera in self.cameras:
            camera.clicked.connect(self._clicked)
            column.addWidget(camera, 1)
        column.addLayout(self._switches())
        column.addWidget(self._verdict)
        column.addWidget(self._figures)

    def set_off(self, words: str) -> None:
        """Show these words in place of pictures, because the exercise does not show them; empty
        ends that. How the tracker is stands below as ever.
        """
        self.off = words
        for camera in self.cameras:
            camera.show_picture(None, words)

    def forget(self) -> None:
        """Show no pictures and say nothing: nobody watches now."""
        for camera in self.cameras:
            camera.show_picture(None, self.off)
        self._verdict.clear()
        self._verdict.setToolTip("")
        self._figures.clear()
        self._shown = -1e9

    @property
    def overlays(self) -> Overlays:
        """Return what is drawn over the pictures."""
        return self.cameras[0].overlays

    def due(self, now: float) -> bool:
        """Return whether the pictures may be refreshed at `now` [s] and anybody would see it."""
        return self.isVisible() and now - self._shown >= REFRESH

    def show_tracker(
        self, inspection: Inspection | None, figures: TrackerFigures, now: float
    ) -> None:
        """Show the newest pictures and figures."""
        self._shown = now
        pictures = inspection.pictures if inspection is not None else ()
        self._show_what_there_is(inspection is None or inspection.cameras > 1)
        instead = self.off or figures.instead
        for i, camera in enumerate(self.cameras):
            camera.show_picture(pictures[i] if i < len(pictures) else None, instead)
        self.learn.setEnabled(not self.off)
        colour, symbol = figures.item.verdict.colour_and_symbol
        self._verdict.setStyleSheet(f"color: {colour};")
        self._verdict.setText(f"{symbol} {figures.item.text}")
        self._verdict.setToolTip(literal(figures.item.help))
        radius = inspection.radius if inspection is not None else None
        known = inspection is None or inspection.uncertainty_known
        self._figures.show_figures(figures, radius, known)

    def _show_what_there_is(self, marker: bool) -> None:
        """Leave out, for a pen, the second picture and what is about a coloured marker."""
        for widget in (self.cameras[1], self.learn, *(self._buttons[name] for name in OF_MARKER)):
            widget.setVisible(marker)

    def set_overlay(self, name: str, shown: bool) -> None:
        """Switch one of `Overlays` by its name, in both pictures."""
        self._buttons[name].setChecked(shown)
        for camera in self.cameras:
            camera.overlays = replace(camera.overlays, **{name: shown})
            camera.update()

    def _switches(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(4)
        for name, title, help_ in (
            ("mask", tr("Mask"), tr("Pixels that count as the marker's colour")),
            (
                "epipolar",
                tr("Lines"),
                tr(
                    "Where the marker may lie by what the other camera shows; it should pass "
                    "through the marker"
                ),
            ),
            ("region", tr("Region"), tr("Where the marker is looked for in the next picture")),
            ("magnifier", tr("Zoom"), tr("The marker's surroundings, enlarged")),
        ):
            button = QToolButton(self)
            button.setText(title)
            button.setToolTip(literal(translated(help_)))
            button.setCheckable(True)
            button.setChecked(getattr(self.overlays, name))
            button.toggled.connect(lambda on, name=name: self.set_overlay(name, on))
            self._buttons[name] = button
            row.addWidget(button)
        row.addStretch(1)
        self.learn.setText(tr("Learn"))
        self.learn.setToolTip(
            tr("Learn the marker's colour: press, then click on the marker in a picture")
        )
        self.learn.setCheckable(True)
        row.addWidget(self.learn)
        return row

    def _clicked(self, camera: str, pixel: object) -> None:
        if self.learn.isChecked():
            self.learn.setChecked(False)
            self.colour_clicked.emit(camera, pixel)


OF_MARKER: Final = ("mask", "region", "magnifier")
"""Overlays that are about the coloured marker."""


class _Figures(QWidget):
    """Named figures in two columns."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(theme.SPACING)
        grid.setVerticalSpacing(0)
        self._values: dict[str, QLabel] = {}
        for number, (name, title, help_) in enumerate(_TITLES):
            label, value = PlainLabel(translated(title), self), PlainLabel("–", self)
            label.setProperty("role", "dim")
            label.setToolTip(literal(translated(help_)))
            value.setToolTip(literal(translated(help_)))
            row, column = divmod(number, 2)
            grid.addWidget(label, row, 2 * column)
            grid.addWidget(value, row, 2 * column + 1)
            self._values[name] = value
        grid.setColumnStretch(1, 1)
        grid.setColumnStretch(3, 1)

    def show_figures(
        self, figures: TrackerFigures, radius: float | None, known: bool = True
    ) -> None:
        """Show them; what is not known is a dash.

        Args:
            figures: of the tracker.
            radius: round the tip, 95 % [m].
            known: whether it holds the calibration's error.
        """
        residual, skew = figures.residual_px, figures.skew
        size = "–" if radius is None else tr("± {mm:.2f} mm", mm=1e3 * radius)
        if radius is not None and not known:
            size = tr("{size} + calibration (not known)", size=size)
            self._values["radius"].setToolTip(
                tr(
                    "From the pictures alone: the calibration was imported, so its own "
                    "uncertainty is unknown. The true radius is larger; calibrate with "
                    "pictures of a board to learn it"
                )
            )
        else:
            self._values["radius"].setToolTip(literal(translated(_HELP["radius"])))
        texts = {
            "residual": residual_text(residual),
            "radius": size,
            "rate": tr("{rate:.0f} pairs/s", rate=figures.rate),
            "valid": tr("{share:.0f} %", share=100.0 * figures.valid_share),
            "latency": tr("{ms:.0f} ms", ms=1e3 * figures.latency),
            "skew": "–" if skew is None else tr("{ms:.1f} ms", ms=1e3 * skew),
        }
        for name, text in texts.items():
            self._values[name].setText(text)

    def clear(self) -> None:
        """Write dashes."""
        for value in self._values.values():
            value.setText("–")

    def text(self, name: str) -> str:
        """Shown value."""
        return self._values[name].text()


def residual_text(residual_px: float | None) -> str:
    """Say how far the pictures disagree; never nothing, which no measurement is."""
    if residual_px is None:
        return "–"
    return tr("{px:.2f} px", px=residual_px) if residual_px >= 0.01 else tr("< 0.01 px")


_TITLES: Final = (
    (
        "residual",
        sentence("Residual"),
        sentence(
            "How far the two pictures disagree; above 1 px the calibration should be checked. It "
            "is no accuracy: a wrong scale leaves it small"
        ),
    ),
    (
        "radius",
        sentence("Tip, 95 %"),
        sentence(
            "Radius round the tip that holds the true one with 95 %, by pictures and calibration"
        ),
    ),
    ("rate", sentence("Rate"), sentence("Pairs of pictures a second")),
    ("valid", sentence("Valid"), sentence("Share of pairs in which both cameras saw the marker")),
    ("latency", sentence("Latency"), sentence("From capture to the needle's place, median")),
    (
        "skew",
        sentence("Skew"),
        sentence("Capture of the right picture after the left one; it is made up for"),
    ),
)

_HELP: Final = {name: help_ for name, _, help_ in _TITLES}
