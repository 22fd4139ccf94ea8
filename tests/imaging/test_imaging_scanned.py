"""A control scan shows its slices of the CT, the needle where it crosses them, and no more."""

import numpy as np
import pytest
from numpy.typing import NDArray

from app.core.errors import NumericalError
from app.core.rotation import rotation_exp
from app.imaging import scanned
from app.imaging.errors import ScanOrderError
from app.imaging.scan_order import ScanNeedle, ScanOrder, Seen, seen
from app.imaging.scanned import METAL_HU, scan_image
from app.imaging.series import Series
from app.imaging.volume import Volume

RADIUS = 0.9


@pytest.fixture
def endless(monkeypatch: pytest.MonkeyPatch) -> None:
    """A scale that does not end below steel, so that brightness measures metal."""
    monkeypatch.setattr(scanned, "LAST_HU", 32000.0)


def volume_of(hu: NDArray[np.generic], affine: NDArray[np.float64] | None = None) -> Volume:
    if affine is None:
        affine = np.diag([0.8, 0.8, 1.0, 1.0])
        affine[:3, 3] = (-25.6, -25.6, 100.0)
    k, j, i = hu.shape
    series = Series("1", "CT", "", (i, j, k), None, None, None, True, "", (), "CT-1", "", ())
    return Volume(hu, affine, series)


def flat(value: int = 40) -> Volume:
    return volume_of(np.full((60, 65, 65), value, np.int16))


def metal_mm3(picture: Volume, tissue: float = 40.0) -> float:
    """Volume of the metal that a picture shows, by its brightness."""
    share = (picture.hu.astype(np.float64) - tissue) / (METAL_HU - tissue)
    return float(share.sum() * np.prod(picture.spacing_mm))


def test_a_scan_without_a_needle_is_the_mean_of_the_ct_over_each_slice() -> None:
    rng = np.random.default_rng(3)
    source = volume_of(rng.integers(-500, 500, (60, 65, 65)).astype(np.int16))
    picture = scan_image(source, ScanOrder(130.0, 3, 5.0))
    assert picture.size == (65, 65, 3)
    np.testing.assert_allclose(picture.affine_mm[:3, 3], (-25.6, -25.6, 125.0))
    # five planes of a 5 mm slice lie on the CT's own slices, 1 mm apart
    np.testing.assert_allclose(picture.hu[1], source.hu[28:33].mean(axis=0), atol=0.51)


@pytest.mark.usefixtures("endless")
@pytest.mark.parametrize("direction", [(0, 0, 1), (0, 1, 0), (1, 2, 0.3), (-0.4, 0.8, -0.2)])
def test_the_metal_in_the_picture_is_as_much_as_in_the_slices(direction: tuple[float, ...]) -> None:
    axis = np.array(direction) / np.linalg.norm(direction)
    middle = np.array([0.3, -0.2, 130.1])
    needle = ScanNeedle(middle - 9.0 * axis, middle + 9.0 * axis, RADIUS)
    picture = scan_image(flat(), ScanOrder(130.0, 5, 5.0), needle)
    whole = np.pi * RADIUS**2 * 18.0
    assert metal_mm3(picture) == pytest.approx(whole, rel=0.05)


def test_the_metal_lies_where_the_needle_does() -> None:
    needle = ScanNeedle(np.array([-10.0, -15.0, 130.0]), np.array([6.0, 9.0, 130.0]), RADIUS)
    picture = scan_image(flat(), ScanOrder(130.0, 3, 5.0), needle)
    changed = np.argwhere(picture.hu != 40)
    points = picture.lps_mm(changed[:, ::-1].astype(float))
    assert set(changed[:, 0].tolist()) == {1}
    along = np.clip((points - needle.hub_mm) @ needle.axis, 0.0, needle.length_mm)
    nearest = needle.hub_mm + along[:, None] * needle.axis
    assert np.linalg.norm((points - nearest)[:, :2], axis=1).max() < RADIUS + 0.6
    assert np.linalg.norm(points - needle.tip_mm, axis=1).min() < 1.0


def test_a_tip_outside_the_range_leaves_no_changed_voxel_near_it() -> None:
    needle = ScanNeedle(np.array([0.0, -20.0, 150.0]), np.array([0.0, 10.0, 110.0]), RADIUS)
    order = ScanOrder(130.0, 3, 5.0)
    picture = scan_image(flat(), order, needle)
    changed = picture.lps_mm(np.argwhere(picture.hu != 40)[:, ::-1].astype(float))
    assert seen(order, needle) is Seen.SHAFT
    assert len(changed) > 10
    low, high = order.range_mm
    part = needle.within(low, high)
    assert part is not None
    for end in part:  # nothing beyond where the shaft leaves the slices, but its own thickness
        beyond = (changed - end) @ needle.axis * (1 if end is part[1] else -1)
        assert beyond.max() < order.slice_mm / 2 + RADIUS + 1.2
    assert np.linalg.norm(changed - needle.tip_mm, axis=1).min() > 10.0


