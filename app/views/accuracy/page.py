"""What accuracy costs: every choice of the program as a diagram, measured on this computer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QSplitter,
    QTableWidgetItem,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from app.views.accuracy.diagram import Diagram
from app.views.accuracy.sweep_tab import SweepTab
from app.views.kit import theme
from app.views.kit.parts import button, label, table
from app.views.kit.text import listing, literal, tr
from app.views.kit.verdict import Verdict, tell

if TYPE_CHECKING:
    from app.studies.findings import Findings
    from app.studies.kept import Kept

SHOWN_ROWS = 4
"""So many rows of a table are seen at once, however low the window."""

NAME = Qt.ItemDataRole.UserRole


class HardCasesTab(QWidget):
    """Every hard case with its error and its bound, tried on this computer.

    Signals:
        wanted(): try them.
    """

    wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        words = tr(
            "Where a formula is delicate: what is right there, how far off the program is, how far "
            "off it may be, and what happens one step beyond."
        )
        self.run = button(tr("Try them all"))
        self.run.clicked.connect(self.wanted)
        self.said = label()
        self.cases = table(
            (
                tr("Subsystem"),
                tr("Case"),
                tr("Error"),
                tr("Bound"),
                tr("Unit"),
                tr("Beyond the bound"),
                tr("Holds"),
            )
        )
        self.cases.setAccessibleName(tr("Hard cases"))
        head = QHBoxLayout()
        head.addWidget(self.run)
        head.addWidget(self.said, 1)
        column = QVBoxLayout(self)
        column.addWidget(label(words))
        column.addLayout(head)
        column.addWidget(self.cases, 1)

    def show_findings(self, findings: Findings) -> None:
        """Show what a trial of all cases found."""
        (sheet,) = findings.sheets
        places = [
            sheet.columns.index(name)
            for name in ("subsystem", "case", "error", "bound", "unit", "beyond the bound", "holds")
        ]
        self.cases.setRowCount(len(sheet.rows))
        for row, values in enumerate(sheet.rows):
            for column, place in enumerate(places):
                value = values[place]
                text = f"{value:.2g}" if isinstance(value, float) else str(value)
                item = QTableWidgetItem(text)
                item.setToolTip(
                    literal(f"{values[2]}\n{values[3]}")
                )  # the input, and what is right
                self.cases.setItem(row, column, item)
        verdict = Verdict.GOOD if findings.passed else Verdict.BAD
        tell(self.said, verdict, findings.lines[0])


def share_words(share: float) -> str:
    """Say an error as a share of what is noticed."""
    if share >= 2.0:
        return tr("{times:.3g} times", times=share)
    if share >= 0.01:
        return tr("{percent:.0f} %", percent=100.0 * share)
    return tr("{percent:.2g} %", percent=100.0 * share)


class AccuracyPage(QWidget):
    """Studies on the left; on the right the diagram of one, its table, and how it was measured.

    Signals:
        closed(): back to where the user came from.
        wanted(str): a study shall be shown.
        measure_wanted(str): a study shall be measured on this computer.
        source_wanted(bool): the figures of this computer (True), or those kept with the program.
    """

    closed = Signal()
    wanted = Signal(str)
    measure_wanted = Signal(str)
    source_wanted = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.studies = QListWidget(self)
        self.studies.setAccessibleName(tr("Cost of accuracy"))
        self.studies.setMinimumWidth(theme.px(240))
        self.studies.setResizeMode(QListWidget.ResizeMode.Adjust)
        self.studies.setWordWrap(True)
        self.studies.setTextElideMode(Qt.TextElideMode.ElideNone)
        self.studies.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.studies.currentItemChanged.connect(self._choose)
        self.title, self.question, self.verdict = label("", "title"), label(), label("", "dim")
        self.failures = label("", "dim")
        self.source = QComboBox(self)
        self.source.addItem(tr("Measured with this version"), False)
        self.source.addItem(tr("Measured on this computer"), True)
        self.source.setToolTip(tr("Ratios hold on every computer, seconds do not"))
        self.source.activated.connect(lambda _: self.source_wanted.emit(self.source.currentData()))
        self.measure = button(tr("Measure on this computer"))
        self.measure.clicked.connect(lambda: self.measure_wanted.emit(self.name))
        self.diagram = Diagram(self)
        self.ways = table(
            (
                tr("Way"),
                tr("Largest error"),
                tr("Share of what can be noticed"),
                tr("Time"),
                tr("Verdict"),
            )
        )
        self.ways.setAccessibleName(tr("Way"))
        self.hard, self.sweeps = HardCasesTab(), SweepTab()
        self.tabs = QTabWidget(self)
        back = button(tr("Back"))
        back.clicked.connect(self.closed)
        self._lay_out(back)

    def _lay_out(self, back: QWidget) -> None:
        how = QHBoxLayout()
        how.addWidget(self.source)
        how.addWidget(self.measure)
        how.addStretch(1)
        right = QWidget(self)
        column = QVBoxLayout(right)
        for widget in (self.title, self.question):
            column.addWidget(widget)
        column.addLayout(how)
        column.addWidget(self.diagram, 3)
        column.addWidget(self.verdict)
        column.addWidget(self.ways, 2)
        column.addWidget(self.failures)
        sides = QSplitter(Qt.Orientation.Horizontal, self)
        sides.addWidget(self.studies)
        sides.addWidget(right)
        sides.setStretchFactor(1, 1)
        foot = QHBoxLayout()
        foot.addWidget(back)
        foot.addStretch(1)
        rows = QVBoxLayout(self)
        rows.addWidget(label(tr("Cost of accuracy"), "title"))
        self.tabs.addTab(sides, tr("Choices"))
        self.tabs.addTab(self.hard, tr("Hard cases"))
        self.tabs.addTab(self.sweeps, tr("Sweeps"))
        rows.addWidget(self.tabs, 1)
        rows.addLayout(foot)

    def set_measuring(self, on: bool) -> None:
        """Let nothing be measured while something is."""
        why = tr("Something is being measured: wait, or cancel it at the top") if on else ""
        for one in (self.measure, self.hard.run):
            one.setEnabled(not on)
            one.setToolTip(literal(why))

    @property
    def name(self) -> str:
        """Study that is shown; empty for none."""
        item = self.studies.currentItem()
        return str(item.data(NAME)) if item is not None else ""

    def set_studies(self, titles: dict[str, str]) -> None:
        """List the studies by name and title."""
        self.studies.clear()
        for name, title in sorted(titles.items(), key=lambda one: one[1]):
            item = QListWidgetItem(title, self.studies)
            item.setData(NAME, name)
        if self.studies.count():
            self.studies.setCurrentRow(0)

    def choose(self, name: str) -> None:
        """Show a study by its name, if it is there."""
        for row in range(self.studies.count()):
            if self.studies.item(row).data(NAME) == name:
                self.studies.setCurrentRow(row)

    def show_study(self, outcome: Kept, here: bool) -> None:
        """Show a measured study.

        Args:
            outcome: its points.
            here: whether it was measured on this computer.
        """
        study = outcome.result.study
        self.title.setText(study.title)
        self.question.setText(study.question)
        self.source.setCurrentIndex(int(here))
        self.diagram.show_study(outcome)
        self.verdict.setText(self._words(outcome))
        self._fill(outcome)
        reasons = [f"{f.way} ({f.setting}): {f.reason}" for f in outcome.result.failures]
        self.failures.setText(tr("No answer: {ways}", ways="; ".join(reasons)) if reasons else "")
        self.failures.setVisible(bool(reasons))

    def _words(self, outcome: Kept) -> str:
        study = outcome.result.study
        when = tr("Measured {date}, version {version}.", date=outcome.date, version=outcome.version)
        why = outcome.exception.replace("`", "")
        if why:
            return tr(
                "In use: {name}. Exception: {why} {when}",
                name=study.default,
                why=why,
                when=when,
            )
        words = tr("the cheapest method in time whose error goes unnoticed")
        return tr("In use: {name}, {words}. {when}", name=study.default, words=words, when=when)

    def _fill(self, outcome: Kept) -> None:
        from app.studies.rule import noticed_share
        from app.studies.study import duration

        points = outcome.result.summary()
        self.ways.setRowCount(len(points))
        for row, point in enumerate(points):
            marks = [tr("in use")] if point.way == outcome.default else []
            marks += [] if point.within_perception else [tr("noticed")]
            marks += [] if point.within_deadline else [tr("too slow")]
            cells = (
                point.way,
                f"{point.error:.3g}",
                share_words(noticed_share(outcome.result, point.way)),
                duration(point.seconds),
                listing(marks) or tr("keeps both limits"),
            )
            for place, text in enumerate(cells):
                self.ways.setItem(row, place, QTableWidgetItem(text))
        shown = sum(self.ways.rowHeight(row) for row in range(min(SHOWN_ROWS, len(points))))
        head = self.ways.horizontalHeader().sizeHint().height()
        self.ways.setMinimumHeight(head + shown + 2 * self.ways.frameWidth() + theme.SPACING)

    def _choose(self, *_: object) -> None:
        if self.name:
            self.wanted.emit(self.name)
