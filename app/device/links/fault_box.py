"""A board behind two faulty pieces of wire: what the emulator and the link in memory consist of.

One float64 array holds the program's end of the wire, the board and both lines, so that one stage
can work on all of it.
"""

from dataclasses import dataclass
from typing import Any, Final

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.device.errors import LinkError
from app.device.links import board, line, wire
from app.device.links import board_layout as at

DOWN: Final = at.SIZE  # line to the board
UP: Final = DOWN + line.SIZE  # line from it
SIZE: Final = UP + line.SIZE


@njit
def exchange(p: FloatArray, now: float, sent: Any, count: int, answer: Any, fill: int) -> int:
    """Carry `sent[:count]` to the board, let it work, append what arrives to `answer[fill:]`.

    Returns:
        The new fill of `answer`.
    """
    the_board = p[: at.SIZE]
    down, up = p[DOWN:UP], p[UP:SIZE]
    line.push(down, now, sent, count)
    the_board[wire.IN_COUNT] = line.pop(
        down, now, wire.incoming(the_board), int(the_board[wire.IN_COUNT]), wire.IN_BYTES
    )
    if count > 0:
        the_board[at.HEARD] = now
    board.work(the_board, now)
    line.push(up, now, wire.outgoing(the_board), int(the_board[wire.OUT_COUNT]))
    the_board[wire.OUT_COUNT] = 0.0
    return line.pop(up, now, answer, fill, len(answer))


_SWITCHES: Final = {  # most, factor, places in the box
    "drop": (1.0, 1.0, (DOWN + line.DROP, UP + line.DROP)),
    "garble": (1.0, 1.0, (DOWN + line.GARBLE, UP + line.GARBLE)),
    "delay": (30.0, 1e-3, (DOWN + line.DELAY, UP + line.DELAY)),
    "cut": (1.0, 1.0, (DOWN + line.CUT, UP + line.CUT)),
    "freeze": (1.0, 1.0, (at.FROZEN,)),
    "reset": (1.0, 1.0, (at.RESET,)),
    "version": (255.0, 1.0, (at.VERSION,)),
    "error": (255.0, 1.0, (at.ERROR,)),
}

FAULTS: Final = tuple(_SWITCHES)
"""Names of the faults."""


@dataclass(frozen=True, slots=True)
class Faults:
    """Switches of a board and its wire; `array` is the box that they act on.

    `drop` and `garble` are probabilities per message in each direction, `delay` is in milliseconds
    each way, `freeze` and `cut` are on or off, `reset` happens once, `version` is what the board
    claims, `error` is what it reports.
    """

    array: FloatArray

    def set(self, name: str, value: float) -> None:
        """Switch one fault.

        Raises:
            LinkError: if there is no such fault, or the value is out of range; names those valid.
        """
        if name not in _SWITCHES:
            raise LinkError(f"no fault {name!r}; valid names: {', '.join(FAULTS)}")
        most, factor, places = _SWITCHES[name]
        if not 0.0 <= value <= most:
            raise LinkError(f"fault {name} is {value:g}; it must be from 0 to {most:g}")
        for place in places:
            self.array[place] = value * factor
