"""Whether pairs belong together: two cameras' fit against that of each picture by itself.

A board that moved between the two pictures of a pair, or a camera that moved between pairs, fits
each camera perfectly and only the two of them badly. The residual grows, but the standard
deviations that follow from it do not hold: they count every corner as independent, while all
corners of a pair err together. The test for lack of fit (Draper and Smith, Applied Regression
Analysis, chapter 2) tells: freeing the board's pose in the right picture takes away 6 unknowns per
pair, so

    MS_lack = (SS_together - SS_alone) / (6 n - 6),   F = MS_lack / MS_alone,

and where F is beyond chance MS_lack, not the residual's variance, is what pairs contribute.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.tracking.calibration.bundle import Adjusted
from app.tracking.calibration.mono import MonoResult
from app.tracking.calibration.poses import board_pose
from app.tracking.calibration.validation import ViewPair
from app.tracking.calibration.views import BoardView
from app.tracking.optics.calibration import FitTogether

CHANCE: Final = 4.0
"""Standard deviations of F about 1 that are still chance."""

APART: Final = 2.0
"""Residual together over that of each picture by itself from which pairs do not belong together."""


def fit_together(
    left: MonoResult, right: MonoResult, pairs: Sequence[ViewPair], adjusted: Adjusted
) -> FitTogether:
    """Compare the fit of pairs with that of their pictures by themselves.

    Args:
        left: the left camera by itself.
        right: the right one.
        pairs: used, in the order of the estimate.
        adjusted: both cameras; its covariance by the residual's variance.
    """
    sides = [
        np.array([_squares(pair[side], mono) for pair in pairs])
        for side, mono in enumerate((left, right))
    ]
    points = [sum(len(pair[side].ids) for pair in pairs) for side in (0, 1)]
    alone_px = [float(np.sqrt(found.sum() / n)) for found, n in zip(sides, points, strict=True)]
    together = sum(float((r**2).sum()) for r in adjusted.residuals[: 2 * len(pairs)])
    alone = float(sum(found.sum() for found in sides))
    lenses = len(left.calibration.estimated) + len(right.calibration.estimated)
    freedom_alone = max(1, 2 * sum(points) - 12 * len(pairs) - lenses)
    freedom_lack = max(1, 6 * len(pairs) - 6)
    lack = max(0.0, together - alone) / freedom_lack
    by_chance = 1.0 + CHANCE * np.sqrt(2.0 / freedom_lack + 2.0 / freedom_alone)
    beyond = lack > by_chance * alone / freedom_alone
    factor = np.sqrt(lack) / max(adjusted.sigma_px, 1e-12) if beyond else 1.0
    return FitTogether(
        alone_px=(alone_px[0], alone_px[1]),
        together_px=float(np.sqrt(together / sum(points))),
        sd_factor=max(1.0, float(factor)),
    )


def together_remarks(result: FitTogether) -> list[str]:
    """Say what the lack of fit is, what makes it, and what was done about it."""
    if result.sd_factor <= 1.0:
        return []
    px = sentence(
        "{together_px:.2f} px against {left_alone_px:.2f} and {right_alone_px:.2f}",
        together_px=result.together_px,
        left_alone_px=result.alone_px[0],
        right_alone_px=result.alone_px[1],
    )
    done = sentence(
        "standard deviations are multiplied by {result_sd_factor:.1f}",
        result_sd_factor=result.sd_factor,
    )
    if apart(result):
        return [
            sentence(
                "the pairs do not belong together: {px} px of each camera by itself; pictures "
                "not taken at the same moment, a board or a camera that moved do that: hold the "
                "board still and take them again; {done}",
                px=px,
                done=done,
            )
        ]
    return [
        sentence(
            "the two cameras fit together less well than each by itself ({px} px): {done}",
            px=px,
            done=done,
        )
    ]


def apart(result: FitTogether) -> bool:
    """Return whether pairs fit together so much worse that they do not belong together."""
    alone = float(np.sqrt(np.mean(np.square(result.alone_px))))
    return result.sd_factor > 1.0 and result.together_px > APART * alone


def _squares(view: BoardView, mono: MonoResult) -> float:
    """Sum of the squared residuals of a picture, its board's pose fitted to it alone [px²].

    A picture that the camera was estimated from has been fitted so already.
    """
    for used, residual in zip(mono.views, mono.adjusted.residuals, strict=True):
        if used is view:
            return float((residual**2).sum())
    parameters: FloatArray = mono.adjusted.state.parameters[0]
    return len(view.ids) * board_pose(view, parameters)[1] ** 2
