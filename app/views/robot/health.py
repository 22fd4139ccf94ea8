"""The robot's health in words, group by group, for the technician. Pure."""

from __future__ import annotations

from dataclasses import dataclass

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.device.readiness import SCALE_TOLERANCE
from app.mechanisms.profile import DeviceProfile
from app.session.snapshot import Snapshot
from app.views.exercise.energy import energy_figures, gauge_help, guard_words, millijoules
from app.views.exercise.felt import force_limit, origin_help, origin_word
from app.views.exercise.readings import fault_text
from app.views.exercise.run import ExerciseRun
from app.views.exercise.status_items import StatusItem, Verdict
from app.views.kit.text import tr
from app.views.robot.health_wire import NONE, Rates, loop_items, wire_items


@dataclass(frozen=True, slots=True)
class HealthGroup:
    """Lines that belong together."""

    title: str
    items: tuple[StatusItem, ...]


def health(run: ExerciseRun, snapshot: Snapshot, rates: Rates) -> tuple[HealthGroup, ...]:
    """Everything a technician asks, most urgent first."""
    device = snapshot.device
    if device is None:
        nothing = StatusItem(Verdict.BAD, tr("Robot"), tr("says nothing"), tr(
            "The loop has not ticked yet. Wait a moment; if it stays so, start the exercise again."
        ))  # fmt: skip
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
    """Whether there is force, and what holds it back."""
    device = snapshot.device
    row = device.row if device is not None else sv.empty_state()
    fault = fault_text(int(device.fault)) if device is not None else ""
    fault_line = StatusItem(
        Verdict.BAD if fault else Verdict.GOOD, tr("Fault"), fault or tr("none"),
        tr("While there is a fault the robot gives no force. Its message says what to do."),
    )  # fmt: skip
    percent = tr("{percent:.0f} %", percent=100 * row[sv.ARMING])
    armed = StatusItem(
        Verdict.GOOD if snapshot.armed else Verdict.IDLE, tr("Armed"),
        percent if snapshot.armed else tr("off"),
        tr("The force rises from 0 to 100 % within a second after arming, and is off at once."),
    )  # fmt: skip
    return (
        fault_line, armed, cap_item(run, snapshot), governor_item(row), let_go_item(run.profile),
        depth_item(run, row),
        *energy_items(snapshot),
    )  # fmt: skip


def cap_item(run: ExerciseRun, snapshot: Snapshot) -> StatusItem:
    """Say the present limit of the force, and why it is not more."""
    limit = force_limit(snapshot, run.profile.limits.hand_force)
    clearance = snapshot.clearance or run.clearance
    reason = clearance.reason if clearance is not None else ""
    if not reason:
        return StatusItem(Verdict.GOOD, tr("Force limit"), tr("{n:g} N", n=limit), tr(
            "Largest force at the hand: the device's own limit, nothing holds it lower."
        ))  # fmt: skip
    held = clearance.force_cap if clearance is not None else limit
    return StatusItem(
        Verdict.WARNING if held > 0.0 else Verdict.BAD, tr("Force limit"), tr("{n:g} N", n=held),
        reason,
    )  # fmt: skip


def governor_item(row: FloatArray) -> StatusItem:
    """Say what the speed governor leaves of the force."""
    scale = float(row[sv.LET_GO_SCALE])
    calm = not scale < 1.0
    known = scale > 0.0 or row[sv.ARMING] > 0.0
    text = tr("at rest") if calm else tr("force at {percent:.0f} %", percent=100 * scale)
    return StatusItem(
        Verdict.IDLE if not known else Verdict.GOOD if calm else Verdict.WARNING,
        tr("Speed governor"), text if known else NONE,
        tr("Weakens the force when the needle moves faster than a hand would move it, and ends it "
           "when the needle has been let go."),
    )  # fmt: skip


def let_go_item(profile: DeviceProfile) -> StatusItem:
    """Say how far the robot's own forces may drive a needle that is let go."""
    limit, stated = profile.let_go, profile.limits.let_go is not None
    text = tr("{v:g} m/s, {e:g} mJ", v=limit.speed, e=limit.energy_mj)
    return StatusItem(
        Verdict.GOOD if stated else Verdict.WARNING,
        tr("Limit when let go"), text if stated else tr("{limit} (by default)", limit=text),
        tr("What the robot's forces may at most give a needle that is let go. ") + (
            tr("It stands in the profile of the robot.") if stated else
            tr("The robot's profile states none (limits.let_go), so it is held to 0.25 m/s.")
        ),
    )  # fmt: skip


