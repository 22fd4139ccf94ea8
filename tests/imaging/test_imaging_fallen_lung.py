"""A lung that falls back in the CT: by its share, from the uppermost side, and nothing else."""

import json

import numpy as np
import pytest
from chest import CORNER, DOWN, ENTRY, LEFT, RADIUS, RIGHT, STEP, TARGET, chest, ct_of

from app.core.errors import NumericalError
from app.imaging.fallen_lung import TURN_RAD, changed_ct
from app.imaging.inside import MOST, Inside, left_over, lung_shape

FIELD = chest()
CT = ct_of(FIELD)
SHAPE = lung_shape(FIELD, TARGET, DOWN)
PLACES = np.stack(np.indices(CT.hu.shape)[::-1], axis=-1) * STEP + np.array(CORNER)
OF_RIGHT = np.linalg.norm(PLACES - RIGHT, axis=-1) < RADIUS + STEP


def inside(share=0.0, blood=0.0, dense=False):
    way = np.array([[-60.0, -45.0, 0.0], TARGET]) if blood else None
    return Inside(share, SHAPE.centre_mm, TARGET, SHAPE.is_left, blood, way, dense)


IN_LUNG = np.linalg.norm(PLACES - RIGHT, axis=-1) < RADIUS


EDGE = 0.5 * STEP * 3.0 / RADIUS
"""Half a voxel about the whole lung, which its pleura fills in the picture, as share of it."""


def lung_left(hu, share=0.0):
    """Voxels of the right lung's room that are lung, those half of it by half."""
    own = 150.0 / (1.0 - share)  # of its weight, all is left
    return np.clip((hu[IN_LUNG] + 1000.0) / own, 0.0, 1.0).sum()


def test_the_shape_is_of_the_targets_lung_and_falls_to_the_middle_and_down() -> None:
    assert SHAPE.is_left is False
    assert SHAPE.centre_mm[0] > RIGHT[0] + 20.0
    assert SHAPE.centre_mm[1] > 15.0
    assert lung_shape(FIELD, LEFT, DOWN).is_left is True
    assert lung_shape(FIELD, LEFT, -DOWN).centre_mm[1] < -15.0


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5])
def test_the_air_is_the_share_of_the_lungs_volume(share: float) -> None:
    fallen = changed_ct(CT, FIELD, inside(share)).hu
    left = lung_left(fallen, share) / lung_left(CT.hu)
    assert left == pytest.approx(1.0 - share, abs=EDGE)


@pytest.mark.parametrize("share", [0.15, 0.4])
def test_the_air_is_deepest_above_and_as_deep_as_is_said(share: float) -> None:
    hu = changed_ct(CT, FIELD, inside(share)).hu
    lung = (hu > -930) & (hu < -300) & IN_LUNG
    top, bottom = (np.flatnonzero(lung.any(axis=(0, 2)))[n] * STEP + CORNER[1] for n in (0, -1))
    sunk, risen = top + RADIUS, RADIUS - bottom
    assert sunk == pytest.approx(SHAPE.rim_mm(share), abs=1.5 * STEP)
    assert sunk > risen + 1.0


def test_chest_wall_and_the_other_lung_stay_to_the_last_bit() -> None:
    hu = changed_ct(CT, FIELD, inside(0.4)).hu
    assert not np.array_equal(hu, CT.hu)
    np.testing.assert_array_equal(hu[~OF_RIGHT], CT.hu[~OF_RIGHT])


def test_the_lesion_keeps_its_size_moves_and_turns() -> None:
    share = 0.4
    now = inside(share)
    hu = changed_ct(CT, FIELD, now).hu
    near = np.linalg.norm(PLACES - (TARGET + now.displacement_mm), axis=-1) < 15.0
    solid = np.clip((hu.astype(float) + 700.0) / 740.0, 0.0, 1.0) * near
    before_near = np.linalg.norm(PLACES - TARGET, axis=-1) < 15.0
    before = np.clip((CT.hu.astype(float) + 700.0) / 740.0, 0.0, 1.0) * before_near
    assert solid.sum() == pytest.approx(before.sum(), rel=0.12)
    centre = (PLACES * solid[..., None]).sum(axis=(0, 1, 2)) / solid.sum()
    np.testing.assert_allclose(centre, TARGET + now.displacement_mm, atol=0.7)
    assert np.linalg.norm(now.displacement_mm) > 5.0
    away = (PLACES - centre)[..., :2]
    spread = np.einsum("kji,kjia,kjib->ab", solid, away, away)
    x, y = np.linalg.eigh(spread)[1][:, -1]
    turned = np.arctan(y / x)
    assert abs(turned) == pytest.approx(TURN_RAD * share, abs=0.06)


def test_nothing_changes_where_nothing_happened() -> None:
    assert changed_ct(CT, FIELD, None) is CT
    assert changed_ct(CT, FIELD, inside()) is CT
    assert changed_ct(CT, None, inside(0.3)) is CT


def test_only_the_wanted_slices_are_made_and_they_are_the_same() -> None:
    now = inside(0.3)
    whole, part = changed_ct(CT, FIELD, now).hu, changed_ct(CT, FIELD, now, (-5.0, 5.0)).hu
    rows = slice(round((-5.0 - CORNER[2]) / STEP), round((5.0 - CORNER[2]) / STEP) + 1)
    np.testing.assert_array_equal(part[rows], whole[rows])
    np.testing.assert_array_equal(part[:5], CT.hu[:5])


def test_blood_is_a_ground_glass_about_the_needles_way_alone() -> None:
    hu = changed_ct(CT, FIELD, inside(blood=10.0)).hu.astype(int)
    along = np.clip((PLACES[..., 1] + 45.0) / 35.0, 0.0, 1.0)
    nearest = np.stack([np.full_like(along, -60.0), -45.0 + 35.0 * along, 0.0 * along], axis=-1)
    far = np.linalg.norm(PLACES - nearest, axis=-1)
    changed = hu != CT.hu
    assert changed.any()
    assert far[changed].max() <= 10.0
    assert hu[changed].max() < -300
    dense = changed_ct(CT, FIELD, inside(blood=20.0, dense=True)).hu
    assert (dense[(far < 3.0) & OF_RIGHT & (CT.hu < -800)] > -200).mean() > 0.9


def test_what_a_record_keeps_is_read_back_to_the_last_bit() -> None:
    now = inside(0.123456789, 7.7, dense=True)
    again = Inside.of(json.loads(json.dumps(now.document())))
    assert again.document() == now.document()


@pytest.mark.parametrize("share", [1e-12, 0.8, 0.999999, 1.0])
def test_hard_no_share_gives_anything_but_a_picture(share: float) -> None:
    hu = changed_ct(CT, FIELD, inside(share)).hu
    assert hu.dtype == CT.hu.dtype
    assert hu.min() >= -1024
    assert hu.max() <= CT.hu.max()
    assert left_over(share) >= (1.0 - MOST) ** (1.0 / 3.0) - 1e-12


@pytest.mark.parametrize("share", [float("nan"), float("inf"), -0.1, 1.1])
def test_a_share_that_is_none_is_refused(share: float) -> None:
    with pytest.raises(NumericalError, match="share"):
        inside(share)
    assert ENTRY[1] < TARGET[1]
