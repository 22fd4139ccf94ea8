"""The world frame of calibrated cameras, from a board that lies at a known place.

T_world_left = T_world_board · T_left_board⁻¹. Each place gives one estimate; its covariance is
what the corners' scatter leaves and how exactly the board was laid down. Several places are
joined by their information (inverse covariance).

The board was seen by the very cameras whose frame it gives. Where they are taken a little wrongly
the board is found wrongly, and the tip is, and near the board the one makes up for the other: both
together are known far better than their errors, taken as independent, would say. So the frame's
change with the cameras' parameters is kept beside its own covariance.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.rotation import skew
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.calibration.board_pose import FittedBoardPose, Pair, board_rays, fit_pose
from app.tracking.calibration.identity import new_id
from app.tracking.calibration.placed_board import PlacedBoard, check_fit, remarks_on
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import PoseCalibration, StereoCalibration

PLACE_SD_MM: Final = 0.3
"""How exactly a board is laid to marks by hand, standard deviation per axis: an estimate."""

PLACE_SD_DEG: Final = 0.15
"""The same of its direction, per axis."""


@dataclass(frozen=True, slots=True, eq=False)
class WorldFrame:
    """Where the cameras stand.

    Attributes:
        pose: T_world_left with its covariance, were the cameras known exactly.
        by_cameras: change of its twist with what `StereoCalibration.covariance` is of, (6, 24).
        rms_px: of the corners, over all places.
        by_picture: the same, picture by picture.
        scale: measured size of the board over its true size; None with one camera.
        scale_sd: standard deviation of it.
        disagreement_mm: largest distance between the left camera's centre by one place and by
            all; 0 with one place.
        centres: of both cameras in world [m], (2, 3).
        watched_sd_mm: standard deviation per axis (root mean square of the three) that the frame
            gives a point at the middle of `watched`; None without that.
        remarks: what to look at, one line each.
    """

    pose: PoseCalibration
    by_cameras: FloatArray
    rms_px: float
    by_picture: tuple[tuple[str, float], ...]
    scale: float | None
    scale_sd: float
    disagreement_mm: float
    centres: FloatArray
    watched_sd_mm: float | None
    remarks: tuple[str, ...]


def find_world(
    calibration: StereoCalibration,
    boards: Sequence[PlacedBoard],
    *,
    place_sd_mm: float = PLACE_SD_MM,
    place_sd_deg: float = PLACE_SD_DEG,
    watched: FloatArray | None = None,
    expected: RigidTransform | None = None,
) -> WorldFrame:
    """Find the world frame.

    Args:
        calibration: of the two cameras.
        boards: one per place.
        place_sd_mm: how exactly a board lies where it is said to, standard deviation per axis.
        place_sd_deg: the same of its direction.
        watched: points that both cameras are meant to see [m, world], (n, 3); a remark says so
            if they do not.
        expected: rough T_world_left; tells which way round a board lies that looks the same after
            half a turn.

    Raises:
        CalibrationError: if no picture shows the board, a picture's size is another one, the
            corners do not fit, the board's size is wrong, it lies face down, a camera would look
            at it from behind, or it can lie two ways round.
    """
    if not boards:
        raise CalibrationError(
            sentence("no board was given: one picture of it at a known place is needed")
        )
    chosen = [_fit(calibration, board, expected) for board in boards]
    for fit, board in zip(chosen, boards, strict=True):
        check_fit(calibration, fit, board)
    poses, spreads, changes = [], [], []
    for fit, board in zip(chosen, boards, strict=True):
        pose = board.T_world_board @ fit.T_left_board.inverse()
        poses.append(pose)
        spreads.append(_spread(fit, board.T_world_board, pose, place_sd_mm, place_sd_deg))
        changes.append(-_adjoint(pose) @ fit.by_cameras)
    joined, covariance = _joined(poses, spreads)
    weighed = zip(spreads, changes, strict=True)
    by_cameras = covariance @ sum(np.linalg.solve(spread, change) for spread, change in weighed)
    apart = [float(np.linalg.norm(p.translation - joined.translation)) for p in poses]
    away = max(apart) if len(boards) > 1 else 0.0
    world = PoseCalibration.of(joined, covariance)
    placed = calibration.model_copy(update={"world": world})
    centres = np.array([model.centre for model in placed.models()])
    total = np.sqrt(np.mean([fit.rms_px**2 for fit in chosen]))
    scaled = [fit for fit in chosen if fit.scale is not None]
    best = min(scaled, key=lambda fit: fit.scale_sd, default=None)
    return WorldFrame(
        world,
        np.asarray(by_cameras),
        float(total),
        tuple(line for fit in chosen for line in fit.by_picture),
        best.scale if best is not None else None,
        best.scale_sd if best is not None else 0.0,
        away / MILLIMETRE,
        centres,
        None if watched is None else _sd_at(watched.mean(axis=0), covariance) / MILLIMETRE,
        remarks_on(placed, centres, watched, away, covariance),
    )


def with_world(calibration: StereoCalibration, world: WorldFrame, board: str) -> StereoCalibration:
    """Return a new calibration, with an id of its own, that has this world frame."""
    created = datetime.now(UTC)
    kept = tuple(note for note in calibration.notes if not note.startswith("no world frame"))
    note = f"world frame by {board}, {world.rms_px:.2f} px; cameras as in {calibration.id}"
    return calibration.model_copy(
        update={
            "id": new_id(created),
            "created": created,
            "world": world.pose,
            "world_by_cameras": tuple(map(tuple, world.by_cameras.tolist())),
            "notes": (*kept, note),
        }
    )


def _fit(
    calibration: StereoCalibration, board: PlacedBoard, expected: RigidTransform | None
) -> FittedBoardPose:
    """Fit one place; of the ways round that a board may lie, take the one that is expected."""
    orders = next(view.board.orders for pair in board.pairs for view in pair if view is not None)
    if len(orders) == 1:
        return fit_pose(calibration, board_rays(calibration, board.pairs))
    if expected is None:
        raise CalibrationError(
            sentence(
                "the board looks the same after half a turn, so the world could be turned by "
                "180°: use a ChArUco board, or one with an odd and an even count of corners, or "
                "say where the cameras stand roughly (--rig)"
            )
        )
    fits = [
        fit_pose(calibration, board_rays(calibration, pairs))
        for pairs in (_turned(board.pairs, *pick) for pick in product(orders, repeat=2))
    ]
    least = min(fit.rms_px for fit in fits)
    good = [fit for fit in fits if fit.rms_px < 2.0 * least + 0.1]

    def away(fit: FittedBoardPose) -> float:
        found = board.T_world_board @ fit.T_left_board.inverse()
        return float(np.linalg.norm(found.translation - expected.translation))

    return min(good, key=away)


def _turned(
    pairs: Sequence[Pair], left: NDArray[np.int64], right: NDArray[np.int64]
) -> tuple[Pair, ...]:
    def turn(view: BoardView | None, order: NDArray[np.int64]) -> BoardView | None:
        return None if view is None else view.reordered(order)

    return tuple((turn(pair[0], left), turn(pair[1], right)) for pair in pairs)


def _spread(
    fit: FittedBoardPose,
    T_world_board: RigidTransform,
    T_world_left: RigidTransform,
    sd_mm: float,
    sd_deg: float,
) -> FloatArray:
    """Covariance of T_world_left's twist on the left, (6, 6)."""
    adjoint = _adjoint(T_world_left)
    about_board = np.eye(6)
    about_board[:3, 3:] = skew(T_world_board.translation)
    sd = np.repeat([sd_mm * MILLIMETRE, sd_deg * DEGREE], 3)
    laid = about_board @ np.diag(sd**2) @ about_board.T
    return np.asarray(adjoint @ fit.covariance @ adjoint.T + laid)


