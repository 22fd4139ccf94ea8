"""`acus device`: robots on serial ports, commissioning one, and one that is emulated."""

from __future__ import annotations

import queue
import stat
import sys
import threading
from enum import StrEnum
from os import fstat
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands, wants_json
from app.commands.reader_language import local
from app.commands.shown import Each
from app.core.messages import joined, sentence

if TYPE_CHECKING:
    from app.commands.answers import Answers
    from app.compose.emulator import Emulator
    from app.device.commissioning.bench import Bench
    from app.device.commissioning.results import AnyResult, RoutineName, RoutineReport

Port = Annotated[
    str, typer.Argument(help="Serial port, e.g. /dev/ttyACM0, or haply: for an Inverse3.")
]
Profile = Annotated[
    str,
    typer.Option(help="Device profile: a name or a YAML file.", autocompletion=completion.profiles),
]


RANK = 120


def register(app: typer.Typer) -> None:
    """Add `acus device …`."""
    group = Commands(help="Robots on serial ports.")
    group.command("list")(list_ports)
    group.command("show")(show)
    group.command("test")(measure)
    group.command("conform")(conform_)
    group.command("calibrate")(calibrate)
    group.command("emulate")(emulate)
    app.add_typer(group, name="device")


def list_ports() -> Answer:
    """List serial ports and device profiles."""
    from app.device.links.port import ports
    from app.mechanisms.profile import load_profile, profile_names

    rows = [
        {"port": port.path, "description": port.description, "hardware": port.hardware}
        for port in ports()
    ]
    profiles = []
    for name in profile_names():
        profile = load_profile(name)
        profiles.append(
            {
                "name": name,
                "protocol": profile.wire.protocol,
                "description": profile.description,
            }
        )
    none = sentence("no serial ports; plug the robot in, or try `acus device emulate`")
    shown = (
        Each("ports", "{port:<16} {description}  {hardware}", none),
        "profiles:",
        Each("profiles", "  {name:<12} {protocol}, {description}"),
    )
    return Answer({"ports": rows, "profiles": profiles}, shown=shown)


def _check_there(port: str) -> None:
    from app.device.links.port import check_there

    check_there(port)


def show(port: Port, profile: Profile = "icube") -> Answer:
    """Ask the robot on a port who it is."""
    from dataclasses import asdict

    _check_there(port)
    from app.device.links.inverse3 import robot_link
    from app.mechanisms.profile import load_profile

    link = robot_link(port, load_profile(profile))
    link.open()
    try:
        found = asdict(link.info())
    finally:
        link.close()
    lines = [
        f"{name:<10} {value}"
        if value != ""
        else joined("", (f"{name:<10} ", sentence("(the board does not say)")))
        for name, value in found.items()
    ]
    return Answer({"port": port} | found, lines)


def measure(
    port: Port,
    profile: Profile = "icube",
    seconds: Annotated[float, typer.Option(min=0.1, max=3600.0, help="How long.")] = 5.0,
) -> Answer:
    """Measure the link. Zero torques at the profile's rate: round trip, losses, errors.

    Ends with 3 unless each command was answered.
    """
    _check_there(port)
    from app.device.link_test import measure_link
    from app.mechanisms.profile import load_profile

    result = measure_link(port, load_profile(profile), seconds)
    lines = [f"{label:<24} {value}" for label, value in result.lines()]
    return Answer(result.document(), lines, yes=result.good)


def conform_(
    port: Port,
    profile: Profile = "icube",
    push: Annotated[
        bool, typer.Option("--push", help="Give torques, up to the largest: the arms move.")
    ] = False,
    turn: Annotated[
        bool, typer.Option("--turn", help="Wait until both links are turned by hand.")
    ] = False,
    restart: Annotated[
        bool, typer.Option("--restart", help="Wait until the board is switched off and on.")
    ] = False,
    out: Annotated[
        Path | None, typer.Option("--out", help="File for the report: .pdf, or text.")
    ] = None,
) -> Answer:
    """Test a board against the protocol, rule by rule.

    Zero torques unless --push is given. The board is homed anew where it stands. Ends with 3 if
    it breaks a rule (docs/firmware.md).
    """
    _check_there(port)
    from datetime import datetime

    from app.core.files import write_atomically
    from app.device.conformance.suite import conform
    from app.device.links.inverse_service import refuse_inverse3
    from app.mechanisms.profile import load_profile

    refuse_inverse3(port)
    result = conform(
        port,
        load_profile(profile),
        push,
        turn,
        restart,
        lambda line: typer.echo(line, err=wants_json()),
    )
    if out is not None and out.suffix.lower() == ".pdf":
        from app.views.robot.conformance_page import write_conformance

        write_conformance(out, result, datetime.now())
    elif out is not None:
        write_atomically(out, result.report(datetime.now()))
    return Answer(result.document(), result.lines(), yes=result.good)


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
    _check_there(port)
    from app.commands.answers import Answers, numbers
    from app.device.commissioning.bench import Bench
    from app.device.commissioning.results import RoutineName
    from app.device.links.inverse_service import refuse_inverse3
    from app.device.links.serial_link import SerialLink
    from app.mechanisms.profile import load_profile

    refuse_inverse3(port)
    chosen = load_profile(profile)
    steps = [RoutineName(name.value) for name in step or ()] or [
        RoutineName.HOMING,
        RoutineName.SIGNS,
        RoutineName.LATENCY,
        RoutineName.FORCE,
    ]
    answers = Answers(yes, numbers(readings, "--readings", 3) if readings else ())
    with Bench(SerialLink(port, chosen), chosen) as bench:
        _wait_for_the_robot(bench)
        if undo:
            bench.undo(*(steps if step else ()))
        results = [] if undo else [_commission(bench, one, answers, yes) for one in steps]
        return _answer(bench, results)


