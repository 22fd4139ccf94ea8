"""What a control scan's picture shows of a complication, measured in the picture alone.

A scripted hand knows no more than a student: the slices that it was delivered, its needle, where it
aims, and the planning CT. Air is a dark rim next to the chest wall, on the side that lies up; blood
is lung that has become denser about the needle.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.imaging.volume import Volume

AIR_HU: Final = -945.0
"""Darker is air: between aerated lung and air, well away from either."""

LUNG_HU: Final = -600.0
"""Darker is lung or air, brighter chest wall."""

BODY_HU: Final = -300.0
"""Brighter is body."""

SMOOTH_MM: Final = 2.5
"""Noise is smoothed over so much."""

ABOUT_MM: Final = 60.0
"""The rim is looked for so far to both sides of the target."""

EDGE_MM: Final = 3.0
"""Between wall and air lies so much at most that is neither, by partial volume."""

DENSER_HU: Final = 80.0
"""Lung that is denser by so much has blood in it."""

BEHIND_MM: Final = (6.0, 36.0)
"""Blood is looked for about the needle so far behind its tip."""

RING_MM: Final = 2.0
WIDEST_MM: Final = 30.0
LEAST_VOXELS: Final = 12
LEAST_LINES: Final = 4

METAL_MM: Final = 8.0
"""So near to the needle's line its own dark band is taken for no air."""

BAND_HU: Final = -800.0
"""What is taken there in place of air: neither air nor wall."""

UPWARDS: Final = 0.94
"""Cosine of the angle within which air lies below the wall, and not beside it."""


@dataclass(frozen=True, slots=True)
class ScanReading:
    """What was measured.

    Attributes:
        rim_mm: largest depth of air between chest wall and lung in the slices; 0 for none.
        blood_mm: radius of the denser lung about the needle; 0 for none.
    """

    rim_mm: float = 0.0
    blood_mm: float = 0.0


def air_rim_mm(
    picture: Volume,
    target_mm: ArrayLike,
    up: ArrayLike,
    hub_mm: ArrayLike | None = None,
    tip_mm: ArrayLike | None = None,
) -> float:
    """Return the largest depth of air below the uppermost chest wall in straight slices [mm].

    Args:
        picture: slices as delivered, pixels along the patient's left and back.
        target_mm: where the student aims, LPS, shape (3,): air is looked for beside it.
        up: against gravity, LPS, shape (3,): the nearest side of the picture is taken.
        hub_mm: end of the needle at the hand, LPS, shape (3,); None without a needle.
        tip_mm: its other end.
    """
    target, upwards = frozen(target_mm, (3,), "target_mm"), frozen(up, (3,), "up")
    column, row, _ = np.asarray(picture.inverse_mm @ [*target, 1.0])[:3]
    pixel = [float(np.linalg.norm(picture.affine_mm[:3, axis])) for axis in (0, 1)]
    along_x = abs(float(upwards[0])) > abs(float(upwards[1]))
    beside, down = (row, 0) if along_x else (column, 1)
    deepest = 0.0
    for k, layer in enumerate(picture.hu):
        hu = _smooth(layer, pixel)
        if hub_mm is not None and tip_mm is not None:
            _, off = _about_needle(picture, k, frozen(hub_mm, (3,), "hub"), np.asarray(tip_mm))
            hu[(off < METAL_MM) & (hu < BAND_HU)] = BAND_HU
        lines = hu if along_x else hu.T  # one line after another, each from one side to the other
        if float(upwards[down]) * float(picture.affine_mm[down, down]) > 0.0:
            lines = lines[:, ::-1]
        across = pixel[1 - down]
        first = max(0, round(beside - ABOUT_MM / across))
        last = max(first, round(beside + ABOUT_MM / across) + 1)
        deepest = max(deepest, _deepest(lines[first:last], (across, pixel[down])))
    return deepest