def _adjoint(T: RigidTransform) -> FloatArray:
    """Return what takes a twist on the right of T to that on its left, (6, 6)."""
    R = T.rotation
    return np.block([[R, skew(T.translation) @ R], [np.zeros((3, 3)), R]])


def _sd_at(p_world: FloatArray, covariance: FloatArray) -> float:
    """Root mean square over the axes of the deviation that the frame gives a point [m]."""
    jacobian = np.hstack([np.eye(3), -skew(p_world)])
    return float(np.sqrt(np.trace(jacobian @ covariance @ jacobian.T) / 3.0))


def _joined(
    poses: Sequence[RigidTransform], spreads: Sequence[FloatArray]
) -> tuple[RigidTransform, FloatArray]:
    """Mean of poses, weighted by their information, and its covariance."""
    weights = [np.linalg.inv(spread) for spread in spreads]
    covariance = np.linalg.inv(sum(weights))
    mean = poses[0]
    for _ in range(10):
        pull = sum(
            weight @ (pose @ mean.inverse()).log()
            for weight, pose in zip(weights, poses, strict=True)
        )
        step = covariance @ pull
        mean = RigidTransform.exp(step) @ mean
        if float(np.abs(step).max()) < 1e-12:
            break
    return mean, 0.5 * (covariance + covariance.T)
