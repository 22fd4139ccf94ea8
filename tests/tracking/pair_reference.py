"""The solver's steps in plain numpy and OpenCV, to hold the compiled ones against."""

import cv2
import numpy as np
from scipy.spatial import ConvexHull

from app.core.rotation import skew
from app.tracking.stereo.epipolar import normalised
from app.tracking.stereo.triangulation import StereoStatus, Way, triangulate

_ANGLES = 2.0 * np.pi * np.arange(24) / 24
_CIRCLE = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)]) * np.sqrt(
    2.0 * np.pi / (24 * np.sin(2.0 * np.pi / 24))
)


def shift_reference(model, needle, p_world, axis_world, single=False):
    """Outline's centroid minus the picture of the band's centre; `single` as OpenCV has it."""
    centre = model.T_camera_world @ p_world
    axis = model.T_camera_world.rotate(axis_world)
    uv, ok = model.project_camera(np.vstack([_body(needle, centre, axis), centre]))
    if not ok.all():
        return None
    uv = uv - uv[-1]
    if single:
        return _shift_in_single_precision(uv)
    outline, shaft = (part[ConvexHull(part).vertices] for part in (uv[:48], uv[48:-1]))
    area, first = _moments(outline)
    common = outline
    for a, b in zip(shaft, np.roll(shaft, -1, axis=0), strict=True):
        common = _cut(common, a, b)
    hidden_area, hidden = _moments(common) if len(common) > 2 else (0.0, np.zeros(2))
    return (first - hidden) / (area - hidden_area)


def _shift_in_single_precision(uv):
    uv = uv.astype(np.float32)
    outline, shaft = (cv2.convexHull(part).reshape(-1, 2) for part in (uv[:48], uv[48:-1]))
    area, first = _moments(outline)
    overlap, common = cv2.intersectConvexConvex(outline, shaft)
    hidden_area, hidden = (0.0, np.zeros(2)) if overlap <= 0 else _moments(common.reshape(-1, 2))
    return (first - hidden) / (area - hidden_area)


def _body(needle, centre, axis):
    turn = skew(axis)
    across = turn[:, int(np.argmin(np.abs(axis)))]
    across = across / np.linalg.norm(across)
    ring = _CIRCLE @ np.array([across, turn @ across])
    if axis @ centre > 0.0:
        stations = [-needle.half, -needle.half - 3.0 * needle.radius]
    else:
        stations = [needle.half, max(needle.half, needle.tip - needle.point), needle.tip]
    ends = [(needle.half, needle.radius), (-needle.half, needle.radius)]
    shaft = [(s, needle.shaft * min(1.0, (needle.tip - s) / needle.point)) for s in stations]
    return np.vstack([centre + s * axis + radius * ring for s, radius in ends + shaft])


def _cut(polygon, a, b):
    kept = []
    for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        sides = [(b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]) for x in (p, q)]
        if sides[0] >= 0.0:
            kept.append(p)
        if (sides[0] >= 0.0) != (sides[1] >= 0.0):
            kept.append(p + sides[0] / (sides[0] - sides[1]) * (q - p))
    return np.array(kept) if kept else np.empty((0, 2))


def _moments(polygon):
    x, y = np.asarray(polygon, dtype=np.float64).T
    nx, ny = np.roll(x, -1), np.roll(y, -1)
    cross = x * ny - nx * y
    sign = np.sign(cross.sum()) or 1.0
    return 0.5 * sign * cross.sum(), sign * np.array([(x + nx) @ cross, (y + ny) @ cross]) / 6.0


def located_reference(models, needle, pixels, spreads, outlines, axis):
    """Triangulate twice, the second time with the outlines moved to the band's centre."""
    poses = tuple(model.T_camera_world for model in models)
    shifts, found = [np.zeros(2), np.zeros(2)], None
    for way in (Way.MIDPOINT, Way.REPROJECTION):
        seen = [normalised(*one) for one in zip(models, pixels - shifts, spreads, strict=True)]
        if seen[0] is None or seen[1] is None:
            return None
        rays, noise = (np.array(part) for part in zip(*seen, strict=True))
        found = triangulate(poses, rays, noise, way)
        if found.status is not StereoStatus.FOUND:
            return found
        for i, outline in enumerate(outlines):
            if outline:
                shifts[i] = shift_reference(models[i], needle, found.p_world, axis)
    return found


def off_line_reference(found, covariance, fulcrum, axis, line_variance):
    """Squared distance from the robot's line in variances, and the way there [m]."""
    offset = found.p_world - fulcrum
    beside = offset - (offset @ axis) * axis
    across = np.eye(3) - np.outer(axis, axis)
    spread = across @ covariance @ across + line_variance * np.eye(3)
    return float(beside @ np.linalg.solve(spread, beside)), beside
