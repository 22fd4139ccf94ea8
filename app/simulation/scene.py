"""The scene: what stands in the simulated world, as frozen values; all that the compiler reads."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, frozen
from app.simulation.errors import SimulationError

SETTLING: Final = 1.0
"""Time in which an organ takes the place that a breath-hold gives it, and leaves it again [s]."""


@dataclass(frozen=True, slots=True)
class EffectRequest:
    """One effect by name; its presence in the scene is the switch.

    Attributes:
        name: file name of the effect in `simulation/effects`, without `.py`.
        parameters: SI values that replace the effect's defaults.
        model: which of the effect's ways to compute it; empty chooses the effect's first.
        organ: what the effect acts on; empty means everything. An effect on an organ that the
            target does not lie in has no consumer.
    """

    name: str
    parameters: Mapping[str, float] = field(default_factory=dict)
    model: str = ""
    organ: str = ""


@dataclass(frozen=True, slots=True)
class TissueLayer:
    """A slab of tissue along the path, counted from the skin.

    Attributes:
        name: what it is, for display.
        thickness: along the path [m], 0 or more.
        side_stiffness: lateral foundation stiffness [N/m per m of needle = N/m²].
        friction: kinetic shaft friction per inserted length [N/m].
        static_friction: break-away friction per inserted length [N/m], at least `friction`.
        viscous_friction: per inserted length [N·s/m²].

    Raises:
        SimulationError: if a value is negative or not finite.
    """

    name: str
    thickness: float
    side_stiffness: float = 20e3
    friction: float = 10.57
    static_friction: float = 18.45
    viscous_friction: float = 250.0

    def __post_init__(self) -> None:
        for quantity in (
            "thickness",
            "side_stiffness",
            "friction",
            "static_friction",
            "viscous_friction",
        ):
            value = getattr(self, quantity)
            if not (np.isfinite(value) and value >= 0.0):
                raise SimulationError(
                    f"layer {self.name!r}: {quantity} is {value}; give a finite value of 0 or more"
                )


@dataclass(frozen=True, slots=True)
class Needle:
    """The needle in the scene: `length` hub to tip [m], `outer_diameter` [m] (18 G by default)."""

    length: float = 0.200
    outer_diameter: float = 1.270e-3

    def __post_init__(self) -> None:
        for quantity in ("length", "outer_diameter"):
            value = getattr(self, quantity)
            if not (np.isfinite(value) and value > 0.0):
                raise SimulationError(f"needle {quantity} is {value}; give a finite value above 0")


DEFAULT_LAYERS: tuple[TissueLayer, ...] = (
    TissueLayer("skin", 0.002, 50e3),
    TissueLayer("fat", 0.015, 10e3, friction=5.0, static_friction=9.0, viscous_friction=120.0),
    TissueLayer("muscle", 0.015, 30e3, friction=12.0, static_friction=20.0),
    TissueLayer("liver", 0.168, 20e3),
)
"""Abdominal wall over liver; engineering defaults within the published ranges (10-50 kPa, Okamura
2004 friction). The last layer is thicker than any needle reaches."""


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """Everything that the compiler needs to know.

    Attributes:
        effects: what is asked for, in any order.
        layers: tissue along the path from the fulcrum inwards.
        needle: the needle.
        R_world_patient: columns are the patient's L, P and S directions in world, shape (3, 3).
        target_organ: organ in which the target lies; empty if not known.
    """

    effects: tuple[EffectRequest, ...] = ()
    layers: tuple[TissueLayer, ...] = DEFAULT_LAYERS
    needle: Needle = field(default_factory=Needle)
    R_world_patient: FloatArray = field(default_factory=lambda: np.eye(3))
    target_organ: str = ""

    def __post_init__(self) -> None:
        rotation = frozen(self.R_world_patient, (3, 3), "R_world_patient")
        if np.abs(rotation @ rotation.T - np.eye(3)).max() > 1e-6:
            raise SimulationError(f"R_world_patient {rotation.tolist()} is not a rotation")
        object.__setattr__(self, "R_world_patient", rotation)
        names = [request.name for request in self.effects]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise SimulationError(f"effect {twice[0]!r} stands twice in the scene; name it once")


@dataclass(frozen=True, slots=True, eq=False)
class Binding:
    """What an effect is bound to when its parameters array is made.

    Attributes:
        scene: the scene.
        depth_slot: slot that holds the depth for effects along the needle: the true depth of a
            simulated needle, else the measured one.
        model: the chosen way to compute the effect.
    """

    scene: Scene
    depth_slot: int = sv.DEPTH
    model: str = ""
