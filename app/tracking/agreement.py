"""What two pictures confirm of each other, and when one alone is believed.

On each other's epipolar line: a point that both cameras show fulfils x₂ᵀ E x₁ = 0 in normalised,
undistorted coordinates, whatever its depth. Pixels with noise miss that by e = x₂ᵀ E x₁ with the
variance, to first order,

    σ² = g₁ᵀ Σ₁ g₁ + g₂ᵀ Σ₂ g₂,   g₁ = (Eᵀ x₂)₁,₂,   g₂ = (E x₁)₁,₂

(Sampson's distance is e / σ with equal Σ). Pictures of different times may miss it by what a marker
moves meanwhile, |e| ≤ v |Δt| |g₂| / Z: a bound, not noise.

Two pictures confirm each other; one alone shows the needle's line and every red thing on it. So the
depth by one camera counts while it continues, without a gap and no faster than a hand, a depth that
both cameras have measured, and by a find that can be nothing but the marker (`MarkerFix.alone`).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.extractor import Centre, MarkerFix
from app.tracking.motion.depth_filter import FASTEST
from app.tracking.optics.rig import RigProfile
from app.tracking.solver import systematic_px
from app.tracking.stereo.epipolar import essential_matrix, normalised

MEMORY = 1.0
"""Time [s] without a depth after which one camera alone is not believed any more."""

SPEED = FASTEST
"""Fastest change of depth [m/s] that is believed."""

DEPTH_SIGMAS = 4.0
"""Noise of both depths [standard deviations] that is allowed for."""


class Continuity:
    """Remembers the last depth that was believed."""

    def __init__(self) -> None:
        self._last: NeedleFix | None = None

    def judge(self, fix: NeedleFix, result: Sequence[MarkerFix] = ()) -> NeedleFix:
        """Return the fix, without its point if it is not to be believed.

        Args:
            fix: by one camera or two.
            result: what it was made of.
        """
        if not fix.usable:
            return fix
        alone = all(one.alone for one in result)
        if fix.status is FixStatus.VALID:
            if not alone and all(one.centre is Centre.OUTLINE for one in result):
                return _without(
                    fix,
                    FixStatus.INCONSISTENT,
                    "no fit holds: the marker is partly hidden, or it is another red thing",
                )
            self._last = fix
            return fix
        if alone and self._continues(fix):
            self._last = fix
            return fix
        return _without(
            fix,
            fix.status,
            f"{fix.reason.split(':')[0]}: what the other one sees may be any red thing on "
            "the needle's line until both have seen it",
        )

    def clear(self) -> None:
        """Forget it: both cameras have to see the marker before one is believed."""
        self._last = None

    def _continues(self, fix: NeedleFix) -> bool:
        last = self._last
        if last is None:
            return False
        gap = fix.time - last.time
        if not 0.0 <= gap <= MEMORY:
            return False
        noise = DEPTH_SIGMAS * float(np.sqrt(fix.depth_variance + last.depth_variance))
        return abs(fix.depth - last.depth) <= SPEED * gap + noise


def _without(fix: NeedleFix, status: FixStatus, reason: str) -> NeedleFix:
    zero = np.zeros((3, 3))
    return replace(
        fix,
        status=status,
        p_tip_world=np.zeros(3),
        covariance=zero,
        noise_covariance=zero,
        depth=0.0,
        depth_variance=0.0,
        residual_px=0.0,
        has_point=False,
        reason=reason,
    )


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
        """Return whether both may be one point."""
        return self.apart <= SIGMAS

    @property
    def hopeless(self) -> bool:
        """Return whether not even a camera that was bumped explains the distance."""
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
