"""Grayscale Softcopy Presentation State (PS3.3 A.33.1): plan and tip drawn on the slices they meet.

On each slice stands what of the path from entry to target runs through its thickness; entry, target
and tip stand as circles on the slice next to them. Places are in pixels, the upper left corner of
the first one being (0, 0) (C.10.5).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.imaging.results.attempt_facts import AttemptFacts
from app.imaging.results.contours import nearest_slice
from app.imaging.results.errors import ResultsError

_RADIUS_MM: Final = 3.0
_LEAST: Final = 0.05
"""A part of the path shorter than this [pixels] is drawn as a point."""


def presentation(
    highdicom: Any, headers: Sequence[Any], attempt: AttemptFacts, affine_mm: FloatArray
) -> Any:
    """Return the presentation state.

    Raises:
        ResultsError: if neither path nor points meet a slice of the CT.
    """
    layer = highdicom.pr.GraphicLayer("ACUS", 1, description="Plan and tip")
    annotations = [
        highdicom.pr.GraphicAnnotation(
            referenced_images=[headers[k]],
            graphic_layer=layer,
            graphic_objects=[
                highdicom.pr.GraphicObject(kind, data, "PIXEL") for kind, data in drawn
            ],
            text_objects=[
                highdicom.pr.TextObject(text, "PIXEL", anchor_point=tuple(at)) for text, at in texts
            ]
            or None,
        )
        for k, (drawn, texts) in sorted(_drawings(attempt, affine_mm, headers).items())
    ]
    if not annotations:
        raise ResultsError(sentence("the plan of this attempt meets no slice of this CT"))
    series = headers[0].SeriesInstanceUID
    return highdicom.pr.GrayscaleSoftcopyPresentationState(
        referenced_images=list(headers),
        series_instance_uid=attempt.uid("PR series", series),
        series_number=302,
        sop_instance_uid=attempt.uid("PR", series),
        instance_number=1,
        manufacturer="Acus",
        manufacturer_model_name="Acus trainer",
        software_versions="1",
        device_serial_number="0",
        content_label="ACUS_PLAN",
        content_description="Plan and tip of a training attempt",
        graphic_annotations=annotations,
        graphic_layers=[layer],
    )


Drawing = tuple[list[tuple[str, FloatArray]], list[tuple[str, FloatArray]]]


def _drawings(
    attempt: AttemptFacts, affine_mm: FloatArray, headers: Sequence[Any]
) -> dict[int, Drawing]:
    """Return by slice what is drawn there, and what is written."""
    found: dict[int, Drawing] = {}
    rows, columns = int(headers[0].Rows), int(headers[0].Columns)

    def at(k: int) -> Drawing:
        return found.setdefault(k, ([], []))

    start, _ = nearest_slice(attempt.entry_mm, affine_mm)
    end, _ = nearest_slice(attempt.target_mm, affine_mm)
    for k in range(len(headers)):
        part = within(start, end, k)
        if part is not None and _inside(part, rows, columns):
            short = np.linalg.norm(part[1] - part[0]) < _LEAST
            at(k)[0].append(("POINT", part[:1]) if short else ("POLYLINE", part))
    radius = _RADIUS_MM / np.linalg.norm(affine_mm[:3, 0])
    for name, point in attempt.points.items():
        ijk, k = nearest_slice(point, affine_mm)
        centre = ijk[:2] + 0.5
        if 0 <= k < len(headers) and _inside(centre[None], rows, columns):
            at(k)[0].append(("CIRCLE", np.array([centre, centre + np.array([radius, 0.0])])))
            at(k)[1].append((name, centre))
    return found


def within(start: FloatArray, end: FloatArray, k: int) -> FloatArray | None:
    """Return the ends of what of a path runs through slice k, in pixels, shape (2, 2), or None.

    Args:
        start: of the path, in voxels (i, j, k).
        end: likewise.
        k: the slice: half a voxel to both sides.
    """
    along = end[2] - start[2]
    if abs(along) < 1e-9:
        if int(np.rint(start[2])) != k:
            return None
        ends = 0.0, 1.0
    else:
        a, b = sorted(((k - 0.5 - start[2]) / along, (k + 0.5 - start[2]) / along))
        ends = max(0.0, a), min(1.0, b)
        if ends[0] >= ends[1]:
            return None
    return np.array([start[:2] + share * (end[:2] - start[:2]) + 0.5 for share in ends])


def _inside(points: FloatArray, rows: int, columns: int) -> bool:
    return bool((points >= 0.0).all() and (points <= (columns, rows)).all())
