"""Finding DICOM series in a folder: by content, at any depth, headers only."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.core.progress import Progress
from app.imaging import stack
from app.imaging.acquisitions import Group, split
from app.imaging.errors import FolderError
from app.imaging.header import Plane, Point, SliceHeader
from app.imaging.series import Ignored, Listing, Remedy, Series
from app.imaging.suitability import Verdict, is_mr, judge
from app.imaging.worker.service import examine_files


def scan_folder(path: Path | str, progress: Progress | None = None) -> Listing:
    """List every DICOM series below a folder, and every file that belongs to none.

    Args:
        path: a folder; all depths are searched, links to folders are not followed.
        progress: told how far the search is; cancels it.

    Raises:
        FolderError: if it does not exist, is no folder, or cannot be listed.
        Cancelled: if `progress` was cancelled.
    """
    root = Path(path)
    progress = progress or Progress()
    ignored: list[Ignored] = []
    files = _files(root, ignored, progress)
    headers: list[SliceHeader] = []
    for found in examine_files(files, progress):
        if isinstance(found, Ignored):
            ignored.append(found)
        else:
            headers.extend(found)
    groups: dict[str, list[SliceHeader]] = {}
    for header in headers:
        groups.setdefault(header.identity.series_uid, []).append(header)
    series = tuple(
        _series(part, root) for _, group in sorted(groups.items()) for part in split(group)
    )
    progress.report(1.0, f"{len(series)} series")
    return Listing(root, series, tuple(ignored))


def _files(root: Path, ignored: list[Ignored], progress: Progress) -> list[Path]:
    try:
        os.scandir(root).close()
    except FileNotFoundError:
        raise FolderError(f"{root} does not exist; name a folder with DICOM files") from None
    except NotADirectoryError:
        raise FolderError(f"{root} is a file; name the folder it is in") from None
    except (OSError, ValueError) as error:
        raise FolderError(f"{root} cannot be read: {_why(error)}") from error

    def unreadable(error: OSError) -> None:
        ignored.append(Ignored(Path(error.filename), f"folder cannot be read: {_why(error)}"))

    found: list[Path] = []
    for folder, folders, names in os.walk(root, onerror=unreadable):
        progress.report(0.0, f"{len(found)} files found")
        folders.sort()
        found.extend(Path(folder, name) for name in sorted(names))
    return found


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


def _described(headers: list[SliceHeader], grid: "_Grid", group: Group, verdict: Verdict) -> Series:
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
        notes=verdict.notes,
        unit="" if is_mr(headers) else "HU",
        tilt_deg=verdict.tilt_deg,
    )


def _shared_frame(headers: list[SliceHeader]) -> str:
    """Frame of reference of all files; empty where some de-identifier gave each its own."""
    frames = {header.identity.frame_of_reference for header in headers}
    return frames.pop() if len(frames) == 1 else ""


def _why(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error)


@dataclass(frozen=True, slots=True)
class _Grid:
    """Geometry of a series as far as it is known, see `Series`."""

    spacing_mm: Point | None = None
    origin_mm: Point | None = None
    direction: tuple[float, ...] | None = None


def _grid(plane: Plane, slices: stack.Stack) -> _Grid:
    between = float(np.linalg.norm(slices.affine_mm[:3, 2]))
    spacing = (plane.pixel_spacing_mm[1], plane.pixel_spacing_mm[0], between)
    axes = (plane.orientation[:3], plane.orientation[3:], stack.normal(plane))
    x, y, z = slices.affine_mm[:3, 3].tolist()
    return _Grid(
        spacing if len(slices.order) > 1 else None,
        (x, y, z),
        tuple((np.stack(axes, axis=1).ravel() + 0.0).tolist()),  # + 0.0: no negative zeros
    )
