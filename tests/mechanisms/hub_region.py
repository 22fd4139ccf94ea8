"""The workspace under the fulcrum: a cone of tilts surveyed, and where a hub stands by name."""

from dataclasses import dataclass
from enum import StrEnum
from math import atan2, hypot

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.mechanisms import lever
from app.mechanisms.errors import MechanismError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.kinematics import WORKING_MODE
from app.mechanisms.status import OK, Status
from app.studies.references.workspace import (
    _COLUMNS,
    _DEXTERITY,
    _LEVER,
    _PRINTED,
    _Q1,
    _Q2,
    _REACHED,
    _TORQUE,
    _disc,
    _peak,
    _survey,
)


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
        raise MechanismError(f"tilt is {tilt} rad; a cone needs more than 0 and less than π/2")
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
            f"no tool point within {np.degrees(tilt):g}° of tilt is reached in mode {mode},"
            f" assembly {assembly}"
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


class HubRegion(StrEnum):
    """Where a hub point stands."""

    INSIDE = "inside"
    BEYOND_TILT = "beyond_tilt"
    BEYOND_DEPTH = "beyond_depth"
    UNREACHABLE = "unreachable"
    BELOW_FULCRUM = "below_fulcrum"
    AT_FULCRUM = "at_fulcrum"
    NOT_FINITE = "not_finite"


def _range(values: FloatArray) -> tuple[float, float]:
    return float(values.min()), float(values.max())


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
        raise MechanismError(f"hub has shape {point.shape}; (3,) is needed")
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
