"""Series read on request: uneven, gapped, tilted, too large; and what the volume says of it."""

import json

import numpy as np
import pytest

from app.core.progress import Cancelled, Progress
from app.imaging import memory
from app.imaging.body import find_body
from app.imaging.errors import SeriesRefusedError, TooLargeError
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.reading import choose, load_ct, read_again, read_with
from app.imaging.scanning import scan_folder
from app.imaging.series import AS_IT_IS
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices


class Field(Slices):
    """Slices through a field that is linear in the patient, so that any resampling is exact."""

    SLOPE = np.array([2.0, -3.0, 5.0])

    def write(self, folder, prefix="s"):
        folder.mkdir(parents=True, exist_ok=True)
        return [
            self.write_one(folder / f"{prefix}{k}", k, offset, **self.extra(offset))
            for k, offset in enumerate(self.offsets)
        ]

    def extra(self, offset):
        rows, columns = self.shape
        j, i = np.mgrid[:rows, :columns]
        points = (
            self.position(offset)
            + i[..., None] * self.spacing[1] * np.array(self.orientation[:3])
            + j[..., None] * self.spacing[0] * np.array(self.orientation[3:])
        )
        stored = np.rint(self.field(points)).astype("<i2")
        return {"PixelData": stored.tobytes(), "RescaleIntercept": "0", "PixelRepresentation": 1}

    def field(self, points):
        return (points - np.array(self.origin)) @ self.SLOPE


def read(folder, remedy):
    return read_with(choose(scan_folder(folder), None, remedy), remedy)


def check_field(volume, field, least=0.5):
    k, j, i = np.nonzero(volume.hu > -1000)
    assert len(k) > least * volume.hu.size
    expected = field.field(volume.lps_mm(np.stack([i, j, k], axis=1)))
    assert np.abs(volume.hu[k, j, i] - expected).max() <= 1.01  # rounded twice


@pytest.mark.parametrize("orientation", [factory.TRANSVERSE, factory.oblique(), factory.REVERSED])
def test_uneven_slices_are_resampled_to_where_they_lie(tmp_path, orientation):
    field = Field(orientation, offsets=(0.0, 2.0, 4.0, 6.3, 8.0))
    field.write(tmp_path)
    with pytest.raises(SeriesRefusedError, match="it can be read if you ask to resample"):
        load_ct(tmp_path, factory.SERIES)
    volume = read(tmp_path, "resample")
    assert volume.made == ("resampled from slices 1.7 to 2.3 mm apart to 2 mm",)
    assert volume.size == (16, 12, 5)
    check_field(volume, field, 0.99)


@pytest.mark.parametrize("orientation", [factory.TRANSVERSE, factory.oblique()])
def test_a_tilted_stack_is_straightened_to_where_it_lies(tmp_path, orientation):
    field = Field(orientation, shear=0.25)
    field.write(tmp_path)
    volume = read(tmp_path, "straighten")
    assert volume.made == ("straightened from a gantry tilt of 14.0°",)
    assert volume.tilt_deg == pytest.approx(0.0, abs=1e-6)
    np.testing.assert_allclose(volume.direction.T @ volume.direction, np.eye(3), atol=1e-9)
    assert volume.size == (16, 15, 5)  # 2 mm of drift are 2.5 rows of 0.8 mm
    check_field(volume, field)


def test_a_gap_stays_empty(tmp_path):
    field = Field(offsets=(0.0, 2.0, 4.0, 8.0, 10.0))
    field.write(tmp_path)
    volume = read(tmp_path, "resample")
    assert volume.made[1] == "1 gap of missing slices left empty"
    assert (volume.hu[3] == -1024).all()
    assert volume.size[2] == 6
    check_field(volume, field, 0.8)


def test_a_change_of_spacing_is_no_gap(tmp_path):
    field = Field(offsets=(0.0, 1.0, 2.0, 3.0, 5.0, 7.0, 9.0))
    field.write(tmp_path)
    series = scan_folder(tmp_path).series[0]
    volume = read_with(series, "resample", spacing_mm=1.0)
    assert volume.size[2] == 10
    check_field(volume, field, 0.99)


def test_halving_averages_blocks_and_keeps_their_places(tmp_path):
    field = Field(offsets=(0.0, 0.5, 1.0, 1.5, 2.0), spacing=(0.5, 0.5))
    field.write(tmp_path)
    volume = read(tmp_path, "halve")
    assert volume.size == (8, 6, 2)
    assert volume.made == ("reduced: 2 × 2 × 2 voxels averaged to one",)
    check_field(volume, field)


@pytest.mark.parametrize(
    ("remedy", "changes", "asked"),
    [
        ("resample", {"offsets": (0.0, 2.0, 4.0, 6.3, 8.0)}, {"spacing_mm": 1.5}),
        ("resample", {"offsets": (0.0, 2.0, 4.0, 6.3, 8.0)}, {}),
        ("straighten", {"shear": 0.25}, {}),
        ("halve", {}, {"factors": (2, 1, 3)}),
    ],
)
def test_a_volume_knows_how_to_be_read_the_same_way_again(tmp_path, remedy, changes, asked):
    Field(**changes).write(tmp_path)
    first = read_with(choose(scan_folder(tmp_path), None, remedy), remedy, **asked)
    assert first.recipe.remedy == remedy
    again = read_again(scan_folder(tmp_path).series[0], first.recipe)
    assert again.recipe == first.recipe
    assert again.made == first.made
    np.testing.assert_array_equal(again.hu, first.hu)
    np.testing.assert_array_equal(again.affine_mm, first.affine_mm)


