"""The debrief page: verdict, score, scans, and the attempt replayed in all views and curves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from PySide6.QtCore import QSize, Qt, Signal, SignalInstance
from PySide6.QtGui import QColor, QHideEvent, QKeySequence, QResizeEvent, QShortcut
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QComboBox,
    QHBoxLayout,
    QHeaderView,
    QPushButton,
    QScrollArea,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.exercises.drill import DrillKind
from app.imaging.scan_order import Seen
from app.scoring.result import Score
from app.session.control_scan import TEACHING_ESTIMATE, ControlScan
from app.session.motion import Alignment
from app.session.next_exercise import Proposal, ProposalReason
from app.session.review import Review
from app.views.debrief.card import DebriefCard, drill_title
from app.views.debrief.curves import CurvesView
from app.views.debrief.margin_map import AblationReview
from app.views.debrief.published import PublishedOdds
from app.views.debrief.remarks import RemarkActions, said_words
from app.views.debrief.replay import (
    LEAP_S,
    STEP_S,
    Ghost,
    ReplayBar,
    Replayer,
    ReplayViews,
    placed_ghost,
)
from app.views.debrief.score_words import (
    complication_lines,
    counting,
    facts_of,
    met_lines,
    proposal_words,
    risk_lines,
    row_texts,
    short_words,
    shown_only,
    whose_words,
)
from app.views.exercise.readouts import clock_text
from app.views.exercise.stages import state_word
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.coordinates import axis_words
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel
from app.views.kit.roles import Role
from app.views.kit.text import date_text, declared, disclaimer, literal, number, tr, translated

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
        self.setTabKeyNavigation(False)
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
        # What a scan shows is read first; where its slices lie is whole in the tip.
        header.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)
        self.cellActivated.connect(lambda row, _: self.scan_wanted.emit(self._scans[row]))
        self.hide()

    def show_review(self, review: Review) -> None:
        """Fill the table."""
        self._scans = review.control_scans
        self.setRowCount(len(self._scans))
        self.setVisible(bool(self._scans))
        for row, scan in enumerate(self._scans):
            for column, text in enumerate(cells(scan, review.clock_at(scan.time))):
                item = QTableWidgetItem(text)
                item.setToolTip(literal(text))
                if column == _COLUMNS - 1:
                    item.setTextAlignment(
                        Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    )
                    item.setToolTip(tr(TEACHING_ESTIMATE))
                self.setItem(row, column, item)


def cells(scan: ControlScan, shown: float) -> tuple[str, ...]:
    """Words of one row; `shown` on the student's clock as it was taken [s]."""
    low, high = scan.order.range_mm
    slices = tr(
        "{n} × {mm:g} mm, {low} to {high}",
        n=scan.order.slices,
        mm=scan.order.slice_mm,
        low=axis_words(2, low),
        high=axis_words(2, high),
    )
    if chosen := translated(scan.chosen):
        slices = f"{slices}, {chosen}"
    shows = {
        Seen.TIP: tr("● tip"),
        Seen.BETWEEN: tr("◆ tip in a gap"),
        Seen.SHAFT: tr("▲ shaft only"),
        Seen.NOTHING: tr("✖ no needle"),
    }
    time = clock_text(shown)
    return str(scan.number), time, slices, shows[scan.seen], number(scan.dose, ".1f")


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
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setTabKeyNavigation(False)
        self.setAccessibleName(tr("Points"))
        self.setShowGrid(False)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(_ROW_HEIGHT)
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setHighlightSections(False)
        self._score: Score | None = None
        self._detailed = True

    def set_detailed(self, detailed: bool) -> None:
        """Show what does not count as well, or only what the score is made of."""
        if detailed != self._detailed:
            self._detailed = detailed
            self.show_score(self._score)

    def show_score(self, score: Score | None) -> None:
        """Fill the table; None empties it."""
        self._score = score
        self.setRowCount(0)
        self.verticalHeader().setDefaultSectionSize(theme.px(_ROW_HEIGHT))
        self._leave_out()
        if score is None:
            return
        for row in (*counting(score), *(shown_only(score) if self._detailed else ())):
            texts = row_texts(row, score)
            index = self.rowCount()
            self.insertRow(index)
            dim = row.tolerance is None
            cells = (texts.label, texts.value, texts.band, texts.points, texts.weight)
            for column, text in enumerate(cells):
                item = _cell(text, column)
                colour = texts.colour if column == 2 else theme.TEXT_DIM if dim else theme.TEXT
                item.setForeground(QColor(theme.now(colour)))
                # The column of names is the one that is cut where there is little room.
                item.setToolTip(
                    literal(f"{texts.label}\n{texts.help}" if column == 0 else texts.help)
                )
                self.setItem(index, column, item)
        self.updateGeometry()

    def sizeHint(self) -> QSize:
        """Return room for all rows: the page scrolls, a table in it does not as well."""
        frame = 2 * self.frameWidth()
        head = self.horizontalHeader().sizeHint().height()
        rows = self.rowCount() * self.verticalHeader().defaultSectionSize()
        return QSize(super().sizeHint().width(), head + rows + frame)

    def minimumSizeHint(self) -> QSize:
        """Return the same height: nothing of it is put away."""
        return QSize(super().minimumSizeHint().width(), self.sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave the names of the metrics room."""
        super().resizeEvent(event)
        self._leave_out()

    def _leave_out(self) -> None:
        """Leave the weight out where there is no room: the points say it too."""
        self.setColumnHidden(_WEIGHT, theme.scale() > 1.0 or self.width() < _ROOMY)


_ROOMY = 480
"""Width from which all columns of the score have room [px]."""


def _cell(text: str, column: int) -> QTableWidgetItem:
    """Cell aligned as its column: words to the left, numbers to the right."""
    item = QTableWidgetItem(text)
    side = Qt.AlignmentFlag.AlignLeft if column in (0, 2) else Qt.AlignmentFlag.AlignRight
    item.setTextAlignment(side | Qt.AlignmentFlag.AlignVCenter)
    return item


_LEFT, _VIEWS = 440, 520
"""Width of what stands beside the views, and of the views [px]."""

_NARROW: Final = 1100
"""A page that is narrower gives it no more than its share [px]."""

_SHARE: Final = 0.36
"""Of the page's width it takes no more, however large the text."""

_AGAIN_LONGEST: Final = 34
"""Characters of a title on a button."""


_FOLD_STYLE: Final = (
    "QToolButton, QToolButton:checked { background: transparent; color: palette(window-text);"
    " border: 1px solid transparent; padding: 4px 8px; }"
    "QToolButton:focus { border: 1px solid palette(highlight); }"
)


class DebriefPage(QWidget):
    """Shows one attempt and replays it; what its buttons do is up to whoever listens.

    Signals:
        report_requested(Review), export_requested(Review): of the attempt shown.
        retry_requested(): the same exercise again.
        next_requested(str): begin this exercise, which was proposed.
        sessions_requested().
        said(): the instructor said something of the attempt.
        ghost_wanted(object): the key of another attempt that is to stand beside this one.
        drill_wanted(object): begin this `DrillKind`.

    Attributes:
        replayer: the clock of the replay.
        views: slices, 3D and bull's-eye at its moment.
        bar: plays and scrubs it.
    """

    report_requested = Signal(object)
    export_requested = Signal(object)
    retry_requested = Signal()
    next_requested = Signal(str)
    sessions_requested = Signal()
    said = Signal()
    ghost_wanted = Signal(object)
    drill_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._review: Review | None = None
        self._waits = ""
        self._proposal: Proposal | None = None
        self._ghost: Ghost | None = None
        self._alignment = Alignment.TIME
        self._dragged = False
        self._title, self._facts, self.conditions = (
            PlainLabel(self),
            PlainLabel(self),
            PlainLabel(self),
        )
        self.whose = PlainLabel(self)
        self.card, self.fold = DebriefCard(self), QToolButton(self)
        self._problems, self.risks = PlainLabel(self), PlainLabel(self)
        self.met, self.published = PlainLabel(self), PublishedOdds(self)
        self.complications = PlainLabel(self)
        self.proposal = PlainLabel(self)
        self.held, self.comment = PlainLabel(self), PlainLabel(self)
        self.table = ScoreTable(self)
        self.details = QPushButton(tr("Details"), self)
        self.details.setCheckable(True)
        self.scans = ScanList(self)
        self.ablation = AblationReview(self)
        self.replayer = Replayer(self)
        self.views, self.curves = ReplayViews(self), CurvesView(self)
        self.bar = ReplayBar(self.replayer, self)
        self.path = self.views.path
        self.report = QPushButton(tr("Save report (PDF)"), self)
        self.export = QPushButton(tr("Export CSV"), self)
        self.retry = QPushButton(tr("Again"), self)
        self.next = QPushButton(self)
        self.sessions = QPushButton(tr("Sessions"), self)
        self.remarks = RemarkActions(self, lambda: [self._review.id] if self._review else [])
        self._style()
        self._lay_out()
        self._connect()
        self.details.toggled.connect(lambda _: self.follow_role())
        ACCESS.changed.connect(self.follow_role)
        self.follow_role()
        self.show_proposal(None)

    def show_review(self, review: Review) -> None:
        """Show an attempt, standing where its needle ended."""
        self._review, self._ghost, self._waits = review, None, ""
        self._show_held("")
        self._title.setText(title_of(review))
        self._facts.setText(facts(review))
        self._show_conditions(review)
        self.show_said(review)
        lines = risk_lines(review)
        self.risks.setText("\n".join((tr("Closest to structures of risk"), *lines)))
        self.risks.setVisible(bool(lines))
        lines = met_lines(review)
        self.met.setText(
            "\n".join((tr("What the needle met, with the force along the needle"), *lines))
        )
        self.met.setVisible(bool(lines))
        lines = complication_lines(review)
        self.complications.setText("\n".join((tr("What happened to the patient"), *lines)))
        self.complications.setVisible(bool(lines))
        self.published.show_review(review)
        self.card.offer(None)
        self.table.show_score(review.score)
        self.scans.show_review(review)
        self.ablation.show_ablation(review.ablation)
        self.curves.show_review(review)
        self.show_proposal(None)
        self._begin_replay(review)

    def show_said(self, review: Review, waits: str = "") -> None:
        """Show what the instructor says of the attempt that is shown.

        Args:
            review: of the same attempt, with what is said now.
            waits: title of the course whose instructor has not released the result yet, for him.
        """
        self._review, self._waits = review, waits
        self._show_words(review)
        self.follow_access()

    def follow_role(self) -> None:
        """Fold away what does not count, and what only leaves the station, for a student."""
        student = ACCESS.role is Role.STUDENT
        self.details.setVisible(student)
        self.export.setVisible(not student)
        self.table.set_detailed(not student or self.details.isChecked())

    def follow_access(self) -> None:
        """Offer what may be said of the attempt by who is here."""
        review = self._review
        if review is None:
            self.remarks.follow({}, {})
        else:
            held = {review.id: self._waits} if self._waits else {}
            self.remarks.follow({review.id: review.said}, held)

    def show_held(self, review: Review, words: str) -> None:
        """Say only that there was an attempt, and who releases its result: nothing that tells it.

        Args:
            review: of the attempt; neither score nor course of it is shown.
            words: who releases it.
        """
        self._review, self._ghost, self._waits = None, None, ""
        self.follow_access()
        self.replayer.begin(0.0, 0.0)
        self._title.setText(declared(review.exercise))
        self._facts.setText(facts(review))
        self.show_proposal(None)
        self._show_held(words)

    def show_proposal(self, proposal: Proposal | None) -> None:
        """Say what comes next and why; None while nobody has looked."""
        self._proposal = proposal
        words = proposal_words(proposal) if proposal is not None else ""
        drills = self.card.kind is not None and not self._passed
        self.proposal.setText(words)
        self.proposal.setVisible(bool(words) and not drills)  # the drill is what comes next
        other = proposal is not None and bool(proposal.exercise) and proposal.reason not in SAME
        self.next.setVisible(other)
        if proposal is not None and other:
            title = declared(proposal.title)
            if len(title) > _AGAIN_LONGEST:
                title = title[: _AGAIN_LONGEST - 1].rstrip() + "…"
            self.next.setText(tr("Next: {title}", title=title))
            self.next.setToolTip(literal(words))
        closed = proposal.closed if proposal is not None else ""
        self.retry.setEnabled(not closed)
        self.retry.setToolTip(literal(translated(closed)))
        for button, primary in ((self.next, other), (self.retry, not other and not closed)):
            button.setProperty("role", "primary" if primary and not drills else "")
            button.style().unpolish(button)
            button.style().polish(button)

    def offer_drill(self, kind: DrillKind | None, rounds: int = 0, aligned: bool = False) -> None:
        """Offer a drill on the card; None offers none.

        Args:
            kind: which.
            rounds: how many of it were done today.
            aligned: whether a simulated hand would lead the needle.
        """
        self.card.offer(kind, rounds, first=not self._passed, aligned=aligned)
        self.show_proposal(self._proposal)

    @property
    def _passed(self) -> bool:
        score = None if self._review is None else self._review.score
        return score is not None and score.passed

    def _show_conditions(self, review: Review) -> None:
        """Say what the score was made under in one line, and all of it to whoever points there."""
        known = review.conditions
        whose = whose_words(known)
        self.whose.setText(whose)
        self.whose.setVisible(bool(whose))
        self.conditions.setText(short_words(known))
        self.conditions.setVisible(known is not None)
        lines = [f"{name}: {value}" for name, value in facts_of(known)] if known else []
        self.conditions.setToolTip(literal("\n".join(lines)))

    def _show_words(self, review: Review) -> None:
        """Write the verdict and what belongs to it, without names while they are hidden."""
        self.card.show_review(review)
        said = said_words(replace(review.said, void=""), self._waits)
        self.comment.setText(NAMES.without_names("\n".join(said)))
        self.comment.setVisible(bool(said))
        problems = "\n".join(f"▲ {problem}" for problem in review.problems)
        self._problems.setText(NAMES.without_names(problems, files=True))
        self._problems.setVisible(bool(review.problems))

    @property
    def review(self) -> Review | None:
        """The attempt shown; None before one is, and while its result is held."""
        return self._review

    # --- replay -----------------------------------------------------------------------------------
    def _begin_replay(self, review: Review) -> None:
        motion = review.motion
        self.views.show_review(review)
        self.bar.set_ghosts([])
        self.bar.show_alignment(False)
        if motion is None or not len(motion):
            self.replayer.begin(0.0, 0.0)
        else:
            self.replayer.begin(motion.end, float(motion.time[motion.last]))
        self.bar.begin(review.shown_time)
        self.bar.setVisible(self.replayer.end > 0.0)

    def _show_time(self, time: float) -> None:
        """Let every view and the curves stand at a moment [s]."""
        review = self._review
        if review is None or review.motion is None:
            return
        self.views.show_row(review.motion.row(time))
        self.curves.show_time(time)

    def _seek(self, time: float) -> None:
        self.replayer.pause()
        self.replayer.seek(time)

    def _seek_scan(self, row: int) -> None:
        """Go to the moment at which a scan was taken."""
        if self._review is not None:
            self._seek(self._review.control_scans[row].time - self._review.origin)

    def offer_ghosts(self, choices: Sequence[tuple[object, str]], at_first: object = None) -> None:
        """Offer what may stand beside the needle: keys with their words.

        Args:
            choices: what there is.
            at_first: key of what stands there until somebody chooses; None for nothing.
        """
        there = self.bar.ghost.count() > 1  # somebody may have chosen already
        chosen = self.bar.ghost.currentData() if there else at_first
        self.bar.set_ghosts(list(choices), chosen)
        if not there and self.bar.ghost.currentData() is not None:
            self.bar.align_by(Alignment.DEPTH)
            self.ghost_wanted.emit(self.bar.ghost.currentData())

    def show_ghost(self, ghost: Ghost | None) -> None:
        """Let the ideal path, another attempt, or nothing stand beside this one."""
        self._ghost = ghost
        self.bar.show_alignment(ghost is not None and ghost.review is not None)
        self._place_ghost()

    def _align(self, by: str) -> None:
        self._alignment = Alignment(by)
        self._place_ghost()

    def _place_ghost(self) -> None:
        review, ghost = self._review, self._ghost
        if review is None or review.motion is None:
            return
        placed = placed_ghost(review, ghost, self._alignment)
        self.views.path.show_ghost(placed.track)
        self.curves.show_ghost(placed.lines)
        self.views.set_ghost(placed.needle, "" if ghost is None else ghost.title)

    def _style(self) -> None:
        self._title.setProperty("role", "title")
        for label in (self._facts, self.conditions):
            label.setProperty("role", "dim")
        self._problems.setStyleSheet(f"color: {theme.WARNING}; font-size: {theme.SMALL_PX}px;")
        self.proposal.setStyleSheet("font-weight: 600;")
        self.comment.setStyleSheet(
            f"background: {theme.RAISED}; border-left: 3px solid {theme.ACCENT}; padding: 4px 8px;"
        )
        self.whose.setStyleSheet(
            f"background: {theme.RAISED}; border-left: 3px solid {theme.WARNING}; padding: 4px 8px;"
            " font-weight: 600;"
        )
        for label in (
            self._title,
            self._facts,
            self.whose,
            self.conditions,
            self._problems,
            self.risks,
            self.met,
            self.complications,
            self.proposal,
            self.held,
            self.comment,
        ):
            label.setWordWrap(True)

    def _lay_out(self) -> None:
        page = QVBoxLayout(self)
        page.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        page.addWidget(self._head())
        page.addWidget(self.held, 1)
        page.addWidget(self._body(), 1)
        page.addLayout(self._foot())

    def _head(self) -> QWidget:
        head = QWidget(self)
        row = QHBoxLayout(head)
        row.setContentsMargins(0, 0, 0, 0)
        self._title.setWordWrap(False)
        self._facts.setWordWrap(False)
        row.addWidget(self._title)
        row.addSpacing(theme.SPACING)
        row.addWidget(self._facts, 1, Qt.AlignmentFlag.AlignRight)
        return head

    def _body(self) -> QWidget:
        left = QWidget(self)
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, theme.SPACING, 0)
        column.setSpacing(8)
        column.addWidget(self.whose)
        column.addWidget(self.card)
        for widget in (self.comment, self._problems, self.proposal, self.conditions, self.fold):
            column.addWidget(widget)
        column.addWidget(self.ablation)
        column.addWidget(self._folded())
        column.addWidget(self.scans)
        column.addStretch(1)
        scrolled = QScrollArea(self)
        scrolled.setWidgetResizable(True)
        scrolled.setFrameShape(QScrollArea.Shape.NoFrame)
        scrolled.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scrolled.setWidget(left)
        right = QWidget(self)
        self._inner = QSplitter(Qt.Orientation.Horizontal, right)
        self._inner.addWidget(self.views)
        self._inner.addWidget(self.curves)
        self._inner.setStretchFactor(0, 5)
        self._inner.setStretchFactor(1, 4)
        beside = QVBoxLayout(right)
        beside.setContentsMargins(0, 0, 0, 0)
        beside.addWidget(self._inner, 1)
        beside.addWidget(self.bar)
        self._splitter = splitter = QSplitter(Qt.Orientation.Horizontal, self)
        splitter.addWidget(scrolled)
        splitter.addWidget(right)
        splitter.setStretchFactor(1, 1)
        splitter.splitterMoved.connect(self._note_drag)
        splitter.setSizes([_LEFT, 900])
        self._inner.setSizes([_VIEWS, 400])
        return splitter

    def _folded(self) -> QWidget:
        """Return what the fold shows: the metrics, and what else the needle did."""
        self._below = below = QWidget(self)
        column = QVBoxLayout(below)
        column.setContentsMargins(0, 0, 0, 0)
        for widget in (
            self.table,
            self.details,
            self.risks,
            self.met,
            self.complications,
            self.published,
        ):
            column.addWidget(widget)
        self.fold.setText(tr("All metrics"))
        self.fold.setToolTip(tr("Every metric with its value, band and points; remembered"))
        self.fold.setCheckable(True)
        self.fold.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.fold.setStyleSheet(_FOLD_STYLE)
        self.fold.toggled.connect(self._unfold)
        self._unfold(False)
        return below

    def _unfold(self, unfolded: bool) -> None:
        self._below.setVisible(unfolded)
        self.fold.setArrowType(Qt.ArrowType.DownArrow if unfolded else Qt.ArrowType.RightArrow)

    def _foot(self) -> QHBoxLayout:
        buttons = QHBoxLayout()
        note = PlainLabel(disclaimer(), self)
        note.setProperty("role", "disclaimer")
        note.setWordWrap(True)
        buttons.addWidget(note, 1)
        for button in (
            self.remarks.button,
            self.sessions,
            self.export,
            self.report,
            self.retry,
            self.next,
        ):
            buttons.addWidget(button)
        return buttons

    def _show_held(self, words: str) -> None:
        """Show nothing but these words, or everything where there are none."""
        self.held.setText(words)
        self.held.setVisible(bool(words))
        self.held.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._splitter.setVisible(not words)
        self.report.setVisible(not words)
        self.export.setVisible(not words and ACCESS.role is not Role.STUDENT)

    def _connect(self) -> None:
        self.report.clicked.connect(lambda: self._emit(self.report_requested))
        self.export.clicked.connect(lambda: self._emit(self.export_requested))
        self.retry.clicked.connect(self.retry_requested)
        self.next.clicked.connect(self._go_on)
        self.sessions.clicked.connect(self.sessions_requested)
        self.remarks.changed.connect(self.said)
        self.replayer.moved.connect(self._show_time)
        self.curves.sought.connect(self._seek)
        self.card.drill_wanted.connect(self.drill_wanted)
        self.scans.cellClicked.connect(lambda row, _: self._seek_scan(row))
        self.bar.laid.connect(self.views.lay_along_path)
        self.bar.aligned.connect(self._align)
        self.bar.ghost_wanted.connect(self.ghost_wanted)
        near, far = STEP_S, LEAP_S
        for keys, does in (
            ("Left", lambda: self.replayer.step(-near)),
            ("Right", lambda: self.replayer.step(near)),
            ("Shift+Left", lambda: self.replayer.step(-far)),
            ("Shift+Right", lambda: self.replayer.step(far)),
            ("Home", lambda: self._seek(0.0)),
            ("End", lambda: self._seek(self.replayer.end)),
            ("Space", self._press_space),
        ):
            shortcut = QShortcut(QKeySequence(keys), self)
            shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            shortcut.activated.connect(does)

    def _press_space(self) -> None:
        """Play or pause; on a button, or a choice, do what Space does there."""
        within = self.focusWidget()
        if isinstance(within, QAbstractButton):
            within.click()
        elif isinstance(within, QComboBox):
            within.showPopup()
        else:
            self.replayer.toggle()

    def _go_on(self) -> None:
        if self._proposal is not None and self._proposal.exercise:
            self.next_requested.emit(self._proposal.exercise)

    def hideEvent(self, event: QHideEvent) -> None:
        """Stand still while nobody looks."""
        super().hideEvent(event)
        self.replayer.pause()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the words their share, until somebody has dragged the border."""
        super().resizeEvent(event)
        if not self._dragged:
            self._share_width()

    def suit_room(self) -> None:
        """Write anew who it was, or hide it; take the present colours and size of the text."""
        self._share_width()
        self.views.suit_room()
        if self._review is not None:
            self._facts.setText(facts(self._review))
            self._show_words(self._review)
            self.table.show_score(self._review.score)

    def _note_drag(self) -> None:
        self._dragged = True

    def _share_width(self) -> None:
        left = theme.px(_LEFT)
        if self.width() > 0:
            least = _LEFT if self.width() >= _NARROW else 0
            left = min(left, max(least, round(_SHARE * self.width())))
        self._splitter.setSizes([left, max(left, self.width() - left)])

    def _emit(self, signal: SignalInstance) -> None:
        if self._review is not None:
            signal.emit(self._review)


SAME: Final = (
    *(ProposalReason.AGAIN, ProposalReason.CONFIRM, ProposalReason.VOID, ProposalReason.DONE),
    ProposalReason.YOURSELF,
)
"""Reasons to propose the same exercise once more: the button *Again* does it."""


def title_of(review: Review) -> str:
    """Return the title of an attempt's exercise, and of which drill it was."""
    title = declared(review.exercise)
    if review.drill is None:
        return title
    return tr("Drill, {drill}: {title}", drill=drill_title(review.drill.kind), title=title)


def facts(review: Review) -> str:
    """Return who, when, how long, in one line."""
    return "  ·  ".join(
        (
            NAMES.shown(ACCESS.shown(review.student)),
            date_text(review.started),
            state_word(review.state),
            clock_text(review.duration),
            tr("control scans: {n}", n=review.scans),
        )
    )
