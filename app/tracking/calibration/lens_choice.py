"""Which model of the lens the views ask for.

The five-coefficient model is taken unless a longer one is worth its place twice: by the F test of
nested models at `CHANCE`, and by views that it was not estimated from. The test takes the corners
of a view for independent, which they are not quite (a board that is not flat, blur):
cross-validation by whole views does not. Among longer models that pass, the Bayesian information
criterion decides, n·ln(SS / n) + k·ln(n) (Schwarz 1978).

The longer models are rational (k1 to k6, p1, p2), rational with thin prism (s1 to s4 as well), five
coefficients with thin prism, and fisheye. All of a model's coefficients are estimated. The fisheye
model has no decentring: it is taken where the pictures reach beyond `FISHEYE_ANGLE`, where
polynomials of the tangent run off, and where it fits as the rational one does but for `AS_WELL`.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.stats import f as f_distribution

from app.core.arrays import FloatArray
from app.core.confidence import chi_square_quantile
from app.tracking.calibration.bundle import Adjusted
from app.tracking.calibration.poses import board_pose
from app.tracking.calibration.sightings import AdjustedState
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.distortion import fold_radius, undistort_grid
from app.tracking.optics.lens import LensModel

CHANCE: Final = 1e-3
"""Probability by which a longer model may fit that much better by chance."""

WORTH_A_LOOK: Final = 1e-2
"""The same of the simplest longer models, from which all are tried."""

SURE: Final = 1.0
"""Standard errors by which other views must be better predicted, in the median: one view at the
picture's edge may be predicted far better or worse than all others."""

_PARTS: Final = 4
"""In which views are left out to be predicted."""

FISHEYE_ANGLE: Final = np.deg2rad(60.0)
"""Angle off the axis up to which the rational model is preferred [rad]."""

AS_WELL: Final = 9.5
"""Likelihood ratio by which the rational model, of four parameters more, may fit better by chance:
χ² of four degrees of freedom at 95 %. Beyond it the lens has a decentring that fisheye lacks."""

_EXACT_PX: Final = 1e-6
"""Residual of exact corners, whose differences are no evidence."""

_FIVE: Final = LensModel.BROWN.parameters
_PRISM: Final = ("s1", "s2", "s3", "s4")


@dataclass(frozen=True)
class LensChoice:
    """A model of a lens.

    Attributes:
        lens: the model.
        names: of the parameters that are estimated.
    """

    lens: LensModel
    names: tuple[str, ...]


BROWN: Final = LensChoice(LensModel.BROWN, _FIVE)
RATIONAL: Final = tuple(
    LensChoice(LensModel.RATIONAL, (*_FIVE, *("k4", "k5", "k6")[:count])) for count in (1, 2, 3)
)
THIN_PRISM: Final = LensChoice(LensModel.RATIONAL, (*_FIVE, *_PRISM))
BOTH: Final = LensChoice(LensModel.RATIONAL, LensModel.RATIONAL.parameters)
FISHEYE: Final = LensChoice(LensModel.FISHEYE, LensModel.FISHEYE.parameters)

CHOICES: Final = {
    LensModel.BROWN: (BROWN,),
    LensModel.RATIONAL: (*RATIONAL, THIN_PRISM, BOTH),
    LensModel.FISHEYE: (FISHEYE,),
}

_SIMPLEST: Final = (RATIONAL[0], THIN_PRISM)

Fit = Callable[[Sequence[BoardView], AdjustedState, LensChoice], Adjusted]
"""Estimates a camera with a model from views, from an earlier state."""


def choose_lens(
    views: Sequence[BoardView], usual: Adjusted, fit: Fit, allowed: LensModel | None = None
) -> LensChoice:
    """Choose the model that the views ask for.

    Args:
        views: of one camera, without those that do not belong.
        usual: estimate from these views with five coefficients.
        fit: estimates.
        allowed: choose among this lens' models alone; None for all.
    """
    if allowed is not None and len(CHOICES[allowed]) == 1:
        return CHOICES[allowed][0]
    tried = CHOICES[LensModel.RATIONAL]
    longer = _fitted_all(views, usual.state, fit, _SIMPLEST)
    if allowed is None and all(_chance(usual, longer[c], c) > WORTH_A_LOOK for c in longer):
        return BROWN
    rest = [c for c in (*tried, *([] if allowed is not None else [FISHEYE])) if c not in _SIMPLEST]
    longer |= _fitted_all(views, usual.state, fit, rest)
    if allowed is None:
        passed = {c for c in tried if c in longer and _chance(usual, longer[c], c) < CHANCE}
        longer = {c: found for c, found in longer.items() if c in passed or c is FISHEYE}
        if not passed:
            return BROWN
    best = _best(longer, views) if longer else tried[0]
    if allowed is not None or _predicts_better(views, usual.state, fit, best):
        return best
    return BROWN


