"""Defects of the encoders' hard cases: what believes too much."""

from math import radians

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from tests.hard.defects import Defect


def let_all_pass(state: FloatArray, p: FloatArray) -> None:
    """Believe every reading."""


def by_distance(state: FloatArray, p: FloatArray) -> None:
    """Judge a reading by its distance from the newest believed one alone, which grows with time."""
    believed = p[-3:]  # what of the memory is empty at first: an angle, its time, whether it is one
    stamp, left = state[sv.Q_TIME], state[sv.Q_LEFT]
    near = abs(left - believed[0]) <= radians(3.0) * max((stamp - believed[1]) * 1e3, 1.0)
    if near or believed[2] == 0.0:
        believed[:] = left, stamp, 1.0
    state[sv.Q_LEFT] = believed[0]


DEFECTS = {
    "cables and encoders": {
        "an encoder that slips by 3.6° in a millisecond and stays there is not believed": Defect(
            "3° for each millisecond since the last believed reading", by_distance
        ),
        "five readings that are 2¹⁶ counts off are missing ones": Defect(
            "every reading is believed", let_all_pass
        ),
    },
}
