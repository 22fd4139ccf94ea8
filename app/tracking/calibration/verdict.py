"""Whether a calibration of two cameras is good enough: one rule for window and command line.

Limits grow with the rig: errors of the boards held back count against their distance from the
cameras, residuals against the pictures' width. Boards held back lie where the others lay: what they
say holds there. So the rays are asked, too, where in the pictures the marker comes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.tracking.calibration.checks import Check
from app.tracking.calibration.fit_together import apart
from app.tracking.calibration.ray_error import at_pixels
from app.tracking.optics.calibration import StereoCalibration

GOOD_SHARE: Final = 1e-3
WORST_SHARE: Final = 3e-3
"""Error of corners on pairs held back over the boards' distance: up to the first it is good, above
the second of no use: 0.3 and 0.9 mm at 30 cm."""

USUAL_DISTANCE_MM: Final = 300.0
"""How far away a marker usually is: what an error of the rays comes to is told there."""

GOOD_PX: Final = 0.6
WORST_PX: Final = 1.5
"""Residuals in a picture `USUAL_WIDTH` wide; larger pictures have larger pixels' worth of them."""

USUAL_WIDTH: Final = 640

GOOD_SCALE: Final = 0.003
"""Relative error of lengths on pairs held back."""


REGION_QUANTILE: Final = 0.95
ANYWHERE_QUANTILE: Final = 0.75
"""Share of the places at which rays must be known so well: where the marker comes, or of all of the
picture where that is not known."""

_PLACES: Final = 33


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
    RAYS_BAD = "rays_bad"
    APART = "apart"
    ROLLING = "rolling"
    UNCHECKED = "unchecked"
    RAYS = "rays"
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


Region = tuple[FloatArray, FloatArray]
"""Outlines in the left and the right picture, (n, 2) each [px]; may reach beyond them."""


def judge(
    calibration: StereoCalibration, checks: Sequence[Check] = (), region: Region | None = None
) -> Judgement:
    """Say whether a calibration is good enough to use, and why.

    Args:
        calibration: two cameras.
        checks: lengths known otherwise, if any were given.
        region: where in the pictures the marker comes; anywhere if None.
    """
    against = next((check for check in checks if not check.passed), None)
    if against is not None:
        return Judgement(
            Grade.NOT_GOOD_ENOUGH,
            Why.CONTRADICTED,
            sentence(
                "a length that is known contradicts it: {against_text}", against_text=against.text
            ),
        )
    fit = _of_fit(calibration)
    rays = _of_rays(calibration, region)
    if rays is None or list(Why).index(fit.why) < list(Why).index(rays.why):
        return fit
    return rays


def _of_rays(calibration: StereoCalibration, region: Region | None) -> Judgement | None:
    """Judge how sure the rays are where they are needed; None if sure enough, or not known."""
    worst: tuple[float, float, str] | None = None
    for side, camera in enumerate(calibration.cameras):
        if camera.ray_sd_px is None:
            continue
        pixels = _inside(camera.image_size, None if region is None else region[side])
        if not len(pixels):
            continue
        sds = at_pixels(camera.ray_sd_px, camera.image_size, pixels)
        sd = float(np.quantile(sds, ANYWHERE_QUANTILE if region is None else REGION_QUANTILE))
        share = float(np.sqrt(2.0) * sd / np.mean(camera.focal_px))
        if worst is None or share > worst[0]:
            worst = (share, sd, camera.name)
    if worst is None or worst[0] <= GOOD_SHARE:
        return None
    share, sd, name = worst
    where = (
        sentence("where the marker comes")
        if region is not None
        else sentence("in a quarter of its picture")
    )
    mm, good = (part * USUAL_DISTANCE_MM for part in (share, GOOD_SHARE))
    text = sentence(
        "{name}: {where} its rays are known to ± {sd:.2g} px only, {mm:.2g} mm at "
        "{usual_distance_mm:.0f} mm ({good:.2g} mm is good): the board was not seen there; "
        "show it there too, up to the edges",
        name=name,
        where=where,
        sd=sd,
        mm=mm,
        usual_distance_mm=USUAL_DISTANCE_MM,
        good=good,
    )
    if share > WORST_SHARE and region is not None:
        return Judgement(Grade.NOT_GOOD_ENOUGH, Why.RAYS_BAD, text)
    return Judgement(Grade.USABLE, Why.RAYS, text)


