"""`acus ct` and `acus library`: what a folder of CT holds, where a voxel lies, CTs taken in."""

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from app.commands.answer import Answer, Commands
from app.commands.reader_language import template
from app.commands.shown import Each
from app.core.errors import ConfigurationError
from app.core.messages import counted, joined, sentence

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.imaging.field import TissueField
    from app.imaging.library import Imported, LibraryEntry
    from app.imaging.privacy.burned_in import MaskBox
    from app.imaging.series import Listing, Series
    from app.imaging.volume import Volume


class RemedyGroup(TyperGroup):
    """Commands whose `--remedy` names every remedy in its help, read when the help is asked for."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return name, command and the other arguments."""
        name, command, others = super().resolve_command(ctx, args)
        for option in getattr(command, "params", ()) if "--help" in others else ():
            if option.name == "remedy":
                option.help = _remedies_help()
        return name, command, others


app = Commands(help="CT series: list, points, import.", cls=RemedyGroup)
library = Commands(help="The CTs that were taken in: list, remove.")

MASK_HELP = "Pixels to blacken, in every picture or in one (from 1); may be repeated."


def _remedies_help() -> str:
    from app.imaging.remedies import remedies

    ways = (f"{one.name} ({one.against})" for one in remedies())
    return f"Read the series on request: {', '.join(ways)}."


Mend = Annotated[str | None, typer.Option(metavar="WORD", help="Read the series on request.")]
Folder = Annotated[
    Path, typer.Argument(metavar="DIR", help="Folder (at any depth), zip, DICOMDIR or file.")
]


RANK = 40


def register(root: typer.Typer) -> None:
    """Add `ct` and `library` to the command line."""
    root.add_typer(app, name="ct")
    root.add_typer(library, name="library")


@app.command("list")
def list_series(folder: Folder) -> Answer:
    """List every series and whether it can be used. Modality, size, place, or why not."""
    _start_reader()
    from app.imaging.scanning import scan_folder

    listing = scan_folder(folder)
    if not listing.series:
        from app.imaging.reading import choose

        choose(listing)  # says what is wrong with the folder
    ignored = [f"ignored  {listing.shown(one.path)}: {one.reason}" for one in listing.ignored]
    return Answer(_listing(listing), [*map(_line, listing.series), *ignored])


@app.command()
def point(
    folder: Folder,
    series: Annotated[
        str | None, typer.Option(help="SeriesInstanceUID, where several fit.")
    ] = None,
    voxel: Annotated[
        str | None, typer.Option(metavar="I,J,K", help="Column, row and slice along the normal.")
    ] = None,
    sop: Annotated[str | None, typer.Option(help="SOPInstanceUID of one file.")] = None,
    pixel: Annotated[
        str | None, typer.Option(metavar="COL,ROW", help="Pixel of that file.")
    ] = None,
    frame: Annotated[
        int | None, typer.Option(help="Frame of a multi-frame file, from 1; goes with --sop.")
    ] = None,
    remedy: Mend = None,
) -> Answer:
    """Print where a voxel lies, and its value. LPS in mm, Hounsfield; or of a file's pixel."""
    if (voxel is None) == (sop is None and pixel is None):
        raise ConfigurationError(
            sentence("name a point: either --voxel I,J,K, or --sop UID with --pixel COL,ROW")
        )
    if frame is not None and (sop is None or frame < 1):
        raise ConfigurationError(
            sentence("--frame {frame}: frames count from 1 and go with --sop UID", frame=frame)
        )
    _start_reader()
    source: dict[str, Any] = {"sop_uid": sop, "frame": frame or 1}
    if voxel is not None:
        lps_mm, hu, source = _voxel(folder, series, remedy, _integers(voxel, 3, "--voxel", "I,J,K"))
    elif remedy is not None:
        raise ConfigurationError(
            sentence("--remedy goes with --voxel; a pixel lies where its file puts it")
        )
    elif sop is None or pixel is None:
        raise ConfigurationError(sentence("--sop UID and --pixel COL,ROW go together; give both"))
    else:
        lps_mm, hu = _pixel(
            folder, sop, _integers(pixel, 2, "--pixel", "COL,ROW"), (frame or 1) - 1
        )
    shown = (
        template(
            "LPS {lps_mm.0:.3f} {lps_mm.1:.3f} {lps_mm.2:.3f} mm, "
            "{hu:?{hu:g} HU|no HU: padding, nothing was measured there}"
        ),
        "{sop_uid:?SOPInstanceUID {sop_uid}, frame {frame}}" if voxel is not None else "",
    )
    return Answer({"lps_mm": lps_mm, "hu": hu, **source}, shown=shown)


