"""Whether a calibration is of these cameras and pictures; refused by name if it is not."""

from collections.abc import Sequence

from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import CameraCalibration, StereoCalibration


def require_size(
    camera: CameraCalibration, image_size: tuple[int, int], picture: str = "the picture"
) -> None:
    """Refuse a picture of another size than the camera was calibrated at.

    Raises:
        CalibrationError: naming both sizes, and what to do.
    """
    if tuple(image_size) != tuple(camera.image_size):
        (w, h), (cw, ch) = image_size, camera.image_size
        raise CalibrationError(
            f"{picture} has {w}x{h} pixels; camera {camera.name} was calibrated at {cw}x{ch}: set "
            "the camera to that size, or calibrate at the new one"
        )


def require_cameras(
    calibration: StereoCalibration,
    names: Sequence[str],
    sizes: Sequence[tuple[int, int]],
) -> None:
    """Refuse a calibration of other cameras, of swapped ones, or of other picture sizes.

    Args:
        calibration: that is to be used.
        names: of the two cameras in use, left and right.
        sizes: width, height [px] of their pictures.

    Raises:
        CalibrationError: naming what differs, and what to do.
    """
    known = [camera.name for camera in calibration.cameras]
    if list(names) == known[::-1] and names[0] != names[1]:
        raise CalibrationError(
            f"the cameras are swapped: calibration {calibration.id} has {known[0]} on the left and "
            f"{known[1]} on the right; exchange the two sources"
        )
    if list(names) != known:
        raise CalibrationError(
            f"calibration {calibration.id} is of the cameras {', '.join(known)}; in use are "
            f"{', '.join(names)}: use their calibration, or calibrate them"
        )
    for camera, size in zip(calibration.cameras, sizes, strict=True):
        require_size(camera, size, f"the picture of camera {camera.name}")
