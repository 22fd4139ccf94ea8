"""Published odds of what the needle met: folded away, for who wants to know; no part of a score."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton, QVBoxLayout, QWidget

from app.scoring.odds import published_risks
from app.session.review import Review
from app.views.kit.parts import PlainLabel
from app.views.kit.text import tr


def published_lines(review: Review) -> tuple[str, ...]:
    """Say what series say of what an attempt's needle met, a line each with its source."""
    return tuple(f"· {risk.sentence}" for risk in published_risks(review.met))


class PublishedOdds(QWidget):
    """A button that unfolds the lines; hidden where nothing of it was met.

    Attributes:
        button: folds and unfolds.
        lines: what is unfolded.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.button, self.lines = QToolButton(self), PlainLabel(self)
        self.button.setCheckable(True)
        self.button.setAutoRaise(True)
        self.button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.button.setToolTip(
            tr(
                "Rates of published series of patients, with their sources: not the probability "
                "for this patient, and no part of the score"
            )
        )
        self.lines.setWordWrap(True)
        self.lines.setProperty("role", "dim")
        self.lines.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.button)
        column.addWidget(self.lines)
        self.button.toggled.connect(self._fold)
        self._fold(False)
        self.hide()

    def show_review(self, review: Review) -> None:
        """Take another attempt, folded."""
        lines = published_lines(review)
        self.button.setText(tr("Published risks of what was met: {n}", n=len(lines)))
        self.lines.setText("\n".join(lines))
        self.button.setChecked(False)
        self.setVisible(bool(lines))

    def _fold(self, unfolded: bool) -> None:
        self.button.setArrowType(Qt.ArrowType.DownArrow if unfolded else Qt.ArrowType.RightArrow)
        self.lines.setVisible(unfolded)
