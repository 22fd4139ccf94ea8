"""Stored values of one image: copied from their place in the file, or decoded."""

import os
from functools import lru_cache
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.imaging.codecs import keep_stored
from app.imaging.deflated import Inflater
from app.imaging.errors import FileDamagedError, brief
from app.imaging.header import SliceHeader
from app.imaging.pixel_data import (
    DEFLATED,
    EXPLICIT_BIG,
    RAW,
    PixelData,
    PixelFormat,
    Stamp,
)
from app.imaging.pixel_finding import Place, frame_bytes, frame_places, walk

Stored = NDArray[Any]


def read_stored(header: SliceHeader, out: Stored) -> None:
    """Read the stored values of one image.

    Args:
        header: of an image without damage.
        out: C-contiguous, shape (rows, columns), of the type `stored_type` gives; filled in place.

    Raises:
        FileDamagedError: if the file cannot be read or decoded, has changed since its header was
            read, or is not of the size it says.
    """
    try:
        with header.path.open("rb", buffering=0) as stream:
            _check_unchanged(header, stream)
            if header.pixels.syntax in RAW:
                _read_raw(header, stream, out)
            elif header.pixels.syntax == DEFLATED:
                _read_deflated(header, stream, out)
            else:
                _decode(header, stream, out)
    except OSError as error:
        if isinstance(error, FileDamagedError):
            raise
        raise FileDamagedError(
            sentence(
                "{header_path} cannot be read: {error_strerror}",
                header_path=header.path,
                error_strerror=error.strerror or error,
            )
        ) from error


def is_raw(header: SliceHeader) -> bool:
    """Return whether the pixels are copied from the file as they stand: nothing is decoded."""
    return header.pixels.syntax in RAW


def stored_type(pixel_format: PixelFormat) -> np.dtype[Any]:
    """Type that holds the stored values: (u)int8 or (u)int16."""
    kind = "i" if pixel_format.signed else "u"
    return np.dtype(f"{kind}{pixel_format.bits_allocated // 8}")


def _check_unchanged(header: SliceHeader, stream: BinaryIO) -> None:
    """Refuse a file swapped since the scan: it would be read at the places of the old one."""
    stamp = header.pixels.stamp
    if stamp is not None and stamp != Stamp.of(stream):
        raise FileDamagedError(
            sentence(
                "{header_path} has changed since the folder was searched; search it again",
                header_path=header.path,
            )
        )


def _read_raw(header: SliceHeader, stream: BinaryIO, out: Stored) -> None:
    if header.pixels.offset is None:
        raise FileDamagedError(
            sentence(
                "{header_path}: {header_pixels_damage}",
                header_path=header.path,
                header_pixels_damage=header.pixels.damage or "no pixels",
            )
        )
    stream.seek(header.pixels.offset + header.frame * header.format.frame_bytes)
    view = out.reshape(-1).view(np.uint8).data
    got = 0
    while got < len(view) and (count := stream.readinto(view[got:])):  # type: ignore[attr-defined]
        got += count
    if got < len(view):
        raise FileDamagedError(
            sentence(
                "{header_path} ends {missing_bytes} bytes too early; read it again",
                header_path=header.path,
                missing_bytes=len(view) - got,
            )
        )
    _finish_raw(header, out)


def _finish_raw(header: SliceHeader, out: Stored) -> None:
    if header.pixels.syntax == EXPLICIT_BIG and out.itemsize == 2:
        out.byteswap(inplace=True)
    try:
        keep_stored(out, header.format)
    except FileDamagedError as error:
        raise FileDamagedError(
            sentence("{header_path}: {error}", header_path=header.path, error=error)
        ) from error


def _read_deflated(header: SliceHeader, stream: BinaryIO, out: Stored) -> None:
    form = header.format
    at, needed = header.frame * form.frame_bytes, form.frame_bytes
    try:
        if form.frames > 1:
            data = _inflated(header.path, header.pixels, form.frames * needed)[at : at + needed]
        else:
            data = _inflate(stream, header.pixels, needed)
    except (FileDamagedError, MemoryError) as error:
        raise FileDamagedError(
            sentence(
                "{header_path}: {error}",
                header_path=header.path,
                error=error or "needs too much memory",
            )
        ) from error
    if len(data) < needed:
        raise FileDamagedError(
            sentence(
                "{header_path} inflates to {needed} bytes too few",
                header_path=header.path,
                needed=needed - len(data),
            )
        )
    np.copyto(out, np.frombuffer(data, out.dtype).reshape(out.shape))
    _finish_raw(header, out)


def _inflate(stream: BinaryIO, pixels: PixelData, needed: int) -> bytes:
    return Inflater(stream, pixels.start).read_at(pixels.offset or 0, needed)


@lru_cache(maxsize=1)
def _inflated(path: Path, pixels: PixelData, needed: int) -> bytes:
    """Pixels of all frames; kept for the next frame of the same file."""
    with path.open("rb") as stream:
        return _inflate(stream, pixels, needed)


def _decode(header: SliceHeader, stream: BinaryIO, out: Stored) -> None:
    from app.imaging.codecs import decode

    try:
        places = _places(header.path, header.pixels, header.format.frames)
        decode(frame_bytes(stream, places[header.frame]), header.pixels.syntax, header.format, out)
    except FileDamagedError as error:
        raise FileDamagedError(
            sentence("{header_path}: {error}", header_path=header.path, error=error)
        ) from error
    except MemoryError:
        raise
    except Exception as error:  # hostile bytes: nearly anything can come
        raise FileDamagedError(
            sentence(
                "{header_path} cannot be decoded ({brief})",
                header_path=header.path,
                brief=brief(error),
            )
        ) from error


@lru_cache(maxsize=2)
def _places(path: Path, pixels: PixelData, frames: int) -> tuple[tuple[Place, ...], ...]:
    """Return where each frame of a file lies; kept for the next frame of the same file."""
    with path.open("rb") as stream:
        size = os.fstat(stream.fileno()).st_size
        return frame_places(stream, walk(stream, pixels.offset or 0, size), frames)
