"""One camera from the views it had of a board."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.tracking.calibration.bundle import Adjusted, adjust, rms, with_free
from app.tracking.calibration.lens_choice import BOTH, BROWN, FISHEYE, LensChoice, choose_lens
from app.tracking.calibration.poses import better_corners, board_pose, first_estimate, usual_rms
from app.tracking.calibration.ray_error import ray_sds, with_usual_k3
from app.tracking.calibration.remarks import (
    ViewResidual,
    lens_remarks,
    mono_remarks,
    unrefined_remarks,
)
from app.tracking.calibration.rolling_shutter import moved_px, rolling_remark
from app.tracking.calibration.selection import (
    Dropped,
    belongs,
    choose_held_back,
    held_back_count,
    limit_px,
    smallest_model,
)
from app.tracking.calibration.sightings import AdjustedState, SeenBoard
from app.tracking.calibration.views import BoardView, named
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import CameraCalibration
from app.tracking.optics.lens import LensModel

LEAST_VIEWS = 3
LEAST_CONDITION = 1e-12
"""Smallest eigenvalue, see `Adjusted.condition`, of views that determine a camera."""

MOST_FOCAL_SPREAD = 0.05
"""Standard deviation of the focal length over itself beyond which views are refused."""


@dataclass(frozen=True, eq=False)
class MonoResult:
    """A calibrated camera and how it came about.

    Attributes:
        calibration: the camera.
        adjusted: the estimate.
        views: those used, in the order of the estimate's poses.
        chosen: every view given, in that order, with the corners that fit better: refined, or as
            the finder gave them.
        residuals: of every view given, in that order.
        five_px: residual with five coefficients where the lens asks for another model; else None.
        dropped: coefficients that the views do not tell.
        wide_covariance: of the camera's parameters with what is dropped as uncertain as it is.
        usual_rms_px: what OpenCV's plain recipe leaves on the same corners: all views, all five
            coefficients; None if it finds nothing.
        held_back_rms_px: of views that took no part; None if there were none.
        notes: lines for people.
    """

    calibration: CameraCalibration
    adjusted: Adjusted
    views: tuple[BoardView, ...]
    chosen: tuple[BoardView, ...]
    residuals: tuple[ViewResidual, ...]
    five_px: float | None
    dropped: tuple[Dropped, ...]
    wide_covariance: FloatArray
    usual_rms_px: float | None
    held_back_rms_px: float | None
    notes: tuple[str, ...]


def calibrate_mono(
    views: Sequence[BoardView],
    name: str = "camera",
    hold_back: int | None = None,
    progress: Progress | None = None,
    lens: LensModel | None = None,
) -> MonoResult:
    """Calibrate one camera.

    Args:
        views: of one board by one camera, at least three.
        name: of the camera.
        hold_back: how many views take no part and are fitted afterwards; one in five if None.
        progress: reports, and may cancel.
        lens: model of the lens; by what the views ask for if None.

    Raises:
        CalibrationError: if the views are too few, of different sizes, or do not determine the
            camera (all in one plane, say).
    """
    progress = progress or Progress()
    _require(views, name)
    views = named(views)
    given = views
    count = held_back_count(len(views)) if hold_back is None else hold_back
    held = set(choose_held_back(views, min(count, len(views) - LEAST_VIEWS)))
    progress.report(0.1, sentence("{name}: first estimate", name=name))
    views = better_corners(views, _first(views, held, progress.part(0.1, 0.2)))
    while True:
        kept = [view for i, view in enumerate(views) if i not in held]
        model = _estimated(kept, name, lens, progress)
        used, out, adjusted = model.used, model.out, model.adjusted
        better = better_corners(views, adjusted.state.parameters[0])
        if better == views:  # the very same: every round takes more of them unrefined, or none
            break
        views = better
    _require_determined(adjusted, name)
    progress.report(0.9, sentence("{name}: views held back", name=name))
    residuals = _residuals(views, used, out, adjusted)
    camera = _calibration(name, views[0].image_size, adjusted, model)
    moved = moved_px(used, adjusted)
    apart = [r.rms_px for r in residuals if r.role == "held_back"]
    return MonoResult(
        camera.model_copy(update={"rolling_px": moved}),
        adjusted,
        tuple(used),
        tuple(views),
        residuals,
        model.five_px,
        model.dropped,
        adjusted.covariance if model.wide_covariance is None else model.wide_covariance,
        usual_rms(views),
        float(np.sqrt(np.mean(np.square(apart)))) if apart else None,
        (
            *unrefined_remarks(name, given, views),
            *lens_remarks(name, model.choice.lens, adjusted, used, model.five_px),
            *([] if moved is None else [rolling_remark(name, moved)]),
            *mono_remarks(name, used, adjusted, model.dropped, residuals),
        ),
    )


@dataclass(frozen=True, eq=False)
class _Model:
    """A camera estimated: views used and left out, the model of its lens, and the estimate."""

    used: list[BoardView]
    out: list[BoardView]
    choice: LensChoice
    adjusted: Adjusted
    five_px: float | None = None
    dropped: tuple[Dropped, ...] = ()
    wide_covariance: FloatArray | None = None


def _estimated(
    views: list[BoardView], name: str, lens: LensModel | None, progress: Progress
) -> _Model:
    """Choose views and the model of the lens, and estimate the camera."""
    used, out, usual = _without_outliers(views, BROWN, progress.part(0.2, 0.5))
    progress.report(0.5, sentence("{name}: which coefficients the views support", name=name))
    choosing = progress.part(0.5, 0.9)
    if lens is not LensModel.BROWN:
        longer = _longer(views, used, out, usual, lens, choosing)
        if longer is not None:
            return longer
    adjusted, names, dropped = smallest_model(
        lambda free, earlier: (
            usual
            if earlier is None
            else _fit(used, earlier.state, LensChoice(BROWN.lens, free), choosing)
        )
    )
    wide = with_usual_k3(usual.covariance) if dropped else None
    return _Model(used, out, LensChoice(BROWN.lens, names), adjusted, None, dropped, wide)


def _longer(
    views: list[BoardView],
    used: list[BoardView],
    out: list[BoardView],
    usual: Adjusted,
    lens: LensModel | None,
    progress: Progress,
) -> _Model | None:
    """Estimate a camera by a longer model; None where the views do not ask for one.

    Views at the edges of a wide lens' picture do not fit five coefficients and look like outliers:
    the choice is made on the views that fit the richest model.
    """

    def fit(
        some: Sequence[BoardView], state: AdjustedState, choice: LensChoice, steps: int
    ) -> Adjusted:
        return _fit(some, state, choice, progress, steps)

    if out:
        tried = FISHEYE if lens is LensModel.FISHEYE else BOTH
        used, out, _ = _without_outliers(views, tried, progress)
        usual = _fit(used, first_estimate(used), BROWN, progress)
    choice = choose_lens(used, usual, fit, lens)
    if choice is BROWN:
        return None
    used, out, adjusted = _without_outliers(views, choice, progress)
    five_px = _fit(used, first_estimate(used), BROWN, progress).rms_px
    return _Model(used, out, choice, adjusted, five_px)


def _first(views: Sequence[BoardView], held: set[int], progress: Progress) -> FloatArray:
    """Parameters of a camera from all views that are not held back, shape (9,)."""
    progress.report(0.0, sentence("first estimate"))
    kept = [view for i, view in enumerate(views) if i not in held]
    return first_estimate(kept).parameters[0]


def _require(views: Sequence[BoardView], name: str) -> None:
    if len(views) < LEAST_VIEWS:
        raise CalibrationError(
            sentence(
                "camera {name}: {usable_views} usable views of the board; at least {least_views} "
                "are needed, 15 to 30 are good",
                name=name,
                usable_views=len(views),
                least_views=LEAST_VIEWS,
            )
        )
    _require_one_size(views, name)
    boards = sorted({view.board.spec for view in views})
    if len(boards) > 1:
        raise CalibrationError(
            sentence(
                "camera {name}: views of different boards, {boards}",
                name=name,
                boards=", ".join(boards),
            )
        )


def _require_one_size(views: Sequence[BoardView], name: str) -> None:
    sizes = [view.image_size for view in views]
    usual = max(set(sizes), key=sizes.count)
    other = [view for view in views if view.image_size != usual]
    if other:
        width, height = other[0].image_size
        raise CalibrationError(
            sentence(
                "camera {name}: pictures of different sizes: {view_name} has "
                "{width}x{height} ({differing_views} of {views} are not "
                "{usual_width}x{usual_height}); one camera at one resolution is needed: leave "
                "the others out",
                name=name,
                view_name=other[0].name or "a view",
                width=width,
                height=height,
                differing_views=len(other),
                views=len(views),
                usual_width=usual[0],
                usual_height=usual[1],
            )
        )


def _fit(
    views: Sequence[BoardView],
    start: AdjustedState,
    choice: LensChoice,
    progress: Progress,
    steps: int = 60,
) -> Adjusted:
    """Estimate the parameters of a choice; the coefficients that are not in it are zero."""
    free = with_free(choice.names, 1, choice.lens)
    count = free.shape[1]
    parameters = np.zeros((1, count))
    shared = min(count, start.parameters.shape[1])
    if choice.lens is LensModel.FISHEYE and shared != count:
        shared = 4
    parameters[:, :shared] = start.parameters[:, :shared]
    parameters = np.where(free | (np.arange(count) < 4), parameters, 0.0)
    seen = [SeenBoard(i, 0, view.points, view.pixels) for i, view in enumerate(views)]
    progress.report(0.0, sentence("adjusting"))
    first = AdjustedState(parameters, start.T_right_left, start.poses)
    return adjust(seen, first, free, rounds=steps)


def _without_outliers(
    views: list[BoardView], choice: LensChoice, progress: Progress
) -> tuple[list[BoardView], list[BoardView], Adjusted]:
    """Leave out views that do not belong, worst first; what fits again later comes back, once.

    Returns:
        Views used, views left out, and the estimate from those used.
    """
    used, out, came_back = list(views), list[BoardView](), set[int]()
    while True:
        adjusted = _fit(used, first_estimate(used), choice, progress)
        each = [rms(r) for r in adjusted.residuals]
        worst = int(np.argmax(each))
        if each[worst] > limit_px(each) and len(used) > LEAST_VIEWS:
            out.append(used.pop(worst))
            continue
        parameters = adjusted.state.parameters[0]
        again = [
            view
            for view in out
            if id(view) not in came_back and belongs(board_pose(view, parameters)[1], each)
        ]
        if not again:
            return used, out, adjusted
        came_back |= {id(view) for view in again}
        out = [view for view in out if not any(view is other for other in again)]
        used += again


def _require_determined(adjusted: Adjusted, name: str) -> None:
    focal, spread = adjusted.state.parameters[0, :2], adjusted.sd()[:2]
    worst = float((spread / focal).max())
    undetermined = adjusted.condition < LEAST_CONDITION  # exact corners leave no spread to see it
    if undetermined or not np.isfinite(worst) or worst > MOST_FOCAL_SPREAD:
        raise CalibrationError(
            sentence(
                "camera {name}: the views do not determine the focal length ({focal_px:.0f} ± "
                "{spread_px:.0f} px; at most {most_focal_spread:.0%} is taken); boards that "
                "are all parallel cannot: tilt the board to different sides by 20 to 45 degrees",
                name=name,
                focal_px=focal[0],
                spread_px=spread[0],
                most_focal_spread=MOST_FOCAL_SPREAD,
            )
        )


def _residuals(
    views: Sequence[BoardView], used: list[BoardView], out: list[BoardView], adjusted: Adjusted
) -> tuple[ViewResidual, ...]:
    fitted = {id(v): rms(r) for v, r in zip(used, adjusted.residuals, strict=True)}
    rows = []
    for view in views:
        if id(view) in fitted:
            rows.append(ViewResidual(view.name, fitted[id(view)], "used"))
            continue
        left_out = any(view is other for other in out)
        error = board_pose(view, adjusted.state.parameters[0])[1]
        rows.append(ViewResidual(view.name, error, "outlier" if left_out else "held_back"))
    return tuple(rows)


def _calibration(
    name: str, size: tuple[int, int], adjusted: Adjusted, model: _Model
) -> CameraCalibration:
    own = adjusted.covariance
    return camera_of(
        name,
        size,
        adjusted.state.parameters[0],
        model.choice,
        own,
        adjusted.rms_px,
        len(adjusted.residuals),
        own if model.wide_covariance is None else model.wide_covariance,
    )


def camera_of(
    name: str,
    size: tuple[int, int],
    parameters: np.ndarray,
    choice: LensChoice,
    covariance: np.ndarray,
    rms_px: float,
    views: int,
    wide_covariance: np.ndarray,
) -> CameraCalibration:
    """Return a camera as the value that files hold."""
    p = [float(value) for value in parameters]
    return CameraCalibration(
        name=name,
        image_size=size,
        focal_px=(p[0], p[1]),
        centre_px=(p[2], p[3]),
        lens=choice.lens,
        distortion=tuple(p[4:]),
        estimated=choice.names,
        covariance=tuple(tuple(float(value) for value in row) for row in covariance),
        rms_px=rms_px,
        views=views,
        ray_sd_px=tuple(map(tuple, ray_sds(parameters, wide_covariance, size).tolist())),
    )
