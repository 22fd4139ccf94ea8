"""One SeriesInstanceUID, several stacks: copies, passes, pictures beside them."""

import shutil

import numpy as np
import pytest

from app.imaging.errors import SeriesAmbiguousError
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices


def parts(folder) -> dict[str, tuple[int, bool]]:
    return {s.part: (s.size[2], s.usable) for s in scan_folder(folder).series}


def test_a_folder_that_holds_every_file_twice_is_one_series(tmp_path):
    Slices().write(tmp_path / "a")
    shutil.copytree(tmp_path / "a", tmp_path / "b")
    (series,) = scan_folder(tmp_path).series
    assert series.usable
    assert series.size[2] == 5
    assert series.notes == ("5 files are copies and left out",)


def test_a_copy_under_another_uid_counts_once_if_its_pixels_are_the_same(tmp_path):
    slices = Slices()
    slices.write(tmp_path)
    slices.write_one(tmp_path / "again", 2, 4.0, SOPInstanceUID="2.25.77")
    (series,) = scan_folder(tmp_path).series
    assert series.usable
    assert series.notes == ("1 file is a copy and left out",)


def test_two_files_of_one_instance_that_differ_are_refused_by_name(tmp_path):
    slices = Slices()
    slices.write(tmp_path)
    slices.write_one(tmp_path / "other", 2, 4.0, PixelData=bytes(2 * 12 * 16))
    (series,) = scan_folder(tmp_path).series
    assert series.reason.startswith("doubled slices")
    assert "other" in series.reason
    assert "differ" in series.reason


def test_the_whole_one_of_two_copies_stands_for_the_broken_one(tmp_path):
    paths = Slices(shape=(64, 64)).write(tmp_path)
    whole = paths[2].read_bytes()
    paths[2].write_bytes(whole[: len(whole) - 100])
    (tmp_path / "whole").write_bytes(whole)
    assert scan_folder(tmp_path).series[0].usable


@pytest.mark.parametrize(
    ("tag", "values"),
    [
        ("AcquisitionNumber", (4, 7)),
        ("TemporalPositionIdentifier", (1, 2)),
        ("ConvolutionKernel", ("B30f", "B70f")),
        ("ImageType", (["ORIGINAL", "PRIMARY", "AXIAL"], ["DERIVED", "SECONDARY", "AXIAL"])),
    ],
)
def test_passes_over_the_same_places_become_series_of_their_own(tmp_path, tag, values):
    for number, value in enumerate(values):
        Slices(tags={tag: value, "PixelPaddingValue": number}).write(tmp_path / str(number))
    for number, path in enumerate(sorted((tmp_path / "1").iterdir())):
        slices = Slices(tags={tag: values[1]})
        data = np.full(slices.shape, 7 + number, "<u2").tobytes()
        k = [97 * n % 101 for n in range(5)].index(int(path.name[1:]))
        slices.write_one(path, k, 2.0 * k, SOPInstanceUID=f"2.25.88.{k}", PixelData=data)
    found = scan_folder(tmp_path)
    assert [(s.size[2], s.usable) for s in found.series] == [(5, True), (5, True)]
    assert len({s.key for s in found.series}) == 2
    with pytest.raises(SeriesAmbiguousError, match="2 passes over the same places"):
        load_ct(tmp_path, factory.SERIES)
    highest = [int(load_ct(tmp_path, series.key).hu.max()) for series in found.series]
    assert min(highest) == 11 - 1024
    assert max(highest) > 1000


def test_acquisitions_that_continue_each_other_stay_one_series(tmp_path):
    slices = Slices(offsets=(0.0, 2.0, 4.0))
    slices.write(tmp_path / "a")
    for k, offset in enumerate((6.0, 8.0, 10.0), 3):
        slices.write_one(tmp_path / f"b{k}", k, offset, AcquisitionNumber=2)
    assert parts(tmp_path) == {"": (6, True)}


def test_a_gap_between_acquisitions_is_not_hidden_by_splitting_them(tmp_path):
    slices = Slices()
    for k, offset in enumerate((0.0, 2.0, 4.0, 8.0, 10.0, 12.0)):
        slices.write_one(tmp_path / f"s{k}", k, offset, AcquisitionNumber=1 + (k > 2))
    (series,) = scan_folder(tmp_path).series
    assert series.reason.startswith("gap: 1 slice is missing")


def test_interleaved_acquisitions_are_apart_though_they_mesh_to_an_even_stack(tmp_path):
    slices = Slices()
    for k, offset in enumerate(slices.offsets):
        slices.write_one(tmp_path / f"s{k}", k, offset, AcquisitionNumber=1 + k % 2)
    assert parts(tmp_path) == {"acquisition-1": (3, True), "acquisition-2": (2, True)}


def test_overlapping_ranges_at_other_places_are_split(tmp_path):
    slices = Slices()
    for n, offsets in enumerate(((0.0, 2.0, 4.0, 6.0), (3.3, 5.3, 7.3))):
        for k, offset in enumerate(offsets):
            slices.write_one(tmp_path / f"s{n}{k}", 10 * n + k, offset, AcquisitionNumber=n + 1)
    assert parts(tmp_path) == {"acquisition-1": (4, True), "acquisition-2": (3, True)}


def test_a_localizer_among_the_slices_is_set_beside_them(tmp_path):
    slices = Slices()
    slices.write(tmp_path)
    slices.write_one(
        tmp_path / "scout",
        9,
        0.0,
        ImageType=["ORIGINAL", "PRIMARY", "LOCALIZER"],
        ImageOrientationPatient=list(factory.CORONAL),
    )
    assert parts(tmp_path) == {"": (5, True), "localizer": (1, False)}


def test_whole_stacks_of_two_directions_are_two_series(tmp_path):
    Slices().write(tmp_path / "a")
    Slices(factory.CORONAL, tags={"InstanceNumber": 1}).write(tmp_path / "b")
    for n, path in enumerate((tmp_path / "b").iterdir()):
        import pydicom

        file = pydicom.dcmread(path)
        file.SOPInstanceUID = file.file_meta.MediaStorageSOPInstanceUID = f"2.25.99.{n}"
        file.save_as(path)
    assert parts(tmp_path) == {"stack-1": (5, True), "stack-2": (5, True)}
