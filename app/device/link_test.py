"""How good is a wire: round trips, losses and errors at the profile's rate, with zero torque."""

import time
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control import Loop, Table
from app.device.errors import LinkError
from app.device.links.link import describe_error
from app.device.links.serial_link import SerialLink
from app.mechanisms.profile import DeviceProfile

WAIT_SHARE = 0.8
"""Share of a tick for which the test waits for the answer to the command it has just sent."""

_SETTLE = 0.2
_MINIMUM = 10


@dataclass(frozen=True, slots=True)
class LinkResult:
    """What a test of a wire has shown; times in milliseconds.

    `round_trip_*` are those of answers that came within the tick; `late` counts the others.
    """

    port: str
    profile: str
    board: str
    rate_hz: float
    seconds: float
    commands: int
    replies: int
    lost: int
    errors: int
    late: int
    missed_deadlines: int
    board_error: str
    round_trip_p50_ms: float
    round_trip_p90_ms: float
    round_trip_p99_ms: float
    round_trip_max_ms: float

    def document(self) -> dict[str, Any]:
        """Return it JSON-ready."""
        return asdict(self)

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
        ]


def measure_link(port: str, profile: DeviceProfile, seconds: float) -> LinkResult:
    """Send zero torques at the profile's rate and wait for each answer within the tick.

    Raises:
        LinkError: if the robot cannot be reached, or answers so rarely that nothing can be said.
    """
    link = SerialLink(port, profile)
    # No write side of its own: there is nothing to stop, because no torque was ever wanted.
    table = Table.of(link.test_stages(WAIT_SHARE / profile.rate_hz))
    loop = Loop(table, profile.rate_hz, link=link)
    with loop:
        time.sleep(_SETTLE)
        before = loop.latest().row
        rows = _watch(loop, seconds)
        board = link.info().profile or f"{profile.name} ({link.info().protocol})"
    return _result(port, profile, board, seconds, before, rows, loop.rate_hz)


def _watch(loop: Loop, seconds: float) -> FloatArray:
    kept, since = [], loop.latest().tick
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        time.sleep(min(0.5, max(end - time.monotonic(), 0.0)))
        rows = loop.rows(since)
        if len(rows):
            since = int(rows[-1, sv.TICK])
            kept.append(rows[:, [*_KEPT]])
    return np.concatenate(kept)


_KEPT = (
    sv.LINK_REPLIES,
    sv.ROUND_TRIP,
    sv.LINK_LOST,
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
    rate_hz: float,
) -> LinkResult:
    replies, trip, lost, errors, missed, board_errors = rows.T
    fresh = np.diff(replies, prepend=before[sv.LINK_REPLIES]) > 0
    trips = trip[fresh] * 1e3
    in_time = trips < 1e3 / rate_hz
    if np.count_nonzero(in_time) < _MINIMUM:
        raise LinkError(
            f"only {np.count_nonzero(in_time)} answers of the robot on {port} came within a tick of"
            f" {1e3 / rate_hz:g} ms; lower loop.rate_hz in the profile or use a faster port"
        )
    p50, p90, p99, largest = np.percentile(trips, (50, 90, 99, 100))
    return LinkResult(
        port=port,
        profile=profile.name,
        board=board,
        rate_hz=rate_hz,
        seconds=seconds,
        commands=len(rows),
        replies=int(replies[-1] - before[sv.LINK_REPLIES]),
        lost=int(lost[-1] - before[sv.LINK_LOST]),
        errors=int(errors[-1] - before[sv.LINK_ERRORS]),
        late=int(np.count_nonzero(~in_time)),
        missed_deadlines=int(missed[-1] - before[sv.MISSED]),
        board_error=describe_error(int(board_errors[-1])) if board_errors[-1] else "",
        round_trip_p50_ms=float(p50),
        round_trip_p90_ms=float(p90),
        round_trip_p99_ms=float(p99),
        round_trip_max_ms=float(largest),
    )
