"""Study: how fine the grid is that a bone's surface is taken from.

Bones whose surface is known: rings as thick as ribs, and a ball like a femoral head, in soft
tissue, sampled like a CT (0.8 × 0.8 × 1.5 mm) with edges blurred by a millimetre. The extractor is
the program's own, lent by the 3D view.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.core.rotation import rotation_exp
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.studies.in_use import called, default_of
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Surfaces of the 3D view: resolution of the grid against time",
    "question": "How fine must the grid be that a bone's surface is taken from?",
    "reference": "signed distance of rings and balls in closed form, 1e-12 mm",
}

_SPACING_MM: Final = (0.8, 0.8, 1.5)
_SIZE: Final = (220, 220, 110)
_BONE_HU: Final = 240.0
_SLOPE: Final = 400.0  # [HU/mm] of a bone's edge
_RING_MM: Final = 60.0
_SEEN_MM: Final = 0.5
_STEPS_MM: Final = (1.6, 2.4, 3.2, 4.8, 6.4)

Extract = Callable[..., Any]


def distance(points_mm: FloatArray, radius: float, ring: bool) -> FloatArray:
    """Distance to the bone's surface, below 0 inside [mm]; points (..., 3) -> (...)."""
    turned = points_mm @ rotation_exp([0.4, 0.3, 0.2])
    if ring:
        beside = np.hypot(turned[..., 0], turned[..., 1]) - _RING_MM
        return np.asarray(np.hypot(beside, turned[..., 2]) - radius)
    return np.asarray(np.linalg.norm(turned, axis=-1) - radius)


def bone(radius: float, ring: bool, densest_hu: float) -> Volume:
    """Return a CT of the bone in soft tissue, int16."""
    i, j, k = ((np.arange(n) - (n - 1) / 2.0) * s for n, s in zip(_SIZE, _SPACING_MM, strict=True))
    points = np.stack(np.broadcast_arrays(*np.ix_(i, j, k)), axis=-1)
    hu = np.clip(_BONE_HU - _SLOPE * distance(points, radius, ring), 40.0, densest_hu)
    affine = np.diag([*_SPACING_MM, 1.0])
    affine[:3, 3] = [i[0], j[0], k[0]]
    series = Series("study", "CT", "", _SIZE, None, None, None, True, "", (), "", "", ())
    return Volume(np.ascontiguousarray(hu.transpose(2, 1, 0)).astype(np.int16), affine, series)


def _case(setting: Setting, extract: Extract) -> Case:
    radius, ring = setting.values["radius_mm"], bool(setting.values["ring"])
    volume = bone(radius, ring, setting.values["hu"])

    def error(mesh: Any) -> float:
        return float(np.sqrt(np.mean(distance(mesh.points, radius, ring) ** 2)))

    return Case((extract, volume, np.ones(volume.hu.shape, bool)), error, _SEEN_MM)


def _way(step_mm: float) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        extract, volume, mask = case.data
        return Prepared(lambda: extract(volume, mask, Progress(), step_mm))

    return prepare


def _in_use(extract: Extract, whole: Extract) -> object:
    if called(whole, "bone_surface") is not extract:
        return None
    return default_of(extract, "step_mm")


STUDY: Final = Study(
    error_label="RMS distance of the mesh from the bone [mm]",
    ways=tuple(
        Way(f"{step:g} mm", "flying edges, smoothed", _way(step), "grid of this step", step)
        for step in _STEPS_MM
    ),
    settings=(
        Setting("ring, 10 mm, 440 HU", {"radius_mm": 5.0, "ring": 1.0, "hu": 440.0}),
        Setting("ball, 48 mm, 440 HU", {"radius_mm": 24.0, "ring": 0.0, "hu": 440.0}),
        Setting("ball, 48 mm, 1200 HU", {"radius_mm": 24.0, "ring": 0.0, "hu": 1200.0}),
    ),
    case=lambda setting, extract, whole: _case(setting, extract),
    deadline=Limit(5.0, "5 s in the background, once a CT"),
    perception=Limit(_SEEN_MM, "0.5 mm: a pixel of the 3D view"),
    default="2.4 mm",
    exception=(
        "Dense bone looks up to a millimetre thicker, for blocks of voxels pass the level that it "
        "fills by a fifth; the picture shows where bones are, and nothing is measured on it."
    ),
    in_use=_in_use,
    borrows=(
        "app.views.scene.surfaces:bone_surface",
        "app.views.scene.surfaces:extract_surfaces",
    ),
)
