"""The phantom as a folder of DICOM files: made once, kept in the cache."""

import hashlib
import os
import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Final

from app.core import paths
from app.core.errors import ConfigurationError
from app.core.progress import Progress
from app.imaging.phantom.dicom import write_slice
from app.imaging.phantom.lesion import make_patient
from app.imaging.phantom.patient import MODEL_TOP
from app.imaging.phantom.rendering import Scan

_FIELD_MM: Final = 384.0
_THREADS: Final = 2


def phantom_series(
    seed: int = 1, progress: Progress | None = None, *, slices: int = 300, rows: int = 512
) -> Path:
    """Folder of the DICOM CT series of a phantom patient, made at the first call.

    Args:
        seed: which patient, 0 or more.
        progress: told how far the making is; cancels it, leaving nothing behind.
        slices: number of slices over the 300 mm from iliac crests to lung bases.
        rows: rows and columns of a slice, over 384 mm.

    Raises:
        ConfigurationError: if a number is out of range.
        Cancelled: if `progress` was cancelled.
    """
    if seed < 0 or not 2 <= slices <= 2000 or not 16 <= rows <= 2048:
        raise ConfigurationError(
            f"phantom seed {seed}, {slices} slices, {rows} rows: the seed must be 0 or more, "
            "slices 2 to 2000 and rows 16 to 2048"
        )
    name = f"seed{seed}-{slices}x{rows}"
    folder = paths.cache() / "phantom" / f"{name}-{_version()}"
    if not folder.is_dir():
        _make(folder, seed, slices, rows, progress or Progress())
        for older in set(folder.parent.glob(f"{name}-*")) - {folder}:
            shutil.rmtree(older, ignore_errors=True)  # made by an earlier version of the program
    return folder


def _version() -> str:
    """Digest of the code that makes the phantom, so that an older one is never taken for it."""
    digest = hashlib.sha256()
    for file in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:10]


def _make(folder: Path, seed: int, slices: int, rows: int, progress: Progress) -> None:
    """Write beside, then rename: the folder is there whole or not at all."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    beside = Path(tempfile.mkdtemp(dir=folder.parent, prefix=".making-"))
    try:
        _write_all(beside, seed, slices, rows, progress)
        beside.chmod(0o755)
        try:
            os.rename(beside, folder)
        except OSError:
            if not folder.is_dir():  # another process made it meanwhile: take that one
                raise
    finally:
        shutil.rmtree(beside, ignore_errors=True)


def _write_all(folder: Path, seed: int, slices: int, rows: int, progress: Progress) -> None:
    pixel, between = _FIELD_MM / rows, MODEL_TOP / slices
    progress.report(0.0, f"phantom patient {seed}")
    scan = Scan(make_patient(seed), rows, pixel)
    corner = -(rows - 1) / 2 * pixel

    def write(index: int) -> None:
        z = index * between
        hu = scan.slice_hu(z, index)
        name = folder / f"IM{index + 1:04d}.dcm"
        write_slice(name, hu, seed, index, (corner, corner, z), (pixel, between))

    write(0)  # fills what all slices share before the threads start
    with ThreadPoolExecutor(_THREADS) as pool:
        try:
            for done, _ in enumerate(pool.map(write, range(1, slices)), start=2):
                progress.report(done / slices, f"phantom slice {done} of {slices}")
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
