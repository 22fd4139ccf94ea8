"""The needle's pose from its two sources: the robot's fine line and the cameras' absolute point.

The robot says on which line the tip is, to within S_line across it; the cameras say where in
space, to within S_cam. With d̂ the line's direction and P_I a point of it, the depth that both agree
on best is the generalised least squares one,

    S = S_cam + S_line,   g = S⁻¹ d̂ / (d̂ᵀ S⁻¹ d̂),   depth = gᵀ (p - P_I),   var = 1 / (d̂ᵀ S⁻¹ d̂),

not the foot of the perpendicular: where the cameras see less exactly in some direction, the point
is moved to the line along that one. The tip is snapped to the line, P_I + depth·d̂, while point and
line agree; its error is then d̂gᵀn + (d̂gᵀ - 1)e, with n the cameras' and e the line's, so that

    Σ = d̂gᵀ S_cam g d̂ᵀ + (d̂gᵀ - 1) S_line (d̂gᵀ - 1)ᵀ.

Where they do not, as with a bent needle, the cameras' point stands by itself.

The straight needle ends at P_I + depth·d̂. The robot gives d̂ every tick; where simulated tissue
bends the needle, the tip is beside that line by what the same solution says that gives the force
(`core.bend`). A depth is old when it comes (capture, transfer, search) and older when it is seen:
for the views alone it is moved on to the moment of display (`predicted`), at the rate of its
filter, by at most `FARTHEST`. Record, score and force laws use the measured pose, because a
prediction overshoots where the hand stops.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, isfinite, log, sqrt
from typing import Final

import numpy as np

from app.core import state_vector as slots
from app.core.arrays import FloatArray, read_only
from app.core.bend import Bend
from app.core.messages import sentence
from app.core.rotation import skew
from app.core.staleness import ENCODER_ZERO, TRACKER_FRESH, TRACKER_HOLD
from app.device.state import DeviceState
from app.session.needle import DOWN, DepthSource, NeedlePose
from app.tracking.fix import DIRECTION_SIGMA, GATE, FixStatus, NeedleFix
from app.tracking.motion.depth_filter import HAND_SPEED, DepthMotion

_LIMIT: Final = -2.0 * log(GATE)  # of chi-square with two degrees of freedom


MODEL_SIGMA: Final = 0.03
"""Standard deviation of the model's depth [m]: the needle slides freely in its tube, so the
model only says where it would be (declared, not measured)."""


DISPLAY_LATENCY: Final = 0.030
"""From a pose to the light of the screen [s]: declared, one frame of 60 Hz and the panel's own."""

