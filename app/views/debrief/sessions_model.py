"""Recorded sessions as a table for Qt: one column per fact, sortable by its value."""

from collections.abc import Sequence
from typing import Any, Final

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor

from app.session.summary import BROKEN, Summary
from app.views.debrief.condition_words import facts_of, short_words
from app.views.debrief.page import date_text
from app.views.exercise.readouts import clock_text
from app.views.exercise.state_words import state_word
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.text import tr

Index = QModelIndex | QPersistentModelIndex
SORT_ROLE: Final = Qt.ItemDataRole.UserRole
SUMMARY_ROLE: Final = Qt.ItemDataRole.UserRole + 1
DATE, STUDENT, EXERCISE, SCORE, MADE, STATE, DURATION, NOTE = range(8)
_RIGHT: Final = frozenset({SCORE, DURATION})
_RIGHTWARDS: Final = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
_STATE_LOOKS: Final = {
    "ended": (theme.TEXT, "✔"),
    "aborted": (theme.WARNING, "▲"),
    "unfinished": (theme.WARNING, "▲"),
    "broken": (theme.BAD, "✖"),
}


class SessionsModel(QAbstractTableModel):
    """Read-only table of summaries."""

    def __init__(self) -> None:
        super().__init__()
        self._summaries: tuple[Summary, ...] = ()

    def set_summaries(self, summaries: Sequence[Summary]) -> None:
        """Replace all rows."""
        self.beginResetModel()
        self._summaries = tuple(summaries)
        self.endResetModel()

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Return the number of sessions."""
        return 0 if parent.isValid() else len(self._summaries)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Return the number of columns."""
        return 0 if parent.isValid() else NOTE + 1

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole
    ) -> Any:
        """Titles of the columns, aligned as their cells."""
        if role == Qt.ItemDataRole.TextAlignmentRole and section in _RIGHT:
            return _RIGHTWARDS
        if orientation is not Qt.Orientation.Horizontal or role != Qt.ItemDataRole.DisplayRole:
            return None
        return (
            tr("Date"), tr("Student"), tr("Exercise"), tr("Score"), tr("Made with"), tr("State"),
            tr("Time"),
            tr("Remark"),
        )[section]  # fmt: skip

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Text, colour, alignment, sort key or the summary itself."""
        summary, column = self._summaries[index.row()], index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return cell_text(summary, column)
        if role == SORT_ROLE:
            return sort_key(summary, column)
        if role == SUMMARY_ROLE:
            return summary
        if role == Qt.ItemDataRole.ToolTipRole:
            known = summary.conditions
            under = [f"{name}: {value}" for name, value in facts_of(known)] if known else []
            lines = filter(None, (summary.id, summary.reason, *summary.problems, *under))
            return NAMES.without_names("\n".join(lines), files=True)
        if role == Qt.ItemDataRole.TextAlignmentRole and column in _RIGHT:
            return _RIGHTWARDS
        if role == Qt.ItemDataRole.ForegroundRole and column == STATE:
            return QColor(theme.now(_STATE_LOOKS.get(summary.state, (theme.TEXT, ""))[0]))
        return None


def cell_text(summary: Summary, column: int) -> str:
    """Text of one cell."""
    if column == DATE:
        return date_text(summary.started)
    if column == STUDENT:
        return NAMES.shown(summary.student)
    if column == EXERCISE:
        return exercise_text(summary)
    if column == SCORE:
        return score_text(summary)
    if column == MADE:
        return short_words(summary.conditions)
    if column == STATE:
        symbol = _STATE_LOOKS.get(summary.state, ("", "•"))[1]
        return f"{symbol} {state_word(summary.state)}"
    if column == DURATION:
        return "" if summary.state == BROKEN else clock_text(summary.duration)
    remark = "; ".join(filter(None, (summary.reason, *summary.problems)))
    return NAMES.without_names(remark, files=True)


def exercise_text(summary: Summary) -> str:
    """Title of the exercise, with its version from the second one on."""
    title, known = summary.exercise_title or summary.exercise_id, summary.conditions
    if known is None or known.version < 2:
        return title
    return tr("{title} (version {n})", title=title, n=known.version)


def score_text(summary: Summary) -> str:
    """Points with ✔ or ✖, `void`, or nothing."""
    score = summary.score
    if score is None:
        return ""
    if score.get("void_reason") or score.get("total") is None:
        return tr("void")
    return f"{'✔' if score.get('passed') else '✖'} {float(score['total']):.0f}"


def sort_key(summary: Summary, column: int) -> str | float:
    """Value that a column is sorted by; without a score below every score."""
    if column == DATE:
        return summary.started
    if column == SCORE:
        total = (summary.score or {}).get("total")
        return float(total) if total is not None else -1.0
    if column == DURATION:
        return summary.duration
    return cell_text(summary, column).casefold()
