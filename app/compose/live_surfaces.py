"""Skin and structures of a run as a few thousand triangles, for programs that draw them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

import numpy as np
from scipy.ndimage import gaussian_filter

from app.core.identifiers import without_identifiers
from app.core.units import MILLIMETRE
from app.exchange.moment import LiveSurface
from app.imaging.body import find_body
from app.imaging.coarse_surface import CoarseSurface, coarse_surface
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
    found = []
    if volume is not None:
        body = find_body(volume)
        affine = np.array(volume.affine_mm, np.float64)
        affine[:3, :3] *= body.factors
        smooth = gaussian_filter(np.asarray(body.coarse, np.float32), 0.7, mode="nearest")
        found.append(_surface(SKIN, coarse_surface(smooth, affine, 0.5, SKIN_TRIANGLES), True))
    for risk in risks:
        field = risk.field
        affine = np.diag([field.step_mm, field.step_mm, field.step_mm, 1.0])
        affine[:3, 3] = field.start_mm
        surface = coarse_surface(-field.values, affine, 0.0, STRUCTURE_TRIANGLES)
        found.append(_surface(without_identifiers(risk.name), surface, False))
    return tuple(one for one in found if len(one.triangles))


def _surface(name: str, surface: CoarseSurface, skin: bool) -> LiveSurface:
    return LiveSurface(name, surface.points_mm * MILLIMETRE, surface.triangles, skin)
