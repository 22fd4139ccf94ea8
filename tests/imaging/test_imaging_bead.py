"""Centres of beads: finer than a voxel, and refused where there is no bead."""

import numpy as np
import pytest

from app.core.arrays import FloatArray
from app.core.rotation import rotation_exp
from app.imaging.errors import BeadError, OutsideImageError
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.planning.registration.points import find_bead

SPACING = np.array([0.7, 0.7, 1.0])
SIZE = (40, 34, 30)
SERIES = Series("u", "CT", "l", SIZE, None, None, None, True, "", (), "CT-0", "", ())


def phantom(
    beads: list[FloatArray], diameter: float = 3.0, noise: float = 20.0, peak: float = 3000.0
) -> Volume:
    """Beads in water with partial volume (64 points a voxel), slight blur, noise, 12-bit limit."""
    rotation = rotation_exp(np.array([0.1, -0.2, 0.3]))
    affine = np.eye(4)
    affine[:3, :3] = rotation * SPACING
    affine[:3, 3] = (-30.0, 12.0, 400.0)
    i, j, k = SIZE
    grid = np.stack(np.meshgrid(*map(np.arange, (k, j, i)), indexing="ij")[::-1], axis=-1)
    fill = np.zeros((k, j, i))
    offsets = (np.arange(4) + 0.5) / 4 - 0.5
    for offset in np.stack(np.meshgrid(offsets, offsets, offsets), axis=-1).reshape(-1, 3):
        points = (grid + offset) @ affine[:3, :3].T + affine[:3, 3]
        for bead in beads:
            fill += (((points - bead) ** 2).sum(axis=-1) <= 0.25 * diameter**2) / 64.0
    from scipy.ndimage import gaussian_filter

    hu = peak * gaussian_filter(fill, 0.5) + noise * np.random.default_rng(4).standard_normal(
        fill.shape
    )
    return Volume(np.clip(hu, -1024, 3071).astype(np.int16), affine, SERIES)


def at(ijk: tuple[float, float, float]) -> FloatArray:
    volume = phantom([], noise=0.0)
    return volume.lps_mm(ijk)


@pytest.mark.parametrize("offset", [(0.0, 0.0, 0.0), (0.5, 0.5, 0.5), (0.2, -0.4, 0.35)])
def test_the_centre_is_found_to_a_tenth_of_a_voxel(offset: tuple[float, float, float]) -> None:
    truth = at((20 + offset[0], 20 + offset[1], 18 + offset[2]))
    volume = phantom([truth])
    click = truth + np.array([1.4, -1.2, 1.0])
    bead = find_bead(volume, click, 3.0)
    assert np.linalg.norm(bead.centre_mm - truth) < 0.07
    assert bead.diameter_mm == pytest.approx(3.0, abs=0.5)
    assert bead.moved_mm == pytest.approx(2.1, abs=0.15)


def test_a_second_bead_two_diameters_away_does_not_pull() -> None:
    truth = at((20.3, 20.1, 18.2))
    volume = phantom([truth, truth + np.array([6.5, 0.0, 0.0])])
    assert np.linalg.norm(find_bead(volume, truth + 0.5, 3.0).centre_mm - truth) < 0.1


def test_a_click_beside_every_bead_is_refused() -> None:
    volume = phantom([at((10, 10, 10))])
    with pytest.raises(BeadError, match="no bead within"):
        find_bead(volume, at((30, 26, 24)), 3.0)


def test_something_large_is_no_bead() -> None:
    truth = at((22, 20, 18))
    with pytest.raises(BeadError, match="bone, or two beads"):
        find_bead(phantom([truth], diameter=12.0), truth, 3.0)


def test_a_bead_cut_off_by_the_edge_is_refused() -> None:
    truth = at((1.0, 20, 18))
    with pytest.raises(BeadError, match="reaches the edge"):
        find_bead(phantom([truth]), truth, 3.0)


def test_a_click_outside_is_refused() -> None:
    with pytest.raises(OutsideImageError):
        find_bead(phantom([at((20, 20, 18))]), np.array([900.0, 0.0, 0.0]), 3.0)
