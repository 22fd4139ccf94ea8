"""Pixels of one file: read straight from their offset, or decoded by the plugin named for them."""

import warnings
from typing import Any

import numpy as np
import pydicom
from numpy.typing import NDArray
from pydicom.pixels.decoders.base import get_decoder
from pydicom.pixels.utils import pixel_array

from app.imaging.errors import FileDamagedError
from app.imaging.header import SliceHeader
from app.imaging.pixel_data import DECODERS, DEFLATED, EXPLICIT_BIG, RAW, PixelFormat

Stored = NDArray[Any]


def read_stored(header: SliceHeader, out: Stored) -> None:
    """Read the stored values of one single-frame file.

    Args:
        header: of a file without damage.
        out: C-contiguous, shape (rows, columns), of the type `stored_type` gives; filled in place.

    Raises:
        FileDamagedError: if the file cannot be read or decoded, or is not of the size it says.
    """
    try:
        if header.pixels.syntax in RAW:
            _read_raw(header, out)
        else:
            _decode(header, out)
    except OSError as error:
        raise FileDamagedError(
            f"{header.path} cannot be read: {error.strerror or error}"
        ) from error


def stored_type(pixel_format: PixelFormat) -> np.dtype[Any]:
    """Type that holds the stored values: (u)int8 or (u)int16."""
    kind = "i" if pixel_format.signed else "u"
    return np.dtype(f"{kind}{pixel_format.bits_allocated // 8}")


def _read_raw(header: SliceHeader, out: Stored) -> None:
    if header.pixels.offset is None:
        raise FileDamagedError(f"{header.path}: {header.pixels.damage or 'no pixels'}")
    with header.path.open("rb", buffering=0) as stream:
        stream.seek(header.pixels.offset)
        view = out.reshape(-1).view(np.uint8).data
        got = 0
        while got < len(view) and (count := stream.readinto(view[got:])):
            got += count
    if got < len(view):
        raise FileDamagedError(
            f"{header.path} ends {len(view) - got} bytes too early; read it again"
        )
    if header.pixels.syntax == EXPLICIT_BIG and out.itemsize == 2:
        out.byteswap(inplace=True)
    _drop_unused_bits(header.format, out)


def _drop_unused_bits(form: PixelFormat, out: Stored) -> None:
    """Keep the stored bits only; the others are not part of the value (PS3.5 8.1.1)."""
    if form.bits_stored == form.bits_allocated:
        return
    np.left_shift(out, form.bits_allocated - 1 - form.high_bit, out=out)
    np.right_shift(out, form.bits_allocated - form.bits_stored, out=out)  # keeps the sign


def _decode(header: SliceHeader, out: Stored) -> None:
    try:
        with warnings.catch_warnings():  # what a decoder grumbles about is for nobody's screen
            warnings.simplefilter("ignore")
            decoded = (
                _inflated(header, out) if header.pixels.syntax == DEFLATED else _plugin(header)
            )
    except (OSError, FileDamagedError):
        raise
    except Exception as error:  # a decoder meets hostile bytes: nearly anything can come
        brief = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise FileDamagedError(f"{header.path} cannot be decoded ({brief})") from error
    if decoded.shape != out.shape:
        raise FileDamagedError(
            f"{header.path} decodes to {decoded.shape}, its header says {out.shape}"
        )
    np.copyto(out, decoded.astype(out.dtype, copy=False))
    if header.pixels.syntax == DEFLATED:
        _drop_unused_bits(header.format, out)


def _plugin(header: SliceHeader) -> Stored:
    wanted = DECODERS[header.pixels.syntax]
    installed = get_decoder(header.pixels.syntax).available_plugins
    usable = [name for name in wanted if name in installed]
    if not usable:
        raise FileDamagedError(
            f"{header.path} needs a decoder for transfer syntax {header.pixels.syntax}; install "
            f"one of pydicom's plugins {', '.join(wanted)}"
        )
    return pixel_array(header.path, raw=True, decoding_plugin=usable[0])


def _inflated(header: SliceHeader, out: Stored) -> Stored:
    data = pydicom.dcmread(header.path, force=True).PixelData
    return np.frombuffer(data, out.dtype, count=out.size).reshape(out.shape)
