"""What a board in software knows, as fields of one float64 array, and a new one for a profile."""

from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.device.links import acus_protocol as acus
from app.device.links import haply_protocol as haply
from app.device.links import wire
from app.device.links.framing import RECEIVER
from app.mechanisms.profile import DeviceProfile, Protocol

WATCHDOG: Final = wire.END  # [s]
LIMIT: Final = wire.END + 1  # largest joint torque [N·m]
VERSION: Final = wire.END + 2  # of the protocol that it claims
BOOT: Final = wire.END + 3  # number of the power cycle
STEP: Final = wire.END + 4  # joint angle of a count [rad]
HAPLY: Final = wire.END + 5  # 1 for a Haply board
DEVICE_ID: Final = wire.END + 6
LEFT_SECOND: Final = wire.END + 7  # 1 if the left joint has the higher port
GAUGE: Final = wire.END + 8  # 1 if it has a force gauge
GAUGE_READING: Final = wire.END + 9
FROZEN: Final = wire.END + 10  # 1: its program hangs; the watchdog is a circuit of its own
RESET: Final = wire.END + 11  # 1: power goes off and on again
Q: Final = wire.END + 12  # true joint angles [rad]: left, right
ZERO: Final = wire.END + 14  # joint angles at zero counts [rad]: left, right
TORQUE: Final = wire.END + 16  # of its motors [N·m]: left, right
ENABLED: Final = wire.END + 18
HOMED: Final = wire.END + 19
GREETED: Final = wire.END + 20
TRIPPED: Final = wire.END + 21
ERROR: Final = wire.END + 22
COMMANDED: Final = wire.END + 23  # [s] time of the newest valid command
COMMANDS: Final = wire.END + 24
ERRORS: Final = wire.END + 25  # frames dropped
LARGEST: Final = wire.END + 26  # largest torque since power-up [N·m]
BORN: Final = wire.END + 27  # [s]
LAST: Final = wire.END + 28  # [s] time of the round before
HEARD: Final = wire.END + 29  # [s] when bytes came last
ANGLE_OFFSET: Final = wire.END + 30  # Haply: [°], in the order of ports
ENCODER_SIGN: Final = wire.END + 32  # -1 for a joint wired the wrong way round: left, right
MOTOR_SIGN: Final = wire.END + 34
TEMPLATE: Final = wire.END + 36  # 56 bytes: the INFO message
WORK: Final = TEMPLATE + 7  # 72 bytes: a message being built
RECEIVER_AT: Final = WORK + 9
CHANNELS: Final = RECEIVER_AT + RECEIVER  # 4 for winches, 0 for motors on the joints
CABLE: Final = CHANNELS + 1  # true tensions [N], four
REEL: Final = CABLE + 4  # reeled in [m], four
PULL: Final = REEL + 4  # what its winches do: tension [N], or speed of reeling in [m/s]
HOLDS: Final = PULL + 4  # 1 while those are speeds
FASTEST: Final = HOLDS + 1  # of reeling [m/s]
JUMP: Final = FASTEST + 1  # counts by which the left encoder is off
STUCK: Final = JUMP + 1  # 1: the left encoder gives what it gave last
LAST_COUNT: Final = STUCK + 1  # of the left encoder
REVERSED: Final = LAST_COUNT + 1  # 1: the left encoder counts backwards from where it is
TURNING: Final = REVERSED + 1  # 1: it does so already, about the angle that follows [rad]
TURNING_AT: Final = TURNING + 1
FLIPS: Final = TURNING_AT + 1  # probability that a bit of the left count of a state is wrong
RANDOM: Final = FLIPS + 1
LIMITED: Final = RANDOM + 1  # 1: the newest command asked for more than the largest
SIZE: Final = LIMITED + 1

TRIPS_EARLY: Final = 2e-3
"""The watchdog trips this long before its time is over [s], so that the torque is zero by then."""

FORGETS_AFTER: Final = 2e-3
"""A Haply command that stays incomplete for this long is forgotten [s]."""


def new_board(profile: DeviceProfile, serial: str = "EMULATED", boot: int = 1) -> FloatArray:
    """Return a board that has just been switched on, for a profile's protocol and numbers."""
    p = np.zeros(SIZE)
    p[WATCHDOG], p[LIMIT] = profile.wire.watchdog_ms * 1e-3, profile.limits.joint_torque
    p[VERSION], p[BOOT] = acus.VERSION, boot
    if profile.tension_range is not None:
        p[VERSION], p[CHANNELS], p[LIMIT] = 2.0, 4.0, profile.tension_range[1]
        p[FASTEST] = profile.fastest_reel
    p[STEP] = 2.0 * np.pi / profile.encoder.counts_per_turn
    p[ENCODER_SIGN : MOTOR_SIGN + 2] = 1.0
    p[RESET] = p[RANDOM] = 1.0
    if profile.wire.protocol is Protocol.HAPLY:
        section = haply.section_of(profile)
        p[HAPLY], p[DEVICE_ID] = 1.0, section.device_id
        p[LEFT_SECOND] = section.encoder_ports[0] > section.encoder_ports[1]
    template = p[TEMPLATE:WORK].view(np.uint8)
    text = acus.pack_info(profile, serial, boot, gauge=False, emulated=True)
    template[: len(text)] = np.frombuffer(text, np.uint8)
    return p
