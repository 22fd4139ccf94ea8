"""What the commands of `acus calibrate` share: their group, options, a bar of progress."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from app.commands.answer import Commands, wants_json

if TYPE_CHECKING:
    from collections.abc import Callable

    from app.core.progress import Progress
    from app.tracking.calibration.views import BoardView, Rejection

T = TypeVar("T")

app = Commands(help="Calibrate cameras from pictures of a board.")

Images = Annotated[Path, typer.Option("--images", metavar="DIR", help="Folder of the pictures.")]
BoardSpec = Annotated[
    str,
    typer.Option(
        "--board",
        metavar="SPEC",
        help="checkerboard:COLSxROWS:SQUARE (inner corners, e.g. checkerboard:9x6:25mm) or "
        "charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY (squares).",
    ),
]


def with_progress(work: "Callable[[Progress], T]") -> T:
    """Run `work(progress)` with a bar on the standard error; Ctrl-C cancels it."""
    from rich.console import Console
    from rich.progress import Progress as Bar

    from app.core.progress import Progress

    with Bar(console=Console(stderr=True), transient=True, disable=wants_json()) as bar:
        task = bar.add_task("", total=1.0)

        def show(fraction: float, text: str) -> None:
            bar.update(task, completed=fraction, description=text)

        return work(Progress(show))


def view_document(view: "BoardView | Rejection") -> dict[str, Any]:
    """One picture as JSON."""
    from app.tracking.calibration.views import Rejection

    if isinstance(view, Rejection):
        return {"name": view.name, "used": False, "reason": view.reason.value, "text": view.text}
    return {
        "name": view.name,
        "used": True,
        "reason": "",
        "text": "",
        "image_size": list(view.image_size),
        "corners": int(view.ids.size),
        "square_px": round(view.square_px, 2),
        "edge_px": round(view.sharpness, 2),
        "window_px": view.window,
    }


def view_line(view: "BoardView | Rejection") -> str:
    """One picture as a line for people."""
    from app.tracking.calibration.views import Rejection

    if isinstance(view, Rejection):
        return f"{view.name:<24} not used  {view.text}"
    return (
        f"{view.name:<24} {view.ids.size:>3} corners  squares {view.square_px:.0f} px  "
        f"edges {view.sharpness:.1f} px  window ±{view.window} px"
    )
