"""Traced backgrounds kept on disk: half a second of work per camera, done once per rig."""

import hashlib
import io
import logging
from collections.abc import Callable
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core import paths
from app.core.files import write_atomically

Traced = NDArray[np.float32]

_SOURCES: Final = ("background.py", "box_kernels.py", "sampling.py")
_KEPT: Final = 12

_log = logging.getLogger(__name__)


def kept_or_traced(
    parts: tuple[bytes, ...], shape: tuple[int, ...], trace: Callable[[], Traced]
) -> Traced:
    """Return what `trace` returned for the same parts before, from the user's cache, or trace now.

    Args:
        parts: everything the picture depends on, besides the code that traces it.
        shape: what the picture must have; a file that is damaged is traced again.
        trace: makes the picture.
    """
    folder = paths.cache() / "backgrounds"
    path = folder / f"{_digest(parts)}.npy"
    kept = _read(path, shape)
    if kept is not None:
        return kept
    traced = trace()
    _keep(path, traced)
    return traced


def _digest(parts: tuple[bytes, ...]) -> str:
    digest = hashlib.sha256()
    here = Path(__file__).resolve().parent
    for part in (*(here.joinpath(name).read_bytes() for name in _SOURCES), *parts):
        digest.update(len(part).to_bytes(8, "little") + part)
    return digest.hexdigest()[:24]


def _read(path: Path, shape: tuple[int, ...]) -> Traced | None:
    try:
        picture = np.load(path, allow_pickle=False)
    except FileNotFoundError:
        return None
    except (OSError, ValueError, EOFError) as error:
        _log.warning("background %s cannot be read and is traced again: %s", path, error)
        return None
    fits = picture.shape == shape and picture.dtype == np.float32 and np.isfinite(picture).all()
    return picture if fits else None


def _keep(path: Path, picture: Traced) -> None:
    buffer = io.BytesIO()
    np.save(buffer, picture, allow_pickle=False)
    try:
        write_atomically(path, buffer.getvalue())
        files = sorted(path.parent.glob("*.npy"), key=lambda file: file.stat().st_mtime)
        for old in files[:-_KEPT]:
            old.unlink(missing_ok=True)
    except OSError as error:  # a read-only home: traced at every start
        _log.info("background %s is not kept: %s", path, error)
