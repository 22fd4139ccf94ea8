"""The needle's pose from both of its sources: direction from the robot, depth from the cameras.

The straight needle ends at P_I + depth·d̂. The robot gives d̂ every tick; the cameras give the tip,
and `tracking.fusion` says how deep that is on the robot's line. Where simulated tissue bends the
needle, the tip is beside that line by what the same solution says that gives the force
(`core.bend`): `p_tip` is where the tip is, bent or straight, for everybody. Each source has its own
clock, so the pose carries both ages.
"""

from dataclasses import dataclass
from enum import StrEnum
from math import inf, isfinite
from typing import Final

import numpy as np

from app.core import state_vector as slots
from app.core.arrays import FloatArray, read_only
from app.core.bend import Bend, needle_curve
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
        p_tip: tip, of the bent needle where it bends [m], shape (3,), read-only.
        axis: unit direction from hub to tip at the fulcrum, shape (3,), read-only.
        depth: tip beyond the fulcrum along the axis [m].
        time: moment the pose stands for [s].
        orientation_age: age of the encoder values [s].
        depth_age: age of the depth [s]; the state's own age where the model gives it.
        depth_source: where the depth comes from.
        valid: whether direction and depth may be used; the depth is measured only if
            `measured` says so too.
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

    @property
    def p_straight(self) -> FloatArray:
        """Where the tip would be if the tissue bent nothing [m], shape (3,)."""
        return self.p_tip if self.bend is None else self.p_tip - self.bend.at(self.depth)

    @property
    def tip_axis(self) -> FloatArray:
        """Direction in which the tip goes on, shape (3,); unit to the second order."""
        return self.axis if self.bend is None else self.axis + self.bend.slope_at(self.depth)

    @property
    def bending(self) -> float | None:
        """How far the tip is off the straight needle [m]: by the tissue's model, and by what both
        cameras see beside that; None where neither tells.
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
    device: DeviceStatePort,
    fix: FixPort | None,
    now: float,
    last: NeedlePose | None = None,
    doubt: str = "",
) -> NeedlePose:
    """Fuse the robot's direction and the cameras' depth into one pose; never NaN.

    The interval that holds the depth is the loop's own: force and let-go are limited by it.

    Args:
        device: newest state of the loop.
        fix: newest *believed* fix of the tracker, or None without one. Another is not used.
        now: present time [s].
        last: pose before this one; its numbers are repeated, marked invalid, where the robot
            gives nothing usable.
        doubt: why fixes of the cameras are not believed now.
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
    bend = Bend.of_row(np.asarray(device.row))
    least, most = _interval(device, depth)
    return NeedlePose(
        p_tip=_bent(fulcrum + depth * axis, bend, depth),
        axis=read_only(axis),
        depth=depth,
        time=now,
        orientation_age=_age(encoder_time(device), now),
        depth_age=_age(device.time, now),
        depth_source=DepthSource.MODEL,
        valid=True,
        covariance=_bent_covariance(tip_covariance(axis, depth, MODEL_SIGMA**2), axis, bend, depth),
        bend=bend,
        depth_least=least,
        depth_most=most,
        doubt=doubt,
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
    bend = Bend.of_row(np.asarray(device.row))
    least, most = _interval(device, tip.depth)
    return NeedlePose(
        p_tip=_bent(tip.p_tip, bend, tip.depth),
        axis=read_only(axis),
        depth=tip.depth,
        time=now,
        orientation_age=_age(encoder_time(device), now),
        depth_age=age,
        depth_source=fresh if age <= TRACKER_FRESH else DepthSource.HELD,
        valid=True,
        covariance=_bent_covariance(tip.covariance + aged, axis, bend, tip.depth),
        snapped=tip.snapped,
        deflection=float(np.linalg.norm(tip.beside)) if both else 0.0,
        deflection_sigma=across_sigma(fix, axis, tip.depth),
        bend=bend,
        depth_least=least,
        depth_most=most,
    )


def _bent(p_straight: FloatArray, bend: Bend | None, depth: float) -> FloatArray:
    """Where the tip is [m], beside the straight needle's."""
    return read_only(p_straight if bend is None else p_straight + bend.at(depth))


def _bent_covariance(
    straight: FloatArray, axis: FloatArray, bend: Bend | None, depth: float
) -> FloatArray:
    """Covariance of the tip [m²]: what is unsure along the needle lies along its bent end.

    A turn of the needle moves the bent tip less than the straight one; but an encoder's error is
    the same where the channel was cut as it is now, and moves both together. So what lies across
    stays as it is.
    """
    if bend is None:
        return read_only(straight)
    turn = np.eye(3) + np.outer(bend.slope_at(depth), axis)
    return read_only(turn @ straight @ turn.T)


def _interval(device: DeviceStatePort, depth: float) -> tuple[float, float]:
    """Interval of the loop, which may be a tick behind a fix: with the `depth` [m] in it."""
    least, most = (float(device.row[slot]) for slot in (slots.DEPTH_LEAST, slots.DEPTH_MOST))
    if not (isfinite(least) and isfinite(most)):
        return -inf, inf
    return min(least, depth), max(most, depth)


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
        bend=last.bend if last else None,
    )


def _age(time: float, now: float) -> float:
    """Age [s], never negative; the largest float where the time is not a number."""
    age = now - time
    return max(0.0, age) if np.isfinite(age) else float(np.finfo(np.float64).max)


def _text_ms(age: float) -> str:
    return f"{age * 1e3:.0f} ms" if np.isfinite(age) else "an unknown time"
