"""Small tissue fields whose boundaries are known by formula."""

from collections.abc import Callable, Sequence

import numpy as np

from app.core.arrays import FloatArray
from app.imaging.field import NOBODYS, FieldTissue, TissueField, TissueKind
from app.imaging.field.band import distances

Level = Callable[[FloatArray], FloatArray]
"""Signed distance of points [mm], shape (n, 3) -> (n,), negative inside."""


def field_of_shapes(
    shapes: Sequence[tuple[TissueKind, str, Level]],
    corner_mm: tuple[float, float, float],
    size: tuple[int, int, int],
    spacing_mm: float = 1.0,
) -> TissueField:
    """Label a grid by shapes that lie over each other, the last on top; code 0 where none is."""
    affine = np.diag([spacing_mm, spacing_mm, spacing_mm, 1.0])
    affine[:3, 3] = corner_mm
    k, j, i = np.indices(size[::-1])
    points = np.stack([i, j, k], axis=-1).reshape(-1, 3) * spacing_mm + np.array(corner_mm)
    labels, level = np.zeros(len(points), np.uint8), np.full(len(points), 6.0)
    for code, (_, _, shape) in enumerate(shapes, start=1):
        at = shape(points)
        level = np.where(at < 0.0, -at, np.minimum(level, np.abs(at)))
        labels[at < 0.0] = code
    distance = distances(
        labels.reshape(size[::-1]),
        (spacing_mm,) * 3,
        lambda a, b: level[a] / (level[a] + level[b]),
    )
    tissues = (
        NOBODYS,
        *(FieldTissue(n, kind, name, 1.0, "test") for n, (kind, name, _) in enumerate(shapes, 1)),
    )
    return TissueField(labels.reshape(size[::-1]), distance, affine, tissues)


def ball(centre: Sequence[float], radius: float) -> Level:
    """Return the signed distance of a ball."""
    return lambda points: np.linalg.norm(points - np.array(centre), axis=1) - radius


def beyond(normal: Sequence[float], depth: float) -> Level:
    """Return the signed distance of all that lies further along a direction than a depth."""
    way = np.array(normal) / np.linalg.norm(normal)
    return lambda points: depth - points @ way
