"""Which finds of two pictures may be one point: those on each other's epipolar line.

A point that both cameras show fulfils x₂ᵀ E x₁ = 0 in normalised, undistorted coordinates, whatever
its depth. Pixels with noise miss that by e = x₂ᵀ E x₁ with the variance, to first order,

    σ² = g₁ᵀ Σ₁ g₁ + g₂ᵀ Σ₂ g₂,   g₁ = (Eᵀ x₂)₁,₂,   g₂ = (E x₁)₁,₂

(Sampson's distance is e / σ with equal Σ). Pictures of different times may miss it by what a marker
moves meanwhile, |e| ≤ v |Δt| |g₂| / Z: a bound, not noise.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.continuity import SPEED
from app.tracking.markers.extractor import Centre, MarkerFix
from app.tracking.optics.rig import RigProfile
from app.tracking.solver import systematic_px
from app.tracking.stereo.epipolar import essential_matrix
from app.tracking.stereo.rays import normalised

SIGMAS: Final = 4.5
"""Distance [standard deviations] up to which two finds may be one point."""

HOPELESS: Final = 12.0
"""Distance [standard deviations], some 8 px for two outlines, from which two finds are two things
and not the marker before a bumped camera: `health` takes no more for one either."""

_OUTLINE_PX: Final = 0.5
"""How far an outline's centroid may be from the picture of the band's centre [px]."""


@dataclass(frozen=True, slots=True, eq=False)
class Pairing:
    """A find of the first picture with one of the second.

    Attributes:
        first, second: the finds.
        apart: distance from the epipolar line beyond what the skew explains, in standard
            deviations; infinite where a pixel has no ray.
    """

    first: MarkerFix
    second: MarkerFix
    apart: float

    @property
    def agrees(self) -> bool:
        """Whether both may be one point."""
        return self.apart <= SIGMAS

    @property
    def hopeless(self) -> bool:
        """Whether not even a camera that was bumped explains the distance."""
        return self.apart > HOPELESS


class EpipolarGate:
    """Compares the finds of a rig's two cameras; holds the rig, no memory."""

    def __init__(self, rig: RigProfile) -> None:
        self._models = rig.models
        poses = (self._models[0].T_camera_world, self._models[1].T_camera_world)
        self._essential = essential_matrix(poses)
        self._systematic = systematic_px(rig) ** 2
        self._distance = _distance(rig)

    def pairings(
        self, firsts: list[MarkerFix], seconds: list[MarkerFix], dt: float
    ) -> list[Pairing]:
        """Every pairing, those that agree best first.

        Args:
            firsts: finds in the first camera's picture.
            seconds: in the second's.
            dt: time between the two captures [s].
        """
        pairs = [Pairing(a, b, self._apart(a, b, dt)) for a in firsts for b in seconds]
        return sorted(pairs, key=lambda pair: pair.apart)

    def _apart(self, first: MarkerFix, second: MarkerFix, dt: float) -> float:
        seen = [self._ray(camera, fix) for camera, fix in enumerate((first, second))]
        if seen[0] is None or seen[1] is None:
            return float("inf")
        (x1, s1), (x2, s2) = seen[0], seen[1]
        line2 = self._essential @ np.append(x1, 1.0)
        line1 = self._essential.T @ np.append(x2, 1.0)
        miss = abs(float(line2 @ np.append(x2, 1.0)))
        moved = SPEED * abs(dt) / self._distance * float(np.linalg.norm(line2[:2]))
        variance = float(line1[:2] @ s1 @ line1[:2] + line2[:2] @ s2 @ line2[:2])
        return max(0.0, miss - moved) / float(np.sqrt(variance)) if variance > 0.0 else 0.0

    def _ray(self, camera: int, fix: MarkerFix) -> tuple[FloatArray, FloatArray] | None:
        shift = _OUTLINE_PX**2 if fix.centre is Centre.OUTLINE else 0.0
        covariance = fix.covariance + (self._systematic + shift) * np.eye(2)
        return normalised(self._models[camera], fix.uv, covariance)


def _distance(rig: RigProfile) -> float:
    """Distance [m] of the second camera from where both optical axes come closest."""
    (c1, d1), (c2, d2) = ((m.centre, m.T_world_camera.rotation[:, 2]) for m in rig.models)
    along = np.linalg.lstsq(np.column_stack([d1, -d2]), c2 - c1, rcond=None)[0]
    return max(float(along[1]), 0.05)
