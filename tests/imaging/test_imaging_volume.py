"""Points and values of a volume."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.rotation import rotation_exp
from app.imaging.interpolation import Interpolation, interpolate
from tests.imaging.test_imaging_orthogonal import volume_of

TURNED = rotation_exp((0.4, -0.8, 1.9))


def test_points_and_voxels_map_there_and_back():
    volume = volume_of(TURNED)
    ijk = np.random.default_rng(1).uniform(-20.0, 20.0, (50, 3))
    np.testing.assert_allclose(volume.voxel(volume.lps_mm(ijk)), ijk, atol=1e-11)
    np.testing.assert_allclose(volume.points_m(ijk) * 1e3, volume.lps_mm(ijk))
    np.testing.assert_allclose(volume.direction, TURNED, atol=1e-12)


def test_the_edge_voxels_belong_to_the_volume_and_nothing_beyond():
    volume = volume_of(np.eye(3))
    assert volume.contains(volume.lps_mm((-0.49, 0.0, 4.49)))
    assert volume.hu_at(volume.lps_mm((-0.49, 0.0, 0.0))) == volume.hu[0, 0, 0]
    assert volume.hu_at(volume.lps_mm((-0.51, 0.0, 0.0))) is None
    assert volume.hu_at((np.nan, 0.0, 0.0)) is None


@pytest.mark.parametrize("way", Interpolation)
def test_every_way_returns_the_voxel_at_its_centre(way):
    volume = volume_of(TURNED)
    for ijk in ((0, 0, 0), (8, 6, 4), (3, 2, 1)):
        i, j, k = ijk
        assert volume.hu_at(volume.lps_mm(ijk), way) == pytest.approx(volume.hu[k, j, i])


@given(at=st.tuples(st.floats(1.0, 7.0), st.floats(1.0, 5.0), st.floats(1.0, 3.0)))
@settings(derandomize=True, deadline=None, max_examples=50)
def test_linear_is_exact_for_linear_and_cubic_for_quadratic_fields(at):
    k, j, i = np.mgrid[:5, :7, :9].astype(np.float64)
    x, y, z = at
    linear, quadratic = 3.0 * i - 2.0 * j + k, i * i - 2.0 * j * k + 0.5 * k * k
    point = np.array([at])
    assert interpolate(linear, point)[0] == pytest.approx(3.0 * x - 2.0 * y + z, abs=1e-9)
    value = interpolate(quadratic, point, Interpolation.CUBIC)[0]
    assert value == pytest.approx(x * x - 2.0 * y * z + 0.5 * z * z, abs=1e-9)


def test_an_unknown_way_is_refused():
    volume = volume_of(np.eye(3))
    with pytest.raises(ValueError, match="sinc"):
        volume.hu_at(volume.lps_mm((1, 1, 1)), "sinc")
