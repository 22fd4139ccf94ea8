"""The robot's health in words, group by group, for the technician: robot, wire, loop. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from math import degrees, isfinite

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.device.links.link import LinkStatus, describe_error
from app.device.readiness import SCALE_TOLERANCE
from app.device.wire_watch import WINDOW, WireFigures
from app.mechanisms.profile import DeviceProfile
from app.session.snapshot import Snapshot
from app.views.exercise.energy_gauge import energy_figures, gauge_help, guard_words, millijoules
from app.views.exercise.felt import force_limit, origin_help, origin_word
from app.views.exercise.readings import fault_text
from app.views.exercise.run import ExerciseRun
from app.views.exercise.status_items import LoopFigures, encoder_item, loop_item
from app.views.kit.text import day, tr
from app.views.kit.verdict import StatusItem, Verdict

NONE = "–"


@dataclass(frozen=True, slots=True)
class Rates:
    """What is measured over several polls.

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
        Verdict.BAD if error else Verdict.GOOD,
        tr("Board's error"),
        tr("{words} (code {code})", words=describe_error(error), code=error)
        if error
        else tr("none"),
        tr("Error that the board reports; docs/protocol.md lists the codes."),
    )
    if wire is None or (not run.is_real and wire.replies == 0.0):
        return (status, board)
    trip = NONE
    if wire.median is not None and wire.p99 is not None:
        trip = tr("{median:.2f} / {p99:.2f} ms", median=1e3 * wire.median, p99=1e3 * wire.p99)
    trips = StatusItem(
        Verdict.IDLE if wire.median is None else Verdict.GOOD,
        tr("Round trip"),
        trip,
        tr("From command to answer, median / 99th percentile of the last {s:.0f} s.", s=WINDOW),
    )
    troubled = wire.errors > 0.0 or wire.lost > 0.0
    counts = StatusItem(
        Verdict.WARNING if troubled else Verdict.GOOD,
        tr("Answers"),
        tr(
            "{replies:.0f}/s · {errors:.1f}/s broken · {lost:.1f}/s lost",
            replies=wire.replies,
            errors=wire.errors,
            lost=wire.lost,
        ),
        tr(
            "Answers of the board, frames with a wrong checksum, and commands without an answer, "
            "over the last {s:.0f} s; since the start {replies}, {errors}, {lost}. Broken frames: "
            "a shorter cable, away from motor leads, a ferrite.",
            s=WINDOW,
            replies=int(row[sv.LINK_REPLIES]),
            errors=int(row[sv.LINK_ERRORS]),
            lost=int(row[sv.LINK_LOST]),
        ),
    )
    return (status, trips, counts, board)


def link_item(status: int, real: bool) -> StatusItem:
    """Say how the link is."""
    words = {
        LinkStatus.FINE: (Verdict.GOOD, tr("connected") if real else tr("in memory"), ""),
        LinkStatus.CONNECTING: (Verdict.WARNING, tr("connecting"), tr("Wait a moment.")),
        LinkStatus.SILENT: (
            Verdict.BAD,
            tr("no answer"),
            tr("Check cable and power; the program keeps looking for the robot."),
        ),
        LinkStatus.CLOSED: (
            Verdict.BAD,
            tr("closed"),
            tr("The port is gone: plug the cable in, or choose the robot again."),
        ),
        LinkStatus.WRONG_VERSION: (
            Verdict.BAD,
            tr("wrong protocol version"),
            tr("The board speaks another version; load the firmware that fits (docs/protocol.md)."),
        ),
    }
    unknown = (Verdict.BAD, tr("status {code}", code=status), "")
    known = status in set(LinkStatus)
    verdict, text, todo = words[LinkStatus(status)] if known else unknown
    return StatusItem(verdict, tr("Link"), text, todo or tr("How the wire to the robot is."))


def loop_items(run: ExerciseRun, snapshot: Snapshot, rates: Rates) -> tuple[StatusItem, ...]:
    """Return how the loop keeps its time, and how old its angles are."""
    items = []
    timing, device = snapshot.timing, snapshot.device
    if timing is not None:
        figures = LoopFigures(
            rates.loop, timing.median, timing.p99, rates.missing, timing.missed, timing.ticks
        )
        items.append(loop_item(figures))
    items.append(encoder_item(snapshot.pose.orientation_age))
    if device is not None and all(isfinite(angle) for angle in device.q):
        left, right = (degrees(angle) for angle in device.q)
        angles = tr("left {left:.1f}°, right {right:.1f}°", left=left, right=right)
        items.append(StatusItem(Verdict.IDLE, tr("Joints"), angles, tr("Joint angles now.")))
    if run.velocity:
        items.append(
            StatusItem(
                Verdict.IDLE,
                tr("Velocity by"),
                run.velocity,
                tr("How joint velocities are estimated; `acus study velocity` compares the ways."),
            )
        )
    return tuple(items)


