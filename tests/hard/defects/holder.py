"""Defects of the needle holder's hard cases: who does not look, or waits too long."""

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.faults import Fault
from tests.hard.defects import Defect


def nothing(state: FloatArray, parameters: FloatArray) -> None:
    state[sv.MACHINE_FAULT] = 0.0


def late(state: FloatArray, parameters: FloatArray) -> None:
    # As if the program waited for the staleness of an ordinary robot.
    old = state[sv.TIME] - state[sv.Q_TIME]
    state[sv.MACHINE_FAULT] = float(Fault.ENCODER_LOST) if old > 0.1 else 0.0


DEFECTS = {
    "cables and encoders": {
        **dict.fromkeys(
            (
                "a torn cable whose tension is measured",
                "a torn cable whose motor's current says that it pulls",
                "a cable that hangs",
                "an encoder that sticks while both of its cables move",
            ),
            Defect("nobody looks", nothing),
        ),
        "an encoder that is not read any more": Defect(
            "wait for 100 ms, as where no cables pull", late
        ),
    },
}
