"""The debrief page: verdict, score, scans, the tip's track and the curves of one attempt."""

from __future__ import annotations

from datetime import datetime

from PySide6.QtCore import Qt, Signal, SignalInstance
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from app.imaging.scan_order import Seen
from app.scoring.result import Score
from app.session.control_scan import TEACHING_ESTIMATE, ControlScan
from app.session.review import Review
from app.views.debrief.curves import CurvesView
from app.views.debrief.path_view import PathView
from app.views.debrief.score_words import (
    counting,
    facts_of,
    lessons,
    risk_lines,
    row_texts,
    short_words,
    shown_only,
    total_text,
    verdict,
)
from app.views.exercise.readouts import clock_text
from app.views.exercise.steps import state_word
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.coordinates import axis_words
from app.views.kit.names import NAMES
from app.views.kit.text import disclaimer, tr

_ROW_HEIGHT = 24
_COLUMNS = 5


class ScanList(QTableWidget):
    """One row for each scan; hidden where the attempt has none with slices.

    Signals:
        scan_wanted(ControlScan): a row was activated: its picture is asked for.
    """

    scan_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, _COLUMNS, parent)
        self._scans: tuple[ControlScan, ...] = ()
        estimate = tr(TEACHING_ESTIMATE).replace(" ", "\n")
        dosed = tr("mGy·cm\n{estimate}", estimate=estimate)
        titles = (tr("Scan"), tr("Time"), tr("Slices"), tr("Shows"), dosed)
        for column, title in enumerate(titles):
            self.setHorizontalHeaderItem(column, QTableWidgetItem(title))
        dose = self.horizontalHeaderItem(_COLUMNS - 1)
        if dose is not None:
            dose.setToolTip(tr(TEACHING_ESTIMATE))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setShowGrid(False)
        self.setAccessibleName(tr("Control scans"))
        self.setToolTip(tr("Enter or a double click shows its slices, if the CT is open"))
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        small = f"font-size: {theme.SMALL_PX}px;"  # all five columns fit beside the curves
        self.setStyleSheet(f"{small} QHeaderView::section {{ {small} padding: 3px 4px; }}")
        header = self.horizontalHeader()
        header.setMinimumSectionSize(24)
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(3, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)
        self.cellActivated.connect(lambda row, _: self.scan_wanted.emit(self._scans[row]))
        self.hide()

    def show_review(self, review: Review) -> None:
        """Fill the table."""
        self._scans = review.control_scans
        self.setRowCount(len(self._scans))
        self.setVisible(bool(self._scans))
        for row, scan in enumerate(self._scans):
            for column, text in enumerate(cells(scan, review.origin)):
                item = QTableWidgetItem(text)
                if column == _COLUMNS - 1:
                    item.setTextAlignment(
                        Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    )
                    item.setToolTip(tr(TEACHING_ESTIMATE))
                self.setItem(row, column, item)


def cells(scan: ControlScan, origin: float) -> tuple[str, ...]:
    """Words of one row."""
    low, high = scan.order.range_mm
    slices = tr(
        "{n} × {mm:g} mm, {low} to {high}",
        n=scan.order.slices,
        mm=scan.order.slice_mm,
        low=axis_words(2, low),
        high=axis_words(2, high),
    )
    shows = {
        Seen.TIP: tr("● tip"),
        Seen.SHAFT: tr("▲ shaft only"),
        Seen.NOTHING: tr("✖ no needle"),
    }
    time = clock_text(scan.time - origin)
    return str(scan.number), time, slices, shows[scan.seen], f"{scan.dose:.1f}"


_ROW_HEIGHT, _WEIGHT = 26, 4


