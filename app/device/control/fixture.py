"""The virtual fixture: a spring that turns the needle towards the planned path."""

from dataclasses import dataclass
from math import atan2, cos, pi, sin
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.vectors import norm_kernel, shrink_kernel, unit_kernel
from app.mechanisms.profile import DeviceProfile

_STIFFNESS, _DAMPING, _LIMIT, _DIAL_RATE, _DIAL, _SIZE = range(6)


@njit
def attraction_kernel(
    dx: float, dy: float, dz: float, px: float, py: float, pz: float
) -> tuple[float, float, float]:
    """Force at the hub per stiffness [rad], perpendicular to the needle d, towards the path p.

    Its length is g(ε) = ε up to 90°, and ε sin ε beyond, which ends at zero at 180° where no
    direction is better than another. Written as -(g/sin ε)(p - (p·d) d): no 0/0 at ε = 0, where it
    is exactly zero. Unit vectors in; zeros for a path without direction.
    """
    cx, cy, cz = py * dz - pz * dy, pz * dx - px * dz, px * dy - py * dx
    sine, cosine = norm_kernel(cx, cy, cz), px * dx + py * dy + pz * dz
    angle = atan2(sine, cosine)
    gain = 1.0
    if cosine < 0.0:
        gain = angle
    elif sine > 0.0:
        gain = angle / sine
    # d x (p x d) is the part of p perpendicular to d, without the cancellation of p - (p·d) d.
    return (
        -gain * (dy * cz - dz * cy),
        -gain * (dz * cx - dx * cz),
        -gain * (dx * cy - dy * cx),
    )


@njit
def fixture_potential(angle: float, stiffness: float, l_out: float) -> float:
    """Energy of the spring [J] at an angle error [rad]: the force is minus its gradient.

    K L_out ε²/2 up to 90°, then K L_out (π²/8 - 1 + sin ε - ε cos ε). The gradient is
    taken at constant L_out: along the needle the energy changes too, which this device cannot
    render, so energy claims must count the axial port.
    """
    if angle <= 0.5 * pi:
        return stiffness * l_out * 0.5 * angle * angle
    return stiffness * l_out * (pi * pi / 8.0 - 1.0 + sin(angle) - angle * cos(angle))


@njit
def _dial(state: FloatArray, p: FloatArray) -> float:
    """Return the assistance in use: it follows its input, at a limited rate while force is on."""
    wanted = min(max(state[sv.ASSISTANCE], 0.0), 1.0)
    if state[sv.ARMING] == 0.0:
        p[_DIAL] = wanted
        return wanted
    step = p[_DIAL_RATE] * max(state[sv.DT], 0.0)
    p[_DIAL] = min(max(wanted, p[_DIAL] - step), p[_DIAL] + step)
    return p[_DIAL]


@stage
def fixture_stage(state: FloatArray, p: FloatArray) -> None:
    """Write GUIDE_* and add it to FORCE_*: assistance times (spring - damper), limited."""
    assistance = _dial(state, p)
    if not assistance > 0.0:
        return
    px, py, pz = unit_kernel(state[sv.PATH_X], state[sv.PATH_Y], state[sv.PATH_Z])
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    ex, ey, ez = attraction_kernel(dx, dy, dz, px, py, pz)
    if px == 0.0 and py == 0.0 and pz == 0.0:
        return  # no path: nothing to guide to, and nothing to damp
    spring, damper = assistance * p[_STIFFNESS], assistance * p[_DAMPING]
    fx = spring * ex - damper * state[sv.HUB_VX]
    fy = spring * ey - damper * state[sv.HUB_VY]
    fz = spring * ez - damper * state[sv.HUB_VZ]
    scale = shrink_kernel(fx, fy, fz, p[_LIMIT])
    state[sv.GUIDE_X], state[sv.GUIDE_Y], state[sv.GUIDE_Z] = scale * fx, scale * fy, scale * fz
    state[sv.FORCE_X] += scale * fx
    state[sv.FORCE_Y] += scale * fy
    state[sv.FORCE_Z] += scale * fz


@dataclass(frozen=True, slots=True)
class VirtualFixture:
    """Attractive guidance with one dial, the input `ASSISTANCE` from 0 (off) to 1.

    Attributes:
        stiffness: force at the hub per angle error [N/rad].
        damping: against the hub's velocity across the needle [N·s/m].
        limit: largest force at the hand [N].
        dial_rate: how fast the assistance follows its dial [1/s], so that a click on the dial's
            end does not jerk the hand. Disarming is the way to zero at once.
    """

    stiffness: float
    damping: float
    limit: float
    dial_rate: float = 4.0

    @classmethod
    def of(cls, profile: DeviceProfile) -> "VirtualFixture":
        """Fixture with the defaults of a device profile."""
        section = profile.fixture
        return cls(section.stiffness, section.damping, profile.limits.hand_force)

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_SIZE)
        parameters[:_DIAL] = self.stiffness, self.damping, self.limit, self.dial_rate
        return "fixture", fixture_stage, parameters
