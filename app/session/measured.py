"""What a fix of the cameras says of the tip, on the robot's line."""

import numpy as np

from app.core.arrays import FloatArray
from app.session.ports import FixPort
from app.tracking.fix import FixStatus
from app.tracking.fusion import FusedTip, fuse_tip, line_covariance, turned


def is_usable(fix: FixPort) -> bool:
    """Whether a fix is a measurement of the tip and all its numbers are finite."""
    return bool(
        fix.usable
        and np.isfinite(fix.time)
        and np.isfinite(fix.p_tip_world).all()
        and np.isfinite(fix.covariance).all()
    )


def is_one_eyed(fix: FixPort) -> bool:
    """Whether one camera alone has seen the marker."""
    return str(fix.status) == FixStatus.ONE_CAMERA


def tip_of(fix: FixPort, fulcrum: FloatArray, axis: FloatArray) -> FusedTip:
    """Tip of a usable fix on the present line from `fulcrum` [m] along the unit `axis`.

    Cameras and robot are compared at the capture: a needle that has turned since is not a bent
    one. What was found goes on with the line.
    """
    then = axis if fix.axis is None else fix.axis
    tip = fuse_tip(fix.p_tip_world, fix.covariance, fulcrum, then, fix.line_variance)
    return tip if fix.axis is None else turned(tip, fulcrum, then, axis)


def fix_depth(fix: FixPort, fulcrum: FloatArray, axis: FloatArray) -> tuple[float, float]:
    """Depth of the tip that a usable fix says [m], and its variance [m²].

    On the axis, not the distance from P_I: that is never negative, and biased by the noise across
    the needle when the tip is at the skin.
    """
    tip = tip_of(fix, fulcrum, axis)
    return tip.depth, tip.depth_variance


def across_sigma(fix: FixPort, axis: FloatArray, depth: float) -> float:
    """Return the standard deviation of tip from line, per axis [m]; 0 where it is unknown."""
    if fix.line_variance is None:
        return 0.0
    then = axis if fix.axis is None else fix.axis
    total = np.asarray(fix.covariance) + line_covariance(then, depth, fix.line_variance)
    across = np.eye(3) - np.outer(then, then)
    return float(np.sqrt(max(0.0, 0.5 * np.trace(across @ total @ across))))
