"""Why a group of images is not a series that a volume can be made of, and what can be done."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.imaging import memory, stack
from app.imaging.acquisitions import SECONDARY_CAPTURE, Group
from app.imaging.header import MULTI_FRAME, SliceHeader
from app.imaging.series import Remedy

_CT_IMAGE: Final = "1.2.840.10008.5.1.4.1.1.2"
_MR_IMAGE: Final = "1.2.840.10008.5.1.4.1.1.4"
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
        remedy: what would make it readable, or better, on request.
        notes: what should be known of it all the same.
        tilt_deg: gantry tilt [degrees].
    """

    reason: str
    remedy: Remedy = Remedy.NONE
    notes: tuple[str, ...] = ()
    tilt_deg: float = 0.0


def judge(group: Group, root: Path) -> Suitability:
    """Whether these images make a volume.

    Args:
        group: images of one series.
        root: the folder that was searched; files are named relative to it.
    """
    headers = group.headers
    for wrong in _JUDGES:
        if reason := wrong(headers, root):
            return Suitability(reason, notes=group.notes)
    slices = _stack(headers)
    tilt = slices.tilt_deg
    names = _Names(headers, slices.order, root)
    if reason := stack.doubled(slices, names) or stack.turned(slices, names):
        return Suitability(reason, notes=group.notes, tilt_deg=tilt)
    notes = (*group.notes, *_notes(headers, tilt), *_gap_notes(headers, slices))
    if reason := stack.irregular(slices, names):
        return Suitability(reason, Remedy.RESAMPLE, notes, tilt)
    if reason := memory.need(headers).reason:
        return Suitability(reason, Remedy.HALVE, notes, tilt)
    return Suitability("", Remedy.STRAIGHTEN if tilt else Remedy.NONE, notes, tilt)


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
    """Whether all images are MR."""
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
            notes.append("direction cosines not of length one: taken as they are written")
    return notes


def _gap_notes(headers: Headers, slices: stack.Stack) -> list[str]:
    """Say that most of the body between the slices was not scanned, where that is so."""
    thickness = max((header.thickness_mm or 0.0 for header in headers), default=0.0)
    between = float(np.median(slices.gaps_mm))
    if not 0.0 < thickness * SPARSE <= between:
        return []
    return [
        f"slices lie {between:.1f} mm apart and are {thickness:.3g} mm thick: what is shown "
        "between them is interpolated, nothing there was scanned"
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
    return f"not CT (modality {', '.join(others)})" if others else ""


def _object(header: SliceHeader) -> str:
    kind, image_type = header.identity.sop_class, header.identity.image_type
    modality, frames = header.identity.modality, header.format.frames
    if header.obstacle:
        return header.obstacle
    if header.format.samples > 1 or header.format.photometric not in ("MONOCHROME1", "MONOCHROME2"):
        what = header.format.photometric or "no photometric interpretation"
        return f"not a CT image but a picture ({what}, secondary capture)"
    if kind.startswith(SECONDARY_CAPTURE):
        return "secondary capture, not an original CT image"
    if kind in MULTI_FRAME and modality in MULTI_FRAME[kind]:
        return ""
    if frames > 1:
        return f"multi-frame file ({frames} frames) that does not say where each of them lies"
    if kind != (_MR_IMAGE if modality == "MR" else _CT_IMAGE):
        what = "not CT but MR, and not an MR image" if modality == "MR" else "not a CT image"
        return f"{what} (SOP class {kind or 'missing'})"
    if "MOSAIC" in image_type:
        return "a mosaic: many slices side by side in one picture, which says of none where it lies"
    if "LOCALIZER" in image_type:
        return "localizer (scout view), not a volume"
    return ""


def _wrong_object(headers: Headers, root: Path) -> str:
    return _first(headers, root, _object)


def _damaged(headers: Headers, root: Path) -> str:
    return _first(headers, root, lambda header: header.damage and f"damaged file ({header.damage})")


def _bits(header: SliceHeader) -> str:
    form = header.format
    if form.bits_allocated not in (8, 16):
        return f"{form.bits_allocated} bits per pixel are not supported (8 or 16 are)"
    if not 1 <= form.bits_stored <= form.high_bit + 1 <= form.bits_allocated:
        return (
            f"BitsStored {form.bits_stored}, HighBit {form.high_bit} and BitsAllocated "
            f"{form.bits_allocated} contradict each other"
        )
    if form.rows < 1 or form.columns < 1:
        return f"no pixels: {form.columns} columns × {form.rows} rows"
    if header.rescale is None:
        return "no Hounsfield units (RescaleSlope and RescaleIntercept missing, or another unit)"
    if header.plane is None:
        return "ImagePositionPatient, ImageOrientationPatient or PixelSpacing missing"
    return ""


def _wrong_pixels(headers: Headers, root: Path) -> str:
    return _first(headers, root, _bits)


def _mixed(headers: Headers, root: Path) -> str:
    sizes = {(header.format.columns, header.format.rows) for header in headers}
    if len(sizes) > 1:
        return "mixed image sizes: " + ", ".join(f"{c}×{r}" for c, r in sorted(sizes))
    return stack.mixed([header.plane for header in headers if header.plane])


def _single(headers: Headers, root: Path) -> str:
    return "a single slice; a volume needs at least two" if len(headers) < 2 else ""


_JUDGES: Final = (_modality, _wrong_object, _damaged, _wrong_pixels, _mixed, _single)