def _deepest(lines: NDArray[np.float64], steps_mm: tuple[float, float]) -> float:
    """Return how deep air lies below the wall, on lines from outside inwards [mm].

    It is the largest distance from the wall of the air that lines meet first behind it: airways
    lie deeper.
    """
    from scipy import ndimage  # only who reads a picture waits for it

    begun = [_first_air(line, steps_mm[1]) for line in lines]
    seeds = [(row, at) for row, at in enumerate(begun) if at is not None]
    if len(seeds) < LEAST_LINES:  # what one line alone shows is no rim
        return 0.0
    bodies, count = ndimage.label(lines > BODY_HU)
    sizes = np.bincount(bodies.ravel(), minlength=count + 1)
    sizes[0] = 0
    outside = bodies != int(sizes.argmax())
    away, (_, wall) = ndimage.distance_transform_edt(
        outside, sampling=steps_mm, return_indices=True
    )
    below = (np.arange(lines.shape[1]) - wall) * steps_mm[1] >= UPWARDS * away
    rooms, _ = ndimage.label(lines < AIR_HU)
    inside = np.isin(rooms, np.unique([rooms[seed] for seed in seeds])) & below
    return float(away[inside].max(initial=0.0))


def _first_air(line: NDArray[np.float64], step_mm: float) -> int | None:
    """Return where a line from outside comes to air right behind the wall; None without."""
    body = np.flatnonzero(line > BODY_HU)
    if not len(body):
        return None
    inside = np.flatnonzero(line[body[0] :] < LUNG_HU)
    if not len(inside):
        return None
    wall = int(body[0] + inside[0])
    air = np.flatnonzero(line[wall : wall + max(1, int(EDGE_MM / step_mm)) + 1] < AIR_HU)
    if not len(air) or not (line[wall:] > BODY_HU).any():
        return None  # no air, or out of the body again: it was none of its cavities
    return wall + int(air[0])


def blood_radius_mm(picture: Volume, before: Volume, hub_mm: ArrayLike, tip_mm: ArrayLike) -> float:
    """Return how far about the needle lung is denser than in the same slices before [mm].

    Args:
        picture: slices as delivered.
        before: the same slices of the planning CT.
        hub_mm: end of the needle at the hand, LPS, shape (3,).
        tip_mm: its other end.
    """
    hub, tip = frozen(hub_mm, (3,), "hub_mm"), frozen(tip_mm, (3,), "tip_mm")
    if picture.hu.shape != before.hu.shape:
        return 0.0
    pixel = [float(np.linalg.norm(picture.affine_mm[:3, axis])) for axis in (0, 1)]
    denser, known, away = [], [], []
    for k, (layer, old) in enumerate(zip(picture.hu, before.hu, strict=True)):
        behind, off = (part.ravel() for part in _about_needle(picture, k, hub, tip))
        was, now = _smooth(old, pixel).ravel(), _smooth(layer, pixel).ravel()
        near = (behind > BEHIND_MM[0]) & (behind < BEHIND_MM[1]) & (off < WIDEST_MM)
        denser.append((now - was > DENSER_HU)[near])
        known.append((was < LUNG_HU)[near])
        away.append(off[near])
    return _radius(np.concatenate(denser), np.concatenate(known), np.concatenate(away))


def _about_needle(
    picture: Volume, k: int, hub: FloatArray, tip: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return of each pixel how far behind the tip and how far off the needle's line it is [mm]."""
    rows, columns = np.mgrid[: picture.hu.shape[1], : picture.hu.shape[2]]
    ijk = np.stack([columns.ravel(), rows.ravel(), np.full(rows.size, k)], axis=1)
    places, way = picture.lps_mm(ijk), (tip - hub) / max(float(np.linalg.norm(tip - hub)), 1e-9)
    behind = (tip - places) @ way
    off = np.linalg.norm(places - tip + behind[:, None] * way, axis=1)
    return behind.reshape(rows.shape), off.reshape(rows.shape)


def _radius(denser: NDArray[np.bool_], lung: NDArray[np.bool_], away: FloatArray) -> float:
    radius = 0.0
    for inner in np.arange(RING_MM, WIDEST_MM, RING_MM):  # within the first ring lies the needle
        ring = lung & (away >= inner) & (away < inner + RING_MM)
        if ring.sum() < LEAST_VOXELS or denser[ring].mean() < 0.5:
            break
        radius = float(inner + RING_MM)
    return radius


def _smooth(layer: NDArray[np.int16], pixel: list[float]) -> NDArray[np.float64]:
    from scipy import ndimage

    size = [max(1, round(SMOOTH_MM / step)) for step in (pixel[1], pixel[0])]
    return np.asarray(ndimage.uniform_filter(layer.astype(np.float64), size, mode="nearest"))
