"""`acus demo`: a whole exercise shown by a scripted trainee, or by whom a plug-in adds.

A file in `demonstrations/` of a folder of plug-ins declares itself in a literal `DECLARATION`
(`title`; `help` for `--device`; `about`, a paragraph for `--help`) and defines three functions:

    prepare(exercise, simulated, tell)  refuses what it cannot show; imports what it needs
    alone(seed, folder, tell)           shows what the window does not, without a display;
                                        returns why that failed, or nothing
    leader(feature)                     a `Leader` of `views.shell.demonstration`
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from enum import StrEnum
from inspect import cleandoc
from pathlib import Path
from tempfile import TemporaryFile
from types import ModuleType
from typing import TYPE_CHECKING, Annotated, Final

import typer

from app.commands import completion, link_options
from app.commands.reader_language import language, local, tell
from app.core import plugin_folders
from app.core.errors import AcusError
from app.core.files import read_at_most
from app.core.messages import sentence
from app.scoring.unit_words import unit_words

if TYPE_CHECKING:
    from app.compose.watchers import RunWatcher
    from app.exercises.schema import Exercise
    from app.session.result import AttemptResult
    from app.views.shell.demonstration import DemonstrationScript, MakesLeader


TOO_BUSY: Final = sentence(
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


_OWN: Final = "pantograph"


def _demonstrations() -> Iterator[tuple[str, dict[str, str]]]:
    """Read what they say about themselves as text: `acus --help` imports nothing heavy."""
    for path in plugin_folders.files("demonstrations"):
        try:
            said = plugin_folders.declared(ast.parse(read_at_most(path).decode()).body)
        except (OSError, SyntaxError, ValueError) as error:
            plugin_folders.refused[path] = sentence(
                "{path} cannot be read: {error}", path=path, error=error
            )
        else:
            yield path.stem, {key: str(value) for key, value in said.items()}


_OTHERS: Final = dict(_demonstrations())

DemoDevice = StrEnum(  # type: ignore[misc]  # its names are those of the files
    "DemoDevice", {name.upper(): name for name in (_OWN, *_OTHERS)}
)
"""Machines that a demonstration shows."""

_DEVICE: Final = DemoDevice(_OWN)
_HELP: Final = " ".join(f"{name}: {said.get('help', '')}" for name, said in _OTHERS.items())


RANK = 20


def register(app: typer.Typer) -> None:
    """Add the command."""
    about = (cleandoc(demo.__doc__ or ""), *(said.get("about", "") for said in _OTHERS.values()))
    app.command("demo", help="\n\n".join(about))(demo)


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
        typer.Option(
            help=" ".join(f"{one}: {said.get('help', '')}" for one, said in _OTHERS.items())
        ),
    ] = _DEVICE,
    igtl: link_options.Igtl = None,
    rosbridge: link_options.Rosbridge = None,
    foxglove: link_options.Foxglove = None,
    links_host: link_options.Host = None,
    links_token: link_options.Token = None,
    links_allow: link_options.Allow = None,
) -> None:
    """Show a whole exercise, from the plan to the debrief.

    Without a display it runs as with --headless; with code 3 if the attempt is void then.
    """
    from app.exercises.library import load_exercise

    shown = load_exercise(exercise)
    other = None if device.value == _OWN else _demonstration(device.value)
    if other is not None:
        other.prepare(shown, cameras == "simulated" and not pen, tell)
    from app.views.shell.application import has_display

    hidden = headless or not has_display()
    name = "demo" if other is None else f"demo-{device.value}"
    folder = out or (Path("out") / name if hidden else None)
    if folder is not None:
        _try_to_write(folder)
    if other is not None and hidden and folder is not None:
        _show_alone(other, seed, folder)
    leader = None if other is None else other.leader
    asked = link_options.given(
        igtl=igtl,
        rosbridge=rosbridge,
        foxglove=foxglove,
        links_host=links_host,
        links_token=links_token,
        links_allow=links_allow,
    )
    watchers = link_options.opened(asked)
    try:
        _show(ct, shown, hidden, folder, seed, skill, cameras, pen, leader, watchers)
    finally:
        for watcher in watchers:
            watcher.close()


def _try_to_write(folder: Path) -> None:
    """Refuse, before minutes are spent on it, a folder in which nothing can be written."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise AcusError(
            sentence(
                "nothing can be written to {folder} ({error}); start it in a folder of your own, or"
                " name one by --out",
                folder=folder.absolute(),
                error=error.strerror,
            )
        ) from error


