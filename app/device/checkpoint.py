"""Everything that a tick of the loop depends on besides its inputs, at one moment."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final, Protocol

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, read_only

ADDRESSED: Final = {"tissue_field": 3, "keep_bend": 3}
"""Stage -> how many numbers at the beginning of its array are a slot's place and addresses of this
process: no checkpoint holds an address, and no run goes on with that of another."""


class NamedStage(Protocol):
    """What a checkpoint needs of a stage of the loop's table."""

    @property
    def name(self) -> str:
        """Name of the stage."""
        ...

    @property
    def parameters(self) -> FloatArray:
        """Its constants and its memory, shape (n,)."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Checkpoint:
    """State of a loop between two ticks: with the inputs that follow, the run can be recomputed.

    Attributes:
        tick: number of the last tick before it; 0 before the first.
        state: the state vector, shape (SLOTS,), read-only.
        parameters: constants and memory of every stage, one after the other, shape (n,), read-only.
        sizes: how many numbers belong to each stage; their sum is n.
        names: of the stages in the order of the tick.
    """

    tick: int
    state: FloatArray
    parameters: FloatArray
    sizes: tuple[int, ...]
    names: tuple[str, ...]

    @classmethod
    def of(cls, buffer: FloatArray, stages: Iterable[NamedStage]) -> Checkpoint:
        """Copy what the kernel wrote: the state, then the stages' arrays, shape (SLOTS + n,)."""
        table: list[Any] = list(stages)
        copy = read_only(_without_addresses(np.array(buffer, dtype=np.float64), table))
        return cls(
            tick=int(copy[sv.TICK]),
            state=copy[: sv.SLOTS],
            parameters=copy[sv.SLOTS :],
            sizes=tuple(len(stage.parameters) for stage in table),
            names=tuple(stage.name for stage in table),
        )


def _without_addresses(copy: FloatArray, stages: Iterable[NamedStage]) -> FloatArray:
    place = sv.SLOTS
    for stage in stages:
        copy[place + 1 : place + ADDRESSED.get(stage.name, 1)] = 0.0
        place += len(stage.parameters)
    return copy
