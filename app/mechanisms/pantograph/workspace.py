"""Workspace under the fulcrum: what the robot can do in a cone of tilts, and where a hub stands."""

from dataclasses import dataclass
from enum import StrEnum
from math import atan2, hypot

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.errors import MechanismError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.differential import assembly_kernel, dexterity_kernel
from app.mechanisms.pantograph.kinematics import WORKING_MODE
from app.mechanisms.pantograph.status import OK, Status

_RINGS, _SPOKES = 121, 360
_REACHED, _Q1, _Q2, _DEXTERITY, _LEVER, _TORQUE, _PRINTED, _COLUMNS = range(8)


@dataclass(frozen=True, slots=True)
class Workspace:
    """Tool points inside a cone of tilts about the vertical, L_out by the printed mode C - L_in.

    Attributes:
        tilt: half angle of the cone [rad].
        radius: of the disc of tool points [m].
        share: of the disc's area that the robot reaches in the working mode and assembly.
        q_left, q_right: smallest and largest joint angle [rad] over what is reached.
        worst_condition: largest condition number of the Jacobian.
        lever: smallest and largest L_out/L_in.
        torque: largest joint torque [N·m] for the force felt in any direction, by virtual work.
        torque_printed: the same by equation 4.12 as printed.
        no_grip: share of the reached area where L_in ≥ C leaves nothing to hold.
    """

    tilt: float
    radius: float
    share: float
    q_left: tuple[float, float]
    q_right: tuple[float, float]
    worst_condition: float
    lever: tuple[float, float]
    torque: float
    torque_printed: float
    no_grip: float


def survey(
    geometry: Geometry,
    tilt: float,
    force: float = 5.0,
    mode: tuple[int, int] = WORKING_MODE,
    assembly: int = 1,
) -> Workspace:
    """Survey the cone on rings and spokes that each stand for the same area, rim and middle too.

    Args:
        geometry: lengths.
        tilt: half angle of the cone [rad].
        force: felt at the hub [N], for the torques.
        mode: working mode.
        assembly: closure.

    Raises:
        MechanismError: if the cone is not open downwards, or nothing in it is reached.
    """
    if not 0.0 < tilt < 0.5 * np.pi:
        raise MechanismError(f"tilt is {tilt} rad; a cone needs more than 0 and less than π/2")
    radius = float(geometry.fulcrum[2] * np.tan(tilt))
    points = _disc(geometry, radius)
    rows = np.zeros((len(points), _COLUMNS))
    modes = float(mode[0]), float(mode[1]), float(assembly)
    lengths = *geometry.links, *geometry.fulcrum_xyz, geometry.needle_length
    _survey(points, rows, np.array(lengths), *modes)
    found = rows[rows[:, _REACHED] > 0.0]
    held = found[found[:, _LEVER] > 0.0]
    if not len(held):
        raise MechanismError(
            f"no tool point within {np.degrees(tilt):g}° of tilt is reached in mode {mode},"
            f" assembly {assembly}"
        )
    return Workspace(
        tilt=float(tilt),
        radius=radius,
        share=len(found) / len(points),
        q_left=_range(found[:, _Q1]),
        q_right=_range(found[:, _Q2]),
        worst_condition=float(1.0 / found[:, _DEXTERITY].min()),
        lever=_range(held[:, _LEVER]),
        torque=float(force * held[:, _TORQUE].max()),
        torque_printed=float(force * held[:, _PRINTED].max()),
        no_grip=1.0 - len(held) / len(found),
    )


class Region(StrEnum):
    """Where a hub point stands."""

    INSIDE = "inside"
    BEYOND_TILT = "beyond_tilt"
    BEYOND_DEPTH = "beyond_depth"
    UNREACHABLE = "unreachable"
    BELOW_FULCRUM = "below_fulcrum"
    AT_FULCRUM = "at_fulcrum"
    NOT_FINITE = "not_finite"


@dataclass(frozen=True, slots=True)
class Whereabouts:
    """A hub point against the workspace; `NaN` never: what does not exist is None.

    Attributes:
        region: where it stands; the first that applies, from the impossible to the forbidden.
        tilt: of the needle from the vertical [rad], or None.
        depth: of the tip beyond the fulcrum [m], or None.
        q: joint angles (left, right) [rad], or None where there are none.
    """

    region: Region
    tilt: float | None
    depth: float | None
    q: tuple[float, float] | None


