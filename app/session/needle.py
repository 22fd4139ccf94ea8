"""The needle's pose from both of its sources: direction from the robot, depth from the cameras.

tip = P_I + depth·d̂. The robot gives d̂ every tick; the cameras give the tip, and `tracking.fusion`
says how deep that is on the robot's line. Each source has its own clock, so the pose carries both
ages.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from app.core import state_vector as slots
from app.core.arrays import FloatArray, read_only
from app.core.staleness import ENCODER_ZERO, TRACKER_FRESH, TRACKER_HOLD
from app.session.measured import across_sigma, is_one_eyed, is_usable, tip_of
from app.session.ports import DeviceStatePort, FixPort
from app.tracking.confidence import covariance_radius
from app.tracking.fusion import DIRECTION_SIGMA
from app.tracking.motion.depth_filter import HAND_SPEED

ORIENTATION_SIGMA: Final = DIRECTION_SIGMA
"""Standard deviation of the direction [rad]."""

MODEL_SIGMA: Final = 0.03
"""Standard deviation of the model's depth [m]: the needle slides freely in its tube, so the
model only says where it would be (declared, not measured)."""

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
        p_tip: tip [m], shape (3,), read-only.
        axis: unit direction from hub to tip, shape (3,), read-only.
        depth: tip beyond the fulcrum along the axis [m].
        time: moment the pose stands for [s].
        orientation_age: age of the encoder values [s].
        depth_age: age of the depth [s]; the state's own age where the model gives it.
        depth_source: where the depth comes from.
        valid: whether direction and depth may be used; the depth is measured only if
            `measured` says so too.
        covariance: of the tip [m²], shape (3, 3), read-only.
        rate: of the depth by the cameras [m/s]; 0 where it is not known.
        predicted: how far ahead of the capture of its depth the pose has been moved [s]; 0 for a
            measured pose. Only what is shown is predicted: record, score and force are not.
        snapped: whether the tip stands on the robot's line; False where the cameras see it beside
            that, as of a bent needle.
        deflection: of the tip from the robot's line by both cameras [m]; 0 where it is not known.
        deflection_sigma: standard deviation of `deflection` [m]; 0 where it is not known.
        reason: why the pose is not valid, one line; empty if it is.
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
    rate: float = 0.0
    predicted: float = 0.0
    snapped: bool = True
    deflection: float = 0.0
    deflection_sigma: float = 0.0

    @property
    def radius(self) -> float:
        """Radius [m] round the tip that holds the true one with 95 %."""
        return covariance_radius(self.covariance)

    @property
    def bends(self) -> bool:
        """Whether the cameras see the tip beside the robot's line, beyond `fusion.GATE`.

        At a lower limit a straight needle would be called bent every few seconds, and one that a
        moved camera shows a little beside its line all the time.
        """
        return not self.snapped and self.deflection > 3.0 * self.deflection_sigma > 0.0

    @property
    def measured(self) -> bool:
        """Whether the cameras vouch for the depth."""
        return self.valid and self.depth_source in FROM_CAMERAS


def fuse(
    device: DeviceStatePort, fix: FixPort | None, now: float, last: NeedlePose | None = None
) -> NeedlePose:
    """Fuse the robot's direction and the cameras' depth into one pose; never NaN.

    Args:
        device: newest state of the loop.
        fix: newest *usable* fix of the tracker, or None before the first. Another is not used.
        now: present time [s].
        last: pose before this one; its numbers are repeated, marked invalid, where the robot
            gives nothing usable.
    """
    axis = np.asarray(device.axis, dtype=np.float64)
    fault = _device_fault(device, axis, now)
    if fault:
        return _invalid(last, now, fault, _age(encoder_time(device), now))
    axis = axis / np.linalg.norm(axis)
    fulcrum = np.asarray(device.tip) - device.depth * np.asarray(device.axis)
    if fix is not None and is_usable(fix) and _age(fix.time, now) <= TRACKER_HOLD:
        return _measured(device, fix, fulcrum, axis, now)
    depth = float(device.depth)
    return NeedlePose(
        p_tip=read_only(fulcrum + depth * axis),
        axis=read_only(axis),
        depth=depth,
        time=now,
        orientation_age=_age(encoder_time(device), now),
        depth_age=_age(device.time, now),
        depth_source=DepthSource.MODEL,
        valid=True,
        covariance=read_only(tip_covariance(axis, depth, MODEL_SIGMA**2)),
    )


def _measured(
    device: DeviceStatePort, fix: FixPort, fulcrum: FloatArray, axis: FloatArray, now: float
) -> NeedlePose:
    """Pose with a depth by the cameras, from `fulcrum` [m] along the unit `axis`."""
    tip = tip_of(fix, fulcrum, axis)
    age = _age(fix.time, now)
    fresh = DepthSource.ONE_CAMERA if is_one_eyed(fix) else DepthSource.TRACKED
    aged = (HAND_SPEED * age) ** 2 * np.outer(axis, axis)
    both = fix.line_variance is not None
    return NeedlePose(
        p_tip=tip.p_tip,
        axis=read_only(axis),
        depth=tip.depth,
        time=now,
        orientation_age=_age(encoder_time(device), now),
        depth_age=age,
        depth_source=fresh if age <= TRACKER_FRESH else DepthSource.HELD,
        valid=True,
        covariance=read_only(tip.covariance + aged),
        snapped=tip.snapped,
        deflection=float(np.linalg.norm(tip.beside)) if both else 0.0,
        deflection_sigma=across_sigma(fix, axis, tip.depth),
    )


def tip_covariance(axis: FloatArray, depth: float, depth_variance: float) -> FloatArray:
    """Covariance of tip = P_I + depth·d̂ [m²], shape (3, 3).

    σ_depth² along the needle and (depth·σ_direction)² across it, to first order.
    """
    along = np.outer(axis, axis)
    across = (depth * ORIENTATION_SIGMA) ** 2
    result: FloatArray = depth_variance * along + across * (np.eye(3) - along)
    return result


def encoder_time(device: DeviceStatePort) -> float:
    """When the encoders were read [s]."""
    return float(device.row[slots.Q_TIME])


def _device_fault(device: DeviceStatePort, axis: FloatArray, now: float) -> str:
    if not (np.isfinite(axis).all() and 0.5 < float(np.linalg.norm(axis)) < 2.0):
        return "the robot gives no needle direction"
    if not (np.isfinite(device.tip).all() and np.isfinite(device.depth)):
        return "the robot gives no needle position"
    age = now - encoder_time(device)
    if not np.isfinite(age) or age > ENCODER_ZERO:
        return (
            f"the encoder values are {_text_ms(age)} old, the limit is {ENCODER_ZERO * 1e3:.0f} ms"
        )
    return ""


def _invalid(last: NeedlePose | None, now: float, reason: str, age: float) -> NeedlePose:
    return NeedlePose(
        p_tip=last.p_tip if last else read_only(np.zeros(3)),
        axis=last.axis if last else DOWN,
        depth=last.depth if last else 0.0,
        time=now,
        orientation_age=age,
        depth_age=last.depth_age + max(0.0, now - last.time) if last else age,
        depth_source=DepthSource.NONE,
        valid=False,
        covariance=last.covariance if last else read_only(MODEL_SIGMA**2 * np.eye(3)),
        reason=reason,
    )


def _age(time: float, now: float) -> float:
    """Age [s], never negative; the largest float where the time is not a number."""
    age = now - time
    return max(0.0, age) if np.isfinite(age) else float(np.finfo(np.float64).max)


def _text_ms(age: float) -> str:
    return f"{age * 1e3:.0f} ms" if np.isfinite(age) else "an unknown time"
