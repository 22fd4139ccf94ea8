"""How good is a wire: round trips, losses and errors at the profile's rate, with zero torque."""

import time
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.device.control import Loop, Table
from app.device.errors import LinkError, LoopError
from app.device.links.inverse3 import robot_link
from app.device.links.link import describe_error
from app.device.links.serial_link import SILENCE, SerialLink
from app.mechanisms.profile import DeviceProfile

WAIT_SHARE = 0.8
"""Share of a tick for which the test waits for the answer to the command it has just sent."""

_SETTLE = 0.2
_ARRIVES = 0.1  # [s] that a last answer is waited for
_MINIMUM = 10


@dataclass(frozen=True, slots=True)
class LinkResult:
    """What a test of a wire has shown; times in milliseconds.

    `round_trip_*` are those of answers that came within the tick; `late` counts the others. Every
    command was answered or is `lost`: replies + lost = commands. `last_answer` is how long after
    the beginning the last answer came [s].
    """

    port: str
    profile: str
    board: str
    rate_hz: float
    seconds: float
    commands: int
    replies: int
    lost: int
    last_answer: float
    errors: int
    late: int
    missed_deadlines: int
    board_error: str
    round_trip_p50_ms: float
    round_trip_p90_ms: float
    round_trip_p99_ms: float
    round_trip_max_ms: float

    @property
    def good(self) -> bool:
        """Return whether every command was answered."""
        return self.lost == 0

    @property
    def verdict(self) -> str:
        """One sentence: whether the wire is good, else what was wrong and what to do."""
        if self.good:
            return sentence("the wire is good")
        unanswered = sentence(
            "{lost} of {commands} commands were never answered",
            lost=self.lost,
            commands=self.commands,
        )
        if self.seconds - self.last_answer > SILENCE:
            return sentence(
                "the board fell silent {last_answer:.2f} s after the beginning: {unanswered};"
                " check its power, its cable and its program, then test again",
                last_answer=self.last_answer,
                unanswered=unanswered,
            )
        return sentence(
            "{unanswered}: check the cable and its plugs, and what else this computer has to do,"
            " then test again",
            unanswered=unanswered,
        )

    def document(self) -> dict[str, Any]:
        """Return it JSON-ready."""
        return asdict(self) | {"good": self.good, "verdict": self.verdict}

    def lines(self) -> list[tuple[str, str]]:
        """Return it for people: label and value."""
        trip = (
            f"p50 {self.round_trip_p50_ms:.3f}   p90 {self.round_trip_p90_ms:.3f}   "
            f"p99 {self.round_trip_p99_ms:.3f}   max {self.round_trip_max_ms:.3f} ms"
        )
        return [
            ("robot", f"{self.board} on {self.port}"),
            ("rate", f"{self.rate_hz:g} Hz for {self.seconds:g} s"),
            ("round trip", trip),
            ("commands", str(self.commands)),
            ("replies", str(self.replies)),
            ("lost", str(self.lost)),
            ("damaged", str(self.errors)),
            ("answered a tick late", str(self.late)),
            ("own deadlines missed", str(self.missed_deadlines)),
            ("board's own error", self.board_error or "none"),
            ("verdict", self.verdict),
        ]


def measure_link(port: str, profile: DeviceProfile, seconds: float) -> LinkResult:
    """Send zero torques at the profile's rate and wait for each answer within the tick.

    Commands and answers are counted from one moment without a command under way to another.

    Raises:
        LinkError: if the robot cannot be reached, or answers so rarely that nothing can be said.
    """
    link = robot_link(port, profile)
    # No write side of its own: there is nothing to stop, because no torque was ever wanted.
    table = Table.of(link.test_stages(WAIT_SHARE / profile.rate_hz))
    loop = Loop(table, profile.rate_hz, link=link)
    with loop:
        time.sleep(_SETTLE)
        _rest(link)
        before, sent = loop.latest().row, link.commands
        link.rest(False)
        rows = _watch(loop, seconds, link)
        board = link.info().profile or f"{profile.name} ({link.info().protocol})"
        sent = link.commands - sent
    return _result(port, profile, board, seconds, before, rows, sent, loop.rate_hz)


def _rest(link: SerialLink) -> None:
    """Send nothing, and let the last answer arrive."""
    link.rest(True)
    time.sleep(_ARRIVES)


def _watch(loop: Loop, seconds: float, link: SerialLink) -> FloatArray:
    """Return the ticks of a test, shape (n, `_KEPT`); no command is under way at its end."""
    kept, since = [], loop.latest().tick
    end = time.monotonic() + seconds
    ended = False
    while not ended:
        time.sleep(min(0.5, max(end - time.monotonic(), 0.0)))
        ended = time.monotonic() >= end
        if ended:
            _rest(link)
        rows = loop.rows(since)
        if len(rows):
            since = int(rows[-1, sv.TICK])
            kept.append(rows[:, [*_KEPT]])
    if not kept:
        raise LoopError(sentence("the loop did not run: this computer is too busy to test a wire"))
    return np.concatenate(kept)


_KEPT = (
    sv.TIME,
    sv.LINK_REPLIES,
    sv.ROUND_TRIP,
    sv.LINK_ERRORS,
    sv.MISSED,
    sv.BOARD_ERROR,
)


def _result(
    port: str,
    profile: DeviceProfile,
    board: str,
    seconds: float,
    before: FloatArray,
    rows: FloatArray,
    commands: int,
    rate_hz: float,
) -> LinkResult:
    moments, replies, trip, errors, missed, board_errors = rows.T
    fresh = np.diff(replies, prepend=before[sv.LINK_REPLIES]) > 0
    trips = trip[fresh] * 1e3
    in_time = trips < 1e3 / rate_hz
    answered = int(replies[-1] - before[sv.LINK_REPLIES])
    if np.count_nonzero(in_time) < _MINIMUM and answered == commands:
        raise LinkError(
            sentence(
                "only {count_nonzero} answers of the robot on {port} came within a tick of"
                " {rate_hz:g} ms; lower loop.rate_hz in the profile or use a faster port",
                count_nonzero=np.count_nonzero(in_time),
                port=port,
                rate_hz=1e3 / rate_hz,
            )
        )
    if not len(trips):
        raise LinkError(
            sentence(
                "the robot on {port} was greeted, but answers no command; see its firmware",
                port=port,
            )
        )
    p50, p90, p99, largest = np.percentile(trips, (50, 90, 99, 100))
    return LinkResult(
        port=port,
        profile=profile.name,
        board=board,
        rate_hz=rate_hz,
        seconds=seconds,
        commands=commands,
        replies=answered,
        lost=commands - answered,
        last_answer=float(moments[fresh][-1] - before[sv.TIME]),
        errors=int(errors[-1] - before[sv.LINK_ERRORS]),
        late=int(np.count_nonzero(~in_time)),
        missed_deadlines=int(missed[-1] - before[sv.MISSED]),
        board_error=describe_error(int(board_errors[-1])) if board_errors[-1] else "",
        round_trip_p50_ms=float(p50),
        round_trip_p90_ms=float(p90),
        round_trip_p99_ms=float(p99),
        round_trip_max_ms=float(largest),
    )
