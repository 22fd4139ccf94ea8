"""Lengths of lines inside structures, against dense sampling by scipy and against geometry."""

import numpy as np
import pytest
from scipy import ndimage
from test_imaging_structures import made, turned

from app.imaging.structures.distance import SignedDistance
from app.imaging.structures.inside import meeting, spans_inside
from app.imaging.structures.structure import Structure

SAMPLES = 100_000


def sampled(mask, start, end):
    """Share of a line inside, by values of scipy's own interpolation."""
    places = start + (np.arange(SAMPLES) + 0.5)[:, None] / SAMPLES * (end - start)
    share = ndimage.map_coordinates(
        mask.astype(float), places[:, ::-1].T, order=1, mode="grid-constant"
    )
    return float((share >= 0.5 - 1e-9).mean())


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", range(6))
def test_the_length_inside_any_mask_is_that_of_dense_sampling(seed):
    rng = np.random.default_rng(seed)
    for trial in range(8):
        mask = rng.random(rng.integers(1, 7, 3)) < rng.choice([0.2, 0.5, 0.9, 1.0])
        start, end = rng.uniform(-3.0, 9.0, (2, 3))
        if trial % 3 == 0:  # along an axis, and on the planes between voxels
            start = np.rint(2.0 * start) / 2.0
            end = start.copy()
            end[rng.integers(3)] += 11.0
        spans = spans_inside(mask, start, end)
        assert (np.diff(spans.ravel()) >= 0.0).all()
        length = float((spans[:, 1] - spans[:, 0]).sum())
        assert length == pytest.approx(sampled(mask, start, end), abs=1e-4)
        assert meeting(mask, np.stack([start, end])[None])[0] == (len(spans) > 0)


@pytest.mark.parametrize("turn", [None, turned()])
@pytest.mark.parametrize("angle_deg", [0.0, 20.0, 55.0])
def test_the_length_through_a_plate_of_one_voxel_is_its_thickness_over_the_cosine(turn, angle_deg):
    volume = made((40, 40, 40), (0.7, 0.7, 0.7), turn=turn)
    mask = np.zeros(volume.hu.shape, bool)
    mask[20] = True
    field = SignedDistance.of(Structure.of("plate", mask, volume))
    across = volume.affine_mm[:3, 2] / 0.7
    beside = volume.affine_mm[:3, 0] / 0.7
    angle = np.radians(angle_deg)
    along = np.cos(angle) * across + np.sin(angle) * beside
    for shift in (0.0, 0.11, 0.37):
        middle = volume.lps_mm([20.0 + shift, 19.6, 20.0])
        nearest = field.along(middle - 8.3 * along, middle + 7.9 * along)
        assert nearest.through_mm == pytest.approx(0.7 / np.cos(angle), abs=1e-6)
        assert nearest.distance_mm < 0.0


@pytest.mark.long("statistics")
def test_a_line_through_the_corner_of_a_voxel_is_never_missed():
    volume = made((20, 20, 20), (0.7, 0.7, 0.7))
    mask = np.zeros(volume.hu.shape, bool)
    mask[10, 10, 10] = True
    field = SignedDistance.of(Structure.of("x", mask, volume))
    rng = np.random.default_rng(4)
    seen = 0
    for _ in range(200):
        across = rng.normal(size=3)
        across /= np.linalg.norm(across)
        aside = np.cross(across, rng.normal(size=3))
        aside *= rng.uniform(0.0, 0.5) / np.linalg.norm(aside)
        middle = np.array([10.0, 10.0, 10.0]) + aside
        start, end = middle - 30.0 * across, middle + 30.0 * across
        share = sampled(mask, start, end)
        nearest = field.along(*volume.lps_mm(np.stack([start, end])))
        assert nearest.through_mm == pytest.approx(share * 60.0 * 0.7, abs=0.002)
        if share > 2.0 / SAMPLES:
            seen += 1
            assert nearest.distance_mm < 0.0
    assert seen > 100
