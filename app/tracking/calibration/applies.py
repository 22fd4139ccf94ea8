"""Whether a calibration is of these cameras and pictures; refused by name if it is not."""

from collections.abc import Sequence

from app.core.messages import sentence
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
            sentence(
                "{picture} has {w}x{h} pixels; camera {camera_name} was calibrated at {cw}x{ch}: "
                "set the camera to that size, or calibrate at the new one",
                picture=picture,
                w=w,
                h=h,
                camera_name=camera.name,
                cw=cw,
                ch=ch,
            )
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
            sentence(
                "the cameras are swapped: calibration {calibration_id} has {left_camera} on the "
                "left and {right_camera} on the right; exchange the two sources",
                calibration_id=calibration.id,
                left_camera=known[0],
                right_camera=known[1],
            )
        )
    if list(names) != known:
        raise CalibrationError(
            sentence(
                "calibration {calibration_id} is of the cameras {known}; in use are "
                "{names}: use their calibration, or calibrate them",
                calibration_id=calibration.id,
                known=", ".join(known),
                names=", ".join(names),
            )
        )
    for camera, size in zip(calibration.cameras, sizes, strict=True):
        require_size(camera, size, f"the picture of camera {camera.name}")
