"""How a part is: a verdict with its colour and symbol, and the words that go with it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

from PySide6.QtWidgets import QLabel

from app.views.kit import theme


class Verdict(StrEnum):
    """How a part is."""

    GOOD = "good"
    WARNING = "warning"
    BAD = "bad"
    IDLE = "idle"

    @property
    def colour_and_symbol(self) -> tuple[str, str]:
        """Colour and symbol: never the colour alone."""
        return theme.VERDICTS.get(self.value, (theme.TEXT_DIM, "–"))


@dataclass(frozen=True, slots=True)
class StatusItem:
    """One line of the status strip.

    Attributes:
        verdict: how the part is.
        title: what it is.
        text: its value in words.
        help: what that means, and what to do.
        plain: what is told instead of the value without details; empty for the value.
        detail: whether a student is told of it by the one light of the robot alone.
    """

    verdict: Verdict
    title: str
    text: str
    help: str
    plain: str = ""
    detail: bool = False

    def for_student(self) -> StatusItem:
        """Return the item with its plain words in place of the value, where it has some."""
        return replace(self, text=self.plain) if self.plain else self


def tell(line: QLabel, verdict: Verdict, words: str) -> None:
    """Show words in a verdict's colour, with its symbol."""
    colour, symbol = verdict.colour_and_symbol
    line.setText(f"{symbol} {words}" if words else "")
    line.setStyleSheet(f"color: {colour};")
