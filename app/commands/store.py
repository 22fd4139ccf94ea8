"""`acus store`: the folder of records and its index."""

from pathlib import Path
from typing import Annotated

import typer

from app.commands.answer import Answer, Commands

FolderOption = Annotated[Path | None, typer.Option("--folder", help="Folder of the records.")]


def register(app: typer.Typer) -> None:
    """Add `store status` and `store rebuild`."""
    store = Commands(help="The folder of records: its index.")
    store.command("status")(status)
    store.command("rebuild")(rebuild)
    app.add_typer(store, name="store")


def status(folder: FolderOption = None) -> Answer:
    """Say how many attempts there are, and what their signatures say.

    Brings the index up to date first. *verified*: written by this station and unchanged; it does
    not mean that the owner of the disk could not forge it.
    """
    from collections import Counter

    from app.session.index import Index
    from app.session.signature import Verdict
    from app.session.store import TRASH, records, records_folder

    place = records_folder(folder)
    index = Index(place)
    seen = index.refresh()
    found = index.attempts()
    verdicts, states = Counter(one.verdict for one in found), Counter(one.state for one in found)
    facts = {
        "folder": place,
        "index": index.path,
        "read": seen.read,
        "gone": seen.gone,
        "attempts": len(found),
        "signatures": {verdict.value: verdicts[verdict.value] for verdict in Verdict},
        "states": dict(sorted(states.items())),
        "deleted": len(records(place / TRASH)),
    }
    lines = [
        f"{len(found)} attempts in {place}, {facts['deleted']} deleted",
        f"index: {index.path or 'in memory, the folder can only be read'}",
        "signatures: " + ", ".join(f"{verdicts[v.value]} {v.value}" for v in Verdict),
        "states: " + (", ".join(f"{n} {state}" for state, n in sorted(states.items())) or "none"),
    ]
    return Answer(facts, lines)


def rebuild(folder: FolderOption = None) -> Answer:
    """Make the index anew from the records; they are read, and never changed."""
    from app.commands.calibrate_parts import with_progress
    from app.session.index import Index
    from app.session.store import records_folder

    index = Index(records_folder(folder))
    done = with_progress(index.rebuild)
    facts = {"folder": index.folder, "index": index.path, "attempts": done.total, "gone": done.gone}
    return Answer(facts, [f"{done.total} attempts indexed, {done.gone} of the old index are gone"])
