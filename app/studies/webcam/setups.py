"""Conditions under which the pen is studied."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, unit
from app.core.units import MILLIMETRE
from app.mechanisms.profile import load_profile
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import CameraProfile
from app.tracking.pen.body import PenProfile, TipProfile, load_pen

_FOCAL_PER_WIDTH: Final = 0.97


@dataclass(frozen=True, slots=True)
class Setup:
    """A condition: edge of the cube [mm], distance of the webcam [m], width of its pictures [px],
    height, and noise [grey levels].
    """

    edge_mm: float = 40.0
    distance: float = 0.45
    width: int = 640
    height: int = 480
    noise: float = 4.0

    def pen(self) -> PenProfile:
        """Return the cube of this size, print and tip exact."""
        pen = load_pen("cube")
        body = pen.body.model_copy(
            update={"edge_mm": self.edge_mm, "marker_mm": 0.75 * self.edge_mm, "build_sd_mm": 0.0}
        )
        base = pen.base.model_copy(update={"build_sd_mm": 0.0})
        exact = TipProfile(covariance_mm2=((0.0,) * 3,) * 3, axis_sd_deg=0.0)
        return pen.model_copy(update={"body": body, "base": base, "tip": exact})

    def camera(self) -> CameraModel:
        """Return a webcam in front of the sheet and above it, looking at where the cube is."""
        entry = load_profile("icube").pantograph.fulcrum / MILLIMETRE
        looks_at = entry + np.array([0.0, 0.0, 70.0])
        way = unit([0.15, 0.80, 0.50])
        position = looks_at + self.distance / MILLIMETRE * way
        focal = _FOCAL_PER_WIDTH * self.width
        return CameraProfile(
            name="webcam",
            image_size=(self.width, self.height),
            focal_px=(focal, focal),
            centre_px=(0.5 * (self.width - 1), 0.5 * (self.height - 1)),
            distortion=(-0.05, 0.02, 0.0, 0.0, 0.0),
            position_mm=_triple(position),
            looks_at_mm=_triple(looks_at),
        ).model()


SETUPS: Final = (
    Setup(),
    Setup(edge_mm=30.0),
    Setup(edge_mm=50.0),
    Setup(distance=0.35),
    Setup(distance=0.60),
    Setup(width=1280, height=720),
    Setup(distance=0.60, width=1280, height=720),
    Setup(noise=1.0),
    Setup(noise=8.0),
)


def _triple(values: FloatArray) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return x, y, z
