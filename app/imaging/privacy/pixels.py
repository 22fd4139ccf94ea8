"""The pixels of a file as they are written anew: their values, and nothing else that was there.

Bytes behind the last pixel, unused bits, comments of code streams: a viewer shows none of them, and
they can hold a name. What is no more than pixels is copied bit for bit, in its own encoding.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydicom.dataset import Dataset
from pydicom.encaps import encapsulate
from pydicom.uid import UID, ExplicitVRLittleEndian, JPEGLSLossless

from app.core.messages import sentence
from app.imaging import codecs, codestream
from app.imaging.decoding import read_stored, stored_type
from app.imaging.errors import FileDamagedError
from app.imaging.header import SliceHeader
from app.imaging.pixel_data import DEFLATED, EXPLICIT_BIG, JPEG, RAW, RLE
from app.imaging.pixel_finding import Fragments, Place, frame_bytes, frame_places, walk
from app.imaging.privacy.code_streams import NotKnownError, only_pixels
from app.imaging.privacy.errors import PrivacyError

_UNLIKE = sentence("its pixels cannot be parted from what else stands with them")


def take_pixels(header: SliceHeader, original: Dataset, result: Dataset) -> tuple[UID, bool]:
    """Take the pixels of a file over into its de-identified data set.

    Args:
        header: of the file.
        original: the file, as it was read.
        result: holds the original's pixel data as they are; changed where they hold more than
            pixels.

    Returns:
        Transfer syntax to write, and whether something was left out.

    Raises:
        PrivacyError: if pixels and the rest cannot be told apart.
        FileDamagedError: if they cannot be decoded where that is needed.
    """
    syntax = header.pixels.syntax
    if syntax in RAW or syntax == DEFLATED:
        return UID(syntax), _native(header, original, result)
    return _encoded(header, original, result)


def _native(header: SliceHeader, original: Dataset, result: Dataset) -> bool:
    form = header.format
    old = bytes(original["PixelData"].value)
    needed = form.frame_bytes * max(form.frames, 1)
    order = ">" if header.pixels.syntax == EXPLICIT_BIG else "<"
    cells = np.frombuffer(old[:needed], f"{order}u{form.bits_allocated // 8}")
    new = _used_bits(cells, header, _padding(original)).tobytes()
    new += b"\0" * (needed % 2)
    if new == old:
        return False
    result["PixelData"].value = new
    return True


def _padding(original: Dataset) -> int | None:
    try:
        return int(original["PixelPaddingValue"].value)
    except (KeyError, TypeError, ValueError):
        return None


def _used_bits(cells: NDArray[Any], header: SliceHeader, padding: int | None) -> NDArray[Any]:
    """Return pixel cells without what stands in their unused bits (PS3.5 8.1.1).

    Above a signed value the bits are either all 0 or repeat its sign, as the file has it; a cell
    that is the padding value, which some write beyond the stored bits, stays.
    """
    form = header.format
    bits, low = form.bits_allocated, form.high_bit + 1 - form.bits_stored
    used = ((1 << form.bits_stored) - 1) << low
    kept = cells & cells.dtype.type(used)
    if form.signed and not np.array_equal(kept, cells):
        above = ((1 << bits) - 1) ^ ((1 << (form.high_bit + 1)) - 1)
        negative = (cells >> cells.dtype.type(form.high_bit)) & cells.dtype.type(1)
        kept = np.where(negative == 1, kept | cells.dtype.type(above), kept)
    if padding is not None:
        kept = np.where(cells == padding % (1 << bits), cells, kept)
    return kept.astype(cells.dtype)


def _encoded(header: SliceHeader, original: Dataset, result: Dataset) -> tuple[UID, bool]:
    form = header.format
    old = bytes(original["PixelData"].value)
    fragments, places = _laid_out(old, max(form.frames, 1))
    stream = BytesIO(old)
    frames = [frame_bytes(stream, place) for place in places]
    syntax = header.pixels.syntax
    drawn_over = _drawn_over(original)
    if drawn_over or any(_hides_bits(frame, header) for frame in frames):
        return _anew(header, result, drawn_over)
    try:
        kept = [only_pixels(frame, syntax, form.rows * form.columns) for frame in frames]
    except NotKnownError:
        return _anew(header, result, False)
    if kept == frames and _is_tidy(fragments, places):
        return UID(syntax), False
    for before, after in zip(frames, kept, strict=True):
        if before != after and not _decode_alike(header, before, after):
            raise PrivacyError(_UNLIKE)
    result["PixelData"].value = encapsulate(kept, has_bot=len(kept) > 1)
    return UID(syntax), True


def _laid_out(value: bytes, frames: int) -> tuple[Fragments, tuple[tuple[Place, ...], ...]]:
    end = b"\xfe\xff\xdd\xe0\0\0\0\0"
    stream = BytesIO(value if value.endswith(end) else value + end)
    fragments = walk(stream, 0, len(value))
    return fragments, frame_places(stream, fragments, frames)


def _is_tidy(fragments: Fragments, places: Sequence[Sequence[Place]]) -> bool:
    """Tell whether the offset table is empty, or says where the frames stand and nothing else."""
    first = fragments.places[0][0] - 8
    starts = tuple(place[0][0] - 8 - first for place in places)
    table = first - 8  # bytes of the table's item without its head
    return table == 0 or (table == 4 * len(starts) and fragments.offsets == starts)


def _drawn_over(original: Dataset) -> bool:
    """Tell whether an overlay lies in the unused bits of the pixels (PS3.5 8.1.2, retired)."""
    return any(
        tag.group & 0xFF00 == 0x6000 and tag.element == 0x0102 and int(original[tag].value or 0) > 0
        for tag in list(original.keys())
    )


def _hides_bits(frame: bytes, header: SliceHeader) -> bool:
    """Tell whether there is something in bits of a frame that `codecs.decode` does not read."""
    syntax, form = header.pixels.syntax, header.format
    if syntax not in (RLE, *JPEG) or (
        codestream.precision(frame, syntax, form) <= form.bits_stored
        and (syntax != RLE or form.bits_stored == form.bits_allocated)
    ):
        return False
    whole = replace(form, bits_stored=form.bits_allocated, high_bit=form.bits_allocated - 1)
    out = np.empty((form.rows, form.columns), stored_type(form))
    codecs.decode(frame, syntax, whole, out)
    cells = out.view(np.dtype(f"u{out.itemsize}"))
    return not np.array_equal(_used_bits(cells, header, None), cells)


def _decode_alike(header: SliceHeader, item: bytes, other: bytes) -> bool:
    form = header.format
    first, second = (np.empty((form.rows, form.columns), stored_type(form)) for _ in range(2))
    codecs.decode(item, header.pixels.syntax, form, first)
    codecs.decode(other, header.pixels.syntax, form, second)
    return np.array_equal(first, second)


def _anew(header: SliceHeader, result: Dataset, stored_only: bool) -> tuple[UID, bool]:
    """Encode the values of all frames anew: JPEG-LS, without loss; uncompressed where it cannot.

    Args:
        header: of the file.
        result: takes them up.
        stored_only: leave out bits beyond BitsStored that the code stream counts as its own.
    """
    form = header.format
    low, high = form.stored_range
    pictures, fit = [], form.bits_stored >= 2
    for frame in range(max(form.frames, 1)):
        out = np.empty((form.rows, form.columns), stored_type(form))
        read_stored(replace(header, frame=frame), out)
        if stored_only:
            codecs.keep_bits(out, form.bits_stored, form.bits_stored - 1)
        fit &= bool(out.min() >= low and out.max() <= high)
        pictures.append(out)
    encoded = [_jpeg_ls(out, header) for out in pictures] if fit else []
    if encoded and all(encoded):
        result["PixelData"].value = encapsulate(encoded, has_bot=len(encoded) > 1)
        result.HighBit = form.bits_stored - 1
        return JPEGLSLossless, True
    raw = b"".join(out.astype(out.dtype.newbyteorder("<")).tobytes() for out in pictures)
    del result["PixelData"]
    wide = form.bits_allocated > 8
    result.add_new("PixelData", "OW" if wide else "OB", raw + b"\0" * (len(raw) % 2))
    result.HighBit = form.bits_stored - 1
    return ExplicitVRLittleEndian, True


def _jpeg_ls(values: NDArray[Any], header: SliceHeader) -> bytes:
    """Encode a picture; empty if it does not come back as it was."""
    try:
        from jpeg_ls import encode_buffer
    except ImportError:
        return b""
    form = header.format
    kind = np.dtype(f"u{values.itemsize}").type
    cells = values.view(kind) & kind((1 << form.bits_stored) - 1)
    width = 1 if form.bits_stored <= 8 else 2
    raw = cells.astype(f"<u{width}").tobytes()
    frame = bytes(encode_buffer(raw, form.rows, form.columns, 1, form.bits_stored))
    out = np.empty_like(values)
    try:
        codecs.decode(frame, str(JPEGLSLossless), form, out)
    except FileDamagedError:
        return b""
    return frame + b"\0" * (len(frame) % 2) if np.array_equal(out, values) else b""
