"""What the enabling switch says: whether there is force, and what to do. Pure."""

from dataclasses import dataclass

from app.core import state_vector as sv
from app.session.machine import RUNNING, State
from app.session.snapshot import Snapshot
from app.views.exercise.readings import fault_text
from app.views.exercise.status_items import Verdict
from app.views.kit.text import tr


@dataclass(frozen=True, slots=True)
class Enabling:
    """How the forces are armed now.

    Attributes:
        running: whether an attempt runs; without one there is nothing to arm.
        held: whether key, pedal or button is held.
        ramp: arming ramp, 0 off … 1 fully on.
        fault: what holds the force at zero, in words; empty if nothing does.
        ready: whether an attempt can begin on this robot: it is homed, its signs are checked.
    """

    running: bool
    held: bool
    ramp: float
    fault: str = ""
    ready: bool = True


def enabling(snapshot: Snapshot, held: bool) -> Enabling:
    """How a snapshot says that the forces are armed."""
    device = snapshot.device
    ramp = float(device.row[sv.ARMING]) if device is not None else 0.0
    fault = fault_text(int(device.fault)) if device is not None else ""
    clearance = snapshot.clearance
    ready = clearance is None or clearance.homed > 0.5
    running = snapshot.state in RUNNING and snapshot.state is not State.WITHDRAWING
    return Enabling(running, held, min(1.0, max(0.0, ramp)), fault, ready)


def enable_words(now: Enabling, key: str) -> tuple[Verdict, str, str]:
    """Verdict, the state in a few words, and what to do; `key` is the key's name."""
    if not now.running and not now.ready:
        return Verdict.BAD, tr("✖ robot not ready"), tr("why, and what to do: Robot's health (F8)")
    if not now.running:
        return Verdict.IDLE, tr("– forces off"), tr("start the attempt first")
    if now.fault:
        todo = tr("let go of {key}", key=key) if now.held else tr("hold {key} again", key=key)
        return Verdict.BAD, tr("✖ no force: {todo}", todo=todo), now.fault
    if not now.held:
        return Verdict.IDLE, tr("○ forces off"), hold(key)
    if now.ramp < 1.0:
        percent = tr("◐ switching on {percent:.0f} %", percent=100 * now.ramp)
        return Verdict.WARNING, percent, tr("keep holding {key}", key=key)
    return Verdict.GOOD, tr("● FORCES ON"), tr("let go of {key}: forces off", key=key)


def hold(key: str) -> str:
    """Say how to switch on."""
    return tr("hold {key}, pedal or this button to switch on", key=key)
