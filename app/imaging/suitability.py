"""Why a group of files is not a CT series that a volume can be made of."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

from app.imaging import stack
from app.imaging.header import SliceHeader

_CT_IMAGE: Final = "1.2.840.10008.5.1.4.1.1.2"
_MULTI_FRAME_CT: Final = (
    "1.2.840.10008.5.1.4.1.1.2.1",  # enhanced
    "1.2.840.10008.5.1.4.1.1.2.2",  # legacy converted enhanced
)
_SECONDARY_CAPTURE: Final = "1.2.840.10008.5.1.4.1.1.7"

Headers = Sequence[SliceHeader]


def refusal(headers: Headers, root: Path) -> str:
    """First reason against reading these files as one CT volume, in plain words; "" if none.

    Args:
        headers: every file of one SeriesInstanceUID.
        root: the folder that was searched; files are named relative to it.
    """
    for judge in _JUDGES:
        if reason := judge(headers, root):
            return reason
    return ""


def display_name(header: SliceHeader, root: Path) -> str:
    """Path of a file relative to the searched folder."""
    try:
        return str(header.path.relative_to(root))
    except ValueError:
        return str(header.path)


def _first(headers: Headers, root: Path, wrong: Callable[[SliceHeader], str]) -> str:
    """First complaint over all files, with the file and how many more there are."""
    found = [(header, reason) for header in headers if (reason := wrong(header))]
    if not found:
        return ""
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return f"{found[0][1]}: {display_name(found[0][0], root)}{more}"


def _modality(headers: Headers, root: Path) -> str:
    others = sorted({header.identity.modality or "none given" for header in headers} - {"CT"})
    return f"not CT (modality {', '.join(others)})" if others else ""


def _object(header: SliceHeader) -> str:
    kind, image_type = header.identity.sop_class, header.identity.image_type
    if kind in _MULTI_FRAME_CT or header.format.frames > 1:
        frames = header.format.frames
        return f"enhanced multi-frame CT ({frames} frames in a file), which is not read yet"
    if header.format.samples > 1 or header.format.photometric not in ("MONOCHROME1", "MONOCHROME2"):
        what = header.format.photometric or "no photometric interpretation"
        return f"not a CT image but a picture ({what}, secondary capture)"
    if kind.startswith(_SECONDARY_CAPTURE):
        return "secondary capture, not an original CT image"
    if kind != _CT_IMAGE:
        return f"not a CT image (SOP class {kind or 'missing'})"
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


def _geometry(headers: Headers, root: Path) -> str:
    if len(headers) < 2:
        return "a single slice; a volume needs at least two"
    slices = stack.stack([header.plane for header in headers if header.plane])
    names = [display_name(headers[index], root) for index in slices.order]
    return stack.irregular(slices, names)


_JUDGES: Final = (_modality, _wrong_object, _damaged, _wrong_pixels, _mixed, _geometry)
