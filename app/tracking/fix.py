"""The needle as the cameras have it at one moment."""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.tracking.confidence import covariance_radius
from app.tracking.discrepancy import Discrepancy

AGREED: Final = Discrepancy()

DIRECTION_SIGMA: Final = 1.0e-4
"""Standard deviation of the direction [rad]: one encoder count is 0.02° of needle, / √12. What the
robot's own calibration leaves is in the rig's `line_sd_mm`, the agreement of line and cameras."""

GATE: Final = 1e-5
"""Probability with which a tip on the line is taken for one beside it."""


class FixStatus(StrEnum):
    """Whether the tip is known, and if not, why."""

    VALID = "valid"
    OUT_OF_VIEW = "out_of_view"  # no camera shows the marker
    NOT_YET_VISIBLE = "not_yet_visible"  # the marker is inside the tube, where no camera sees it
    ONE_CAMERA = "one_camera"  # one does; `missing` names the other; often there is a point
    NO_PICTURE = "no_picture"  # a camera has given no picture in time
    INCONSISTENT = "inconsistent"  # the pictures contradict each other or the robot
    NO_ORIENTATION = "no_orientation"  # the robot gives no axis, so the tip cannot be told


@dataclass(frozen=True, slots=True, eq=False)
class NeedleFix:
    """Where the tip is, by the cameras.

    Attributes:
        p_tip_world: the tip [m], shape (3,); zero unless `has_point`.
        covariance: of the tip [m²], shape (3, 3), with everything that is known to be uncertain:
            pictures and calibration; zero unless `has_point`.
        time: when the pictures were captured [s].
        status: see `usable` for whether there is a measurement.
        pixels: where each camera shows the marker's outline [px], None where it does not.
        residual_px: root mean square of the reprojection error [px]; 0 unless `has_point`.
        depth: of the tip beyond the fulcrum along the axis [m]; 0 unless `has_point`.
        depth_variance: of it [m²].
        missing: names of the cameras that do not show the marker.
        has_point: whether there is a tip at all (`valid`, most of `inconsistent`, and of
            `one_camera` where one ray and the robot's line meet at a good angle).
        reason: one line for people; empty when valid.
        noise_covariance: the share of `covariance` that differs from picture to picture [m²]; the
            rest, by the calibration, is the same in all and does not average out. Without it
            everything counts as noise.
        beside: from the robot's line to the band, across it [m], shape (3,); a bent needle, or one
            of the two sources is off. Zero unless both cameras give a point.
        epipolar: how far the pictures miss each other, signed, in standard deviations; 0 unless
            both cameras give a point.
        line_variance: of the robot's line across itself [m²] while the tip is the cameras' alone;
            None if the line has been used to find it.
        discrepancy: what the last seconds say about why cameras and robot disagree.
        axis: needle's direction by the robot when the pictures were captured, unit, shape (3,);
            None where the robot does not give one.
        axis_world: needle's direction, hub to tip, by the cameras: from the second band to the
            first; unit, shape (3,). None unless both cameras see both bands.
        axis_covariance: of it, shape (3, 3), with the calibration's share: no length, so none along
            itself. None without `axis_world`.
    """

    p_tip_world: FloatArray
    covariance: FloatArray
    time: float
    status: FixStatus
    pixels: tuple[FloatArray | None, FloatArray | None]
    residual_px: float
    depth: float = 0.0
    depth_variance: float = 0.0
    missing: tuple[str, ...] = ()
    has_point: bool = False
    reason: str = ""
    noise_covariance: FloatArray | None = None
    beside: FloatArray = field(default_factory=lambda: np.zeros(3))
    epipolar: float = 0.0
    line_variance: float | None = None
    discrepancy: Discrepancy = AGREED
    axis: FloatArray | None = None
    axis_world: FloatArray | None = None
    axis_covariance: FloatArray | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_tip_world", frozen(self.p_tip_world, (3,), "tip"))
        object.__setattr__(self, "covariance", frozen(self.covariance, (3, 3), "covariance"))
        noise = self.covariance if self.noise_covariance is None else self.noise_covariance
        object.__setattr__(self, "beside", frozen(self.beside, (3,), "beside"))
        object.__setattr__(self, "noise_covariance", frozen(noise, (3, 3), "noise covariance"))
        if self.axis is not None:
            object.__setattr__(self, "axis", frozen(self.axis, (3,), "axis"))
        if self.axis_world is not None:
            object.__setattr__(self, "axis_world", frozen(self.axis_world, (3,), "axis"))
        if self.axis_covariance is not None:
            spread = frozen(self.axis_covariance, (3, 3), "axis covariance")
            object.__setattr__(self, "axis_covariance", spread)

    @property
    def usable(self) -> bool:
        """Return whether the tip may be used as a measurement, with its covariance, however
        large.
        """
        known = self.status is FixStatus.VALID or (
            self.status is FixStatus.ONE_CAMERA and self.has_point
        )
        return known and bool(
            np.isfinite(self.time)
            and np.isfinite(self.p_tip_world).all()
            and np.isfinite(self.covariance).all()
        )

    def radius(self, probability: float = 0.95) -> float:
        """Radius [m] round the tip that holds the true one with `probability`."""
        return covariance_radius(self.covariance, probability)


def without_point(
    status: FixStatus,
    pixels: tuple[FloatArray | None, FloatArray | None],
    time: float,
    missing: tuple[str, ...] = (),
    reason: str = "",
) -> NeedleFix:
    """Return a fix that says why there is none."""
    return NeedleFix(
        np.zeros(3), np.zeros((3, 3)), time, status, pixels, 0.0, missing=missing, reason=reason
    )