@dataclass(frozen=True, slots=True)
class HealthGroup:
    """Lines that belong together."""

    title: str
    items: tuple[StatusItem, ...]


def health(run: ExerciseRun, snapshot: Snapshot, rates: Rates) -> tuple[HealthGroup, ...]:
    """Everything a technician asks, most urgent first."""
    device = snapshot.device
    if device is None:
        nothing = StatusItem(
            Verdict.BAD,
            tr("Robot"),
            tr("says nothing"),
            tr(
                "The loop has not ticked yet. Wait a moment; if it stays so, start the exercise "
                "again."
            ),
        )
        return (HealthGroup(tr("Robot"), (nothing,)),)
    row = device.row
    return (
        HealthGroup(tr("Force"), force_items(run, snapshot)),
        HealthGroup(tr("Device"), device_items(run)),
        HealthGroup(tr("Wire"), wire_items(run, row, rates.wire)),
        HealthGroup(tr("Loop"), loop_items(run, snapshot, rates)),
        HealthGroup(tr("Commissioning"), readiness_items(run)),
    )


def force_items(run: ExerciseRun, snapshot: Snapshot) -> tuple[StatusItem, ...]:
    """Return whether there is force, and what holds it back."""
    device = snapshot.device
    row = device.row if device is not None else sv.empty_state()
    fault = fault_text(int(device.fault)) if device is not None else ""
    fault_line = StatusItem(
        Verdict.BAD if fault else Verdict.GOOD,
        tr("Fault"),
        fault or tr("none"),
        tr("While there is a fault the robot gives no force. Its message says what to do."),
    )
    percent = tr("{percent:.0f} %", percent=100 * row[sv.ARMING])
    armed = StatusItem(
        Verdict.GOOD if snapshot.armed else Verdict.IDLE,
        tr("Armed"),
        percent if snapshot.armed else tr("off"),
        tr("The force rises from 0 to 100 % within a second after arming, and is off at once."),
    )
    return (
        fault_line,
        armed,
        cap_item(run, snapshot),
        governor_item(row),
        let_go_item(run.profile),
        depth_item(run, row),
        *energy_items(snapshot),
    )


def cap_item(run: ExerciseRun, snapshot: Snapshot) -> StatusItem:
    """Say the present limit of the force, and why it is not more."""
    limit = force_limit(snapshot, run.profile.limits.hand_force)
    clearance = snapshot.clearance or run.clearance
    reason = clearance.reason if clearance is not None else ""
    if not reason:
        return StatusItem(
            Verdict.GOOD,
            tr("Force limit"),
            tr("{n:g} N", n=limit),
            tr("Largest force at the hand: the device's own limit, nothing holds it lower."),
        )
    held = clearance.force_cap if clearance is not None else limit
    return StatusItem(
        Verdict.WARNING if held > 0.0 else Verdict.BAD,
        tr("Force limit"),
        tr("{n:g} N", n=held),
        reason,
    )


def governor_item(row: FloatArray) -> StatusItem:
    """Say what the speed governor leaves of the force."""
    scale = float(row[sv.LET_GO_SCALE])
    calm = not scale < 1.0
    known = scale > 0.0 or row[sv.ARMING] > 0.0
    text = tr("at rest") if calm else tr("force at {percent:.0f} %", percent=100 * scale)
    return StatusItem(
        Verdict.IDLE if not known else Verdict.GOOD if calm else Verdict.WARNING,
        tr("Speed governor"),
        text if known else NONE,
        tr(
            "Weakens the force when the needle moves faster than a hand would move it, and ends it "
            "when the needle has been let go."
        ),
    )


def let_go_item(profile: DeviceProfile) -> StatusItem:
    """Say how far the robot's own forces may drive a needle that is let go."""
    limit, stated = profile.let_go, profile.limits.let_go is not None
    text = tr("{v:g} m/s, {e:g} mJ", v=limit.speed, e=limit.energy_mj)
    return StatusItem(
        Verdict.GOOD if stated else Verdict.WARNING,
        tr("Limit when let go"),
        text if stated else tr("{limit} (by default)", limit=text),
        tr("What the robot's forces may at most give a needle that is let go. ")
        + (
            tr("It is given in the robot's profile.")
            if stated
            else tr("The robot's profile states none (limits.let_go), so it is held to 0.25 m/s.")
        ),
    )


