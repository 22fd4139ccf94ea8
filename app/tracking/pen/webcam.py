"""The webcam's lens: as calibrated, or loudly guessed from the size of the picture."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.optics.calibration import PARAMETERS, CameraCalibration
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.errors import PenError

GUESSED_FOCAL = 0.83
"""Focal length over the longer side of the picture: 62° wide, in the middle of usual webcams."""

_GUESS_SD = {
    "fx": 0.14,
    "fy": 0.14,
    "cx": 0.03,
    "cy": 0.03,
    "k1": 0.1,
    "k2": 0.1,
    "p1": 2e-3,
    "p2": 2e-3,
    "k3": 0.0,
}
"""Standard deviations of the guess; the first four in lengths of the longer side. Focal lengths of
webcams lie between 52° and 78° wide."""


@dataclass(frozen=True, slots=True, eq=False)
class Webcam:
    """One camera's lens.

    Attributes:
        calibration: of the lens.
        guessed: whether it is a guess; then the covariance says how little is known.
    """

    calibration: CameraCalibration
    guessed: bool = False

    @property
    def model(self) -> CameraModel:
        """The camera at the origin: its place follows from the sheet, in each picture."""
        return self.calibration.model(RigidTransform.identity())

    @property
    def parameter_covariance(self) -> FloatArray:
        """Covariance of the lens' parameters, shape (m, m)."""
        return self.calibration.parameter_covariance

    def require_size(self, size: tuple[int, int]) -> None:
        """Refuse pictures of another size.

        Raises:
            PenError: naming both sizes.
        """
        if size != tuple(self.calibration.image_size):
            wide, high = self.calibration.image_size
            raise PenError(
                sentence(
                    "the pictures are {picture_width}x{picture_height}, the calibration is of "
                    "{calibrated_width}x{calibrated_height}; set the webcam to that size or "
                    "calibrate it anew (`acus calibrate mono`)",
                    picture_width=size[0],
                    picture_height=size[1],
                    calibrated_width=wide,
                    calibrated_height=high,
                )
            )

    @property
    def words(self) -> str:
        """Return where the lens is known from, for people."""
        if self.guessed:
            return sentence(
                "THE LENS IS GUESSED from the size of the picture: calibrate it with `acus "
                "calibrate mono`, the needle is several times less certain until then"
            )
        return sentence(
            "lens calibrated ({calibration_views} views, {calibration_rms_px:.2f} px)",
            calibration_views=self.calibration.views,
            calibration_rms_px=self.calibration.rms_px,
        )


def guessed_webcam(size: tuple[int, int], name: str = "webcam") -> Webcam:
    """Guess a webcam's lens from the size of its pictures (width, height) [px].

    Both focal lengths are wrong by the same share, as pixels are square.
    """
    longer = float(max(size))
    deviations = np.array(
        [_GUESS_SD[p] * (longer if i < 4 else 1.0) for i, p in enumerate(PARAMETERS)]
    )
    covariance = np.diag(deviations**2)
    covariance[0, 1] = covariance[1, 0] = 0.9999 * deviations[0] ** 2
    focal = GUESSED_FOCAL * longer
    calibration = CameraCalibration.model_validate(
        {
            "name": name,
            "image_size": size,
            "focal_px": (focal, focal),
            "centre_px": (0.5 * (size[0] - 1), 0.5 * (size[1] - 1)),
            "distortion": (0.0,) * 5,
            "estimated": (),
            "covariance": covariance.tolist(),
        }
    )
    return Webcam(calibration, guessed=True)
