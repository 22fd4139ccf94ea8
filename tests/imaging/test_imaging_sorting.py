"""What is one series: one patient, one study, one frame of reference, one pass, one stack."""

import pydicom
import pytest

from app.core.errors import AcusError
from app.imaging.errors import SeriesRefusedError
from app.imaging.library import CtLibrary
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from tests.imaging import dicom_factory as factory
from tests.imaging.archive_series import Archived
from tests.imaging.dicom_factory import Slices
from tests.imaging.test_imaging_enhanced import write_enhanced

COUNT = 8


def written(folder, per_slice=lambda k: {}, extra=(), count=COUNT):
    """Write a series whose slices have tags of their own, and images beside them."""
    series = Archived(count=count)
    folder.mkdir(parents=True, exist_ok=True)
    for k in range(count):
        (folder / f"{k:03d}.dcm").write_bytes(series.encoded(k, **per_slice(k)))
    for n, tags in enumerate(extra):
        own = {"SOPInstanceUID": f"2.25.77.{n}", **tags}
        (folder / f"x{n}.dcm").write_bytes(series.encoded(0, **own))
    return series


def halves(**tags):
    """Give one value to the lower half and another to the upper half."""
    return lambda k: {name: values[2 * k >= COUNT] for name, values in tags.items()}


def in_turn(**tags):
    """Give each of some values to every so manieth slice."""
    return lambda k: {name: values[k % len(values)] for name, values in tags.items()}


def parts(folder):
    return {s.part: (s.size[2], s.usable) for s in scan_folder(folder).series}


# --- patients, studies, frames of reference


