"""Series as archives hold them: sound ones, from which a defect at a time is made byte by byte.

What a series should read as is known from the numbers it was written with, never from reading it.
"""

import io
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pydicom
from pydicom.encaps import encapsulate
from pydicom.uid import (
    DeflatedExplicitVRLittleEndian,
    ExplicitVRBigEndian,
    ExplicitVRLittleEndian,
    ImplicitVRLittleEndian,
)

from tests.imaging.dicom_factory import Slices

PIXELS_LE = b"\xe0\x7f\x10\x00"
PIXELS_BE = b"\x7f\xe0\x00\x10"
ITEM = b"\xfe\xff\x00\xe0"
END = b"\xfe\xff\xdd\xe0\x00\x00\x00\x00"
UNDEFINED = b"\xff\xff\xff\xff"
NATIVE = (ImplicitVRLittleEndian, ExplicitVRLittleEndian, ExplicitVRBigEndian)


@dataclass
class Archived:
    """A series of unsigned CT slices, written to a folder file by file.

    Attributes:
        count: slices.
        shape: rows, columns.
        step_mm: between slices.
        syntax: that it is written in.
        seed: of its values.
        tags: of every file; None deletes one.
    """

    count: int = 6
    shape: tuple[int, int] = (20, 24)
    step_mm: float = 2.0
    syntax: str = ExplicitVRLittleEndian
    seed: int = 1
    tags: dict[str, Any] = field(default_factory=dict)

    def hu(self) -> np.ndarray:
        """Hounsfield values of a body in air, shape (slices, rows, columns)."""
        rng = np.random.default_rng(self.seed)
        k, j, i = np.ogrid[: self.count, : self.shape[0], : self.shape[1]]
        y, x = (j - self.shape[0] / 2) / self.shape[0], (i - self.shape[1] / 2) / self.shape[1]
        body = x**2 + y**2 < 0.12
        noise = rng.integers(-20, 21, (self.count, *self.shape))
        return np.where(body, 40 + 3 * k, -1000) + noise

    def file(self, k: int, **tags: Any) -> pydicom.Dataset:
        """Return slice `k` as it would be written; `tags` go over those of the series."""
        slices = Slices(shape=self.shape, offsets=tuple(self.step_mm * np.arange(self.count)))
        buffer = io.BytesIO()
        stored = (self.hu()[k] + 1024).astype("<u2").tobytes()
        slices.write_one(buffer, k, self.step_mm * k, PixelData=stored)  # type: ignore[arg-type]
        file = pydicom.dcmread(io.BytesIO(buffer.getvalue()))
        file.SliceThickness = "2"
        for name, value in {**self.tags, **tags}.items():
            if value is None:
                delattr(file, name)
            elif name.startswith("PixelPadding"):
                file.add_new(name, "SS" if file.PixelRepresentation else "US", value)
            else:
                setattr(file, name, value)
        return file

    def encoded(self, k: int, **tags: Any) -> bytes:
        """Return the bytes of the file of slice `k`."""
        return encoded(self.file(k, **tags), self.syntax)

    def write(
        self, folder: Path, spoil: Callable[[bytes], bytes] | None = None, **tags: Any
    ) -> list[Path]:
        """Write every slice, spoilt in one way."""
        folder.mkdir(parents=True, exist_ok=True)
        paths = [folder / f"{k:03d}.dcm" for k in range(self.count)]
        for k, path in enumerate(paths):
            whole = self.encoded(k, **tags)
            path.write_bytes(spoil(whole) if spoil else whole)
        return paths


def encoded(file: pydicom.Dataset, syntax: str) -> bytes:
    """Return a file as bytes in a native transfer syntax."""
    file.file_meta.TransferSyntaxUID = syntax
    if syntax == ExplicitVRBigEndian and isinstance(file.PixelData, bytes):
        file.PixelData = np.frombuffer(file.PixelData, "<u2").astype(">u2").tobytes()
    buffer = io.BytesIO()
    pydicom.dcmwrite(buffer, file, enforce_file_format=True)
    return buffer.getvalue()


def relabelled(whole: bytes, syntax: str) -> bytes:
    """Say another transfer syntax of a file, and change nothing else."""
    at = whole.index(b"\x02\x00\x10\x00UI")
    length = struct.unpack_from("<H", whole, at + 6)[0]
    uid = syntax.encode() + b"\0" * (len(syntax) % 2)
    new = whole[: at + 6] + struct.pack("<H", len(uid)) + uid + whole[at + 8 + length :]
    group = new.index(b"\x02\x00\x00\x00UL") + 8
    total = struct.unpack_from("<L", new, group)[0] + len(uid) - length
    return new[:group] + struct.pack("<L", total) + new[group + 4 :]


def pixel_element(whole: bytes) -> tuple[int, int, bool]:
    """Where the pixel element stands, where its value does, and whether it is big endian."""
    for tag, big in ((PIXELS_LE, False), (PIXELS_BE, True)):
        at = whole.rfind(tag)
        if at > 0:
            explicit = whole[at + 4 : at + 6] in (b"OW", b"OB", b"UN")
            return at, at + (12 if explicit else 8), big
    raise ValueError("no pixels")


def with_pixels(whole: bytes, value: bytes, length: int | None = None) -> bytes:
    """Put other bytes in the place of the pixels, with their length or another (-1: undefined)."""
    _, start, big = pixel_element(whole)
    said = len(value) if length is None else length & 0xFFFFFFFF
    return whole[: start - 4] + struct.pack(">L" if big else "<L", said) + value


def pixels(whole: bytes) -> bytes:
    """Return the pixels of a native file."""
    return whole[pixel_element(whole)[1] :]


def in_items(whole: bytes) -> bytes:
    """Return the pixels of a file as one fragment behind an empty table of offsets."""
    return encapsulate([pixels(whole)], has_bot=False) + END


def is_deflated(syntax: str) -> bool:
    """Whether a data set of this syntax is deflated."""
    return syntax == DeflatedExplicitVRLittleEndian
