"""The program's end of a wire: fields that every protocol shares, and the slots it publishes."""

from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.device.links import wire
from app.device.links.framing import RECEIVER
from app.device.links.link import LinkStatus

STATUS: Final = wire.END  # a LinkStatus, by the supervisor
SILENT_AFTER: Final = wire.END + 1  # [s] without a reply
HEARD: Final = wire.END + 2  # [s] time of the newest reply
REPLIES: Final = wire.END + 3
ERRORS: Final = wire.END + 4
LOST: Final = wire.END + 5
ROUND_TRIP: Final = wire.END + 6  # [s]
ANSWERED: Final = wire.END + 7  # sequence number of the newest reply, -1 before the first
HOMED: Final = wire.END + 8  # 1 once homed in this power cycle of the board
ESTRANGED: Final = wire.END + 9  # 1 when the board asks for a new handshake
ERROR: Final = wire.END + 10  # that the board reports
OFFSET: Final = wire.END + 11  # joint angles at zero counts [rad]: left, right
STEP: Final = wire.END + 13  # joint angle per count [rad]
GAUGE: Final = wire.END + 14  # 1 while the force is measured
FORCE: Final = wire.END + 15  # reading of the gauge, as the board sends it
TICKS: Final = wire.END + 16  # calls of the write stage
HOME_WANTED: Final = wire.END + 17  # requests to home
HOME_SENT: Final = wire.END + 18
HOME_COUNT: Final = wire.END + 19  # bytes of the homing message
BOARD_FLAGS: Final = wire.END + 20
HOME_BYTES: Final = wire.END + 21  # 32 bytes
RECEIVER_AT: Final = wire.END + 25
SPARE: Final = RECEIVER_AT + RECEIVER
"""A protocol's own fields."""

SENT: Final = SPARE + 16  # commands sent so far
RESTS: Final = SENT + 1  # 1 while no command shall go out
SIZE: Final = RESTS + 1

_FINE = int(LinkStatus.FINE)
_CONNECTING = int(LinkStatus.CONNECTING)
_SILENT = int(LinkStatus.SILENT)


@njit
def home_bytes(p: FloatArray) -> Any:
    """Bytes of the homing message, ready to send."""
    return p[HOME_BYTES:RECEIVER_AT].view(np.uint8)


@njit
def heard(p: FloatArray) -> None:
    """Count a reply."""
    p[REPLIES] += 1.0
    p[HEARD] = p[wire.NOW]


@njit
def publish(state: FloatArray, p: FloatArray) -> None:
    """Write the LINK_* slots. A robot that is not homed in this power cycle clears HOMED."""
    status = int(p[STATUS])
    if status == _FINE:
        if p[ESTRANGED] != 0.0:
            status = _CONNECTING
        elif not p[wire.NOW] - p[HEARD] <= p[SILENT_AFTER]:
            status = _SILENT
    state[sv.LINK_STATUS] = status
    state[sv.LINK_REPLIES] = p[REPLIES]
    state[sv.LINK_ERRORS] = p[ERRORS]
    state[sv.LINK_LOST] = p[LOST]
    state[sv.ROUND_TRIP] = p[ROUND_TRIP]
    state[sv.BOARD_ERROR] = p[ERROR]
    state[sv.GAUGE] = p[GAUGE]
    state[sv.GAUGE_FORCE] = p[FORCE]
    if p[HOMED] == 0.0:
        state[sv.HOMED] = 0.0


@njit
def may_send(p: FloatArray) -> bool:
    """Return whether a command may go out: not while somebody else talks to the board, or it
    rests.
    """
    p[TICKS] += 1.0
    p[wire.OUT_COUNT] = 0.0
    return p[STATUS] == _FINE and p[RESTS] == 0.0


@njit
def append_home(p: FloatArray) -> bool:
    """Send the homing message once for each request; return whether it was sent."""
    if p[HOME_WANTED] == p[HOME_SENT]:
        return False
    p[HOME_SENT] = p[HOME_WANTED]
    out, start = wire.outgoing(p), int(p[wire.OUT_COUNT])
    data = home_bytes(p)
    for k in range(int(p[HOME_COUNT])):
        out[start + k] = data[k]
    p[wire.OUT_COUNT] = start + p[HOME_COUNT]
    return True
