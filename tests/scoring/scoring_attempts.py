"""Synthetic attempts: straight insertions with chosen errors."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.trajectory import Trajectory

FULCRUM = np.array([0.0, 0.16056, 0.090])
HUB_LENGTH = 0.2


def placed_plan(
    target_mm: tuple[float, float, float] = (20.0, -20.0, 310.0),
    placement: Placement | None = None,
) -> PlacedPlan:
    return PlacedPlan.of(Plan((0.0, -95.0, 300.0), target_mm), placement or Placement(), FULCRUM)


@dataclass(frozen=True)
class Attempt:
    """What is wrong with an attempt; nothing by default. Metres, radians, seconds, newtons."""

    lateral: float = 0.0
    depth: float = 0.0
    tilt: float = 0.0
    aligning: float = 20.0
    inserting: float = 20.0
    holding: float = 5.0
    rate: float = 50.0
    noise: float = 0.0
    detour: float = 0.0
    force: float = 0.0
    seed: int = 1

    def but(self, **changes: Any) -> "Attempt":
        return replace(self, **changes)

    def trajectory(self, **changes: Any) -> Trajectory:
        placed = changes.pop("placed", placed_plan())
        arrays = self._arrays(placed)
        return Trajectory(placed=placed, **(arrays | changes))

    def _arrays(self, placed: PlacedPlan) -> dict[str, Any]:
        total = self.aligning + self.inserting + self.holding
        time = np.arange(round(total * self.rate) + 1) / self.rate
        share = np.clip((time - self.aligning) / self.inserting, 0.0, 1.0)
        side = _perpendicular(placed.axis)
        depth = share * (placed.length + self.depth)
        bow = self.detour * np.sin(np.pi * share) + self.lateral * share
        tip = placed.p_entry + np.outer(depth, placed.axis) + np.outer(bow, side)
        tip = tip + np.random.default_rng(self.seed).normal(0.0, self.noise, tip.shape)
        axis = np.cos(self.tilt) * placed.axis + np.sin(self.tilt) * side
        n = len(time)
        phase = np.full(n, "holding", dtype="U9")
        phase[time < self.aligning + self.inserting] = "inserting"
        phase[time < self.aligning] = "aligning"
        return {
            "time": time,
            "tip": tip,
            "axis": np.tile(axis, (n, 1)),
            "depth": depth,
            "felt": np.tile(self.force * side, (n, 1)),
            "phase": phase,
            "depth_valid": np.ones(n, dtype=bool),
            "hub": tip - HUB_LENGTH * axis,
        }


def _perpendicular(axis: FloatArray) -> FloatArray:
    side = np.cross(axis, [0.0, 1.0, 0.0])
    result: FloatArray = side / np.linalg.norm(side)
    return result
