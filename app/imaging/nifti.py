"""NIfTI files for practice: one file, one volume, placed by its sform, else its qform.

NIfTI says nothing of what its values mean. Where they go down to air they are taken as Hounsfield
units, else as values without a unit; both are said. Its axes count to the patient's right and
front, those of DICOM to the left and back: the affine is turned accordingly.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.progress import Cancelled, Progress
from app.imaging import memory
from app.imaging.errors import (
    FileDamagedError,
    SeriesRefusedError,
    TooLargeError,
    WorkerError,
)
from app.imaging.nifti_file import NiftiHeader
from app.imaging.series import Ignored, Refusal, Series
from app.imaging.structures.errors import ExtraMissingError
from app.imaging.volume import Volume
from app.imaging.worker.jobs import NIFTI_HEADER, NIFTI_VALUES
from app.imaging.worker.limits import MEMORY_BYTES, PACKAGE_SECONDS, Allowance, for_file, size_of
from app.imaging.worker.pool import shared_worker

MODALITY = "NIfTI"
AIR_HU = -500.0
"""Values below this are air: then the values are Hounsfield units."""

UNIT_UNKNOWN = "NIfTI, for practice only: its unit is not said, values below −500 count as air"

_READING = 3.0
"""Copies of the values while they are read: two in the worker, and those that it hands over."""

_COPY_BYTES = 12
"""Memory at work for each voxel while it is read: 16 and 32 bit values, and what is sent."""


def find_nifti(path: Path, progress: Progress | None = None) -> Series | Ignored:
    """Read the header of a NIfTI file.

    Returns:
        The series that it is, usable or not, or why the file is none.

    Raises:
        WorkerError: if the process that reads it cannot be started.
        Cancelled: if `progress` was cancelled.
    """
    allowed = for_file(size_of(path), least=PACKAGE_SECONDS)
    progress = progress or Progress()
    try:
        header = shared_worker().call(NIFTI_HEADER, (path.absolute(),), allowed, progress)
        return _series(path, header)
    except (Cancelled, WorkerError):
        raise
    except ExtraMissingError as error:
        return Ignored(path, str(error))
    except (AcusError, OSError, ValueError) as error:
        return Ignored(path, f"not a NIfTI file that can be read ({error})")


def _series(path: Path, header: NiftiHeader) -> Series:
    affine = _affine(header.affine_mm)
    size, lost = header.size, bool(header.misplaced)
    reason = header.misplaced or header.flaw or memory.need_of(size, 4, _READING).reason
    spacing = np.linalg.norm(affine[:3, :3], axis=0)
    x, y, z = affine[:3, 3].tolist()
    return Series(
        uid=f"nifti-{header.digest}",
        modality=MODALITY,
        label="NIfTI file",
        size=size,
        spacing_mm=None if lost else (float(spacing[0]), float(spacing[1]), float(spacing[2])),
        origin_mm=None if lost else (x, y, z),
        direction=None if lost else tuple((affine[:3, :3] / spacing).ravel().tolist()),
        usable=not reason,
        reason=reason,
        refusal=Refusal.OTHER if reason else Refusal.NOTHING,
        slices=(),
        pseudonym=f"NIfTI-{header.digest[:8]}",
        frame_of_reference="",
        windows=(),
        notes=(UNIT_UNKNOWN,),
        unit="",
        volume_file=path,
    )


def _affine(numbers: tuple[float, ...]) -> FloatArray:
    return np.array(numbers, np.float64).reshape(4, 4)


def read_nifti(series: Series, progress: Progress | None = None) -> Volume:
    """Read the volume of a NIfTI file.

    A left-handed grid is turned over along k, so that i, j, k are right-handed; nothing is
    interpolated.

    Raises:
        SeriesRefusedError: if the series is not usable.
        TooLargeError: if it does not fit the memory that is free now.
        FileDamagedError: if the file has changed since the scan or cannot be read.
        ExtraMissingError: without the extra `nifti`.
        WorkerError: if the process that reads it cannot be started.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    path = series.volume_file
    if path is None or not series.usable:
        raise SeriesRefusedError(
            sentence(
                "series {series_key} cannot be used: {series_reason}",
                series_key=series.key,
                series_reason=series.reason,
            )
        )
    if too_large := memory.need_of(series.size, 4, _READING).reason:
        raise TooLargeError(
            sentence("{path_name} {too_large}", path_name=path.name, too_large=too_large)
        )
    progress.report(0.0, sentence("reading {name}", name=path.name))
    voxels = series.size[0] * series.size[1] * series.size[2]
    seconds = for_file(size_of(path), least=PACKAGE_SECONDS).seconds
    allowed = Allowance(seconds, MEMORY_BYTES + _COPY_BYTES * voxels)
    try:
        read = shared_worker().call(NIFTI_VALUES, (path.absolute(),), allowed, progress)
    except FileDamagedError as error:
        raise type(error)(sentence("{path}: {error}", path=path, error=error)) from error
    except OSError as error:
        raise FileDamagedError(
            sentence(
                "{path} cannot be read: {error_strerror}", path=path, error_strerror=error.strerror
            )
        ) from error
    values, affine = read.values, _affine(read.affine_mm)
    if values.shape != series.size[::-1]:
        raise FileDamagedError(
            sentence("{path} has changed since it was found; open it again", path=path)
        )
    if np.linalg.det(affine[:3, :3]) < 0.0:
        values = np.ascontiguousarray(values[::-1])
        affine = affine @ _turned_over(len(values))
    unit = "HU" if read.lowest < AIR_HU else ""
    progress.report(1.0, sentence("{name} read", name=path.name))
    return Volume(read_only(values), affine, replace(series, unit=unit), unit=unit)


def _turned_over(slices: int) -> FloatArray:
    """Affine from k counted from the other end to k, shape (4, 4)."""
    turn = np.diag([1.0, 1.0, -1.0, 1.0])
    turn[2, 3] = slices - 1.0
    return turn
