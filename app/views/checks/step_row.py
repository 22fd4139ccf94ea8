"""One step of the morning check on its page."""

from __future__ import annotations

from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QWidget

from app.session.checks.steps import StepResult, Verdict
from app.views.kit import theme
from app.views.kit.text import tr

LOOKS = {
    Verdict.GOOD: theme.VERDICTS["good"],
    Verdict.WARNING: theme.VERDICTS["warning"],
    Verdict.BAD: theme.VERDICTS["bad"],
    Verdict.WAITING: (theme.TEXT_DIM, "–"),
}
"""Colour and symbol of a verdict."""


class StepRow:
    """Symbol, title, and what was found above what to do."""

    def __init__(self, grid: QGridLayout, row: int, parent: QWidget) -> None:
        self._symbol, self._title = QLabel(parent), QLabel(parent)
        self._text = QLabel(parent)
        self._text.setWordWrap(True)
        self._title.setProperty("role", "heading")
        for column, label in enumerate((self._symbol, self._title, self._text)):
            grid.addWidget(label, row, column)

    def show_step(self, step: StepResult | None) -> None:
        """Show a step; None hides the row."""
        for label in (self._symbol, self._title, self._text):
            label.setVisible(step is not None)
        if step is None:
            return
        colour, symbol = LOOKS[step.verdict]
        self._symbol.setText(symbol)
        self._symbol.setStyleSheet(f"color: {theme.now(colour)};")
        self._title.setText(tr(step.title))
        self._text.setText(f"{step.found}\n→ {step.todo}" if step.todo else step.found)


def line(parent: QWidget) -> QFrame:
    """Return a horizontal line."""
    made = QFrame(parent)
    made.setFrameShape(QFrame.Shape.HLine)
    made.setStyleSheet(f"color: {theme.BORDER};")
    return made
