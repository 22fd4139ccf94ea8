"""A robot as a process of its own: the board's program and the plant behind a pseudo-terminal.

To the program at the other end it is a serial port, which can be unplugged. The board and the plant
run in a compiled loop of their own; faults are switched while it runs. Unplugging closes the
terminal and plugging in makes a new one behind the same link.
The hand at it is still, led round by a script, or moved by typed orders.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi, radians, sin
from pathlib import Path
from typing import IO, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import SystemClock
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.control import Inbox, Loop
from app.device.errors import LinkError
from app.device.links import board, line, wire
from app.device.links import board_layout as at
from app.device.links.board import FAULTS, NUMBERED, Faults
from app.device.links.board_layout import new_board
from app.device.links.transport import fd_await, fd_send
from app.mechanisms.profile import DeviceProfile
from app.simulation.plant import initial_plant, plant_stage


class Terminal:
    """The board's end of a serial cable.

    The compiled loop reads and writes one descriptor, whose number never changes; unplugged, there
    is nothing behind it.

    Args:
        end: array of the board's end of the wire; its field FD is kept here.
        link: path of a symbolic link to the terminal, made anew with each one.
    """

    def __init__(self, end: FloatArray, link: Path | None) -> None:
        self._end = end
        self._link = link
        self._fd = -1
        self._slave = -1
        self.path = ""

    def open(self) -> None:
        """Plug in.

        Raises:
            LinkError: if the link's path is taken by something that is not a link, or is in a
                folder that is absent or may not be written.
        """
        if self._link is not None and self._link.exists() and not self._link.is_symlink():
            raise LinkError(
                sentence("{link} exists and is not a link; choose another --link", link=self._link)
            )
        if self._link is not None and not os.access(self._link.parent, os.W_OK):
            raise LinkError(
                sentence(
                    "no link can be made in {link_parent}; choose another --link",
                    link_parent=self._link.parent,
                )
            )
        self._fd = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
        self._end[wire.FD] = self._fd
        self.put()

    def put(self) -> None:
        """Make a new terminal and put it behind the descriptor. Does nothing if there is one.

        Raises:
            LinkError: if the system has none.
        """
        if self._slave >= 0:
            return
        try:
            import pty
            import tty
        except ImportError:
            raise LinkError(
                sentence(
                    "this system has no pseudo-terminals (Windows): the emulated board runs on "
                    "Linux"
                )
            ) from None
        master, self._slave = pty.openpty()
        tty.setraw(self._slave)
        os.set_blocking(master, False)
        os.dup2(master, self._fd, inheritable=False)
        os.close(master)
        self.path = os.ttyname(self._slave)
        if self._link is not None:
            fresh = self._link.with_name(f".{self._link.name}.{os.getpid()}")
            fresh.symlink_to(self.path)
            fresh.replace(self._link)

    def take_away(self) -> None:
        """Close the terminal: whoever has it open sees that the port has gone."""
        if self._slave < 0:
            return
        if self._link is not None:
            self._link.unlink(missing_ok=True)
        nothing = os.open(os.devnull, os.O_RDWR | os.O_NONBLOCK)
        os.dup2(nothing, self._fd, inheritable=False)
        os.close(nothing)
        os.close(self._slave)
        self._slave = -1

    def close(self) -> None:
        """Unplug for good; no loop may use the descriptor any more. Idempotent."""
        self.take_away()
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1


HANDS: Final = ("none", "rest", "script")
ORDERS: Final = ("hold", "turn", "lean")
SPEED: Final = 0.3
"""How fast a typed order moves the needle's direction [1/s]: slower than what counts as let go."""

_SIDES: Final = {"left": 0, "right": 1}
_TILT: Final = 0.15
_LARGEST_TILT: Final = 45.0


