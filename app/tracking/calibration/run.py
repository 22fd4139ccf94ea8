"""From views to a calibration that can be kept: estimate, hold back, validate, name."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.tracking.calibration.bundle import rms
from app.tracking.calibration.identity import new_id
from app.tracking.calibration.lens_choice import LensChoice
from app.tracking.calibration.misfit import misfit_px
from app.tracking.calibration.mono import camera_of
from app.tracking.calibration.pair_fit import matched, matched_residual
from app.tracking.calibration.poses import better_corners
from app.tracking.calibration.remarks import ViewResidual
from app.tracking.calibration.selection import choose_held_back, held_back_count
from app.tracking.calibration.stereo import LEAST_PAIRS, StereoEstimate, estimate_stereo
from app.tracking.calibration.validation import ViewPair, validate
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import PoseCalibration, StereoCalibration
from app.tracking.optics.lens import LensModel

MaybeView = BoardView | None


@dataclass(frozen=True, eq=False)
class StereoResult:
    """A calibration and how it came about.

    Attributes:
        calibration: what is kept.
        estimate: the adjustment behind it.
        residuals: of every pair given: used, outlier or held back.
    """

    calibration: StereoCalibration
    estimate: StereoEstimate
    residuals: tuple[ViewResidual, ...]


def calibrate_stereo(
    views_left: Sequence[MaybeView],
    views_right: Sequence[MaybeView],
    names: tuple[str, str] = ("left", "right"),
    hold_back: int | None = None,
    progress: Progress | None = None,
    now: datetime | None = None,
    lens: LensModel | None = None,
) -> StereoCalibration:
    """Calibrate two cameras; see `calibrate_pairs`, of which this is the calibration alone."""
    found = calibrate_pairs(views_left, views_right, names, hold_back, progress, now, lens)
    return found.calibration


def calibrate_pairs(
    views_left: Sequence[MaybeView],
    views_right: Sequence[MaybeView],
    names: tuple[str, str] = ("left", "right"),
    hold_back: int | None = None,
    progress: Progress | None = None,
    now: datetime | None = None,
    lens: LensModel | None = None,
) -> StereoResult:
    """Calibrate two cameras from views taken together, and validate on some held back.

    May run in any thread; `progress` reports and cancels.

    Args:
        views_left: of the left camera; None where it did not see the board (the other's view then
            helps its own parameters alone).
        views_right: of the right camera; view i of both was taken at the same moment.
        names: of the cameras in the rig.
        hold_back: pairs that take no part; one in five from eight pairs on if None.
        progress: reports, and may cancel.
        now: when the calibration was made; the present if None.
        lens: model of both lenses; by what the views ask for if None.

    Raises:
        CalibrationError: see `stereo.estimate_stereo`.
        Cancelled: through `progress`.
    """
    progress = progress or Progress()
    if len(views_left) != len(views_right):
        raise CalibrationError(
            sentence(
                "{left_views} left and {right_views} right views; they are taken in "
                "pairs: give None where a camera did not see the board",
                left_views=len(views_left),
                right_views=len(views_right),
            )
        )
    both = [
        (_called(a, f"{names[0]} {i}"), _called(b, f"{names[1]} {i}"))
        for i, (a, b) in enumerate(zip(views_left, views_right, strict=True), 1)
    ]
    pairs = [(a, b) for a, b in both if a is not None and b is not None]
    alone = (
        [a for a, b in both if a is not None and b is None],
        [b for a, b in both if b is not None and a is None],
    )
    held = set(_held(pairs, hold_back))
    kept = [pair for i, pair in enumerate(pairs) if i not in held]
    estimate = estimate_stereo(kept, alone, names, progress.part(0.0, 0.9), lens)
    progress.report(0.9, sentence("pairs held back"))
    cameras = estimate.adjusted.state.parameters
    better = [
        better_corners([pairs[i][side] for i in sorted(held)], cameras[side]) for side in (0, 1)
    ]
    apart = [matched(pair, estimate.adjusted) for pair in zip(*better, strict=True)]
    calibration = _value(estimate, names, now or datetime.now(UTC))
    if apart:
        update = {"validation": validate(calibration, apart)}
        calibration = calibration.model_copy(update=update)
    rows = (*estimate.residuals, *(_held_row(pair, estimate) for pair in apart))
    progress.report(1.0, sentence("calibrated"))
    return StereoResult(calibration, estimate, tuple(sorted(rows, key=lambda row: row.name)))


def _called(view: MaybeView, name: str) -> MaybeView:
    return view if view is None or view.name else view.called(name)


def _held(pairs: Sequence[ViewPair], hold_back: int | None) -> list[int]:
    count = held_back_count(len(pairs)) if hold_back is None else hold_back
    return choose_held_back([left for left, _ in pairs], min(count, len(pairs) - LEAST_PAIRS))


def _held_row(pair: ViewPair, estimate: StereoEstimate) -> ViewResidual:
    name = f"{pair[0].name} + {pair[1].name}"
    return ViewResidual(name, matched_residual(pair, estimate.adjusted), "held_back")


def _misfit(estimate: StereoEstimate) -> float:
    monos = (estimate.left, estimate.right)
    lenses = sum(len(mono.calibration.estimated) for mono in monos)
    unknowns = lenses + 6 + 6 * len(estimate.adjusted.state.poses)
    return misfit_px([v for pair in estimate.pairs for v in pair], estimate.adjusted, unknowns)


def _value(estimate: StereoEstimate, names: tuple[str, str], now: datetime) -> StereoCalibration:
    adjusted, board = estimate.adjusted, estimate.pairs[0][0].board
    covariance, blocks = _own_blocks(estimate)
    cameras = []
    for side, mono in enumerate((estimate.left, estimate.right)):
        lens = mono.calibration.lens
        camera = camera_of(
            names[side],
            mono.calibration.image_size,
            adjusted.state.parameters[side, : len(lens.parameters)],
            LensChoice(lens, mono.calibration.estimated),
            covariance[blocks[side], blocks[side]],
            rms(estimate.residuals_of(side)),
            len(estimate.pairs),
            mono.wide_covariance if mono.dropped else covariance[blocks[side], blocks[side]],
        )
        update = {"rolling_px": mono.calibration.rolling_px}
        cameras.append(camera.model_copy(update=update))
    return StereoCalibration(
        id=new_id(now),
        created=now,
        board=board.spec,
        cameras=(cameras[0], cameras[1]),
        pose=PoseCalibration.of(adjusted.state.T_right_left, covariance[-6:, -6:]),
        rms_px=estimate.rms_px,
        misfit_px=_misfit(estimate),
        together=estimate.together,
        joint_covariance=tuple(tuple(float(value) for value in row) for row in covariance),
        notes=estimate.notes,
    )


def _own_blocks(estimate: StereoEstimate) -> tuple[FloatArray, tuple[slice, slice]]:
    """Return the covariance without parameters that a camera's lens lacks, and where each stands.

    Both cameras are estimated with the parameters of the longer model.
    """
    count = estimate.adjusted.state.parameters.shape[1]
    left, right = (
        len(mono.calibration.lens.parameters) for mono in (estimate.left, estimate.right)
    )
    keep = np.concatenate([np.arange(left), count + np.arange(right), 2 * count + np.arange(6)])
    covariance = estimate.adjusted.covariance[np.ix_(keep, keep)]
    return covariance, (slice(0, left), slice(left, left + right))
