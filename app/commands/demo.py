"""`acus demo`: a whole exercise shown by a scripted trainee."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

from app.commands import completion
from app.core.errors import AcusError

if TYPE_CHECKING:
    from app.exercises.schema import Exercise
    from app.session.result import AttemptResult
    from app.views.shell.demonstration import DemonstrationScript


TOO_BUSY: Final = (
    "this computer was too busy: the simulated cameras' pictures came too late; close other "
    "programs, then try again"
)


class SkillName(StrEnum):
    """Skills of the scripted trainee, as `simulation.skills` has them."""

    NOVICE = "novice"
    BEGINNER = "beginner"
    COMPETENT = "competent"
    PROFICIENT = "proficient"
    EXPERT = "expert"


class DemoDevice(StrEnum):
    """Machines that a demonstration shows."""

    PANTOGRAPH = "pantograph"
    ARM = "arm"


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("demo")(demo)


def demo(
    ct: Annotated[
        Path | None, typer.Option("--ct", help="Folder of a CT; default: the built-in patient.")
    ] = None,
    exercise: Annotated[
        str,
        typer.Option(
            help="Name or file of the exercise, on its own patient or on --ct.",
            autocompletion=completion.exercises,
        ),
    ] = "first-insertion",
    headless: Annotated[
        bool, typer.Option("--headless", help="Draw into memory; needs no display.")
    ] = False,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for pictures, session and report.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Seed of everything random.", min=0)] = 1,
    skill: Annotated[SkillName, typer.Option(help="Skill of the scripted trainee.")] = (
        SkillName.EXPERT
    ),
    cameras: Annotated[
        str, typer.Option(help="As of `acus run`; real ones must see the needle that is shown.")
    ] = "simulated",
    pen: Annotated[
        bool, typer.Option("--pen", help="No robot: a pen with printed markers, simulated.")
    ] = False,
    device: Annotated[
        DemoDevice,
        typer.Option(help="arm: a simulated arm carries out the plan; it never drives a real one."),
    ] = DemoDevice.PANTOGRAPH,
) -> None:
    """Show a whole exercise, from the plan to the debrief.

    Without a display it runs as with --headless; with code 3 if the attempt is void then.

    With --device arm a simulated arm carries out the exercise's plan: it finds its tool by the
    pictures of two cameras, grasps it, brings it to the entry and inserts it. Without a display its
    own scene is shown first: pictures of what it sees and does there, with a report. It is a
    simulation only and never drives a real arm. Ends with code 3 if the tool is not
    inserted; says why.
    """
    from app.exercises.library import load_exercise

    shown = load_exercise(exercise)
    if device is DemoDevice.ARM:
        if shown.touch is not None:
            raise AcusError(
                f"in {shown.id} targets are touched, and the arm inserts along a path: name another"
                " exercise, or leave out --device arm"
            )
        if pen or cameras != "simulated":
            raise AcusError(
                "the arm works before its own simulated cameras; leave out --pen and --cameras"
            )
        _import_arm()
    from app.views.shell.application import has_display

    hidden = headless or not has_display()
    name = "demo-arm" if device is DemoDevice.ARM else "demo"
    folder = out or (Path("out") / name if hidden else None)
    if device is DemoDevice.ARM and hidden and folder is not None:
        _show_arm(seed, folder)
    _show(ct, shown, hidden, folder, seed, skill, cameras, pen, device is DemoDevice.ARM)


def _import_arm() -> None:
    """Say what it is, and raise the error that names the extra before a window opens for nothing.

    Raises:
        AcusError: if MuJoCo, OMPL or Ruckig is not installed.
    """
    from app.compose.arm import SIMULATION_ONLY
    from app.planning.arm.search import import_ompl
    from app.planning.arm.timing import import_ruckig
    from app.simulation.arm.mjcf import import_mujoco

    typer.echo(SIMULATION_ONLY)
    for load in (import_mujoco, import_ompl, import_ruckig):
        load()


def _show_arm(seed: int, folder: Path) -> None:
    from app.compose.arm import demonstrate
    from app.core.exits import Exit

    shown = demonstrate(seed, folder, typer.echo)
    typer.echo(f"pictures and report are in {folder}")
    if shown.failure is not None:
        typer.echo(f"the tool was not inserted ({shown.failure}): {shown.message}")
        raise typer.Exit(Exit.NO)


def _show(
    ct: Path | None,
    shown: Exercise,
    hidden: bool,
    out: Path | None,
    seed: int,
    skill: SkillName,
    cameras: str,
    pen: bool,
    by_arm: bool = False,
) -> None:
    from app.commands.session import tell_folder
    from app.compose.desktop import Desktop
    from app.core.exits import Exit
    from app.imaging.reading import choose
    from app.imaging.scanning import scan_folder
    from app.tracking.cameras.settings import parse_cameras
    from app.views.shell.application import start
    from app.views.shell.collector import collect_for
    from app.views.shell.demonstration import Demonstration, DemonstrationScript
    from app.views.shell.window import open_window

    if ct is not None:
        choose(scan_folder(ct))  # says here what a dialog would have to ask
    chosen = parse_cameras(cameras)
    if out is None:
        tell_folder()
    application = start(offscreen=hidden)
    sessions = None if out is None else out / "sessions"
    trainee = None if by_arm else skill.value
    window = open_window(Desktop(trainee, seed, sessions, (shown,)))
    if pen:
        window.equipment.take_pen("simulated")
    else:
        window.equipment.take("")  # nobody stands beside the robot that is remembered
    window.equipment.take_cameras(chosen)
    script = DemonstrationScript(shown.id, ct, pictures=out, by_arm=by_arm)
    collector = collect_for(window)
    show = Demonstration(window, script)
    failures: list[str] = []
    void: list[str] = []
    show.told.connect(lambda text: typer.echo(f"{text} …"))
    show.failed.connect(failures.append)
    simulated = pen or cameras == "simulated"
    show.finished.connect(lambda result: void.extend(_tell(result, script, simulated)))
    if hidden:
        window.resize(1400, 900)
        show.failed.connect(lambda _: application.exit(2))
        show.finished.connect(lambda _: application.quit())
    window.show()
    show.start()
    code = application.exec()
    window.close()
    collector.close()
    if failures and hidden:
        raise AcusError(failures[0])
    raise typer.Exit(Exit.NO if void and hidden else code)


def _tell(result: AttemptResult, script: DemonstrationScript, simulated: bool) -> list[str]:
    """Print how the attempt ended; return why it is void, nothing if it is not."""
    score, void = result.score, []
    if score is not None:
        for row in score.rows:
            value = "–" if row.value is None else f"{row.value:z.2f} {row.unit}"
            typer.echo(f"  {row.label:<28} {value}".rstrip())
        total = "void" if score.total is None else f"{score.total:.0f} of 100"
        typer.echo(f"  {'Score':<28} {total}, {'passed' if score.passed else 'not passed'}")
        if score.void_reason:
            void.append(score.void_reason)
            typer.echo(f"  void: {score.void_reason}")
        if score.unseen and simulated:
            typer.echo(f"  {TOO_BUSY}")
    if script.pictures is not None:
        typer.echo(f"pictures, report and session are in {script.pictures}")
    return void