@pytest.mark.parametrize("streak", [False, True])
def test_a_needle_beside_the_range_changes_nothing(streak: bool) -> None:
    needle = ScanNeedle(np.array([0.0, -20.0, 112.0]), np.array([0.0, 10.0, 111.0]), RADIUS)
    order = ScanOrder(130.0, 3, 5.0)
    with_needle = scan_image(flat(), order, needle, streak)
    assert seen(order, needle) is Seen.NOTHING
    np.testing.assert_array_equal(with_needle.hu, scan_image(flat(), order).hu)


@pytest.mark.usefixtures("endless")
def test_a_grazing_shaft_is_faint() -> None:
    def peak(z: float) -> int:
        ends = np.array([[0.0, -15.0, z], [0.0, 15.0, z]])
        needle = ScanNeedle(ends[0], ends[1], 0.6)
        return int(scan_image(flat(), ScanOrder(130.0, 3, 5.0), needle).hu[1].max())

    assert peak(130.0) > peak(132.5) > peak(132.8) > 40
    assert peak(134.0) == 40


def test_the_streak_is_dark_beyond_the_tip_and_only_in_slices_with_metal() -> None:
    needle = ScanNeedle(np.array([0.0, -20.0, 130.0]), np.array([0.0, 5.0, 130.0]), RADIUS)
    order = ScanOrder(130.0, 3, 5.0)
    plain, streaked = (scan_image(flat(), order, needle, on).hu for on in (False, True))
    column, row = 32, round((5.0 + 6.0 + 25.6) / 0.8)
    assert streaked[1, row, column] < plain[1, row, column] - 100
    assert streaked[1, row, column + 5] > plain[1, row, column + 5]
    np.testing.assert_array_equal(streaked[[0, 2]], plain[[0, 2]])


def test_breathing_moves_the_tissue_and_not_the_needle() -> None:
    hu = np.full((60, 65, 65), 40, np.int16)
    hu[:, 30:34, 30:34] = 300
    source = volume_of(hu)
    needle = ScanNeedle(np.array([-10.0, -15.0, 130.0]), np.array([-10.0, -5.0, 130.0]), RADIUS)
    order = ScanOrder(130.0, 3, 5.0)
    still = scan_image(source, order, needle)
    moved = scan_image(source, order, needle, shift_mm=(8.0, 0.0, 0.0))
    np.testing.assert_array_equal(moved.hu[:, 30:34, 40:44], still.hu[:, 30:34, 30:34])
    np.testing.assert_array_equal(moved.hu[:, 10:28, 15:25], still.hu[:, 10:28, 15:25])


def test_slices_of_an_oblique_ct_lie_where_the_patient_has_them() -> None:
    affine = np.eye(4)
    affine[:3, :3] = rotation_exp([0.1, -0.2, 0.15]) @ np.diag([0.9, 0.7, 1.5])
    affine[:3, 3] = (-20.0, 30.0, 200.0)
    k, j, i = np.mgrid[0:30, 0:40, 0:36]
    z = affine[2, 0] * i + affine[2, 1] * j + affine[2, 2] * k + affine[2, 3]
    source = volume_of(np.rint(10 * (z - 200.0)).astype(np.int16), affine)
    picture = scan_image(source, ScanOrder(220.0, 3, 2.0))
    inside = picture.hu > -1000
    middles = np.broadcast_to(np.array([218.0, 220.0, 222.0])[:, None, None], picture.hu.shape)
    off = np.abs(picture.hu - 10 * (middles - 200.0))[inside]
    assert inside.any()
    assert np.median(off) < 1.0  # the rest is the edge, partly air


@pytest.mark.parametrize(
    ("values", "names"),
    [((130.0, 2), "3 to 5"), ((130.0, 6), "3 to 5"), ((130.0, 3, 0.1), "0.5"),
     ((float("nan"), 3), "not a number")],
)  # fmt: skip
def test_an_order_that_no_scanner_takes_is_refused(values: tuple[float, ...], names: str) -> None:
    with pytest.raises(ScanOrderError, match=names):
        ScanOrder(*values)  # type: ignore[arg-type]


def test_a_needle_without_length_or_with_nan_is_refused() -> None:
    with pytest.raises(NumericalError):
        ScanNeedle(np.zeros(3), np.zeros(3))
    with pytest.raises(NumericalError):
        ScanNeedle(np.zeros(3), np.array([0.0, np.nan, 1.0]))


def test_the_table_moves_the_whole_stack() -> None:
    order = ScanOrder(100.0, 4, 3.0)
    np.testing.assert_allclose(order.middles_mm, [95.5, 98.5, 101.5, 104.5])
    assert order.range_mm == (94.0, 106.0)
    assert order.moved(-7.5).range_mm == (86.5, 98.5)
