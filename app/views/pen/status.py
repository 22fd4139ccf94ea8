"""How the pen is: the sentence about its accuracy, and lines below it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.views.kit import theme
from app.views.kit.parts import PlainLabel, label
from app.views.kit.text import tr
from app.views.kit.verdict import tell
from app.views.pen.words import Line


class Lines(QWidget):
    """Lines with their verdicts; room for `most`, so that nothing below them jumps."""

    def __init__(self, most: int, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._labels = [label() for _ in range(most)]
        self._shown: tuple[Line, ...] = ()
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(3)
        for one in self._labels:
            one.setMinimumHeight(theme.FONT_PX + 5)
            rows.addWidget(one)

    @property
    def text(self) -> str:
        """All lines."""
        return "\n".join(line.text for line in self._shown)

    def show_lines(self, lines: Sequence[Line]) -> None:
        """Show these; more than there is room for are left out."""
        shown = tuple(lines)[: len(self._labels)]
        if shown == self._shown:
            return
        self._shown = shown
        for i, one in enumerate(self._labels):
            if i < len(shown):
                tell(one, shown[i].verdict, shown[i].text)
            else:
                one.clear()


class PenStatus(QWidget):
    """Accuracy in one large sentence, and what is seen."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.accuracy, self.lines = PlainLabel(self), Lines(5, self)
        self.accuracy.setProperty("role", "title")
        self.accuracy.setWordWrap(True)
        self.accuracy.setMinimumHeight(round(2.6 * theme.TITLE_PX))
        self.accuracy.setToolTip(
            tr(
                "Radius round the shown tip that holds the true one in 95 of 100 cases: noise, "
                "print, lens and the tip's own place are all in it"
            )
        )
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.addWidget(self.accuracy)
        rows.addWidget(self.lines)

    def show_status(self, accuracy: Line, lines: Sequence[Line]) -> None:
        """Show the sentence and the lines."""
        colour, symbol = accuracy.verdict.colour_and_symbol
        text = f"{symbol} {accuracy.text}"
        if text != self.accuracy.text():
            self.accuracy.setText(text)
            self.accuracy.setStyleSheet(f"color: {colour};")
        self.lines.show_lines(lines)
