"""The words round a slice: its corners, the patient's directions on its edges, and the ruler.

None covers another in a slice of any size: where there is no room the least important line goes
first.
"""

from __future__ import annotations

from collections.abc import Iterable, Set
from itertools import combinations

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QWidget

from app.imaging.window import WindowLevel
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.slices.words import PADDING, Line, Overlay, Ruler, Worth, Written

_A = Qt.AlignmentFlag

APART = 6
"""Least gap between words that stand beside each other [px]."""

_LETTERS = (Worth.LETTER, Worth.LETTER, Worth.UPRIGHT_LETTER, Worth.UPRIGHT_LETTER)


def window_line(window: WindowLevel) -> Line:
    """Return the line that says window and level."""
    words = tr("W {width:.0f}  L {level:.0f}", width=window.width, level=window.level)
    return words, Worth.WINDOW


class EdgeWords:
    """Corners, letters and ruler over one slice.

    Attributes:
        title: in the left upper corner.
        window: in the right upper one.
        cursor: in the left lower one.
        slice: in the right lower one.
        letters: at the left, right, top and bottom edge.
        ruler: above `slice`.
    """

    def __init__(self, pane: QWidget) -> None:
        self._pane = pane
        self.title = Overlay(pane, _A.AlignLeft | _A.AlignTop)
        self.window = Overlay(pane, _A.AlignRight | _A.AlignTop)
        self.cursor = Overlay(pane, _A.AlignLeft | _A.AlignBottom)
        self.slice = Overlay(pane, _A.AlignRight | _A.AlignBottom)
        edges = (
            _A.AlignLeft | _A.AlignVCenter,
            _A.AlignRight | _A.AlignVCenter,
            _A.AlignHCenter | _A.AlignTop,
            _A.AlignHCenter | _A.AlignBottom,
        )
        self.letters = tuple(
            Overlay(pane, edge, theme.IMAGE_WARNING, bold=True, larger=3) for edge in edges
        )
        self.ruler = Ruler(pane)

    @property
    def corners(self) -> tuple[Overlay, ...]:
        """Return the four corners."""
        return self.title, self.window, self.cursor, self.slice

    @property
    def texts(self) -> tuple[Overlay, ...]:
        """Return all but the ruler."""
        return (*self.corners, *self.letters)

    @property
    def everything(self) -> tuple[Written, ...]:
        """Return all that is painted, in its order."""
        return (*self.texts, self.ruler)

    def set_letters(self, letters: Iterable[str]) -> None:
        """Write the patient's directions at the left, right, top and bottom edge."""
        for overlay, letter, worth in zip(self.letters, letters, _LETTERS, strict=True):
            overlay.set_lines((letter, worth))

    def arrange(self, ruled: bool, without: Set[Worth] = frozenset()) -> None:
        """Put all where it covers nothing; leave out line by line what finds no room.

        Args:
            ruled: whether there is anything to be measured by the ruler.
            without: lines that are left out even where there is room.
        """
        for overlay in self.texts:
            overlay.leave_out(*(line for line in overlay.lines if line[1] in without))
            overlay.place()
        self.ruler.setVisible(ruled)
        while True:
            self._place_beside()
            going = [(line, one) for one in self._crowded() if (line := one.least) is not None]
            if not going:
                break
            line, one = min(going, key=lambda least: least[0][1])
            one.leave_out(*one.left_out, line)

    def paint(self, painter: QPainter) -> None:
        """Paint all."""
        for one in self.everything:
            one.paint(painter)

    def _place_beside(self) -> None:
        """Let the upper and the lower letter stand between the corners, the ruler above its own."""
        self._place_between(self.letters[2], self.title, self.window)
        self._place_between(self.letters[3], self.cursor, self.slice)
        bar, words = self.ruler.geometry(), self.slice
        base = self._pane.height() - PADDING if words.is_empty else words.pos().y() - 2
        self.ruler.move(self._pane.width() - PADDING - bar.width(), base - bar.height())

    def _place_between(self, letter: Overlay, left: Overlay, right: Overlay) -> None:
        """Put a letter in the middle of the pane, or of the gap between two corners."""
        letter.place()
        if not any(_touch(letter, one) for one in (left, right)):
            return
        begin = PADDING if left.is_empty else left.geometry().right() + 1
        end = self._pane.width() - PADDING if right.is_empty else right.pos().x()
        letter.move((begin + end - letter.geometry().width()) // 2, letter.pos().y())

    def _crowded(self) -> list[Written]:
        """Return what covers another's place, or has none in the pane."""
        shown = [one for one in self.everything if not one.is_empty]
        pane, crowded = self._pane.rect(), set[Written]()
        for one, other in combinations(shown, 2):
            if _touch(one, other):
                crowded |= {one, other}
        return [one for one in shown if one in crowded or not pane.contains(one.geometry())]


def _touch(item: Written, other: Written) -> bool:
    """Return whether two words cover each other, or stand beside each other without a gap."""
    near = item.geometry().adjusted(-APART, 0, APART, 0)
    return not (item.is_empty or other.is_empty) and near.intersects(other.geometry())
