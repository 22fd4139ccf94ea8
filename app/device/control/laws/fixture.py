"""The virtual fixture: guides the needle to the planned path, or pushes it away, by one dial.

With ε the angle between needle and path, and forces at the hub point across the needle:

- guiding: f(ε) = min(K ε, F) up to 90°, times sin ε beyond, towards the path; potential
  V = L_out ∫ f dε;
- repelling, the thesis' harder mode: f(ε) = s ε (1 - ε/r)³ away from the path; nothing on the path,
  where no direction is better than another, largest at r/4, nothing from r on;
  V = L_out s r² (1 - ε/r)⁴ (1/4 - (1 - ε/r)/5), largest on the path: L_out s r²/20.

The reach r of the hill is shortened to the distance between path and tilt limit, so that it ends
inside the workspace, and its slope s stays. The dial a in [-1, 1] blends them: the force is g(a)
times the one or the other, with g = 0 for |a| < 0.05 and (|a| - 0.05)/0.95 beyond.

The gradients are taken at constant L_out: along the needle the energy changes too, which this
device cannot render; that share is counted in GAIN_WORK.
"""

from collections.abc import Mapping
from math import acos, isfinite, pi
from typing import Any, Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.device.control.law_kernels import (
    HILL,
    STOP_GIVES,
    across_kernel,
    damper_share,
    hill_kernel,
    hub_velocity,
    longest_lever,
    no_pose,
    push,
    speed_fade,
    spring_kernel,
    store,
)
from app.device.control.vectors import unit_kernel
from app.mechanisms.profile import DeviceProfile

DECLARATION: Final[dict[str, Any]] = {
    "title": "Virtual fixture: guides to the path or repels from it",
    "reads": ("assistance", "arming", "dt", "path", "axis", "l_out", "hub_v"),
    "writes": ("guide", "force", "potential", "gain_work"),
    "energy": (
        "potential",
        "stores L_out times the integral of its force over the angle to the path, damps beside it;"
        " turning the dial, moving the path and sliding the needle change it, counted in gain_work",
    ),
    "parameters": {
        "stiffness": ("fixture.stiffness", "N/rad", 0.0, 1000.0, "of the guidance at the hub"),
        "damping": ("fixture.damping", "N·s/m", 0.0, 20.0, "of the hub's motion, at full dial"),
        "limit": ("limits.hand_force", "N", 0.0, 5.0, "largest force of this law"),
        "repulsion": (1.5, "N", 0.0, 5.0, "largest force of the repulsion, at a quarter of reach"),
        "reach": (0.42, "rad", 0.05, 1.0, "angle at which the repulsion has ended"),
        "fade_from": (0.05, "m/s", 0.0, 1.0, "speed along the repulsion from which it fades"),
        "fade_to": (0.20, "m/s", 0.0, 1.0, "speed at which the repulsion has ended"),
        "dial_rate": (4.0, "1/s", 0.1, 100.0, "how fast the force follows the dial while armed"),
    },
}

DEAD_ZONE: Final = 0.05
"""Within ± this much of the dial the force is exactly zero."""


class _FixturePlaces(NamedTuple):
    """Strength and shape of the law, and memory of the last tick."""

    stiffness: int
    damping: int
    limit: int
    slope: int
    reach: int
    fade_from: int
    fade_to: int
    dial_rate: int
    tilt: int
    dial: int = 0
    last_gain: int = 0
    last_l_out: int = 0
    last_x: int = 0
    last_y: int = 0
    last_z: int = 0


_AT: Final = numbered(_FixturePlaces)


def parameters(values: Mapping[str, float], profile: DeviceProfile) -> FloatArray:
    """Return a fresh parameters array, its memory included."""
    return pack(values, profile.tilt_limit)


def pack(values: Mapping[str, float], tilt_limit: float) -> FloatArray:
    """Return a fresh parameters array for a tilt limit [rad] that no path may come near."""
    return packed(
        _AT,
        stiffness=values["stiffness"],
        damping=values["damping"],
        limit=values["limit"],
        slope=HILL * min(values["repulsion"], values["limit"]) / values["reach"],
        reach=values["reach"],
        tilt=tilt_limit,
        fade_from=values["fade_from"],
        fade_to=values["fade_to"],
        dial_rate=values["dial_rate"],
    )


def energy_bound(values: Mapping[str, float], profile: DeviceProfile) -> float:
    """Return the larger of both potentials at full dial [J]: guidance across the whole workspace,
    repulsion on the path; with the needle drawn out as far as it may be.
    """
    widest = min(pi, 2.0 * (profile.tilt_limit + STOP_GIVES))
    slope = HILL * min(values["repulsion"], values["limit"]) / values["reach"]
    guides = spring_kernel(widest, values["stiffness"], values["limit"])[1]
    repels = hill_kernel(0.0, values["reach"], slope)[1]
    return float(longest_lever(profile) * max(guides, repels))