def depth_item(run: ExerciseRun, row: FloatArray) -> StatusItem:
    """Say between which depths the tip is, and what no picture can tell of it."""
    least, most = float(row[sv.DEPTH_LEAST]), float(row[sv.DEPTH_MOST])
    low, high = run.profile.depth_range
    whole = not most - least < 0.9 * (high - low)
    shortest = run.profile.geometry.needle_length - max(most, least)
    share = 100.0 * MILLIMETRE / max(shortest, MILLIMETRE)
    return StatusItem(
        Verdict.WARNING if whole else Verdict.GOOD, tr("Depth is between"),
        tr("{low:.0f} and {high:.0f} mm", low=least / MILLIMETRE, high=most / MILLIMETRE),
        tr("Force and let-go are limited for every depth in it. An error that is the same in every "
           "picture (a needle of another length, a band that has slipped, cameras that were moved) "
           "cannot be seen: each millimetre of it makes the force wrong by up to {share:.1f} % "
           "here. Measure needle and band with calipers.", share=share),
    )  # fmt: skip


def energy_items(snapshot: Snapshot) -> tuple[StatusItem, ...]:
    """Say what the force laws store, and what the guard does."""
    figures = energy_figures(snapshot)
    verdict, words = guard_words(figures)
    guard = StatusItem(verdict, tr("Passivity guard"), words, gauge_help())
    if figures is None or not figures.known:
        return (guard,)
    text = tr(
        "{stored} stored, {tank} of {bound} left, {loss} taken out",
        stored=millijoules(figures.stored), tank=millijoules(figures.tank),
        bound=millijoules(figures.bound), loss=millijoules(figures.loss),
    )  # fmt: skip
    return (guard, StatusItem(Verdict.IDLE, tr("Energy"), text, gauge_help()))


def device_items(run: ExerciseRun) -> tuple[StatusItem, ...]:
    """Who is at the other end."""
    board = run.board
    kind = tr("real, {port}", port=run.port or "?") if run.is_real else tr("simulated")
    where = StatusItem(Verdict.GOOD, tr("Robot"), f"{run.profile.name}, {kind}", tr(
        "Device profile, and whether there is a robot of metal. Choose it in the menu Robot."
    ))  # fmt: skip
    if board is None:
        return (where,)
    facts = (
        (tr("Board"), board.serial or tr("no serial number"),
         tr("Serial number of the board; calibrations are kept by it.")),
        (tr("Firmware"), tr("{version}, protocol {protocol}", version=board.firmware or NONE,
                            protocol=board.protocol or NONE),
         tr("Program on the board and the version of the wire protocol that it speaks.")),
        (tr("Power cycle"), str(board.boot) if board.boot else tr("not numbered"),
         tr("How often the board was switched on. Homing and sign check count for one power "
            "cycle only.")),
    )  # fmt: skip
    return (where, *(StatusItem(Verdict.IDLE, *fact) for fact in facts), gauge_item(run))


def gauge_item(run: ExerciseRun) -> StatusItem:
    """Say whether the force is measured or estimated on this robot."""
    measured = run.board is not None and run.board.gauge
    text = tr("force is {origin}", origin=origin_word(measured))
    return StatusItem(Verdict.GOOD if measured else Verdict.IDLE, tr("Force gauge"), text,
                      origin_help(measured))  # fmt: skip


def readiness_items(run: ExerciseRun) -> tuple[StatusItem, ...]:
    """Say what was commissioned, and when."""
    if not run.is_real:
        return (StatusItem(Verdict.IDLE, tr("Simulated"), tr("nothing to commission"), tr(
            "A simulated robot is homed, its signs are right and its forces are true."
        )),)  # fmt: skip
    done = run.readiness
    boot = run.board.boot if run.board is not None else 0
    homed = done is not None and boot != 0 and done.homed_boot == boot
    signs = done is not None and boot != 0 and done.signs_boot == boot
    todo = tr("Menu Robot, Commissioning; it is needed each time the robot was switched on.")
    return (
        _yes_no(homed, tr("Homed"), todo), _yes_no(signs, tr("Signs checked"), todo),
        scale_item(run),
    )  # fmt: skip


def scale_item(run: ExerciseRun) -> StatusItem:
    """Say whether, when and with which result the force scale was measured."""
    done = run.readiness
    help_text = tr(
        "Whether a commanded newton is a newton on a kitchen scale. Until it is measured on this "
        "device, forces stay below 1 N. Menu Robot, Commissioning."
    )
    if done is None or done.force_factor is None:
        return StatusItem(Verdict.WARNING, tr("Force scale"), tr("never measured"), help_text)
    verified = (
        abs(done.force_factor - 1.0) <= SCALE_TOLERANCE and done.profile == run.profile.name
    )  # fmt: skip
    text = tr("{factor:.3f} on {date}", factor=done.force_factor, date=done.force_date[:10])
    return StatusItem(
        Verdict.GOOD if verified else Verdict.WARNING, tr("Force scale"), text, help_text
    )


def _yes_no(done: bool, title: str, todo: str) -> StatusItem:
    verdict = Verdict.GOOD if done else Verdict.BAD
    text = tr("in this power cycle") if done else tr("not since it was switched on")
    return StatusItem(verdict, title, text, todo)
