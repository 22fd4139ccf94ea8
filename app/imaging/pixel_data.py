"""How the pixels of a file are stored and where: raw at an offset, or encoded."""

import struct
from dataclasses import dataclass
from typing import BinaryIO, Final

IMPLICIT_LITTLE: Final = "1.2.840.10008.1.2"
EXPLICIT_LITTLE: Final = "1.2.840.10008.1.2.1"
EXPLICIT_BIG: Final = "1.2.840.10008.1.2.2"
DEFLATED: Final = "1.2.840.10008.1.2.1.99"

DECODERS: Final = {
    "1.2.840.10008.1.2.5": ("pylibjpeg", "pydicom"),  # RLE
    "1.2.840.10008.1.2.4.50": ("gdcm",),  # JPEG baseline
    "1.2.840.10008.1.2.4.51": ("gdcm",),  # JPEG extended
    "1.2.840.10008.1.2.4.57": ("gdcm",),  # JPEG lossless
    "1.2.840.10008.1.2.4.70": ("gdcm",),  # JPEG lossless, first-order prediction
    "1.2.840.10008.1.2.4.80": ("pyjpegls", "gdcm"),  # JPEG-LS lossless
    "1.2.840.10008.1.2.4.81": ("pyjpegls", "gdcm"),  # JPEG-LS near-lossless
    "1.2.840.10008.1.2.4.90": ("pylibjpeg", "gdcm"),  # JPEG 2000 lossless
    "1.2.840.10008.1.2.4.91": ("pylibjpeg", "gdcm"),  # JPEG 2000
}
"""Encoded transfer syntax -> the pydicom plugins that decode it, the quickest first."""

RAW: Final = (IMPLICIT_LITTLE, EXPLICIT_LITTLE, EXPLICIT_BIG)
"""Transfer syntaxes whose pixels can be read straight from the file."""

_PIXEL_DATA: Final = (0x7FE0, 0x0010)
_UNDEFINED: Final = 0xFFFFFFFF


@dataclass(frozen=True, slots=True)
class PixelFormat:
    """How a pixel is stored.

    Attributes:
        padding: lowest and highest stored value that stands for "no measurement", or None.
    """

    rows: int
    columns: int
    samples: int
    frames: int
    bits_allocated: int
    bits_stored: int
    high_bit: int
    signed: bool
    photometric: str
    padding: tuple[int, int] | None

    @classmethod
    def unknown(cls) -> "PixelFormat":
        """Return the format of a file whose header does not give one."""
        return cls(0, 0, 1, 1, 0, 0, -1, False, "", None)

    @property
    def frame_bytes(self) -> int:
        """Bytes of one uncompressed frame."""
        return self.rows * self.columns * self.samples * self.bits_allocated // 8

    @property
    def stored_range(self) -> tuple[int, int]:
        """Lowest and highest value that `bits_stored` can hold."""
        if self.signed:
            return -(1 << (self.bits_stored - 1)), (1 << (self.bits_stored - 1)) - 1
        return 0, (1 << self.bits_stored) - 1


@dataclass(frozen=True, slots=True)
class PixelData:
    """Where the pixels lie.

    Attributes:
        syntax: transfer syntax UID.
        offset: byte in the file at which raw pixels start; None if encoded or absent.
        damage: what is wrong with them; empty when nothing is.
    """

    syntax: str
    offset: int | None
    damage: str


def find_pixels(stream: BinaryIO, size: int, syntax: str, pixel_format: PixelFormat) -> PixelData:
    """Find the pixel data, `stream` standing where the header ended.

    Args:
        stream: the file.
        size: its length in bytes.
        syntax: its transfer syntax.
        pixel_format: as its header gives it.
    """
    if syntax == DEFLATED:  # the whole data set is one compressed stream
        return PixelData(syntax, None, "")
    if syntax not in RAW and syntax not in DECODERS:
        return PixelData(syntax, None, f"no decoder for transfer syntax {syntax}")
    little = syntax != EXPLICIT_BIG
    length = _element_length(stream, little, syntax == IMPLICIT_LITTLE)
    if length is None:
        return PixelData(syntax, None, f"truncated: {size} bytes and no pixels in them")
    if syntax in RAW:
        return _raw(syntax, stream.tell(), size, length, pixel_format)
    return PixelData(syntax, None, _fragments_damage(stream, size))


def _element_length(stream: BinaryIO, little: bool, implicit: bool) -> int | None:
    head = stream.read(8)
    order = "<" if little else ">"
    if len(head) < 8 or struct.unpack(order + "HH", head[:4]) != _PIXEL_DATA:
        return None
    if implicit:
        return int(struct.unpack("<L", head[4:])[0])
    tail = stream.read(4)
    return int(struct.unpack(order + "L", tail)[0]) if len(tail) == 4 else None


def _raw(syntax: str, offset: int, size: int, length: int, wanted: PixelFormat) -> PixelData:
    needed = wanted.frame_bytes * max(wanted.frames, 1)
    if size - offset < min(length, needed):
        missing = needed - (size - offset)
        return PixelData(syntax, None, f"truncated: the last {missing} bytes of pixels are missing")
    if length < needed:
        return PixelData(syntax, None, f"{length} bytes of pixels where {needed} are needed")
    return PixelData(syntax, offset, "")


def _fragments_damage(stream: BinaryIO, size: int) -> str:
    """Walk the items of encapsulated pixel data to their end (PS3.5 A.4)."""
    while len(head := stream.read(8)) == 8:
        group, element, length = struct.unpack("<HHL", head)
        if (group, element) == (0xFFFE, 0xE0DD):
            return ""
        if (group, element) != (0xFFFE, 0xE000) or length == _UNDEFINED:
            return "its compressed pixels are damaged"
        if stream.tell() + length > size:
            break
        stream.seek(length, 1)
    return "truncated: its compressed pixels do not end"
