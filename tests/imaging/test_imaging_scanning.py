"""Folders of every kind: what is found, what is refused and why, what is ignored and why."""

import os

import pytest

from app.imaging.errors import FolderError, SeriesRefusedError
from app.imaging.reading import load_ct, pixel_lps_mm
from app.imaging.scanning import scan_folder
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices


def reason(folder) -> str:
    (series,) = scan_folder(folder).series
    assert not series.usable
    return series.reason


def test_a_missing_path_is_named(tmp_path):
    with pytest.raises(FolderError, match="does not exist"):
        scan_folder(tmp_path / "nowhere")


def test_a_file_instead_of_a_folder_is_named(tmp_path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(FolderError, match="is a file"):
        scan_folder(tmp_path / "file")


def test_an_empty_folder_is_said_to_be_empty(tmp_path):
    with pytest.raises(FolderError, match="is empty"):
        load_ct(tmp_path)


def test_a_folder_without_dicom_says_what_was_in_it(tmp_path):
    (tmp_path / "notes.txt").write_text("hello" * 100)
    with pytest.raises(FolderError, match=r"no DICOM series.*notes\.txt: not a DICOM file"):
        load_ct(tmp_path)


def test_text_empty_and_broken_files_among_the_slices_are_named_and_do_no_harm(tmp_path):
    Slices().write(tmp_path)
    (tmp_path / "readme.dcm").write_text("no DICOM in spite of the name" * 20)
    (tmp_path / "empty").write_bytes(b"")
    (tmp_path / "noise").write_bytes(b"\0" * 128 + b"DICM" + bytes(range(256)) * 4)
    (tmp_path / "gone").symlink_to(tmp_path / "nowhere")
    os.mkfifo(tmp_path / "pipe")
    listing = scan_folder(tmp_path)
    reasons = {file.path.name: file.reason for file in listing.ignored}
    assert set(reasons) == {"readme.dcm", "empty", "noise", "gone", "pipe"}
    assert reasons["readme.dcm"] == "not a DICOM file"
    assert reasons["empty"] == "empty file"
    assert "cannot be read" in reasons["gone"]
    assert reasons["pipe"] == "not a regular file"
    assert len(listing.usable) == 1


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_a_file_without_permission_is_named(tmp_path):
    paths = Slices().write(tmp_path)
    paths[-1].chmod(0)
    assert "Permission denied" in scan_folder(tmp_path).ignored[0].reason


@pytest.mark.parametrize("keep", [0.98, 0.7])
def test_a_truncated_slice_makes_its_series_refused_by_name(tmp_path, keep):
    paths = Slices(shape=(64, 64)).write(tmp_path)
    raw = paths[2].read_bytes()
    paths[2].write_bytes(raw[: int(len(raw) * keep)])
    assert "truncated" in reason(tmp_path)
    assert paths[2].name in reason(tmp_path)
    with pytest.raises(SeriesRefusedError, match=paths[2].name):
        load_ct(tmp_path)


def test_a_slice_cut_off_before_its_pixels_makes_its_series_refused(tmp_path):
    paths = Slices().write(tmp_path)
    raw = paths[4].read_bytes()
    paths[4].write_bytes(raw[: raw.index(b"\xe0\x7f\x10\x00")])
    assert "no pixels" in reason(tmp_path)
    assert paths[4].name in reason(tmp_path)


def test_a_gap_names_the_files_at_its_sides(tmp_path):
    paths = Slices(offsets=(0.0, 2.0, 4.0, 8.0, 10.0)).write(tmp_path)
    assert reason(tmp_path).startswith("gap: 1 slice is missing")
    assert paths[2].name in reason(tmp_path)
    assert paths[3].name in reason(tmp_path)


def test_doubled_slices_are_refused(tmp_path):
    Slices(offsets=(0.0, 2.0, 4.0, 4.0, 6.0)).write(tmp_path)
    assert reason(tmp_path).startswith("doubled slices")


def test_uneven_spacing_is_refused_with_numbers(tmp_path):
    Slices(offsets=(0.0, 2.0, 4.0, 6.3, 8.0)).write(tmp_path)
    assert "uneven spacing: slices 1.700 to 2.300 mm apart" in reason(tmp_path)


def test_rounding_of_positions_is_no_unevenness(tmp_path):
    Slices(offsets=(0.0, 2.0, 4.009, 5.995, 8.0)).write(tmp_path)
    assert scan_folder(tmp_path).usable


def test_gantry_tilt_is_kept_and_said_with_its_angle(tmp_path):
    Slices(shear=0.25).write(tmp_path)
    (series,) = scan_folder(tmp_path).series
    assert series.usable
    assert series.notes == ("gantry tilt 14.0°",)
    assert series.remedy == "straighten"


@pytest.mark.parametrize(
    ("tags", "words"),
    [
        ({"ImagePositionPatient": None}, "ImagePositionPatient"),
        ({"PixelSpacing": None}, "PixelSpacing"),
        ({"PixelSpacing": [0.0, 0.5]}, "above zero"),
        ({"ImageOrientationPatient": [1, 0, 0, 1, 0, 0]}, "perpendicular"),
        ({"RescaleSlope": None}, "no Hounsfield units"),
        ({"RescaleSlope": "1e308"}, "RescaleSlope is 1e+308; its size must lie between"),
        ({"RescaleSlope": "1e-308"}, "RescaleSlope is 1e-308; its size"),
        ({"RescaleIntercept": "-1e308"}, "RescaleIntercept is -1e+308; its size"),
        ({"ImagePositionPatient": ["0", "-1e308", "0"]}, "ImagePositionPatient is -1e+308 mm"),
        ({"PixelSpacing": ["1e308", "1e308"]}, "PixelSpacing is 1e+308 mm"),
        ({"PixelSpacing": ["1e-300", "0.5"]}, "PixelSpacing is 1e-300 mm"),
        ({"RescaleType": "US"}, "no Hounsfield units"),
        ({"Modality": "MR"}, "not CT"),
        ({"ImageType": ["ORIGINAL", "PRIMARY", "LOCALIZER"]}, "localizer"),
        ({"SOPClassUID": "1.2.840.10008.5.1.4.1.1.7"}, "secondary capture"),
        ({"NumberOfFrames": 2}, "multi-frame"),
        ({"SamplesPerPixel": 3, "PhotometricInterpretation": "RGB"}, "RGB"),
        ({"BitsAllocated": 32, "PixelData": bytes(768)}, "32 bits"),
        ({"BitsStored": 17}, "contradict"),
        ({"Rows": 24}, "384"),
    ],
)
def test_unusable_series_say_why(tmp_path, tags, words):
    Slices(tags=tags).write(tmp_path)
    assert words in reason(tmp_path)


@pytest.mark.parametrize(
    ("tags", "words"),
    [
        ({"ImageOrientationPatient": list(factory.CORONAL)}, "mixed orientations"),
        ({"PixelSpacing": [1.0, 1.0]}, "mixed pixel spacings"),
        ({"Rows": 6, "Columns": 16}, "mixed image sizes"),
    ],
)
def test_too_few_slices_of_a_kind_are_refused_as_mixed(tmp_path, tags, words):
    slices = Slices(offsets=(0.0, 2.0))
    slices.write(tmp_path)
    slices.write_one(tmp_path / "odd", 9, 10.0, **tags)
    if "Rows" in tags:
        tags = {**tags, "PixelData": bytes(192)}
        slices.write_one(tmp_path / "odd", 9, 10.0, **tags)
    assert words in reason(tmp_path)


def test_a_single_slice_is_no_volume(tmp_path):
    Slices(offsets=(0.0,)).write(tmp_path)
    assert "single slice" in reason(tmp_path)


def test_a_wrong_number_is_named_with_its_field(tmp_path):
    paths = Slices().write(tmp_path)
    raw = paths[1].read_bytes()
    start = raw.index(b"\x28\x00\x53\x10")
    broken = raw[: start + 8] + b"x " + raw[start + 10 :]
    paths[1].write_bytes(broken)
    assert "RescaleSlope does not hold finite numbers (needs 1)" in reason(tmp_path)


@pytest.mark.parametrize("written", ["0,8\\0,7", "nan\\0.5"])
def test_a_mistaken_number_is_quoted(tmp_path, written):
    _with_spacing_written(tmp_path, written)
    assert f"PixelSpacing does not hold finite numbers (needs 2), not '{written}'" in reason(
        tmp_path
    )


def test_a_text_in_place_of_a_number_is_not_quoted_for_it_may_name_a_person(tmp_path):
    _with_spacing_written(tmp_path, "Doe\\Ann")
    assert "PixelSpacing does not hold finite numbers (needs 2)" in reason(tmp_path)
    assert "Doe" not in reason(tmp_path)


def _with_spacing_written(folder, written):
    first, *_ = Slices(spacing=(0.125, 0.5)).write(folder)
    raw, usual = first.read_bytes(), b"0.125\\0.5"
    assert raw.count(usual) == 1
    first.write_bytes(raw.replace(usual, written.encode().ljust(len(usual))))


def test_the_study_of_a_phantom_is_sorted_out(shared_data):
    listing = scan_folder(shared_data / "ct_phantom_study")
    verdicts = {series.size: (series.usable, series.reason) for series in listing.series}
    assert verdicts[(512, 512, 28)] == (True, "")
    assert "localizer" in verdicts[(512, 256, 1)][1]
    assert "secondary capture" in verdicts[(512, 256, 6)][1]
    assert {file.path.name for file in listing.ignored} == {"DIRFILE", "LICENSE"}


def test_tilt_and_gap_of_real_series_are_never_guessed(shared_data):
    series = sorted(scan_folder(shared_data / "ct_must_not_guess").series, key=lambda s: s.usable)
    assert series[0].reason.startswith("gap: 1 slice is missing")
    assert (series[0].size[2], series[0].part, series[0].remedy) == (4, "", "resample")
    assert series[1].notes == ("gantry tilt 14.0°",)


def test_a_perfusion_map_in_an_enhanced_file_is_refused_by_that_name(shared_data):
    (enhanced,) = scan_folder(shared_data / "ct_enhanced").series
    assert enhanced.reason.startswith("perfusion map (RCBF, ml/100ml/s), no Hounsfield units")


def test_a_pixel_of_the_tilted_real_series_follows_the_standard(shared_data):
    folder = shared_data / "ct_must_not_guess" / "gantry_tilt"
    (series,) = scan_folder(folder).series
    header = series.slices[2]
    lps_mm, _ = pixel_lps_mm(folder, header.identity.sop_uid, 100, 50)
    plane = header.plane
    for axis in range(3):
        step = 100 * plane.orientation[axis] + 50 * plane.orientation[3 + axis]
        assert lps_mm[axis] == pytest.approx(plane.position_mm[axis] + 0.41796875 * step)
