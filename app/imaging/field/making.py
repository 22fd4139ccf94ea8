"""The field of a CT: from the built-in patient's recipe or by Hounsfield values, kept in the cache.

    field = field_of(volume, structures, entry_mm, reach_mm, progress=progress)

Making it takes seconds; what was made once is read again in a tenth of a second.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core import paths
from app.core.files import remove, step
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.body import Body, find_body
from app.imaging.errors import ImagingError
from app.imaging.field.errors import FieldError
from app.imaging.field.grid import FieldGrid, grid_over
from app.imaging.field.storing import read, write
from app.imaging.field.tissue_field import TissueField
from app.imaging.memory import available
from app.imaging.structures.structure import Structure
from app.imaging.volume import Volume

REACH_MM: Final = 150.0
"""How far from its entry a needle comes at most, where nobody says it better [mm]."""

SPACING_MM: Final = 1.0

MOST_MB: Final = 96.0
"""A field takes no more memory than this."""

KEPT: Final = 12
"""Fields in the cache; the one that was not used for longest goes."""

_WORKING: Final = 32  # bytes of memory at work for each voxel
_SEEDS: Final = 4096


def field_of(
    volume: Volume,
    structures: Sequence[Structure] = (),
    entry_mm: Any = None,
    reach_mm: float = REACH_MM,
    spacing_mm: float = SPACING_MM,
    progress: Progress | None = None,
    body: Body | None = None,
) -> TissueField:
    """Return the tissue field of a CT, from the cache where it was made before.

    Args:
        volume: the CT; that of a built-in patient is labelled by his recipe.
        structures: on it; they know better than anything else, the first before the others.
        entry_mm: of the needle, LPS, shape (3,); None for all of the CT.
        reach_mm: how far the needle comes from there; beyond it is unknown.
        spacing_mm: 0.5, 1, 2 or 3.
        progress: reports, and may be cancelled: then nothing is kept.
        body: of the CT where it has been found already.

    Raises:
        FieldError: if the field would not fit the memory, the entry lies outside the CT, or the
            values are no Hounsfield values.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    progress.report(0.0, sentence("looking for the tissue field in the cache"))
    place = _place(volume, structures, entry_mm, reach_mm, spacing_mm)
    there = _cached(place)
    if there is not None:
        progress.report(1.0, sentence("the tissue field was there"))
        return there
    field = make(volume, structures, entry_mm, reach_mm, spacing_mm, progress, body)
    _keep(field, place)
    return field


def make(
    volume: Volume,
    structures: Sequence[Structure] = (),
    entry_mm: Any = None,
    reach_mm: float = REACH_MM,
    spacing_mm: float = SPACING_MM,
    progress: Progress | None = None,
    body: Body | None = None,
) -> TissueField:
    """Make the field anew, whatever the cache holds; see `field_of`."""
    from app.imaging.field.from_ct import field_of_ct  # compiled code
    from app.imaging.field.from_recipe import field_of_recipe
    from app.imaging.field.marking import laid_over

    progress = progress or Progress()
    body = body or find_body(volume, progress.part(0.0, 0.1))
    grid, note = grid_over(volume, body, entry_mm, reach_mm, spacing_mm)
    _check_memory(grid)
    rest = progress.part(0.1, 1.0)
    seed = seed_of(volume)
    if seed is None:
        field = field_of_ct(volume, structures, grid, rest, body)
    else:
        field = field_of_recipe(seed, grid, rest)
        if structures:
            field = laid_over(field, structures, grid)
    notes = tuple(filter(None, (note, *field.notes, *_absent(field))))
    return replace(field, notes=notes)


def seed_of(volume: Volume) -> int | None:
    """Return the seed of the built-in patient that a CT shows; None for any other CT."""
    return _seed_of_frame(volume.series.frame_of_reference)


@lru_cache(maxsize=64)
def _seed_of_frame(frame: str) -> int | None:
    if not frame.startswith("2.25."):
        return None
    from app.imaging.phantom.series import uid

    return next((seed for seed in range(_SEEDS) if frame == uid("frame", seed)), None)


def _check_memory(grid: FieldGrid) -> None:
    megabytes = 2.0 * grid.voxels / 1e6
    coarser = [one for one in (1.0, 2.0, 3.0) if one > grid.spacing_mm]
    advice = f"take {coarser[0]:g} mm, or a shorter reach" if coarser else "take a shorter reach"
    if megabytes > MOST_MB:
        raise FieldError(
            sentence(
                "a tissue field of {grid_spacing_mm:g} mm takes {megabytes:.0f} MB here; "
                "{most_mb:g} are allowed: {advice}",
                grid_spacing_mm=grid.spacing_mm,
                megabytes=megabytes,
                most_mb=MOST_MB,
                advice=advice,
            )
        )
    free = available()
    if free is not None and grid.voxels * _WORKING > free:
        raise FieldError(
            sentence(
                "making a tissue field of {grid_spacing_mm:g} mm takes "
                "{grid_voxels:.1f} GB of memory, and {free:.1f} GB are free: "
                "{advice}",
                grid_spacing_mm=grid.spacing_mm,
                grid_voxels=grid.voxels * _WORKING / 1e9,
                free=free / 1e9,
                advice=advice,
            )
        )


def _absent(field: TissueField) -> list[str]:
    """Say which tissues of the table have no voxel though a structure named them."""
    there = np.bincount(field.labels.ravel(), minlength=len(field.tissues)) > 0
    return [
        sentence("structure {tissue_words} lies beyond the reach", tissue_words=tissue.words)
        for tissue in field.tissues
        if tissue.source == "structure" and not there[tissue.code]
    ]


def _place(
    volume: Volume, structures: Sequence[Structure], entry_mm: Any, reach_mm: float, spacing: float
) -> Path:
    """Return the file of the cache, by the digest of all that the field is made from."""
    inputs: list[Any] = [_version(), volume.digest, volume.unit, seed_of(volume)]
    inputs += [None if entry_mm is None else np.round(np.asarray(entry_mm, float), 3).tolist()]
    inputs += [reach_mm, spacing]
    for structure in structures:
        packed = hashlib.sha256(np.packbits(structure.mask).tobytes()).hexdigest()
        grid = [round(float(number), 4) for number in structure.grid_mm.ravel()]
        inputs.append([structure.name, structure.kind.value, structure.mask.shape, grid, packed])
    digest = hashlib.sha256(json.dumps(inputs).encode()).hexdigest()
    return paths.cache() / "tissue" / f"{digest[:32]}.field"


@lru_cache(maxsize=1)
def _version() -> str:
    """Digest of the code that makes fields, so that an older one is never taken for it.

    That finds body and tissue, reads structures and paints the built-in patient, too.
    """
    digest = hashlib.sha256()
    imaging = Path(__file__).parents[1]
    for folder in (imaging, *(imaging / name for name in ("field", "phantom", "structures"))):
        for file in sorted(folder.glob("*.py")):
            digest.update(file.read_bytes())
    return digest.hexdigest()


def _cached(place: Path) -> TissueField | None:
    try:
        field = read(place)
        place.touch()
    except (OSError, ImagingError):
        return None
    return field


def _keep(field: TissueField, place: Path) -> None:
    """Write a field into the cache; a cache that cannot be written is none."""
    with suppress(OSError):
        place.parent.mkdir(parents=True, exist_ok=True)
        place.parent.chmod(0o700)  # a patient's
        write(field, place, small=False)
        files = sorted(place.parent.glob("*.field"), key=lambda file: file.stat().st_mtime)
        for old in files[:-KEPT]:
            step("remove", old)
            remove(old)
