"""Published odds of what the needle met: folded away, for who wants to know; no part of a score."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton, QVBoxLayout, QWidget

from app.scoring.odds import published_risks
from app.session.review import Review
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr


def published_lines(review: Review) -> tuple[str, ...]:
    """Say what series say of what an attempt's needle met: a line for each source."""
    by_source: dict[str, list[str]] = {}
    for risk in published_risks(review.met):
        by_source.setdefault(risk.source, []).append(risk.statement)
    lines = ((" ".join(statements), source) for source, statements in by_source.items())
    return tuple(f"· {words} ({source})" if source else f"· {words}" for words, source in lines)


class PublishedOdds(QWidget):
    """A button that unfolds the lines; hidden where nothing of it was met.

    Attributes:
        button: folds and unfolds.
        lines: what is unfolded.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.button, self.lines = QToolButton(self), PlainLabel(self)
        self.button.setAutoRaise(True)
        self._unfolded = False
        self.button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.button.setToolTip(
            tr(
                "Rates of published series of patients, with their sources: not the probability "
                "for this patient, and no part of the score"
            )
        )
        self.lines.setWordWrap(True)
        self.lines.setStyleSheet(f"font-size: {theme.SMALL_PX}px;")
        self.lines.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.button)
        column.addWidget(self.lines)
        self.button.clicked.connect(lambda: self._unfold(not self._unfolded))
        self._unfold(False)
        self.hide()

    def show_review(self, review: Review) -> None:
        """Take another attempt, folded."""
        lines = published_lines(review)
        self.button.setText(tr("Published risks of what was met"))
        self.lines.setText("\n".join(lines))
        self._unfold(False)
        self.setVisible(bool(lines))

    def _unfold(self, unfolded: bool) -> None:
        self._unfolded = unfolded
        self.button.setArrowType(Qt.ArrowType.DownArrow if unfolded else Qt.ArrowType.RightArrow)
        self.lines.setVisible(unfolded)
