"""The wizard's pages in words: what each step is for and what it takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from app.device.commissioning.results import Step
from app.views.exercise.status_items import Verdict
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench

ORDER: Final = (
    Step.HOMING, Step.SIGNS, Step.FORCE, Step.LATENCY, Step.FRICTION, Step.GAUGE,
)  # fmt: skip
NEEDED: Final = (Step.HOMING, Step.SIGNS)
"""Without these the robot gives no force in this power cycle; the others may wait."""

_SAME: Final = {Step.HOMING: (Step.HOMING, Step.OFFSETS)}


@dataclass(frozen=True, slots=True)
class StepWords:
    """One page: its title, what it is for, and what must lie ready."""

    title: str
    purpose: str
    ready: str


def step_words(step: Step) -> StepWords:
    """Words of a step."""
    return {
        Step.HOMING: StepWords(
            tr("Homing"),
            tr("The encoders only count. Bringing both links to a known pose tells the program "
               "where they stand. Needed each time the robot was switched on."),
            tr("The robot gives no force in this step."),
        ),
        Step.OFFSETS: StepWords(
            tr("Encoder offsets"),
            tr("Finds the encoders' zero with the needle in a jig instead of at the stops."),
            tr("The robot gives no force in this step."),
        ),
        Step.SIGNS: StepWords(
            tr("Sign check"),
            tr("Finds out whether each encoder counts the right way and each motor pushes the "
               "right joint the right way. A robot with a wrong sign runs away instead of "
               "guiding. Needed each time the robot was switched on."),
            tr("Blunt needle. One hand at the switch of the motor supply. Small pulses."),
        ),
        Step.FORCE: StepWords(
            tr("Force scale"),
            tr("Finds out whether a commanded newton is a newton. Until it is measured on this "
               "device, forces stay below 1 N."),
            tr("A kitchen scale that shows grams. The robot pushes with 0.2, 0.5 and 0.9 N."),
        ),
        Step.LATENCY: StepWords(
            tr("Latency"),
            tr("Measures the round trip of the wire and the time from a torque to the motion. "
               "Stiffness that is stable depends on it."),
            tr("Hands off the needle. Small pulses."),
        ),
        Step.FRICTION: StepWords(
            tr("Friction"),
            tr("Measures the torque at which each joint begins to move, and its friction in "
               "motion, so that it can be compensated."),
            tr("Hands off the needle. Slow movements."),
        ),
        Step.GAUGE: StepWords(
            tr("Force gauge"),
            tr("Calibrates the board's own gauge by weights, so that the force is measured "
               "instead of estimated."),
            tr("Two or more known weights and a thread."),
        ),
    }[step]  # fmt: skip


def steps_of(bench: Bench) -> tuple[Step, ...]:
    """Return the steps that this robot needs: a gauge is calibrated only where there is one."""
    return tuple(s for s in ORDER if s is not Step.GAUGE or bench.info.gauge)


def state_of(bench: Bench, step: Step) -> tuple[Verdict, str, str]:
    """Verdict, when and what was found, of a step on this robot."""
    entry = bench.record.newest(*_SAME.get(step, (step,)))
    if entry is None:
        needed = Verdict.BAD if step in NEEDED else Verdict.IDLE
        return needed, tr("not done yet"), ""
    when, found = entry.date[:16].replace("T", " "), entry.result.summary()
    if step in NEEDED and not bench.done(*_SAME.get(step, (step,))):
        return Verdict.BAD, tr("{when}, before it was switched on anew", when=when), found
    return Verdict.GOOD, when, found


def connection_lines(bench: Bench) -> tuple[tuple[str, str], ...]:
    """Who is at the other end, line by line."""
    info = bench.info
    return (
        (tr("Profile"), bench.profile.name),
        (tr("Robot"), tr("simulated, to practise") if info.simulated else tr("real")),
        (tr("Board"), info.serial or tr("no serial number")),
        (tr("Firmware"), info.firmware or "–"),
        (tr("Protocol"), info.protocol or "–"),
        (tr("Power cycle"), str(info.boot) if info.boot else tr("not numbered")),
    )


def clearance_words(bench: Bench) -> tuple[Verdict, str]:
    """How much force the robot is cleared for, and why it is not more."""
    clearance = bench.clearance()
    if not clearance.reason:
        return Verdict.GOOD, tr("cleared for {n:g} N at the hand", n=clearance.force_cap)
    verdict = Verdict.WARNING if clearance.force_cap > 0.0 else Verdict.BAD
    return verdict, clearance.reason
