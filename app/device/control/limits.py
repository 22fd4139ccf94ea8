"""What may pass to the motors: pure functions on numbers, each with its property tests.

A factor scales both torques together, so that the direction of the force stays.
"""

from math import atan2, isfinite

from app.core.compiled import njit


@njit
def fade(age: float, start: float, end: float) -> float:
    """Factor on the force for data of an age [s]: 1 up to `start`, falling to 0 at `end`.

    A time as far in the future comes from another clock, and counts like one in the past.
    """
    age = abs(age)
    if not age < end:  # also for NaN
        return 0.0
    return 1.0 if age <= start else (end - age) / (end - start)


@njit
def ramp(previous: float, dt: float, duration: float, armed: bool) -> float:
    """Arming factor: grows from 0 to 1 over `duration` [s] while armed, else 0 at once."""
    return min(1.0, previous + max(dt, 0.0) / duration) if armed else 0.0


@njit
def torque_factor(left: float, right: float, limit: float) -> float:
    """Factor in [0, 1] that brings the larger of two torques [N·m] to at most `limit`."""
    largest = max(abs(left), abs(right))
    if not (isfinite(left) and isfinite(right)) or limit <= 0.0:
        return 0.0
    return limit / largest if largest > limit else 1.0


@njit
def _growth(torque: float, last: float, step: float) -> float:
    room = step + (abs(last) if (torque > 0.0) == (last > 0.0) else 0.0)
    return room / abs(torque) if abs(torque) > room else 1.0


@njit
def slew_factor(
    left: float, right: float, last_left: float, last_right: float, step: float
) -> float:
    """Factor in [0, 1] after which neither torque grows by more than `step` [N·m] in this tick.

    Growing is moving away from zero: a torque may fall, or drop to zero and begin anew on the
    other side, as fast as it likes. Without a step (0, or NaN) nothing grows.
    """
    if not step > 0.0:
        step = 0.0
    if not (isfinite(last_left) and isfinite(last_right)):
        last_left, last_right = 0.0, 0.0
    return min(_growth(left, last_left, step), _growth(right, last_right, step))


@njit
def cap(limit: float, cleared: float, homed: float, sign_check: float) -> float:
    """Largest force at the hand [N]: the profile's `limit`, what the device is `cleared` for, and
    `sign_check` while the signs are being checked (`homed` below 1). Zero for NaN.
    """
    largest = min(limit, cleared)
    if not homed >= 1.0:
        largest = min(largest, sign_check)
    return largest if largest > 0.0 else 0.0


@njit
def tilt_kernel(dx: float, dy: float, dz: float) -> float:
    """Angle of the needle direction from straight down [rad], by atan2; 0 for a zero vector."""
    return atan2((dx * dx + dy * dy) ** 0.5, -dz) if dx * dx + dy * dy > 0.0 or dz > 0.0 else 0.0


@njit
def inwards(
    gx: float, gy: float, dx: float, dy: float, tilt: float, limit: float, margin: float
) -> tuple[float, float]:
    """Tool force (gx, gy) [N] without its outward part, beyond the tilt limit.

    The part along the outward direction (that of dx, dy) fades to zero over `margin` [rad] beyond
    `limit` [rad]; the inward and sideways parts stay, and the force felt only gets smaller.
    Continuous in pose and force.
    """
    beyond = (tilt - limit) / margin
    length = (dx * dx + dy * dy) ** 0.5
    if not (beyond > 0.0 and length > 0.0):
        return gx, gy
    ox, oy = dx / length, dy / length
    drop = min(beyond, 1.0) * max(gx * ox + gy * oy, 0.0)
    return gx - drop * ox, gy - drop * oy
