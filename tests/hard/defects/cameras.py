"""Defects of the cameras' hard cases: corners moved, rays and lenses by textbook formulas."""

from dataclasses import replace
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.calibration.mono import calibrate_mono
from app.tracking.calibration.poses import board_pose
from app.tracking.calibration.views import BoardView
from app.tracking.stereo.triangulation import Way, triangulate
from tests.hard.defects import Defect


def in_single(poses: Any, seen: Any, spread: Any) -> Any:
    return triangulate(poses, np.float32(seen).astype(float), spread)


def by_cosine(first: Any, second: Any) -> Any:
    (p1, d1), (p2, d2) = first, second
    offset, c = p2 - p1, float(d1 @ d2)
    sine2 = max(1.0 - c * c, 1e-300)
    return p1 + float(offset @ d1 - c * (offset @ d2)) / sine2 * d1, p2


def unscaled(poses: Any, seen: Any) -> FloatArray:
    rows = np.empty((4, 4))
    for i, (pose, (x, y)) in enumerate(zip(poses, seen, strict=True)):
        camera = np.column_stack([pose.rotation, pose.translation])
        rows[2 * i], rows[2 * i + 1] = x * camera[2] - camera[0], y * camera[2] - camera[1]
    vector = np.linalg.svd(rows.T @ rows)[2][-1]
    return np.asarray(vector[:3] / vector[3])


def five_rounds(x: float, y: float, c: Any, fold: float) -> Any:
    """OpenCV's own: five rounds of a fixed point."""
    k1, k2, p1, p2, k3 = c
    a, b = x, y
    for _ in range(5):
        r2 = a * a + b * b
        radial = 1.0 + k1 * r2 + k2 * r2**2 + k3 * r2**3
        dx = 2.0 * p1 * a * b + p2 * (r2 + 2.0 * a * a)
        dy = p1 * (r2 + 2.0 * b * b) + 2.0 * p2 * a * b
        a, b = (x - dx) / radial, (y - dy) / radial
    return a, b, True


def half_a_pixel_off(views: Any, name: str, hold_back: int) -> Any:
    shifted = [replace(view, pixels=view.pixels + 0.5) for view in views]
    return calibrate_mono(shifted, name, hold_back)


def shifted(view: BoardView, p: FloatArray) -> Any:
    return board_pose(replace(view, pixels=view.pixels + 0.01), p)


DEFECTS = {
    "triangulation": {
        **dict.fromkeys(
            (f"a point {metres} m away" for metres in (1, 100, 10000)),
            Defect("observations in single precision", in_single),
        ),
        "the point of least reprojection error of two rays that miss each other": Defect(
            "direct linear transformation",
            lambda poses, seen, spread: triangulate(poses, seen, spread, Way.LINEAR),
        ),
        "where two lines 1e-6 rad from parallel are closest": Defect(
            "1 - cos² in the denominator", by_cosine
        ),
        "linear triangulation 10 km from the world's origin": Defect(
            "rows as they come, and AᵀA", unscaled
        ),
        **dict.fromkeys(
            (
                "ray of a pixel at a radius of 0.40",
                "ray of a pixel at a radius of 0.46, at the edge of the fold",
            ),
            Defect("five rounds of a fixed point", five_rounds),
        ),
    },
    "calibration": {
        "a camera from six exact views of a flat board": Defect(
            "pixels counted from their corners", half_a_pixel_off
        ),
        **dict.fromkeys(
            (
                "pose of a board square to the axis",
                "pose of a board seen 5° from its edge",
                "pose of a board upside down",
            ),
            Defect("corners 0.01 px off", shifted),
        ),
    },
}
