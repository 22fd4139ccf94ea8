"""One step of the tracker on drawn pictures, before the first real ones.

Compiled functions are built, or loaded, when they are first called: without a rehearsal the first
fix of a new build would come half a minute late, and the first of any run some tenths of a second.
"""

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.tracking.cameras.camera import Image
from app.tracking.markers.extractor import Extractor, Hint, MarkerFix
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape, RigProfile
from app.tracking.solver import FixSolver, Sighting

_DOWN = np.array([0.0, 0.0, -1.0])
_GREY, _RED = 120, (40, 30, 205)


def rehearse(
    rig: RigProfile,
    fulcrum: FloatArray,
    extractors: tuple[Extractor, Extractor],
    solver: FixSolver,
) -> None:
    """Find a drawn band of a vertical needle in both pictures, and solve for it; the fix is lost.

    Args:
        rig: cameras and needle.
        fulcrum: P_I in world [m], shape (3,).
        extractors: of both cameras.
        solver: of the rig.
    """
    middle = 0.5 * (rig.range.depth_min_mm + rig.range.depth_max_mm) * MILLIMETRE
    centre = fulcrum + (middle - rig.needle.marker_offset) * _DOWN
    sightings = []
    for model, extractor in zip(rig.models, extractors, strict=True):
        picture, uv = _drawn(model, rig.needle.shape, centre)
        extractor.search(picture)
        found = extractor.find(picture, Hint(uv, centre, _DOWN))
        spread = found.covariance if isinstance(found, MarkerFix) else np.eye(2)
        sightings.append(Sighting(uv, spread))
    solver.solve((sightings[0], sightings[1]), _DOWN, 0.0)
    solver.solve((sightings[0], None), _DOWN, 0.0)


def _drawn(model: CameraModel, needle: NeedleShape, centre: FloatArray) -> tuple[Image, FloatArray]:
    """Picture with a red stroke for the band, and the pixel of its middle, shape (2,)."""
    width, height = model.image_size
    picture = np.full((height, width, 3), _GREY, dtype=np.uint8)
    ends = centre + np.outer([-needle.half, 0.0, needle.half], _DOWN)
    uv, seen = model.project(ends)
    if seen.all():
        distance = float(np.linalg.norm(centre - model.centre))
        thick = max(1, round(2.0 * needle.radius * float(model.intrinsics[0]) / distance))
        top, bottom = (tuple(np.clip(np.rint(p), -1e4, 1e4).astype(int).tolist()) for p in uv[::2])
        cv2.line(picture, top, bottom, _RED, thick, cv2.LINE_AA)
    return picture, uv[1]