class ScoreTable(QTableWidget):
    """Rows that count first, then those shown for information, dimmed."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(0, 5, parent)
        titles = (tr("Metric"), tr("Value"), tr("Band"), tr("Points"), tr("Weight"))
        for column, title in enumerate(titles):
            self.setHorizontalHeaderItem(column, _cell(title, column))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setShowGrid(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)

    def show_score(self, score: Score | None) -> None:
        """Fill the table; None empties it."""
        self.setRowCount(0)
        self.verticalHeader().setDefaultSectionSize(theme.px(_ROW_HEIGHT))
        self.setColumnHidden(_WEIGHT, theme.scale() > 1.0)  # the points say it too
        if score is None:
            return
        for row in (*counting(score), *shown_only(score)):
            texts = row_texts(row, score)
            index = self.rowCount()
            self.insertRow(index)
            dim = row.tolerance is None
            cells = (texts.label, texts.value, texts.band, texts.points, texts.weight)
            for column, text in enumerate(cells):
                item = _cell(text, column)
                colour = texts.colour if column == 2 else theme.TEXT_DIM if dim else theme.TEXT
                item.setForeground(QColor(theme.now(colour)))
                item.setToolTip(texts.help)
                self.setItem(index, column, item)


def _cell(text: str, column: int) -> QTableWidgetItem:
    """Cell aligned as its column: words to the left, numbers to the right."""
    item = QTableWidgetItem(text)
    side = Qt.AlignmentFlag.AlignLeft if column in (0, 2) else Qt.AlignmentFlag.AlignRight
    item.setTextAlignment(side | Qt.AlignmentFlag.AlignVCenter)
    return item


_LEFT = 500
"""Width of what stands beside the curves [px]."""


class DebriefPage(QWidget):
    """Shows one attempt; what its buttons do is up to whoever listens.

    Signals:
        report_requested(Review), export_requested(Review): of the attempt shown.
        retry_requested(), sessions_requested().
    """

    report_requested = Signal(object)
    export_requested = Signal(object)
    retry_requested = Signal()
    sessions_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._review: Review | None = None
        self._title, self._facts, self.conditions = QLabel(self), QLabel(self), QLabel(self)
        self._verdict, self._total, self._reason = QLabel(self), QLabel(self), QLabel(self)
        self._problems, self.risks = QLabel(self), QLabel(self)
        self.lessons = QLabel(self)
        self.table = ScoreTable(self)
        self.scans = ScanList(self)
        self.path = PathView(self)
        self.curves = CurvesView(self)
        self.report = QPushButton(tr("Save report (PDF)"), self)
        self.export = QPushButton(tr("Export CSV"), self)
        self.retry = QPushButton(tr("Try again"), self)
        self.sessions = QPushButton(tr("Sessions"), self)
        self._style()
        self._lay_out()
        self._connect()

    def show_review(self, review: Review) -> None:
        """Show an attempt."""
        self._review = review
        self._title.setText(review.exercise)
        self._facts.setText(facts(review))
        self._show_conditions(review)
        self._total.setText(total_text(review.score))
        self._show_words(review)
        lines = risk_lines(review)
        self.risks.setText("\n".join((tr("Closest to structures of risk"), *lines)))
        self.risks.setVisible(bool(lines))
        said = lessons(review)
        self.lessons.setText("\n".join(said))
        self.lessons.setVisible(bool(said))
        self.table.show_score(review.score)
        self.scans.show_review(review)
        self.path.show_review(review)
        self.curves.show_review(review)

    def _show_conditions(self, review: Review) -> None:
        """Say what the score was made under in one line, and all of it to whoever points there."""
        known = review.conditions
        self.conditions.setText(short_words(known))
        self.conditions.setVisible(known is not None)
        lines = [f"{name}: {value}" for name, value in facts_of(known)] if known else []
        self.conditions.setToolTip("\n".join(lines))

    def _show_words(self, review: Review) -> None:
        """Write the verdict and what belongs to it, without names while they are hidden."""
        colour, word, reason = verdict(review)
        self._verdict.setText(word)
        self._verdict.setStyleSheet(f"color: {colour}; font-size: {theme.TITLE_PX + 6}px;")
        self._reason.setText(NAMES.without_names(reason))
        self._reason.setVisible(bool(reason))
        problems = "\n".join(f"▲ {problem}" for problem in review.problems)
        self._problems.setText(NAMES.without_names(problems, files=True))
        self._problems.setVisible(bool(review.problems))

    @property
    def review(self) -> Review | None:
        """The attempt shown."""
        return self._review

    def _style(self) -> None:
        self._title.setProperty("role", "title")
        for label in (self._facts, self.conditions):
            label.setProperty("role", "dim")
        self._total.setStyleSheet(f"font-size: {theme.TITLE_PX}px; font-weight: 600;")
        self._problems.setStyleSheet(f"color: {theme.WARNING}; font-size: {theme.SMALL_PX}px;")
        self.retry.setProperty("role", "primary")
        for label in (
            self._title,
            self._facts,
            self.conditions,
            self._reason,
            self._problems,
            self.risks,
            self.lessons,
        ):
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setWordWrap(True)

    def _lay_out(self) -> None:
        left = QWidget(self)
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, theme.SPACING, 0)
        headline = QHBoxLayout()
        headline.addWidget(self._verdict)
        headline.addWidget(self._total, 1, Qt.AlignmentFlag.AlignRight)
        column.addWidget(self._title)
        column.addWidget(self._facts)
        column.addWidget(self.conditions)
        column.addLayout(headline)
        for widget in (self._reason, self._problems, self.lessons):
            column.addWidget(widget)
        column.addWidget(self.table, 3)
        column.addWidget(self.risks)
        column.addWidget(self.scans, 2)
        column.addWidget(self.path, 4)
        self._splitter = splitter = QSplitter(Qt.Orientation.Horizontal, self)
        splitter.addWidget(left)
        splitter.addWidget(self.curves)
        splitter.setStretchFactor(1, 1)
        splitter.setSizes([_LEFT, 900])
        buttons = QHBoxLayout()
        note = QLabel(disclaimer(), self)
        note.setProperty("role", "disclaimer")
        buttons.addWidget(note, 1)
        for button in (self.sessions, self.export, self.report, self.retry):
            buttons.addWidget(button)
        page = QVBoxLayout(self)
        page.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        page.addWidget(splitter, 1)
        page.addLayout(buttons)

    def _connect(self) -> None:
        self.report.clicked.connect(lambda: self._emit(self.report_requested))
        self.export.clicked.connect(lambda: self._emit(self.export_requested))
        self.retry.clicked.connect(self.retry_requested)
        self.sessions.clicked.connect(self.sessions_requested)

    def suit_room(self) -> None:
        """Write anew who it was, or hide it; take the present colours and size of the text."""
        self._share_width()
        if self._review is not None:
            self._facts.setText(facts(self._review))
            self._show_words(self._review)
            self.table.show_score(self._review.score)

    def _share_width(self) -> None:
        left = theme.px(_LEFT)
        self._splitter.setSizes([left, max(left, self.width() - left)])

    def _emit(self, signal: SignalInstance) -> None:
        if self._review is not None:
            signal.emit(self._review)


def facts(review: Review) -> str:
    """Who, when, how long, in one line."""
    return "  ·  ".join(
        (
            NAMES.shown(ACCESS.shown(review.student)),
            date_text(review.started),
            state_word(review.state),
            clock_text(review.duration),
            tr("control scans: {n}", n=review.scans),
        )
    )


def date_text(started: str) -> str:
    """Say a wall-clock time (ISO 8601) in local time; as it stands if it is no time."""
    try:
        return f"{datetime.fromisoformat(started).astimezone():%Y-%m-%d %H:%M}"
    except ValueError:
        return started
