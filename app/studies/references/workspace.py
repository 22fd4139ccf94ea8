"""Workspace under the fulcrum: the torque that a force at the hand needs in a cone of tilts."""

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.mechanisms import lever
from app.mechanisms.errors import MechanismError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.differential import assembly_kernel, dexterity_kernel
from app.mechanisms.pantograph.kinematics import WORKING_MODE
from app.mechanisms.status import OK

_RINGS, _SPOKES = 121, 360
_REACHED, _Q1, _Q2, _DEXTERITY, _LEVER = range(5)
_TORQUE, _PRINTED, _COLUMNS = 5, 7, 9  # each: left, right
_FINE, _ROUNDS, _SHRINK = 33, 16, 0.25  # of the search about the largest torque of the grid


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


def _disc(geometry: Geometry, radius: float) -> FloatArray:
    rings = radius * np.sqrt(np.linspace(0.0, 1.0, _RINGS))
    turns = np.linspace(0.0, 2.0 * np.pi, _SPOKES, endpoint=False)
    r, a = (grid.ravel() for grid in np.meshgrid(rings, turns))
    return geometry.fulcrum[:2] + np.column_stack([r * np.cos(a), r * np.sin(a)])


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
