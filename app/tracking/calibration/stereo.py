"""Two cameras from pairs of views of one board.

Pictures that were mirrored on the way: what they look like, and how they are told.

A checkerboard is its own mirror image, so one mirrored picture of it looks like a picture from
another place. Two cameras give it away: no T_right_left fits both, until one side is mirrored back.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.tracking.calibration.bundle import Adjusted, adjust, rms, with_free
from app.tracking.calibration.corner_order import CornerAgreement, PosedPair, agree, turns
from app.tracking.calibration.fit_together import fit_together, together_remarks
from app.tracking.calibration.mono import MonoResult, calibrate_mono
from app.tracking.calibration.pair_fit import (
    matched,
    matched_residual,
    pair_residuals,
    pair_sightings,
)
from app.tracking.calibration.poses import board_pose, usual_stereo_rms
from app.tracking.calibration.remarks import ViewResidual, size_remarks, stereo_remarks
from app.tracking.calibration.selection import belongs, limit_px
from app.tracking.calibration.sightings import AdjustedState, SeenBoard
from app.tracking.calibration.validation import ViewPair
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import FitTogether
from app.tracking.optics.lens import LensModel, lens_of


def mirrored_view(view: BoardView) -> BoardView:
    """Return the view as the picture mirrored left to right shows it."""
    board = view.board
    ids = np.arange(board.count).reshape(board.rows, board.columns)[:, ::-1].ravel()
    pixels = view.pixels.copy()
    pixels[:, 0] = view.image_size[0] - 1.0 - pixels[:, 0]
    return BoardView(board, ids[view.ids], pixels, view.image_size, name=view.name)


def mirrored_camera(parameters: FloatArray, width: int) -> FloatArray:
    """Return the camera that mirrored pictures seem to come from: cx, p2, s1, s2 change side."""
    result = parameters.copy()
    result[2] = width - 1.0 - parameters[2]
    names = lens_of(parameters.size - 4).parameters
    for name in {"p2", "s1", "s2"} & set(names):
        result[names.index(name)] *= -1.0
    return result


def one_side_is_mirrored(pairs: Sequence[PosedPair], right_camera: FloatArray) -> bool:
    """Return whether the pairs agree once the right pictures are mirrored back."""
    width = pairs[0].right.image_size[0]
    camera = mirrored_camera(right_camera, width)
    try:
        turned = []
        for pair in pairs:
            view = mirrored_view(pair.right)
            turned.append(
                PosedPair(pair.left, view, pair.T_left_board, board_pose(view, camera)[0])
            )
        found = agree(turned, camera)
    except CalibrationError:
        return False
    return bool(found.agreeing.mean() > 0.5)


LEAST_PAIRS = 3
LEAST_BASELINE = 0.01
"""Distance of the cameras over that of the board from which they count as two."""


@dataclass(frozen=True, eq=False)
class StereoEstimate:
    """Two cameras estimated together, and what was done to the pairs.

    Attributes:
        left, right: each camera by itself, from which the estimate started.
        adjusted: the estimate; poses and residuals are those of the pairs used, left and right in
            turn, then of the views that only one camera had.
        pairs: used, corner orders matching.
        residuals: of every pair given, in that order.
        mended: names of the pairs whose right picture was numbered the other way round.
        usual_rms_px: what OpenCV's plain recipe leaves on the same corners: all pairs, lenses as
            found by themselves; None if it finds nothing, or corners were seen by one camera only.
        together: how well the pairs fit together, against each picture by itself; the estimate's
            covariance is that of the adjustment times the square of its factor.
        notes: lines for people.
    """

    left: MonoResult
    right: MonoResult
    adjusted: Adjusted
    pairs: tuple[ViewPair, ...]
    residuals: tuple[ViewResidual, ...]
    mended: tuple[str, ...]
    usual_rms_px: float | None
    together: FitTogether
    notes: tuple[str, ...]

    @property
    def rms_px(self) -> float:
        """Root mean square residual of the pairs used, both pictures [px]."""
        return rms(np.concatenate([self.residuals_of(0), self.residuals_of(1)]))

    def residuals_of(self, side: int) -> FloatArray:
        """Residuals of the left (0) or right (1) camera in the pairs used [px], shape (n, 2)."""
        return np.concatenate(self.adjusted.residuals[side : 2 * len(self.pairs) : 2])


def estimate_stereo(
    pairs: Sequence[ViewPair],
    alone: tuple[Sequence[BoardView], Sequence[BoardView]] = ((), ()),
    names: tuple[str, str] = ("left", "right"),
    progress: Progress | None = None,
    lens: LensModel | None = None,
) -> StereoEstimate:
    """Estimate both cameras and their relative pose.

    Args:
        pairs: views taken together, left and right.
        alone: views that only one of the cameras had; they help its own parameters.
        names: of the cameras.
        progress: reports, and may cancel.
        lens: model of both lenses; by what the views ask for if None.

    Raises:
        CalibrationError: see `calibrate_mono`; or the pairs do not agree on where the cameras
            stand, cannot tell which way round the board lies, come from one camera, or are
            mirrored on one side.
    """
    progress = progress or Progress()
    if len(pairs) < LEAST_PAIRS:
        raise CalibrationError(
            sentence(
                "{pairs} pairs show the board to both cameras; at least {least_pairs} are "
                "needed, 15 to 30 are good",
                pairs=len(pairs),
                least_pairs=LEAST_PAIRS,
            )
        )
    _require_two_cameras(pairs)
    left, right = _cameras(
        [[*(pair[side] for pair in pairs), *alone[side]] for side in (0, 1)],
        names,
        progress.part(0.0, 0.6),
        lens,
    )
    count = len(pairs)
    pairs = list(zip(left.chosen[:count], right.chosen[:count], strict=True))
    progress.report(0.6, sentence("which corner is which"))
    posed = [_posed(pair, left, right) for pair in pairs]
    agreement = agree(posed, right.adjusted.state.parameters[0])
    _require_agreement(agreement, posed, right)
    mended = _mended(pairs, agreement)
    adjusted, used = _adjusted(mended, posed, left, right, agreement, progress.part(0.7, 1.0))
    _require_apart(adjusted)
    residuals = _residuals(mended, used, adjusted)
    together = fit_together(left, right, [mended[i] for i in used], adjusted)
    adjusted = replace(adjusted, covariance=adjusted.covariance * together.sd_factor**2)
    changed = tuple(
        pairs[i][1].name for i in used if mended[i][1] is not pairs[i][1] and pairs[i][1].name
    )
    remarks = stereo_remarks(names, len(pairs), changed, residuals, adjusted)
    remarks += together_remarks(together)
    return StereoEstimate(
        left,
        right,
        adjusted,
        tuple(mended[i] for i in used),
        residuals,
        changed,
        usual_stereo_rms(mended),
        together,
        (*left.notes, *right.notes, *size_remarks(names, pairs[0]), *remarks),
    )


def _cameras(
    views: list[list[BoardView]],
    names: tuple[str, str],
    progress: Progress,
    lens: LensModel | None,
) -> tuple[MonoResult, MonoResult]:
    """Calibrate each camera by itself; where one needs the fisheye model, both get it."""
    left, right = (
        calibrate_mono(views[i], names[i], 0, progress.part(0.4 * i, 0.4 * i + 0.4), lens)
        for i in (0, 1)
    )
    lenses = {left.calibration.lens, right.calibration.lens}
    if LensModel.FISHEYE in lenses and len(lenses) > 1:
        left, right = (
            calibrate_mono(views[i], names[i], 0, progress, LensModel.FISHEYE) for i in (0, 1)
        )
    return left, right


def _require_two_cameras(pairs: Sequence[ViewPair]) -> None:
    same = [
        left.ids.shape == right.ids.shape and np.allclose(left.pixels, right.pixels, atol=0.02)
        for left, right in pairs
    ]
    if np.mean(same) > 0.5:
        raise CalibrationError(
            sentence(
                "left and right show the same pictures: both come from one camera; choose "
                "another source for one of them"
            )
        )


def _require_apart(adjusted: Adjusted) -> None:
    """Refuse cameras at one place: nothing can be triangulated."""
    apart = float(np.linalg.norm(adjusted.state.T_right_left.translation))
    far = float(np.median([np.linalg.norm(T.translation) for T in adjusted.state.poses]))
    if apart < LEAST_BASELINE * far:
        raise CalibrationError(
            sentence(
                "the two cameras stand at one place ({apart:.2f} mm apart, the board "
                "{far:.0f} mm away); both pictures seem to come from one camera: choose another "
                "source for one of them, or move them apart",
                apart=apart * 1e3,
                far=far * 1e3,
            )
        )


def _posed(pair: ViewPair, left: MonoResult, right: MonoResult) -> PosedPair:
    return PosedPair(pair[0], pair[1], _pose_in(pair[0], left), _pose_in(pair[1], right))


def _pose_in(view: BoardView, camera: MonoResult) -> RigidTransform:
    """Pose of a board in a camera; known already if the view was used for the camera itself."""
    for used, T in zip(camera.views, camera.adjusted.state.poses, strict=True):
        if used is view:
            return T
    return board_pose(view, camera.adjusted.state.parameters[0])[0]


def _require_agreement(
    agreement: CornerAgreement, posed: list[PosedPair], right: MonoResult
) -> None:
    if agreement.agreeing.mean() > 0.5 and agreement.agreeing.sum() >= LEAST_PAIRS:
        return
    if one_side_is_mirrored(posed, right.adjusted.state.parameters[0]):
        raise CalibrationError(
            sentence(
                "the pictures of one of the two cameras are mirrored: the pairs fit once one "
                "side is mirrored back; turn mirror mode off in that camera's settings and take "
                "them again"
            )
        )
    raise CalibrationError(
        sentence(
            "the pairs do not agree on where the cameras stand: {agreeing_pairs} of "
            "{pairs} fit together within {agreement_near:.0f} px; pictures that were not "
            "taken together, cameras moved in between, or names paired wrongly do that",
            agreeing_pairs=int(agreement.agreeing.sum()),
            pairs=len(posed),
            agreement_near=agreement.near,
        )
    )


def _mended(pairs: Sequence[ViewPair], agreement: CornerAgreement) -> list[ViewPair]:
    orders = turns(pairs[0][0].board)
    return [
        (left, right.reordered(orders[way]) if way else right)
        for (left, right), way in zip(pairs, agreement.ways, strict=True)
    ]


def _adjusted(
    pairs: list[ViewPair],
    posed: list[PosedPair],
    left: MonoResult,
    right: MonoResult,
    agreement: CornerAgreement,
    progress: Progress,
) -> tuple[Adjusted, list[int]]:
    """Adjust everything together; pairs that do not belong are left out, worst first.

    What was left out is tried again after each adjustment, the first, rough stage's pairs too: it
    comes back, once, if it fits as the others do; `pairs` then has it in the order that fits.
    """
    cameras, free = _stacked(left, right)
    lone = _lone(posed, left, right, agreement.T_right_left)
    used = [i for i in range(len(pairs)) if agreement.agreeing[i]]
    T_right_left, came_back = agreement.T_right_left, set[int]()
    while True:
        poses = [posed[i].T_left_board for i in used] + [T for _, _, T in lone]
        seen = pair_sightings([pairs[i] for i in used])
        seen += [
            SeenBoard(len(used) + i, side, view.points, view.pixels)
            for i, (side, view, _) in enumerate(lone)
        ]
        adjusted = adjust(seen, AdjustedState(cameras, T_right_left, tuple(poses)), free, progress)
        each = pair_residuals(adjusted, len(used))
        worst = int(np.argmax(each))
        if each[worst] > limit_px(each) and len(used) > LEAST_PAIRS:
            used = [i for place, i in enumerate(used) if place != worst]
            continue
        again = []
        for i in (i for i in range(len(pairs)) if i not in used and i not in came_back):
            pair = matched(pairs[i], adjusted)
            if belongs(matched_residual(pair, adjusted), each):
                again.append(i)
                if not np.array_equal(pair[1].pixels, pairs[i][1].pixels):
                    pairs[i] = pair
        if not again:
            return adjusted, used
        came_back |= set(again)
        used = sorted([*used, *again])
        T_right_left = adjusted.state.T_right_left


def _stacked(left: MonoResult, right: MonoResult) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Parameters of both cameras and which are free, shape (2, m): in the longer lens' order.

    The rational model begins as the five-coefficient one does.
    """
    lenses = [mono.calibration.lens for mono in (left, right)]
    longer = max(lenses, key=lambda lens: len(lens.parameters))
    cameras = np.zeros((2, len(longer.parameters)))
    for row, mono in zip(cameras, (left, right), strict=True):
        own = mono.adjusted.state.parameters[0]
        row[: own.size] = own
    free = [with_free(mono.calibration.estimated, 1, longer) for mono in (left, right)]
    return cameras, np.vstack(free)


def _lone(
    posed: list[PosedPair], left: MonoResult, right: MonoResult, T_right_left: RigidTransform
) -> list[tuple[int, BoardView, RigidTransform]]:
    """List views that only one camera had: side, view, and the board in the left frame."""
    paired = {id(view) for pair in posed for view in (pair.left, pair.right)}
    back = (RigidTransform.identity(), T_right_left.inverse())
    return [
        (side, view, back[side] @ T)
        for side, mono in enumerate((left, right))
        for view, T in zip(mono.views, mono.adjusted.state.poses, strict=True)
        if id(view) not in paired
    ]


def _residuals(
    pairs: list[ViewPair], used: list[int], adjusted: Adjusted
) -> tuple[ViewResidual, ...]:
    fitted = dict(zip(used, pair_residuals(adjusted, len(used)), strict=True))
    rows = []
    for i, pair in enumerate(pairs):
        name = f"{pair[0].name} + {pair[1].name}"
        if i in fitted:
            rows.append(ViewResidual(name, fitted[i], "used"))
            continue
        rows.append(ViewResidual(name, matched_residual(pair, adjusted), "outlier"))
    return tuple(rows)
