"""`acus structures`: what a file of structures holds, on which CT, and how far a plan keeps off."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from app.imaging.structures.structure import StructureSet
    from app.imaging.volume import Volume

app = typer.Typer(
    help="Structures (SEG, RTSTRUCT, .seg.nrrd, NIfTI labels) of a CT: list, import, export."
)

Files = Annotated[
    list[Path], typer.Argument(metavar="FILE…", help="DICOM SEG, RTSTRUCT, .seg.nrrd or NIfTI.")
]
Folder = Annotated[Path, typer.Option("--ct", metavar="DIR", help="Folder of the CT.")]
Uid = Annotated[str | None, typer.Option("--series", help="SeriesInstanceUID, if several fit.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON; the keys stand in docs/json.md.")]


def register(root: typer.Typer) -> None:
    """Add `structures` to the command line."""
    root.add_typer(app, name="structures", no_args_is_help=True)


@app.command("list")
def list_structures(files: Files, ct: Folder, series: Uid = None, as_json: AsJson = False) -> None:
    """List the structures of files as they lie on a CT: kind, size, place, and what was lost."""
    structures, _ = _read(files, ct, series)
    if as_json:
        typer.echo(json.dumps(_document(structures), indent=2))
        return
    for one in structures:
        x, y, z = one.centre_mm
        warn = f"warns within {one.warn_mm:g} mm" if one.warn_mm else "never warns"
        typer.echo(f"{one.name}  {one.kind}  {one.millilitres:.2f} ml  "
                   f"centre LPS {x:.1f} {y:.1f} {z:.1f} mm  {warn}")  # fmt: skip
    for note in structures.notes:
        typer.echo(f"note  {note}")


@app.command()
def export(
    files: Files,
    ct: Folder,
    out: Annotated[Path, typer.Option(help="File to write: .seg.nrrd, or .dcm for DICOM SEG.")],
    series: Uid = None,
) -> None:
    """Write structures anew on the grid of their CT, as .seg.nrrd (3D Slicer) or DICOM SEG."""
    from app.imaging.structures.files import write_structures

    structures, volume = _read(files, ct, series)
    write_structures(out, structures, volume)
    typer.echo(f"{out}: {len(structures)} structures")
    for note in structures.notes:
        typer.echo(f"note  {note}")


@app.command()
def distance(
    files: Files,
    ct: Folder,
    plan: Annotated[Path, typer.Option(metavar="FILE", help="Plan, .mrk.json.")],
    series: Uid = None,
    as_json: AsJson = False,
) -> None:
    """Signed distance of a plan's path from each structure: negative where it runs through it."""
    from app.exchange.markups import read_plan
    from app.imaging.structures.distance import SignedDistance
    from app.planning.clearance import clearances

    structures, _ = _read(files, ct, series)
    path = read_plan(plan)
    fields = [(one, SignedDistance.of(one)) for one in structures]
    found = clearances(path.entry_mm, path.target_mm, fields)
    if as_json:
        typer.echo(json.dumps([
            {"name": one.structure.name, "kind": one.structure.kind.value,
             "distance_mm": round(one.distance_mm, 3), "depth_mm": round(one.depth_mm, 3),
             "through_mm": round(one.through_mm, 3), "at_mm": one.at_mm.tolist(),
             "accuracy_mm": round(one.accuracy_mm, 3), "nearness": one.nearness.value}
            for one in found], indent=2))  # fmt: skip
        return
    for one in found:
        through = f", {one.through_mm:.1f} mm inside" if one.through_mm else ""
        typer.echo(f"{one.structure.name}  {one.distance_mm:+.1f} ± {one.accuracy_mm:.1f} mm  "
                   f"at depth {one.depth_mm:.1f} mm{through}  {one.nearness}")  # fmt: skip


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
            {"name": one.name, "kind": one.kind.value, "colour": list(one.colour),
             "millilitres": round(one.millilitres, 4), "centre_mm": one.centre_mm.tolist(),
             "voxels": int(one.mask.sum()), "corner": list(one.corner),
             "size": list(one.mask.shape[::-1]), "warn_mm": one.warn_mm}
            for one in structures
        ],
        "notes": list(structures.notes),
    }  # fmt: skip
