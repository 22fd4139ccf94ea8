"""ROS camera_info files (`camera_calibration_parsers` YAML), one per camera, in metres.

A camera_info tells a pair's geometry by its rectification: with R₁, R₂ the rotations to the
rectified frame and P₂ = f·[... | -B] (sensor_msgs/CameraInfo),

    x_rectified = R₁·x_left,   x_rectified - (B, 0, 0) = R₂·x_right,

so T_right_left = (R₂ᵀ·R₁, -R₂ᵀ·(B, 0, 0)).
"""

from pathlib import Path
from typing import Any, Final

import numpy as np
import yaml

from app.core.arrays import FloatArray, unit
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.calibration.formats.fields import Fields, intrinsics, pose
from app.tracking.calibration.formats.imported import NAMES, ImportedCamera, stereo_of
from app.tracking.calibration.formats.lenses import lens_coefficients
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import CameraCalibration, StereoCalibration
from app.tracking.optics.lens import LensModel

_NAMES: Final = {lens.value: lens for lens in LensModel} | {"fisheye": LensModel.FISHEYE}
"""Models by their name in files; newer drivers write `fisheye`."""

_SHORT: Final = 8
"""Coefficients of `rational_polynomial` in ROS' own files, which have no thin prism."""


def ros_paths(folder: Path, calibration: StereoCalibration) -> tuple[Path, Path]:
    """Return where the pair goes: `<folder>/<camera>.yaml`."""
    first, second = (folder / f"{camera.name}.yaml" for camera in calibration.cameras)
    return first, second


def write_ros(left: Path, right: Path, calibration: StereoCalibration) -> None:
    """Write the pair, each file whole or not at all.

    Raises:
        CalibrationError: if one camera looks along the line to the other (no rectification
            exists), or a file cannot be written.
    """
    for path, document in zip((left, right), documents(calibration), strict=True):
        try:
            write_atomically(path, yaml.safe_dump(document, sort_keys=False))
        except OSError as error:
            raise CalibrationError(
                sentence(
                    "camera_info cannot be written to {path}: {error_strerror}",
                    path=path,
                    error_strerror=error.strerror or error,
                )
            ) from error


def documents(calibration: StereoCalibration) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the two files' content; see `write_ros`."""
    T_right_left = calibration.pose.transform
    R_left = _rectification(T_right_left)
    R_right = R_left @ T_right_left.rotation.T
    left, right = calibration.cameras
    focal = float(np.mean([left.focal_px[1], right.focal_px[1]]))
    projection = np.zeros((3, 4))
    projection[:, :3] = [
        [focal, 0.0, (left.image_size[0] - 1) / 2.0],
        [0.0, focal, (left.image_size[1] - 1) / 2.0],
        [0.0, 0.0, 1.0],
    ]
    other = projection.copy()
    other[0, 3] = -focal * calibration.baseline
    return _document(left, R_left, projection), _document(right, R_right, other)


def read_ros(left: Path, right: Path, names: tuple[str, str] = NAMES) -> StereoCalibration:
    """Read the pair.

    Raises:
        CalibrationError: naming file, field, value and what is valid.
    """
    first, second = (_camera(Fields(path)) for path in (left, right))
    return stereo_of(first, second, "ROS camera_info", names=names)


def _rectification(T_right_left: RigidTransform) -> FloatArray:
    """Rotation of the left camera to the rectified frame: x along the baseline, z forwards."""
    x = unit(-T_right_left.rotation.T @ T_right_left.translation, "baseline")
    forwards = np.array([0.0, 0.0, 1.0]) + T_right_left.rotation[2]
    z = forwards - np.dot(forwards, x) * x
    if float(np.linalg.norm(z)) < 1e-3:
        raise CalibrationError(
            sentence(
                "the cameras look along the line between them: such a pair has no rectification "
                "and cannot be written as camera_info; export it as yaml"
            )
        )
    z = unit(z)
    return np.stack([x, np.cross(z, x), z])


def _document(
    camera: CameraCalibration, rectification: FloatArray, projection: FloatArray
) -> dict[str, Any]:
    (fx, fy), (cx, cy) = camera.focal_px, camera.centre_px
    matrix = np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
    return {
        "image_width": camera.image_size[0],
        "image_height": camera.image_size[1],
        "camera_name": camera.name,
        "camera_matrix": _matrix(matrix),
        "distortion_model": camera.lens.value,
        "distortion_coefficients": _matrix(np.array([_coefficients(camera)])),
        "rectification_matrix": _matrix(rectification),
        "projection_matrix": _matrix(projection),
    }


def _coefficients(camera: CameraCalibration) -> tuple[float, ...]:
    if camera.lens is LensModel.RATIONAL and not any(camera.distortion[_SHORT:]):
        return camera.distortion[:_SHORT]
    return camera.distortion


def _matrix(values: FloatArray) -> dict[str, Any]:
    return {"rows": values.shape[0], "cols": values.shape[1], "data": values.ravel().tolist()}


def _camera(fields: Fields) -> ImportedCamera:
    lens = _NAMES[fields.text("distortion_model", tuple(_NAMES))]
    where = f"{fields.path}: camera_matrix"
    focal, centre = intrinsics(fields.matrix("camera_matrix", 3, 3), where)
    given = fields.row("distortion_coefficients")
    lens, distortion = lens_coefficients(f"{fields.path}: distortion_coefficients", given, lens)
    rectification = fields.matrix("rectification_matrix", 3, 3)
    rectified = pose(
        np.hstack([rectification, np.zeros((3, 1))]), 1.0, f"{fields.path}: rectification_matrix"
    )
    projection = fields.matrix("projection_matrix", 3, 4)
    intrinsics(projection[:, :3], f"{fields.path}: projection_matrix")
    # P = K'·[I | shift]: the shift of the rectified frame's origin as this camera sees it.
    shift = np.linalg.solve(projection[:, :3], projection[:, 3])
    return ImportedCamera(
        fields.path,
        fields.size(),
        focal,
        centre,
        distortion,
        rectified.inverse() @ RigidTransform.from_translation(shift),
        lens=lens,
    )