def depth_item(run: ExerciseRun, row: FloatArray) -> StatusItem:
    """Say between which depths the tip is, and what no picture can tell of it."""
    least, most = float(row[sv.DEPTH_LEAST]), float(row[sv.DEPTH_MOST])
    low, high = run.profile.depth_range
    whole = not most - least < 0.9 * (high - low)
    shortest = run.profile.needle_length - max(most, least)
    share = 100.0 * MILLIMETRE / max(shortest, MILLIMETRE)
    return StatusItem(
        Verdict.WARNING if whole else Verdict.GOOD,
        tr("Depth is between"),
        tr("{low:.0f} and {high:.0f} mm", low=least / MILLIMETRE, high=most / MILLIMETRE),
        tr(
            "Force and let-go are limited for every depth in it. An error that is the same in "
            "every picture (a needle of another length, a band that has slipped, cameras that "
            "were moved) cannot be seen: each millimetre of it makes the force wrong by up to "
            "{share:.1f} % here. Measure needle and band with calipers.",
            share=share,
        ),
    )


def energy_items(snapshot: Snapshot) -> tuple[StatusItem, ...]:
    """Say what the force laws store, and what the guard does."""
    figures = energy_figures(snapshot)
    verdict, words = guard_words(figures)
    guard = StatusItem(verdict, tr("Passivity guard"), words, gauge_help())
    if figures is None or not figures.known:
        return (guard,)
    text = tr(
        "{stored} stored, {tank} of {bound} left, {loss} removed",
        stored=millijoules(figures.stored),
        tank=millijoules(figures.tank),
        bound=millijoules(figures.bound),
        loss=millijoules(figures.loss),
    )
    return (guard, StatusItem(Verdict.IDLE, tr("Energy"), text, gauge_help()))


def device_items(run: ExerciseRun) -> tuple[StatusItem, ...]:
    """Return who is at the other end."""
    board = run.board
    kind = tr("real, {port}", port=run.port or "?") if run.is_real else tr("simulated")
    where = StatusItem(
        Verdict.GOOD,
        tr("Robot"),
        f"{run.profile.name}, {kind}",
        tr("Device profile, and whether there is a robot of metal. Choose it in the menu Robot."),
    )
    if board is None:
        return (where,)
    facts = (
        (
            tr("Board"),
            board.serial or tr("no serial number"),
            tr("Serial number of the board; calibrations are kept by it."),
        ),
        (
            tr("Firmware"),
            tr(
                "{version}, protocol {protocol}",
                version=board.firmware or NONE,
                protocol=board.protocol or NONE,
            ),
            tr("Program on the board and the version of the wire protocol that it speaks."),
        ),
        (
            tr("Power cycle"),
            str(board.boot) if board.boot else tr("not numbered"),
            tr(
                "How often the board was switched on. Homing and sign check count for one power "
                "cycle only."
            ),
        ),
    )
    return (where, *(StatusItem(Verdict.IDLE, *fact) for fact in facts), gauge_item(run))


def gauge_item(run: ExerciseRun) -> StatusItem:
    """Say whether the force is measured or estimated on this robot."""
    measured = run.board is not None and run.board.gauge
    text = tr("force is {origin}", origin=origin_word(measured))
    return StatusItem(
        Verdict.GOOD if measured else Verdict.IDLE, tr("Force gauge"), text, origin_help(measured)
    )


def readiness_items(run: ExerciseRun) -> tuple[StatusItem, ...]:
    """Say what was commissioned, and when."""
    if not run.is_real:
        return (
            StatusItem(
                Verdict.IDLE,
                tr("Simulated"),
                tr("nothing to commission"),
                tr("A simulated robot is homed, its signs are right and its forces are true."),
            ),
        )
    done = run.readiness
    boot = run.board.boot if run.board is not None else 0
    homed = done is not None and boot != 0 and done.homed_boot == boot
    signs = done is not None and boot != 0 and done.signs_boot == boot
    todo = tr("Menu Robot, Commissioning; it is needed each time the robot was switched on.")
    return (
        _yes_no(homed, tr("Homed"), todo),
        _yes_no(signs, tr("Signs checked"), todo),
        scale_item(run),
    )


def scale_item(run: ExerciseRun) -> StatusItem:
    """Say whether, when and with which result the force scale was measured."""
    done = run.readiness
    help_text = tr(
        "Whether a commanded newton is a newton on a kitchen scale. Until it is measured on this "
        "device, forces stay below 1 N. Menu Robot, Commissioning."
    )
    if done is None or done.force_factor is None:
        return StatusItem(Verdict.WARNING, tr("Force scale"), tr("never measured"), help_text)
    verified = abs(done.force_factor - 1.0) <= SCALE_TOLERANCE and done.profile == run.profile.name
    text = tr(
        "{factor:.3f} on {date}",
        factor=done.force_factor,
        date=day(datetime.fromisoformat(done.force_date)),
    )
    return StatusItem(
        Verdict.GOOD if verified else Verdict.WARNING, tr("Force scale"), text, help_text
    )


def _yes_no(done: bool, title: str, todo: str) -> StatusItem:
    verdict = Verdict.GOOD if done else Verdict.BAD
    text = tr("in this power cycle") if done else tr("not since it was switched on")
    return StatusItem(verdict, title, text, todo)
