"""Which model of the lens the views ask for.

The five-coefficient model is taken unless a longer one is worth its place twice: by the F test of
nested models at `CHANCE`, and by views that it was not estimated from. The test takes the corners
of a view for independent, which they are not quite (a board that is not flat, blur):
cross-validation by whole views does not. Longer models that pass are compared by
n·ln(SS / n) + χ²·k, χ² what a coefficient that is not needed may gain at `CHANCE`.

The longer models are rational (p1, p2, k1 to k3, and k4, k4 and k5, or k4 to k6), with thin prism
(s1 to s4 as well), five coefficients with thin prism, and fisheye. All of a model's coefficients
are estimated. The rational one grows by a coefficient at a time: numerator and denominator bend
alike without a trace in the pixels, and several at once find a pole that fits a corner's noise.
Whether a step is worth a fit tells Rao's score test, from the shorter model's end.

The fisheye model has no decentring: it is taken where the pictures reach beyond `FISHEYE_ANGLE`,
where polynomials of the tangent run off, and where it fits as the rational one does but for
`AS_WELL`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.stats import f as f_distribution

from app.core.arrays import FloatArray
from app.core.confidence import chi_square_quantile
from app.core.transform import RigidTransform
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
"""The same by the score test, from which a longer model is fitted."""

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

Fit = Callable[[Sequence[BoardView], AdjustedState, LensChoice, int], Adjusted]
"""Estimates a camera with a model from views, from an earlier state, in at most so many steps."""

_STEPS: Final = 60

_STEPS_BEFORE: Final = {
    **{choice: count for count, choice in enumerate(RATIONAL, 1)},
    THIN_PRISM: 1,
    BOTH: len(RATIONAL) + 2,
}
"""How many shorter models, the usual one included, must be worth it before one is tried."""


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
    longer = _tried(views, usual, fit, allowed is not None)
    if allowed is None:
        if not longer:
            return BROWN
        wide = _fitted(views, usual.state, fit, FISHEYE)
        longer |= {} if wide is None else {FISHEYE: wide}
    best = _best(longer, views) if longer else RATIONAL[0]
    if allowed is not None or _predicts_better(views, usual.state, fit, best):
        return best
    return BROWN


def _tried(
    views: Sequence[BoardView], usual: Adjusted, fit: Fit, every: bool
) -> dict[LensChoice, Adjusted]:
    """Fit the rational models, each from the longest that it contains; without `every` only those
    that are worth it from there, a step at a time: a pole among the corners fits what noise it
    likes, and several coefficients at once find one.
    """
    known = {BROWN: usual}
    for choice in CHOICES[LensModel.RATIONAL]:
        inside = [c for c in known if set(c.names) < set(choice.names)]
        base = max(inside, key=lambda c: len(c.names))
        if every or len(inside) == _STEPS_BEFORE[choice]:
            found = _longer(views, known[base], fit, (base, choice), every)
            if found is not None:
                known[choice] = found
    return {choice: found for choice, found in known.items() if choice is not BROWN}


def _longer(
    views: Sequence[BoardView],
    shorter: Adjusted,
    fit: Fit,
    models: tuple[LensChoice, LensChoice],
    every: bool,
) -> Adjusted | None:
    """Fit the second of two models, from an estimate with the first; None if it is not worth it."""
    base, choice = models
    if not every:
        look = _fitted(views, shorter.state, fit, choice, 0)
        if look is None or _chance(shorter, look.promised, base, choice) > WORTH_A_LOOK:
            return None
    found = _fitted(views, shorter.state, fit, choice)
    if found is None or every:
        return found
    gain = _total(shorter) - _total(found)
    return found if _chance(shorter, gain, base, choice) < CHANCE else None


def _total(result: Adjusted) -> float:
    """Sum of squared residuals [px²]."""
    return sum(float((r**2).sum()) for r in result.residuals)


def _chance(shorter: Adjusted, gain: float, base: LensChoice, choice: LensChoice) -> float:
    """Probability that residuals fall by so much, were the longer model not needed (F test)."""
    more = len(choice.names) - len(base.names)
    measured = sum(r.size for r in shorter.residuals)
    freedom = max(1, measured - len(choice.names) - 6 * len(shorter.state.poses))
    noise = max((_total(shorter) - gain) / freedom, _EXACT_PX**2)
    return float(f_distribution.sf(max(0.0, gain) / more / noise, more, freedom))


def criterion(result: Adjusted, choice: LensChoice) -> float:
    """Return how well a model fits, less what each of its coefficients might by chance; smaller is
    better.
    """
    measured = sum(r.size for r in result.residuals)
    mean = max(_total(result) / measured, _EXACT_PX**2)
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
    squares = [_total(longer[c]) for c in (FISHEYE, best)]
    ratio = measured * np.log(max(squares[0], 1e-300) / max(squares[1], 1e-300))
    return FISHEYE if angle > FISHEYE_ANGLE and ratio < AS_WELL else best


def _fitted(
    views: Sequence[BoardView],
    start: AdjustedState,
    fit: Fit,
    choice: LensChoice,
    steps: int = _STEPS,
) -> Adjusted | None:
    try:
        return fit(views, start, choice, steps)
    except CalibrationError:
        return None


def _predicts_better(
    views: Sequence[BoardView], start: AdjustedState, fit: Fit, choice: LensChoice
) -> bool:
    """Return whether a model predicts views better that it was not estimated from, a part at a
    time.
    """
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
        for i in range(number, len(views), parts):
            before, after = (_squares(views[i], camera, start.poses[i]) for camera in cameras)
            gains.append(np.log(before / after))
    middle = float(np.median(gains))
    spread = 1.4826 * float(np.median(np.abs(np.array(gains) - middle)))
    return middle > SURE * np.sqrt(0.5 * np.pi / len(gains)) * spread


def _squares(view: BoardView, parameters: FloatArray, near: RigidTransform) -> float:
    """Mean squared residual of a view by a camera, its board's pose fitted [px²]."""
    try:
        return max(board_pose(view, parameters, near)[1], _EXACT_PX) ** 2
    except CalibrationError:
        return float(np.linalg.norm(view.image_size)) ** 2