def locate(
    geometry: Geometry,
    hub: ArrayLike,
    tilt_limit: float,
    depth_range: tuple[float, float],
    mode: tuple[int, int] = WORKING_MODE,
) -> Whereabouts:
    """Say where a hub point P_u [m], shape (3,), stands; never raises for a finite or NaN point.

    Args:
        geometry: lengths.
        hub: the hub point.
        tilt_limit: of the ball joint [rad].
        depth_range: depths that the device allows [m].
        mode: working mode.
    """
    point = np.asarray(hub, dtype=np.float64)
    if point.shape != (3,):
        raise MechanismError(f"hub has shape {point.shape}; (3,) is needed")
    status, x, y, _, l_out = kernels.tool_kernel(*point.tolist(), *geometry.fulcrum_xyz)
    if status != OK:
        return Whereabouts(_IMPOSSIBLE[Status(status)], None, None, None)
    fx, fy, fz = geometry.fulcrum_xyz
    tilt, depth = atan2(hypot(x - fx, y - fy), fz), geometry.needle_length - l_out
    status, *angles = kernels.inverse_kernel(x, y, *geometry.links, *map(float, mode))
    if status != OK:
        return Whereabouts(Region.UNREACHABLE, tilt, depth, None)
    region = Region.INSIDE
    if tilt > tilt_limit:
        region = Region.BEYOND_TILT
    elif not depth_range[0] <= depth <= depth_range[1]:
        region = Region.BEYOND_DEPTH
    return Whereabouts(region, tilt, depth, (angles[0], angles[1]))


_IMPOSSIBLE = {
    Status.NOT_FINITE: Region.NOT_FINITE,
    Status.DEGENERATE: Region.AT_FULCRUM,
    Status.UNREACHABLE: Region.BELOW_FULCRUM,
}


def _disc(geometry: Geometry, radius: float) -> FloatArray:
    rings = radius * np.sqrt(np.linspace(0.0, 1.0, _RINGS))
    turns = np.linspace(0.0, 2.0 * np.pi, _SPOKES, endpoint=False)
    r, a = (grid.ravel() for grid in np.meshgrid(rings, turns))
    return geometry.fulcrum[:2] + np.column_stack([r * np.cos(a), r * np.sin(a)])


def _range(values: FloatArray) -> tuple[float, float]:
    return float(values.min()), float(values.max())


@njit
def _survey(
    points: FloatArray,
    rows: FloatArray,
    lengths: FloatArray,
    mode_left: float,
    mode_right: float,
    assembly: float,
) -> None:
    a1, a2, base, fx, fy, fz, needle = lengths
    for k in range(len(points)):
        x, y = points[k]
        status, q1, q2 = kernels.inverse_kernel(x, y, a1, a2, base, mode_left, mode_right)
        if status != OK or assembly_kernel(q1, q2, x, y, a1, base) != assembly:
            continue
        status, jxl, jxr, jyl, jyr = kernels.jacobian_kernel(q1, q2, x, y, a1, a2, base)
        if status != OK:
            continue
        rows[k, _REACHED], rows[k, _Q1], rows[k, _Q2] = 1.0, q1, q2
        rows[k, _DEXTERITY] = dexterity_kernel(jxl, jxr, jyl, jyr)
        dx, dy, dz, l_in = kernels.axis_kernel(x, y, fx, fy, fz)
        if l_in < needle:
            rows[k, _LEVER] = (needle - l_in) / l_in
            for jx, jy in ((jxl, jyl), (jxr, jyr)):
                vw, printed = _torque_per_newton(jx, jy, dx, dy, dz, rows[k, _LEVER])
                rows[k, _TORQUE] = max(rows[k, _TORQUE], vw)
                rows[k, _PRINTED] = max(rows[k, _PRINTED], printed)


@njit
def _torque_per_newton(
    jx: float, jy: float, dx: float, dy: float, dz: float, lever: float
) -> tuple[float, float]:
    """Largest torque of a joint for 1 N felt, any direction across d: (virtual work, printed).

    A torque is linear in the force, τ = r·F; its largest value is the length of r across d.
    """
    along = dx * jx + dy * jy
    vx, vy, vz = jx - along * dx, jy - along * dy, -along * dz
    pz = -along / dz  # of 4.12: J column on x and y, and what the force's z share brings back
    slide = along + dz * pz
    px, py, pz = jx - slide * dx, jy - slide * dy, pz - slide * dz
    return (
        lever * np.sqrt(vx * vx + vy * vy + vz * vz),
        lever * np.sqrt(px * px + py * py + pz * pz),
    )
