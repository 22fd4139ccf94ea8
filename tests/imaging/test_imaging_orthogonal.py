"""The three views of a volume of any orientation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.rotation import rotation_exp
from app.imaging.errors import OutsideImageError
from app.imaging.orthogonal import Letters, OrthogonalSlicer, View, letters
from app.imaging.reading import load_ct
from app.imaging.series import Series
from app.imaging.volume import Volume
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices

ANATOMICAL = {
    View.AXIAL: Letters("R", "L", "A", "P"),
    View.SAGITTAL: Letters("A", "P", "S", "I"),
    View.CORONAL: Letters("R", "L", "S", "I"),
}
STRAIGHT = [
    factory.TRANSVERSE,
    factory.SAGITTAL,
    factory.CORONAL,
    factory.REVERSED,
    factory.FEET_FIRST_PRONE,
]


def volume_of(direction: np.ndarray, shape=(5, 7, 9), spacing=(0.5, 0.8, 2.0)) -> Volume:
    affine = np.eye(4)
    affine[:3, :3] = direction * spacing
    affine[:3, 3] = (10.0, -20.0, 30.0)
    hu = np.arange(np.prod(shape), dtype=np.int16).reshape(shape)
    series = Series("u", "CT", "l", shape[::-1], None, None, None, True, "", (), "CT-0", "", ())
    return Volume(hu, affine, series)


@pytest.mark.parametrize("orientation", STRAIGHT)
def test_every_straight_acquisition_is_shown_in_the_radiological_convention(tmp_path, orientation):
    Slices(orientation).write(tmp_path)
    slicer = OrthogonalSlicer(load_ct(tmp_path))
    for view in View:
        assert slicer.letters(view) == ANATOMICAL[view]


@pytest.mark.parametrize("orientation", [*STRAIGHT, factory.oblique(), factory.oblique(-50.0)])
@pytest.mark.parametrize("view", View)
def test_a_pixel_shows_the_voxel_at_its_patient_point(tmp_path, orientation, view):
    Slices(orientation).write(tmp_path)
    volume = load_ct(tmp_path)
    slicer = OrthogonalSlicer(volume)
    rows, columns = slicer.shape(view)
    for index in (0, slicer.count(view) - 1):
        image = slicer.image(view, index)
        assert image.shape == (rows, columns)
        for row, column in ((0, 0), (rows - 1, 1), (2, columns - 1)):
            lps_mm = slicer.to_lps_mm(view, index, column, row)
            assert volume.hu_at(lps_mm, "nearest") == image[row, column]
            back = slicer.from_lps_mm(view, lps_mm)
            np.testing.assert_allclose(back, (index, column, row), atol=1e-9)


@given(
    omega=st.tuples(*[st.floats(-3.0, 3.0)] * 3),
    place=st.tuples(*[st.floats(-50.0, 50.0)] * 3),
    view=st.sampled_from(View),
)
@settings(derandomize=True, deadline=None, max_examples=60)
def test_mapping_there_and_back_is_exact_for_any_rotation(omega, place, view):
    slicer = OrthogonalSlicer(volume_of(rotation_exp(np.array(omega))))
    index, column, row = slicer.from_lps_mm(view, place)
    np.testing.assert_allclose(slicer.to_lps_mm(view, index, column, row), place, atol=1e-9)


@given(omega=st.tuples(*[st.floats(-3.0, 3.0)] * 3))
@settings(derandomize=True, deadline=None, max_examples=60)
def test_each_view_keeps_its_nearest_anatomical_axes_for_any_rotation(omega):
    """Each patient axis is used once, in its own sense, whatever way the volume lies."""
    slicer = OrthogonalSlicer(volume_of(rotation_exp(np.array(omega))))
    right = slicer.to_lps_mm(View.AXIAL, 0, 1, 0) - slicer.to_lps_mm(View.AXIAL, 0, 0, 0)
    down = slicer.to_lps_mm(View.AXIAL, 0, 0, 1) - slicer.to_lps_mm(View.AXIAL, 0, 0, 0)
    up = slicer.to_lps_mm(View.AXIAL, 1, 0, 0) - slicer.to_lps_mm(View.AXIAL, 0, 0, 0)
    share = sum(v[axis] / np.linalg.norm(v) for axis, v in enumerate((right, down, up)))
    assert share >= 1.0 - 1e-9  # of all permutations and flips the best has at least this


def test_views_share_the_volume_s_memory():
    volume = volume_of(rotation_exp((0.3, 2.0, -1.0)))
    slicer = OrthogonalSlicer(volume)
    for view in View:
        assert np.shares_memory(slicer.image(view, 1), volume.hu)
        assert not slicer.image(view, 1).flags.writeable


def test_pixel_sizes_follow_the_axes():
    slicer = OrthogonalSlicer(volume_of(np.eye(3)))
    assert slicer.pixel_size_mm(View.AXIAL) == (0.5, 0.8)
    assert slicer.pixel_size_mm(View.CORONAL) == (0.5, 2.0)
    assert slicer.pixel_size_mm(View.SAGITTAL) == (0.8, 2.0)
    assert [slicer.slice_spacing_mm(view) for view in View] == [2.0, 0.5, 0.8]


def test_a_slice_that_does_not_exist_is_refused():
    slicer = OrthogonalSlicer(volume_of(np.eye(3)))
    for index in (-1, 5):
        with pytest.raises(OutsideImageError, match="slices 0 to 4 do"):
            slicer.image(View.AXIAL, index)
    assert slicer.nearest_index(View.AXIAL, (0.0, 0.0, 1e9)) == 4
    assert slicer.nearest_index(View.AXIAL, (0.0, 0.0, -1e9)) == 0


@pytest.mark.parametrize(
    ("direction", "text"),
    [
        ((1, 0, 0), "L"),
        ((-3, 0, 0.01), "R"),
        ((0.5, -0.8, 0), "AL"),
        ((0.2, 0.3, -0.9), "IPL"),
        ((0, 1, 1e-9), "P"),
    ],
)
def test_letters_come_in_the_order_of_dominance(direction, text):
    assert letters(direction) == text
