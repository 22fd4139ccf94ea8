"""`acus law`: the force laws that are there, and why some cannot be used."""

from typing import Annotated, Any

import typer

from app.commands.answer import Answer, Commands
from app.commands.reader_language import template
from app.commands.shown import Each

app = Commands(help="The force laws, the program's and your own.")


RANK = 200


def register(root: typer.Typer) -> None:
    """Add the group."""
    root.add_typer(app, name="law")


@app.command("list")
def list_laws(
    tried: Annotated[
        bool, typer.Option("--try", help="Also try laws that were not tried before.")
    ] = False,
) -> Answer:
    """List force laws, and why a file of yours is refused.

    Ends with code 3 if one is refused. Nothing is deleted.
    """
    rows = _rows(tried)
    shown = template(
        "{refused:?✖|✔} {law}: {refused:?refused: {refused}|{title}"
        "{trial_states:? (tried with {trial_states} states in {trial_s} s)}}"
    )
    fine = not any(row["refused"] for row in rows)
    return Answer({"laws": rows}, yes=fine, shown=Each("laws", shown))


def _rows(tried: bool) -> list[dict[str, Any]]:
    from app.core.trial import Trial
    from app.device.control import laws as room
    from app.device.control.law import KIND, read_law

    refused, rows = room.refused(), []
    on_trial = KIND.trial or Trial("")
    for path in room.files():
        reason, title, trial = refused.get(path, ""), "", {}
        if not reason:
            law = read_law(path)
            title = law.title
            if not room.is_own(law):
                reason = KIND.fault(path) if tried else ""
                trial = on_trial.known(path)
        rows.append(
            {
                "law": path.stem,
                "title": title,
                "file": str(path),
                "refused": reason,
                "trial_states": trial.get("states"),
                "trial_s": trial.get("seconds"),
            }
        )
    return rows
