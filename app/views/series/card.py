"""One series in the browser: a picture, what it is, whether and how it can be opened."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QImage, QMouseEvent, QPixmap
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from app.core.identifiers import HIDDEN
from app.imaging.series import Remedy, Series
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.text import tr

PICTURE_PX = 112
_BUTTON_PX = 190


class SeriesCard(QFrame):
    """Shows a series.

    Signals:
        chosen(Series, Remedy): open it, as it is or in the way asked for.
    """

    chosen = Signal(object, object)

    def __init__(
        self, series: Series, parent: QWidget | None = None, *, taking: bool = False
    ) -> None:
        super().__init__(parent)
        self.series = series
        self.setProperty("role", "panel")
        self.picture = QLabel(tr("no picture"), self)
        self.picture.setFixedSize(PICTURE_PX, PICTURE_PX)
        self.picture.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.picture.setStyleSheet(
            f"background: {theme.IMAGE_BACKGROUND}; color: {theme.IMAGE_DIM}"
        )
        self.verdict = _line(_without_names(series, verdict(series)), wraps=True)
        self.verdict.setStyleSheet(f"color: {_colour(series)}")
        row = QHBoxLayout(self)
        row.setSpacing(theme.MARGIN)
        row.addWidget(self.picture)
        row.addLayout(self._words(), 1)
        self.buttons = _buttons(series, self, taking)
        column = QVBoxLayout()
        for button, remedy in self.buttons:
            button.clicked.connect(lambda _=False, r=remedy: self.chosen.emit(self.series, r))
            column.addWidget(button)
        column.addStretch()
        row.addLayout(column)

    def _words(self) -> QVBoxLayout:
        heading = _line(NAMES.shown(self.series.label), "heading")
        column = QVBoxLayout()
        column.setSpacing(4)
        column.addWidget(heading)
        column.addWidget(_line(facts(self.series), "dim"))
        column.addWidget(self.verdict)
        for note in self.series.notes:
            column.addWidget(_line(f"•  {_without_names(self.series, note)}", "dim", wraps=True))
        column.addStretch()
        return column

    def show_picture(self, grey: NDArray[np.uint8] | None) -> None:
        """Show a grey picture, shape (rows, columns); None: there is none."""
        if grey is None:
            self.picture.setText(tr("no picture"))
            return
        rows, columns = grey.shape
        grey = np.ascontiguousarray(grey)
        image = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        self.picture.setPixmap(QPixmap.fromImage(image.copy()))

    def open(self) -> None:
        """Open the series in the first way there is."""
        if self.buttons:
            self.chosen.emit(self.series, self.buttons[0][1])

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Open the series."""
        self.open()


def verdict(series: Series) -> str:
    """Whether it can be used, in words, with a sign that tells it without colour."""
    if series.usable:
        return "✔  " + tr("can be used")
    sign = "✖" if series.remedy is Remedy.NONE else "▲"
    return f"{sign}  {series.reason}"


def facts(series: Series) -> str:
    """Modality, size and spacing."""
    size = " × ".join(str(count) for count in series.size)
    parts = [series.modality, size]
    if series.spacing_mm is not None:
        parts.append(" × ".join(f"{value:.3g}" for value in series.spacing_mm) + " mm")
    return "  ·  ".join(part for part in parts if part)


def remedy_words(remedy: Remedy) -> str:
    """Name the way of opening on a button."""
    return {
        Remedy.RESAMPLE: tr("Open resampled"),
        Remedy.STRAIGHTEN: tr("Open straightened"),
        Remedy.HALVE: tr("Open at half size"),
    }.get(remedy, tr("Open"))


def _remedy_tip(remedy: Remedy) -> str:
    return {
        Remedy.RESAMPLE: tr(
            "Interpolates between the slices onto an even grid; missing slices stay empty."
        ),
        Remedy.STRAIGHTEN: tr(
            "Interpolates onto a right-angled grid. Opened as it is, the tilt is kept exactly."
        ),
        Remedy.HALVE: tr("Averages neighbouring voxels until the volume fits the memory."),
    }.get(remedy, "")


def _buttons(series: Series, parent: QWidget, taking: bool) -> list[tuple[QPushButton, Remedy]]:
    ways = [Remedy.NONE] if series.usable else []
    if series.remedy is not Remedy.NONE and not (taking and series.usable):
        ways.append(series.remedy)
    found = []
    for remedy in ways:
        button = QPushButton(tr("Import…") if taking else remedy_words(remedy), parent)
        button.setMinimumWidth(_BUTTON_PX)
        button.setToolTip(_remedy_tip(remedy))
        if remedy is Remedy.NONE:
            button.setProperty("role", "primary")
        found.append((button, remedy))
    return found


def _without_names(series: Series, text: str) -> str:
    """Take the files' names out of a reason while names are hidden."""
    if NAMES.are_hidden:
        for one in series.slices:
            text = text.replace(one.path.name, HIDDEN)
    return NAMES.without_names(text, files=True)


def _line(text: str, role: str = "", wraps: bool = False) -> QLabel:
    label = QLabel(text)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(wraps)
    if role:
        label.setProperty("role", role)
    return label


def _colour(series: Series) -> str:
    if series.usable:
        return theme.GOOD
    return theme.BAD if series.remedy is Remedy.NONE else theme.WARNING