def _inside(size: tuple[int, int], outline: FloatArray | None) -> FloatArray:
    """Pixels on a grid inside the picture, and inside the outline if there is one, (n, 2)."""
    u, v = (np.linspace(0.0, side - 1.0, _PLACES) for side in size)
    pixels = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
    if outline is None or len(outline) < 3:
        return pixels if outline is None else pixels[:0]
    ends = np.roll(outline, -1, axis=0)
    edge, way = ends - outline, pixels[:, None] - outline[None]
    turn = edge[None, :, 0] * way[:, :, 1] - edge[None, :, 1] * way[:, :, 0]
    return np.asarray(pixels[(turn >= 0.0).all(axis=1) | (turn <= 0.0).all(axis=1)])


def _of_fit(calibration: StereoCalibration) -> Judgement:
    rms, checked = calibration.rms_px, calibration.validation
    wide = max(1.0, calibration.cameras[0].image_size[0] / USUAL_WIDTH)
    flat = sentence(
        "glue the board on something flat, take sharper pictures, check its counts and sizes"
    )
    if rms > WORST_PX * wide:
        text = sentence(
            "residual of {rms:.2f} px, at most {worst_px:.2g} px: {flat}",
            rms=rms,
            worst_px=WORST_PX * wide,
            flat=flat,
        )
        return Judgement(Grade.NOT_GOOD_ENOUGH, Why.RESIDUAL_BAD, text)
    if checked is not None:
        away = checked.distance_mm
        share = checked.rms_mm / away
        held = sentence(
            "pairs held back are wrong by {checked_rms_mm:.2f} mm RMS at {away:.0f} mm",
            checked_rms_mm=checked.rms_mm,
            away=away,
        )
        if share > WORST_SHARE:
            text = sentence(
                "{held}, at most {worst_share:.2g} mm: {flat}",
                held=held,
                worst_share=WORST_SHARE * away,
                flat=flat,
            )
            return Judgement(Grade.NOT_GOOD_ENOUGH, Why.ERROR_BAD, text)
    if calibration.together is not None and apart(calibration.together):
        text = sentence(
            "the pairs do not belong together: hold the board still while both cameras look, "
            "fix the cameras, and take them again"
        )
        return Judgement(Grade.USABLE, Why.APART, text)
    rolling = [c for c in calibration.cameras if c.rolling_px is not None]
    if rolling:
        named = " and ".join(f"{camera.name} ({camera.rolling_px:.2g} px)" for camera in rolling)
        text = sentence(
            "rolling shutter: the board moved while the pictures of {named} were read row by "
            "row, which makes focal length and distances wrong and hardly shows in the "
            "residual: hold the board against something still, and take them again",
            named=named,
        )
        return Judgement(Grade.USABLE, Why.ROLLING, text)
    if checked is None:
        text = sentence("it fits, but no pair was held back to check it: take at least eight pairs")
        return Judgement(Grade.USABLE, Why.UNCHECKED, text)
    better = sentence("more and sharper views will do better")
    if rms > GOOD_PX * wide:
        text = sentence(
            "residual of {rms:.2f} px, {good_px:.2g} px is good: {better}",
            rms=rms,
            good_px=GOOD_PX * wide,
            better=better,
        )
        return Judgement(Grade.USABLE, Why.RESIDUAL, text)
    if share > GOOD_SHARE:
        text = sentence(
            "{held}, {good_share:.2g} mm is good: {better}",
            held=held,
            good_share=GOOD_SHARE * away,
            better=better,
        )
        return Judgement(Grade.USABLE, Why.ERROR, text)
    if abs(checked.scale - 1.0) > max(GOOD_SCALE, 3.0 * checked.scale_sd):
        text = sentence(
            "lengths on pairs held back are {checked_scale:.4f} times the true ones: {better}",
            checked_scale=checked.scale,
            better=better,
        )
        return Judgement(Grade.USABLE, Why.LENGTHS, text)
    return Judgement(
        Grade.GOOD, Why.RIGHT, sentence("pairs that took no part come out right: {held}", held=held)
    )