def _demonstration(name: str) -> ModuleType:
    for module in plugin_folders.modules("demonstrations", name):
        return module
    raise AcusError(" ".join(plugin_folders.refused.values()))


def _show_alone(demonstration: ModuleType, seed: int, folder: Path) -> None:
    from app.core.exits import Exit

    failure = demonstration.alone(seed, folder, tell)
    tell(sentence("pictures and report are in {folder}", folder=folder))
    if failure:
        tell(failure)
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
    leader: MakesLeader | None = None,
    watchers: tuple[RunWatcher, ...] = (),
) -> None:
    from app.commands.session import tell_folder
    from app.compose import needle_sources
    from app.compose.desktop import Desktop
    from app.core.exits import Exit
    from app.imaging.reading import choose
    from app.imaging.scanning import scan_folder
    from app.tracking.cameras.settings import parse_cameras
    from app.views.shell.application import start
    from app.views.shell.collector import collect_for
    from app.views.shell.demonstration import Demonstration, DemonstrationScript
    from app.views.shell.window import open_window

    if pen:
        needle_sources.KIND.find("pen")
    if ct is not None:
        choose(scan_folder(ct))  # says here what a dialog would have to ask
    chosen = parse_cameras(cameras)
    if out is None:
        tell_folder()
    application = start(offscreen=hidden)
    sessions = None if out is None else out / "sessions"
    trainee = skill.value if leader is None else None
    window = open_window(Desktop(trainee, seed, sessions, (shown,), leader is not None, watchers))
    if pen:
        window.equipment.take_pen("simulated")
    else:
        window.equipment.take("")  # nobody stands beside the robot that is remembered
    window.equipment.take_cameras(chosen)
    script = DemonstrationScript(shown.id, ct, pictures=out, leader=leader)
    collector = collect_for(window)
    show = Demonstration(window, script)
    failures: list[str] = []
    void: list[str] = []
    show.told.connect(lambda text: typer.echo(f"{text} …"))
    show.failed.connect(failures.append)
    show.finished.connect(lambda result: void.extend(_tell(result, script, pen)))
    if hidden:
        window.resize(1400, 900)
        show.failed.connect(lambda _: application.exit(2))
        show.finished.connect(lambda _: application.quit())
    window.show()
    show.start()
    code = application.exec()
    window.close()
    collector.close()
    if show.aborted and hidden:
        tell(sentence("  void: {reason}", reason=show.aborted))
        raise typer.Exit(Exit.NO)
    if failures and hidden:
        raise AcusError(failures[0])
    raise typer.Exit(Exit.NO if void and hidden else code)


def _tell(result: AttemptResult, script: DemonstrationScript, hurried: bool) -> list[str]:
    """Print how the attempt ended; return why it is void, nothing if it is not.

    Time waits for simulated cameras, but not for a `hurried` pen's.
    """
    score, void = result.score, []
    if score is not None:
        here = language()
        for row in score.rows:
            unit = local(unit_words(row.unit))
            value = "–" if row.value is None else f"{here.number(row.value, 'z.2f')} {unit}"
            typer.echo(f"  {here.text(row.label):<28} {value}".rstrip())
        points = sentence("{total:.0f} of 100", total=score.total or 0.0)
        total = sentence("void") if score.total is None else points
        passed = sentence("passed") if score.passed else sentence("not passed")
        typer.echo(f"  {here.text('Score'):<28} {local(total)}, {local(passed)}")
        for fail in score.hard_fails:
            typer.echo(f"  {local(fail)}")
        if score.void_reason:
            void.append(score.void_reason)
            tell(sentence("  void: {reason}", reason=score.void_reason))
        if score.unseen and hurried:
            typer.echo(f"  {local(TOO_BUSY)}")
    if script.pictures is not None:
        tell(sentence("pictures and report are in {folder}", folder=script.pictures))
        if result.record is not None:
            tell(
                sentence(
                    "session: {record} (`acus session show`, `replay`: by this path)",
                    record=result.record,
                )
            )
    return void
