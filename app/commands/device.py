"""`acus device`: robots on serial ports, and one that is emulated."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from app.commands import completion
from app.commands.answer import Answer, Commands
from app.commands.device_calibrate import calibrate

if TYPE_CHECKING:
    from app.compose.emulator import Emulator

Port = Annotated[str, typer.Argument(help="Serial port, e.g. /dev/ttyACM0.")]
Profile = Annotated[
    str,
    typer.Option(help="Device profile: a name or a YAML file.", autocompletion=completion.profiles),
]


def register(app: typer.Typer) -> None:
    """Add `acus device …`."""
    group = Commands(help="Robots on serial ports.")
    group.command("list")(list_ports)
    group.command("show")(show)
    group.command("info", hidden=True)(show)
    group.command("test")(measure)
    group.command("calibrate")(calibrate)
    group.command("emulate")(emulate)
    app.add_typer(group, name="device")


def list_ports() -> Answer:
    """List serial ports and device profiles."""
    from app.device.links.port import ports
    from app.mechanisms.profile import load_profile, profile_names

    found = ports()
    rows = [
        {"port": port.path, "description": port.description, "hardware": port.hardware}
        for port in found
    ]
    lines = [f"{port.path:<16} {port.description}  {port.hardware}" for port in found]
    if not found:
        lines.append("no serial ports; plug the robot in, or try `acus device emulate`")
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
    lines.append("profiles:")
    lines += [f"  {p['name']:<12} {p['protocol']}, {p['description']}" for p in profiles]
    return Answer({"ports": rows, "profiles": profiles}, lines, first_form=rows)


def show(port: Port, profile: Profile = "icube") -> Answer:
    """Ask the robot on a port who it is."""
    from dataclasses import asdict

    from app.device.links.serial_link import SerialLink
    from app.mechanisms.profile import load_profile

    link = SerialLink(port, load_profile(profile))
    link.open()
    try:
        found = asdict(link.info())
    finally:
        link.close()
    lines = [
        f"{name:<10} {value if value != '' else '(the board does not say)'}"
        for name, value in found.items()
    ]
    return Answer({"port": port} | found, lines)


def measure(
    port: Port,
    profile: Profile = "icube",
    seconds: Annotated[float, typer.Option(min=0.1, max=3600.0, help="How long.")] = 5.0,
) -> Answer:
    """Measure the link. Zero torques at the profile's rate: round trip, losses, errors."""
    from app.device.link_test import measure_link
    from app.mechanisms.profile import load_profile

    result = measure_link(port, load_profile(profile), seconds)
    lines = [f"{label:<24} {value}" for label, value in result.lines()]
    return Answer(result.document(), lines)


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

    from app.commands.orders import Orders
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
                    typer.echo(f"not understood: {error}")
            emulator.work()
            time.sleep(0.01)
    finally:
        emulator.close()
