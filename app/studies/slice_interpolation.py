"""Study: nearest, trilinear or cubic for oblique slices.

A band-limited volume whose value is known everywhere, sampled like a CT (0.8 x 0.8 x 1.5 mm), is
cut by an oblique plane of 512 x 512 pixels. Structures of four sizes, by shortest wavelength.
"""

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.rotation import rotation_exp
from app.imaging.interpolation import Interpolation
from app.imaging.oblique import Plane, oblique_image
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.studies.in_use import default_of
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Oblique slices: nearest, trilinear, cubic",
    "question": "Which interpolation is good enough to look at, and fast enough to scroll?",
    "reference": "analytic band-limited field, exact to 1e-10 HU; its float32 samples to 6e-5 HU",
}

_SPACING_MM: Final = (0.8, 0.8, 1.5)
_SIZE: Final = (256, 256, 128)
_PICTURE: Final = 512
_WAVES: Final = 12
_CONTRAST_HU: Final = 100.0  # standard deviation of the volume: soft tissue, vessels, fat
_AMPLITUDE_HU: Final = _CONTRAST_HU * float(np.sqrt(2.0 / _WAVES))
_SEEN_HU: Final = 10.0


def _waves(wavelength_mm: float) -> tuple[FloatArray, FloatArray]:
    """Wave vectors [rad/mm], shape (n, 3), and phases, shape (n,), of 1 to 3 wavelengths."""
    random = np.random.default_rng(11)
    directions = random.normal(size=(_WAVES, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    lengths = wavelength_mm * np.linspace(1.0, 3.0, _WAVES)
    return 2.0 * np.pi * directions / lengths[:, None], random.uniform(0.0, 2.0 * np.pi, _WAVES)


def field(points_mm: FloatArray, wavelength_mm: float) -> FloatArray:
    """Return the exact value [HU] at points, shape (..., 3)."""
    vectors, phases = _waves(wavelength_mm)
    total = np.zeros(points_mm.shape[:-1])
    for vector, phase in zip(vectors, phases, strict=True):
        total += np.cos(points_mm @ vector + phase)
    return total * _AMPLITUDE_HU


def sampled(wavelength_mm: float) -> Volume:
    """Sample the field like a CT; float32, so the samples are exact to 6e-5 HU.

    A wave on a grid is a product of three one-dimensional ones, so a slice is a matrix product.
    """
    vectors, phases = _waves(wavelength_mm)
    x, y, z = (
        np.exp(1j * np.outer(vectors[:, axis], np.arange(_SIZE[axis]) * _SPACING_MM[axis]))
        for axis in range(3)
    )
    z *= np.exp(1j * phases)[:, None]
    hu = np.empty(_SIZE[::-1], np.float32)
    for index in range(_SIZE[2]):
        hu[index] = ((y * z[:, index, None]).T @ x).real * _AMPLITUDE_HU
    series = Series("study", "CT", "", _SIZE, None, None, None, True, "", (), "", "", ())
    return Volume(hu, np.diag([*_SPACING_MM, 1.0]), series)


def oblique_plane() -> Plane:
    """Plane of the study: through the middle, along no axis, within the volume."""
    turn = rotation_exp([0.5, 0.35, 0.3])
    middle = (np.array(_SIZE) - 1) * np.array(_SPACING_MM) / 2.0
    return Plane.centred(middle, turn[:, 0], turn[:, 1], 0.24, _PICTURE, _PICTURE)


def _case(setting: Setting) -> Case:
    wavelength = setting.values["wavelength_mm"]
    plane = oblique_plane()
    exact = field(plane.points_mm(), wavelength)

    def error(picture: Any) -> float:
        return float(np.sqrt(np.mean((picture.astype(np.float64) - exact) ** 2)))

    return Case((sampled(wavelength), plane), error, _SEEN_HU)


def _way(interpolation: Interpolation) -> Callable[[Case], Prepared]:
    def prepare(case: Case) -> Prepared:
        volume, plane = case.data
        out = np.empty((plane.rows, plane.columns), np.float32)
        return Prepared(lambda: oblique_image(volume, plane, interpolation, out=out))

    return prepare


_WAYS: Final = tuple(
    Way(way.value, way.value, _way(way), "one 512 x 512 oblique slice", way)
    for way in Interpolation
)

STUDY: Final = Study(
    error_label="RMS error of the picture [HU], contrast 100 HU",
    ways=_WAYS,
    settings=tuple(
        Setting(f"{wavelength:g} mm", {"wavelength_mm": wavelength})
        for wavelength in (40.0, 20.0, 10.0, 5.0)
    ),
    case=_case,
    deadline=Limit(16e-3, "16 ms: one frame"),
    perception=Limit(_SEEN_HU, "10 HU: noise of a diagnostic CT"),
    default="trilinear",
    because="below the noise down to structures of 5 mm, and within a frame",
    in_use=lambda: default_of(oblique_image, "interpolation"),
)
