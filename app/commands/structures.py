"""`acus structures`: what a file of structures holds, on which CT, and how far a plan keeps off."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer, Commands
from app.commands.shown import Each
from app.core.messages import joined, sentence

if TYPE_CHECKING:
    from app.imaging.structures.structure import StructureSet
    from app.imaging.volume import Volume

app = Commands(help="Structures of a CT: list, export, distance to a plan.")

Files = Annotated[
    list[Path], typer.Argument(metavar="FILE…", help="DICOM SEG, RTSTRUCT, .seg.nrrd or NIfTI.")
]
Folder = Annotated[Path, typer.Option("--ct", metavar="DIR", help="Folder of the CT.")]
Uid = Annotated[str | None, typer.Option("--series", help="SeriesInstanceUID, if several fit.")]


RANK = 60


def register(root: typer.Typer) -> None:
    """Add `structures` to the command line."""
    root.add_typer(app, name="structures")


@app.command("list")
def list_structures(files: Files, ct: Folder, series: Uid = None) -> Answer:
    """List structures as they lie on a CT. Kind, size, place, and what was lost."""
    structures, _ = _read(files, ct, series)
    lines = []
    for one in structures:
        x, y, z = one.centre_mm
        warn = sentence("never warns")
        if one.warn_mm:
            warn = sentence("warns within {warn_mm:g} mm", warn_mm=one.warn_mm)
        lines.append(
            sentence(
                "{name}  {kind}  {millilitres:.2f} ml  centre LPS {place} mm  {warn}",
                name=one.name,
                kind=one.kind,
                millilitres=one.millilitres,
                place=f"{x:.1f} {y:.1f} {z:.1f}",
                warn=warn,
            )
        )
    return Answer(_document(structures), lines + _notes(structures))


@app.command()
def export(
    files: Files,
    ct: Folder,
    out: Annotated[Path, typer.Option(help="File to write: .seg.nrrd, or .dcm for DICOM SEG.")],
    series: Uid = None,
) -> Answer:
    """Write structures anew on the grid of their CT.

    As .seg.nrrd (3D Slicer) or DICOM SEG.
    """
    from app.imaging.structures.files import write_structures

    structures, volume = _read(files, ct, series)
    write_structures(out, structures, volume)
    facts = {"files": [out], "structures": len(structures), "notes": list(structures.notes)}
    return Answer(facts, shown=("{files}: {structures} structures", Each("notes", "note  {}")))


@app.command()
def distance(
    files: Files,
    ct: Folder,
    plan: Annotated[Path, typer.Option(metavar="FILE", help="Plan, .mrk.json.")],
    series: Uid = None,
) -> Answer:
    """Print how far a plan keeps off each structure. Negative where it runs through one."""
    from app.exchange.markups import read_plan
    from app.imaging.structures.distance import SignedDistance
    from app.planning.clearance import clearances

    structures, _ = _read(files, ct, series)
    path = read_plan(plan)
    fields = [(one, SignedDistance.of(one)) for one in structures]
    found = clearances(path.entry_mm, path.target_mm, fields)
    rows = [
        {
            "name": one.structure.name,
            "kind": one.structure.kind.value,
            "distance_mm": round(one.distance_mm, 3),
            "depth_mm": round(one.depth_mm, 3),
            "through_mm": round(one.through_mm, 3),
            "at_mm": one.at_mm.tolist(),
            "accuracy_mm": round(one.accuracy_mm, 3),
            "nearness": one.nearness.value,
        }
        for one in found
    ]
    lines = []
    for one in found:
        far = f"{one.distance_mm:+.1f} ± {one.accuracy_mm:.1f} mm"
        where: str = sentence("at depth {depth_mm:.1f} mm", depth_mm=one.depth_mm)
        if one.through_mm:
            where += sentence(", {inside_mm:.1f} mm inside", inside_mm=one.through_mm)
        lines.append(joined("  ", (one.structure.name, far, where, one.nearness)))
    return Answer({"structures": rows}, lines)


def _notes(structures: "StructureSet") -> list[str]:
    return [sentence("note  {note}", note=note) for note in structures.notes]


def _read(files: list[Path], ct: Path, series: str | None) -> "tuple[StructureSet, Volume]":
    from app.imaging.reading import load_ct
    from app.imaging.structures.files import read_structures
    from app.imaging.structures.structure import StructureSet

    volume = load_ct(ct, series)
    structures = StructureSet()
    for file in files:
        structures = structures.united(read_structures(file, volume))
    return structures, volume


def _document(structures: "StructureSet") -> dict[str, Any]:
    return {
        "structures": [
            {
                "name": one.name,
                "kind": one.kind.value,
                "colour": list(one.colour),
                "millilitres": round(one.millilitres, 4),
                "centre_mm": one.centre_mm.tolist(),
                "voxels": int(one.mask.sum()),
                "corner": list(one.corner),
                "size": list(one.mask.shape[::-1]),
                "warn_mm": one.warn_mm,
            }
            for one in structures
        ],
        "notes": list(structures.notes),
    }
