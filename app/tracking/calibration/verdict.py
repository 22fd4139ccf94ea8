"""Whether a calibration of two cameras is good enough: one rule for window and command line.

Limits grow with the rig: errors of the boards held back count against their distance from the
cameras, residuals against the pictures' width.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

from app.tracking.calibration.checks import Check
from app.tracking.calibration.fit_together import apart
from app.tracking.optics.calibration import StereoCalibration

GOOD_SHARE: Final = 1e-3
WORST_SHARE: Final = 3e-3
"""Error of corners on pairs held back over the boards' distance: up to the first it is good, above
the second of no use: 0.3 and 0.9 mm at 30 cm."""

USUAL_DISTANCE_MM: Final = 300.0
"""Taken where an older file does not say how far away its boards were."""

GOOD_PX: Final = 0.6
WORST_PX: Final = 1.5
"""Residuals in a picture `USUAL_WIDTH` wide; larger pictures have larger pixels' worth of them."""

USUAL_WIDTH: Final = 640

GOOD_SCALE: Final = 0.003
"""Relative error of lengths on pairs held back."""


class Grade(StrEnum):
    """How good a calibration is."""

    GOOD = "good"
    USABLE = "usable"
    NOT_GOOD_ENOUGH = "not good enough"


class Why(StrEnum):
    """What decides on the grade; the worst first."""

    CONTRADICTED = "contradicted"
    RESIDUAL_BAD = "residual_bad"
    ERROR_BAD = "error_bad"
    APART = "apart"
    UNCHECKED = "unchecked"
    RESIDUAL = "residual"
    ERROR = "error"
    LENGTHS = "lengths"
    RIGHT = "right"


@dataclass(frozen=True, slots=True)
class Judgement:
    """A grade and its reason.

    Attributes:
        grade: how good.
        why: for programs.
        text: for people, with what to do.
    """

    grade: Grade
    why: Why
    text: str


def judge(calibration: StereoCalibration, checks: Sequence[Check] = ()) -> Judgement:
    """Say whether a calibration is good enough to use, and why.

    Args:
        calibration: two cameras.
        checks: lengths known otherwise, if any were given.
    """
    against = next((check for check in checks if not check.passed), None)
    if against is not None:
        return Judgement(
            Grade.NOT_GOOD_ENOUGH,
            Why.CONTRADICTED,
            f"a length that is known contradicts it: {against.text}",
        )
    return _of_fit(calibration)


def _of_fit(calibration: StereoCalibration) -> Judgement:
    rms, checked = calibration.rms_px, calibration.validation
    wide = max(1.0, calibration.cameras[0].image_size[0] / USUAL_WIDTH)
    flat = "glue the board on something flat, take sharper pictures, check its counts and sizes"
    if rms > WORST_PX * wide:
        text = f"residual of {rms:.2f} px, at most {WORST_PX * wide:.2g} px: {flat}"
        return Judgement(Grade.NOT_GOOD_ENOUGH, Why.RESIDUAL_BAD, text)
    if checked is not None:
        away = checked.distance_mm or USUAL_DISTANCE_MM
        share = checked.rms_mm / away
        held = f"pairs held back are wrong by {checked.rms_mm:.2f} mm RMS at {away:.0f} mm"
        if share > WORST_SHARE:
            text = f"{held}, at most {WORST_SHARE * away:.2g} mm: {flat}"
            return Judgement(Grade.NOT_GOOD_ENOUGH, Why.ERROR_BAD, text)
    if calibration.together is not None and apart(calibration.together):
        text = (
            "the pairs do not belong together: hold the board still while both cameras look, fix "
            "the cameras, and take them again"
        )
        return Judgement(Grade.USABLE, Why.APART, text)
    if checked is None:
        text = "it fits, but no pair was held back to check it: take at least eight pairs"
        return Judgement(Grade.USABLE, Why.UNCHECKED, text)
    better = "more and sharper views will do better"
    if rms > GOOD_PX * wide:
        text = f"residual of {rms:.2f} px, {GOOD_PX * wide:.2g} px is good: {better}"
        return Judgement(Grade.USABLE, Why.RESIDUAL, text)
    if share > GOOD_SHARE:
        text = f"{held}, {GOOD_SHARE * away:.2g} mm is good: {better}"
        return Judgement(Grade.USABLE, Why.ERROR, text)
    if abs(checked.scale - 1.0) > max(GOOD_SCALE, 3.0 * checked.scale_sd):
        text = f"lengths on pairs held back are {checked.scale:.4f} times the true ones: {better}"
        return Judgement(Grade.USABLE, Why.LENGTHS, text)
    return Judgement(Grade.GOOD, Why.RIGHT, f"pairs that took no part come out right: {held}")
