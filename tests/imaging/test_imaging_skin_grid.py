"""A grid on the skin: lines as far apart as is said along it, found again by table and line."""

import numpy as np
import pytest
from test_imaging_scanned import volume_of

from app.imaging.body import find_body
from app.imaging.errors import InvalidEntryError
from app.imaging.scan_look import ScanLook, look_of
from app.imaging.scan_order import ScanOrder
from app.imaging.scanned import scan_image
from app.imaging.skin_grid import GridPlace, GridSpec, SkinGrid, spec_of
from app.imaging.volume import Volume

RADIUS, HEIGHT = 90.0, 120.0
SPEC = GridSpec((10.0, -20.0, 60.0), (0.0, -1.0), 11, 10.0, 80.0)


def cylinder() -> Volume:
    """A patient as round as a pipe, its axis along z, the skin to a fraction of a voxel."""
    k, j, i = np.mgrid[0:60, 0:110, 0:110]
    x, y = -109.0 + 2.0 * i, -109.0 + 2.0 * j
    edge = np.clip((RADIUS - np.hypot(x, y)) / 2.0 + 0.5, 0.0, 1.0)
    affine = np.diag([2.0, 2.0, 2.0, 1.0])
    affine[:2, 3] = -109.0
    return volume_of(np.rint(-1000.0 + 1040.0 * edge + 0 * k).astype(np.int16), affine)


@pytest.fixture(scope="module")
def known() -> tuple[Volume, SkinGrid]:
    volume = cylinder()
    return volume, SkinGrid(find_body(volume), SPEC)


def angle_of(point: np.ndarray) -> float:
    """Of a point about the cylinder's axis, from its front, towards the patient's left [rad]."""
    return float(np.arctan2(point[0], -point[1]))


def test_lines_lie_on_the_skin_and_as_far_apart_as_the_arc_is_long(known) -> None:
    _, grid = known
    points = np.array([grid.point(GridPlace(52.0, line)) for line in range(1, 12)])
    np.testing.assert_allclose(np.hypot(points[:, 0], points[:, 1]), RADIUS, atol=0.6)
    arcs = RADIUS * np.diff([angle_of(point) for point in points])
    np.testing.assert_allclose(arcs, 10.0, atol=0.3)
    np.testing.assert_allclose(points[5, [0, 2]], (10.0, 52.0), atol=0.05)  # above the centre


def test_a_place_is_found_again_and_the_way_between_two_is_that_of_the_pipe(known) -> None:
    _, grid = known
    for place in (GridPlace(50.0, 3, 2.5), GridPlace(71.5, 9, -4.0), GridPlace(60.0, 6)):
        again = grid.place(grid.point(place))
        assert (again.line, again.table_mm) == (place.line, place.table_mm)
        assert again.offset_mm == pytest.approx(place.offset_mm, abs=0.05)
    a, b = grid.point(GridPlace(50.0, 2, 3.0)), grid.point(GridPlace(74.0, 8, -2.0))
    unrolled = np.hypot(RADIUS * (angle_of(b) - angle_of(a)), 24.0)
    assert grid.distance_mm(a, b) == pytest.approx(unrolled, rel=0.01)


def test_a_side_that_lies_up_carries_the_grid(known) -> None:
    volume, _ = known
    side = SkinGrid(find_body(volume), GridSpec((20.0, 5.0, 60.0), (-1.0, 0.0), 5, 10.0, 60.0))
    point = side.point(GridPlace(60.0, 3))
    assert point[0] < 0.0
    np.testing.assert_allclose(point[1:], (5.0, 60.0), atol=0.05)


@pytest.mark.long("journey")
def test_a_scan_shows_a_dot_of_metal_on_the_skin_for_each_line(known) -> None:
    volume, grid = known
    order = ScanOrder(60.0, 3, 5.0)
    plain = scan_image(volume, order).hu
    shown = scan_image(volume, order, look=ScanLook(grid=SPEC))
    changed = shown.hu[1].astype(int) - plain[1] > 500
    from scipy import ndimage

    labels, count = ndimage.label(changed, np.ones((3, 3)))
    assert count == 11
    places = np.array(ndimage.center_of_mass(changed, labels, range(1, 12)))[:, ::-1]
    dots = shown.lps_mm(np.column_stack([places, np.ones(11)]))
    wires = np.array([grid.point(GridPlace(60.0, line)) for line in range(1, 12)])
    order_x = np.argsort(dots[:, 0])
    np.testing.assert_allclose(dots[order_x, 0], wires[:, 0], atol=1.5)
    added = shown.hu[1].astype(float) - plain[1]
    near = ndimage.grey_dilation(labels, size=(5, 5))
    sizes = ndimage.sum(added, near, range(1, 12))[order_x]
    assert sizes[4] > sizes[3]  # the fifth is thick
    assert sizes[9] > sizes[8]


def test_beyond_its_lines_and_its_length_the_grid_is_not_there(known) -> None:
    volume, grid = known
    with pytest.raises(InvalidEntryError, match="1 to 11"):
        grid.point(GridPlace(60.0, 12))
    below = ScanOrder(10.0, 3, 5.0)
    np.testing.assert_array_equal(
        scan_image(volume, below, look=ScanLook(grid=SPEC)).hu, scan_image(volume, below).hu
    )


def test_a_grid_without_skin_below_is_refused(known) -> None:
    volume, _ = known
    beside = SkinGrid(find_body(volume), GridSpec((105.0, 0.0, 60.0)))
    with pytest.raises(InvalidEntryError, match="no skin"):
        beside.point(GridPlace(60.0, 7))


def test_a_grid_is_read_back_as_it_was() -> None:
    assert spec_of(SPEC.document()) == SPEC
    look = ScanLook(grid=SPEC)
    assert look_of(False, look.document()) == look
