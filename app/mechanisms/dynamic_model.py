"""Constants of the equations of motion of one robot, as compiled code takes them.

Kernels take the model as a slice of an array of parameters: `values`, laid out as the slots named
here, starting at any index that the caller chooses.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.core.arrays import FloatArray, frozen
from app.mechanisms.geometry import Geometry
from app.mechanisms.inertia import LumpedInertia

# Lengths [m].
A1: Final = 0
A2: Final = 1
BASE: Final = 2
FX: Final = 3
FY: Final = 4
FZ: Final = 5
# Links: lumped inertias [kg·m²], mass at P3 [kg], first moments of mass [kg·m].
DRIVEN: Final = 6
PASSIVE: Final = 7
COUPLING: Final = 8
TOOL: Final = 9
DRIVEN_MOMENT: Final = 10
PASSIVE_MOMENT: Final = 11
# Needle: mass [kg], inertia across the shaft [kg·m²], centre of mass beyond the fulcrum at zero
# depth, along the needle [m] (negative: outside).
NEEDLE_MASS: Final = 12
NEEDLE_INERTIA: Final = 13
NEEDLE_OFFSET: Final = 14
# Gravity in the robot's frame [m/s²].
GX: Final = 15
GY: Final = 16
GZ: Final = 17
# Friction of each joint: Coulomb [N·m], viscous [N·m·s/rad], speed over which the first builds up
# [rad/s].
COULOMB: Final = 18
VISCOUS: Final = 19
SMOOTH: Final = 20
MODEL_SIZE: Final = 21

SMOOTH_SPEED: Final = 0.02
"""Joint speed over which Coulomb friction builds up [rad/s]; ours, not a property of a device."""


@dataclass(frozen=True, slots=True, eq=False)
class DynamicModel:
    """Everything that the equations of motion of a pantograph with its needle depend on.

    Attributes:
        geometry: lengths.
        inertia: lumped inertias, needle included.
        gravity: acceleration of gravity in the robot's frame [m/s²], shape (3,).
        coulomb: Coulomb friction of each driven joint [N·m].
        viscous: viscous friction of each driven joint [N·m·s/rad].
        smooth_speed: joint speed over which Coulomb friction builds up [rad/s].
    """

    geometry: Geometry
    inertia: LumpedInertia
    gravity: FloatArray
    coulomb: float
    viscous: float
    smooth_speed: float = SMOOTH_SPEED

    @property
    def values(self) -> FloatArray:
        """Return the constants in the order of the slots of this module, shape (MODEL_SIZE,)."""
        part = self.inertia
        return frozen(
            [
                *self.geometry.links,
                *self.geometry.fulcrum_xyz,
                *part.values,
                part.driven_moment,
                part.passive_moment,
                part.needle_mass,
                part.needle_inertia,
                part.needle_centre - self.geometry.needle_length,
                *self.gravity,
                *(self.coulomb, self.viscous, self.smooth_speed),
            ],
            (MODEL_SIZE,),
            "model of the dynamics",
        )
