"""A calibration made of another program's numbers."""

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.calibration.identity import new_id
from app.tracking.errors import CalibrationError, TrackingError
from app.tracking.optics.calibration import (
    CameraCalibration,
    PoseCalibration,
    StereoCalibration,
)
from app.tracking.optics.lens import LensModel

NAMES = ("left", "right")
"""What the cameras of every shipped rig are called."""


@dataclass(frozen=True, slots=True)
class ImportedCamera:
    """One camera as a file gives it.

    Attributes:
        source: file it came from.
        image_size: width, height [px].
        focal_px: fx, fy.
        centre_px: cx, cy.
        distortion: coefficients of `lens` in OpenCV's order.
        T_camera_reference: takes points of the file's common frame to the camera's.
        rms_px: of its own reprojection; 0 if the file does not say.
        lens: model of the distortion.
    """

    source: Path
    image_size: tuple[int, int]
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    distortion: tuple[float, ...]
    T_camera_reference: RigidTransform
    rms_px: float = 0.0
    lens: LensModel = LensModel.BROWN


def stereo_of(
    left: ImportedCamera,
    right: ImportedCamera,
    format_name: str,
    *,
    rms_px: float = 0.0,
    names: tuple[str, str] = NAMES,
) -> StereoCalibration:
    """Join two imported cameras; the calibration gets a new id and no world frame.

    Raises:
        CalibrationError: if both cameras stand at the same place: no depth comes from them.
    """
    T_right_left = right.T_camera_reference @ left.T_camera_reference.inverse()
    if float(abs(T_right_left.translation).max()) < 1e-6:
        raise CalibrationError(
            sentence(
                "{left_source} and {right_source}: both cameras stand at the same place; the "
                "pair needs two different poses. Was the same file given twice, or only one "
                "camera's pose?",
                left_source=left.source,
                right_source=right.source,
            )
        )
    created = datetime.now(UTC)
    notes = (
        f"imported: {format_name}, {left.source.name} and {right.source.name}",
        "the files hold no uncertainty: the covariance is unknown and stands as zero",
        "no world frame: lay the board at its known place and run `acus calibrate world`",
    )
    found = StereoCalibration(
        id=new_id(created),
        created=created,
        cameras=(_camera(left, names[0]), _camera(right, names[1])),
        pose=PoseCalibration.of(T_right_left),
        rms_px=rms_px,
        notes=notes,
    )
    try:
        found.models()  # an impossible camera or pose is refused here, not later
    except (TrackingError, ArithmeticError) as error:
        raise CalibrationError(
            sentence(
                "{left_source} and {right_source}: {error}",
                left_source=left.source,
                right_source=right.source,
                error=error,
            )
        ) from error
    return found


def _camera(camera: ImportedCamera, name: str) -> CameraCalibration:
    return CameraCalibration(
        name=name,
        image_size=camera.image_size,
        focal_px=camera.focal_px,
        centre_px=camera.centre_px,
        lens=camera.lens,
        distortion=camera.distortion,
        rms_px=camera.rms_px,
    )
