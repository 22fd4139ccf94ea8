"""A picture of an exercise's patient: three coarse slices through the target, kept in the cache.

It holds grey values of the CT and the plan's two points, and nothing of whose they are; its file is
named by a digest of exercise and patient. Those of the shipped exercises on built-in patients ship
with them (`tools.portraits`). Whoever opens another patient makes it at hardly any cost; else it is
made in the background, once.
"""

from __future__ import annotations

import hashlib
import io
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core import paths
from app.core.arrays import FloatArray, read_only
from app.core.errors import AcusError
from app.core.files import write_atomically
from app.core.messages import sentence
from app.core.progress import Progress
from app.exercises.scene import draft_of
from app.exercises.schema import Exercise
from app.imaging.volume import Volume
from app.imaging.window import PRESETS

PIXELS: Final = 340
"""Pixels along the longest side of the patient."""

AIR_GREY: Final = 12
"""What is no brighter is air around the patient [grey value of 255]."""

COARSE: Final = (100, 192)
"""Slices and rows of a phantom that is made for its picture alone: 1 in 20 of the whole."""

_MARGIN_MM: Final = 6.0
_VERSION: Final = 2

ACROSS: Final = {"axial": (0, 1), "coronal": (0, 2), "sagittal": (1, 2)}
"""Slice -> LPS axes that run to its right and, x and y downwards but z upwards, down it."""


@dataclass(frozen=True, slots=True, eq=False)
class Portrait:
    """Slices through the target, as radiologists look at them: axial from below, feet down.

    Attributes:
        slices: grey values by `axial`, `coronal` and `sagittal`, uint8, row 0 on top.
        low_mm, high_mm: corners of the box that they cover, DICOM LPS [mm].
        target_mm: where they meet, LPS [mm].
        entry_mm: where the plan enters, LPS [mm]; None where the student chooses it.
    """

    slices: dict[str, NDArray[np.uint8]]
    low_mm: tuple[float, ...]
    high_mm: tuple[float, ...]
    target_mm: tuple[float, ...]
    entry_mm: tuple[float, ...] | None = None

    def place(self, name: str, point_mm: tuple[float, ...]) -> tuple[float, float]:
        """Return where a point lies in a slice: shares of its width and height, from its top left.

        Args:
            name: of the slice.
            point_mm: patient LPS [mm]; what lies before or behind the slice is projected.
        """
        right, down = ACROSS[name]
        low, high = self.low_mm, self.high_mm
        x = (point_mm[right] - low[right]) / (high[right] - low[right])
        y = (point_mm[down] - low[down]) / (high[down] - low[down])
        return x, 1.0 - y if down == 2 else y


def portrait_file(exercise: Exercise, folder: Path | None = None) -> Path:
    """Return where the picture of an exercise's patient is kept, made or not.

    Args:
        exercise: whose patient.
        folder: of pictures; the cache's without it.
    """
    ct = exercise.ct
    content = (_VERSION, ct.model_dump_json(), exercise.model_dump_json(include={"plan"}))
    name = hashlib.sha256(repr(content).encode()).hexdigest()[:24]
    return (folder or paths.cache() / "portraits") / f"{name}.npz"


def shipped_portraits() -> Path:
    """Return the folder of the pictures that ship with the program."""
    return paths.resources() / "portraits"


def kept_portrait(exercise: Exercise) -> Portrait | None:
    """Return the picture that ships or is kept; None if there is none, or none can be read."""
    shipped = _read(portrait_file(exercise, shipped_portraits()))
    return shipped or _read(portrait_file(exercise))


def _read(file: Path) -> Portrait | None:
    try:
        with np.load(file, allow_pickle=False) as content:
            slices = {name: read_only(content[name].astype(np.uint8)) for name in ACROSS}
            low, high, target = (tuple(content[n].tolist()) for n in ("low", "high", "target"))
            entry = tuple(content["entry"].tolist()) or None
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    return Portrait(slices, low, high, target, entry)


def make_portrait(exercise: Exercise, volume: Volume, folder: Path | None = None) -> Portrait:
    """Make and keep the picture of a patient who is open; some ten milliseconds.

    Args:
        exercise: whose patient.
        volume: his CT.
        folder: where pictures are kept; in the cache without it.

    Raises:
        AcusError: if the exercise's plan cannot be read.
    """
    draft = draft_of(exercise)
    target = draft.target_mm
    if target is None:
        raise AcusError(
            sentence("exercise {exercise_id} has no target to picture", exercise_id=exercise.id)
        )
    entry = None if draft.entry_mm is None else tuple(float(x) for x in draft.entry_mm)
    made = _pictured(volume, tuple(float(x) for x in target), entry)
    packed = io.BytesIO()
    ends = {"low": made.low_mm, "high": made.high_mm, "target": made.target_mm}
    np.savez_compressed(packed, **made.slices, **ends, entry=np.array(entry or ()))  # type: ignore[arg-type]
    write_atomically(portrait_file(exercise, folder), packed.getvalue())
    return made