@app.command()
def digest(
    folder: Folder,
    series: Annotated[
        str | None, typer.Option(help="SeriesInstanceUID, where several fit.")
    ] = None,
    remedy: Mend = None,
) -> Answer:
    """Print a digest of values and geometry, to compare programs."""
    _start_reader()
    from app.imaging.volume import digest_of

    found = digest_of(_volume(folder, series, remedy))
    rows = [
        " ".join(f"{n:.9g}" for n in found.affine_mm[4 * row : 4 * row + 4]) for row in range(3)
    ]
    size = "×".join(map(str, found.size))
    lines = [f"{name} [mm]  {row}" for name, row in zip("xyz", rows, strict=True)]
    values = sentence(
        "values  sha256 {digest} of {size} {kind}", digest=found.values, size=size, kind=found.kind
    )
    return Answer(asdict(found), [values, *lines])


@app.command()
def path(
    folder: Folder,
    entry: Annotated[str, typer.Option(metavar="X,Y,Z", help="Entry, DICOM LPS [mm].")],
    target: Annotated[str, typer.Option(metavar="X,Y,Z", help="Target, DICOM LPS [mm].")],
    structures: Annotated[
        list[Path] | None, typer.Option(metavar="FILE", help="Structures on this CT.")
    ] = None,
    series: Annotated[
        str | None, typer.Option(help="SeriesInstanceUID, where several fit.")
    ] = None,
    lung: Annotated[
        bool, typer.Option("--lung", help="Report pleura, fissures, lung, ribs and vessels.")
    ] = False,
    alternatives: Annotated[
        int,
        typer.Option(min=0, max=8, metavar="N", help="With --lung: report N other entries too."),
    ] = 0,
) -> Answer:
    """Print what a straight path meets. Tissue after tissue, and how sure that is."""
    import numpy as np

    from app.commands.calibrate_parts import with_progress
    from app.imaging.field.making import field_of
    from app.imaging.field.walking import walk
    from app.imaging.structures.files import read_structures

    ends = np.array([_numbers(entry, "--entry"), _numbers(target, "--target")])
    _start_reader()
    volume = _volume(folder, series, None)
    reach = float(np.linalg.norm(ends[1] - ends[0])) + _BEYOND_MM
    marked = [one for file in structures or () for one in read_structures(file, volume)]
    if lung:
        from app.commands.lung_path import lung_answer

        return lung_answer(volume, marked, ends, alternatives)

    def work(progress: "Progress") -> "TissueField":
        return field_of(volume, marked, ends[0], reach, progress=progress)

    field = with_progress(work)
    rows = []
    for part in walk(field, ends):
        tissue = field.tissues[part.code]
        rows.append(
            {
                "kind": tissue.kind.value,
                "name": tissue.name,
                "words": tissue.words,
                "begin_mm": part.begin_mm,
                "length_mm": part.length_mm,
                "angle_deg": part.angle_deg,
                "confidence": tissue.confidence,
                "source": tissue.source,
            }
        )
    facts = {"digest": field.digest, "notes": list(field.notes), "tissues": rows}
    row = "{begin_mm:6.1f} mm  {words}, {length_mm:.1f} mm  ({source:?{source}, }{confidence:.0%})"
    return Answer(facts, shown=(Each("tissues", row), Each("notes", "note: {}")))


_BEYOND_MM = 10.0


def _numbers(text: str, option: str) -> list[float]:
    """Read three numbers of an option.

    Raises:
        ConfigurationError: if they are none.
    """
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError as error:
        raise ConfigurationError(
            sentence("{option} {point!r}: three numbers X,Y,Z in mm", option=option, point=text)
        ) from error
    return [x, y, z]


