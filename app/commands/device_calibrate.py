"""`acus device calibrate`: commission a real device, typed or scripted."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands.answer import Answer, wants_json

if TYPE_CHECKING:
    from app.commands.answers import Answers
    from app.device.commissioning.bench import Bench
    from app.device.commissioning.report import Report
    from app.device.commissioning.results import AnyResult, Step


class StepName(StrEnum):
    """Routines that can be asked for."""

    HOMING = "homing"
    OFFSETS = "offsets"
    SIGNS = "signs"
    FRICTION = "friction"
    LATENCY = "latency"
    FORCE = "force"
    GAUGE = "gauge"


def calibrate(
    port: Annotated[str, typer.Argument(help="Serial port, e.g. /dev/ttyACM0.")],
    profile: Annotated[str, typer.Option(help="Device profile: a name or a YAML file.")] = "icube",
    step: Annotated[
        list[StepName] | None,
        typer.Option(help="Routine; repeatable. Default: homing, signs, latency, force."),
    ] = None,
    readings: Annotated[
        str, typer.Option(help="Scale readings in grams at 0.2, 0.5 and 0.9 N, e.g. 20.5,51,92.")
    ] = "",
    yes: Annotated[
        bool,
        typer.Option("--yes", help="Confirm everything; signs by pulses only. For scripts."),
    ] = False,
    undo: Annotated[bool, typer.Option("--undo", help="Take the newest result back.")] = False,
) -> Answer:
    """Commission a robot: homing, signs, latency, force scale.

    And its friction, offsets and gauge where asked for (docs/hardware.md).

    Results are kept for the device by its serial number. Ctrl-C ends at zero torque at any time.
    """
    from app.commands.answers import Answers, numbers
    from app.device.commissioning.bench import Bench
    from app.device.commissioning.results import Step
    from app.device.links.serial_link import SerialLink
    from app.mechanisms.profile import load_profile

    chosen = load_profile(profile)
    steps = [Step(name.value) for name in step or ()] or [
        Step.HOMING,
        Step.SIGNS,
        Step.LATENCY,
        Step.FORCE,
    ]
    answers = Answers(yes, numbers(readings, "--readings", 3) if readings else ())
    with Bench(SerialLink(port, chosen), chosen) as bench:
        _wait_for_the_robot(bench)
        if undo:
            bench.undo(*(steps if step else ()))
        results = [] if undo else [_run(bench, one, answers, yes) for one in steps]
        return _answer(bench, results)


def _run(bench: Bench, step: Step, answers: Answers, yes: bool) -> AnyResult:
    """Run one routine to its end and keep what it found; a check that fails takes back its own."""
    from app.device.commissioning.errors import CommissioningError
    from app.device.commissioning.settle import settle

    routine = bench.routine(step, by_hand=not yes)
    said: list[str] = []
    aside = wants_json()  # what is said on the way is not the answer

    def tell(report: Report) -> None:
        if report.message not in said[-1:] and not report.needs:
            said.append(report.message)
            typer.echo(f"  {report.message}", err=aside)

    typer.echo(f"{routine.TITLE}", err=aside)
    report = bench.run(routine, lambda report: answers.to(routine, report, aside), tell)
    failure = settle(bench, step, report)
    if report.result is None:
        raise CommissioningError(failure)
    return report.result


def _wait_for_the_robot(bench: Bench) -> None:
    """Wait for the first angles: compiled code is loaded on the first start."""
    from app.core import state_vector as sv
    from app.device.commissioning.errors import CommissioningError

    end = bench.clock.now() + 120.0
    while bench.loop.latest().row[sv.Q_TIME] == 0.0:
        if bench.clock.now() > end:
            raise CommissioningError(
                "the robot was greeted but sends no joint angles; see `acus device test`"
            )
        bench.advance(0.05)


def _answer(bench: Bench, results: list[AnyResult]) -> Answer:
    from dataclasses import asdict

    clearance = bench.clearance()
    facts = {
        "device": bench.record.device,
        "boot": bench.info.boot,
        "results": [result.model_dump(mode="json") for result in results],
        "clearance": asdict(clearance),
    }
    text = clearance.reason or f"cleared for {clearance.force_cap:g} N"
    lines = [f"{result.step.value:<10} {result.summary()}" for result in results]
    return Answer(facts, [*lines, f"{'device':<10} {bench.record.device}: {text}"])
