"""One tick of the loop as a value."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, read_only
from app.device.faults import Fault


class Limiter(IntEnum):
    """What holds the guidance where it is: values of the slot GUIDANCE_LIMITED_BY.

    `HAND`: nothing but the hand's limit of the profile. `TORQUE`: the motors cannot give more at
    this lever. `LETTING_GO`: more could not be stopped in time if the needle were let go. `DEPTH`:
    the hand's limit at the deepest place where the tip can be; felt is less further out.
    """

    HAND = 0
    TORQUE = 1
    LETTING_GO = 2
    DEPTH = 3


@dataclass(frozen=True, slots=True, eq=False)
class DeviceState:
    """State of the robot and its loop after a tick; SI, in world, arrays read-only.

    Attributes:
        row: the whole state vector, shape (SLOTS,).
        time: monotonic time of the tick [s].
        tick: number of the tick, from 1; 0 before the first.
        q: joint angles (left, right) [rad], shape (2,).
        qd: joint velocities [rad/s], shape (2,).
        p3: tool point [m], shape (2,).
        axis: needle direction, hub to tip, shape (3,).
        hub: hub point [m], shape (3,).
        tip: tip [m], shape (3,).
        l_in: fulcrum to tool point [m].
        l_out: hub point to fulcrum [m].
        depth: tip beyond the fulcrum along the axis [m].
        depth_source: 1 tracked, 2 held, 0 model.
        depth_least, depth_most: interval that holds the depth [m].
        angle_error: between needle and path [rad].
        force: wanted at the hub [N], shape (3,).
        guide: share of the virtual fixture [N], shape (3,).
        felt: at the hub after all limits [N], shape (3,), estimated from the torques and the depth.
        felt_most: largest that it can be, at `depth_most` [N].
        force_measured: whether the board's gauge measures the force at the hand.
        measured_force: what it measures, across the needle [N]; 0 without a gauge.
        torque: joint torques sent (left, right) [N·m], shape (2,).
        axial_force: tissue on needle along the axis [N].
        limit_scale: factor of force and torque limits, 1 when none acts.
        safety_scale: factor of fading and arming, 0 to 1.
        fault: why the force is held at zero.
        kinematics: status of the forward kinematics, 0 = valid.
        lateness: wake-up after the deadline [s].
        missed: deadlines missed so far.
    """

    row: FloatArray
    time: float
    tick: int
    q: FloatArray
    qd: FloatArray
    p3: FloatArray
    axis: FloatArray
    hub: FloatArray
    tip: FloatArray
    l_in: float
    l_out: float
    depth: float
    depth_source: int
    depth_least: float
    depth_most: float
    angle_error: float
    force: FloatArray
    guide: FloatArray
    felt: FloatArray
    felt_most: float
    force_measured: bool
    measured_force: float
    torque: FloatArray
    axial_force: float
    limit_scale: float
    safety_scale: float
    fault: Fault
    kinematics: int
    lateness: float
    missed: int

    @classmethod
    def from_row(cls, row: FloatArray) -> DeviceState:
        """Read a state vector, shape (SLOTS,); keeps a read-only copy."""
        copy = read_only(np.array(row, dtype=np.float64))

        def number(slot: int) -> float:
            return float(copy[slot])

        return cls(
            row=copy,
            time=number(sv.TIME),
            tick=int(copy[sv.TICK]),
            q=copy[sv.Q],
            qd=copy[sv.QD],
            p3=copy[sv.P3],
            axis=copy[sv.AXIS],
            hub=copy[sv.HUB],
            tip=copy[sv.TIP],
            l_in=number(sv.L_IN),
            l_out=number(sv.L_OUT),
            depth=number(sv.DEPTH),
            depth_source=int(copy[sv.DEPTH_SOURCE]),
            depth_least=number(sv.DEPTH_LEAST),
            depth_most=number(sv.DEPTH_MOST),
            angle_error=number(sv.ANGLE_ERROR),
            force=copy[sv.FORCE],
            guide=copy[sv.GUIDE],
            felt=copy[sv.FELT],
            felt_most=number(sv.FELT_MOST),
            force_measured=bool(copy[sv.GAUGE] > 0.0),
            measured_force=number(sv.GAUGE_FORCE) if copy[sv.GAUGE] > 0.0 else 0.0,
            torque=copy[sv.TORQUE],
            axial_force=number(sv.AXIAL_FORCE),
            limit_scale=number(sv.LIMIT_SCALE),
            safety_scale=number(sv.SAFETY_SCALE),
            fault=Fault(int(copy[sv.FAULT])),
            kinematics=int(copy[sv.KINEMATICS]),
            lateness=number(sv.LATENESS),
            missed=int(copy[sv.MISSED]),
        )
