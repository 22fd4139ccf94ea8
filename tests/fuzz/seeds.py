"""Small CT series in every encoding that is read, as the files that mutations start from."""

import io
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pydicom
from pydicom.uid import (
    DeflatedExplicitVRLittleEndian,
    ExplicitVRBigEndian,
    ImplicitVRLittleEndian,
    JPEG2000Lossless,
    JPEGLosslessSV1,
    JPEGLSLossless,
    RLELossless,
)

from tests.imaging.dicom_factory import Slices

SHAPE = (32, 32)
OFFSETS = (0.0, 2.0, 4.0)
MIDDLE = 1


@dataclass(frozen=True)
class Seed:
    """Three slices; the middle one is mutated.

    Attributes:
        name: of the encoding.
        files: content of each file.
        hu: values, shape (3, rows, columns).
    """

    name: str
    files: tuple[bytes, ...]
    hu: np.ndarray


def seeds(folder: Path) -> Iterator[Seed]:
    """Make every seed; `folder` is for what has to be written on the way."""
    slices = Slices(offsets=OFFSETS, shape=SHAPE)
    paths = slices.write(folder)
    plain = [path.read_bytes() for path in paths]
    hu = np.stack([slices.stored(k) for k in range(len(OFFSETS))]) - 1024
    yield Seed("explicit", tuple(plain), hu)
    for name, make in {
        "implicit": lambda data: _rewritten(data, ImplicitVRLittleEndian),
        "big endian": lambda data: _rewritten(data, ExplicitVRBigEndian),
        "deflated": lambda data: _rewritten(data, DeflatedExplicitVRLittleEndian),
        "RLE": lambda data: _compressed(data, RLELossless),
        "JPEG-LS": lambda data: _compressed(data, JPEGLSLossless),
        "JPEG 2000": lambda data: _compressed(data, JPEG2000Lossless),
        "JPEG lossless": lambda data: _by_gdcm(data, folder),
        "no preamble": lambda data: data[132:],
    }.items():
        yield Seed(name, tuple(make(data) for data in plain), hu)


@cache
def bomb(data: bytes, megabytes: int = 300) -> bytes:
    """Turn a deflated file into one that inflates to far more than its header says."""
    start = data.index(b"UI", 132)  # the meta group's own end follows from its length element
    meta = 144 + int.from_bytes(data[140:144], "little")
    assert start < meta
    whole = zlib.decompressobj(-zlib.MAX_WBITS).decompress(data[meta:])
    engine = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    parts = [engine.compress(whole)]
    parts += [engine.compress(bytes(1 << 20)) for _ in range(megabytes)]
    return data[:meta] + b"".join([*parts, engine.flush()])


def _saved(file: pydicom.FileDataset, **encoding: bool) -> bytes:
    out = io.BytesIO()
    pydicom.dcmwrite(out, file, enforce_file_format=True, **encoding)
    return out.getvalue()


def _rewritten(data: bytes, syntax: pydicom.uid.UID) -> bytes:
    file = pydicom.dcmread(io.BytesIO(data))
    if syntax == ExplicitVRBigEndian:
        file.PixelData = np.frombuffer(file.PixelData, "<u2").astype(">u2").tobytes()
    file.file_meta.TransferSyntaxUID = syntax
    fresh = pydicom.Dataset(file)
    fresh.file_meta, fresh.preamble = file.file_meta, b"\0" * 128
    return _saved(fresh)


def _compressed(data: bytes, syntax: pydicom.uid.UID) -> bytes:
    file = pydicom.dcmread(io.BytesIO(data))
    file.compress(syntax, generate_instance_uid=False)
    return _saved(file)


def _by_gdcm(data: bytes, folder: Path) -> bytes:
    import gdcm

    raw, out = folder / "raw.dcm", folder / "encoded.dcm"
    raw.write_bytes(data)
    reader = gdcm.ImageReader()
    reader.SetFileName(str(raw))
    assert reader.Read()
    change = gdcm.ImageChangeTransferSyntax()
    kind = gdcm.TransferSyntax.GetTSType(JPEGLosslessSV1)
    change.SetTransferSyntax(gdcm.TransferSyntax(kind))
    change.SetInput(reader.GetImage())
    assert change.Change()
    writer = gdcm.ImageWriter()
    writer.SetFileName(str(out))
    writer.SetFile(reader.GetFile())
    writer.SetImage(change.GetOutput())
    assert writer.Write()
    encoded, file = pydicom.dcmread(out), pydicom.dcmread(raw)
    raw.unlink()
    out.unlink()
    file.file_meta.TransferSyntaxUID = JPEGLosslessSV1
    file.PixelData = encoded.PixelData  # GDCM leaves the rescale out of the rest
    file["PixelData"].is_undefined_length = True
    return _saved(file)
