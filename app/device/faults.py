"""Why the robot gives no force: names and messages of the loop's faults."""

from enum import IntEnum
from typing import Final


class Fault(IntEnum):
    """Why the force is held at zero; the value of the slot `FAULT`."""

    NONE = 0
    INPUT_NOT_FINITE = 1
    ENCODER_NOT_FINITE = 2
    UNREACHABLE = 3
    SINGULAR = 4
    NO_GRIP = 5
    DEGENERATE = 6
    FORCE_NOT_FINITE = 7
    ENCODERS_STALE = 8
    HEARTBEAT_LOST = 9
    LET_GO = 10
    NOT_HOMED = 11
    LINK_LOST = 12
    BOARD_ERROR = 13
    CABLE_SLACK = 14
    CABLE_BROKEN = 15
    ENCODER_LOST = 16
    ENCODER_WRAPPED = 17
    ENCODER_JUMPED = 18

    @property
    def message(self) -> str:
        """Say what happened and what to do, for people."""
        return _MESSAGES[self]


_MESSAGES: Final = {
    Fault.NONE: "no fault",
    Fault.INPUT_NOT_FINITE: "an input of the loop (hand, path, tracker or dial) is not a number;"
    " check the camera calibration and the plan",
    Fault.ENCODER_NOT_FINITE: "an encoder gives no number; check its cable",
    Fault.UNREACHABLE: "the encoders report a pose that the links cannot take; check their offsets",
    Fault.SINGULAR: "the robot is in a singular pose; move the needle back towards the middle",
    Fault.NO_GRIP: "nothing of the needle stands out of the fulcrum; pull it out",
    Fault.DEGENERATE: "the needle has no direction; check the encoder offsets",
    Fault.FORCE_NOT_FINITE: "a force law or an effect gave no number; leave out the effect",
    Fault.ENCODERS_STALE: "the encoders have not been read for 100 ms; check the link to the robot",
    Fault.HEARTBEAT_LOST: "the window has given no sign of life for 1 s; it is busy or has ended",
    Fault.LET_GO: "the needle moved as if nobody held it, so its force was cut; hold it, then arm"
    " or begin again",
    Fault.NOT_HOMED: "the robot is not homed, or its signs are not checked, since it was switched"
    " on; run the commissioning wizard or `acus device calibrate`",
    Fault.LINK_LOST: "the robot does not answer; check cable and power, it is looked for again",
    Fault.CABLE_SLACK: "a cable of the robot has gone slack, so its force was cut; look whether it"
    " lies on its pulleys, then arm again",
    Fault.CABLE_BROKEN: "a cable of the robot runs without load, as if it were torn, so its force"
    " was cut; look at all four, then arm again",
    Fault.ENCODER_LOST: "an encoder of the robot contradicts its cables or is silent, so the force"
    " was cut; check its plug, then arm again",
    Fault.ENCODER_WRAPPED: "an encoder jumped by a power of two counts or by a whole turn, as where"
    " its counter overflows or loses a bit, so the force was cut; check the board's counters, then"
    " home the robot again",
    Fault.ENCODER_JUMPED: "an encoder jumped further than a hand or a motor can turn it, so the"
    " force was cut; check its cable and plug, then home the robot again",
    Fault.BOARD_ERROR: "the robot's board reports an error; see the robot's health panel",
}
