"""`acus ct import` and `acus ct library`: CTs taken in de-identified."""

import json
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.ct import AsJson, Folder, Mend
from app.commands.ct import app as ct
from app.core.errors import ConfigurationError

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.imaging.library import Entry, Imported
    from app.imaging.privacy.burned_in import Box
    from app.imaging.series import Remedy

MASK_HELP = "Pixels to blacken, in every picture or in one (from 1); may be repeated."


def register(root: typer.Typer) -> None:
    """Add `import` and `library` to `acus ct`, which its own file adds to the command line."""
    names = {command.name for command in ct.registered_commands}
    if "import" not in names:
        ct.command("import")(import_ct)
        ct.command("library")(library)


def import_ct(
    folder: Folder,
    series: Annotated[
        str | None, typer.Option(help="SeriesInstanceUID, where several fit.")
    ] = None,
    mask: Annotated[
        list[str] | None,
        typer.Option(metavar="COL,ROW,WIDTH,HEIGHT[,PICTURE]", help=MASK_HELP),
    ] = None,
    remedy: Mend = None,
    as_json: AsJson = False,
) -> None:
    """Take a series into the library, de-identified (DICOM PS3.15), whole or not at all."""
    from app.commands.calibrate import with_progress
    from app.imaging.library import CtLibrary
    from app.imaging.reading import choose
    from app.imaging.scanning import scan_folder

    boxes, asked = boxes_of(mask), remedy_of(remedy)

    def work(progress: "Progress") -> "Imported":
        listing = scan_folder(folder, progress.part(0.0, 0.2))
        chosen = choose(listing, series, asked)
        return CtLibrary().import_series(chosen, boxes, progress.part(0.2, 1.0), asked)

    imported = with_progress(work, as_json)
    show_imported(imported, as_json)


def library(
    remove: Annotated[str | None, typer.Option(metavar="NAME", help="Delete this CT.")] = None,
    as_json: AsJson = False,
) -> None:
    """List the CTs of the library, or delete one."""
    from app.imaging.library import CtLibrary

    own = CtLibrary()
    if remove is not None:
        own.remove(remove)
    entries = own.entries()
    if as_json:
        typer.echo(json.dumps({"entries": [_entry(entry) for entry in entries]}, indent=2))
        return
    for entry in entries:
        opens = "" if entry.remedy == "none" else f"  opens with --remedy {entry.remedy}"
        typer.echo(f"{entry.name}  {entry.label}  {entry.files} files{opens}  {entry.folder}")
    if not entries:
        typer.echo("the library is empty; `acus ct import DIR` takes a CT in")


def show_imported(imported: "Imported", as_json: bool) -> None:
    """Print what `acus ct import`, `acus pacs get` and `acus pacs move` have taken in."""
    if as_json:
        typer.echo(json.dumps(_document(imported), indent=2))
        return
    for line in _lines(imported):
        typer.echo(line)


def _document(imported: "Imported") -> dict[str, Any]:
    return {
        **_entry(imported.entry),
        "again": imported.again,
        "before": imported.before,
        "given": imported.given,
        "report": imported.report.document(),
    }


def _lines(imported: "Imported") -> list[str]:
    entry = imported.entry
    head = f"{entry.name}: {entry.label}, {entry.files} files: {imported.words}"
    if entry.remedy != "none":
        head += f"; it opens with --remedy {entry.remedy}"
    return [head, *(f"  {line}" for line in imported.report.lines()), f"  {entry.folder}"]


def _entry(entry: "Entry") -> dict[str, Any]:
    return {
        "name": entry.name,
        "label": entry.label,
        "files": entry.files,
        "remedy": entry.remedy.value,
        "folder": str(entry.folder),
    }


def remedy_of(text: str | None) -> "Remedy":
    """Read `--remedy`.

    Raises:
        ConfigurationError: listing what there is.
    """
    from app.imaging.series import Remedy

    valid = [one.value for one in Remedy if one is not Remedy.NONE]
    if text is not None and text not in valid:
        raise ConfigurationError(f"--remedy {text!r} is none of {', '.join(valid)}")
    return Remedy.NONE if text is None else Remedy(text)


def boxes_of(masks: list[str] | None) -> list["Box"]:
    """Read the boxes of `--mask`.

    Raises:
        ConfigurationError, BurnedInError: naming the one that is none.
    """
    return [_box(text) for text in masks or ()]


def _box(text: str) -> "Box":
    from app.imaging.privacy.burned_in import Box

    try:
        numbers = [int(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (4, 5):
        raise ConfigurationError(
            f"--mask {text!r} is not COL,ROW,WIDTH,HEIGHT or COL,ROW,WIDTH,HEIGHT,PICTURE: four or "
            "five whole numbers, no blanks"
        )
    return Box(*numbers)
