"""Which pictures of a board to keep: sharp, still, unlike those already kept; and what is missing.

Knows nothing of cameras or windows: it is offered pictures, of one camera or of two at the same
time, and says what to do next. The same pictures in the same order give the same answers.

How many and which views make a good calibration, and what to do to get them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.tracking.calibration.boards import Board
from app.tracking.calibration.corners import find_corners
from app.tracking.calibration.coverage import Attitude, Coverage
from app.tracking.calibration.views import BoardView, Rejection
from app.tracking.errors import CalibrationError

ENOUGH_VIEWS: Final = 15
"""Views of each camera from which a calibration is good."""

ENOUGH_PAIRS: Final = 12
"""Pairs, of which some are held back for validation."""

ENOUGH_COVERED: Final = 0.6
ENOUGH_GROWTH: Final = 1.3
ENOUGH_TILT_DEG: Final = 15.0
"""One camera alone: tilt wanted to each of the four sides."""

ENOUGH_TILT_SPAN_DEG: Final = 20.0
"""Two cameras: from the one side to the other, for both axes; they see the board aslant anyway."""


def missing_words(coverage: Coverage, alone: bool) -> list[str]:
    """Say what a camera's views still lack, one line each.

    Args:
        coverage: of the camera.
        alone: whether it is calibrated by itself: then its picture's corners and tilts to all
            sides are wanted; two cameras see a board aslant, and seldom at every rim.
    """
    lines = []
    if coverage.views:
        lines += _place_words(coverage, alone) + _tilt_words(coverage, alone)
        if coverage.growth < ENOUGH_GROWTH:
            lines.append(sentence("hold the board nearer to the camera, and farther away"))
    count = ENOUGH_VIEWS - len(coverage.views)
    if count > 0:
        lines.append(
            sentence("{count} more pictures of the board, unlike those taken", count=count)
        )
    return lines


def _place_words(coverage: Coverage, alone: bool) -> list[str]:
    bare = coverage.bare_corners()
    if alone and bare:
        return [sentence("{corner} corner of the picture not covered", corner=bare[0])]
    if coverage.covered < ENOUGH_COVERED:
        share = round(100.0 * coverage.covered)
        where = sentence(", nothing near the {corner} corner", corner=bare[0]) if bare else ""
        wanted = round(100.0 * ENOUGH_COVERED)
        return [
            sentence(
                "{share} % of the picture covered, {wanted} % wanted{where}",
                share=share,
                wanted=wanted,
                where=where,
            )
        ]
    return []


def _tilt_words(coverage: Coverage, alone: bool) -> list[str]:
    sides = (("left", "right"), ("upper", "lower"))
    lines: list[str] = []
    for (low, high), (first, second) in zip(coverage.tilts(), sides, strict=True):
        if not alone:
            if high - low < ENOUGH_TILT_SPAN_DEG:
                lines.append(
                    sentence(
                        "tilt the board more: once its {first}, once its {second} side nearer",
                        first=first,
                        second=second,
                    )
                )
        elif high < ENOUGH_TILT_DEG:
            lines.append(
                sentence("tilt the board more: its {second} side towards the camera", second=second)
            )
        elif low > -ENOUGH_TILT_DEG:
            lines.append(
                sentence("tilt the board more: its {first} side towards the camera", first=first)
            )
    return lines


STILL_PX: Final = 2.0
"""Median move of the corners between two pictures in a row below which the board is still."""

BLUR_FACTOR: Final = 1.6
"""Edges wider than this many times the sharpest so far are motion or lost focus."""

BLUR_FLOOR_PX: Final = 2.5
"""Edges that are sharp in any case [px]."""

Images = Sequence[NDArray[Any] | None]
Seen = tuple[BoardView | Rejection | None, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Offer:
    """Answer to what one picture, or two at the same time, show.

    Attributes:
        kept: whether it was kept.
        words: why, or what to do, one line for people.
        seen: of each camera: the view, or why there is none; None without a picture.
    """

    kept: bool
    words: str
    seen: Seen


class ViewCollector:
    """Collects views of a board.

    Args:
        board: which board.
        names: of the cameras, one or two.
        live: pictures follow each other and the board must be held still; False for pictures
            from a folder.
    """

    def __init__(self, board: Board, names: Sequence[str], live: bool = True) -> None:
        if not 1 <= len(names) <= 2:
            raise CalibrationError(
                sentence(
                    "{cameras} cameras were named; one or two can be calibrated",
                    cameras=len(names),
                )
            )
        self.board, self.names, self._live = board, tuple(names), live
        self._kept: list[tuple[BoardView | None, ...]] = []
        self._coverage = [Coverage() for _ in names]
        self._last: list[BoardView | None] = [None for _ in names]
        self._sharpest = [float("inf") for _ in names]

    @property
    def kept(self) -> tuple[tuple[BoardView | None, ...], ...]:
        """Kept views, one per camera; None where a camera did not see the board."""
        return tuple(self._kept)

    @property
    def pairs(self) -> int:
        """Number of kept views that both cameras have."""
        return sum(None not in views for views in self._kept) if len(self.names) == 2 else 0

    def coverage(self, camera: int) -> Coverage:
        """Return what the kept views of a camera cover."""
        return self._coverage[camera]

    def offer(self, images: Images, names: Sequence[str] = ()) -> Offer:
        """Find the board in pictures taken at the same time, and keep them if they are useful.

        `names` of the pictures, one for each camera, go into the views.

        Raises:
            CalibrationError: if there is not one picture (or None) for each camera.
        """
        found = [self._find(image) for image in images]
        if names:
            found = [_called(one, name) for one, name in zip(found, names, strict=True)]
        return self.consider(tuple(found))

    def consider(self, seen: Seen) -> Offer:
        """Keep what was found, if it is useful.

        Raises:
            CalibrationError: if there is not one answer for each camera.
        """
        if len(seen) != len(self.names):
            raise CalibrationError(
                sentence(
                    "{pictures} pictures were given; there are {cameras} cameras: {names}",
                    pictures=len(seen),
                    cameras=len(self.names),
                    names=", ".join(self.names),
                )
            )
        views = [view if isinstance(view, BoardView) else None for view in seen]
        if not any(views):
            self._last = views
            return Offer(False, self._nothing(seen), seen)
        refusal = self._unsteady(views) or self._blurred(views)
        self._last = views
        if refusal:
            return Offer(False, refusal, seen)
        attitudes = [Attitude.of(view) if view is not None else None for view in views]
        if not self._new(views, attitudes):
            return Offer(False, sentence("like one already kept: {next}", next=self._next()), seen)
        self._keep(views, attitudes)
        return Offer(True, f"kept ({len(self._kept)})", seen)

    def drop_last(self) -> None:
        """Take back what was kept last, if anything was."""
        kept = self._kept[:-1]
        self._kept, self._coverage = [], [Coverage() for _ in self.names]
        for views in kept:
            self._keep(views, [Attitude.of(v) if v is not None else None for v in views])

    @property
    def missing(self) -> tuple[str, ...]:
        """Return what is still missing, the most useful first; empty once there is enough."""
        lines = []
        for i, name in enumerate(self.names):
            at = f"{name}: " if len(self.names) > 1 else ""
            lines += [
                at + words for words in missing_words(self._coverage[i], alone=len(self.names) == 1)
            ]
        if len(self.names) == 2 and self.pairs < ENOUGH_PAIRS:
            count = ENOUGH_PAIRS - self.pairs
            lines.insert(
                0, f"{count} more pairs: both cameras see the board, unlike in the pairs taken"
            )
        return tuple(lines)

    @property
    def enough(self) -> bool:
        """Return whether a good calibration can be expected."""
        return not self.missing

    @property
    def progress(self) -> float:
        """Return how near to enough, from 0 to 1."""
        parts = [min(1.0, len(c.views) / ENOUGH_VIEWS) for c in self._coverage]
        parts += [min(1.0, c.covered / ENOUGH_COVERED) for c in self._coverage]
        if len(self.names) == 2:
            parts.append(min(1.0, self.pairs / ENOUGH_PAIRS))
        share = float(np.mean(parts))
        return 1.0 if self.enough else min(0.99, share)

    # --- inside -----------------------------------------------------------------------------------
    def _find(self, image: NDArray[Any] | None) -> BoardView | Rejection | None:
        return None if image is None else find_corners(image, self.board, thorough=not self._live)

    def _keep(
        self, views: Sequence[BoardView | None], attitudes: Sequence[Attitude | None]
    ) -> None:
        self._kept.append(tuple(views))
        for i, (view, attitude) in enumerate(zip(views, attitudes, strict=True)):
            if view is not None and attitude is not None:
                self._coverage[i] = self._coverage[i].adding(view, attitude)

    def _new(self, views: Sequence[BoardView | None], attitudes: Sequence[Attitude | None]) -> bool:
        """Return whether any camera sees something new; a first pair of a known view is new,
        too.
        """
        fresh = [
            attitude is not None and not self._coverage[i].knows(attitude)
            for i, attitude in enumerate(attitudes)
        ]
        if len(views) == 2 and None not in views and not any(fresh):
            return not self._pair_known(attitudes)
        return any(fresh)

    def _pair_known(self, attitudes: Sequence[Attitude | None]) -> bool:
        for kept in self._kept:
            if None in kept:
                continue
            others = [Attitude.of(view) for view in kept if view is not None]
            if all(
                a is not None and b is not None and a.alike(b)
                for a, b in zip(attitudes, others, strict=True)
            ):
                return True
        return False

    def _unsteady(self, views: Sequence[BoardView | None]) -> str:
        if not self._live:
            return ""
        for view, last in zip(views, self._last, strict=True):
            if view is None:
                continue
            if last is None:
                return sentence("hold the board still")
            common, here, there = np.intersect1d(view.ids, last.ids, return_indices=True)
            moved = np.linalg.norm(view.pixels[here] - last.pixels[there], axis=1)
            if not common.size or float(np.median(moved)) > STILL_PX:
                return sentence("hold the board still")
        return ""

    def _blurred(self, views: Sequence[BoardView | None]) -> str:
        for i, view in enumerate(views):
            if view is None:
                continue
            limit = max(BLUR_FLOOR_PX, BLUR_FACTOR * self._sharpest[i])
            if view.sharpness > limit:
                return sentence(
                    "{names}: blurred, edges {view_sharpness:.1f} px wide (at most "
                    "{limit:.1f}): more light, hold still, focus",
                    names=self.names[i],
                    view_sharpness=view.sharpness,
                    limit=limit,
                )
            self._sharpest[i] = min(self._sharpest[i], view.sharpness)
        return ""

    def _nothing(self, seen: Seen) -> str:
        lines = [
            f"{name}: {view.text}"
            for name, view in zip(self.names, seen, strict=True)
            if isinstance(view, Rejection)
        ]
        return lines[0] if lines else "no picture"

    def _next(self) -> str:
        missing = self.missing
        return missing[0] if missing else sentence("there are enough views")


def _called(result: BoardView | Rejection | None, name: str) -> BoardView | Rejection | None:
    return replace(result, name=name) if result is not None else None