class EmulatedHand:
    """Writes HAND_* of the emulator's own loop; `work` must be called now and then.

    Args:
        profile: the robot.
        depth: of the tip, which the hand keeps [m].
        q: joint angles under the upright needle [rad]: left, right.
        name: `none` (the needle is free), `rest` (held), `script` (led round in a cone).

    Raises:
        LinkError: for another name; gives the valid ones.
    """

    def __init__(
        self, profile: DeviceProfile, depth: float, q: tuple[float, float], name: str
    ) -> None:
        self._profile, self._depth = profile, depth
        self._q = np.array(q)
        self._wanted = np.zeros(2)
        self._at = np.zeros(2)
        self._time = 0.0
        self.take(name)

    def take(self, name: str) -> None:
        """Hold the needle otherwise."""
        if name not in HANDS:
            raise LinkError(
                sentence(
                    "no hand {name!r}; valid names: {hands}", name=name, hands=", ".join(HANDS)
                )
            )
        self.name = name

    def obey(self, words: list[str]) -> None:
        """Obey `hold on|off`, `turn left|right DEGREES` of one link, or `lean X Y` in degrees.

        Turning and leaning take the needle into the hand, and move it at `SPEED`.

        Raises:
            LinkError: if it cannot be understood, or would lean the needle too far.
            MechanismError: if the links cannot take the pose.
        """
        match words:
            case ["hold"] | ["hold", "on" | "1"]:
                self.take("rest")
            case ["hold", "off" | "0"]:
                self.take("none")
            case ["turn", side, angle] if side in _SIDES:
                self._turn(_SIDES[side], radians(_degrees(angle)))
            case ["lean", x, y]:
                self._wanted = np.sin(np.radians([_degrees(x), _degrees(y)]))
                self.name = "rest"
            case _:
                raise LinkError(
                    sentence(
                        "{order!r} is not understood; valid are: hold on|off,"
                        " turn left|right DEGREES, lean X Y (degrees towards x and y)",
                        order=" ".join(words),
                    )
                )

    def work(self, now: float, inbox: Inbox) -> None:
        """Move as far as the time since the last call [s] allows."""
        elapsed, self._time = min(max(now - self._time, 0.0), 0.1), now
        if self.name == "script":
            angle = 2.0 * pi * 0.3 * now
            self._at = sin(_TILT) * np.array([cos(angle), sin(angle)])
        else:
            way = self._wanted - self._at
            self._at = self._at + way * min(1.0, SPEED * elapsed / max(np.hypot(*way), 1e-12))
        x, y = self._at.tolist()
        holds = float(self.name != "none")
        inbox.write(hand_x=x, hand_y=y, hand_depth=self._depth, hand_holds=holds)

    def _turn(self, side: int, angle: float) -> None:
        q: FloatArray = self._q.copy()
        q[side] += angle
        axis = self._profile.machine.axis(q)
        if not np.hypot(*axis[:2]) <= sin(radians(_LARGEST_TILT)) or axis[2] > 0.0:
            raise LinkError(
                sentence(
                    "the needle would lean by more than {largest_tilt:g} degrees; turn by less",
                    largest_tilt=_LARGEST_TILT,
                )
            )
        self._q, self._wanted, self.name = q, np.array(axis[:2]), "rest"


def _degrees(text: str) -> float:
    try:
        value = float(text)
    except ValueError as error:
        raise LinkError(sentence("{angle!r} is no number of degrees", angle=text)) from error
    if not abs(value) <= _LARGEST_TILT:
        raise LinkError(
            sentence(
                "{angle} degrees is too much; give at most {largest_tilt:g}",
                angle=text,
                largest_tilt=_LARGEST_TILT,
            )
        )
    return value


UPRIGHT: Final = (0.0, 0.0, -1.0)
DEPTH: Final = -0.015
RATE_HZ: Final = 4000.0
"""Rounds of the board and steps of the plant in a second."""

_LISTENS: Final = 0.6
"""Share of a round in which the board waits for bytes, to answer them at once."""

_BOX: Final = wire.END
_PARKED: Final = _BOX + board.SIZE  # 1: the arms go to the home angles, 0: back
_SHARE: Final = _PARKED + 1  # of the way there
_START: Final = _PARKED + 2  # joint angles under the upright needle [rad]: left, right
_PARK: Final = _PARKED + 4  # home angles [rad]: left, right
_UNPLUGGED: Final = _PARKED + 6
_SIZE: Final = _UNPLUGGED + 1
_PARKING_TIME: Final = 0.5
_SILENT: Final = 2.0  # LINK_STATUS of a tripped watchdog in the record


@njit
def _move_to_park(state: FloatArray, p: FloatArray) -> None:
    step = state[sv.DT] / _PARKING_TIME
    p[_SHARE] += min(max(p[_PARKED] - p[_SHARE], -step), step)
    if p[_SHARE] > 0.0:
        for k in range(2):
            way = p[_SHARE] * (p[_PARK + k] - p[_START + k])
            state[sv.PLANT_Q_LEFT + k] = p[_START + k] + way
            state[sv.PLANT_QD_LEFT + k] = 0.0


