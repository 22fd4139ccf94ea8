"""`acus check`: the daily check."""

from typing import TYPE_CHECKING, Annotated

import typer

from app.commands.answer import Answer
from app.commands.reader_language import local
from app.core.messages import joined, sentence

if TYPE_CHECKING:
    from app.session.checks.record import DayCheck

_MARKS = {"good": "✔", "warning": "▲", "bad": "✖", "waiting": "–"}


RANK = 30


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("check")(check)


def check(
    device: Annotated[
        str | None, typer.Option(help="Serial port of a real robot; default: simulated.")
    ] = None,
    cameras: Annotated[
        str | None, typer.Option(help="Real cameras, as in `acus run --cameras`.")
    ] = None,
    plate: Annotated[str, typer.Option(help="Plate with the point to touch.")] = "stepped-plate",
    point: Annotated[str, typer.Option(help="Its fiducial; default: the last.")] = "",
    touch: Annotated[
        bool, typer.Option("--touch/--no-touch", help="Whether to touch a point.")
    ] = True,
    last: Annotated[
        bool, typer.Option("--last", help="Show the newest check instead of making one.")
    ] = False,
) -> Answer:
    """Make the daily check of robot and cameras. It takes two minutes.

    Looked at: robot, pictures, marker and one touched point; the result is kept.

    Ends with code 3 if something is wrong.
    """
    from app.session.checks.record import newest_check
    from app.session.checks.steps import CheckVerdict

    found = newest_check() if last else _made(device, cameras, plate, point, touch)
    if found is None:
        none = [sentence("no daily check was made yet")]
        return Answer({"check": None}, none, yes=False)
    document = found.model_dump(mode="json")
    passed = found.verdict not in (CheckVerdict.BAD, CheckVerdict.WAITING)
    return Answer({"check": document}, _lines(found), yes=passed)


def _made(
    device: str | None, cameras: str | None, plate: str, point: str, touch: bool
) -> "DayCheck":
    from datetime import datetime

    from app.compose.daily_check import DailyCheck, known_point
    from app.planning.registration.plate import load_plate
    from app.session.checks.record import DayCheck, save_check
    from app.session.checks.steps import daily_check
    from app.tracking.cameras.settings import parse_cameras

    name, place = known_point(load_plate(plate), point)
    settings = parse_cameras(cameras) if cameras else None
    running = DailyCheck(port=device, cameras=settings)
    try:
        running.open()
        if touch:
            if running.simulated and settings is None:
                running.move_to(place)
            else:
                typer.prompt(
                    local(
                        sentence("Rest the tip in {name} and hold still; press Enter", name=name)
                    ),
                    default="",
                    show_default=False,
                    err=True,
                )
            running.touch(name, place)
        results = tuple(one for one in daily_check(running.facts()) if touch or one.name != "touch")
        found = DayCheck.of(
            results,
            datetime.now().astimezone(),
            running.device,
            running.simulated,
            running.calibration,
        )
    finally:
        running.close()
    save_check(found)
    return found


def _lines(result: "DayCheck") -> list[str]:
    from datetime import datetime

    lines: list[str] = []
    for step in result.steps:
        lines.append(joined("", (f"{_MARKS[step.verdict.value]} {step.name:10} ", step.found)))
        if step.todo:
            lines.append(joined("", (f"  {'':10} → ", step.todo)))
    return [*lines, result.words(datetime.now().astimezone())]