@app.command("import")
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


@library.command("list")
def list_entries() -> Answer:
    """List the CTs of the library."""
    from app.imaging.library import CtLibrary

    entries = CtLibrary().entries()
    lines = []
    for entry in entries:
        remedy = entry.remedy
        parts = [
            f"{entry.name}  {entry.label}",
            counted("{n} file", "{n} files", entry.files),
            "" if remedy == "none" else sentence("opens with --remedy {remedy}", remedy=remedy),
            str(entry.folder),
        ]
        lines.append(joined("  ", filter(None, parts)))
    empty = sentence("the library is empty; `acus ct import DIR` takes a CT in")
    return Answer({"entries": [_entry(entry) for entry in entries]}, lines or [empty])


@library.command("remove")
def remove(name: Annotated[str, typer.Argument(metavar="NAME", help="Which CT.")]) -> Answer:
    """Delete a CT from the library."""
    from app.imaging.library import CtLibrary

    CtLibrary().remove(name)
    return list_entries()


def imported_answer(imported: "Imported") -> Answer:
    """Return what a command has taken into the library."""
    return Answer(_imported(imported), _imported_lines(imported))


def _imported(imported: "Imported") -> dict[str, Any]:
    return {
        **_entry(imported.entry),
        "again": imported.again,
        "before": imported.before,
        "given": imported.given,
        "report": imported.report.document(),
    }


def _imported_lines(imported: "Imported") -> list[str]:
    entry = imported.entry
    head: str = sentence(
        "{name}: {label}, {files}: {content}",
        name=entry.name,
        label=entry.label,
        files=counted("{n} file", "{n} files", entry.files),
        content=imported.words,
    )
    if entry.remedy != "none":
        head += sentence("; it opens with --remedy {remedy}", remedy=entry.remedy)
    report = [joined("", ("  ", line)) for line in imported.report.lines()]
    return [head, *report, f"  {entry.folder}"]


def _entry(entry: "LibraryEntry") -> dict[str, Any]:
    return {
        "name": entry.name,
        "label": entry.label,
        "files": entry.files,
        "remedy": entry.remedy,
        "folder": str(entry.folder),
    }


def remedy_of(text: str | None) -> str:
    """Read `--remedy`.

    Raises:
        ConfigurationError: listing what there is.
    """
    from app.imaging.remedies import remedies
    from app.imaging.series import NO_REMEDY

    valid = [one.name for one in remedies()]
    if text is not None and text not in valid:
        raise ConfigurationError(
            sentence("--remedy {remedy!r} is none of {valid}", remedy=text, valid=", ".join(valid))
        )
    return NO_REMEDY if text is None else text


def boxes_of(masks: list[str] | None) -> list["MaskBox"]:
    """Read the boxes of `--mask`.

    Raises:
        ConfigurationError, BurnedInError: naming the one that is none.
    """
    return [_box(text) for text in masks or ()]


