"""FormPage of the form of an exercise: what counts, and what scripted skills would score."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from PySide6.QtCore import QPointF, QRectF, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QShowEvent
from PySide6.QtWidgets import QTableWidget, QTableWidgetItem, QWidget

from app.scoring import metrics
from app.views.author.editing import ExerciseEditor, default_tolerance
from app.views.author.page import FormPage, number_of, plain
from app.views.kit import theme
from app.views.kit.parts import PlainLabel, label
from app.views.kit.text import tr

USUAL = (
    *("lateral_error", "depth_error", "angle_error", "path_ratio", "total_time", "target_error"),
    *("risk_breach", "control_scans", "notional_dose"),
)
"""Metrics that stand first in the table."""

BANDS = ("expert", "good", "pass", "zero", "weight")


class SkillsPlot(QWidget):
    """A dot for each attempt's score, a column for each skill, and the line to pass.

    Attributes:
        scores: what is drawn, skill → scores of 0 to 100.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.scores: dict[str, list[float]] = {}
        self._passed: dict[str, float] = {}
        self._pass_mark = 60.0
        self.setFixedHeight(theme.px(140))
        self.setAccessibleName(tr("What scripted skills would score (scripts, not people)"))

    def show_scores(self, rows: Sequence[Mapping[str, Any]], pass_mark: float) -> None:
        """Draw rows of `acus exercise trial --json`; none where nothing is known."""
        self._pass_mark = pass_mark
        self._passed = {row["skill"]: row["share_passed"] for row in rows}
        self.scores = {
            row["skill"]: [score for score in row["scores"] if score is not None] for row in rows
        }
        self.setAccessibleDescription(
            "; ".join(
                f"{name} " + ", ".join(f"{score:.0f}" for score in scores)
                for name, scores in self.scores.items()
            )
        )
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw it."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        line = self.fontMetrics().height()
        left, top, bottom = 2.5 * line, 0.5 * line, self.height() - 2.4 * line
        right = self.width() - 0.5 * line

        def height(score: float) -> float:
            return bottom - (bottom - top) * score / 100.0

        painter.setPen(QColor(theme.TEXT_DIM))
        for score in (0.0, 50.0, 100.0):
            painter.drawText(QPointF(0.0, height(score) + 0.35 * line), f"{score:.0f}")
            painter.drawLine(QPointF(left, height(score)), QPointF(right, height(score)))
        painter.setPen(QPen(QColor(theme.TEXT), 1.0, Qt.PenStyle.DashLine))
        at = height(self._pass_mark)
        painter.drawLine(QPointF(left, at), QPointF(right, at))
        width = (right - left) / max(len(self.scores), 1)
        for number, (name, scores) in enumerate(self.scores.items()):
            column = QRectF(left + number * width, bottom + 0.1 * line, width, 2.2 * line)
            passes = f"{self._passed[name]:.0%} " + tr("pass")
            painter.setPen(QColor(theme.TEXT))
            painter.drawText(column, Qt.AlignmentFlag.AlignHCenter, f"{name}\n{passes}")
            good = self._passed[name] > 0.5
            painter.setBrush(QColor(theme.GOOD if good else theme.BAD))
            painter.setPen(Qt.PenStyle.NoPen)
            step = min(0.5 * line, 0.85 * width / max(len(scores), 1))
            for place, score in enumerate(scores):
                beside = (place - 0.5 * (len(scores) - 1)) * step
                middle = QPointF(column.center().x() + beside, height(score))
                painter.drawEllipse(middle, 0.25 * line, 0.25 * line)
        painter.end()


