"""The result of compiling a scene: what is simulated, with which model, and why."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.simulation.effects import Effect, implementation, parameters_of
from app.simulation.errors import SimulationError
from app.simulation.scene import Binding, Scene

Stage = tuple[str, Any, FloatArray]
"""Name, compiled `void(state, parameters)`, its parameters array."""


@dataclass(frozen=True, slots=True)
class KeptEffect:
    """An effect that is simulated: with which model, which parameters, for whom, and why."""

    declaration: Effect
    model: str
    parameters: dict[str, float]
    consumers: tuple[str, ...]
    why: str

    @property
    def name(self) -> str:
        """Name of the effect."""
        return self.declaration.name


@dataclass(frozen=True, slots=True)
class DroppedEffect:
    """An effect that was asked for and is not simulated, and why."""

    name: str
    why: str


@dataclass(frozen=True, slots=True)
class SimulationPlan:
    """What is simulated, in the order in which it runs, and what is not.

    Attributes:
        scene: what was compiled.
        kept: effects in running order.
        dropped: effects without a consumer, in the scene's order.
        depth_slot: slot that effects along the needle take the depth from.
    """

    scene: Scene
    kept: tuple[KeptEffect, ...]
    dropped: tuple[DroppedEffect, ...]
    depth_slot: int

    def stages(self) -> list[Stage]:
        """Import what is kept and return its stages, each with fresh memory.

        They add to FORCE_*, which the device's table clears, and to AXIAL_FORCE and
        TARGET_SHIFT_*, which the first of these stages clears. Nothing kept: no stages.
        """
        if not self.kept:
            return []
        from app.simulation.clearing import clear  # compiled; the plan itself is needed sooner

        return [("clear_effects", clear, np.zeros(1)), *(self._stage(kept) for kept in self.kept)]

    def energy_bound(self) -> float:
        """Return the most energy that the kept effects can store behind FORCE_* together [J].

        An effect that does not say (no function `energy_bound(parameters)` in its file) counts as
        active: it gets no share, and what it gives out is paid by the others.

        Raises:
            SimulationError: if an effect's own bound is no finite number of 0 or more.
        """
        return sum(self._bound(kept) for kept in self.kept)

    def _bound(self, kept: KeptEffect) -> float:
        module = implementation(kept.name)
        if not hasattr(module, "energy_bound"):
            return 0.0
        bound = float(module.energy_bound(self._stage(kept)[2]))
        if not 0.0 <= bound < math.inf:
            raise SimulationError(
                f"effect {kept.name}: energy_bound is {bound} J; give a finite number of 0 or more"
            )
        return bound

    def _stage(self, kept: KeptEffect) -> Stage:
        binding = Binding(self.scene, self.depth_slot, kept.model)
        array = parameters_of(kept.name, kept.parameters, binding)
        return kept.name, implementation(kept.name).step, array
