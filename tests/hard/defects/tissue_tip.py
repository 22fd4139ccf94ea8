"""Defects of the tip in a field: a look at its end alone, and a way to what is no number."""

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import tissue_field
from app.simulation.tissue_walk import at_rest, distances_of, labels_of
from tests.hard.defects import Defect


def end_alone(state: FloatArray, parameters: FloatArray) -> None:
    # What lies at the tip of each tick: walls in between are jumped over.
    tip = state[sv.TIP]
    seen = at_rest(parameters, labels_of(parameters), distances_of(parameters), *tip)
    changed = seen[0] != parameters[tissue_field._AT.code]
    parameters[tissue_field._AT.code] = seen[0]
    state[sv.TISSUE], state[sv.WALL] = seen[0], -1e-9 if changed else 1.0


def by_nothing(state: FloatArray, parameters: FloatArray) -> None:
    tissue_field.step(state, parameters)
    if not np.isfinite(state[sv.TIP]).all():
        state[sv.WALL] = np.nan


DEFECTS = {
    "effects": {
        "walls of slabs thinner than a tick's way are all told, at their places": Defect(
            "only the tissue at the tip of each tick is looked up", end_alone
        ),
        "a tip at the grid's border, far off it, or nowhere, is in a tissue of the table": Defect(
            "what is no number is walked to", by_nothing
        ),
    }
}
