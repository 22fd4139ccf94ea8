"""Hard cases of the imaging room: hostile files, degenerate geometry, huge and empty input."""

import contextlib

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.core.errors import AcusError, NumericalError
from app.core.rotation import rotation_exp
from app.imaging.body import find_body, is_inside, nearest_skin, skin_entry
from app.imaging.errors import InvalidEntryError
from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from app.imaging.window import WindowLevel, to_grey
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices
from tests.imaging.test_imaging_orthogonal import volume_of

QUICK = settings(
    derandomize=True,
    deadline=None,
    max_examples=60,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


@pytest.mark.long("statistics")
@given(where=st.integers(0, 1200), value=st.integers(0, 255), length=st.integers(1, 8))
@QUICK
def test_a_damaged_byte_never_gives_anything_but_a_verdict(tmp_path, where, value, length):
    """The series is read with every value in range, refused, or the file ignored; nothing else."""
    tmp_path /= "ct"  # beside it the settings get the key of the pseudonyms
    for old in tmp_path.glob("*"):
        old.unlink()
    paths = Slices().write(tmp_path)
    raw = bytearray(paths[2].read_bytes())
    raw[where : where + length] = bytes([value]) * len(raw[where : where + length])
    paths[2].write_bytes(raw)
    with contextlib.suppress(AcusError):
        volume = load_ct(tmp_path)
        assert np.isfinite(volume.hu).all()
        assert np.isfinite(volume.affine_mm).all()


@pytest.mark.long("statistics")
@given(keep=st.floats(0.0, 0.9999))
@QUICK
def test_a_file_cut_anywhere_is_never_taken_for_whole(tmp_path, keep):
    tmp_path /= "ct"  # beside it the settings get the key of the pseudonyms
    for old in tmp_path.glob("*"):
        old.unlink()
    paths = Slices().write(tmp_path)
    raw = paths[2].read_bytes()
    paths[2].write_bytes(raw[: int(keep * len(raw))])
    listing = scan_folder(tmp_path)
    assert not listing.usable
    named = [file.path.name for file in listing.ignored] + [s.reason for s in listing.series]
    assert any(paths[2].name in text or "gap" in text for text in named)


@pytest.mark.parametrize("text", ["nan", "inf", "1e999", "1e400", "--1", "1,5", "0x10"])
@pytest.mark.parametrize("tag", [b"\x20\x00\x32\x00", b"\x28\x00\x52\x10", b"\x28\x00\x30\x00"])
def test_numbers_that_are_none_are_named_and_never_passed_on(tmp_path, text, tag):
    paths = Slices().write(tmp_path)
    raw = paths[1].read_bytes()
    start = raw.index(tag) + 8
    length = int.from_bytes(raw[start - 2 : start], "little")
    value = text.encode()[:length].ljust(length)
    paths[1].write_bytes(raw[:start] + value + raw[start + length :])
    (series,) = scan_folder(tmp_path).series
    assert not series.usable
    assert "finite numbers" in series.reason


@pytest.mark.parametrize("angle", [44.999, 45.0, 45.001, 89.9999, 90.0, 135.0, 180.0])
def test_views_of_a_volume_between_two_axes_stay_exact(angle):
    slicer = OrthogonalSlicer(volume_of(rotation_exp((0.0, 0.0, np.radians(angle)))))
    for view in View:
        lps_mm = slicer.to_lps_mm(view, 1, 2, 3)
        np.testing.assert_allclose(slicer.from_lps_mm(view, lps_mm), (1, 2, 3), atol=1e-9)
        letters = slicer.letters(view)
        assert len({letters.left, letters.right, letters.top, letters.bottom}) == 4


def test_a_singular_or_broken_affine_is_refused():
    flat = np.eye(3)
    flat[:, 2] = flat[:, 1]
    with pytest.raises(NumericalError, match="singular"):
        volume_of(flat)
    with pytest.raises(NumericalError, match="not finite"):
        volume_of(np.full((3, 3), np.nan))


@pytest.mark.parametrize("way", Interpolation)
@pytest.mark.parametrize("shape", [(1, 1, 1), (1, 5, 5), (2, 1, 3)])
def test_interpolation_of_thin_volumes_keeps_to_their_values(way, shape):
    values = np.random.default_rng(4).uniform(0.0, 1.0, shape)
    far = np.array([[0, 0, 0], [-1e6, 0, 0], [0, 1e6, 1e6], [0.5, 0.5, 0.5]], float)
    out = interpolate(values, far, way)
    assert np.isfinite(out).all()
    assert out.min() >= -0.5
    assert out.max() <= 1.5


def test_the_smallest_series_and_a_large_offset_keep_their_geometry(tmp_path):
    slices = Slices(
        factory.oblique(), origin=(90000.0, -90000.0, 90000.0), offsets=(0.0, 0.05), shape=(2, 2)
    )
    slices.write(tmp_path)
    volume = load_ct(tmp_path)
    np.testing.assert_allclose(volume.lps_mm((0, 0, 1)), slices.position(0.05), atol=1e-6)
    np.testing.assert_allclose(volume.voxel(volume.lps_mm((1, 1, 1))), (1, 1, 1), atol=1e-6)


def test_a_long_series_tilted_by_less_than_the_limit_is_placed_exactly(tmp_path):
    slices = Slices(shear=0.0015, offsets=tuple(np.arange(0.0, 60.0, 1.5)), shape=(2, 3))
    slices.write(tmp_path)
    volume = load_ct(tmp_path)
    for k in (0, 20, 39):
        expected = slices.position(slices.offsets[k])
        np.testing.assert_allclose(volume.lps_mm((0, 0, k)), expected, atol=1e-6)


@pytest.mark.parametrize("hu", [-1000, 300])
def test_a_volume_of_air_or_of_tissue_only_has_no_skin_to_be_found(hu):
    volume = volume_of(np.eye(3), (20, 20, 20), (2.0, 2.0, 2.0))
    object.__setattr__(volume, "hu", np.full((20, 20, 20), hu, np.int16))
    body = find_body(volume)
    middle = volume.lps_mm((10, 10, 10))
    assert is_inside(body, middle) == (hu > 0)
    if hu < 0:
        with pytest.raises(InvalidEntryError, match="no body"):
            nearest_skin(body, middle)
    with pytest.raises(NumericalError, match="not finite"):
        nearest_skin(body, (np.nan, 0.0, 0.0))
    with pytest.raises(NumericalError, match="not finite"):
        skin_entry(body, (np.inf, 0.0, 0.0), middle)


def test_extreme_values_and_windows_keep_grey_levels_in_range():
    values = np.array([-1e30, -32768, 0, 32767, 3e38], np.float32)
    for window in (WindowLevel(1, 0), WindowLevel(1.0005, 0), WindowLevel(1e6, -1e6)):
        grey = to_grey(values, window)
        assert grey[0] == 0
        assert grey[-1] == 255
        assert (np.diff(grey.astype(int)) >= 0).all()
