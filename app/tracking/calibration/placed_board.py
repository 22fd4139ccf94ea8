"""Where a board is laid, and whether what the cameras see of it can be."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.rotation import rotation_exp, skew
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.calibration.board_pose import FittedBoardPose, Pair
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration

WORST_RMS: Final = 3.0
"""Residual over that of the calibration beyond which something has moved."""

LEAST_RMS_PX: Final = 0.3
"""Residual that a calibration is taken to have at least [px]: imported ones may say 0."""

SCALE_LIMIT: Final = 0.005
"""Relative error of the board's size that is refused if it is also significant (5 sd)."""


@dataclass(frozen=True, slots=True, eq=False)
class PlacedBoard:
    """Pictures of a board that lay still at a known place.

    Attributes:
        T_world_board: its place; the board's origin is its first inner corner, x along the
            columns, y along the rows, z away from whoever looks at the print.
        pairs: what left and right camera saw, at least one picture.
    """

    T_world_board: RigidTransform
    pairs: tuple[Pair, ...]


def place(
    x_mm: float,
    y_mm: float,
    z_mm: float,
    rx_deg: float = 180.0,
    ry_deg: float = 0.0,
    rz_deg: float = 0.0,
) -> RigidTransform:
    """Place of a board: its origin, and turns about the world's x, then y, then z axis.

    A turn of 180° about x is a board that lies print up with its columns along the world's x.
    """
    turns = ((rx_deg, (1.0, 0.0, 0.0)), (ry_deg, (0.0, 1.0, 0.0)), (rz_deg, (0.0, 0.0, 1.0)))
    rotation = np.eye(3)
    for angle, axis in turns:
        rotation = rotation_exp(np.array(axis) * angle * DEGREE) @ rotation
    return RigidTransform(rotation, np.array([x_mm, y_mm, z_mm]) * MILLIMETRE)


def check_fit(calibration: StereoCalibration, fit: FittedBoardPose, board: PlacedBoard) -> None:
    """Refuse what cannot be.

    Raises:
        CalibrationError: if the board's size is wrong, the corners do not fit, the board lies face
            down, or a camera would look at it from behind; says what to do.
    """
    limit = WORST_RMS * max(calibration.rms_px, LEAST_RMS_PX)
    if fit.scale is not None and abs(fit.scale - 1.0) > max(SCALE_LIMIT, 5.0 * fit.scale_sd):
        raise CalibrationError(
            sentence(
                "the board measures {fit_scale:.4f} ± {fit_scale_sd:.4f} times what its "
                "specification says: measure a square, or was the calibration made with another "
                "board?",
                fit_scale=fit.scale,
                fit_scale_sd=fit.scale_sd,
            )
        )
    if fit.rms_px > limit:
        worst = max(fit.by_picture, key=lambda line: line[1])
        raise CalibrationError(
            sentence(
                "the corners lie {fit_rms_px:.2f} px from where they should ({limit:.2f} px is "
                "the limit), worst in {worst_picture} ({worst_px:.2f} px): did the board move "
                "between the pictures, did a camera, or are left and right exchanged?",
                fit_rms_px=fit.rms_px,
                limit=limit,
                worst_picture=worst[0],
                worst_px=worst[1],
            )
        )
    up = -board.T_world_board.rotation[2, 2]
    if up < -0.1:
        raise CalibrationError(
            sentence(
                "the place says that the print faces down; a board that lies print up is turned "
                "by 180 degrees about x: --at x,y,z,180,0,rz"
            )
        )
    T_world_left = board.T_world_board @ fit.T_left_board.inverse()
    centres = (T_world_left, T_world_left @ calibration.pose.transform.inverse())
    for camera, pose in zip(calibration.cameras, centres, strict=True):
        p_board = board.T_world_board.inverse() @ pose.translation
        if p_board[2] > 0.0:
            raise CalibrationError(
                sentence(
                    "camera {camera_name} would look at the board from behind: is its picture "
                    "mirrored, or is the calibration one of other cameras?",
                    camera_name=camera.name,
                )
            )


def remarks_on(
    calibration: StereoCalibration,
    centres: FloatArray,
    watched: FloatArray | None,
    away: float,
    covariance: FloatArray,
) -> tuple[str, ...]:
    """Say what to look at, one line each.

    Args:
        calibration: with its world frame.
        centres: of both cameras in world [m], (2, 3).
        watched: points that both are meant to see [m, world], (n, 3), or None.
        away: largest distance of the left camera's centre by one place from that by all [m].
        covariance: of the world frame's twist, (6, 6).
    """
    remarks = []
    for camera, centre in zip(calibration.cameras, centres, strict=True):
        if centre[2] < 0.0:
            remarks.append(
                sentence(
                    "camera {camera_name} stands {centre_mm:.0f} mm below the robot's "
                    "plane (z = 0): is the board's place right?",
                    camera_name=camera.name,
                    centre_mm=-centre[2] / MILLIMETRE,
                )
            )
    if watched is not None:
        for model in calibration.models():
            if not bool(np.all(model.sees(watched))):
                remarks.append(
                    sentence(
                        "camera {model_name} does not see the needle's place: is the board's "
                        "place right, and does the camera look at the needle?",
                        model_name=model.name,
                    )
                )
    at_camera = np.hstack([np.eye(3), -skew(centres[0])])
    spread = float(np.sqrt(np.trace(at_camera @ covariance @ at_camera.T)))
    if away > 3.0 * spread + 1e-3:
        remarks.append(
            sentence(
                "the places disagree by {away_mm:.1f} mm at the left camera: was a board "
                "laid wrongly?",
                away_mm=away / MILLIMETRE,
            )
        )
    return tuple(remarks)
