"""`acus plugin`: files of your own of every kind, and why some cannot be used."""

import os

import typer

from app.commands.answer import Answer, Commands
from app.commands.shown import Each
from app.core.messages import sentence

app = Commands(
    help="Your own laws, effects, metrics, studies, machines. They run with all your rights: take "
    "none from people whom you do not trust."
)


RANK = 210


def register(root: typer.Typer) -> None:
    """Add the group."""
    root.add_typer(app, name="plugin")


@app.command("list")
def list_plugins() -> Answer:
    """List your own files of every kind, and why one is refused.

    File and line of what is wrong are told. Each is imported once, in a process of its own, which
    it may end; what it does there it does with all your rights. Ends with code 3 if one is refused.
    Where there are none, the folders for them are listed. Nothing is deleted; `acus law list --try`
    also runs force laws.
    """
    from app.commands.calibrate_parts import with_progress
    from app.compose.plugins import RIGHTS, plugin_files, plugin_folders

    rows = [
        {
            "kind": f.kind,
            "name": f.name,
            "title": f.title,
            "file": str(f.path),
            "refused": f.refused,
        }
        for f in with_progress(lambda progress: plugin_files(tried=True, progress=progress))
    ]
    fine = not any(row["refused"] for row in rows)
    folders = {k: os.pathsep.join(map(str, places)) for k, places in plugin_folders().items()}
    none = (
        sentence("no files of your own yet; save them in these folders (make what is missing):"),
        Each("folders", "  {key}: {value}"),
    )
    row = "{refused:?✖|✔} {kind} {name}: {refused:?refused: {refused}|{title}}"
    facts = {"plugins": rows, "folders": folders}
    return Answer(facts, [RIGHTS], yes=fine, shown=Each("plugins", row, none))
