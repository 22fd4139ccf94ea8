"""`acus calibrate`: cameras from pictures of a board."""

import typer

from app.commands.answer import Answer
from app.commands.calibrate_cameras import mono, stereo
from app.commands.calibrate_parts import (
    BoardSpec,
    Images,
    app,
    view_document,
    view_line,
    with_progress,
)

app.command("mono")(mono)
app.command("stereo")(stereo)


def register(root: typer.Typer) -> None:
    """Add `calibrate` to the command line, with the commands of its other files."""
    from app.commands import calibrate_exchange, calibrate_history, calibrate_world  # noqa: F401

    root.add_typer(app, name="calibrate")


@app.command("views")
def list_views(
    images: Images,
    board: BoardSpec = "charuco:9x6:20mm:15mm:DICT_5X5_100",
) -> Answer:
    """Say of every picture whether it can be used. Or why it cannot."""
    from app.tracking.calibration.boards import parse_board
    from app.tracking.calibration.pictures import list_pictures, look_at_all

    known = parse_board(board)
    paths = list_pictures(images)
    found = with_progress(lambda progress: look_at_all(paths, known, progress))
    facts = {"board": known.spec, "views": [view_document(view) for view in found]}
    return Answer(facts, [view_line(view) for view in found])
