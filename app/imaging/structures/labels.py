"""Label maps as NIfTI files: each whole number above 0 is a structure."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from app.imaging.errors import brief
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.extras import extra
from app.imaging.structures.placing import Found, Labelled

LARGEST = 2_000_000_000
MOST_LABELS = 256
_UNITS_MM = {"mm": 1.0, "unknown": 1.0, "meter": 1000.0, "micron": 0.001}


def read_labels(path: Path) -> Found:
    """Read the labels of a NIfTI file, placed by its sform, else its qform.

    Raises:
        StructureFileError: if the file is damaged, has no place in space, or is no label map.
        ExtraMissingError: without the extra `nifti`.
    """
    nibabel = extra("nibabel", "NIfTI files")
    try:
        image: Any = nibabel.load(str(path), mmap=False)
        affine, shape = _affine(image, path), image.shape
        if len(shape) == 4 and shape[3] == 1:
            shape = shape[:3]
        if len(shape) != 3 or min(shape) < 1 or np.prod(shape, dtype=np.float64) > LARGEST:
            raise StructureFileError(f"{path.name} has sizes {image.shape}; three are read")
        values = np.asanyarray(image.dataobj).reshape(shape)
    except (StructureFileError, MemoryError):
        raise
    except Exception as error:  # nibabel raises whatever the bytes lead it to
        what = brief(error)
        raise StructureFileError(f"{path.name} cannot be read as NIfTI ({what})") from error
    exact = values.dtype.kind in "iub"
    if not exact and (not np.isfinite(values).all() or (np.rint(values) != values).any()):
        raise StructureFileError(f"{path.name} holds fractions; a label map holds whole numbers")
    labels = [int(label) for label in np.unique(values) if label > 0]
    if not labels or len(labels) > MOST_LABELS:
        raise StructureFileError(
            f"{path.name} holds {len(labels)} labels above 0; a label map holds 1 to {MOST_LABELS}"
        )
    stem = path.name.split(".")[0]
    names = [stem] if len(labels) == 1 else [f"{stem} {label}" for label in labels]
    kji = values.transpose(2, 1, 0)
    named = zip(names, labels, strict=True)
    return Found((Labelled(name, kji == label, affine) for name, label in named), len(labels))


def _affine(image: Any, path: Path) -> Any:
    """Voxel (i, j, k) -> LPS [mm]."""
    header = image.header
    if not hasattr(header, "get_sform"):
        raise StructureFileError(f"{path.name} is {type(image).__name__}, not NIfTI")
    sform, s_code = header.get_sform(coded=True)
    qform, q_code = header.get_qform(coded=True)
    if not s_code and not q_code:
        raise StructureFileError(
            f"{path.name} does not say where it lies (neither sform nor qform is set)"
        )
    unit = _UNITS_MM[header.get_xyzt_units()[0]]
    affine = np.array(sform if s_code else qform, np.float64)
    affine[:3] *= unit
    affine[:2] *= -1.0  # RAS -> LPS
    if not np.isfinite(affine).all() or abs(np.linalg.det(affine[:3, :3])) < 1e-9:
        raise StructureFileError(f"{path.name}: its axes span no volume")
    return affine
