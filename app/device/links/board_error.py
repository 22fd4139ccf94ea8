"""What a board says is wrong with it, in words (docs/protocol.md)."""

from enum import IntEnum
from typing import Final


class BoardError(IntEnum):
    """What a board reports in the slot BOARD_ERROR."""

    NONE = 0
    TORQUE_NOT_FINITE = 1
    HOME_REFUSED = 2
    ENCODER = 3
    AMPLIFIER = 4
    SUPPLY_OFF = 5
    TOO_HOT = 6
    INTERNAL = 7

    @property
    def message(self) -> str:
        """Say what it means and what to do."""
        return _MESSAGES[self]


_MESSAGES: Final = {
    BoardError.NONE: "no error",
    BoardError.TORQUE_NOT_FINITE: "the board was sent a torque that is not a number",
    BoardError.HOME_REFUSED: "the board homes only while its motors are off and for the power"
    " cycle it is in; disarm and try again",
    BoardError.ENCODER: "an encoder is missing or skips; check its cable",
    BoardError.AMPLIFIER: "a motor amplifier reports a fault; switch its supply off and on",
    BoardError.SUPPLY_OFF: "the motor supply is off; release the emergency switch",
    BoardError.TOO_HOT: "a motor or amplifier is too hot; let it cool down",
    BoardError.INTERNAL: "the board's program reports an error of its own; reset it",
}


def describe_error(code: int) -> str:
    """Text for a board's error number, known or not."""
    if code in tuple(BoardError):
        return BoardError(code).message
    return f"the board reports error {code}, which this program does not know; see its firmware"
