"""Workspace under the fulcrum: what the robot can do in a cone of tilts, and where a hub stands."""

from dataclasses import dataclass
from enum import StrEnum
from math import atan2, hypot

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.mechanisms import lever
from app.mechanisms.errors import MechanismError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.differential import assembly_kernel, dexterity_kernel
from app.mechanisms.pantograph.kinematics import WORKING_MODE
from app.mechanisms.status import OK, Status

_RINGS, _SPOKES = 121, 360
_REACHED, _Q1, _Q2, _DEXTERITY, _LEVER = range(5)
_TORQUE, _PRINTED, _COLUMNS = 5, 7, 9  # each: left, right
_FINE, _ROUNDS, _SHRINK = 33, 16, 0.25  # of the search about the largest torque of the grid


@dataclass(frozen=True, slots=True)
class ConeWorkspace:
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
) -> ConeWorkspace:
    """Survey the cone on rings and spokes that each stand for the same area, rim and middle too.

    The torques' peaks lie between the rings (5 mm beside the vertical for the ICube lengths): from
    the grid's largest they are searched on, joint by joint, to about 1e-9 of the disc's radius.

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
        raise MechanismError(
            sentence("tilt is {tilt} rad; a cone needs more than 0 and less than π/2", tilt=tilt)
        )
    radius = float(geometry.fulcrum[2] * np.tan(tilt))
    points = _disc(geometry, radius)
    rows = np.zeros((len(points), _COLUMNS))
    modes = float(mode[0]), float(mode[1]), float(assembly)
    lengths = np.array([*geometry.links, *geometry.fulcrum_xyz, geometry.needle_length, 0.0])
    _survey(points, rows, lengths, *modes)
    found = rows[rows[:, _REACHED] > 0.0]
    held = found[found[:, _LEVER] > 0.0]
    if not len(held):
        raise MechanismError(
            sentence(
                "no tool point within {tilt_deg:g}° of tilt is reached in mode {mode},"
                " assembly {assembly}",
                tilt_deg=np.degrees(tilt),
                mode=mode,
                assembly=assembly,
            )
        )
    largest = [
        max(_peak(points, rows, column + side, radius, lengths, *modes) for side in (0, 1))
        for column in (_TORQUE, _PRINTED)
    ]
    return ConeWorkspace(
        tilt=float(tilt),
        radius=radius,
        share=len(found) / len(points),
        q_left=_range(found[:, _Q1]),
        q_right=_range(found[:, _Q2]),
        worst_condition=float(1.0 / found[:, _DEXTERITY].min()),
        lever=_range(held[:, _LEVER]),
        torque=force * largest[0],
        torque_printed=force * largest[1],
        no_grip=1.0 - len(held) / len(found),
    )


def torque_per_newton(
    geometry: Geometry,
    l_out: float,
    tilt: float = 0.0,
    mode: tuple[int, int] = WORKING_MODE,
    assembly: int = 1,
) -> float:
    """Return the largest joint torque [N·m] that 1 N at the hand can need, L_out as measured.

    Over all directions of the force across the needle and all directions of the needle in a cone;
    its inverse times the largest torque is the force that can be had everywhere there.

    Args:
        geometry: lengths.
        l_out: hub to fulcrum [m].
        tilt: half angle of the cone [rad]; 0: upright only.
        mode: working mode.
        assembly: closure.

    Raises:
        MechanismError: if `l_out` is not above 0, `tilt` not in [0, π/2), or nothing is reached.
    """
    if not (l_out > 0.0 and 0.0 <= tilt < 0.5 * np.pi):
        raise MechanismError(
            sentence(
                "L_out is {l_out} m and tilt {tilt} rad; L_out must be above 0, tilt in [0, π/2)",
                l_out=l_out,
                tilt=tilt,
            )
        )
    radius = float(geometry.fulcrum[2] * np.tan(tilt))
    points = _disc(geometry, radius)
    rows = np.zeros((len(points), _COLUMNS))
    modes = float(mode[0]), float(mode[1]), float(assembly)
    lengths = np.array([*geometry.links, *geometry.fulcrum_xyz, 0.0, float(l_out)])
    _survey(points, rows, lengths, *modes)
    if not (rows[:, _REACHED] > 0.0).any():
        raise MechanismError(
            sentence(
                "no tool point within {tilt_deg:g}° of tilt is reached in mode {mode},"
                " assembly {assembly}",
                tilt_deg=np.degrees(tilt),
                mode=mode,
                assembly=assembly,
            )
        )
    return max(_peak(points, rows, _TORQUE + side, radius, lengths, *modes) for side in (0, 1))


class HubRegion(StrEnum):
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

    region: HubRegion
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
        raise MechanismError(
            sentence("hub has shape {point_shape}; (3,) is needed", point_shape=point.shape)
        )
    status, x, y, _, l_out = lever.tool_kernel(*point.tolist(), *geometry.fulcrum_xyz)
    if status != OK:
        return Whereabouts(_IMPOSSIBLE[Status(status)], None, None, None)
    fx, fy, fz = geometry.fulcrum_xyz
    tilt, depth = atan2(hypot(x - fx, y - fy), fz), geometry.needle_length - l_out
    status, *angles = kernels.inverse_kernel(x, y, *geometry.links, *map(float, mode))
    if status != OK:
        return Whereabouts(HubRegion.UNREACHABLE, tilt, depth, None)
    region = HubRegion.INSIDE
    if tilt > tilt_limit:
        region = HubRegion.BEYOND_TILT
    elif not depth_range[0] <= depth <= depth_range[1]:
        region = HubRegion.BEYOND_DEPTH
    return Whereabouts(region, tilt, depth, (angles[0], angles[1]))


_IMPOSSIBLE = {
    Status.NOT_FINITE: HubRegion.NOT_FINITE,
    Status.DEGENERATE: HubRegion.AT_FULCRUM,
    Status.UNREACHABLE: HubRegion.BELOW_FULCRUM,
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
    for k in range(len(points)):
        _survey_row(points[k, 0], points[k, 1], rows[k], lengths, mode_left, mode_right, assembly)


@njit
def _survey_row(
    x: float,
    y: float,
    row: FloatArray,
    lengths: FloatArray,
    mode_left: float,
    mode_right: float,
    assembly: float,
) -> None:
    """Fill a row of the survey; `lengths` ends with L_out [m], 0 for the printed mode C - L_in."""
    a1, a2, base, fx, fy, fz, needle, l_out = lengths
    row[:] = 0.0
    status, q1, q2 = kernels.inverse_kernel(x, y, a1, a2, base, mode_left, mode_right)
    if status != OK or assembly_kernel(q1, q2, x, y, a1, base) != assembly:
        return
    status, jxl, jxr, jyl, jyr = kernels.jacobian_kernel(q1, q2, x, y, a1, a2, base)
    if status != OK:
        return
    row[_REACHED], row[_Q1], row[_Q2] = 1.0, q1, q2
    row[_DEXTERITY] = dexterity_kernel(jxl, jxr, jyl, jyr)
    dx, dy, dz, l_in = lever.axis_kernel(x, y, fx, fy, fz)
    outside = l_out if l_out > 0.0 else needle - l_in
    if outside > 0.0:
        row[_LEVER] = outside / l_in
        row[_TORQUE], row[_PRINTED] = _torque_per_newton(jxl, jyl, dx, dy, dz, row[_LEVER])
        row[_TORQUE + 1], row[_PRINTED + 1] = _torque_per_newton(jxr, jyr, dx, dy, dz, row[_LEVER])


@njit
def _peak(
    points: FloatArray,
    rows: FloatArray,
    column: int,
    radius: float,
    lengths: FloatArray,
    mode_left: float,
    mode_right: float,
    assembly: float,
) -> float:
    """Largest value of a column over the disc: finer and finer grids about the surveyed largest.

    In polar coordinates, so that the rim is a straight edge of the grid; what is not reached has
    the value 0 and is never the largest.
    """
    best = int(np.argmax(rows[:, column]))
    largest = rows[best, column]
    fx, fy = lengths[3], lengths[4]
    x, y = points[best, 0] - fx, points[best, 1] - fy
    away, turn = np.hypot(x, y), np.arctan2(y, x)
    row = np.zeros(_COLUMNS)
    width, angle = 0.1 * radius, np.pi
    for _ in range(_ROUNDS):
        middle, heading = away, turn
        for i in range(_FINE):
            r = middle + width * (2.0 * i / (_FINE - 1) - 1.0)
            r = min(max(r, 0.0), radius)
            for j in range(_FINE):
                a = heading + angle * (2.0 * j / (_FINE - 1) - 1.0)
                px, py = fx + r * np.cos(a), fy + r * np.sin(a)
                _survey_row(px, py, row, lengths, mode_left, mode_right, assembly)
                if row[column] > largest:
                    largest, away, turn = row[column], r, a
        width, angle = _SHRINK * width, _SHRINK * angle
    return largest


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
