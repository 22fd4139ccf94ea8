"""Oblique slices: against the numpy interpolation, exactness, edges, refusals."""

import numpy as np
import pytest
from numpy.typing import NDArray

from app.core.errors import NumericalError
from app.core.rotation import rotation_exp
from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.oblique import OUTSIDE_HU, Plane, oblique_image
from app.imaging.series import Series
from app.imaging.volume import Volume

WAYS = list(Interpolation)


def volume_of(hu: NDArray[np.generic]) -> Volume:
    affine = np.eye(4)
    affine[:3, :3] = rotation_exp([0.1, -0.2, 0.3]) @ np.diag([0.8, 0.9, 2.0])
    affine[:3, 3] = (-10.0, 20.0, -5.0)
    k, j, i = hu.shape
    series = Series("1", "CT", "", (i, j, k), None, None, None, True, "", (), "", "", ())
    return Volume(hu, affine, series)


def plane_through(volume: Volume, columns: int = 61, rows: int = 47) -> Plane:
    turn = rotation_exp([0.7, 0.4, -0.2])
    centre = volume.lps_mm((np.array(volume.size) - 1) / 2.0)
    return Plane.centred(centre, turn[:, 0], turn[:, 1], 0.4, columns, rows)


def noise(kind: type = np.int16) -> Volume:
    return volume_of(np.random.default_rng(2).integers(-1000, 1500, (12, 24, 30)).astype(kind))


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", [np.int16, np.float32])
def test_the_compiled_slice_is_the_numpy_interpolation(way: Interpolation, kind: type) -> None:
    volume = noise(kind)
    plane = plane_through(volume)
    image = oblique_image(volume, plane, way)
    ijk = volume.voxel(plane.points_mm().reshape(-1, 3))
    inside = ((ijk >= -0.5) & (ijk <= np.array(volume.size) - 0.5)).all(axis=1)
    expected = np.where(inside, interpolate(volume.hu, ijk, way), OUTSIDE_HU).reshape(image.shape)
    if way is Interpolation.NEAREST:  # at a tie either neighbour is the nearest
        assert np.mean(image != expected) < 1e-3
    else:
        np.testing.assert_allclose(image, expected, atol=1e-3)
    assert 0.1 < inside.mean() < 1.0


@pytest.mark.parametrize("way", WAYS)
def test_a_plane_along_the_slices_gives_the_slices_back(way: Interpolation) -> None:
    volume = noise()
    plane = Plane(
        volume.lps_mm((0, 0, 5)), volume.affine_mm[:3, 0], volume.affine_mm[:3, 1], 30, 24
    )
    np.testing.assert_allclose(oblique_image(volume, plane, way), volume.hu[5], atol=1e-2)


def test_trilinear_is_exact_for_a_linear_field_and_cubic_for_a_quadratic_one_inside() -> None:
    k, j, i = np.meshgrid(*(np.arange(n, dtype=float) for n in (12, 24, 30)), indexing="ij")
    linear = volume_of((3.0 * i - 2.0 * j + 5.0 * k).astype(np.float32))
    square = volume_of((i * i - 0.5 * j * j + 0.1 * k * k).astype(np.float32))
    plane = Plane.centred(
        linear.lps_mm((14.5, 11.5, 5.5)),
        rotation_exp([0.3, 0.2, 0.1])[:, 0],
        rotation_exp([0.3, 0.2, 0.1])[:, 1],
        0.2,
        15,
        15,
    )
    x, y, z = linear.voxel(plane.points_mm().reshape(-1, 3)).T
    ours = oblique_image(linear, plane, Interpolation.TRILINEAR).ravel()
    np.testing.assert_allclose(ours, 3.0 * x - 2.0 * y + 5.0 * z, atol=1e-4)
    cubic = oblique_image(square, plane, Interpolation.CUBIC).ravel()
    np.testing.assert_allclose(cubic, x * x - 0.5 * y * y + 0.1 * z * z, atol=1e-3)


def test_an_oblique_slice_writes_into_the_picture_it_is_given() -> None:
    volume = noise()
    plane = plane_through(volume)
    picture = np.zeros((plane.rows, plane.columns), np.float32)
    assert oblique_image(volume, plane, out=picture) is picture
    assert picture.any()


@pytest.mark.parametrize("way", WAYS)
def test_a_volume_one_voxel_thick_and_a_plane_outside_are_no_trouble(way: Interpolation) -> None:
    thin = volume_of(np.full((1, 4, 4), 7, np.int16))
    plane = Plane.centred(
        thin.lps_mm((1.5, 1.5, 0)), thin.direction[:, 0], thin.direction[:, 1], 0.5, 3, 3
    )
    np.testing.assert_allclose(oblique_image(thin, plane, way), 7.0)
    far = Plane(plane.corner_mm + 1e6, plane.across_mm, plane.down_mm, 3, 3)
    assert (oblique_image(thin, far, way, outside_hu=-5.0) == -5.0).all()


def test_a_wrong_picture_or_plane_is_refused() -> None:
    volume = noise()
    plane = plane_through(volume)
    with pytest.raises(NumericalError, match="contiguous float32"):
        oblique_image(volume, plane, out=np.zeros((2, 2), np.float32))
    with pytest.raises(NumericalError, match="no pixels"):
        Plane(np.zeros(3), np.ones(3), np.ones(3), 0, 3)
    with pytest.raises(NumericalError, match="not finite"):
        Plane(np.array([np.nan, 0, 0]), np.ones(3), np.ones(3), 3, 3)
