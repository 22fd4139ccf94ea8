"""Thick slices of any direction."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from app.core.errors import NumericalError
from app.imaging.oblique import OUTSIDE_HU, Plane, oblique_image
from app.imaging.series import Series
from app.imaging.slab import Projection, slab_image, slab_samples
from app.imaging.volume import Volume

WAYS = {Projection.MEAN: np.mean, Projection.MIP: np.max, Projection.MINIP: np.min}


@pytest.fixture(scope="module")
def volume():
    hu = np.random.default_rng(5).integers(-1000, 1500, (20, 24, 28)).astype(np.int16)
    affine = np.diag([0.8, 0.8, 1.5, 1.0])
    affine[:3, 3] = (-10.0, 5.0, 30.0)
    series = Series("1", "CT", "test", (28, 24, 20), None, None, None, True, "", (), "CT", "1", ())
    return Volume(hu, affine, series)


def slanted(volume):
    right = np.array([0.8, 0.6, 0.0])
    down = np.cross([0.36, -0.48, 0.8], right)
    return Plane.centred(volume.lps_mm([14, 12, 10]), right, down, 0.5, 15, 11)


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", WAYS)
def test_a_slab_is_what_its_samples_make(volume, way):
    plane, thickness = slanted(volume), 4.0
    count = slab_samples(volume, thickness)
    assert count == 5
    normal = np.cross(plane.across_mm, plane.down_mm)
    normal /= np.linalg.norm(normal)
    offsets = ((np.arange(count) + 0.5) / count - 0.5) * thickness
    layers = [
        oblique_image(volume, Plane(plane.corner_mm + offset * normal, plane.across_mm,
                                    plane.down_mm, plane.columns, plane.rows))
        for offset in offsets
    ]  # fmt: skip
    assert_allclose(slab_image(volume, plane, thickness, way), WAYS[way](layers, axis=0), atol=0.05)


@pytest.mark.parametrize("way", WAYS)
def test_only_samples_in_the_volume_count(volume, way):
    corner = volume.lps_mm([4, 4, 0])
    plane = Plane(corner, np.array([0.8, 0.0, 0.0]), np.array([0.0, 0.8, 0.0]), 6, 5)
    image = slab_image(volume, plane, 60.0, way)
    inside = volume.hu[:, 4:9, 4:10]
    assert (image >= inside.min(axis=0).min()).all()
    if way is Projection.MIP:
        assert (image <= inside.max()).all()
    far = Plane(corner - [0, 0, 500.0], plane.across_mm, plane.down_mm, 6, 5)
    assert (slab_image(volume, far, 10.0, way) == OUTSIDE_HU).all()


@pytest.mark.parametrize("thickness", [0.0, -1.0, 101.0, float("nan")])
def test_a_slab_without_thickness_or_too_thick_is_refused(volume, thickness):
    with pytest.raises(NumericalError, match="slab of"):
        slab_image(volume, slanted(volume), thickness)


def test_a_picture_of_the_wrong_shape_is_refused(volume):
    with pytest.raises(NumericalError, match="out is"):
        slab_image(volume, slanted(volume), 5.0, out=np.empty((3, 3), np.float32))
