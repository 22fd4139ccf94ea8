"""The card of a debrief: verdict, score, what cost most and why, and what to practise."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QBoxLayout, QFrame, QVBoxLayout, QWidget

from app.core.units import MILLIMETRE
from app.exercises.drill import ROUNDS, DrillKind, asks
from app.scoring.rows import Row
from app.session.planned import plan_sentences
from app.session.review import Review
from app.views.debrief.score_words import (
    ending_words,
    metric_title,
    points_words,
    total_text,
    verdict,
    with_unit,
)
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.parts import BulletLabel, FittingButton, PlainLabel
from app.views.kit.text import literal, tr, translated

STEERED: Final = frozenset({"lateral_error", "angle_error", "path_ratio", "tip_error"})
"""Metrics that a turn in the depth spoils."""

MOST_COSTS: Final = 2
"""So many metrics are told of: who reads more remembers none."""

HELD_BACK: Final = 0.95
"""That the target was missed is told where all else counts less than this."""

LEAST_REST: Final = 0.5
"""Fewer points than this are no rest, but the rounding of the others."""

FULL: Final = 99.5
"""From so many points on all hundred are shown."""

MOST_REASONS: Final = 3
"""So many sentences are told of one."""


_MARGIN, _AROUND = 16, 4
"""Beside what is on the card, and what a label takes round its words [px]."""


@dataclass(frozen=True, slots=True)
class Cost:
    """What cost points, in words.

    Attributes:
        loss: what it was, how much it cost, and from where on it costs none.
        reasons: why, one sentence each; empty where the record does not tell.
    """

    loss: str
    reasons: tuple[str, ...] = ()


def costs(review: Review) -> tuple[Cost, ...]:
    """Return what cost most and why; every number is the attempt's own.

    Empty where nothing was judged, and where nothing cost points. No reason is told twice.
    """
    score = review.score
    if score is None or score.total is None:
        return ()
    share = min((row.gate for row in score.rows if row.weight > 0.0), default=1.0)
    told: set[str] = set()
    result: list[Cost] = []
    for points, row in score.losses[:MOST_COSTS]:
        texts = [translated(text) for text in review.reasons.get(row.name, ())]
        if row.name in STEERED:
            texts += turn_words(review)
        if share < HELD_BACK and not result:
            texts.insert(
                0,
                tr(
                    "The target was missed: all else counts only {share:.0f} %.",
                    share=100.0 * share,
                ),
            )
        fresh = [text for text in texts if text not in told][:MOST_REASONS]
        told.update(fresh)
        result.append(Cost(_loss(points, row), tuple(fresh)))
    return tuple(result)


def turn_words(review: Review) -> tuple[str, ...]:
    """Say where the needle was turned in the depth, and what the turn would have taken earlier."""
    turn = review.correction
    if turn is None:
        return ()
    words = tr(
        "You turned the needle by {angle:.1f}° at {depth:.0f} mm depth.",
        angle=math.degrees(turn.angle),
        depth=turn.depth / MILLIMETRE,
    )
    if turn.share is not None:
        words += " " + tr(
            "The same turn at {earlier:.0f} mm takes {share:.0f} % of the side force.",
            earlier=turn.earlier / MILLIMETRE,
            share=100.0 * turn.share,
        )
    return (words,)


def rest_words(review: Review) -> str:
    """Say how many points went that `costs` does not tell of; empty where it tells of all.

    What is told adds up to the total as it is shown: whole points.
    """
    score = review.score
    if score is None or score.total is None:
        return ""
    named = [points for points, _ in score.losses[:MOST_COSTS]]
    rest = 100 - round(score.total) - sum(round(points) for points in named)
    if not named or rest < 1 or 100.0 - score.total - sum(named) < LEAST_REST:
        return ""
    return tr("The rest cost {points}.", points=points_words(rest))


def plan_words(review: Review) -> tuple[tuple[str, str], ...]:
    """Say what the student's plan is worth where the attempt has no points; texts with a style.

    An attempt with points tells of the plan among what cost some.
    """
    plan, score = review.planned, review.score
    if plan is None or (score is not None and score.total is not None):
        return ()
    head = tr("Your plan itself: {points} of 100.", points=f"{plan.points:.0f}")
    lines = "\n".join(f"•  {translated(text)}" for text in plan_sentences(plan))
    return (head, "font-weight: 600;"), (lines, "")


def _size(row: Row) -> str:
    """Say how large a value is, as it is judged: its sign in words, or not at all."""
    if row.value is None:
        return "–"
    size = with_unit(abs(row.value), row.unit)
    if row.name != "depth_error":
        return size
    return tr("{size} too deep", size=size) if row.value > 0.0 else tr("{size} short", size=size)


def _loss(points: float, row: Row) -> str:
    expert = row.tolerance.knots[0] if row.tolerance else 0.0
    more = row.tolerance is not None and row.tolerance.knots[0] > row.tolerance.knots[2]
    values = {
        "label": metric_title(row),
        "value": _size(row),
        "points": points_words(points),
        "expert": with_unit(expert, row.unit),
    }
    if more:
        return tr("{label}: {value} cost {points}; {expert} or more costs none.", **values)
    return tr("{label}: {value} cost {points}; {expert} or less costs none.", **values)


def drill_title(kind: DrillKind) -> str:
    """Name a drill."""
    return {
        DrillKind.ALIGN: tr("align only"),
        DrillKind.DEPTH: tr("depth only"),
        DrillKind.BREATH: tr("breath"),
        DrillKind.REPEAT: tr("ten times three minutes"),
    }[kind]


def drill_words(kind: DrillKind, rounds: int = 0, aligned: bool = False) -> str:
    """Say what a drill asks for; of one that is repeated also how many rounds are done.

    Args:
        kind: which.
        rounds: how many of it were done today.
        aligned: see `asks`.
    """
    words = translated(asks(kind, aligned))
    if kind is DrillKind.REPEAT and rounds:
        done = min(rounds, ROUNDS)
        rounds_words = tr("Round {n} of {all} is done.", n=done, all=ROUNDS)
        words = f"{rounds_words} {words}"
    return tr("{drill} It counts for no course and no pass.", drill=words)


class DebriefCard(QFrame):
    """What is seen first of an attempt.

    Signals:
        drill_wanted(object): begin this `DrillKind`.

    Attributes:
        verdict, total, reason: of the score.
        ending: where the needle ended.
        costs: what cost most, each with its reasons.
        headline: verdict and total side by side, or one above the other where that is too wide.
        practise: what the drill asks for.
        drill: begins it; hidden where none is offered.
    """

    drill_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.verdict, self.total, self.reason = (PlainLabel(self) for _ in range(3))
        self.ending, self.practise = PlainLabel(self), PlainLabel(self)
        self.costs = QVBoxLayout()
        self._labels: list[PlainLabel] = []
        self.headline = QBoxLayout(QBoxLayout.Direction.LeftToRight)
        self.drill = FittingButton("", self)
        self._kind: DrillKind | None = None
        self.setObjectName("card")
        self.setAccessibleName(tr("Result"))
        self._style()
        self._lay_out()
        self.drill.clicked.connect(self._begin)
        self.offer(None)

    def show_review(self, review: Review) -> None:
        """Write verdict, score, and what cost most."""
        colour, word, why = verdict(review)
        self.verdict.setText(word)
        self.verdict.setStyleSheet(f"color: {colour}; font-size: {theme.TITLE_PX + 6}px;")
        self.total.setText(total_text(review.score, review.said.void))
        self.reason.setText(NAMES.without_names(why))
        self.reason.setVisible(bool(why))
        self.ending.setText(ending_words(review))
        self.ending.setVisible(bool(self.ending.text()))
        self._show_costs(review)
        self._turn()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the headline a second line where there is no room in one."""
        super().resizeEvent(event)
        self._turn()

    def offer(
        self, kind: DrillKind | None, rounds: int = 0, first: bool = True, aligned: bool = False
    ) -> None:
        """Offer a drill; None offers none.

        Args:
            kind: which.
            rounds: how many of it were done today.
            first: whether nothing else comes before it: its button stands out.
            aligned: whether a simulated hand would lead the needle.
        """
        self._kind = kind
        for widget in (self.drill, self.practise):
            widget.setVisible(kind is not None)
        if kind is None:
            return
        words = drill_words(kind, rounds, aligned)
        self.practise.setText(words)
        self.drill.setText(tr("Practise: {drill}", drill=drill_title(kind)))
        self.drill.setToolTip(literal(words))
        self.drill.setAccessibleDescription(words)
        self.drill.setProperty("role", "primary" if first else "")
        self.drill.style().unpolish(self.drill)
        self.drill.style().polish(self.drill)

    @property
    def kind(self) -> DrillKind | None:
        """Return the drill that is offered; None without one."""
        return self._kind

    @property
    def words(self) -> str:
        """Return what is told of the costs, a line each."""
        return "\n".join(label.text() for label in self._labels)

    def _show_costs(self, review: Review) -> None:
        for label in self._labels:
            self.costs.removeWidget(label)
            label.hide()
            label.deleteLater()
        self._labels = []
        score = review.score
        given = costs(review)
        if not given and score is not None and score.total is not None:
            whole = score.total >= FULL
            words = tr("Nothing cost points.") if whole else tr("Nothing cost as much as a point.")
            given = (Cost(words),)
        for cost in given:
            self._add(cost.loss, "font-weight: 600;")
            if cost.reasons:
                self._add("\n".join(f"•  {text}" for text in cost.reasons), "")
        if rest := rest_words(review):
            self._add(rest, "")
        for words, style in plan_words(review):
            self._add(words, style)

    def _add(self, text: str, style: str) -> None:
        label = BulletLabel(text, self)
        label.setStyleSheet(style)
        self.costs.addWidget(label)
        self._labels.append(label)

    def _turn(self) -> None:
        """Lay verdict and total side by side if both fit into the width that there is."""
        widths = []
        for label in (self.verdict, self.total):
            label.ensurePolished()  # its font is that of its style
            widths.append(label.fontMetrics().horizontalAdvance(label.text()) + _AROUND)
        beside = sum(widths) <= self.width() - 2 * _MARGIN - self.headline.spacing()
        direction = QBoxLayout.Direction
        self.headline.setDirection(direction.LeftToRight if beside else direction.TopToBottom)
        for place, width in enumerate(widths):  # each gets its share, so that neither is broken
            self.headline.setStretch(place, width if beside else 0)
        side = Qt.AlignmentFlag.AlignRight if beside else Qt.AlignmentFlag.AlignLeft
        self.total.setAlignment(side | Qt.AlignmentFlag.AlignVCenter)

    def _begin(self) -> None:
        if self._kind is not None:
            self.drill_wanted.emit(self._kind)

    def _style(self) -> None:
        self.setStyleSheet(
            "#card { background: palette(button); border-radius: 8px; } "
            "#card QLabel { background: transparent; }"
        )
        self.total.setStyleSheet(f"font-size: {theme.TITLE_PX}px; font-weight: 600;")
        self.practise.setProperty("role", "dim")
        for label in (self.verdict, self.total, self.reason, self.ending, self.practise):
            label.setWordWrap(True)

    def _lay_out(self) -> None:
        self.headline.addWidget(self.verdict)
        self.headline.addWidget(self.total)
        self.headline.setSpacing(8)
        self.costs.setSpacing(4)
        column = QVBoxLayout(self)
        column.setContentsMargins(_MARGIN, 8, _MARGIN, 16)
        column.setSpacing(8)
        column.addLayout(self.headline)
        column.addWidget(self.reason)
        column.addWidget(self.ending)
        column.addLayout(self.costs)
        column.addWidget(self.drill)
        column.addWidget(self.practise)