def find_portrait(
    exercise: Exercise, volume: Volume | None = None, progress: Progress | None = None
) -> Portrait | None:
    """Return the picture of an exercise's patient, whose CT is read for it where there is none.

    Called beside the window; seconds where the CT has to be read. None where that cannot be.

    Args:
        exercise: whose patient.
        volume: his CT where it is open: the picture is made of it.
        progress: may cancel.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    kept = kept_portrait(exercise)
    if kept is not None:
        return kept
    try:
        return make_portrait(exercise, volume or _volume_of(exercise, progress or Progress()))
    except (AcusError, OSError):
        return None  # whoever begins the exercise is told what is wrong with its CT


def _volume_of(exercise: Exercise, progress: Progress) -> Volume:
    from app.core.loading import turn

    with turn(progress):  # pydicom: behind the window, not before it
        from app.imaging.phantom.series import phantom_series
        from app.imaging.reading import choose, load_ct, read_with
        from app.imaging.scanning import scan_folder
    ct = exercise.ct
    if ct.folder is None:
        seed, (slices, rows) = ct.phantom.seed if ct.phantom else 1, COARSE
        folder = phantom_series(seed, progress.part(0.0, 0.5), slices=slices, rows=rows)
        return load_ct(folder, progress=progress.part(0.5, 1.0))
    listing = scan_folder(ct.folder, progress.part(0.0, 0.3))
    series = choose(listing, ct.series, ct.remedy)
    return read_with(series, ct.remedy, progress.part(0.3, 1.0))


def _pictured(
    volume: Volume, target: tuple[float, ...], entry: tuple[float, ...] | None
) -> Portrait:
    """Sample the nearest voxels of three planes, then leave out the air around the patient."""
    ends = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float) * (
        np.array(volume.size) - 1
    )
    corners = volume.lps_mm(ends)
    low, high = corners.min(axis=0), corners.max(axis=0)
    step = float((high - low).max()) / PIXELS
    whole = {name: _slice(volume, name, np.array(target), low, high, step) for name in ACROSS}
    low, high = _around_patient(whole, low, high, step, [target, *([entry] if entry else [])])
    slices = {
        name: read_only(_slice(volume, name, np.array(target), low, high, step)) for name in ACROSS
    }
    return Portrait(slices, tuple(low.tolist()), tuple(high.tolist()), target, entry)


def _slice(
    volume: Volume, name: str, through: FloatArray, low: FloatArray, high: FloatArray, step: float
) -> NDArray[np.uint8]:
    right, down = ACROSS[name]
    across = np.arange(low[right], high[right], step)
    along = np.arange(low[down], high[down], step)
    if down == 2:
        along = along[::-1]  # the head is on top
    points = np.empty((len(along), len(across), 3))
    points[:] = through
    points[:, :, right] = across
    points[:, :, down] = along[:, None]
    voxel = np.rint(volume.voxel(points.reshape(-1, 3))).astype(int)
    size = np.array(volume.size)
    inside = ((voxel >= 0) & (voxel < size)).all(axis=1)
    i, j, k = np.clip(voxel, 0, size - 1).T
    window = PRESETS["Soft tissue"]
    dark = window.level - 0.5 * window.width
    grey = (volume.hu[k, j, i].astype(float) - dark) / window.width
    grey = np.where(inside, np.clip(grey, 0.0, 1.0), 0.0)
    return (255.0 * grey).astype(np.uint8).reshape(len(along), len(across))


def _around_patient(
    slices: dict[str, NDArray[np.uint8]],
    low: FloatArray,
    high: FloatArray,
    step: float,
    points: list[tuple[float, ...]],
) -> tuple[FloatArray, FloatArray]:
    """Return the box of what is brighter than air, plan included, with a margin."""
    least, most = low.copy(), high.copy()
    for axis in range(3):
        found = []
        for name, picture in slices.items():
            if axis not in ACROSS[name]:
                continue
            right = ACROSS[name][0] == axis
            bright = (picture > AIR_GREY).mean(axis=0 if right else 1) > 0.02
            if axis == 2:
                bright = bright[::-1]
            if bright.any():
                places = np.flatnonzero(bright)
                found.append((places[0], places[-1] + 1))
        near, far = [point[axis] for point in points], [point[axis] for point in points]
        if found:
            near.append(low[axis] + step * min(first for first, _ in found))
            far.append(low[axis] + step * max(last for _, last in found))
            least[axis] = max(low[axis], min(near) - _MARGIN_MM)
            most[axis] = min(high[axis], max(far) + _MARGIN_MM)
    return least, most
