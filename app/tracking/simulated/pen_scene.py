"""What stands before a simulated webcam: a pen held somewhere, or rocked with its tip at rest."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, unit
from app.core.transform import RigidTransform, rotation_between
from app.core.units import DEGREE
from app.tracking.pen.needle import PenTip

ROCKING_ROUND = 4.0
"""Time [s] in which a rocked pen leans once to every side."""

ROCKING_SWELL = 10.0
"""Time [s] in which its lean grows from little to all and back."""

_LEAST, _MOST = 6.0 * DEGREE, 32.0 * DEGREE
_ROLL = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class PenScene:
    """The pen at one moment.

    Attributes:
        T_world_body: pose of cube or ring; None while it is not in view.
        p_tip: of the pen [m], shape (3,); where the drawn shaft ends.
    """

    T_world_body: RigidTransform | None
    p_tip: FloatArray


PenSceneAt = Callable[[float], PenScene]
"""What stands before the webcam at a monotonic time [s]."""


def body_pose(
    p_tip: FloatArray, axis: FloatArray, tip_body: FloatArray, axis_body: FloatArray, roll: float
) -> RigidTransform:
    """T_world_body of a needle: tip [m] and direction in world and in the body; roll [rad]."""
    turn = rotation_between(axis_body, axis)
    about = RigidTransform.exp(np.concatenate([np.zeros(3), roll * unit(axis)])).rotation
    rotation = about @ turn
    return RigidTransform(rotation, p_tip - rotation @ tip_body)


def rocked(p_tip: FloatArray, tip: PenTip) -> PenSceneAt:
    """Return a pen that is rocked to every side, its tip at rest at a place [m], shape (3,).

    A hand that rocks it does not roll it: the same faces look at the webcam.
    """
    down = np.array([0.0, 0.0, -1.0])
    upright = body_pose(p_tip, down, tip.p_tip, tip.axis, _ROLL).rotation

    def scene(time: float) -> PenScene:
        swell = 0.5 - 0.5 * np.cos(2.0 * np.pi * time / ROCKING_SWELL)
        way = 2.0 * np.pi * time / ROCKING_ROUND
        lean = np.tan(_LEAST + (_MOST - _LEAST) * swell)
        axis = unit([lean * np.cos(way), lean * np.sin(way), -1.0])
        roll = RigidTransform.exp([0.0, 0.0, 0.0, *(0.2 * np.sin(0.7 * way) * axis)]).rotation
        rotation = roll @ rotation_between(down, axis) @ upright
        return PenScene(RigidTransform(rotation, p_tip - rotation @ tip.p_tip), p_tip)

    return scene
