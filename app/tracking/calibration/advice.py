"""How many and which views make a good calibration, and what to do to get them."""

from typing import Final

from app.tracking.calibration.coverage import Coverage

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
            lines.append("hold the board nearer to the camera, and farther away")
    count = ENOUGH_VIEWS - len(coverage.views)
    if count > 0:
        lines.append(f"{count} more pictures of the board, unlike those taken")
    return lines


def _place_words(coverage: Coverage, alone: bool) -> list[str]:
    bare = coverage.bare_corners()
    if alone and bare:
        return [f"{bare[0]} corner of the picture not covered"]
    if coverage.covered < ENOUGH_COVERED:
        share = round(100.0 * coverage.covered)
        where = f", nothing near the {bare[0]} corner" if bare else ""
        wanted = round(100.0 * ENOUGH_COVERED)
        return [f"{share} % of the picture covered, {wanted} % wanted{where}"]
    return []


def _tilt_words(coverage: Coverage, alone: bool) -> list[str]:
    sides = (("left", "right"), ("upper", "lower"))
    lines = []
    for (low, high), (first, second) in zip(coverage.tilts(), sides, strict=True):
        if not alone:
            if high - low < ENOUGH_TILT_SPAN_DEG:
                lines.append(
                    f"tilt the board more: once its {first}, once its {second} side nearer"
                )
        elif high < ENOUGH_TILT_DEG:
            lines.append(f"tilt the board more: its {second} side towards the camera")
        elif low > -ENOUGH_TILT_DEG:
            lines.append(f"tilt the board more: its {first} side towards the camera")
    return lines
