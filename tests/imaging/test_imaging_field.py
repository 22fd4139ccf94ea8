"""The tissue field: boundaries within voxels, lookups, walks, reading and writing."""

import numpy as np
import pytest
from field_rig import ball, beyond, field_of_shapes

from app.imaging.field import (
    FieldError,
    FieldTissue,
    TissueField,
    TissueKind,
    from_bytes,
    read,
    to_bytes,
    write,
)
from app.imaging.field.walking import holding, joined, walk, words

FAT, LIVER = (TissueKind.FAT, ""), (TissueKind.ORGAN, "liver")


def everywhere(points):
    return np.full(len(points), -50.0)


@pytest.mark.parametrize(
    ("radius", "place_mm", "normal_deg"), [(10.0, 0.06, 2.5), (20.0, 0.04, 1.5)]
)
def test_the_wall_of_a_ball_lies_within_a_tenth_and_its_normal_within_two_degrees(
    radius, place_mm, normal_deg
):
    rng = np.random.default_rng(1)
    for _ in range(3):
        centre = 29.5 + rng.uniform(-1.0, 1.0, 3)
        field = field_of_shapes(
            [(*FAT, everywhere), (*LIVER, ball(centre, radius))], (0, 0, 0), (60, 60, 60)
        )
        way = rng.normal(size=(3000, 3))
        way /= np.linalg.norm(way, axis=1)[:, None]
        off = rng.uniform(-0.3, 0.3, len(way))
        found = field.look_up(centre + way * (radius + off)[:, None])
        signed = np.where(found.code == 2, -found.wall_mm, found.wall_mm)
        assert np.abs(signed - off).max() < place_mm
        known = found.other >= 0
        outwards = np.where((found.code == 2)[:, None], found.normal, -found.normal)
        angle = np.degrees(np.arccos(np.clip((outwards * way).sum(axis=1)[known], -1.0, 1.0)))
        assert angle.mean() < normal_deg


def test_a_flat_wall_lies_within_a_step_of_the_stored_distances_however_it_is_turned():
    rng = np.random.default_rng(2)
    for _ in range(6):
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        depth = 20.0 * normal.sum()
        field = field_of_shapes(
            [(*FAT, everywhere), (*LIVER, beyond(normal, depth))], (0, 0, 0), (40, 40, 40)
        )
        off = rng.uniform(-0.3, 0.3, 1000)
        points = rng.uniform(12.0, 28.0, (1000, 3))
        points += ((depth + off) - points @ normal)[:, None] * normal
        found = field.look_up(points)
        signed = np.where(found.code == 2, found.wall_mm, -found.wall_mm)
        assert np.abs(signed - off).max() < 0.03
        known = found.other >= 0
        inwards = np.where((found.code == 1)[:, None], found.normal, -found.normal)
        angles = np.degrees(np.arccos(np.clip(inwards[known] @ normal, -1.0, 1.0)))
        assert angles.max() < 2.5


def test_labels_without_distances_would_put_the_wall_half_a_voxel_off():
    field = field_of_shapes(
        [(*FAT, everywhere), (*LIVER, beyond((0, 0, 1), 9.9))], (0, 0, 0), (20, 20, 20)
    )
    blind = TissueField(
        field.labels, np.full_like(field.distance, 20), field.affine_mm, field.tissues
    )
    line = [[10.0, 10.0, 5.0], [10.0, 10.0, 15.0]]
    assert walk(field, line)[1].begin_mm == pytest.approx(4.9, abs=0.02)
    assert abs(walk(blind, line)[1].begin_mm - 4.9) > 0.3


def test_a_membrane_of_two_millimetres_has_both_its_walls():
    field = field_of_shapes(
        [
            (*FAT, everywhere),
            (TissueKind.SKIN, "", beyond((0.2, 0, 1), 10.0)),
            (*LIVER, beyond((0.2, 0, 1), 12.0)),
        ],
        (0, 0, 0),
        (24, 24, 24),
    )
    crossed = walk(field, [[12.0, 12.0, 2.0], [12.0, 12.0, 20.0]])
    assert [field.tissues[part.code].kind for part in crossed] == ["fat", "skin", "organ"]
    slant = np.hypot(0.2, 1.0)
    assert crossed[1].length_mm == pytest.approx(2.0 * slant, abs=0.04)
    assert crossed[1].angle_deg == pytest.approx(np.degrees(np.arctan(0.2)), abs=2.0)


