"""The series of a folder with pictures: which can be used, why others cannot, what would help."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QImage, QMouseEvent, QPixmap
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QPlainTextEdit,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from app.core.identifiers import HIDDEN
from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.imaging.remedies import remedies
from app.imaging.series import NO_REMEDY, Listing, Series
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel, size_dialog
from app.views.kit.text import kept_text, literal, number, tr, tr_n

PICTURE_PX = 112
_BUTTON_PX = 190


class SeriesCard(QFrame):
    """Shows a series.

    Signals:
        chosen(Series, str): open it, as it is (`NO_REMEDY`) or by the remedy of that name.
    """

    chosen = Signal(object, object)

    def __init__(
        self, series: Series, parent: QWidget | None = None, *, taking: bool = False
    ) -> None:
        super().__init__(parent)
        self.series = series
        self.setProperty("role", "panel")
        self.picture = PlainLabel(tr("no picture"), self)
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
    """Return whether it can be used, in words, with a sign that tells it without colour."""
    if series.usable:
        return "✔  " + tr("can be used")
    sign = "▲" if series.remedies else "✖"
    return f"{sign}  {series.reason}"


def facts(series: Series) -> str:
    """Modality, size and spacing."""
    size = " × ".join(str(count) for count in series.size)
    parts = [series.modality, size]
    if series.spacing_mm is not None:
        parts.append(" × ".join(number(value, ".3g") for value in series.spacing_mm) + " mm")
    return "  ·  ".join(part for part in parts if part)


def _buttons(series: Series, parent: QWidget, taking: bool) -> list[tuple[QPushButton, str]]:
    """Offer the series as it is, and by each remedy that helps it."""
    ways = [(NO_REMEDY, tr("Open"), "")] if series.usable else []
    if not (taking and series.usable):
        ways += [
            (one.name, tr(one.title), tr(one.help))
            for one in remedies()
            if one.name in series.remedies
        ]
    found = []
    for remedy, title, tip in ways:
        button = QPushButton(tr("Import…") if taking else title, parent)
        button.setMinimumWidth(_BUTTON_PX)
        button.setToolTip(literal(tip))
        if remedy == NO_REMEDY:
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
    label = PlainLabel(text)
    label.setWordWrap(wraps)
    if role:
        label.setProperty("role", role)
    return label


def _colour(series: Series) -> str:
    if series.usable:
        return theme.GOOD
    return theme.WARNING if series.remedies else theme.BAD


class Thumbnails(QObject):
    """Makes the pictures in the order given.

    Signals:
        ready(int, object): number of the series, its picture or None.
    """

    ready = Signal(int, object)

    def __init__(self, series: Sequence[Series], size_px: int, parent: QObject) -> None:
        super().__init__(parent)
        self._series, self._size_px = tuple(series), size_px
        self._task: BackgroundTask | None = None

    @property
    def is_busy(self) -> bool:
        """Return whether pictures are still to come."""
        return self._task is not None

    def open(self) -> None:
        """Begin with the first."""
        self._make(0)

    def close(self) -> None:
        """Stop; idempotent."""
        if self._task is not None:
            self._task.close(timeout=0.0)
            self._task = None

    def _make(self, number: int) -> None:
        if number >= len(self._series):
            self._task = None
            return

        def done(picture: object) -> None:
            self.ready.emit(number, picture)
            self._make(number + 1)

        series, size = self._series[number], self._size_px
        self._task = run_in_background(
            self, lambda progress: _picture(series, size, progress), done, lambda _: done(None)
        )


def _picture(series: Series, size_px: int, progress: Progress) -> Any:
    progress.report(0.0)
    with ONE_AT_A_TIME:  # pydicom: behind the window, not before it
        from app.imaging.thumbnails import try_thumbnail
    return try_thumbnail(series, size_px)


SIZE = 980, 620


class SeriesBrowser(QDialog):
    """Lets choose among the series of a folder, those that can be used first.

    With `taking` the one chosen goes into the library: its own images, whatever opens them later.

    Signals:
        chosen(Series, str): open it, as it is (`NO_REMEDY`) or by the remedy of that name.
    """

    chosen = Signal(object, object)

    def __init__(
        self, listing: Listing, parent: QWidget | None = None, *, taking: bool = False
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Series of {name}", name=NAMES.shown(listing.path.name)))
        size_dialog(self, *SIZE)
        self.listing = listing
        shown = sorted(listing.series, key=_rank)
        self.cards = [SeriesCard(series, self, taking=taking) for series in shown]
        self.ignored = QPlainTextEdit(self)
        self._more = QPushButton(self)
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        heading = PlainLabel(_heading(listing), self)
        heading.setProperty("role", "heading")
        column.addWidget(heading)
        column.addWidget(self._scrolled(), 1)
        self._add_ignored(column)
        for card in self.cards:
            card.chosen.connect(self._take)
        self.thumbnails = Thumbnails(shown, PICTURE_PX, self)
        self.thumbnails.ready.connect(lambda n, grey: self.cards[n].show_picture(grey))
        self.finished.connect(self.thumbnails.close)
        self._focus_first()
        self.thumbnails.open()

    def _scrolled(self) -> QScrollArea:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setSpacing(theme.SPACING)
        column.setContentsMargins(0, 0, theme.SPACING, 0)
        for card in self.cards:
            column.addWidget(card)
        column.addStretch()
        area = QScrollArea(self)
        area.setWidgetResizable(True)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setWidget(inside)
        return area

    def _add_ignored(self, column: QVBoxLayout) -> None:
        files = self.listing.ignored
        lines = [
            f"{NAMES.shown(self.listing.shown(file.path))}: "
            + NAMES.without_names(kept_text(file.reason), files=True)
            for file in files
        ]
        self.ignored.setPlainText("\n".join(lines))
        self.ignored.setReadOnly(True)
        self.ignored.setMaximumHeight(160)
        self.ignored.hide()
        self._more.setText(tr("{count} other files…", count=len(files)))
        self._more.setCheckable(True)
        self._more.setAutoDefault(False)
        self._more.toggled.connect(self.ignored.setVisible)
        self._more.setVisible(bool(files))
        close = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel, parent=self)
        close.rejected.connect(self.reject)
        foot = QHBoxLayout()
        foot.addWidget(self._more)
        foot.addStretch()
        foot.addWidget(close)
        column.addWidget(self.ignored)
        column.addLayout(foot)

    def _focus_first(self) -> None:
        """Let Enter open the first series that can be opened, and nothing else."""
        buttons = [button for card in self.cards for button, _ in card.buttons]
        for button in buttons:
            button.setAutoDefault(True)
        if buttons:
            buttons[0].setDefault(True)
            buttons[0].setFocus()

    def _take(self, series: Series, remedy: str) -> None:
        self.accept()
        self.chosen.emit(series, remedy)


def _rank(series: Series) -> tuple[int, int]:
    """Usable ones first, then those that can be mended; the larger before the smaller."""
    kind = 0 if series.usable else 1 if series.remedies else 2
    return kind, -series.size[2]


def _heading(listing: Listing) -> str:
    usable, count = len(listing.usable), len(listing.series)
    if not usable:
        return tr_n(
            "{n} series, which cannot be used as it is",
            "{n} series, none of which can be used as it is",
            count,
        )
    return tr_n(
        "{n} series, {usable} of which can be used",
        "{n} series, {usable} of which can be used",
        count,
        usable=usable,
    )
