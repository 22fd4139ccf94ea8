"""A NIfTI file, read in the worker process: what its header says, and its values."""

import gzip
import hashlib
import warnings
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.elements import FURTHEST_MM
from app.imaging.errors import FileDamagedError
from app.imaging.structures.extras import extra
from app.imaging.worker.values import ATTACHED

_UNITS_MM = {"mm": 1.0, "unknown": 1.0, "meter": 1000.0, "micron": 0.001}
_SQUARE_MM = 0.01
_MOST_VALUE = 1e12
_TO_LPS = np.diag([-1.0, -1.0, 1.0, 1.0])
_SLAB_BYTES = 1 << 25


@dataclass(frozen=True, slots=True)
class NiftiHeader:
    """What the header of a NIfTI file says.

    Attributes:
        size: columns, rows, slices.
        affine_mm: voxel (i, j, k) -> LPS [mm], row by row, 16 numbers.
        misplaced: why it has no place in space; empty if it has.
        flaw: why it is no volume otherwise; empty if it is one.
        digest: of header and values as they stand in the file, however it is compressed: two files
            of one name are two series.
    """

    size: tuple[int, int, int]
    affine_mm: tuple[float, ...]
    misplaced: str
    flaw: str
    digest: str


@dataclass(frozen=True, slots=True, eq=False)
class NiftiValues:
    """The values of a NIfTI file.

    Attributes:
        values: shape (K, J, I), int16 where each fits exactly, else float32.
        lowest: of them.
        affine_mm: as in the header.
    """

    values: Annotated[NDArray[Any], ATTACHED]
    lowest: float
    affine_mm: tuple[float, ...]


def nifti_header(path: Path, progress: Progress) -> NiftiHeader:
    """Job of the worker: read the header.

    Raises:
        FileDamagedError: if the file is no NIfTI.
        ExtraMissingError: without the extra `nifti`.
    """
    image = _opened(path)
    affine, misplaced = _placed(image)
    size = [*(int(n) for n in image.shape[:3]), 1, 1, 1]
    numbers = tuple(float(number) for number in affine.ravel())
    grid = size[0], size[1], size[2]
    return NiftiHeader(grid, numbers, misplaced, _flaw(image), _digest(path, progress))


def _digest(path: Path, progress: Progress) -> str:
    """Digest of the file's content [16 hexadecimal digits]."""
    found, size = hashlib.blake2b(digest_size=8), max(path.stat().st_size, 1)
    with path.open("rb") as file:
        packed = file.read(2) == b"\x1f\x8b"
        file.seek(0)
        try:
            with gzip.GzipFile(fileobj=file) if packed else file as stream:
                while part := stream.read(_SLAB_BYTES):
                    found.update(part)
                    progress.report(min(file.tell() / size, 1.0), sentence("reading"))
        except (EOFError, OSError, zlib.error) as error:
            raise FileDamagedError(sentence("it is cut off or damaged")) from error
    return found.hexdigest()


def nifti_values(path: Path, progress: Progress) -> NiftiValues:
    """Job of the worker: read the values.

    Raises:
        FileDamagedError: if they cannot be read, or are no numbers.
        ExtraMissingError: without the extra `nifti`.
    """
    image = _opened(path)
    affine, _ = _placed(image)
    size = tuple(int(n) for n in image.shape[:3])
    values: NDArray[Any] = np.empty(size[::-1], np.int16)
    for start, slab in _slabs(image, size):
        progress.report(
            start / size[2], sentence("slice {current} of {size}", current=start + 1, size=size[2])
        )
        if not np.isfinite(slab).all():
            raise FileDamagedError(
                sentence("it holds values that are no numbers (NaN or infinite)")
            )
        largest = max(abs(float(slab.min())), abs(float(slab.max())))
        if largest > _MOST_VALUE:
            raise FileDamagedError(
                sentence(
                    "it holds the value {largest:g}; {most_value:g} is the most that is read",
                    largest=largest,
                    most_value=_MOST_VALUE,
                )
            )
        if values.dtype == np.int16 and not _fits(slab):
            values = values.astype(np.float32)
        values[start : start + len(slab)] = slab
    return NiftiValues(values, float(values.min()), tuple(affine.ravel().tolist()))


def _opened(path: Path) -> Any:
    if not path.is_file():  # opening a pipe would wait for ever
        raise FileDamagedError(sentence("it is not a regular file"))
    nibabel = extra("nibabel", "NIfTI files")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        image = nibabel.load(str(path), mmap=False, keep_file_open=True)
    if not hasattr(image.header, "get_sform"):
        raise FileDamagedError(
            sentence("it is {format_name}, not NIfTI", format_name=type(image).__name__)
        )
    return image


def _placed(image: Any) -> tuple[FloatArray, str]:
    """Affine (i, j, k) -> LPS [mm], and what is wrong with it."""
    header = image.header
    sform, s_code = header.get_sform(coded=True)
    qform, q_code = header.get_qform(coded=True)
    if not s_code and not q_code:
        return np.eye(4), "does not say where it lies (neither sform nor qform is set)"
    affine: FloatArray = np.array(sform if s_code else qform, np.float64)
    affine[:3] *= _UNITS_MM[header.get_xyzt_units()[0]]
    affine = _TO_LPS @ affine
    furthest = float(np.abs(affine).max())  # NaN is not above
    if furthest > FURTHEST_MM:
        return np.eye(4), f"lies {furthest:g} mm away; {FURTHEST_MM:g} mm are the most"
    if not np.isfinite(affine).all() or abs(np.linalg.det(affine[:3, :3])) < 1e-9:
        return np.eye(4), "its axes span no volume"
    across, down = affine[:3, 0], affine[:3, 1]
    drift = abs(float(across @ down)) / float(np.linalg.norm(across)) * image.shape[1]
    if drift > _SQUARE_MM:
        return affine, f"sheared: its rows and columns are not perpendicular ({drift:.2f} mm off)"
    return affine, ""


def _flaw(image: Any) -> str:
    shape = image.shape
    if len(shape) not in (3, 4) or (len(shape) == 4 and shape[3] != 1):
        return sentence(
            "has sizes {shape}; one volume is read, no times or vectors",
            shape=" × ".join(map(str, shape)),
        )
    if min(shape[:2]) < 1 or shape[2] < 2:
        return sentence("has {shape} slices; a volume needs at least two", shape=shape[2])
    kind = image.get_data_dtype()
    return (
        ""
        if kind.kind in "iuf"
        else sentence("holds {kind}, not one number for each voxel", kind=kind)
    )


def _slabs(image: Any, size: tuple[int, ...]) -> Iterator[tuple[int, NDArray[Any]]]:
    """Yield the values some slices at a time, shape (slices, J, I), and the first one's number."""
    thick = max(1, _SLAB_BYTES // (8 * size[0] * size[1]))
    for start in range(0, size[2], thick):
        part = np.asanyarray(image.dataobj[:, :, start : start + thick])
        yield start, part.reshape(*size[:2], -1).T


def _fits(slab: NDArray[Any]) -> bool:
    """Return whether 16 bits hold each value exactly."""
    limits = np.iinfo(np.int16)
    if slab.min() < limits.min or slab.max() > limits.max:
        return False
    return slab.dtype.kind in "iu" or not (slab != np.rint(slab)).any()
