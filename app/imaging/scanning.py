"""Finding DICOM series in a folder: by content, at any depth, headers only.

Of a group of images that a volume cannot be made of it is said why, and what can be done.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core.messages import counted, sentence
from app.core.progress import Progress
from app.imaging import memory, stack
from app.imaging.acquisitions import Group
from app.imaging.header import CT_IMAGE, MR_IMAGE, MULTI_FRAME, ImagePlane, Point, SliceHeader
from app.imaging.nifti import find_nifti
from app.imaging.pixel_finding import TRUNCATED
from app.imaging.remedies import offered
from app.imaging.series import Ignored, Listing, Refusal, Series
from app.imaging.sorting import SECONDARY_CAPTURE, split
from app.imaging.sources import is_nifti, open_source
from app.imaging.units import caveat
from app.imaging.worker.pool import shared_worker
from app.imaging.worker.service import read_headers

PRACTICE: Final = "MR, for practice only: its values are no Hounsfield units"

_NOT_UNIT: Final = 1e-5

SPARSE: Final = 2.0
"""Distance of slices in thicknesses from which it is said that most was not scanned."""

Headers = Sequence[SliceHeader]


@dataclass(frozen=True, slots=True)
class Suitability:
    """Whether a group of images makes a volume, and what else is known of it.

    Attributes:
        reason: first reason against reading it as a volume, in plain words; empty if none.
        refusal: which kind of reason it is.
        notes: what should be known of it all the same.
        tilt_deg: gantry tilt [degrees].
    """

    reason: str
    refusal: Refusal = Refusal.NOTHING
    notes: tuple[str, ...] = ()
    tilt_deg: float = 0.0


def judge(group: Group, root: Path) -> Suitability:
    """Return whether these images make a volume.

    Args:
        group: images of one series.
        root: the folder that was searched; files are named relative to it.
    """
    headers = group.headers
    if group.obstacle:
        return Suitability(group.obstacle, Refusal.OTHER, group.notes)
    for wrong in _JUDGES:
        if reason := wrong(headers, root):
            return Suitability(reason, Refusal.OTHER, group.notes)
    slices = _stack(headers)
    tilt = slices.tilt_deg
    names = _Names(headers, slices.order, root)
    if reason := stack.doubled(slices, names) or stack.turned(slices, names):
        return Suitability(reason, Refusal.OTHER, group.notes, tilt)
    notes = (*group.notes, *_notes(headers, tilt), *_gap_notes(headers, slices))
    if reason := stack.irregular(slices, names):
        return Suitability(reason, Refusal.UNEVEN, notes, tilt)
    if reason := memory.need(headers).reason:
        return Suitability(reason, Refusal.TOO_LARGE, notes, tilt)
    return Suitability("", notes=notes, tilt_deg=tilt)


class _Names(Sequence[str]):
    """Names of the files in the order of a stack, made when one is asked for: mostly none is."""

    def __init__(self, headers: Headers, order: Sequence[int], root: Path) -> None:
        self._headers, self._order, self._root = headers, order, root

    def __len__(self) -> int:
        return len(self._order)

    def __getitem__(self, index: Any) -> Any:
        return _name(self._headers[self._order[index]], self._root)


def display_name(header: SliceHeader, root: Path) -> str:
    """Path of a file relative to the searched folder."""
    try:
        return str(header.path.relative_to(root))
    except ValueError:
        return str(header.path)


def is_mr(headers: Headers) -> bool:
    """Return whether all images are MR."""
    return all(header.identity.modality == "MR" for header in headers)


def _name(header: SliceHeader, root: Path) -> str:
    name = display_name(header, root)
    return f"{name} frame {header.frame + 1}" if header.format.frames > 1 else name


def _stack(headers: Headers) -> stack.Stack:
    planes = [header.plane for header in headers if header.plane]
    return stack.stack(planes, (headers[0].format.columns, headers[0].format.rows))


def _notes(headers: Headers, tilt_deg: float) -> list[str]:
    notes = [PRACTICE] if is_mr(headers) else []
    if tilt_deg:
        notes.append(f"gantry tilt {tilt_deg:.1f}°")
    plane = headers[0].plane
    if plane is not None:
        row, column = plane.orientation[:3], plane.orientation[3:]
        off = max(abs(sum(v * v for v in vector) - 1.0) for vector in (row, column))
        if off > 2.0 * _NOT_UNIT:
            notes.append(sentence("direction cosines not of length one: taken as they are written"))
    behind = sum(header.pixels.behind > 0 for header in headers)
    if behind:
        notes.append(
            counted(
                "{n} file holds bytes behind the pixels, which are left out",
                "{n} files hold bytes behind the pixels, which are left out",
                behind,
            )
        )
    if words := caveat(headers[0].identity.image_type):
        notes.append(words)
    return notes


def _gap_notes(headers: Headers, slices: stack.Stack) -> list[str]:
    """Say that most of the body between the slices was not scanned, where that is so."""
    thickness = max((header.thickness_mm or 0.0 for header in headers), default=0.0)
    between = float(np.median(slices.gaps_mm))
    if not 0.0 < thickness * SPARSE <= between:
        return []
    return [
        sentence(
            "slices lie {between:.1f} mm apart and are {thickness:.3g} mm thick: what is shown "
            "between them is interpolated, nothing there was scanned",
            between=between,
            thickness=thickness,
        )
    ]


def _first(headers: Headers, root: Path, wrong: Callable[[SliceHeader], str]) -> str:
    """First complaint over all files, with the file and how many more there are."""
    found = [(header, reason) for header in headers if (reason := wrong(header))]
    if not found:
        return ""
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return f"{found[0][1]}: {_name(found[0][0], root)}{more}"


def _modality(headers: Headers, root: Path) -> str:
    found = {header.identity.modality or "none given" for header in headers}
    if found == {"MR"}:
        return ""
    others = sorted(found - {"CT"})
    return sentence("not CT (modality {others})", others=", ".join(others)) if others else ""


def _object(header: SliceHeader) -> str:
    kind, image_type = header.identity.sop_class, header.identity.image_type
    modality, frames = header.identity.modality, header.format.frames
    if header.damage and not header.format.photometric:  # which is the damage, or part of it
        return ""
    if header.format.samples > 1 or header.format.photometric not in ("MONOCHROME1", "MONOCHROME2"):
        what = header.format.photometric or sentence("no photometric interpretation")
        return sentence(
            "not a CT image but a picture ({photometric}, secondary capture)", photometric=what
        )
    if kind.startswith(SECONDARY_CAPTURE):
        return sentence("secondary capture, not an original CT image")
    if "LOCALIZER" in image_type:
        return sentence("localizer (scout view), not a volume")
    if header.obstacle:
        return header.obstacle
    if kind in MULTI_FRAME and modality in MULTI_FRAME[kind]:
        return ""
    if frames > 1:
        return sentence(
            "multi-frame file ({frames} frames) that does not say where each of them lies",
            frames=frames,
        )
    if kind != (MR_IMAGE if modality == "MR" else CT_IMAGE):
        what = (
            sentence("not CT but MR, and not an MR image")
            if modality == "MR"
            else sentence("not a CT image")
        )
        return f"{what} (SOP class {kind or 'missing'})"
    if "MOSAIC" in image_type:
        return sentence(
            "a mosaic: many slices side by side in one picture, which says of none where it lies"
        )
    return ""


def _wrong_object(headers: Headers, root: Path) -> str:
    return _first(headers, root, _object)


def _truncated(headers: Headers, root: Path) -> str:
    """Say which images end too early; what else they lack may have been cut off."""
    images = (CT_IMAGE, MR_IMAGE, *MULTI_FRAME)
    cut = [
        header
        for header in headers
        if header.damage.startswith(TRUNCATED) and header.identity.sop_class in images
    ]
    if not cut:
        return ""
    more = f" (and {len(cut) - 1} more)" if len(cut) > 1 else ""
    return sentence(
        "{display_name} is {cut_first_damage}{more}; have it sent again",
        display_name=display_name(cut[0], root),
        cut_first_damage=cut[0].damage,
        more=more,
    )


def _damaged(headers: Headers, root: Path) -> str:
    return _first(headers, root, lambda header: header.damage and f"damaged file ({header.damage})")


def _bits(header: SliceHeader) -> str:
    form = header.format
    if form.bits_allocated not in (8, 16):
        return sentence(
            "{form_bits_allocated} bits per pixel are not supported (8 or 16 are)",
            form_bits_allocated=form.bits_allocated,
        )
    if not 1 <= form.bits_stored <= form.high_bit + 1 <= form.bits_allocated:
        return sentence(
            "BitsStored {form_bits_stored}, HighBit {form_high_bit} and BitsAllocated "
            "{form_bits_allocated} contradict each other",
            form_bits_stored=form.bits_stored,
            form_high_bit=form.high_bit,
            form_bits_allocated=form.bits_allocated,
        )
    if form.rows < 1 or form.columns < 1:
        return sentence(
            "no pixels: {form_columns} columns × {form_rows} rows",
            form_columns=form.columns,
            form_rows=form.rows,
        )
    if header.rescale is None:
        return sentence(
            "no Hounsfield units (RescaleSlope and RescaleIntercept missing, or another unit)"
        )
    if header.plane is None:
        return sentence("ImagePositionPatient, ImageOrientationPatient or PixelSpacing missing")
    return ""


def _wrong_pixels(headers: Headers, root: Path) -> str:
    return _first(headers, root, _bits)


def _mixed(headers: Headers, root: Path) -> str:
    sizes = {(header.format.columns, header.format.rows) for header in headers}
    if len(sizes) > 1:
        return sentence("mixed image sizes: ") + ", ".join(f"{c}×{r}" for c, r in sorted(sizes))
    return stack.mixed([header.plane for header in headers if header.plane])


def _single(headers: Headers, root: Path) -> str:
    return sentence("a single slice; a volume needs at least two") if len(headers) < 2 else ""


_JUDGES: Final = (_modality, _truncated, _wrong_object, _damaged, _wrong_pixels, _mixed, _single)


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
    progress.report(1.0, sentence("{count} series", count=len(series)))
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
    series = _described(headers, grid, group, verdict)
    offer = offered(series)
    if not (series.usable or offer.names):  # of what cannot be read every file is named
        series = _described([*headers, *group.copies], grid, group, verdict)
    return replace(series, remedies=offer.names, notes=(*series.notes, *offer.faults))


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
        part=group.part,
        refusal=verdict.refusal,
        notes=(*verdict.notes, *_frame_notes(headers)),
        unit="" if is_mr(headers) else "HU",
        tilt_deg=verdict.tilt_deg,
    )


def _shared_frame(headers: list[SliceHeader]) -> str:
    """Frame of reference of all files; empty where some de-identifier gave each its own."""
    frames = {header.identity.frame_of_reference for header in headers}
    return frames.pop() if len(frames) == 1 else ""


def _frame_notes(headers: list[SliceHeader]) -> tuple[str, ...]:
    frames = {h.identity.frame_of_reference for h in headers if not h.damage}
    if len(frames) < 2:
        return ()
    if "" in frames:
        return (
            sentence(
                "some of its files name no frame of reference: they lie together only if whoever "
                "wrote them left it out"
            ),
        )
    return (
        sentence(
            "its files name {frames} frames of reference: they lie together only if "
            "whoever de-identified them gave each a number of its own",
            frames=len(frames),
        ),
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
