"""Wire and loop in words, for the technician. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, isfinite

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.links.board_error import describe_error
from app.device.links.link import LinkStatus
from app.device.wire_watch import WINDOW, WireFigures
from app.session.snapshot import Snapshot
from app.views.exercise.run import ExerciseRun
from app.views.exercise.status_items import (
    LoopFigures,
    StatusItem,
    Verdict,
    encoder_item,
    loop_item,
)
from app.views.kit.text import tr

NONE = "–"


@dataclass(frozen=True, slots=True)
class Rates:
    """What is measured over several looks.

    Attributes:
        loop: ticks a second [Hz].
        missing: share of deadlines missed of late, 0…1.
        wire: the link's counters over the last seconds; None for no robot.
    """

    loop: float
    missing: float
    wire: WireFigures | None


def wire_items(
    run: ExerciseRun, row: FloatArray, wire: WireFigures | None
) -> tuple[StatusItem, ...]:
    """Health of the link."""
    status = link_item(int(row[sv.LINK_STATUS]), run.is_real)
    error = int(row[sv.BOARD_ERROR])
    board = StatusItem(
        Verdict.BAD if error else Verdict.GOOD, tr("Board's error"),
        tr("{words} (code {code})", words=describe_error(error), code=error) if error else
        tr("none"),
        tr("Error that the board reports; docs/protocol.md lists the codes."),
    )  # fmt: skip
    if wire is None or (not run.is_real and wire.replies == 0.0):
        return (status, board)
    trip = NONE
    if wire.median is not None and wire.p99 is not None:
        trip = tr("{median:.2f} / {p99:.2f} ms", median=1e3 * wire.median, p99=1e3 * wire.p99)
    trips = StatusItem(
        Verdict.IDLE if wire.median is None else Verdict.GOOD, tr("Round trip"), trip,
        tr("From command to answer, median / 99th percentile of the last {s:.0f} s.", s=WINDOW),
    )  # fmt: skip
    troubled = wire.errors > 0.0 or wire.lost > 0.0
    counts = StatusItem(
        Verdict.WARNING if troubled else Verdict.GOOD, tr("Answers"),
        tr("{replies:.0f}/s · {errors:.1f}/s broken · {lost:.1f}/s lost",
           replies=wire.replies, errors=wire.errors, lost=wire.lost),
        tr("Answers of the board, frames with a wrong checksum, and commands without an answer, "
           "over the last {s:.0f} s; since the start {replies}, {errors}, {lost}. Broken frames: "
           "a shorter cable, away from motor leads, a ferrite.", s=WINDOW,
           replies=int(row[sv.LINK_REPLIES]), errors=int(row[sv.LINK_ERRORS]),
           lost=int(row[sv.LINK_LOST])),
    )  # fmt: skip
    return (status, trips, counts, board)


def link_item(status: int, real: bool) -> StatusItem:
    """Say how the link is."""
    words = {
        LinkStatus.FINE: (Verdict.GOOD, tr("connected") if real else tr("in memory"), ""),
        LinkStatus.CONNECTING: (Verdict.WARNING, tr("connecting"), tr("Wait a moment.")),
        LinkStatus.SILENT: (Verdict.BAD, tr("no answer"), tr(
            "Check cable and power; the robot is looked for again by itself.")),
        LinkStatus.CLOSED: (Verdict.BAD, tr("closed"), tr(
            "The port is gone: plug the cable in, or choose the robot anew.")),
        LinkStatus.WRONG_VERSION: (Verdict.BAD, tr("wrong protocol version"), tr(
            "The board speaks another version; load the firmware that fits (docs/protocol.md).")),
    }  # fmt: skip
    unknown = (Verdict.BAD, tr("status {code}", code=status), "")
    known = status in set(LinkStatus)
    verdict, text, todo = words[LinkStatus(status)] if known else unknown
    return StatusItem(verdict, tr("Link"), text, todo or tr("How the wire to the robot is."))


def loop_items(run: ExerciseRun, snapshot: Snapshot, rates: Rates) -> tuple[StatusItem, ...]:
    """How the loop keeps its time, and how old its angles are."""
    items = []
    timing, device = snapshot.timing, snapshot.device
    if timing is not None:
        figures = LoopFigures(rates.loop, timing.median, timing.p99, rates.missing,
                              timing.missed, timing.ticks)  # fmt: skip
        items.append(loop_item(figures))
    items.append(encoder_item(snapshot.pose.orientation_age))
    if device is not None and all(isfinite(angle) for angle in device.q):
        left, right = (degrees(angle) for angle in device.q)
        angles = tr("left {left:.1f}°, right {right:.1f}°", left=left, right=right)
        items.append(StatusItem(Verdict.IDLE, tr("Joints"), angles, tr("Joint angles now.")))
    if run.velocity:
        items.append(StatusItem(Verdict.IDLE, tr("Velocity by"), run.velocity, tr(
            "How joint velocities are estimated; `acus study velocity` compares the ways."
        )))  # fmt: skip
    return tuple(items)