def test_outside_the_field_and_where_there_is_no_number_all_is_unknown():
    field = field_of_shapes([(*LIVER, everywhere)], (0, 0, 0), (8, 8, 8))
    found = field.look_up([[-0.01, 4, 4], [4, 4, 7.01], [np.nan, 4, 4], [1e300, 4, 4], [7, 7, 7]])
    assert found.code.tolist() == [0, 0, 0, 0, 1]
    assert np.isfinite(found.wall_mm).all()
    assert not found.normal.any()


def test_a_field_comes_back_from_record_and_cache_to_the_last_bit(tmp_path):
    field = field_of_shapes(
        [(*FAT, everywhere), (*LIVER, ball((20, 21, 19), 11.3))], (-5, 3, 7), (40, 42, 38)
    )
    small = to_bytes(field)
    back = from_bytes(small)
    assert back.digest == field.digest
    assert np.array_equal(back.distance, field.distance)
    write(field, tmp_path / "x.field", small=False)
    assert read(tmp_path / "x.field").digest == field.digest
    assert len(small) < 0.2 * (tmp_path / "x.field").stat().st_size
    assert b'"patient_data": true' in small


@pytest.mark.parametrize("place", [0, 20, 200, -3])
def test_a_damaged_field_is_refused_in_one_line(place):
    content = bytearray(to_bytes(field_of_shapes([(*LIVER, everywhere)], (0, 0, 0), (9, 9, 9))))
    content[place] ^= 0xFF
    with pytest.raises(FieldError) as caught:
        from_bytes(bytes(content))
    assert "\n" not in str(caught.value)
    with pytest.raises(FieldError):
        from_bytes(bytes(content[: len(content) // 2]))


def test_a_label_without_a_row_of_values_is_refused():
    field = field_of_shapes([(*LIVER, everywhere)], (0, 0, 0), (4, 4, 4))
    with pytest.raises(FieldError, match="label 1 has no row in the table of 1 tissues"):
        TissueField(field.labels, field.distance, field.affine_mm, field.tissues[:1])
    odd = FieldTissue(0, TissueKind.BONE, "")
    with pytest.raises(FieldError, match="it must be unknown"):
        TissueField(field.labels, field.distance, field.affine_mm, (odd, field.tissues[1]))


def test_a_path_says_what_it_meets_and_gaps_join():
    field = field_of_shapes(
        [
            (*LIVER, everywhere),
            (TissueKind.VESSEL, "small vessel", ball((10, 10, 15), 2.0)),
            (TissueKind.BONE, "rib", beyond((0, 0, 1), 26.5)),
        ],
        (0, 0, 0),
        (20, 20, 40),
    )
    line = [[10.0, 10.0, 2.0], [10.0, 10.0, 35.0]]
    assert words(field, line).endswith("rib 8.5 mm")
    crossed = walk(field, line)
    (liver,) = joined(crossed, {1}, 0.5, {2})
    assert liver.length_mm == pytest.approx(24.5, abs=0.05)
    assert len(joined(crossed, {1}, 0.5, set())) == 2
    assert walk(field, [[1, 1, 1], [1, 1, 1]]) == []


def test_a_nodule_lies_in_the_lung_and_a_lesion_in_the_liver():
    field = field_of_shapes(
        [
            (*FAT, everywhere),
            (TissueKind.LUNG, "", ball((30, 30, 30), 25.0)),
            (TissueKind.ORGAN, "lung nodule", ball((30, 30, 30), 6.0)),
        ],
        (0, 0, 0),
        (60, 60, 60),
    )
    assert holding(field, (30, 30, 30)).tolist() == [2, 3]
    assert holding(field, (3, 3, 3)).tolist() == [1]
