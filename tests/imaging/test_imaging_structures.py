"""Structures: their values, outlines, distances, and how they come onto a CT."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.core.progress import Cancelled, Progress
from app.imaging.series import Series
from app.imaging.structures.contours import even_odd
from app.imaging.structures.distance import SignedDistance
from app.imaging.structures.edit import brushed
from app.imaging.structures.errors import FrameOfReferenceError, StructureError
from app.imaging.structures.placing import Found, Labelled, guessed_kind, place
from app.imaging.structures.structure import (
    MOST_POINTS,
    Structure,
    StructureKind,
    StructureSet,
    contours,
    cropped,
    outlines,
)
from app.imaging.volume import Volume

FRAME = "2.25.77"


def made(
    size=(60, 50, 40), spacing=(0.8, 0.8, 2.0), origin=(-30.0, 20.0, 100.0), turn=None, hu=None
):
    """A CT of nothing, or of these numbers, with a geometry."""
    affine = np.eye(4)
    affine[:3, :3] = (np.eye(3) if turn is None else turn) * spacing
    affine[:3, 3] = origin
    series = Series("2.25.1", "CT", "", size, None, None, None, True, "", (), "p", FRAME, ())
    return Volume(np.zeros(size[::-1], np.int16) if hu is None else hu, affine, series)


def turned(degrees=25.0):
    a = np.radians(degrees)
    c, s = np.cos(a), np.sin(a)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array(
        [[1, 0, 0], [0, c, -s], [0, s, c]]
    )


def ball(volume, centre, radius):
    k, j, i = np.indices(volume.hu.shape)
    points = volume.lps_mm(np.stack([i, j, k], axis=-1).reshape(-1, 3))
    return (np.linalg.norm(points - centre, axis=1) <= radius).reshape(volume.hu.shape)


def placed_on(labelled, frame, volume):
    return place(Found(labelled, len(labelled), frame), volume, Progress())


def middle(volume):
    return volume.lps_mm((np.array(volume.size) - 1) / 2)


def test_a_structure_keeps_its_box_and_gives_its_mask_back():
    volume = made()
    mask = ball(volume, middle(volume), 9.0)
    one = Structure.of("ball", mask, volume, StructureKind.RISK)
    assert one.mask.size < mask.size / 5
    assert np.array_equal(one.full(volume.hu.shape), mask)
    assert one.millilitres == pytest.approx(4 / 3 * np.pi * 0.9**3, rel=0.05)
    assert np.allclose(one.centre_mm, middle(volume), atol=0.1)
    assert one.warn_mm == 5.0
    assert not one.mask.flags.writeable


def test_points_are_in_the_voxel_that_holds_them():
    volume = made(turn=turned())
    one = Structure.of("ball", ball(volume, middle(volume), 8.0), volume)
    at = np.argwhere(one.full(volume.hu.shape))[:, ::-1]
    assert one.holds(volume.lps_mm(at)).all()
    assert not one.holds(middle(volume) + [[0, 0, 9.6], [0, 9.6, 0], [900, 0, 0]]).any()


@pytest.mark.parametrize("bad", ["", "   ", "x" * 65])
def test_a_name_that_is_none_is_refused(bad):
    volume = made()
    with pytest.raises(StructureError):
        Structure.of(bad, ball(volume, middle(volume), 5.0), volume)


def test_an_empty_structure_is_refused():
    with pytest.raises(StructureError, match="voxel"):
        cropped(np.zeros((3, 3, 3), bool))


def test_names_in_a_set_are_unique_and_unknown_ones_are_told_with_those_there_are():
    volume = made()
    one = Structure.of("aorta", ball(volume, middle(volume), 5.0), volume)
    both = StructureSet((one,)).united(StructureSet((one,)))
    assert [s.name for s in both] == ["aorta", "aorta 2"]
    with pytest.raises(StructureError, match="aorta, aorta 2"):
        both.find("liver")
    with pytest.raises(StructureError, match="twice"):
        StructureSet((one, one))
    assert [s.name for s in both.without("aorta")] == ["aorta 2"]
    renamed = both.with_one(one.changed(name="vein"), instead_of="aorta")
    assert [s.name for s in renamed] == ["vein", "aorta 2"]


# --- distance ----------------------------------------------------------------------------------
@pytest.mark.long("journey")
@pytest.mark.parametrize("turn", [None, turned()])
@pytest.mark.parametrize("spacing", [(0.8, 0.8, 2.0), (0.7, 0.7, 0.7), (1.0, 1.0, 5.0)])
def test_the_distance_of_a_ball_is_true_to_the_stated_accuracy(spacing, turn):
    volume = made((64, 64, 48), spacing, turn=turn)
    centre = middle(volume)
    field = SignedDistance.of(Structure.of("b", ball(volume, centre, 14.0), volume))
    rng = np.random.default_rng(1)
    directions = rng.normal(size=(4000, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    radii = rng.uniform(1.0, 60.0, 4000)
    error = field.at(centre + directions * radii[:, None]) - (radii - 14.0)
    assert np.abs(error).max() <= field.accuracy_mm
    assert abs(error.mean()) < 0.25 * field.accuracy_mm


def test_the_distance_goes_on_beyond_the_grid_without_a_jump():
    volume = made((64, 64, 48), (0.8, 0.8, 0.8))
    field = SignedDistance.of(Structure.of("b", ball(volume, middle(volume), 10.0), volume))
    along = np.arange(11.0, 80.0, 0.1)[:, None] * [[1.0, 0.0, 0.0]] + middle(volume)
    steps = np.diff(field.at(along))
    assert np.abs(steps - 0.1).max() < 0.6
    assert abs(field.at(along)[-1] - 69.9) < 1.0


@pytest.mark.long("journey")
def test_a_line_past_and_one_through_a_ball():
    volume = made((64, 64, 64), (0.8, 0.8, 0.8))
    centre = middle(volume)
    field = SignedDistance.of(Structure.of("b", ball(volume, centre, 10.0), volume))
    past = field.along(centre + [-40, 15, 0], centre + [40, 15, 0])
    assert past.distance_mm == pytest.approx(5.0, abs=field.accuracy_mm)
    assert past.depth_mm == pytest.approx(40.0, abs=4.0)
    assert past.through_mm == 0.0
    through = field.along(centre + [-40, 0, 0], centre + [40, 0, 0])
    assert through.distance_mm == pytest.approx(-10.0, abs=field.accuracy_mm)
    assert through.through_mm == pytest.approx(20.0, abs=2.0)


def test_a_single_voxel_has_a_distance_and_the_work_can_be_cancelled():
    volume = made()
    mask = np.zeros(volume.hu.shape, bool)
    mask[20, 25, 30] = True
    one = Structure.of("dot", mask, volume)
    field = SignedDistance.of(one)
    at = volume.lps_mm([30, 25, 20])
    assert field.at(at[None])[0] < 0.5
    assert field.at((at + [10.0, 0, 0])[None])[0] == pytest.approx(9.6, abs=1.0)
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        SignedDistance.of(one, progress)


# --- outlines ----------------------------------------------------------------------------------
def area(line):
    x, y = line.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def test_outlines_are_closed_and_turn_the_other_way_round_holes():
    picture = np.zeros((30, 40))
    picture[5:25, 5:35] = 1.0
    picture[10:20, 10:20] = 0.0
    lines = sorted(outlines(picture), key=lambda line: abs(area(line)))
    assert len(lines) == 2
    assert np.sign(area(lines[0])) != np.sign(area(lines[1]))
    assert abs(area(lines[1])) == pytest.approx(600.0, abs=1.0)
    assert outlines(np.zeros((4, 4))) == []
    assert len(outlines(np.ones((4, 4)))) == 1


@pytest.mark.parametrize("around", [0, 1])
def test_an_edge_lies_half_a_voxel_outside_at_the_box_too(around):
    """A voxel reaches half its size from its centre (DICOM PS3.3 C.7.6.2.1.1)."""
    (line,) = outlines(np.pad(np.ones((4, 6)), around))
    assert line.min(axis=0) == pytest.approx([around - 0.5] * 2)
    assert line.max(axis=0) == pytest.approx([around + 5.5, around + 3.5])


def test_two_corners_across_from_each_other_give_two_lines():
    assert len(outlines(np.eye(2))) == 2


def test_random_pictures_give_the_area_of_their_voxels():
    rng = np.random.default_rng(3)
    picture = (rng.random((40, 40)) < 0.5).astype(float)
    lines = outlines(picture)
    # corners are cut: the lines alone, filled again, give every voxel and no other
    assert np.array_equal(even_odd(lines, picture.shape), picture.astype(bool))


@pytest.mark.parametrize("turn", [None, turned()])
def test_a_ball_is_a_circle_in_any_plane(turn):
    volume = made((64, 64, 48), (0.8, 0.8, 1.2), turn=turn)
    centre = middle(volume)
    one = Structure.of("b", ball(volume, centre, 14.0), volume)
    rng = np.random.default_rng(2)
    for offset in (0.0, 8.0, -8.0):
        for _ in range(4):
            basis, _ = np.linalg.qr(rng.normal(size=(3, 3)))
            right, down = basis[:, 0], basis[:, 1]
            normal = np.cross(right, down)
            lines = contours(one, centre + offset * normal - 50 * right, right, down)
            radius = np.sqrt(14.0**2 - offset**2)
            off = np.linalg.norm(lines[0] - [50.0, 0.0], axis=1) - radius
            assert len(lines) == 1
            assert np.abs(off).max() < 1.2


def test_outlines_on_slices_of_the_ct_pass_between_its_voxels():
    volume = made(turn=turned())
    one = Structure.of("b", ball(volume, middle(volume), 9.0), volume)
    mask = one.full(volume.hu.shape)
    axes = volume.affine_mm[:3, :3].T
    for k in (18, 20, 22):
        origin = volume.lps_mm([0, 0, k])
        lines = contours(one, origin, axes[0], axes[1])  # in voxels
        assert np.array_equal(even_odd(lines, mask[k].shape), mask[k])
    lines = contours(one, volume.lps_mm([49, 0, 0]), -axes[0], axes[1])
    assert lines == []
    lines = contours(one, volume.lps_mm([59, 0, 20]), -axes[0], axes[1])
    assert np.array_equal(even_odd(lines, mask[20].shape), mask[20][:, ::-1])


def noise(size):
    """A CT of nothing, and a threshold within its noise."""
    volume = made(size=size)
    mask = np.random.default_rng(1).random(size[::-1]) > 0.6
    return volume, Structure.of("noise", mask, volume)


@pytest.mark.parametrize("oblique", [False, True])
def test_outlines_within_noise_are_coarse_and_leave_no_voxel_out(oblique):
    volume, one = noise((300, 300, 9))
    axes = volume.affine_mm[:3, :3].T
    right, down = (axes[0] + 1e-4 * axes[2], axes[1]) if oblique else (axes[0], axes[1])
    lines = contours(one, volume.lps_mm([0, 0, 4]), right, down, 0.9)
    assert 100 < sum(map(len, lines)) <= MOST_POINTS
    inside = even_odd(lines, (300, 300))
    assert inside[one.full(volume.hu.shape)[4]].mean() >= (0.999 if oblique else 1.0)


def test_outlines_of_a_large_structure_take_no_copy_of_it():
    volume, one = noise((128, 128, 512))
    origin, axes = volume.lps_mm([0, 0, 100]), volume.affine_mm[:3, :3].T
    contours(one, origin, axes[0], axes[1])
    tracemalloc.start()
    contours(one, origin, axes[0], axes[1])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < one.mask.nbytes / 2


@given(st.integers(0, 2**32 - 1), st.booleans(), st.booleans())
def test_a_stroke_of_dabs_is_what_they_are_one_by_one(seed, add, limited):
    rng = np.random.default_rng(seed)
    hu = rng.integers(0, 3, (12, 13, 14)).astype(np.int16)
    volume = made(size=(14, 13, 12), spacing=(1.0, 1.2, 1.5), hu=hu)
    one = Structure.of("s", ball(volume, middle(volume), rng.uniform(2.0, 5.0)), volume)
    centres = middle(volume) + rng.normal(size=(4, 3)) * 5.0
    limits = (1.0, 2.0) if limited else None
    radius = rng.uniform(1.0, 5.0)
    stroke = brushed(one, volume, centres, radius, add, limits)
    truth = one
    for centre in centres:
        found = brushed(truth, volume, centre, radius, add, limits)
        if found is None:
            assert stroke is None
            return
        truth = one.changed(mask=found[0], corner=found[1])
        ij = np.argwhere(truth.mask)
        assert (ij.min(axis=0) == 0).all()
        assert (ij.max(axis=0) + 1 == truth.mask.shape).all()
    after = one.changed(mask=stroke[0], corner=stroke[1])
    assert after.corner == truth.corner
    assert np.array_equal(after.mask, truth.mask)


# --- polygons ----------------------------------------------------------------------------------
def square(low, high):
    return np.array([[low, low], [high, low], [high, high], [low, high]], float)


def test_an_inner_contour_is_a_hole_and_one_in_it_an_island():
    inside = even_odd([square(1.5, 20.5), square(5.5, 15.5), square(8.5, 11.5)], (24, 24))
    assert inside[3, 3]
    assert not inside[7, 7]
    assert inside[10, 10]
    assert inside.sum() == 19**2 - 10**2 + 3**2


def test_a_keyhole_gives_the_same_hole():
    outer, inner = square(1.5, 20.5), square(5.5, 15.5)[::-1]
    keyhole = np.vstack([outer, outer[:1], inner, inner[:1]])
    assert np.array_equal(even_odd([keyhole], (24, 24)), even_odd([outer, inner], (24, 24)))


def test_corners_on_voxel_centres_count_once_and_nothing_leaves_the_picture():
    triangle = np.array([[2.0, 2.0], [12.0, 2.0], [7.0, 12.0]])
    inside = even_odd([triangle], (20, 20))
    rows = inside.sum(axis=1)
    assert rows[:2].sum() == 0
    assert (np.diff(rows[2:12]) <= 0).all()
    assert even_odd([square(-50.0, 90.0)], (8, 8)).all()
    assert not even_odd([square(30.0, 40.0)], (8, 8)).any()
    assert not even_odd([square(3.2, 3.4)], (8, 8)).any()


# --- placing -----------------------------------------------------------------------------------
def test_a_grid_that_differs_only_in_the_order_of_its_axes_is_taken_voxel_for_voxel():
    volume = made(turn=turned())
    mask = ball(volume, middle(volume) + [3, 2, 1], 8.0)
    flipped = volume.affine_mm.copy()
    flipped[:3, 3] += flipped[:3, 0] * (volume.size[0] - 1)
    flipped[:3, 0] *= -1
    swapped = flipped[:, [1, 0, 2, 3]]
    other = mask[:, :, ::-1].transpose(0, 2, 1)
    placed = placed_on([Labelled("lesion", other, swapped)], FRAME, volume)
    one = placed.find("lesion")
    assert np.array_equal(one.full(volume.hu.shape), mask)
    assert one.kind is StructureKind.TARGET
    assert placed.notes == ()


@pytest.mark.long("journey")
@pytest.mark.parametrize("spacing", [(0.4, 0.4, 0.5), (3.0, 3.0, 3.0), (1.0, 1.0, 1.0)])
def test_another_grid_is_resampled_to_the_same_place_and_volume(spacing):
    volume = made((64, 64, 40), (0.9, 0.9, 2.5))
    extent = np.array(volume.size) * volume.spacing_mm
    other = made(tuple(int(n) for n in extent / spacing), spacing, turn=turned(8.0))
    centre = middle(volume)
    mask = ball(other, centre, 12.0)
    one = placed_on([Labelled("x", mask, other.affine_mm)], "", volume).find("x")
    assert np.allclose(one.centre_mm, centre, atol=0.3)
    assert one.millilitres == pytest.approx(4 / 3 * np.pi * 1.2**3, rel=0.06)


def test_what_lies_outside_is_told_and_another_frame_of_reference_refused():
    volume = made()
    mask = ball(volume, middle(volume), 8.0)
    found = [Labelled("x", mask, volume.affine_mm)]
    with pytest.raises(FrameOfReferenceError, match="another frame"):
        placed_on(found, "2.25.78", volume)
    away = volume.affine_mm.copy()
    away[0, 3] += 500.0
    with pytest.raises(StructureError, match="none of the structures"):
        placed_on([Labelled("x", mask, away)], FRAME, volume)
    half = volume.affine_mm.copy()
    half[0, 3] = volume.affine_mm[0, 3] - 0.8 * 30
    placed = placed_on([Labelled("x", mask, half)], FRAME, volume)
    assert "% of x lie outside" in placed.notes[0]
    assert "no frame of reference" in placed_on(found, "", volume).notes[0]


def test_a_vessel_thinner_than_the_voxels_is_not_lost():
    volume = made((40, 40, 20), (1.0, 1.0, 5.0))
    fine = made((80, 80, 200), (0.5, 0.5, 0.5))
    mask = np.zeros(fine.hu.shape, bool)
    mask[60, 40, 20:60] = True
    one = placed_on([Labelled("vein", mask, fine.affine_mm)], FRAME, volume).find("vein")
    assert one.mask.any()


def test_kinds_are_guessed_from_names():
    assert guessed_kind("Aorta abdominalis") is StructureKind.VESSEL
    assert guessed_kind("left_rib 7") is StructureKind.BONE
    assert guessed_kind("GTV") is StructureKind.TARGET
    assert guessed_kind("Right lung") is StructureKind.RISK
    assert guessed_kind("thing") is StructureKind.OTHER
    assert guessed_kind("spinal cord") is StructureKind.RISK
