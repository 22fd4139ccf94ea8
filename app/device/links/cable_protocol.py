"""Acus' own protocol, version 2: a robot whose four winches pull cables (docs/protocol.md).

HELLO, INFO and HOME are those of version 1 but for the number of the version. A command has four
channels, what a winch is asked: tension, or while it holds how fast it reels in; a state has the
joints' counts, and of each cable its tension and what has been reeled in.
"""

from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.links import acus_protocol as acus
from app.device.links import framing, wire
from app.device.links import host_end as host
from app.device.links.framing import RECEIVER

VERSION: Final = 2
"""Version of the protocol for robots with four channels."""
CHANNELS: Final = 4

COMMAND: Final = 0x04
STATE: Final = 0x84
COMMAND_BYTES: Final = 20
STATE_BYTES: Final = 49

HOLD: Final = 2
"""Flag of a command: the channels are speeds of reeling [m/s], not tensions [N]."""

_TENSIONS: Final = 17  # place of the first in a state
_REELS: Final = 33


@njit
def _take_state(state: FloatArray, p: FloatArray, data: Any) -> None:
    fresh = acus.take_joints(state, p, data)
    if not fresh:
        return
    for k in range(CHANNELS):
        state[sv.CABLE_1 + k] = wire.get_float(p, data, _TENSIONS + 4 * k)
        state[sv.REEL_1 + k] = wire.get_float(p, data, _REELS + 4 * k)


@stage
def cables_read(state: FloatArray, p: FloatArray) -> None:
    """Parse what has come; the newest STATE becomes Q_*, CABLE_*, REEL_* and LINK_*."""
    receiver = p[host.RECEIVER_AT : host.RECEIVER_AT + RECEIVER]
    frame, payload = framing.frame_bytes(receiver), framing.payload_bytes(receiver)
    data = wire.incoming(p)
    for k in range(int(p[wire.IN_COUNT])):
        length = framing.receive(receiver, frame, payload, data[k])
        if length < 0:
            p[host.ERRORS] += 1.0
        elif length == STATE_BYTES and payload[0] == STATE:
            _take_state(state, p, payload)
    p[wire.IN_COUNT] = 0.0
    host.publish(state, p)


@stage
def cables_write(state: FloatArray, p: FloatArray) -> None:
    """Put one COMMAND with TENSION_*, or with REEL_RATE_* while it holds, into `outgoing`."""
    if not host.may_send(p):
        return
    host.append_home(p)
    holds = state[sv.HOLDING] > 0.5
    first = sv.REEL_RATE_1 if holds else sv.TENSION_1
    total = 0.0
    for k in range(CHANNELS):
        total += state[first + k]
    enable = state[sv.ENABLED] > 0.5 and np.isfinite(total)
    p[wire.SEQUENCE] = (int(p[wire.SEQUENCE]) + 1) & 0xFFFF
    p[host.SENT] += 1.0
    data = p[host.SPARE : host.SPARE + 8].view(np.uint8)
    data[0], data[1] = COMMAND, (acus.ENABLE if enable else 0) | (HOLD if holds else 0)
    wire.put_int(data, 2, int(p[wire.SEQUENCE]), 2)
    for k in range(CHANNELS):
        wire.put_float(p, data, 4 + 4 * k, state[first + k] if enable else 0.0)
    start = int(p[wire.OUT_COUNT])
    p[wire.OUT_COUNT] = framing.encode(data, COMMAND_BYTES, wire.outgoing(p), start)
