"""From stored values to Hounsfield units: int16 where exact, float32 where not, never wrapped.

In the worker process slices are decoded straight into memory that the program shares.
"""

import math
import mmap
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging import codecs
from app.imaging.decoding import read_stored, stored_type
from app.imaging.errors import FileDamagedError, NotExactError, SeriesRefusedError
from app.imaging.header import Rescale, SliceHeader
from app.imaging.worker.lent_memory import LentMemory
from app.imaging.worker.values import reader

_shared: dict[str, LentMemory] = {}
_scratch: dict[str, NDArray[Any]] = {}


def take_volume(memory: LentMemory) -> None:
    """Take the memory that slices are written to, in place of the one before."""
    if "volume" in _shared:
        _shared["volume"].close()
    _shared["volume"] = memory


def load_decoders(progress: Progress) -> None:
    """Load what decodes slices; what is not installed is told by the first file that needs it."""
    codecs.load()
    reader(SliceHeader)  # of the headers that name what is to be decoded


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
        raise FileDamagedError(sentence("there is no volume to write to"))
    _shared["volume"].write(place * hu.nbytes, memoryview(hu.data).cast("B"))


def _array(name: str, shape: tuple[int, int], dtype: np.dtype[Any]) -> NDArray[Any]:
    kept = _scratch.get(name)
    if kept is None or kept.shape != shape or kept.dtype != dtype:
        kept = _scratch[name] = np.empty(shape, dtype)
    return kept


_INT16: Final = np.iinfo(np.int16)

_AIR_HU: Final = -1000.0
EMPTY_HU: Final = -1024.0
"""Value of voxels at which nothing was measured, in Hounsfield units; 0 where there is no unit."""


def fresh_array(shape: tuple[int, int, int], dtype: np.dtype[Any]) -> NDArray[Any]:
    """Uninitialised array on ordinary memory pages.

    For large arrays numpy asks for huge pages; on a machine whose memory is full of cached files
    the kernel has to make room for those first, which was measured to take up to ten times as long.

    Raises:
        SeriesRefusedError: if the machine has not enough memory.
    """
    size = math.prod(shape) * dtype.itemsize
    try:
        return _ordinary_pages(size, dtype).reshape(shape)
    except (OSError, MemoryError) as error:
        raise SeriesRefusedError(
            sentence(
                "the volume needs {size:.1f} GB of memory, which this machine cannot give",
                size=size / 1e9,
            )
        ) from error


def _ordinary_pages(size: int, dtype: np.dtype[Any]) -> NDArray[Any]:
    flags = getattr(mmap, "MAP_PRIVATE", 0) | getattr(mmap, "MAP_ANONYMOUS", 0)
    if not flags:  # no such choice on this system
        return np.empty(size // dtype.itemsize, dtype)
    return np.frombuffer(mmap.mmap(-1, size, flags=flags), dtype)


def fill_slice(header: SliceHeader, out: NDArray[Any], stored: NDArray[Any]) -> None:
    """Read one slice and scale it to Hounsfield units.

    The stored values go through one small array that stays in the processor's cache: reading them
    straight into the fresh pages of the volume costs several times as much.
    """
    read_stored(header, stored)
    if out.dtype == np.float32:
        _scale_float(header, stored, _rescale(header), out)
    else:
        _scale_exact(header, stored, _rescale(header), out)


def _rescale(header: SliceHeader) -> Rescale:
    if header.rescale is None:
        raise FileDamagedError(
            sentence("{header_path} gives no Hounsfield units", header_path=header.path)
        )
    return header.rescale


def integral(header: SliceHeader) -> bool:
    """Return whether the file's rescale makes whole numbers of whole numbers."""
    rescale = _rescale(header)
    limit = 1 << 20
    return all(v.is_integer() and abs(v) < limit for v in (rescale.slope, rescale.intercept))


def _scale_exact(
    header: SliceHeader, stored: NDArray[Any], rescale: Rescale, out: NDArray[Any]
) -> None:
    if not integral(header):
        raise NotExactError
    slope, intercept = int(rescale.slope), int(rescale.intercept)
    fits = _fits(header.format.stored_range, slope, intercept)
    if not fits or padding_stands_out(header):
        padding = _padding(header, stored)
        if padding is not None and padding.any():  # padding is no measurement: it may saturate
            _scale_padded(stored, padding, (slope, intercept), nothing_of(header), out)
            return
        if not fits and not _fits((int(stored.min()), int(stored.max())), slope, intercept):
            raise NotExactError
    if stored.dtype.itemsize == 1:
        stored = stored.astype(np.int16)
    out = out.view(stored.dtype)  # two's complement: the result fits, so wrapping does no harm
    if slope != 1:
        stored = np.multiply(stored, np.array(slope % 65536, np.uint16).astype(stored.dtype))
    np.add(stored, np.array(intercept % 65536, np.uint16).astype(stored.dtype), out=out)


def _fits(bounds: tuple[int, int], slope: int, intercept: int) -> bool:
    ends = [slope * value + intercept for value in bounds]
    return min(ends) >= _INT16.min and max(ends) <= _INT16.max


def nothing_of(header: SliceHeader) -> float:
    """Value of a pixel at which nothing was measured: air of a CT, 0 where there is no unit."""
    return 0.0 if header.identity.modality == "MR" else EMPTY_HU


def padding_stands_out(header: SliceHeader) -> bool:
    """Return whether padding would count as more than nothing if it were scaled like a
    measurement.
    """
    form = header.format
    if form.padding is None:
        return False
    most = 0.0 if header.identity.modality == "MR" else _AIR_HU
    return form.pads_beyond_stored or max(padding_ends(header)) > most


def padding_ends(header: SliceHeader) -> tuple[float, float]:
    """Scale the ends of the padding of a file that has any, as if they were measurements."""
    rescale, padding = _rescale(header), header.format.padding or (0, 0)
    low, high = (rescale.slope * value + rescale.intercept for value in padding)
    return low, high


def _padding(header: SliceHeader, stored: NDArray[Any]) -> NDArray[np.bool_] | None:
    if header.format.padding is None:
        return None
    low, high = header.format.padding
    result: NDArray[np.bool_] = (stored >= low) & (stored <= high)
    return result


def _scale_padded(
    stored: NDArray[Any],
    padding: NDArray[np.bool_],
    scale: tuple[int, int],
    nothing: float,
    out: NDArray[Any],
) -> None:
    """Scale to int16 by slope and intercept; padding becomes no more than `nothing`."""
    scaled = stored.astype(np.int64) * scale[0] + scale[1]  # one slice only
    measured = scaled[~padding]
    if measured.size and not _fits((int(measured.min()), int(measured.max())), 1, 0):
        raise NotExactError
    scaled[padding] = np.clip(scaled[padding], _INT16.min, int(nothing))
    np.copyto(out, scaled.astype(np.int16))


def _scale_float(
    header: SliceHeader, stored: NDArray[Any], rescale: Rescale, out: NDArray[Any]
) -> None:
    scaled = stored.astype(np.float64) * rescale.slope + rescale.intercept  # one slice only
    if padding_stands_out(header):
        padding = _padding(header, stored)
        np.minimum(scaled, nothing_of(header), out=scaled, where=padding)
    np.copyto(out, scaled.astype(np.float32))