def test_a_series_read_as_it_is_asks_for_nothing(tmp_path):
    Field().write(tmp_path)
    volume = read_with(scan_folder(tmp_path).series[0])
    assert volume.recipe == AS_IT_IS
    np.testing.assert_array_equal(read_again(volume.series, volume.recipe).hu, volume.hu)


def test_what_does_not_fit_the_memory_is_refused_and_halving_offered(tmp_path, monkeypatch):
    field = Field()
    field.write(tmp_path)
    fitting = scan_folder(tmp_path).series[0]
    monkeypatch.setattr(memory, "available", lambda: 1500)
    monkeypatch.setattr(memory, "open_bytes", lambda: 0)
    (series,) = scan_folder(tmp_path).series
    assert not series.usable
    assert series.remedy == "halve"
    assert "of memory" in series.reason
    with pytest.raises(TooLargeError, match="ask to halve it"):
        load_ct_of(fitting)
    volume = read_with(series, "halve")
    assert volume.hu.nbytes * memory.WORKING_COPIES <= 1500 * memory.SHARE
    check_field(volume, field)


def load_ct_of(series):
    return read_with(series)


def test_a_remedy_that_does_not_help_is_refused(tmp_path):
    Slices(tags={"ImageType": ["ORIGINAL", "PRIMARY", "LOCALIZER"]}).write(tmp_path)
    (series,) = scan_folder(tmp_path).series
    with pytest.raises(
        SeriesRefusedError,
        match=r"the remedy 'resample' does not help series \S+: localizer.*; no remedy does$",
    ):
        read_with(series, "resample")


def test_resampling_can_be_cancelled(tmp_path):
    Field(offsets=(0.0, 2.0, 4.5)).write(tmp_path)
    (series,) = scan_folder(tmp_path).series
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        read_with(series, "resample", progress)


def test_the_slices_of_a_tilted_volume_keep_places_and_distances(tmp_path):
    slices = Slices(shear=0.25)
    slices.write(tmp_path)
    volume = load_ct(tmp_path)
    assert volume.is_sheared
    assert volume.tilt_deg == pytest.approx(14.036, abs=1e-3)
    slicer = OrthogonalSlicer(volume)
    for view in View:
        point = slicer.to_lps_mm(view, 1, 2, 3)
        np.testing.assert_allclose(slicer.from_lps_mm(view, point), (1, 2, 3), atol=1e-9)
    np.testing.assert_allclose(slicer.to_lps_mm(View.AXIAL, 3, 0, 0), slices.position(6.0))
    assert slicer.slice_spacing_mm(View.AXIAL) == pytest.approx(2.0)
    assert [slicer.is_right_angled(view) for view in View] == [True, False, True]
    right, down = slicer.straight_axes(View.SAGITTAL)
    assert right @ down == pytest.approx(0.0, abs=1e-12)


def test_the_body_of_a_tilted_volume_is_found_where_it_lies(tmp_path):
    slices = Slices(
        spacing=(2.0, 2.0), shape=(40, 40), shear=0.25, offsets=tuple(np.arange(20) * 2.5)
    )
    centre = slices.position(24.0) + (38.0, 38.0, 0.0)
    for k, offset in enumerate(slices.offsets):
        j, i = np.mgrid[:40, :40]
        points = slices.position(offset) + np.stack([2.0 * i, 2.0 * j, 0.0 * i], axis=-1)
        stored = np.where(np.linalg.norm(points - centre, axis=-1) < 18.0, 1064, 24).astype("<u2")
        slices.write_one(tmp_path / f"s{k}", k, offset, PixelData=stored.tobytes())
    body = find_body(load_ct(tmp_path))
    inside = body.share(centre + 15.0 * np.eye(3))
    outside = body.share(centre + 23.0 * np.vstack([np.eye(3), -np.eye(3)]))
    assert (inside > 0.5).all()
    assert (outside < 0.5).all()


def test_the_command_reads_on_request_and_says_so(tmp_path, monkeypatch, capsys):
    from tests.imaging.test_imaging_ct_command import run

    field = Field(offsets=(0.0, 2.0, 4.0, 6.3, 8.0))
    field.write(tmp_path)
    arguments = ("point", tmp_path, "--voxel", "3,2,3", "--json")
    code, out, error = run(monkeypatch, capsys, *arguments, "--remedy", "resample")
    assert code == 0
    answer = json.loads(out)["facts"]
    assert answer["lps_mm"] == pytest.approx([-18.5, 31.6, -94.0])
    assert answer["hu"] == pytest.approx(3.0 * 0.5 * 2 - 2 * 0.8 * 3 + 6.0 * 5, abs=1.01)
    assert "resampled from slices 1.7 to 2.3 mm apart" in error
    code, _, error = run(monkeypatch, capsys, *arguments, "--remedy", "glue")
    assert code == 2
    assert "resample, straighten, halve" in error
