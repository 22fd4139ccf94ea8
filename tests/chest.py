"""A chest of two balls of lung in muscle, with a nodule in the right one: known by formula."""

import numpy as np
from field_rig import ball, beyond, field_of_shapes

from app.imaging.field import TissueField, TissueKind
from app.imaging.series import Series
from app.imaging.volume import Volume

RADIUS, RIGHT, LEFT = 45.0, (-60.0, 0.0, 0.0), (60.0, 0.0, 0.0)
TARGET = np.array([-60.0, -10.0, 0.0])
"""Middle of the nodule, 35 mm below the pleura in front."""

ENTRY = np.array([-60.0, -60.0, 0.0])
CORNER, SIZE, STEP = (-112.0, -62.0, -52.0), (113, 66, 53), 2.0
DOWN = np.array([0.0, 1.0, 0.0])
"""On the back."""

LONG, SHORT = 9.0, 5.0
_HU = {TissueKind.MUSCLE: 50, TissueKind.LUNG: -850, TissueKind.ORGAN: 40, TissueKind.BONE: 400}


def nodule(points):
    """Longer along the patient's left and right than otherwise."""
    away = points - TARGET
    return (np.linalg.norm(away / (LONG, SHORT, SHORT), axis=1) - 1.0) * SHORT


def chest(extra=()) -> TissueField:
    """Return the field; muscle ends at y = -60, where the skin is."""
    shapes = [
        (TissueKind.MUSCLE, "", beyond((0.0, 1.0, 0.0), -60.0)),
        (TissueKind.BONE, "", ball((0.0, 55.0, 0.0), 8.0)),
        (TissueKind.LUNG, "", ball(RIGHT, RADIUS)),
        (TissueKind.LUNG, "", ball(LEFT, RADIUS)),
        (TissueKind.ORGAN, "lung nodule", nodule),
        *extra,
    ]
    return field_of_shapes(shapes, CORNER, SIZE, STEP)


def ct_of(field: TissueField) -> Volume:
    """Return a CT with one Hounsfield value for each kind of tissue."""
    table = np.array([_HU.get(tissue.kind, -1000) for tissue in field.tissues], np.int16)
    k, j, i = field.labels.shape
    series = Series("1", "CT", "", (i, j, k), None, None, None, True, "", (), "CT-1", "", ())
    return Volume(table[field.labels], field.affine_mm, series)