@stage
def board_stage(state: FloatArray, p: FloatArray) -> None:
    """Bytes of the port to the board and back; TORQUE_* becomes what its motors give.

    LINK_REPLIES counts valid commands, LINK_ERRORS frames dropped, ROUND_TRIP is the time since the
    newest command, LINK_STATUS 2 while the watchdog has tripped, LINK_LOST 1 while unplugged, HOMED
    and ENABLED as the board has them.
    """
    end, box = p[:_BOX], p[_BOX:_PARKED]
    _move_to_park(state, p)
    now = state[sv.TIME]
    box[at.Q], box[at.Q + 1] = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    for k in range(4):
        box[at.CABLE + k] = state[sv.PLANT_CABLE_1 + k]
        box[at.REEL + k] = state[sv.PLANT_REEL_1 + k]
    box[at.GAUGE_READING] = np.sqrt(
        state[sv.PULL_X] ** 2 + state[sv.PULL_Y] ** 2 + state[sv.PULL_Z] ** 2
    )
    end[wire.OUT_COUNT] = board.exchange(
        box, now, wire.incoming(end), int(end[wire.IN_COUNT]), wire.outgoing(end), 0
    )
    end[wire.IN_COUNT] = 0.0
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = box[at.TORQUE], box[at.TORQUE + 1]
    board.winches(state, box)
    state[sv.LINK_REPLIES], state[sv.LINK_ERRORS] = box[at.COMMANDS], box[at.ERRORS]
    state[sv.ROUND_TRIP] = now - box[at.COMMANDED]
    state[sv.LINK_STATUS] = _SILENT if box[at.TRIPPED] != 0.0 else 0.0
    state[sv.HOMED], state[sv.ENABLED] = box[at.HOMED], box[at.ENABLED]
    state[sv.LINK_LOST] = p[_UNPLUGGED]


@dataclass(frozen=True, slots=True)
class EmulatorSetup:
    """What is emulated.

    Attributes:
        profile: the robot.
        link: path of a symbolic link to the terminal, kept across unplugging; None: no link.
        hand: `none` (the needle is free), `rest` (held upright), `script` (led round in a cone).
        record: CSV file of every round of the board; None: no record.
        parked: whether the arms rest at the home angles at first, as they do for homing.
        gauge: whether the board has a force gauge.
        serial: serial number that the board reports.
        seed: of the faults.
    """

    profile: DeviceProfile
    link: Path | None = None
    hand: str = "none"
    record: Path | None = None
    parked: bool = False
    gauge: bool = False
    serial: str = "EMULATED"
    seed: int = 1

    def __post_init__(self) -> None:
        if self.hand not in HANDS:
            raise LinkError(
                sentence(
                    "no hand {hand!r}; valid names: {hands}", hand=self.hand, hands=", ".join(HANDS)
                )
            )


