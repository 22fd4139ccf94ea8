"""A robot in memory: the protocol's own bytes, the board's own program, no port and no clock.

Everything runs in the tick of the loop that it serves, so an hour of faults takes seconds on a
virtual clock. The board's torque, not the wanted one, moves the plant.
"""

from collections.abc import Iterable

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.errors import LinkError
from app.device.links import board, line, wire
from app.device.links import board_layout as at
from app.device.links import host_end as host
from app.device.links.board import Faults
from app.device.links.board_layout import new_board
from app.device.links.link import BoardInfo, DeviceLink, Link, LinkStatus
from app.device.links.protocols import Speech, speech_of
from app.mechanisms.profile import DeviceProfile

_BOX = host.SIZE
_WANTED = _BOX + board.SIZE
_CHANNELS = 4
_PULLED = _WANTED + 2  # what four winches were asked: tensions, speeds, whether they hold
_SIZE = _PULLED + 2 * _CHANNELS + 1


@stage
def _clock(state: FloatArray, p: FloatArray) -> None:
    """Say what time it is; what the board has answered lies in `incoming` already."""
    p[wire.NOW] = state[sv.TIME]
    if p[host.HEARD] == 0.0:  # the silence begins with the first tick
        p[host.HEARD] = p[wire.NOW]


@stage
def _carry(state: FloatArray, p: FloatArray) -> None:
    """Bytes to the board and back; TORQUE_* becomes the board's torque, for the plant."""
    end, box = p[:_BOX], p[_BOX:_WANTED]
    now = state[sv.TIME]
    if end[wire.OUT_COUNT] > 0.0:
        wire.note_sent(end, now)
    box[at.Q], box[at.Q + 1] = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    for k in range(_CHANNELS):
        box[at.CABLE + k] = state[sv.PLANT_CABLE_1 + k]
        box[at.REEL + k] = state[sv.PLANT_REEL_1 + k]
    box[at.GAUGE_READING] = np.sqrt(
        state[sv.PULL_X] ** 2 + state[sv.PULL_Y] ** 2 + state[sv.PULL_Z] ** 2
    )
    end[wire.IN_COUNT] = board.exchange(
        box,
        now,
        wire.outgoing(end),
        int(end[wire.OUT_COUNT]),
        wire.incoming(end),
        int(end[wire.IN_COUNT]),
    )
    end[wire.OUT_COUNT] = 0.0
    p[_WANTED], p[_WANTED + 1] = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = box[at.TORQUE], box[at.TORQUE + 1]
    for k in range(_CHANNELS):
        p[_PULLED + k] = state[sv.TENSION_1 + k]
        p[_PULLED + _CHANNELS + k] = state[sv.REEL_RATE_1 + k]
    p[_PULLED + 2 * _CHANNELS] = state[sv.HOLDING]
    board.winches(state, box)


@stage
def _restore(state: FloatArray, p: FloatArray) -> None:
    """Put the torques that were sent back into TORQUE_*, for who reads the state."""
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = p[_WANTED], p[_WANTED + 1]
    for k in range(_CHANNELS):
        state[sv.TENSION_1 + k] = p[_PULLED + k]
        state[sv.REEL_RATE_1 + k] = p[_PULLED + _CHANNELS + k]
    state[sv.HOLDING] = p[_PULLED + 2 * _CHANNELS]


class MemoryLink(DeviceLink):
    """A board of a profile in memory, with stages of a plant behind it.

    Args:
        profile: protocol and numbers of the robot.
        plant: stages that read TORQUE_* and write PLANT_*.
        start: joint angles where the board is switched on [rad]: its counters begin there.
        homed: whether the board was homed before, at the profile's home offsets.
        seed: of the wire's faults.
    """

    def __init__(
        self,
        profile: DeviceProfile,
        plant: Iterable[Stage] = (),
        start: tuple[float, float] | None = None,
        homed: bool = True,
        seed: int = 1,
    ) -> None:
        self.profile = profile
        self._speech: Speech = speech_of(profile)
        self._plant = tuple(plant)
        self._array = np.zeros(_SIZE)
        self._end = self._array[:_BOX]
        self._box = self._array[_BOX:_WANTED]
        self._homed = homed
        self._start = start or profile.encoder.home_offsets
        self._box[: at.SIZE] = new_board(profile, serial="MEMORY", boot=0)
        self._box[board.DOWN : board.UP] = line.line(seed)
        self._box[board.UP :] = line.line(seed + 1)
        self._end[host.STATUS] = LinkStatus.CLOSED
        self.faults = Faults(self._box)

    @property
    def torque(self) -> tuple[float, float]:
        """Torques of the board's motors now [N·m]: left, right."""
        return float(self._box[at.TORQUE]), float(self._box[at.TORQUE + 1])

    @property
    def largest_torque(self) -> float:
        """Largest torque that its motors have had since power-up [N·m]."""
        return float(self._box[at.LARGEST])

    def open(self) -> None:
        """Greet the board in memory.

        Raises:
            LinkError: if it does not answer, or speaks another version.
        """
        self._box[at.Q : at.Q + 2] = self._start
        self._say(b"")  # power-up
        if self._homed:
            self._box[at.ZERO : at.ZERO + 2] = self.profile.encoder.home_offsets
            self._box[at.HOMED] = 1.0
        self._info = self._speech.greet(self._say)
        self._speech.fill(self._end)
        self._speech.greeted(self._end, self._info)
        if self._homed:
            self._box[at.ZERO : at.ZERO + 2] = self.profile.encoder.home_offsets
            self._end[host.HOME_WANTED] = self._end[host.HOME_SENT] = 1.0
        self._end[host.HEARD] = 0.0
        self._end[host.STATUS] = LinkStatus.FINE

    def close(self) -> None:
        """Leave the board alone."""
        self._end[host.STATUS] = LinkStatus.CLOSED

    def home(self) -> None:
        """Ask the board to take the present joint angles as its home."""
        self._end[host.HOME_WANTED] += 1.0

    def stages(self) -> Link:
        """Stages of the tick; plant included."""
        read, write = self._speech.stages
        return Link.of(
            [Stage("wire", _clock, self._end), Stage(f"{self._speech.name} read", read, self._end)],
            [
                Stage(f"{self._speech.name} write", write, self._end),
                Stage("board", _carry, self._array),
                *self._plant,
                Stage("wanted torques", _restore, self._array),
            ],
        )

    def info(self) -> BoardInfo:
        """Return what the board said when it was greeted.

        Raises:
            LinkError: before `open`.
        """
        if not hasattr(self, "_info"):
            raise LinkError(sentence("the link has not been opened yet; call open() first"))
        return self._info

    def _say(self, data: bytes) -> bytes:
        sent = np.zeros(max(len(data), 1), np.uint8)
        sent[: len(data)] = np.frombuffer(data, np.uint8)
        answer = np.zeros(wire.IN_BYTES, np.uint8)
        now = float(self._box[at.LAST])
        count = board.exchange(self._box, now, sent, len(data), answer, 0)
        return answer[:count].tobytes()
