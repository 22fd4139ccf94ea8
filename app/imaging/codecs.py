"""Decoders of encoded frames: bytes of one frame in, stored values out.

The libraries are called on the frame's own bytes: through pydicom each frame costs another reading
of the file's header. Which library decodes which transfer syntax stands in `pixel_data.DECODERS`.
"""

import contextlib
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.imaging import codestream
from app.imaging.errors import FileDamagedError
from app.imaging.pixel_data import DECODERS, JPEG, RLE, PixelFormat


def keep_bits(out: NDArray[Any], stored: int, high: int) -> None:
    """Keep the stored bits only; the others are not part of the value (PS3.5 8.1.1).

    Args:
        out: changed in place; a signed type keeps the sign of the highest stored bit.
        stored: number of bits kept.
        high: place of the highest of them.
    """
    allocated = 8 * out.itemsize
    if stored == allocated:
        return
    np.left_shift(out, allocated - 1 - high, out=out)
    np.right_shift(out, allocated - stored, out=out)


def keep_stored(out: NDArray[Any], form: PixelFormat) -> None:
    """Keep the stored bits of pixels, and padding that is written in more bits than these.

    Args:
        out: changed in place.
        form: of the pixels.

    Raises:
        FileDamagedError: if bits below the stored ones are in use: then HighBit cannot be right.
    """
    if form.bits_stored == 8 * out.itemsize:
        return
    if form.bits_below and (out & ((1 << form.bits_below) - 1)).any():
        raise FileDamagedError(form.bits_below_used)
    beyond = None
    if form.padding is not None and form.pads_beyond_stored:
        beyond = (out >= form.padding[0]) & (out <= form.padding[1])
        padding = out[beyond]
    keep_bits(out, form.bits_stored, form.high_bit)
    if beyond is not None:
        out[beyond] = padding


Stored = NDArray[Any]
Codec = Callable[[bytes, str, PixelFormat, int], Any]


def decode(data: bytes, syntax: str, form: PixelFormat, out: Stored) -> None:
    """Decode one frame.

    Args:
        data: all its fragments, joined.
        syntax: transfer syntax.
        form: as the file's header gives it, of one sample per pixel.
        out: shape (rows, columns), filled in place.

    Raises:
        FileDamagedError: if it cannot be decoded, or is not what the header says.
    """
    precision = codestream.precision(data, syntax, form)
    codec = _installed(syntax)
    try:
        pixels = codec(data, syntax, form, precision)
    except (FileDamagedError, MemoryError, KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:  # nearly anything can come; a panic in Rust is no Exception
        what = f"{type(error).__name__} in {DECODERS[syntax][0]}"
        raise FileDamagedError(
            sentence("its pixels cannot be decoded ({fault})", fault=what)
        ) from None
    width = form.bits_allocated // 8 if syntax == RLE or precision > 8 else 1
    found = np.frombuffer(pixels, f"<u{width}")
    if found.size < out.size:
        raise FileDamagedError(
            sentence(
                "decodes to {size} pixels where {out_size} are needed",
                size=found.size,
                out_size=out.size,
            )
        )
    values = found[: out.size].reshape(out.shape)
    np.copyto(out, values.astype(f"u{out.itemsize}", copy=False).view(out.dtype))
    if syntax == RLE:
        keep_stored(out, form)
    else:  # the code stream's own figure holds (PS3.5 8.2); JPEG's may count bits of overlays
        bits = min(precision, form.bits_stored) if syntax in JPEG else precision
        keep_bits(out, bits, bits - 1)


def _installed(syntax: str) -> Codec:
    for name in DECODERS[syntax]:
        try:
            return _CODECS[name]()
        except ImportError:
            continue
    raise FileDamagedError(
        sentence(
            "a decoder for transfer syntax {syntax} is missing: pip install {package}",
            syntax=syntax,
            package=DECODERS[syntax][0],
        )
    )


def load() -> None:
    """Load every decoder that is installed."""
    for make in _CODECS.values():
        with contextlib.suppress(ImportError):
            make()


def _jpeg_ls() -> Codec:
    import jpeg_ls

    return lambda data, syntax, form, precision: jpeg_ls.decode_pixel_data(data)[0]


def _openjpeg() -> Codec:
    from openjpeg.utils import decode_pixel_data

    return lambda data, syntax, form, precision: decode_pixel_data(data, version=2)


def _rle() -> Codec:
    from rle.utils import decode_frame

    return lambda data, syntax, form, precision: decode_frame(
        data, form.rows * form.columns, form.bits_allocated, "<"
    )


def _gdcm() -> Codec:
    import gdcm

    for off in (gdcm.Trace.DebugOff, gdcm.Trace.WarningOff, gdcm.Trace.ErrorOff):
        off()
    return _by_gdcm


def _by_gdcm(data: bytes, syntax: str, form: PixelFormat, precision: int) -> bytes:
    import gdcm

    fragment = gdcm.Fragment()
    fragment.SetByteStringValue(data)
    fragments = gdcm.SequenceOfFragments.New()
    fragments.AddFragment(fragment)
    element = gdcm.DataElement(gdcm.Tag(0x7FE0, 0x0010))
    element.SetValue(fragments.__ref__())
    image = gdcm.Image()
    image.SetNumberOfDimensions(2)
    image.SetDimensions((form.columns, form.rows, 1))
    image.SetDataElement(element)
    kind = gdcm.PhotometricInterpretation.GetPIType("MONOCHROME2")
    image.SetPhotometricInterpretation(gdcm.PhotometricInterpretation(kind))
    image.SetTransferSyntax(gdcm.TransferSyntax(gdcm.TransferSyntax.GetTSType(syntax)))
    allocated = 16 if precision > 8 else 8
    image.SetPixelFormat(gdcm.PixelFormat(1, allocated, precision, precision - 1, 0))
    found: bytes = image.GetBuffer().encode("utf-8", "surrogateescape")
    return found


_CODECS = {
    "pyjpegls": _jpeg_ls,
    "pylibjpeg-openjpeg": _openjpeg,
    "pylibjpeg-rle": _rle,
    "python-gdcm": _gdcm,
}
"""Package that installs it -> maker of the decoder; ImportError if the package is missing."""
