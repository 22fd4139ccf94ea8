"""Skin and structures of a run as a few thousand triangles, for programs that draw them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from app.core.arrays import FloatArray
from app.core.identifiers import without_identifiers
from app.core.units import MILLIMETRE
from app.exchange.moment import LiveSurface
from app.imaging.body import find_body
from app.session.risks import Risk

if TYPE_CHECKING:
    from app.imaging.volume import Volume

SKIN: Final = "skin"
SKIN_TRIANGLES: Final = 6000
STRUCTURE_TRIANGLES: Final = 1500


def live_surfaces(volume: Volume | None, risks: Iterable[Risk]) -> tuple[LiveSurface, ...]:
    """Return the skin, where a CT is open, and the structures of risk.

    Takes some tenths of a second on a large CT, of a thread that nobody waits for.
    """
    surfaces = []
    if volume is not None:
        body = find_body(volume)
        affine = np.array(volume.affine_mm, np.float64)
        affine[:3, :3] *= body.factors
        smooth = gaussian_filter(np.asarray(body.coarse, np.float32), 0.7, mode="nearest")
        surfaces.append(_closed(SKIN, smooth - 0.5, affine, SKIN_TRIANGLES, skin=True))
    for risk in risks:
        field = risk.field
        affine = np.diag([field.step_mm, field.step_mm, field.step_mm, 1.0])
        affine[:3, 3] = field.start_mm
        name = without_identifiers(risk.name)
        surfaces.append(_closed(name, -field.values, affine, STRUCTURE_TRIANGLES))
    return tuple(surface for surface in surfaces if len(surface.triangles))


def _closed(
    name: str, values: NDArray[Any], affine_mm: FloatArray, most: int, skin: bool = False
) -> LiveSurface:
    """Return the surface round what is above 0; what lies beyond the grid is outside."""
    from app.views.scene.mesh import isosurface  # VTK is loaded where a link asks for surfaces

    outside = -float(np.abs(values).max(initial=1.0))
    affine = np.array(affine_mm)
    affine[:3, 3] -= affine[:3, :3].sum(axis=1)  # the layer around it
    padded = np.pad(np.asarray(values, np.float32), 1, constant_values=outside)
    mesh = isosurface(padded, affine, 0.0, most)
    points = mesh.points.astype(np.float64) * MILLIMETRE
    return LiveSurface(name, points, mesh.triangles.astype(np.int64), skin)
