"""What an encoded frame says of itself: size and precision, from the head of its code stream."""

import struct
from dataclasses import dataclass

from app.core.messages import sentence
from app.imaging.errors import FileDamagedError
from app.imaging.pixel_data import JPEG, JPEG_2000, JPEG_LS, RLE, PixelFormat

HEAD = 4096
"""Bytes in which the head of a code stream is looked for."""

_JPEG_START = b"\xff\xd8"
_J2K_START = b"\xff\x4f\xff\x51"
_NO_FRAME = (0xC4, 0xC8, 0xCC)  # Huffman tables, reserved, arithmetic conditioning
_KINDS = {"JPEG": JPEG, "JPEG-LS": JPEG_LS, "JPEG 2000": JPEG_2000, "RLE": (RLE,)}
_BARE = (0x01, *range(0xD0, 0xD9))  # markers without a length


@dataclass(frozen=True, slots=True)
class Codestream:
    """One encoded frame.

    Attributes:
        precision: bits of a sample.
        kind: "JPEG", "JPEG-LS" or "JPEG 2000".
    """

    rows: int
    columns: int
    samples: int
    precision: int
    kind: str


def describe(data: bytes) -> Codestream | None:
    """Read the head of a JPEG, JPEG-LS or JPEG 2000 code stream; None if it is not in `data`.

    Sources: ITU-T T.81 B.2.2 (SOF), T.87 C.2.2 (SOF55), T.800 A.5.1 (SIZ).
    """
    if data[:2] == _JPEG_START:
        return _jpeg(data)
    start = data.find(_J2K_START, 0, HEAD)  # some writers put a JP2 file around it
    return None if start < 0 else _jpeg_2000(data[start:])


def _jpeg(data: bytes) -> Codestream | None:
    at = 2
    while at + 4 <= len(data):
        if data[at] != 0xFF:
            return None
        marker = data[at + 1]
        if marker == 0xFF or marker in _BARE:
            at += 1 if marker == 0xFF else 2
            continue
        if (0xC0 <= marker <= 0xCF and marker not in _NO_FRAME) or marker == 0xF7:
            if at + 10 > len(data):
                return None
            precision, rows, columns, samples = struct.unpack_from(">BHHB", data, at + 4)
            kind = "JPEG-LS" if marker == 0xF7 else "JPEG"
            return Codestream(rows, columns, samples, precision, kind)
        at += 2 + int(struct.unpack_from(">H", data, at + 2)[0])
    return None


def _jpeg_2000(data: bytes) -> Codestream | None:
    if len(data) < 43:
        return None
    right, bottom, left, top = struct.unpack_from(">LLLL", data, 8)
    samples, depth = struct.unpack_from(">HB", data, 40)
    return Codestream(bottom - top, right - left, samples, (depth & 0x7F) + 1, "JPEG 2000")


def contradiction(data: bytes, syntax: str, form: PixelFormat) -> str:
    """Return how the head of a frame contradicts the file's header; "" where it does not.

    A frame larger than its header says is not decoded: it may be made to fill the memory.

    Args:
        data: the frame, or its first `HEAD` bytes.
        syntax: transfer syntax of the file.
        form: as the header gives it.
    """
    found = describe(data)
    if found is not None and found.kind != _kind(syntax):
        return sentence(
            "its pixels are compressed as {found_compression}, and its transfer syntax is of "
            "{stated_compression}; have it sent again",
            found_compression=found.kind,
            stated_compression=_kind(syntax),
        )
    if syntax == RLE:
        return _rle_contradiction(data, form)
    if found is None:
        return (
            ""
            if len(data) >= HEAD
            else sentence("its compressed pixels are damaged (no frame header)")
        )
    if (found.rows, found.columns) != (form.rows, form.columns):
        return sentence(
            "its compressed picture is {columns} × {rows}, "
            "its header says {form_columns} × {form_rows}",
            columns=found.columns,
            rows=found.rows,
            form_columns=form.columns,
            form_rows=form.rows,
        )
    if found.samples != form.samples:
        return sentence(
            "{samples} samples per compressed pixel, its header says {form_samples}",
            samples=found.samples,
            form_samples=form.samples,
        )
    if not 1 <= found.precision <= form.bits_allocated:
        return sentence(
            "{precision} bits per compressed pixel do not fit BitsAllocated {form_bits_allocated}",
            precision=found.precision,
            form_bits_allocated=form.bits_allocated,
        )
    return ""


def _kind(syntax: str) -> str:
    for kind, syntaxes in _KINDS.items():
        if syntax in syntaxes:
            return kind
    return "another kind"


def _rle_contradiction(data: bytes, form: PixelFormat) -> str:
    """PS3.5 G.5: one segment for each byte of a pixel."""
    if len(data) < 64:
        return sentence("its compressed pixels are damaged (no RLE header)")
    segments = int(struct.unpack_from("<L", data)[0])
    wanted = form.samples * form.bits_allocated // 8
    return (
        ""
        if segments == wanted
        else sentence(
            "{segments} RLE segments where {wanted} are needed", segments=segments, wanted=wanted
        )
    )


def precision(data: bytes, syntax: str, form: PixelFormat) -> int:
    """Bits of a sample, checked against the header.

    Raises:
        FileDamagedError: if the frame contradicts the header; says how.
    """
    if wrong := contradiction(data, syntax, form):
        raise FileDamagedError(wrong)
    found = None if syntax == RLE else describe(data)
    return form.bits_stored if found is None else found.precision