class Emulator:
    """A robot behind a pseudo-terminal. `work` must be called now and then while it is open.

    Args:
        setup: what is emulated.
        tell: called with each line for people, e.g. the path of the terminal.
    """

    def __init__(self, setup: EmulatorSetup, tell: Callable[[str], None] = print) -> None:
        profile = setup.profile
        self.setup = setup
        self._tell = tell
        self._array = np.zeros(_SIZE)
        self._end, box = self._array[:_BOX], self._array[_BOX:_PARKED]
        box[: at.SIZE] = new_board(profile, setup.serial, boot=int(SystemClock().now()))
        box[at.GAUGE] = setup.gauge
        box[board.DOWN : board.UP] = line.line(setup.seed)
        box[board.UP :] = line.line(setup.seed + 1)
        self._array[_PARK : _PARK + 2] = profile.encoder.home_offsets
        self._array[_PARKED] = self._array[_SHARE] = setup.parked
        self._faults = Faults(box)
        self._end[wire.WAIT] = _LISTENS / RATE_HZ
        self._terminal = Terminal(self._end, setup.link)
        start = initial_plant(profile, UPRIGHT, DEPTH)
        q = start["plant_q_left"], start["plant_q_right"]
        self._hand = EmulatedHand(profile, DEPTH, q, setup.hand)
        self._array[_START : _START + 2] = q
        if setup.parked:
            start["plant_q_left"], start["plant_q_right"] = profile.encoder.home_offsets
        stages = [
            Stage("receive", fd_await, self._end),
            Stage("board", board_stage, self._array),
            Stage("send", fd_send, self._end),
            plant_stage(profile, UPRIGHT, DEPTH),
        ]
        self._loop = Loop(stages, RATE_HZ, initial=start)
        self._columns = COLUMNS | (CABLE_COLUMNS if profile.tension_range is not None else {})
        self._record: IO[str] | None = None
        self._recorded = 0

    @property
    def path(self) -> str:
        """Path of the terminal, or of the link to it."""
        return str(self.setup.link or self._terminal.path)

    def open(self) -> None:
        """Plug in and switch on; tells the path once the board runs."""
        self._hand.work(SystemClock().now(), self._loop.inbox)
        if self.setup.record is not None:
            self._record = self.setup.record.open("w", encoding="utf-8")
            self._record.write(",".join(self._columns) + "\n")
        self._terminal.open()
        self._loop.open()
        while self._loop.latest().tick == 0:
            time.sleep(0.01)
        self._tell(self.path)

    def close(self) -> None:
        """Switch off and unplug. Idempotent."""
        self._loop.close()
        self._write_record()
        self._terminal.close()
        if self._record is not None:
            self._record.close()
            self._record = None

    def work(self) -> None:
        """Move the hand and write the record up to now; at least once a second."""
        self._hand.work(SystemClock().now(), self._loop.inbox)
        self._write_record()

    def switch(self, order: str) -> None:
        """Obey one line, e.g. `drop 0.1`, `freeze on`, `unplug off`, `reset`, `park on`,
        `turn left 10`.

        Raises:
            LinkError: if it cannot be understood; names the valid orders.
        """
        words = order.replace("=", " ").split()
        if words and words[0] in ORDERS:
            self._hand.obey(words)
            return
        name, value = _understood(order)
        if name == "unplug":
            self._unplug(value != 0.0)
        elif name == "park":
            self._array[_PARKED] = value != 0.0
        elif name in FAULTS:
            self._faults.set(name, value)
        else:
            valid = (*FAULTS, "unplug", "park", *ORDERS)
            raise LinkError(
                sentence(
                    "no fault or order {name!r}; valid names: {valid}",
                    name=name,
                    valid=", ".join(valid),
                )
            )

    def _unplug(self, out: bool) -> None:
        self._array[_UNPLUGGED] = out
        if out:
            self._terminal.take_away()
        else:
            self._terminal.put()
            self._tell(self.path)

    def _write_record(self) -> None:
        if self._record is None:
            return
        rows = self._loop.rows(self._recorded)
        if len(rows):
            self._recorded = int(rows[-1, sv.TICK])
            table = rows[:, list(self._columns.values())]
            self._record.writelines(",".join(f"{x:.9g}" for x in row) + "\n" for row in table)
            self._record.flush()


def _understood(order: str) -> tuple[str, float]:
    """Split an order into its name and value; only a switch may stand without its `on`."""
    words = order.replace("=", " ").split() or [""]
    name, text = words[0], words[1] if len(words) > 1 else "on"
    if len(words) == 1 and name in NUMBERED:
        raise LinkError(sentence("fault {name} needs a number, e.g. `{name} 1`", name=name))
    try:
        return name, float({"on": "1", "off": "0"}.get(text, text))
    except ValueError as error:
        raise LinkError(
            sentence("fault {name}: {setting!r} is no number, on or off", name=name, setting=text)
        ) from error


COLUMNS: Final = {
    "tick": sv.TICK,
    "time": sv.TIME,
    "lateness": sv.LATENESS,
    "torque_left": sv.TORQUE_LEFT,
    "torque_right": sv.TORQUE_RIGHT,
    "commands": sv.LINK_REPLIES,
    "since_command": sv.ROUND_TRIP,
    "tripped": sv.LINK_STATUS,
    "unplugged": sv.LINK_LOST,
    "enabled": sv.ENABLED,
    "homed": sv.HOMED,
    "q_left": sv.PLANT_Q_LEFT,
    "q_right": sv.PLANT_Q_RIGHT,
}
"""Columns of the record -> slots of the emulator's own loop; `tripped` is 2 after the watchdog."""

CABLE_COLUMNS: Final = {
    f"{what}_{k}": sv.INDEX[f"{what}_{k}"]
    for what in ("tension", "reel_rate", "plant_cable")
    for k in range(1, 5)
}
"""Further columns of a robot with cables."""
