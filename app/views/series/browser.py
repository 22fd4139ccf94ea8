"""The series of a folder with pictures: which can be used, why others cannot, what would help."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
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

from app.imaging.series import Listing, Remedy, Series
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.series.card import PICTURE_PX, SeriesCard
from app.views.series.thumbs import Thumbnails

SIZE = 980, 620


class SeriesBrowser(QDialog):
    """Lets choose among the series of a folder, those that can be used first.

    With `taking` the one chosen goes into the library: its own images, whatever opens them later.

    Signals:
        chosen(Series, Remedy): open it, as it is or in the way asked for.
    """

    chosen = Signal(object, object)

    def __init__(
        self, listing: Listing, parent: QWidget | None = None, *, taking: bool = False
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Series of {name}", name=NAMES.shown(listing.path.name)))
        self.resize(*SIZE)
        self.listing = listing
        shown = sorted(listing.series, key=_rank)
        self.cards = [SeriesCard(series, self, taking=taking) for series in shown]
        self.ignored = QPlainTextEdit(self)
        self._more = QPushButton(self)
        column = QVBoxLayout(self)
        column.setSpacing(theme.SPACING)
        heading = QLabel(_heading(listing), self)
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
            + NAMES.without_names(file.reason, files=True)
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

    def _take(self, series: Series, remedy: Remedy) -> None:
        self.accept()
        self.chosen.emit(series, remedy)


def _rank(series: Series) -> tuple[int, int]:
    """Usable ones first, then those that can be mended; the larger before the smaller."""
    kind = 0 if series.usable else 1 if series.remedy is not Remedy.NONE else 2
    return kind, -series.size[2]


def _heading(listing: Listing) -> str:
    usable, count = len(listing.usable), len(listing.series)
    if not usable:
        return tr("{count} series, none of which can be used as it is", count=count)
    return tr("{count} series, {usable} of which can be used", count=count, usable=usable)
