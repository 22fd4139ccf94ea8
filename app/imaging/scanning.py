"""Finding DICOM series in a folder: by content, at any depth, headers only."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.core.progress import Progress
from app.imaging import stack
from app.imaging.acquisitions import Group, split
from app.imaging.header import ImagePlane, Point, SliceHeader
from app.imaging.nifti import find_nifti
from app.imaging.series import Ignored, Listing, Remedy, Series
from app.imaging.sources import is_nifti, open_source
from app.imaging.suitability import Suitability, is_mr, judge
from app.imaging.worker.pool import shared_worker
from app.imaging.worker.service import read_headers


def scan_folder(path: Path | str, progress: Progress | None = None) -> Listing:
    """List every series below a folder, and every file that belongs to none.

    Args:
        path: a folder, zip archive, DICOMDIR or single file, see `open_source`.
        progress: told how far the search is; cancels it.

    Raises:
        WorkerError: if the process that reads files cannot be started.
        FolderError: if it does not exist, cannot be read, or is none of these.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    shared_worker().warm()  # it comes up while the folder is searched
    source = open_source(Path(path), progress)
    ignored = source.ignored
    whole = [find_nifti(file, progress) for file in source.files if is_nifti(file)]
    files = [file for file in source.files if not is_nifti(file)]
    headers: list[SliceHeader] = []
    begin = 0.0 if source.keeper is None else 0.5
    for found in read_headers(files, progress.part(begin, 1.0)) if files else ():
        if isinstance(found, Ignored):
            ignored.append(found)
        else:
            headers.extend(found)
    groups: dict[str, list[SliceHeader]] = {}
    for header in headers:
        groups.setdefault(header.identity.series_uid, []).append(header)
    series = [
        _series(part, source.root) for _, group in sorted(groups.items()) for part in split(group)
    ]
    series.extend(found for found in whole if isinstance(found, Series))
    ignored.extend(found for found in whole if isinstance(found, Ignored))
    progress.report(1.0, f"{len(series)} series")
    return Listing(source.path, tuple(series), tuple(ignored), source.root, source.keeper)


def _series(group: Group, root: Path) -> Series:
    headers = list(group.headers)
    verdict = judge(group, root)
    planes = [header.plane for header in headers if header.plane is not None]
    grid = _Grid()
    if len(planes) == len(headers) and not stack.mixed(planes):
        size = (headers[0].format.columns, headers[0].format.rows)
        slices = stack.stack(planes, size)
        headers = [headers[index] for index in slices.order]
        grid = _grid(planes[0], slices)
    if verdict.reason and verdict.remedy is Remedy.NONE:
        headers.extend(group.copies)  # of what cannot be read every file is named
    return _described(headers, grid, group, verdict)


def _described(
    headers: list[SliceHeader], grid: "_Grid", group: Group, verdict: Suitability
) -> Series:
    first = headers[0]
    part = group.part.replace("-", " ")
    return Series(
        uid=first.identity.series_uid,
        modality=first.identity.modality,
        label=", ".join(filter(None, (first.identity.label, part))),
        size=(first.format.columns, first.format.rows, len(headers)),
        spacing_mm=grid.spacing_mm,
        origin_mm=grid.origin_mm,
        direction=grid.direction,
        usable=not verdict.reason,
        reason=verdict.reason,
        slices=tuple(headers),
        pseudonym=first.identity.pseudonym,
        frame_of_reference=_shared_frame(headers),
        windows=first.windows,
        former=first.identity.former,
        part=group.part,
        remedy=verdict.remedy,
        notes=(*verdict.notes, *_frame_notes(headers)),
        unit="" if is_mr(headers) else "HU",
        tilt_deg=verdict.tilt_deg,
    )


def _shared_frame(headers: list[SliceHeader]) -> str:
    """Frame of reference of all files; empty where some de-identifier gave each its own."""
    frames = {header.identity.frame_of_reference for header in headers}
    return frames.pop() if len(frames) == 1 else ""


def _frame_notes(headers: list[SliceHeader]) -> tuple[str, ...]:
    frames = {header.identity.frame_of_reference for header in headers}
    if len(frames) < 2:
        return ()
    if "" in frames:
        return (
            "some of its files name no frame of reference: they lie together only if whoever "
            "wrote them left it out",
        )
    return (
        f"its files name {len(frames)} frames of reference: they lie together only if whoever "
        "de-identified them gave each a number of its own",
    )


@dataclass(frozen=True, slots=True)
class _Grid:
    """Geometry of a series as far as it is known, see `Series`."""

    spacing_mm: Point | None = None
    origin_mm: Point | None = None
    direction: tuple[float, ...] | None = None


def _grid(plane: ImagePlane, slices: stack.Stack) -> _Grid:
    between = float(np.linalg.norm(slices.affine_mm[:3, 2]))
    spacing = (plane.pixel_spacing_mm[1], plane.pixel_spacing_mm[0], between)
    at_one_place = slices.gaps_mm.sum() < stack.TOLERANCE_MM
    axes = (plane.orientation[:3], plane.orientation[3:], stack.normal(plane))
    x, y, z = slices.affine_mm[:3, 3].tolist()
    return _Grid(
        None if at_one_place else spacing,
        (x, y, z),
        tuple((np.stack(axes, axis=1).ravel() + 0.0).tolist()),  # + 0.0: no negative zeros
    )
