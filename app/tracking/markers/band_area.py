"""How much of the band an outline shows: one that is too small is no outline of a whole band.

What hides the share h of a band from an end moves the outline's centroid by h times half its
length, from a side by h times half its width. A camera's tone curve makes the paint's share of an
edge look smaller: outlines of whole bands have 0.87 to 1.03 of the area that they should have in
pictures of another renderer (sRGB, JPEG), 99 of 100 of them.
"""

import math
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.markers.extractor import Hint, MarkerFix, Miss, MissReason
from app.tracking.markers.silhouette import visible_area
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

LEAST: Final = 0.87
"""Share of the area from which on a band may be seen whole."""

WHOLE: Final = 0.97
"""Share of the area of a band that is surely seen whole."""


def judged_by_area(
    fix: MarkerFix, model: CameraModel, shape: NeedleShape, hint: Hint
) -> MarkerFix | Miss:
    """Refuse an outline that is too small for the whole band, state what may be hidden of others.

    Without the band's place and the needle's axis in the hint nothing is known of its size.

    Args:
        fix: an outline's centroid.
        model: the camera.
        shape: of the needle.
        hint: where the band is.
    """
    if hint.p_world is None or hint.axis_world is None:
        return fix
    area = visible_area(model, shape, hint.p_world, hint.axis_world)
    if not area > 0.0:
        return fix
    share = fix.area / area
    if share < LEAST:
        return Miss(MissReason.PARTLY_HIDDEN, fix.uv)
    hidden = max(0.0, WHOLE - share)
    if hidden == 0.0:
        return fix
    doubt = _doubt(hidden, model, shape, hint.p_world, hint.axis_world)
    return fix.with_covariance(fix.covariance + doubt)


def _doubt(
    hidden: float,
    model: CameraModel,
    shape: NeedleShape,
    p_world: FloatArray,
    axis_world: FloatArray,
) -> FloatArray:
    """Return the covariance by a hidden share that comes from an end or a side [px²], (2, 2)."""
    ends, seen = model.project(p_world + np.outer([shape.half, -shape.half], axis_world))
    if not seen.all():
        return np.zeros((2, 2))
    along = 0.5 * (ends[0] - ends[1])
    depth = float(model.T_camera_world.rotation[2] @ (p_world - model.centre))
    wide = shape.radius * math.sqrt(float(np.prod(model.intrinsics[:2]))) / max(depth, 1e-6)
    across = wide * np.array([-along[1], along[0]]) / max(float(np.linalg.norm(along)), 1e-6)
    doubt: FloatArray = hidden**2 * (np.outer(along, along) + np.outer(across, across))
    return doubt
