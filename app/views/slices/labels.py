"""Where the names of marks stand: inside the pane, off each other, off the needle and the path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Rect = tuple[float, float, float, float]
"""Left, top, width and height [px]."""

GAP_PX = 4.0
CLEAR_PX = 3.0
"""How far a label stays off points that it should not cover."""

OUTSIDE, COVERED_LABEL, COVERED_MARK, COVERED_LINE, SAME_PLACE = 400.0, 100.0, 40.0, 2.0, -1.5
BAD = 20.0
"""Cost from which a label that can be done without is left out."""


@dataclass(frozen=True, slots=True)
class Wanted:
    """A label that wants a place.

    Attributes:
        x, y: middle of its mark in the pane [px].
        width, height: of the text [px].
        radius: of the mark [px].
        last: place (number of the candidate) it had before, kept where nothing speaks against it.
        optional: whether it may be left out where there is no good place.
    """

    x: float
    y: float
    width: float
    height: float
    radius: float
    last: int = 0
    optional: bool = False


@dataclass(frozen=True, slots=True)
class Placed:
    """A label's rectangle in the pane [px], and which of the candidates it is."""

    rect: Rect
    place: int


def arrange(
    wanted: Sequence[Wanted],
    pane: tuple[float, float],
    lines: Sequence[tuple[float, float]] = (),
) -> list[Placed | None]:
    """Give each label its best place, the first ones first.

    Args:
        wanted: labels, the most important first.
        pane: width and height [px].
        lines: points of lines that should stay free [px].

    Returns:
        A place for each; None where the mark lies outside the pane, or no good place is left.
    """
    placed: list[Placed | None] = []
    for label in wanted:
        if not (0.0 <= label.x <= pane[0] and 0.0 <= label.y <= pane[1]):
            placed.append(None)
            continue
        others = [(mark.x, mark.y, mark.radius) for mark in wanted if mark is not label]
        taken = [other.rect for other in placed if other is not None]
        costs = [
            _cost(rect, number, label, pane, taken, others, lines)
            for number, rect in enumerate(_candidates(label))
        ]
        best = min(range(len(costs)), key=costs.__getitem__)
        rect = _inside(_candidates(label)[best], pane)
        placed.append(None if label.optional and costs[best] >= BAD else Placed(rect, best))
    return placed


def _candidates(label: Wanted) -> list[Rect]:
    """Right, left, above and below, each near the mark; the first is the one liked best."""
    w, h, r = label.width, label.height, label.radius + GAP_PX
    right, left, middle = label.x + r, label.x - r - w, label.x - w / 2
    up, down, level = label.y - h - GAP_PX, label.y + GAP_PX, label.y - h / 2
    return [
        (right, up, w, h), (right, down, w, h), (left, up, w, h), (left, down, w, h),
        (right, level, w, h), (left, level, w, h),
        (middle, label.y - r - h, w, h), (middle, label.y + r, w, h),
        (right, up - h, w, h), (right, down + h, w, h),
        (left, up - h, w, h), (left, down + h, w, h),
    ]  # fmt: skip


def _cost(
    rect: Rect,
    number: int,
    label: Wanted,
    pane: tuple[float, float],
    taken: Sequence[Rect],
    marks: Sequence[tuple[float, float, float]],
    lines: Sequence[tuple[float, float]],
) -> float:
    cost = 0.5 * number + (SAME_PLACE if number == label.last else 0.0)
    if _inside(rect, pane) != rect:
        cost += OUTSIDE
    cost += COVERED_LABEL * sum(_overlap(rect, other) for other in taken)
    cost += COVERED_MARK * sum(_near(rect, x, y, radius) for x, y, radius in marks)
    return cost + COVERED_LINE * sum(_near(rect, x, y, CLEAR_PX) for x, y in lines)


def _inside(rect: Rect, pane: tuple[float, float]) -> Rect:
    x, y, w, h = rect
    return max(0.0, min(x, pane[0] - w)), max(0.0, min(y, pane[1] - h)), w, h


def _overlap(one: Rect, other: Rect) -> bool:
    x, y, w, h = one
    u, v, a, b = other
    return x < u + a and u < x + w and y < v + b and v < y + h


def _near(rect: Rect, x: float, y: float, distance: float) -> bool:
    left, top, w, h = rect
    return left - distance <= x <= left + w + distance and top - distance <= y <= top + h + distance