@njit
def dial_gain(assistance: float) -> float:
    """Gain of the force for a dial in [-1, 1]: exactly zero in the dead zone, then linear to ±1."""
    if not isfinite(assistance):
        return 0.0
    size = min(max(abs(assistance) - DEAD_ZONE, 0.0) / (1.0 - DEAD_ZONE), 1.0)
    return size if assistance > 0.0 else -size


@njit
def _dial(state: FloatArray, p: FloatArray) -> float:
    """Return the dial in use: it follows its input, at a limited rate while force is on."""
    wanted = min(max(state[sv.ASSISTANCE], -1.0), 1.0) if isfinite(state[sv.ASSISTANCE]) else 0.0
    if state[sv.ARMING] == 0.0:
        p[_AT.dial] = wanted
        return wanted
    step = p[_AT.dial_rate] * max(state[sv.DT], 0.0)
    p[_AT.dial] = min(max(wanted, p[_AT.dial] - step), p[_AT.dial] + step)
    return p[_AT.dial]


@njit
def fixture_kernel(
    gain: float, angle: float, tilt: float, p: FloatArray
) -> tuple[float, float, float]:
    """Return (guiding, repelling) force over sine [N] and the potential per lever [J/m].

    Args:
        gain: of the dial, -1 to 1.
        angle: between needle and path [rad].
        tilt: of the path from the vertical [rad].
        p: the law's parameters.
    """
    if gain > 0.0:
        force, stored = spring_kernel(angle, p[_AT.stiffness], p[_AT.limit])
        return gain * force, 0.0, gain * stored
    reach = min(p[_AT.reach], p[_AT.tilt] - tilt)
    if not (gain < 0.0 and reach > 0.0):
        return 0.0, 0.0, 0.0
    force, stored = hill_kernel(angle, reach, p[_AT.slope])
    return 0.0, -gain * force, -gain * stored


@njit
def _tilt(px: float, py: float, pz: float) -> float:
    return acos(min(max(-pz, -1.0), 1.0))


@njit
def _stored_before(p: FloatArray, dx: float, dy: float, dz: float) -> float:
    """Energy [J] that the last tick's dial, lever and path would store in this direction."""
    px, py, pz = p[_AT.last_x], p[_AT.last_y], p[_AT.last_z]
    angle = across_kernel(dx, dy, dz, px, py, pz)[3]
    return p[_AT.last_l_out] * fixture_kernel(p[_AT.last_gain], angle, _tilt(px, py, pz), p)[2]


@njit
def _remember(p: FloatArray, gain: float, l_out: float, px: float, py: float, pz: float) -> None:
    p[_AT.last_gain], p[_AT.last_l_out] = gain, l_out
    p[_AT.last_x], p[_AT.last_y], p[_AT.last_z] = px, py, pz


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Add the fixture's force and energy: spring or hill, and a damper, within the limit."""
    gain = dial_gain(_dial(state, p))
    px, py, pz = unit_kernel(state[sv.PATH_X], state[sv.PATH_Y], state[sv.PATH_Z])
    if px == 0.0 and py == 0.0 and pz == 0.0:
        gain = 0.0  # no path: nothing to guide to, and nothing to damp
    if (gain == 0.0 and p[_AT.last_gain] == 0.0) or no_pose(state):
        return
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    vx, vy, vz = hub_velocity(state)
    ax, ay, az, angle = across_kernel(dx, dy, dz, px, py, pz)
    guides, repels, stored = fixture_kernel(gain, angle, _tilt(px, py, pz), p)
    before = stored * p[_AT.last_l_out]
    if (
        gain != p[_AT.last_gain]
        or px != p[_AT.last_x]
        or py != p[_AT.last_y]
        or pz != p[_AT.last_z]
    ):
        before = _stored_before(p, dx, dy, dz)
    store(state, stored * state[sv.L_OUT], before)
    _remember(p, gain, state[sv.L_OUT], px, py, pz)
    size = (ax * ax + ay * ay + az * az) ** 0.5
    if repels > 0.0 and size > 0.0:  # the hub moves with p's perpendicular part: the tip flees
        along = (vx * ax + vy * ay + vz * az) / size
        repels *= speed_fade(along, p[_AT.fade_from], p[_AT.fade_to])
    pull = repels - guides
    fx, fy, fz = pull * ax, pull * ay, pull * az
    damper = -abs(gain) * p[_AT.damping]
    bx, by, bz = damper * vx, damper * vy, damper * vz
    share = damper_share(fx, fy, fz, bx, by, bz, p[_AT.limit])
    push(state, fx + share * bx, fy + share * by, fz + share * bz)