def _box(text: str) -> "MaskBox":
    from app.imaging.privacy.burned_in import MaskBox

    try:
        numbers = [int(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (4, 5):
        raise ConfigurationError(
            sentence(
                "--mask {mask!r} is not COL,ROW,WIDTH,HEIGHT or COL,ROW,WIDTH,HEIGHT,PICTURE: "
                "four or five whole numbers, no blanks",
                mask=text,
            )
        )
    return MaskBox(*numbers)


def _voxel(
    folder: Path, series_uid: str | None, remedy: str | None, ijk: list[int]
) -> tuple[list[float], float | int | None, dict[str, Any]]:
    """Point and value of a voxel, and the picture that it stands in, where it stands in one."""
    from app.imaging.errors import OutsideImageError
    from app.imaging.reading import is_padding

    volume = _volume(folder, series_uid, remedy)
    if not all(0 <= index < size for index, size in zip(ijk, volume.size, strict=True)):
        limits = ", ".join(
            f"{name} 0 to {n - 1}" for name, n in zip("IJK", volume.size, strict=True)
        )
        raise OutsideImageError(
            sentence("voxel {ijk} is outside the series: {limits}", ijk=tuple(ijk), limits=limits)
        )
    i, j, k = ijk
    slices = volume.series.slices if not volume.made else ()
    header = slices[k] if len(slices) == volume.size[2] else None
    source = {
        "sop_uid": None if header is None else header.identity.sop_uid,
        "frame": None if header is None else header.frame + 1,
    }
    hu = None if is_padding(volume, (i, j, k)) else _plain(volume.hu[k, j, i].item())
    return volume.lps_mm(ijk).tolist(), hu, source


def _volume(folder: Path, series_uid: str | None, remedy: str | None) -> "Volume":
    """Read a series; what was done to it on request is said on the error stream."""
    from app.imaging.reading import choose, load_ct, read_with
    from app.imaging.scanning import scan_folder

    if remedy is None:
        return load_ct(folder, series_uid)
    asked = remedy_of(remedy)
    listing = scan_folder(folder)
    volume = read_with(choose(listing, series_uid, asked), asked)
    for words in volume.made:
        typer.echo(words, err=True)
    return volume


def _start_reader() -> None:
    """Start the process that reads files: it comes up while the rest is still loaded."""
    from app.imaging.worker.pool import shared_worker

    shared_worker().warm()


def _pixel(
    folder: Path, sop: str, place: list[int], frame: int
) -> tuple[list[float], float | int | None]:
    from app.imaging.reading import pixel_lps_mm

    column, row = place
    lps_mm, hu = pixel_lps_mm(folder, sop, column, row, frame=frame)
    return lps_mm.tolist(), None if hu is None else _plain(hu)


def _plain(hu: float) -> float | int:
    return int(hu) if float(hu).is_integer() else hu


def _integers(text: str, count: int, option: str, form: str) -> list[int]:
    try:
        numbers = [int(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count:
        raise ConfigurationError(
            sentence(
                "{option} {argument!r} is not {form}: {count} whole numbers, no blanks",
                option=option,
                argument=text,
                form=form,
                count=count,
            )
        )
    return numbers


def _listing(listing: "Listing") -> dict[str, Any]:
    return {
        "series": [_series(series) for series in listing.series],
        "ignored": [
            {"file": listing.shown(file.path), "reason": file.reason} for file in listing.ignored
        ],
    }


def _series(series: "Series") -> dict[str, Any]:
    return {
        "uid": series.uid,
        "modality": series.modality,
        "label": series.label,
        "pseudonym": series.pseudonym,
        "size": list(series.size),
        "spacing_mm": _list(series.spacing_mm),
        "origin_mm": _list(series.origin_mm),
        "direction": _list(series.direction),
        "files": len(series.files),
        "usable": series.usable,
        "reason": series.reason,
        "key": series.key,
        "part": series.part,
        "remedy": series.remedy,
        "notes": list(series.notes),
        "unit": series.unit,
        "tilt_deg": series.tilt_deg,
        "frame_of_reference": series.frame_of_reference,
        "slices": [
            {"sop_uid": header.identity.sop_uid, "frame": header.frame + 1}
            for header in series.slices
        ],
    }


def _list(values: tuple[float, ...] | None) -> list[float] | None:
    return None if values is None else list(values)


def _line(series: "Series") -> str:
    size = "×".join(str(n) for n in series.size)
    spacing = "" if series.spacing_mm is None else " ".join(f"{s:.4g}" for s in series.spacing_mm)
    origin = "" if series.origin_mm is None else " ".join(f"{v:.2f}" for v in series.origin_mm)
    direction = "" if series.direction is None else " ".join(f"{v:.4g}" for v in series.direction)
    remedies = ", ".join(series.remedies)
    parts = [
        sentence("usable ") if series.usable else sentence("refused"),
        f"{series.modality} {size}",
        sentence("spacing {spacing} mm", spacing=spacing) if spacing else "",
        sentence("origin {origin} mm", origin=origin) if origin else "",
        sentence("direction {direction}", direction=direction) if direction else "",
        f"{series.label}, {series.pseudonym}, {series.key}",
        series.reason,
        *series.notes,
        sentence("on request: {remedies}", remedies=remedies) if remedies else "",
    ]
    return joined("  ", (part for part in parts if part))