class ScorePage(FormPage):
    """What counts: bands, weights, hard fails; and what scripted skills would score.

    Signals:
        looked_at(): the page is shown.
    """

    looked_at = Signal()

    def __init__(self, editor: ExerciseEditor) -> None:
        super().__init__(editor, tr("Score"), ("tolerances", "bands", "rules"))
        there = {name: one for name, one in metrics.available().items() if not one.fault}
        first = [name for name in USUAL if name in there]
        self.metrics = {name: there[name] for name in dict.fromkeys((*first, *there))}
        self.bands = QTableWidget(len(self.metrics), 7, self)
        self.bands.setTabKeyNavigation(False)
        heads = [tr("Counts"), tr("expert"), tr("good"), tr("pass"), tr("zero"), tr("weight")]
        heads.append(tr("must"))
        self.bands.setHorizontalHeaderLabels(heads)
        self.bands.setVerticalHeaderLabels(
            [
                f"{one.title} [{one.unit}]" if one.unit else one.title
                for one in self.metrics.values()
            ]
        )
        self.bands.setMinimumHeight(theme.px(250))
        for place, words in enumerate(heads):
            needed = self.bands.fontMetrics().horizontalAdvance(words) + 2 * theme.SPACING
            self.bands.setColumnWidth(place, max(theme.px(50), needed))
        self.bands.verticalHeader().setMaximumWidth(theme.px(230))
        self.bands.itemChanged.connect(self._take)
        self.add(
            ("tolerances",),
            tr("Bands: from “expert” on all points, beyond “zero” none"),
            self.bands,
            lambda _: self._show(),
        )
        self.rows.addWidget(
            PlainLabel(tr("What scripted skills would score (scripts, not people)"))
        )
        self.skills = SkillsPlot(self)
        self.rows.addWidget(self.skills)
        self.tried = label("", "dim")
        self.rows.addWidget(self.tried)
        self.number("rules", "pass_mark")
        self.number("rules", "minimum_tracking")
        self.number("rules", "maximum_pause", within=(0.0, 3600.0, 20.0))
        self.note(("rules",))
        self.drawn = label(
            tr("The rings of “Off the path” are drawn on the CT as you change them."), "dim"
        )
        self.rows.addWidget(self.drawn)

    def inner_words(self, parts: Sequence[str | int]) -> str:
        """Name a metric by its title."""
        known = self.metrics.get(str(parts[0])) if parts else None
        if known is None:
            return super().inner_words(parts)
        return ", ".join(filter(None, (known.title, super().inner_words(parts[1:]))))

    def showEvent(self, event: QShowEvent) -> None:
        """Tell that somebody looks."""
        super().showEvent(event)
        self.looked_at.emit()

    def _show(self) -> None:
        given = self.editor.get("tolerances", default={})
        wrong = {one.field[1] for one in self.editor.problems_at("tolerances") if one.field[1:]}
        with QSignalBlocker(self.bands):
            for row, name in enumerate(self.metrics):
                limits = given.get(name)
                self._flag(row, 0, limits is not None, name in wrong)
                self._flag(row, 6, bool(limits and limits.get("required")), False)
                for place, key in enumerate(BANDS, 1):
                    value = "" if limits is None else limits.get(key, "")
                    self._cell(
                        row, place, plain(value) if value != 0.0 else "0", limits is not None
                    )

    def _flag(self, row: int, place: int, on: bool, wrong: bool) -> None:
        item = self.bands.item(row, place) or QTableWidgetItem()
        item.setFlags(Qt.ItemFlag.ItemIsUserCheckable | Qt.ItemFlag.ItemIsEnabled)
        item.setCheckState(Qt.CheckState.Checked if on else Qt.CheckState.Unchecked)
        item.setText("✖" if wrong else "")
        if item.tableWidget() is None:
            self.bands.setItem(row, place, item)

    def _cell(self, row: int, place: int, text: str, on: bool) -> None:
        item = self.bands.item(row, place) or QTableWidgetItem()
        edited = Qt.ItemFlag.ItemIsEditable | Qt.ItemFlag.ItemIsEnabled
        item.setFlags(edited | Qt.ItemFlag.ItemIsSelectable if on else Qt.ItemFlag.NoItemFlags)
        item.setText(text)
        if item.tableWidget() is None:
            self.bands.setItem(row, place, item)

    def _take(self, item: QTableWidgetItem) -> None:
        name, place = list(self.metrics)[item.row()], item.column()
        on = item.checkState() is Qt.CheckState.Checked
        if place == 0:
            self.editor.put("tolerances", name, value=default_tolerance(name) if on else None)
        elif place == 6:
            self.editor.put("tolerances", name, "required", value=on)
        else:
            value = number_of(item.text().strip())
            self.editor.put("tolerances", name, BANDS[place - 1], value=value)
