"""Where the names of marks stand: inside the pane, off each other, off the needle and the path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray

Rect = tuple[float, float, float, float]
"""Left, top, width and height [px]."""

GAP_PX = 4.0
CLEAR_PX = 3.0
"""How far a label stays off points that it should not cover."""

OUTSIDE, COVERED_LABEL, COVERED_MARK, COVERED_LINE, SAME_PLACE = 400.0, 100.0, 40.0, 2.0, -1.5
BAD = 20.0
"""Cost from which a label that can be done without is left out."""
STEP_PX = 6.0
"""How finely places are tried away from the mark."""


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
class PlacedLabel:
    """A label's rectangle in the pane [px], and which of the candidates it is."""

    rect: Rect
    place: int


def arrange(
    wanted: Sequence[Wanted],
    pane: tuple[float, float],
    lines: ArrayLike = (),
    taken: Sequence[Rect] = (),
    names: Sequence[Rect] = (),
) -> list[PlacedLabel | None]:
    """Give each label its best place, the first ones first.

    Args:
        wanted: labels, the most important first.
        pane: width and height [px].
        lines: points of lines that should stay free [px], shape (n, 2).
        taken: places of other words [px], which no label covers.
        names: places of words [px] that a label covers only where there is no other place.

    Returns:
        A place for each; None where the mark lies outside the pane, or no good place is left: for
        an optional label, or beside `taken`.
    """
    if not wanted:
        return []
    labels = np.array([(w.x, w.y, w.width, w.height, w.radius) for w in wanted]).T
    rects = _candidates(labels)
    costs = _costs(wanted, labels, rects, pane, np.asarray(lines, np.float64).reshape(-1, 2))
    for words in (*taken, *names):
        costs += COVERED_LABEL * _overlap(rects, words)
    placed: list[PlacedLabel | None] = []
    for number, label in enumerate(wanted):
        if not (0.0 <= label.x <= pane[0] and 0.0 <= label.y <= pane[1]):
            placed.append(None)
            continue
        choices, own = rects[:, number], costs[number]
        for other in placed:
            if other is not None:
                own += COVERED_LABEL * _overlap(choices, other.rect)
        best = int(np.argmin(own))
        x, y, w, h = choices[:, best].tolist()
        rect = max(0.0, min(x, pane[0] - w)), max(0.0, min(y, pane[1] - h)), w, h
        others = [one.rect for one in placed if one is not None]
        found: Rect | None = rect
        if (label.optional and own[best] >= BAD) or w > pane[0] or h > pane[1]:
            found = None
        elif _covers(rect, taken):
            found = _nearest_free(label, pane, [*taken, *others])
        elif _covers(rect, others):
            found = _nearest_free(label, pane, [*taken, *others]) or rect
        placed.append(None if found is None else PlacedLabel(found, best))
    return placed


def _covers(rect: Rect, others: Sequence[Rect]) -> bool:
    own = np.array(rect)
    return any(_overlap(own, other) for other in others)


def _nearest_free(label: Wanted, pane: tuple[float, float], taken: Sequence[Rect]) -> Rect | None:
    """Return the place in the pane that covers nothing taken, nearest to the mark; None if none."""
    spare = pane[0] - label.width, pane[1] - label.height
    x, y = (np.linspace(0.0, most, 1 + ceil(most / STEP_PX)) for most in spare)
    left, top = (axis.ravel() for axis in np.meshgrid(x, y))
    sizes = np.full(len(left), label.width), np.full(len(left), label.height)
    rects = np.stack([left, top, *sizes])
    free = ~np.any([_overlap(rects, other) for other in taken], axis=0)
    if not free.any():
        return None
    middle = left + label.width / 2 - label.x, top + label.height / 2 - label.y
    best = int(np.argmin(np.where(free, np.hypot(*middle), np.inf)))
    return float(left[best]), float(top[best]), label.width, label.height


_SIDE = np.array([1, 1, -1, -1, 1, -1, 0, 0, 1, 1, -1, -1])
"""Right of the mark, left of it, or in its middle: the first candidate is the one liked best."""

_BACK = np.where(_SIDE > 0, 0.0, np.where(_SIDE < 0, -1.0, -0.5))
"""Widths by which a rectangle begins before its side."""

_RISE = np.array([-1.0, 0.0, -1.0, 0.0, -0.5, -0.5, -1.0, 0.0, -2.0, 1.0, -2.0, 1.0])
"""Heights by which a rectangle begins below the mark."""

_GAPS = np.array([-1, 1, -1, 1, 0, 0, 0, 0, -1, 1, -1, 1])
_RADII = np.array([0, 0, 0, 0, 0, 0, -1, 1, 0, 0, 0, 0])
_LIKED = 0.5 * np.arange(len(_SIDE))


def _candidates(labels: FloatArray) -> FloatArray:
    """Left, top, width and height of each label's candidates, shape (4, labels, candidates)."""
    x, y, w, h, radius = labels[:, :, None]
    r = radius + GAP_PX
    left = x + r * _SIDE + w * _BACK
    top = y + h * _RISE + GAP_PX * _GAPS + r * _RADII
    return np.stack([left, top, np.broadcast_to(w, left.shape), np.broadcast_to(h, left.shape)])


def _costs(
    wanted: Sequence[Wanted],
    labels: FloatArray,
    rects: FloatArray,
    pane: tuple[float, float],
    lines: FloatArray,
) -> FloatArray:
    """Cost of each candidate, shape (labels, candidates), whatever the other labels choose."""
    left, top, w, h = rects
    cut = (left < 0.0) | (top < 0.0) | (left + w > pane[0]) | (top + h > pane[1])
    costs: FloatArray = _LIKED + OUTSIDE * cut
    costs += COVERED_LINE * _covered(rects, lines.T, CLEAR_PX).sum(axis=2)
    marks = _covered(rects, labels[:2], labels[4])
    for number, label in enumerate(wanted):
        costs[number, label.last] += SAME_PLACE
        marks[number, :, number] = False  # its own
    return costs + COVERED_MARK * marks.sum(axis=2)


def _covered(rects: FloatArray, points: FloatArray, reach: FloatArray | float) -> NDArray[np.bool_]:
    """Return which points, shape (2, n), each candidate covers, or nearly so."""
    left, top, w, h = rects[..., None]
    x, y = points
    across = (left - reach <= x) & (x <= left + w + reach)
    return across & (top - reach <= y) & (y <= top + h + reach)


def _overlap(rects: FloatArray, other: Rect) -> NDArray[np.bool_]:
    """Return whether each rectangle covers part of another one."""
    x, y, w, h = rects
    u, v, a, b = other
    return (x < u + a) & (u < x + w) & (y < v + b) & (v < y + h)
