"""How the pixels of a file are stored and where: raw at an offset, or encoded."""

import os
from dataclasses import dataclass
from typing import BinaryIO, Final

from app.core.messages import sentence

IMPLICIT_LITTLE: Final = "1.2.840.10008.1.2"
EXPLICIT_LITTLE: Final = "1.2.840.10008.1.2.1"
EXPLICIT_BIG: Final = "1.2.840.10008.1.2.2"
DEFLATED: Final = "1.2.840.10008.1.2.1.99"

RLE: Final = "1.2.840.10008.1.2.5"

JPEG: Final = tuple(f"1.2.840.10008.1.2.4.{n}" for n in (50, 51, 53, 55, 57, 70))
"""Baseline, extended (12 bits too), two retired progressive ones, and the lossless ones."""

JPEG_LS: Final = tuple(f"1.2.840.10008.1.2.4.{n}" for n in (80, 81))
JPEG_2000: Final = tuple(f"1.2.840.10008.1.2.4.{n}" for n in (90, 91, 201, 202, 203))

DECODERS: Final = {
    RLE: ("pylibjpeg-rle",),
    **dict.fromkeys(JPEG, ("python-gdcm",)),
    **dict.fromkeys(JPEG_LS, ("pyjpegls", "python-gdcm")),
    **dict.fromkeys(JPEG_2000, ("pylibjpeg-openjpeg", "python-gdcm")),
}
"""Encoded transfer syntax -> the packages that decode it, the quickest first."""

RAW: Final = (IMPLICIT_LITTLE, EXPLICIT_LITTLE, EXPLICIT_BIG)
"""Transfer syntaxes whose pixels can be read straight from the file."""


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
    def size(self) -> tuple[int, int]:
        """Columns and rows."""
        return self.columns, self.rows

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

    @property
    def bits_below(self) -> int:
        """Bits of a pixel below the stored ones: none, but where HighBit is odd."""
        return self.high_bit + 1 - self.bits_stored

    @property
    def bits_below_used(self) -> str:
        """Return what to say if those bits are not empty."""
        return sentence(
            "HighBit {high_bit} and BitsStored {bits_stored} leave the lowest "
            "{bits_below} bits of a pixel empty, and they are not; HighBit must be "
            "{right_high_bit}",
            high_bit=self.high_bit,
            bits_stored=self.bits_stored,
            bits_below=self.bits_below,
            right_high_bit=self.bits_stored - 1,
        )

    @property
    def pads_beyond_stored(self) -> bool:
        """Return whether padding needs more bits than are stored."""
        if self.padding is None:
            return False
        lowest, highest = self.stored_range
        return self.padding[0] < lowest or self.padding[1] > highest


@dataclass(frozen=True, slots=True)
class Stamp:
    """What changes when a file is written anew.

    Attributes:
        size: bytes.
        changed_ns: time of the last writing [ns].
    """

    size: int
    changed_ns: int

    @classmethod
    def of(cls, stream: BinaryIO) -> "Stamp":
        """Return the stamp of an open file."""
        found = os.fstat(stream.fileno())
        return cls(found.st_size, found.st_mtime_ns)


@dataclass(frozen=True, slots=True)
class PixelData:
    """Where the pixels lie.

    Attributes:
        syntax: transfer syntax UID.
        offset: byte at which they start: raw ones in the file or, if it is deflated, in the
            inflated data set; encoded ones with the item of the offset table. None if absent.
        damage: what is wrong with them; empty when nothing is.
        start: byte in the file at which a deflated data set starts.
        stamp: of the file when it was looked at; None if not known.
        behind: bytes that stand behind the pixels without being any, a padding byte left out.
    """

    syntax: str
    offset: int | None
    damage: str
    start: int = 0
    stamp: Stamp | None = None
    behind: int = 0
