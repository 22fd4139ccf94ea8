"""The complete system: joint angles and needle, P_u ↔ Q."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.mechanisms import lever
from app.mechanisms.errors import MechanismError, NoGripError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph.kinematics import WORKING_MODE, forward, inverse, pair
from app.mechanisms.status import check


class LengthMode(StrEnum):
    """Where L_out comes from.

    `MEASURED`: the cameras. `PRINTED`: the thesis' first approach, L_in + L_out = C, in which the
    tip rests at P3.
    """

    MEASURED = "measured"
    PRINTED = "printed"


@dataclass(frozen=True, slots=True, eq=False)
class NeedleState:
    """Needle of the complete system, in world.

    Attributes:
        p3: tool point [m], shape (2,).
        axis: needle direction d, hub to tip, shape (3,).
        l_in: fulcrum to P3 [m], the lever.
        l_out: hub point to fulcrum [m].
        hub: hub point P_u [m], shape (3,).
        tip: tip [m], shape (3,).
        depth: tip beyond the fulcrum along the axis [m]: needle length - L_out.
        residual: C - L_in - L_out [m]; 0 on the surface of the printed mode.
    """

    p3: FloatArray
    axis: FloatArray
    l_in: float
    l_out: float
    hub: FloatArray
    tip: FloatArray
    depth: float
    residual: float


def needle_at(geometry: Geometry, p3: ArrayLike, l_out: float | None = None) -> NeedleState:
    """Needle of a tool point; `l_out` [m] as measured, or None for the printed mode C - L_in.

    Raises:
        NoGripError: if nothing of the needle is left above the fulcrum.
        MechanismError: if `p3` has the wrong shape.
    """
    x, y = pair(p3, "p3")
    dx, dy, dz, l_in = lever.axis_kernel(x, y, *geometry.fulcrum_xyz)
    length = geometry.needle_length
    outside = length - l_in if l_out is None else float(l_out)
    if not outside > 0.0:
        raise NoGripError(
            sentence(
                "no grip: L_out = {outside} m at L_in = {l_in} m; the needle of {length} m must "
                "stand out of the fulcrum (L_out > 0)",
                outside=outside,
                l_in=l_in,
                length=length,
            )
        )
    axis = frozen([dx, dy, dz], (3,), "axis")
    depth = length - outside
    return NeedleState(
        p3=frozen([x, y]),
        axis=axis,
        l_in=l_in,
        l_out=outside,
        hub=frozen(geometry.fulcrum - outside * axis),
        tip=frozen(geometry.fulcrum + depth * axis),
        depth=depth,
        residual=length - l_in - outside,
    )


def system_forward(
    geometry: Geometry,
    q: ArrayLike,
    l_out: float | None = None,
    mode: LengthMode = LengthMode.MEASURED,
    assembly: int = 1,
) -> NeedleState:
    """Needle of joint angles q [rad], shape (2,), and the measured L_out [m].

    Raises:
        MechanismError: as `forward` and `needle_at`; also if the mode and `l_out` contradict.
    """
    if (l_out is None) != (mode is LengthMode.PRINTED):
        raise MechanismError(
            sentence(
                "l_out = {l_out} m does not fit mode {mode!r}: mode 'measured' needs l_out,"
                " mode 'printed' computes it",
                l_out=l_out,
                mode=mode.value,
            )
        )
    return needle_at(geometry, forward(geometry, q, assembly), l_out)


def system_inverse(
    geometry: Geometry, hub: ArrayLike, mode: tuple[int, int] = WORKING_MODE
) -> tuple[FloatArray, NeedleState]:
    """Joint angles [rad], shape (2,), and the needle whose hub point P_u is `hub` [m], shape (3,).

    P3 is where the line from the hub through the fulcrum meets the plane of the links. A hub off
    the printed mode's surface is fine: `NeedleState.residual` says by how much.

    Raises:
        DegenerateError: if the hub is at the fulcrum.
        UnreachableError: if it is level with or below it, or the pantograph does not reach P3.
        NotFiniteError: if a coordinate is NaN or infinite.
    """
    point = np.asarray(hub, dtype=np.float64)
    if point.shape != (3,):
        raise MechanismError(
            sentence("hub has shape {point_shape}; (3,) is needed", point_shape=point.shape)
        )
    status, x, y, _, l_out = lever.tool_kernel(*point.tolist(), *geometry.fulcrum_xyz)
    check(status, f"hub point P_u = {point.tolist()} m above the fulcrum {geometry.fulcrum_xyz} m")
    p3 = np.array([x, y])
    return inverse(geometry, p3, mode), needle_at(geometry, p3, l_out)
