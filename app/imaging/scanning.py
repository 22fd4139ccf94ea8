"""Finding DICOM series in a folder: by content, at any depth, headers only."""

import os
import stat
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final

import numpy as np

from app.core.progress import Progress
from app.imaging import stack
from app.imaging.errors import FileDamagedError, FolderError
from app.imaging.header import Plane, Point, SliceHeader
from app.imaging.header_reading import read_header
from app.imaging.series import Ignored, Listing, Series
from app.imaging.suitability import refusal

_PREAMBLE: Final = 132
_FIRST_GROUPS: Final = (0x0002, 0x0008)
_DICOMDIR: Final = b"1.2.840.10008.1.3.10"


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
    for index, file in enumerate(files):
        progress.report(index / len(files), f"{index} of {len(files)} files")
        found = _examine(file)
        if isinstance(found, SliceHeader):
            headers.append(found)
        else:
            ignored.append(found)
    groups: dict[str, list[SliceHeader]] = {}
    for header in headers:
        groups.setdefault(header.identity.series_uid, []).append(header)
    series = tuple(_series(group, root) for _, group in sorted(groups.items()))
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


def _why(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error)


def _examine(path: Path) -> SliceHeader | Ignored:
    try:
        if not stat.S_ISREG(path.stat().st_mode):  # opening a pipe would wait for ever
            return Ignored(path, "not a regular file")
        with path.open("rb") as stream:
            return _read(path, stream)
    except OSError as error:
        return Ignored(path, f"cannot be read: {_why(error)}")
    except FileDamagedError as error:
        return Ignored(path, f"damaged DICOM file: {error}")


def _read(path: Path, stream: BinaryIO) -> SliceHeader | Ignored:
    head = stream.read(512)
    preamble = head[_PREAMBLE - 4 : _PREAMBLE] == b"DICM"
    if not preamble and not _plausible(head):
        return Ignored(path, "empty file" if not head else "not a DICOM file")
    if _DICOMDIR in head:
        return Ignored(path, "DICOM directory (DICOMDIR), not an image")
    stream.seek(0)
    header = read_header(path, stream, forced=not preamble)
    if header is None:
        what = "DICOM, but truncated or of no series (no SeriesInstanceUID)"
        return Ignored(path, what if preamble else "not a DICOM file")
    return header


def _plausible(head: bytes) -> bool:
    """Whether bytes without a preamble start like a data set: a low group, a VR or a length."""
    if len(head) < 16:
        return False
    for order in "<>":
        group, element, length = struct.unpack_from(order + "HHL", head)
        if group in _FIRST_GROUPS and element <= 0x0100:
            explicit = head[4:6].isalpha() and head[4:6].isupper()
            if explicit or length < 4096:
                return True
    return False


def _series(headers: list[SliceHeader], root: Path) -> Series:
    reason = refusal(headers, root)
    planes = [header.plane for header in headers if header.plane is not None]
    grid = _Grid()
    if len(planes) == len(headers) and not stack.mixed(planes):
        slices = stack.stack(planes)
        headers = [headers[index] for index in slices.order]
        grid = _grid(planes[0], slices)
    first = headers[0]
    return Series(
        uid=first.identity.series_uid,
        modality=first.identity.modality,
        label=first.identity.label,
        size=(first.format.columns, first.format.rows, len(headers)),
        spacing_mm=grid.spacing_mm,
        origin_mm=grid.origin_mm,
        direction=grid.direction,
        usable=not reason,
        reason=reason,
        slices=tuple(headers),
        pseudonym=first.identity.pseudonym,
        frame_of_reference=_shared_frame(headers),
        windows=first.windows,
    )


def _shared_frame(headers: list[SliceHeader]) -> str:
    """Frame of reference of all files; empty where some de-identifier gave each its own."""
    frames = {header.identity.frame_of_reference for header in headers}
    return frames.pop() if len(frames) == 1 else ""


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
