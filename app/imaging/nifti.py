"""NIfTI files for practice: one file, one volume, placed by its sform, else its qform.

NIfTI says nothing of what its values mean. Where they go down to air they are taken as Hounsfield
units, else as values without a unit; both are said. Its axes count to the patient's right and
front, those of DICOM to the left and back: the affine is turned accordingly.
"""

import hashlib
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.progress import Progress
from app.imaging import memory
from app.imaging.errors import FileDamagedError, SeriesRefusedError, TooLargeError
from app.imaging.series import Ignored, Series
from app.imaging.structures.errors import ExtraMissingError
from app.imaging.structures.extras import extra
from app.imaging.volume import Volume

MODALITY = "NIfTI"
AIR_HU = -500.0
"""Values below this are air: then the values are Hounsfield units."""

UNIT_UNKNOWN = "NIfTI, for practice only: its unit is not said, values below −500 count as air"

_UNITS_MM = {"mm": 1.0, "unknown": 1.0, "meter": 1000.0, "micron": 0.001}
_SQUARE_MM = 0.01
_TO_LPS = np.diag([-1.0, -1.0, 1.0, 1.0])


def find_nifti(path: Path) -> Series | Ignored:
    """Read the header of a NIfTI file.

    Returns:
        The series that it is, usable or not, or why the file is none.
    """
    try:
        image = _opened(path)
        affine, flaw = _placed(image)
        size = tuple(int(n) for n in image.shape[:3])
    except ExtraMissingError as error:
        return Ignored(path, str(error))
    except Exception as error:  # nibabel raises whatever the bytes lead it to
        brief = " ".join(f"{type(error).__name__}: {error}".split())[:120]
        return Ignored(path, f"not a NIfTI file that can be read ({brief})")
    size = (*size, *(1,) * (3 - len(size)))
    reason = flaw or _shape_flaw(image) or memory.need_of((size[0], size[1], size[2]), 4).reason
    spacing = np.linalg.norm(affine[:3, :3], axis=0)
    x, y, z = affine[:3, 3].tolist()
    return Series(
        uid=f"nifti-{hashlib.sha256(path.name.encode()).hexdigest()[:8]}",
        modality=MODALITY,
        label="NIfTI file",
        size=(size[0], size[1], size[2]),
        spacing_mm=None if flaw else (float(spacing[0]), float(spacing[1]), float(spacing[2])),
        origin_mm=None if flaw else (x, y, z),
        direction=None if flaw else tuple((affine[:3, :3] / spacing).ravel().tolist()),
        usable=not reason,
        reason=reason,
        slices=(),
        pseudonym="NIfTI",
        frame_of_reference="",
        windows=(),
        notes=(UNIT_UNKNOWN,),
        unit="",
        volume_file=path,
    )


def read_nifti(series: Series, progress: Progress | None = None) -> Volume:
    """Read the volume of a NIfTI file.

    A left-handed grid is turned over along k, so that i, j, k are right-handed; nothing is
    interpolated.

    Raises:
        SeriesRefusedError: if the series is not usable.
        TooLargeError: if it does not fit the memory that is free now.
        FileDamagedError: if the file has changed since the scan or cannot be read.
        ExtraMissingError: without the extra `nifti`.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    path = series.volume_file
    if path is None or not series.usable:
        raise SeriesRefusedError(f"series {series.key} cannot be used: {series.reason}")
    if too_large := memory.need_of(series.size, 4).reason:
        raise TooLargeError(f"{path.name} {too_large}")
    progress.report(0.0, f"reading {path.name}")
    try:
        image = _opened(path)
        affine, _ = _placed(image)
        values = _values(image)
    except (ExtraMissingError, FileDamagedError):
        raise
    except Exception as error:  # nibabel raises whatever the bytes lead it to
        brief = " ".join(f"{type(error).__name__}: {error}".split())[:120]
        raise FileDamagedError(f"{path} cannot be read ({brief})") from error
    if values.shape != series.size[::-1]:
        raise FileDamagedError(f"{path} has changed since it was found; open it again")
    if np.linalg.det(affine[:3, :3]) < 0.0:
        values = np.ascontiguousarray(values[::-1])
        affine = affine @ _turned_over(len(values))
    progress.report(0.9, "looking for air")
    unit = "HU" if float(values.min()) < AIR_HU else ""
    progress.report(1.0, f"{path.name} read")
    return Volume(read_only(values), affine, replace(series, unit=unit), unit=unit)


def _opened(path: Path) -> Any:
    nibabel = extra("nibabel", "NIfTI files")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        image = nibabel.load(str(path), mmap=False)
    if not hasattr(image.header, "get_sform"):
        raise FileDamagedError(f"{path.name} is {type(image).__name__}, not NIfTI")
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
    if not np.isfinite(affine).all() or abs(np.linalg.det(affine[:3, :3])) < 1e-9:
        return np.eye(4), "its axes span no volume"
    across, down = affine[:3, 0], affine[:3, 1]
    drift = abs(float(across @ down)) / float(np.linalg.norm(across)) * image.shape[1]
    if drift > _SQUARE_MM:
        return affine, f"sheared: its rows and columns are not perpendicular ({drift:.2f} mm off)"
    return affine, ""


def _shape_flaw(image: Any) -> str:
    shape = image.shape
    if len(shape) not in (3, 4) or (len(shape) == 4 and shape[3] != 1):
        return f"has sizes {' × '.join(map(str, shape))}; one volume is read, no times or vectors"
    if min(shape[:2]) < 1 or shape[2] < 2:
        return f"has {shape[2]} slices; a volume needs at least two"
    kind = image.get_data_dtype()
    return "" if kind.kind in "iuf" else f"holds {kind}, not one number for each voxel"


def _values(image: Any) -> NDArray[Any]:
    """Values, shape (K, J, I): int16 where each fits exactly, else float32."""
    stored = np.asanyarray(image.dataobj)
    values: NDArray[Any] = stored.reshape(stored.shape[:3]).T
    if not np.isfinite(values).all():
        raise FileDamagedError("it holds values that are no numbers (NaN or infinite)")
    limits = np.iinfo(np.int16)
    fits = limits.min <= values.min() and values.max() <= limits.max
    if fits and (values.dtype.kind in "iu" or not (values != np.rint(values)).any()):
        return np.ascontiguousarray(values, np.int16)
    return np.ascontiguousarray(values, np.float32)


def _turned_over(slices: int) -> FloatArray:
    """Affine from k counted from the other end to k, shape (4, 4)."""
    turn = np.diag([1.0, 1.0, -1.0, 1.0])
    turn[2, 3] = slices - 1.0
    return turn
