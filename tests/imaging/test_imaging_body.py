"""Body and skin."""

import numpy as np
import pytest
from scipy import ndimage

from app.imaging.body import (
    _filled,
    body_mask,
    find_body,
    is_inside,
    nearest_skin,
    skin_entry,
    snap_to_skin,
)
from app.imaging.errors import InvalidEntryError
from tests.imaging.test_imaging_orthogonal import volume_of

RADIUS = 40.0
CENTRE = np.array([60.0, 50.0, 45.0])


@pytest.fixture(scope="module")
def ball():
    """A soft ball of radius 40 mm with an air-filled cavity, above a table plate, 1.5 mm voxels."""
    volume = volume_of(np.eye(3), (66, 80, 80), (1.5, 1.5, 1.5))
    k, j, i = np.mgrid[:66, :80, :80] * 1.5
    r = np.sqrt((i - CENTRE[0]) ** 2 + (j - CENTRE[1]) ** 2 + (k - CENTRE[2]) ** 2)
    share = np.clip(0.5 - (r - RADIUS) / 1.5, 0.0, 1.0)
    hu = -1000.0 + 1050.0 * share
    hu[r < 20.0] = -850.0
    hu[(j > 97.0) & (j < 99.5)] = 100.0
    object.__setattr__(volume, "hu", hu.astype(np.int16))
    return find_body(volume)


def at(body, offset):
    """Point of the volume, relative to the ball's centre."""
    return body.volume.origin_mm + CENTRE + offset


def test_the_cavity_belongs_to_the_body_and_the_table_does_not(ball):
    assert is_inside(ball, at(ball, (0, 0, 0)))
    assert is_inside(ball, at(ball, (0, 30, 0)))
    assert not is_inside(ball, at(ball, (0, 48, 0)))
    assert not is_inside(ball, at(ball, (0, -48, 0)))
    assert not is_inside(ball, (1e6, 0, 0))


def test_the_full_mask_agrees_with_the_ball_to_a_voxel(ball):
    mask = body_mask(ball.volume, ball)
    k, j, i = np.mgrid[:66, :80, :80] * 1.5
    r = np.sqrt((i - CENTRE[0]) ** 2 + (j - CENTRE[1]) ** 2 + (k - CENTRE[2]) ** 2)
    assert mask[r < RADIUS - 1.5].all()
    assert not mask[r > RADIUS + 1.5].any()
    np.testing.assert_array_equal(mask, body_mask(ball.volume))


@pytest.mark.parametrize("direction", [(0, -1, 0), (1, 0, 0), (-0.6, -0.64, 0.48), (0, 0.6, 0.8)])
def test_a_line_meets_the_skin_to_a_fraction_of_a_voxel(ball, direction):
    outside = at(ball, 46.0 * np.array(direction))
    skin = skin_entry(ball, outside, at(ball, (0, 0, 0)))
    assert np.linalg.norm(skin - at(ball, (0, 0, 0))) == pytest.approx(RADIUS, abs=0.3)


def test_the_nearest_skin_of_a_click_is_on_its_radius(ball):
    rng = np.random.default_rng(3)
    for _ in range(20):
        direction = rng.standard_normal(3)
        direction /= np.linalg.norm(direction)
        for reach in (37.0, 44.0):
            skin = nearest_skin(ball, at(ball, reach * direction))
            distance = np.linalg.norm(skin - at(ball, reach * direction))
            assert distance == pytest.approx(abs(reach - RADIUS), abs=0.5)
            assert np.linalg.norm(skin - at(ball, (0, 0, 0))) == pytest.approx(RADIUS, abs=0.3)


def test_a_click_far_from_the_skin_is_refused_with_its_distance(ball):
    with pytest.raises(InvalidEntryError, match="under the skin") as inside:
        snap_to_skin(ball, at(ball, (0, 0, -15)))
    assert inside.value.distance_mm == pytest.approx(25.0, abs=1.5)
    with pytest.raises(InvalidEntryError, match="outside the body") as outside:
        snap_to_skin(ball, at(ball, (0, -65, 0)))
    assert outside.value.distance_mm == pytest.approx(25.0, abs=1.5)
    np.testing.assert_allclose(
        snap_to_skin(ball, at(ball, (0, -45, 0))), at(ball, (0, -RADIUS, 0)), atol=0.5
    )


def test_a_line_that_starts_inside_or_misses_is_refused(ball):
    with pytest.raises(InvalidEntryError, match="starts in the body"):
        skin_entry(ball, at(ball, (0, 30, 0)), at(ball, (0, 0, 0)))
    with pytest.raises(InvalidEntryError, match="never meets"):
        skin_entry(ball, at(ball, (-55, -45, 0)), at(ball, (55, -45, 0)))


@pytest.mark.long("journey")
def test_the_skin_of_the_real_chest_is_without_its_table(shared_data):
    from app.imaging.reading import load_ct

    volume = load_ct(shared_data / "ct_chest_lidc0314")
    body = find_body(volume)
    middle = volume.lps_mm((240, 280, 137))
    front = skin_entry(body, middle - np.array([0, 250, 0]), middle)
    back = skin_entry(body, middle + np.array([0, 160, 0]), middle)
    assert 200.0 < back[1] - front[1] < 260.0
    assert volume.hu_at(front) == pytest.approx(-400.0, abs=20.0)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_what_a_plane_encloses_is_filled_as_plane_by_plane(axis):
    rng = np.random.default_rng(axis)
    for _ in range(20):
        mask = rng.random(rng.integers(1, 14, 3)) > 0.4
        truth = [ndimage.binary_fill_holes(plane) for plane in np.moveaxis(mask, axis, 0)]
        assert np.array_equal(np.moveaxis(_filled(mask, axis), axis, 0), truth)
