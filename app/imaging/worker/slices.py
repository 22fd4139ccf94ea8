"""The child's side of a volume: slices decoded straight into memory that the program shares."""

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.progress import Progress
from app.imaging import codecs
from app.imaging.decoding import stored_type
from app.imaging.errors import FileDamagedError
from app.imaging.header import SliceHeader
from app.imaging.rescaling import fill_slice

_shared: dict[str, int] = {}
_scratch: dict[str, NDArray[Any]] = {}


def take_volume(descriptor: int) -> None:
    """Take the memory that slices are written to, in place of the one before."""
    if "volume" in _shared:
        os.close(_shared["volume"])
    _shared["volume"] = descriptor


def load_decoders(progress: Progress) -> None:
    """Load what decodes slices; what is not installed is told by the first file that needs it."""
    codecs.load()


def fill(header: SliceHeader, place: int, dtype: str, progress: Progress) -> None:
    """Write a slice of Hounsfield values to its place in the volume.

    Raises:
        NotExactError: if a value does not fit the type.
        FileDamagedError: if it cannot be decoded.
    """
    shape = header.format.rows, header.format.columns
    hu = _array("hu", shape, np.dtype(dtype))
    fill_slice(header, hu, _array("stored", shape, stored_type(header.format)))
    if "volume" not in _shared:
        raise FileDamagedError("there is no volume to write to")
    view, at = memoryview(hu.data).cast("B"), place * hu.nbytes
    while view:
        written = os.pwrite(_shared["volume"], view, at)
        view, at = view[written:], at + written


def _array(name: str, shape: tuple[int, int], dtype: np.dtype[Any]) -> NDArray[Any]:
    kept = _scratch.get(name)
    if kept is None or kept.shape != shape or kept.dtype != dtype:
        kept = _scratch[name] = np.empty(shape, dtype)
    return kept