FARTHEST: Final = 0.100
"""No depth is predicted further than this beyond its capture [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class FusedTip:
    """The needle's tip from both sources.

    Attributes:
        p_tip: on the line if `snapped`, but as one camera and the line gave it where they did,
            else the cameras' own [m], shape (3,), read-only.
        covariance: of it [m²], shape (3, 3), read-only.
        depth: beyond the line's point, along it [m].
        depth_variance: of it [m²].
        snapped: whether point and line agree.
        beside: from the line to the cameras' point, across the line [m], shape (3,), read-only.
        chi_square: of that distance, two degrees of freedom.
    """

    p_tip: FloatArray
    covariance: FloatArray
    depth: float
    depth_variance: float
    snapped: bool
    beside: FloatArray
    chi_square: float


def line_covariance(axis: FloatArray, depth: float, line_variance: float) -> FloatArray:
    """Covariance of the line's place at a depth [m²], shape (3, 3): nothing along the line.

    Args:
        axis: unit direction.
        depth: from the point that the line turns about [m].
        line_variance: of that point across the line, per axis [m²].
    """
    across: FloatArray = np.eye(3) - np.outer(axis, axis)
    return (line_variance + (depth * DIRECTION_SIGMA) ** 2) * across


def fuse_tip(
    p_tip: FloatArray,
    covariance: FloatArray,
    fulcrum: FloatArray,
    axis: FloatArray,
    line_variance: float | None,
) -> FusedTip:
    """Fuse the cameras' tip with the robot's line.

    Args:
        p_tip: by the cameras [m], shape (3,).
        covariance: of it [m²], shape (3, 3).
        fulcrum: point of the line that it turns about, P_I [m], shape (3,).
        axis: unit direction of the line, hub to tip.
        line_variance: of the line across itself, per axis [m²]; None if the tip has been found
            with the line's help already (by one camera): the line must not count twice. Such a
            tip is not moved: its error is known in some directions far better than the line.
    """
    offset = np.asarray(p_tip - fulcrum, dtype=np.float64)
    along = np.outer(axis, axis)
    foot = float(offset @ axis)
    beside = read_only(offset - foot * axis)
    own = FusedTip(
        p_tip=read_only(np.array(p_tip, dtype=np.float64)),
        covariance=read_only(np.array(covariance)),
        depth=foot,
        depth_variance=max(0.0, float(axis @ covariance @ axis)),
        snapped=line_variance is None,
        beside=beside,
        chi_square=0.0,
    )
    if line_variance is None:
        return own
    s_line = line_covariance(axis, foot, line_variance)
    total = covariance + s_line + 1e-18 * np.eye(3)
    weighted = np.linalg.solve(total, axis)
    information = float(axis @ weighted)
    gain = weighted / information
    depth = float(gain @ offset)
    apart = offset - depth * axis
    chi_square = float(apart @ np.linalg.solve(total, apart))
    if chi_square > _LIMIT:
        return replace(own, chi_square=chi_square)
    moves = np.outer(axis, gain)
    stays = moves - np.eye(3)
    spread_tip = float(gain @ covariance @ gain) * along + stays @ s_line @ stays.T
    return FusedTip(
        read_only(fulcrum + depth * axis),
        read_only(spread_tip),
        depth,
        1.0 / information,
        True,
        beside,
        chi_square,
    )


def turned(tip: FusedTip, fulcrum: FloatArray, then: FloatArray, now: FloatArray) -> FusedTip:
    """Carry a tip on with its line, from the direction `then` to the direction `now`.

    The line turns about `fulcrum` [m] the short way; a line that has turned round altogether, which
    no needle does, leaves the tip where it was.
    """
    cosine = float(then @ now)
    if cosine < 0.0:
        return tip
    turn = skew(np.cross(then, now))
    rotation = np.eye(3) + turn + turn @ turn / (1.0 + cosine)
    return replace(
        tip,
        p_tip=read_only(fulcrum + rotation @ (tip.p_tip - fulcrum)),
        covariance=read_only(rotation @ tip.covariance @ rotation.T),
        beside=read_only(rotation @ tip.beside),
    )


def is_usable(fix: NeedleFix) -> bool:
    """Return whether a fix is a measurement of the tip and all its numbers are finite."""
    return bool(
        fix.usable
        and np.isfinite(fix.time)
        and np.isfinite(fix.p_tip_world).all()
        and np.isfinite(fix.covariance).all()
    )


def by_one_camera(fix: NeedleFix) -> bool:
    """Return whether one camera alone has seen the marker."""
    return str(fix.status) == FixStatus.ONE_CAMERA


def tip_of(fix: NeedleFix, fulcrum: FloatArray, axis: FloatArray) -> FusedTip:
    """Tip of a usable fix on the present line from `fulcrum` [m] along the unit `axis`.

    Cameras and robot are compared at the capture: a needle that has turned since is not a bent
    one. What was found goes on with the line.
    """
    then = axis if fix.axis is None else fix.axis
    tip = fuse_tip(fix.p_tip_world, fix.covariance, fulcrum, then, fix.line_variance)
    return tip if fix.axis is None else turned(tip, fulcrum, then, axis)


def fix_depth(fix: NeedleFix, fulcrum: FloatArray, axis: FloatArray) -> tuple[float, float]:
    """Depth of the tip that a usable fix says [m], and its variance [m²].

    On the axis, not the distance from P_I: that is never negative, and biased by the noise across
    the needle when the tip is at the skin.
    """
    tip = tip_of(fix, fulcrum, axis)
    return tip.depth, tip.depth_variance


def depth_noise(fix: NeedleFix, fulcrum: FloatArray, axis: FloatArray) -> tuple[float, float]:
    """Return how far the depth of such a fix differs from picture to picture, standard deviation
    [m].

    And the variance that it states [m²], in which the calibration has its share.
    """
    noise = fix.covariance if fix.noise_covariance is None else fix.noise_covariance
    gain: FloatArray = np.asarray(axis)
    if fix.line_variance is not None:
        depth = float((fix.p_tip_world - fulcrum) @ axis)
        total = fix.covariance + line_covariance(axis, depth, fix.line_variance)
        weighted = np.linalg.solve(total, axis)
        gain = np.asarray(weighted / float(axis @ weighted))
    return sqrt(max(0.0, float(gain @ noise @ gain))), fix_depth(fix, fulcrum, axis)[1]


def across_noise(fix: NeedleFix, fulcrum: FloatArray, axis: FloatArray) -> float:
    """Return the standard deviation of the tip of such a fix, per axis across the needle [m]."""
    covariance = tip_of(fix, fulcrum, axis).covariance
    across = float(np.trace(covariance)) - float(axis @ covariance @ axis)
    return sqrt(max(0.0, 0.5 * across))


def across_sigma(fix: NeedleFix, axis: FloatArray, depth: float) -> float:
    """Return the standard deviation of tip from line, per axis [m]; 0 where it is unknown."""
    if fix.line_variance is None:
        return 0.0
    then = axis if fix.axis is None else fix.axis
    total = np.asarray(fix.covariance) + line_covariance(then, depth, fix.line_variance)
    across = np.eye(3) - np.outer(then, then)
    return float(np.sqrt(max(0.0, 0.5 * np.trace(across @ total @ across))))


def fuse(
    device: DeviceState,
    fix: NeedleFix | None,
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
        trusted_depth=last.trusted_depth if last else None,
    )


def _measured(
    device: DeviceState, fix: NeedleFix, fulcrum: FloatArray, axis: FloatArray, now: float
) -> NeedlePose:
    """Pose with a depth by the cameras, from `fulcrum` [m] along the unit `axis`."""
    tip = tip_of(fix, fulcrum, axis)
    age = _age(fix.time, now)
    fresh = DepthSource.ONE_CAMERA if by_one_camera(fix) else DepthSource.TRACKED
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
        trusted_depth=tip.depth,
    )


def _bent(p_straight: FloatArray, bend: Bend | None, depth: float) -> FloatArray:
    """Return where the tip is [m], beside the straight needle's."""
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


