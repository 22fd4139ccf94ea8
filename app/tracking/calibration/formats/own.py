"""The own file: one YAML with everything that a calibration says."""

from collections.abc import Mapping
from pathlib import Path

import yaml

from app.core.configuration import parse, read_yaml
from app.core.errors import ConfigurationError
from app.core.files import write_atomically
from app.core.messages import sentence, sentence_of
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import CameraCalibration, StereoCalibration

_HEAD = """\
# Calibration of two cameras. Lengths in mm, angles in rad, pictures in px (pixel 0, 0 is the
# centre of the upper left pixel). pose takes points of the left camera to the right one;
# world takes points of the left camera to the robot's frame.
"""


_HEAD_OF_ONE = """\
# Calibration of one camera. Pictures in px (pixel 0, 0 is the centre of the upper left pixel);
# covariance of fx, fy, cx, cy and the lens' coefficients: of plumb_bob k1, k2, p1, p2, k3.
"""


def save_calibration(path: Path, calibration: StereoCalibration) -> None:
    """Write a calibration, whole or not at all.

    Raises:
        CalibrationError: if the file cannot be written.
    """
    try:
        write_atomically(path, text_of(calibration))
    except OSError as error:
        raise CalibrationError(
            sentence(
                "calibration {calibration_id} cannot be written to {path}: "
                "{error_strerror}; choose another place",
                calibration_id=calibration.id,
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error


def save_camera(path: Path, camera: CameraCalibration) -> None:
    """Write the lens of one camera, whole or not at all.

    Raises:
        CalibrationError: if the file cannot be written.
    """
    text = yaml.safe_dump(camera.model_dump(mode="json"), sort_keys=False, allow_unicode=True)
    try:
        write_atomically(path, _HEAD_OF_ONE + text)
    except OSError as error:
        raise CalibrationError(
            sentence(
                "the lens of {camera_name} cannot be written to {path}: "
                "{error_strerror}; choose another place",
                camera_name=camera.name,
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error


def text_of(calibration: StereoCalibration) -> str:
    """Return the file's text; numbers come back from it to the last bit."""
    document = calibration.model_dump(mode="json")
    return _HEAD + yaml.safe_dump(document, sort_keys=False, allow_unicode=True, width=100)


def load_calibration(path: Path) -> StereoCalibration:
    """Read a calibration.

    Raises:
        CalibrationError: naming the file, the field, the value and what would be valid.
    """
    try:
        document = read_yaml(path)
        if isinstance(document, Mapping) and "focal_px" in document:
            raise CalibrationError(
                sentence(
                    "{path} is the lens of one camera; a calibration holds two and how they "
                    "stand to each other. A pen takes it (`acus pen calibrate --lens`); for two "
                    "cameras calibrate pairs of pictures (`acus calibrate stereo`)",
                    path=path,
                )
            )
        calibration = parse(document, StereoCalibration, str(path))
        calibration.models()  # an impossible camera or pose is refused here, not later
    except ConfigurationError as error:
        raise CalibrationError(sentence_of(error)) from error
    except ArithmeticError as error:
        raise CalibrationError(
            sentence("{path}: pose or camera cannot be: {error}", path=path, error=error)
        ) from error
    return calibration