def _commission(bench: Bench, step: RoutineName, answers: Answers, yes: bool) -> AnyResult:
    """Run one routine to its end and keep what it found; a check that fails takes back its own."""
    from app.device.commissioning.records import settle
    from app.device.errors import CommissioningError

    routine = bench.routine(step, by_hand=not yes)
    said: list[str] = []
    aside = wants_json()  # what is said on the way is not the answer

    def tell(report: RoutineReport) -> None:
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
    from app.device.errors import CommissioningError

    end = bench.clock.now() + 120.0
    while bench.loop.latest().row[sv.Q_TIME] == 0.0:
        if bench.clock.now() > end:
            raise CommissioningError(
                sentence("the robot was greeted but sends no joint angles; see `acus device test`")
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
    text = clearance.reason or sentence("cleared for {force:g} N", force=clearance.force_cap)
    lines = [joined(" ", (f"{one.step.value:<10}", one.summary())) for one in results]
    last = sentence("device     {device}: {clearance}", device=bench.record.device, clearance=text)
    return Answer(facts, [*lines, last])


def emulate(
    profile: Profile = "icube",
    link: Annotated[Path | None, typer.Option(help="Link to the terminal, e.g. robot.")] = None,
    hand: Annotated[str, typer.Option(help="none, rest or script.")] = "none",
    record: Annotated[Path | None, typer.Option(help="CSV file of every round.")] = None,
    fault: Annotated[
        list[str] | None, typer.Option(help="Fault from the start, e.g. drop=0.1; repeatable.")
    ] = None,
    parked: Annotated[bool, typer.Option("--parked", help="Arms rest at the home angles.")] = False,
    gauge: Annotated[bool, typer.Option("--gauge", help="The board has a force gauge.")] = False,
    serial: Annotated[str, typer.Option(help="Serial number of the board.")] = "EMULATED",
    seed: Annotated[int, typer.Option(min=0, help="Seed of the faults.")] = 1,
) -> None:
    """Be a robot behind a pseudo-terminal. Its path is printed; faults are typed on the way.

    Lines on the standard input: drop P, garble P, delay MS, freeze on|off, cut on|off,
    unplug on|off, reset, version N, error N, park on|off, quit. For the hand: hold
    on|off, turn left|right DEGREES (one link), lean X Y (degrees).
    """
    from app.compose.emulator import Emulator, EmulatorSetup
    from app.mechanisms.profile import load_profile

    setup = EmulatorSetup(load_profile(profile), link, hand, record, parked, gauge, serial, seed)
    emulator = Emulator(setup, lambda line: print(line, flush=True))  # noqa: T201
    for order in fault or ():
        emulator.switch(order)
    _serve(emulator)


def _serve(emulator: Emulator) -> None:
    """Run until `quit`, the end of a pipe on the standard input, or a signal."""
    import signal
    import time

    from app.core.errors import AcusError

    ended: list[int] = []
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda received, _: ended.append(received))
    orders = Orders()
    emulator.open()
    try:
        while not ended and not orders.ended:
            for order in orders.waiting():
                if order == "quit":
                    ended.append(0)
                    break
                try:
                    emulator.switch(order)
                    typer.echo(f"ok {order}")
                except AcusError as error:
                    typer.echo(local(sentence("not understood: {error}", error=error)))
            emulator.work()
            time.sleep(0.01)
    finally:
        emulator.close()


class Orders:
    """Lines of the standard input, read by a thread.

    `ended` becomes true when a pipe ends: whoever gave orders through it has gone. The end of a
    terminal or of /dev/null means nothing.
    """

    def __init__(self) -> None:
        self.ended = False
        self._lines: queue.SimpleQueue[str] = queue.SimpleQueue()
        threading.Thread(target=self._read, name="acus orders", daemon=True).start()

    def waiting(self) -> list[str]:
        """Take the lines that have come, without blanks."""
        lines = []
        while not self._lines.empty():
            lines.append(self._lines.get())
        return lines

    def _read(self) -> None:
        for line in sys.stdin:
            if line.strip():
                self._lines.put(line.strip())
        self.ended = stat.S_ISFIFO(fstat(sys.stdin.fileno()).st_mode)
