"""Vector arithmetic on scalars for the stages: safe for zero, huge and tiny entries."""

from math import isfinite, sqrt

from app.core.compiled import njit

TINY = 1e-12
"""Below this, speeds and torques become zero: subnormal numbers make a tick many times slower."""


@njit
def norm_kernel(x: float, y: float, z: float) -> float:
    """Length of a vector that neither overflows nor underflows; NaN or inf if an entry is."""
    largest = max(abs(x), abs(y), abs(z))
    if not largest > 0.0:
        return x + y + z  # zero, or NaN
    if largest > 1e150 or largest < 1e-150:
        x, y, z = x / largest, y / largest, z / largest
        return largest * sqrt(x * x + y * y + z * z)
    return sqrt(x * x + y * y + z * z)


@njit
def unit_kernel(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Direction of a vector; zeros if it has none (zero, NaN or infinite)."""
    length = norm_kernel(x, y, z)
    if not (isfinite(length) and length > 1e-300):
        return 0.0, 0.0, 0.0
    return x / length, y / length, z / length


@njit
def shrink_kernel(x: float, y: float, z: float, limit: float) -> float:
    """Factor in [0, 1] that brings a vector to at most `limit` and keeps its direction."""
    length = norm_kernel(x, y, z)
    return limit / length if length > limit else 1.0


@njit
def snapped(value: float) -> float:
    """Return the value, or exactly zero where it is too small to matter."""
    return 0.0 if abs(value) < TINY else value