def _chance(usual: Adjusted, longer: Adjusted, choice: LensChoice) -> float:
    """Probability of so much better a fit by a longer model, were it not needed (F test)."""
    before, after = (sum(float((r**2).sum()) for r in a.residuals) for a in (usual, longer))
    more = len(choice.names) - len(BROWN.names)
    measured = sum(r.size for r in longer.residuals)
    freedom = measured - len(choice.names) - 6 * len(longer.state.poses)
    noise = max(after / max(1, freedom), _EXACT_PX**2)
    return float(f_distribution.sf(max(0.0, before - after) / more / noise, more, max(1, freedom)))


def criterion(found: Adjusted, choice: LensChoice) -> float:
    """Return how well a model fits, less what each of its coefficients might by chance; smaller is
    better.
    """
    measured = sum(r.size for r in found.residuals)
    squares = sum(float((r**2).sum()) for r in found.residuals)
    mean = max(squares / measured, _EXACT_PX**2)
    return float(measured * np.log(mean) + len(choice.names) * chi_square_quantile(1.0 - CHANCE, 1))


def reach(parameters: FloatArray, views: Sequence[BoardView]) -> float:
    """Return the largest angle off the axis at which a camera saw a corner [rad]."""
    pixels = np.concatenate([view.pixels for view in views])
    lens = parameters[4:]
    rays, exist = undistort_grid(pixels, parameters[:4], lens, fold_radius(lens))
    return float(np.arctan(np.linalg.norm(rays[exist], axis=1).max(initial=0.0)))


def _best(longer: dict[LensChoice, Adjusted], views: Sequence[BoardView]) -> LensChoice:
    """Choose among the longer models; the fisheye one only for lenses as wide as that."""
    score = {choice: criterion(found, choice) for choice, found in longer.items()}
    best = min((c for c in longer if c is not FISHEYE), key=score.__getitem__, default=FISHEYE)
    if best is FISHEYE or FISHEYE not in longer:
        return best
    angle = reach(longer[FISHEYE].state.parameters[0], views)
    measured = sum(r.size for r in longer[best].residuals)
    squares = [sum(float((r**2).sum()) for r in longer[c].residuals) for c in (FISHEYE, best)]
    ratio = measured * np.log(max(squares[0], 1e-300) / max(squares[1], 1e-300))
    return FISHEYE if angle > FISHEYE_ANGLE and ratio < AS_WELL else best


def _fitted_all(
    views: Sequence[BoardView], start: AdjustedState, fit: Fit, choices: Iterable[LensChoice]
) -> dict[LensChoice, Adjusted]:
    """Fit models; those that cannot be fitted are left out."""
    tried = {choice: _fitted(views, start, fit, choice) for choice in choices}
    return {choice: found for choice, found in tried.items() if found is not None}


def _fitted(
    views: Sequence[BoardView], start: AdjustedState, fit: Fit, choice: LensChoice
) -> Adjusted | None:
    try:
        return fit(views, start, choice)
    except CalibrationError:
        return None


def _predicts_better(
    views: Sequence[BoardView], start: AdjustedState, fit: Fit, choice: LensChoice
) -> bool:
    """Whether a model predicts views better that it was not estimated from, a part at a time."""
    gains = list[float]()
    parts = min(_PARTS, len(views))
    for number in range(parts):
        other = [i for i in range(len(views)) if i % parts != number]
        poses = tuple(start.poses[i] for i in other)
        part = AdjustedState(start.parameters, start.T_right_left, poses)
        kept = [views[i] for i in other]
        usual, longer = (_fitted(kept, part, fit, c) for c in (BROWN, choice))
        if usual is None or longer is None:
            return usual is None and longer is not None
        cameras = [found.state.parameters[0] for found in (usual, longer)]
        gains += [
            np.log(_squares(v, cameras[0]) / _squares(v, cameras[1])) for v in views[number::parts]
        ]
    middle = float(np.median(gains))
    spread = 1.4826 * float(np.median(np.abs(np.array(gains) - middle)))
    return middle > SURE * np.sqrt(0.5 * np.pi / len(gains)) * spread


def _squares(view: BoardView, parameters: FloatArray) -> float:
    """Mean squared residual of a view by a camera, its board's pose fitted [px²]."""
    try:
        return max(board_pose(view, parameters)[1], _EXACT_PX) ** 2
    except CalibrationError:
        return float(np.linalg.norm(view.image_size)) ** 2
