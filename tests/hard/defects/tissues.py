"""Defects of the tissue field's hard cases: labels alone, runs counted twice, edges carried on."""

from typing import Any

import numpy as np

from app.imaging.field.walking import walk
from tests.hard.defects import Defect


def by_labels(field: Any, points: Any) -> Any:
    """Return the nearest voxel's code, and half a voxel in the place of its wall."""
    ijk = np.rint(points).astype(int)
    return field.labels[ijk[:, 2], ijk[:, 1], ijk[:, 0]], np.full(len(points), 0.5)


def edge_goes_on(field: Any, points: Any) -> Any:
    return by_labels(field, np.clip(points, 0.0, np.array(field.labels.shape[::-1]) - 1.0))


def twice(field: Any, points: Any) -> Any:
    crossed = walk(field, points)
    return [*crossed, *crossed]


DEFECTS = {
    "distances": {
        "a wall of tissue across voxels of 1 mm, turned about two axes": Defect(
            "labels alone", by_labels
        ),
        "a needle that lies along a wall of tissue, to 1e-12 mm": Defect(
            "both sides of the wall are met", twice
        ),
        "two membranes at one place": Defect("labels alone", by_labels),
        "a hole of the tissue field, its last voxel, and 1e-9 mm beyond": Defect(
            "the edge goes on", edge_goes_on
        ),
    },
}
