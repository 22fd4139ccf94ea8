"""Where the needle may be, as the two pictures see it: for aiming the cameras.

The band's centre lies in a cone through the fulcrum: any azimuth, any tilt up to the largest, any
depth of the range. It is sampled so that every part of the cone's angle and every depth counts the
same: the share that both cameras see is a share of directions and depths, not of volume.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.errors import RigError
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleProfile, RangeProfile

_DEPTHS: Final = 31
_TILTS: Final = 9
_AZIMUTHS: Final = 24


@dataclass(frozen=True, slots=True, eq=False)
class ViewCone:
    """The needle's cone in two pictures.

    Attributes:
        names: of the cameras.
        depth: of the tip at each sample [m], shape (n,).
        azimuth: of each sample [rad], shape (n,); 0 leans towards x.
        seen: whether each camera sees the whole band there, shape (n, 2).
        outlines: convex outline of the band's centres in each picture [px], (m, 2); may reach
            beyond the picture; empty if the camera looks another way.
    """

    names: tuple[str, str]
    depth: FloatArray
    azimuth: FloatArray
    seen: NDArray[np.bool_]
    outlines: tuple[FloatArray, FloatArray]

    @property
    def share(self) -> float:
        """Share of the samples that both cameras see, 0 to 1."""
        return float(self.seen.all(axis=1).mean())

    @property
    def shares(self) -> tuple[float, float]:
        """Share that each camera sees, 0 to 1."""
        left, right = self.seen.mean(axis=0)
        return float(left), float(right)

    def share_at(self, lowest: float, highest: float) -> float:
        """Share that both see between two depths [m]; 0 if no sample lies between them."""
        chosen = (self.depth >= lowest - 1e-9) & (self.depth <= highest + 1e-9)
        return float(self.seen[chosen].all(axis=1).mean()) if chosen.any() else 0.0

    def losses(self) -> tuple[str, ...]:
        """Say for each camera at which depths the band is lost; empty if both see all."""
        return tuple(
            text for i, name in enumerate(self.names) if (text := self._loss(i, name)) is not None
        )

    def _loss(self, index: int, name: str) -> str | None:
        lost = ~self.seen[:, index]
        if not lost.any():
            return None
        if lost.all():
            return f"{name} sees nothing of it: the camera looks another way"
        depths = np.unique(self.depth)
        gone = [d for d in depths if lost[self.depth == d].all()]
        part = [d for d in depths if d not in gone and lost[self.depth == d].any()]
        texts = []
        if gone:
            texts.append(f"everything at {_ranges(gone, depths)}")
        if part:
            texts.append(f"part of it at {_ranges(part, depths)}")
        return f"{name} loses {' and '.join(texts)} mm depth"


def view_cone(
    models: tuple[CameraModel, CameraModel],
    needle: NeedleProfile,
    reach: RangeProfile,
    fulcrum: FloatArray,
) -> ViewCone:
    """Project the cone into both pictures.

    Args:
        models: both cameras in world.
        needle: for the band's length and place.
        reach: depths and largest tilt.
        fulcrum: P_I in world [m], shape (3,).

    Raises:
        RigError: if the range is empty.
    """
    if reach.depth_max_mm < reach.depth_min_mm:
        raise RigError(
            f"the range ends at {reach.depth_max_mm:g} mm, above its beginning at "
            f"{reach.depth_min_mm:g} mm; swap depth_min_mm and depth_max_mm"
        )
    depth, azimuth, axis = _samples(reach)
    half = 0.5 * needle.marker_length_mm * MILLIMETRE
    centre = fulcrum + (depth - needle.marker_offset)[:, None] * axis
    seen = np.stack(
        [m.sees(centre - half * axis) & m.sees(centre + half * axis) for m in models], axis=1
    )
    left, right = (_outline(model, centre) for model in models)
    names = (models[0].name, models[1].name)
    return ViewCone(names, depth, azimuth, seen, (left, right))


def _samples(reach: RangeProfile) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Depth, azimuth (n,) and direction (n, 3); equal parts of solid angle in the middle of each.

    The outermost ring lies on the rim, so that the outline is the cone's own.
    """
    lowest, highest = reach.depth_min_mm * MILLIMETRE, reach.depth_max_mm * MILLIMETRE
    depths = np.linspace(lowest, highest, _DEPTHS)
    cosines = np.linspace(1.0, np.cos(reach.tilt_max_deg * DEGREE), _TILTS)
    azimuths = np.linspace(0.0, 2.0 * np.pi, _AZIMUTHS, endpoint=False)
    depth, cosine, azimuth = (a.ravel() for a in np.meshgrid(depths, cosines, azimuths))
    sine = np.sqrt(np.maximum(0.0, 1.0 - cosine**2))
    axis = np.column_stack([sine * np.cos(azimuth), sine * np.sin(azimuth), -cosine])
    return depth, azimuth, axis


def _outline(model: CameraModel, points: FloatArray) -> FloatArray:
    uv, ok = model.project(points)
    if ok.sum() < 3:
        return np.empty((0, 2))
    hull = cv2.convexHull(uv[ok].astype(np.float32))
    return hull.reshape(-1, 2).astype(np.float64)


def _ranges(depths: list[float], all_depths: FloatArray) -> str:
    """Write depths [m] as ranges in mm: `-30 to 25, 110 to 120`."""
    index = [int(np.searchsorted(all_depths, d)) for d in depths]
    pieces: list[list[int]] = []
    for i in index:
        if pieces and i == pieces[-1][-1] + 1:
            pieces[-1].append(i)
        else:
            pieces.append([i])
    mm = all_depths / MILLIMETRE
    return ", ".join(
        f"{mm[p[0]]:.0f} to {mm[p[-1]]:.0f}" if len(p) > 1 else f"{mm[p[0]]:.0f}" for p in pieces
    )
