"""Where the needle is: one frozen value for screen, record and score.

`session.fusion` makes it from the robot's direction and the cameras' depth. Each source has its own
clock, so the pose carries both ages; `p_tip` is where the tip is, bent or straight, for everybody.
"""

from dataclasses import dataclass
from enum import StrEnum
from math import inf
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.bend import Bend, needle_curve
from app.tracking.confidence import covariance_radius

DOWN: Final = read_only(np.array([0.0, 0.0, -1.0]))
"""Direction of the vertical needle, hub to tip."""


class DepthSource(StrEnum):
    """Where the depth of a pose comes from."""

    TRACKED = "tracked"
    ONE_CAMERA = "one_camera"  # one camera's ray and the shaft's line: measured, but coarser
    HELD = "held"
    MODEL = "model"
    NONE = "none"


FROM_CAMERAS: Final = (DepthSource.TRACKED, DepthSource.ONE_CAMERA, DepthSource.HELD)
"""Depths that the cameras vouch for: of now, or bridged for at most `TRACKER_HOLD`."""


@dataclass(frozen=True, slots=True, eq=False)
class NeedlePose:
    """Pose of the needle in `world`, SI, always finite.

    Attributes:
        p_tip: tip, of the bent needle where it bends [m], shape (3,), read-only.
        axis: unit direction from hub to tip at the fulcrum, shape (3,), read-only.
        depth: tip beyond the fulcrum along the axis [m].
        time: moment the pose stands for [s].
        orientation_age: age of the encoder values [s].
        depth_age: age of the depth [s]; the state's own age where the model gives it.
        depth_source: where the depth comes from.
        valid: whether the direction may be used; the depth may be only if `measured` says so.
        covariance: of the tip [m²], shape (3, 3), read-only.
        depth_least: least depth that the needle can have [m], see `device.control.depth_interval`;
            minus infinity where nothing is known.
        depth_most: largest depth that it can have [m]; infinity where nothing is known.
        doubt: why depths of the cameras are not believed now; empty if they are.
        rate: of the depth by the cameras [m/s]; 0 where it is not known.
        predicted: how far ahead of the capture of its depth the pose has been moved [s]; 0 for a
            measured pose. Only what is shown is predicted: record, score and force are not.
        snapped: whether the cameras see the tip where robot and simulated tissue say it is; False
            where they see it beside that, as of a needle that bends in earnest: then theirs counts.
        deflection: of the tip from there by both cameras [m]; 0 where it is not known.
        deflection_sigma: standard deviation of `deflection` [m]; 0 where it is not known.
        reason: why the pose is not valid, one line; empty if it is.
        bend: how simulated tissue bends the needle; None for a straight one.
        trusted_depth: depth that the cameras vouched for last [m]; None where they never did.
    """

    p_tip: FloatArray
    axis: FloatArray
    depth: float
    time: float
    orientation_age: float
    depth_age: float
    depth_source: DepthSource
    valid: bool
    covariance: FloatArray
    reason: str = ""
    depth_least: float = -inf
    depth_most: float = inf
    doubt: str = ""
    rate: float = 0.0
    predicted: float = 0.0
    snapped: bool = True
    deflection: float = 0.0
    deflection_sigma: float = 0.0
    bend: Bend | None = None
    trusted_depth: float | None = None

    @property
    def p_straight(self) -> FloatArray:
        """Return where the tip would be if the tissue bent nothing [m], shape (3,)."""
        return self.p_tip if self.bend is None else self.p_tip - self.bend.at(self.depth)

    @property
    def tip_axis(self) -> FloatArray:
        """Direction in which the tip goes on, shape (3,); unit to the second order."""
        return self.axis if self.bend is None else self.axis + self.bend.slope_at(self.depth)

    @property
    def bending(self) -> float | None:
        """Return how far the tip is off the straight needle [m]: by the tissue's model, and by what
        both cameras see beside that; None where neither tells.
        """
        seen = None if self.deflection_sigma == 0.0 else self.deflection
        if self.bend is None or not self.measured:
            return seen
        modelled = float(np.linalg.norm(self.bend.at(self.depth)))
        return modelled if self.snapped or seen is None else modelled + seen

    @property
    def curve(self) -> FloatArray:
        """Points of the inserted part from the fulcrum to the tip [m], shape (n, 3)."""
        return needle_curve(self.p_tip, self.axis, self.depth, self.bend)

    @property
    def radius(self) -> float:
        """Radius [m] round the tip that holds the true one with 95 %."""
        return covariance_radius(self.covariance)

    @property
    def bends(self) -> bool:
        """Return whether the cameras see the tip beside the robot's line, beyond `fusion.GATE`.

        At a lower limit a straight needle would be called bent every few seconds, and one that a
        moved camera shows a little beside its line all the time.
        """
        return not self.snapped and self.deflection > 3.0 * self.deflection_sigma > 0.0

    @property
    def measured(self) -> bool:
        """Return whether the cameras vouch for the depth."""
        return self.valid and self.depth_source in FROM_CAMERAS