def _interval(device: DeviceState, depth: float) -> tuple[float, float]:
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
    across = (depth * DIRECTION_SIGMA) ** 2
    result: FloatArray = depth_variance * along + across * (np.eye(3) - along)
    return result


def encoder_time(device: DeviceState) -> float:
    """Return when the encoders were read [s]."""
    return float(device.row[slots.Q_TIME])


def _device_fault(device: DeviceState, axis: FloatArray, now: float) -> str:
    if not (np.isfinite(axis).all() and 0.5 < float(np.linalg.norm(axis)) < 2.0):
        return sentence("the robot gives no needle direction")
    if not (np.isfinite(device.tip).all() and np.isfinite(device.depth)):
        return sentence("the robot gives no needle position")
    age = now - encoder_time(device)
    if not np.isfinite(age) or age > ENCODER_ZERO:
        return sentence(
            "the encoder values are {text_ms} old, the limit is {encoder_zero:.0f} ms",
            text_ms=_text_ms(age),
            encoder_zero=ENCODER_ZERO * 1e3,
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
        trusted_depth=last.trusted_depth if last else None,
    )


def _age(time: float, now: float) -> float:
    """Age [s], never negative; the largest float where the time is not a number."""
    age = now - time
    return max(0.0, age) if np.isfinite(age) else float(np.finfo(np.float64).max)


def _text_ms(age: float) -> str:
    return f"{age * 1e3:.0f} ms" if np.isfinite(age) else sentence("an unknown time")


def moment(pose: NeedlePose) -> float:
    """Time that the shown depth should stand for [s]."""
    captured = pose.time - pose.depth_age
    return min(pose.time + DISPLAY_LATENCY, captured + FARTHEST)


def predicted(pose: NeedlePose, motion: DepthMotion | None) -> NeedlePose:
    """Return the pose with the depth of `motion`, which stands for `moment(pose)`.

    Only a depth that cameras measured is moved; any other pose is returned as it is. The pose's
    variance allows for a hand that nothing followed since the picture; the filter did follow it.
    """
    by_cameras = pose.measured and pose.depth_source is not DepthSource.NONE
    if motion is None or not by_cameras:
        return pose
    change = motion.depth - pose.depth
    bend, moved = pose.bend, pose.p_straight + change * pose.axis
    along = np.outer(pose.tip_axis, pose.tip_axis)
    present = float(pose.axis @ pose.covariance @ pose.axis)
    followed = min(pose.depth_age, FARTHEST)
    aged = HAND_SPEED**2 * (pose.depth_age**2 - (pose.depth_age - followed) ** 2)
    growth = max(motion.variance - present, -min(aged, present))
    return replace(
        pose,
        p_tip=read_only(moved if bend is None else moved + bend.at(motion.depth)),
        depth=motion.depth,
        rate=motion.rate,
        predicted=max(0.0, motion.time - (pose.time - pose.depth_age)),
        covariance=read_only(pose.covariance + growth * along),
    )