@pytest.mark.parametrize("spread", [halves, in_turn])
@pytest.mark.parametrize(
    ("tags", "part"),
    [
        ({"PatientID": ("A-1", "B-2")}, "patient"),
        ({"PatientID": ("A-1", "B-2"), "StudyInstanceUID": ("2.25.11", "2.25.12")}, "patient"),
        ({"PatientID": ("A-1", "")}, "patient"),
        ({"StudyInstanceUID": ("2.25.11", "2.25.12")}, "study"),
    ],
)
def test_two_patients_or_studies_under_one_series_uid_are_two_series(tmp_path, tags, part, spread):
    series = written(tmp_path, spread(**tags))
    found = scan_folder(tmp_path).series
    assert [(s.part, s.size[2], s.usable) for s in found] == [
        (f"{part}-1", COUNT // 2, True),
        (f"{part}-2", COUNT // 2, True),
    ]
    assert len({s.pseudonym for s in found}) == 2
    assert all("read apart" in s.notes[0] for s in found)
    for one in found:
        volume = load_ct(tmp_path, one.key)
        own = [int(header.path.stem) for header in one.slices]
        assert (volume.hu == series.hu()[own]).all()


@pytest.mark.parametrize(
    "tags",
    [
        {"IssuerOfPatientID": ("ONE", "OTHER")},
        {"PatientBirthDate": ("19500101", "19610203")},
        {"PatientName": ("Nobody^Here", "Someone^Else")},
        {"PatientID": ("", ""), "PatientName": ("Nobody^Here", "Someone^Else")},
    ],
)
def test_two_patients_whom_no_identifier_tells_apart_are_refused_by_name(tmp_path, tags):
    written(tmp_path, halves(**tags))
    (series,) = scan_folder(tmp_path).series
    assert f"two patients: {list(tags)[-1]} differs" in series.reason
    assert "folder of their own" in series.reason
    assert not any(word in series.reason for word in ("ONE", "1961", "Someone", "Else"))


@pytest.mark.parametrize(
    "names", [("Doe^John", "DOE^JOHN^"), ("Müller^Eva", "M\xfcLLER^EVA"), ("A^B=\xe4", "A^B")]
)
def test_one_name_in_several_spellings_is_one_patient(tmp_path, names):
    written(tmp_path, halves(PatientName=names))
    assert parts(tmp_path) == {"": (COUNT, True)}


@pytest.mark.promise(
    "docs/privacy.md: files of two patients or studies are never taken together, whatever "
    "SeriesInstanceUID they share"
)
def test_an_import_never_joins_two_patients(tmp_path):
    written(tmp_path / "in", halves(PatientID=("A-1", "B-2")))
    library = CtLibrary(tmp_path / "library")
    found = scan_folder(tmp_path / "in").series
    taken = [library.import_series(series).entry for series in found]
    ids = [
        {str(pydicom.dcmread(file).PatientID) for file in entry.folder.glob("*.dcm")}
        for entry in taken
    ]
    assert [len(one) for one in ids] == [1, 1]
    assert ids[0] != ids[1]
    assert len({entry.name[:11] for entry in taken}) == 2


def test_an_import_refuses_what_was_joined_by_any_other_way(tmp_path):
    from dataclasses import replace

    written(tmp_path / "in", halves(PatientID=("A-1", "B-2")))
    first, second = scan_folder(tmp_path / "in").series
    joined = replace(first, slices=first.slices + second.slices)
    with pytest.raises(SeriesRefusedError, match="PatientID differs among its files"):
        CtLibrary(tmp_path / "library").import_series(joined)


def test_two_patients_in_enhanced_files_of_one_series_are_two_series(tmp_path):
    for n in (1, 2):
        folder = tmp_path / f"f{n}"
        folder.mkdir()
        write_enhanced(folder / "e", Slices(), PatientID=f"P{n}", SOPInstanceUID=f"2.25.5.{n}")
    assert parts(tmp_path) == {"patient-1": (5, True), "patient-2": (5, True)}


def test_two_frames_of_reference_in_one_series_are_two_series(tmp_path):
    written(tmp_path, halves(FrameOfReferenceUID=("2.25.31", "2.25.32")))
    assert parts(tmp_path) == {"frame-1": (4, True), "frame-2": (4, True)}


def test_a_frame_of_reference_for_each_file_is_whoever_de_identified_them(tmp_path):
    written(tmp_path, lambda k: {"FrameOfReferenceUID": f"2.25.{k + 40}"})
    (series,) = scan_folder(tmp_path).series
    assert series.usable
    assert "8 frames of reference" in series.notes[0]
    assert series.frame_of_reference == ""


def test_one_slice_of_another_frame_of_reference_is_set_apart(tmp_path):
    written(tmp_path, lambda k: {"FrameOfReferenceUID": "2.25.32" if k == 7 else "2.25.31"})
    assert parts(tmp_path) == {"frame-1": (7, True), "frame-2": (1, False)}


# --- passes that mesh to an even stack


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("tag", "values"),
    [
        ("AcquisitionNumber", (1, 2)),
        ("AcquisitionNumber", (4, 5, 9)),
        ("ConvolutionKernel", ("B30f", "B70f")),
        ("TemporalPositionIdentifier", (1, 2, 3, 4)),
        ("AcquisitionTime", ("100000", "101500")),
        ("AcquisitionTime", ("100000.25", "100003.5", "100007.75")),
        ("AcquisitionDateTime", ("20200101100000", "20200101101500")),
        ("ContentTime", ("100000", "101500")),
        ("ImageType", (["ORIGINAL", "PRIMARY", "AXIAL"], ["DERIVED", "PRIMARY", "AXIAL"])),
        ("ImageType", (["ORIGINAL", "PRIMARY", "AXIAL", "A"], ["ORIGINAL", "PRIMARY", "AXIAL"])),
        ("KVP", ("80", "140")),
        ("EchoNumbers", (1, 2)),
        ("SliceThickness", ("1", "5")),
        ("SeriesNumber", (3, 4)),
        ("SeriesDescription", ("arterial", "venous")),
        ("ContrastBolusAgent", ("", "something")),
    ],
)
def test_passes_that_mesh_to_an_even_stack_are_read_apart(tmp_path, tag, values):
    count = 4 * len(values)
    series = written(tmp_path, in_turn(**{tag: values}), count=count)
    found = scan_folder(tmp_path).series
    assert [(s.size[2], s.usable) for s in found] == [(4, True)] * len(values)
    assert len({s.key for s in found}) == len(values)
    for one in found:
        own = sorted(int(header.path.stem) for header in one.slices)
        assert len({k % len(values) for k in own}) == 1
        assert (load_ct(tmp_path, one.key).hu == series.hu()[own]).all()
        assert not any(text in one.key for text in ("20200101", "arterial", "something"))


def test_two_sweeps_of_the_table_are_read_apart_though_every_slice_has_its_own_time(tmp_path):
    written(tmp_path, lambda k: {"AcquisitionTime": f"10{k % 2}0{k // 2:02d}"})
    assert [(s.size[2], s.usable) for s in scan_folder(tmp_path).series] == [(4, True)] * 2


@pytest.mark.parametrize(
    "per_slice",
    [
        lambda k: {"AcquisitionTime": f"1000{k:02d}", "ContentTime": f"1000{k:02d}"},
        lambda k: {"AcquisitionTime": f"1000{COUNT - k:02d}"},
        lambda k: {"AcquisitionTime": f"1000{k // 2:02d}", "AcquisitionNumber": k // 2 + 1},
        lambda k: {"AcquisitionTime": f"1000{k // 4:02d}", "AcquisitionNumber": k // 4 + 1},
        lambda k: {"AcquisitionNumber": k + 1, "TriggerTime": str(10 * k)},
        lambda k: {"ContentTime": f"10000{(0, 2, 1, 3, 5, 4, 7, 6)[k]}"},
        lambda k: {"ContentTime": f"10000{k % 2}"},
    ],
)
def test_step_and_shoot_and_helical_scans_stay_one_volume(tmp_path, per_slice):
    series = written(tmp_path, per_slice)
    (one,) = scan_folder(tmp_path).series
    assert (one.usable, one.notes) == (True, ())
    assert (load_ct(tmp_path).hu == series.hu()).all()


@pytest.mark.parametrize(
    ("tag", "values"), [("ConvolutionKernel", ("B30f", "B70f")), ("KVP", ("120", "100"))]
)
@pytest.mark.parametrize("odd", [(4,), (3, 4), (0,), (4, 5, 6, 7)])
def test_slices_of_another_kernel_or_voltage_are_said_where_they_are_no_stack(
    tmp_path, tag, values, odd
):
    written(tmp_path, lambda k: {tag: values[k in odd]})
    (series,) = scan_folder(tmp_path).series
    assert series.usable
    assert f"its slices differ in {tag}: neighbours may not compare" in series.notes


def test_meshed_acquisitions_of_mr_stay_one_volume(tmp_path):
    slices = Slices(tags={"Modality": "MR", "SOPClassUID": "1.2.840.10008.5.1.4.1.1.4"})
    for k, offset in enumerate(slices.offsets):
        slices.write_one(tmp_path / f"s{k}", k, offset, AcquisitionNumber=1 + k % 2)
    assert parts(tmp_path) == {"": (5, True)}


# --- what lies beside slices

SCOUT = {"ImageOrientationPatient": list(factory.CORONAL)}
RGB = {
    "SamplesPerPixel": 3,
    "PhotometricInterpretation": "RGB",
    "PlanarConfiguration": 0,
    "BitsAllocated": 8,
    "BitsStored": 8,
    "HighBit": 7,
    "PixelData": bytes(3 * 20 * 24),
}


@pytest.mark.parametrize(
    ("extra", "words", "part"),
    [
        ([SCOUT], "another direction", "beside-1"),
        ([{**SCOUT, "Rows": 24, "Columns": 20}], "another direction", "beside-1"),
        ([{"Rows": 24, "Columns": 20}], "another size", "beside-1"),
        ([{"PixelSpacing": [1.0, 1.0]}], "another pixel spacing", "beside-1"),
        ([RGB], "picture in colour", "picture"),
        ([{"PhotometricInterpretation": "PALETTE COLOR"}], "picture in colour", "picture"),
        ([{"ImagePositionPatient": None}], "does not say where it lies", "unplaced"),
        ([{"PixelSpacing": None}], "does not say where it lies", "unplaced"),
        ([{"Modality": "PT"}], "no CT or MR image", "other"),
        ([{"SOPClassUID": "1.2.840.10008.5.1.4.1.1.481.2"}], "no CT or MR image", "other"),
        ([{"ImageType": ["DERIVED", "SECONDARY", "AXIAL", "CBF"]}], "map of other values", "map"),
        ([SCOUT, {"ImageOrientationPatient": list(factory.SAGITTAL)}], "direction", "beside-2"),
    ],
)
def test_what_is_no_slice_is_set_aside_by_name_and_the_slices_are_usable(
    tmp_path, extra, words, part
):
    series = written(tmp_path, extra=extra)
    found = {s.part: s for s in scan_folder(tmp_path).series}
    assert found[""].usable
    assert any(words in note and "x0.dcm" in note for note in found[""].notes)
    assert not found[part].usable
    assert (load_ct(tmp_path).hu == series.hu()).all()


def test_a_slice_set_aside_is_still_missed_in_the_stack(tmp_path):
    written(tmp_path, lambda k: {"ImagePositionPatient": None} if k == 3 else {})
    found = {s.part: s for s in scan_folder(tmp_path).series}
    assert found[""].reason.startswith("gap: 1 slice is missing between 002.dcm and 004.dcm")
    assert not found["unplaced"].usable


def test_a_series_most_of_which_has_no_place_is_refused_for_that(tmp_path):
    written(tmp_path, lambda k: {"ImagePositionPatient": None} if k > 2 else {})
    (series,) = scan_folder(tmp_path).series
    assert "ImagePositionPatient" in series.reason


def test_different_images_of_one_instance_are_said(tmp_path):
    written(tmp_path, lambda k: {"SOPInstanceUID": f"2.25.6.{k // 2}"})
    (series,) = scan_folder(tmp_path).series
    assert "8 different images share a SOPInstanceUID" in series.notes


def test_a_refusal_is_one_of_the_programs_own_errors(tmp_path):
    written(tmp_path, halves(PatientName=("A^B", "C^D")))
    with pytest.raises(AcusError, match="two patients"):
        load_ct(tmp_path)
