"""`acus ct import` and `acus library`: CTs taken in de-identified."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer, Commands
from app.commands.ct import Folder, Mend
from app.commands.ct import app as ct
from app.core.errors import ConfigurationError

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.imaging.library import Entry, Imported
    from app.imaging.privacy.burned_in import Box
    from app.imaging.series import Remedy

app = Commands(help="The CTs that were taken in: list, remove.")

MASK_HELP = "Pixels to blacken, in every picture or in one (from 1); may be repeated."


def register(root: typer.Typer) -> None:
    """Add `library` to the command line, and `import` to `acus ct`."""
    if "import" not in {command.name for command in ct.registered_commands}:
        ct.command("import")(import_ct)
        ct.command("library", hidden=True)(library)
    root.add_typer(app, name="library")


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
) -> Answer:
    """Take a series into the library, de-identified.

    As DICOM PS3.15 says, whole or not at all.
    """
    from app.commands.calibrate_parts import with_progress
    from app.imaging.library import CtLibrary
    from app.imaging.reading import choose
    from app.imaging.scanning import scan_folder

    boxes, asked = boxes_of(mask), remedy_of(remedy)

    def work(progress: "Progress") -> "Imported":
        listing = scan_folder(folder, progress.part(0.0, 0.2))
        chosen = choose(listing, series, asked)
        return CtLibrary().import_series(chosen, boxes, progress.part(0.2, 1.0), asked)

    return imported_answer(with_progress(work))


@app.command("list")
def list_entries() -> Answer:
    """List the CTs of the library."""
    from app.imaging.library import CtLibrary

    entries = CtLibrary().entries()
    lines = []
    for entry in entries:
        opens = "" if entry.remedy == "none" else f"  opens with --remedy {entry.remedy}"
        lines.append(f"{entry.name}  {entry.label}  {entry.files} files{opens}  {entry.folder}")
    empty = "the library is empty; `acus ct import DIR` takes a CT in"
    return Answer({"entries": [_entry(entry) for entry in entries]}, lines or [empty])


@app.command("remove")
def remove(name: Annotated[str, typer.Argument(metavar="NAME", help="Which CT.")]) -> Answer:
    """Delete a CT from the library."""
    from app.imaging.library import CtLibrary

    CtLibrary().remove(name)
    return list_entries()


def library(
    remove: Annotated[str | None, typer.Option(metavar="NAME", help="Delete this CT.")] = None,
) -> Answer:
    """List the CTs of the library, or delete one."""
    from app.imaging.library import CtLibrary

    if remove is not None:
        CtLibrary().remove(remove)
    return list_entries()


def imported_answer(imported: "Imported") -> Answer:
    """Return what `acus ct import`, `acus pacs get` and `acus pacs move` have taken in."""
    return Answer(_document(imported), _lines(imported))


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
