"""Nearest points of a needle's shaft and a capsule's axis, on scalars."""

from app.core.compiled import njit


@njit
def nearest_kernel(
    sx: float,
    sy: float,
    sz: float,
    dx: float,
    dy: float,
    dz: float,
    length: float,
    bx: float,
    by: float,
    bz: float,
) -> tuple[float, float]:
    """Nearest points of the segment t d, 0 <= t <= length, and s + u b, 0 <= u <= 1: (t, u).

    `d` is a unit vector, `s` the start of the other segment seen from the first one's; `b` may be
    zero. The answer is unique, and moves without a jump, unless the two are parallel.
    """
    bb = bx * bx + by * by + bz * bz
    bd = bx * dx + by * dy + bz * dz
    sd = sx * dx + sy * dy + sz * dz
    sb = sx * bx + sy * by + sz * bz
    across = bb - bd * bd  # |d x b|²
    u = 0.0
    if across > 1e-12 * bb:
        u = min(max((sd * bd - sb) / across, 0.0), 1.0)
    t = sd + u * bd
    if t < 0.0:
        t = 0.0
        u = min(max(-sb / bb, 0.0), 1.0) if bb > 0.0 else 0.0
    elif t > length:
        t = length
        u = min(max((t * bd - sb) / bb, 0.0), 1.0) if bb > 0.0 else 0.0
    return t, u
