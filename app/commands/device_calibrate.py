"""`acus device calibrate`: commission a real device, typed or scripted."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

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


def register(app: typer.Typer) -> None:
    """Add nothing: `commands.device` takes the command into its group."""


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
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON (docs/json.md).")] = False,
) -> None:
    """Home a robot, check its signs, measure friction, latency and force scale (docs/hardware.md).

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
        results = [] if undo else [_run(bench, one, answers, yes, as_json) for one in steps]
        _tell(bench, results, as_json)


def _run(bench: Bench, step: Step, answers: Answers, yes: bool, as_json: bool) -> AnyResult:
    """Run one routine to its end and keep what it found; a check that fails takes back its own."""
    from app.device.commissioning.errors import CommissioningError
    from app.device.commissioning.settle import settle

    routine = bench.routine(step, by_hand=not yes)
    said: list[str] = []

    def tell(report: Report) -> None:
        if report.message not in said[-1:] and not report.needs:
            said.append(report.message)
            typer.echo(f"  {report.message}", err=as_json)

    typer.echo(f"{routine.TITLE}", err=as_json)
    report = bench.run(routine, lambda report: answers.to(routine, report, as_json), tell)
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


def _tell(bench: Bench, results: list[AnyResult], as_json: bool) -> None:
    from dataclasses import asdict
    from json import dumps

    clearance = bench.clearance()
    if as_json:
        document = {
            "device": bench.record.device,
            "boot": bench.info.boot,
            "results": [result.model_dump(mode="json") for result in results],
            "clearance": asdict(clearance),
        }
        typer.echo(dumps(document, indent=2))
        return
    for result in results:
        typer.echo(f"{result.step.value:<10} {result.summary()}")
    text = clearance.reason or f"cleared for {clearance.force_cap:g} N"
    typer.echo(f"{'device':<10} {bench.record.device}: {text}")
