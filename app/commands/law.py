"""`acus law`: the force laws that are there, and why some cannot be used."""

from typing import Annotated, Any

import typer

from app.commands.answer import Answer, Commands

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
    lines = [f"{'✖' if row['refused'] else '✔'} {row['law']}: {_words(row)}" for row in rows]
    fine = not any(row["refused"] for row in rows)
    return Answer({"laws": rows}, lines, yes=fine)


def _rows(tried: bool) -> list[dict[str, Any]]:
    from app.device.control import law_check
    from app.device.control import laws as room
    from app.device.control.law import read_law

    refused, rows = room.refused(), []
    for path in room.files():
        reason, title, trial = refused.get(path, ""), "", {}
        if not reason:
            law = read_law(path)
            title = law.title
            if not room.is_own(law):
                trial = law_check.trial(path) if tried else law_check.known(path)
                reason = trial.get("reason", "")
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


def _words(row: dict[str, Any]) -> str:
    if row["refused"]:
        return f"refused: {row['refused']}"
    if row["trial_states"]:
        return f"{row['title']} (tried with {row['trial_states']} states in {row['trial_s']} s)"
    return str(row["title"])
