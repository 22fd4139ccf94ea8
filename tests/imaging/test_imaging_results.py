"""An attempt as DICOM objects: by other readers, by another validator, by numbers of their own.

dciodvfy is David Clunie's (Debian's dicom3tools); highdicom's and pydicom's readers and dcmtk's
`dsrdump` share no code with what writes the structure set, and geometry is compared with the CT's
own IPP, IOP and PixelSpacing, by PS3.3 C.7.6.2.1.1.
"""

import os
import shutil
import subprocess
from dataclasses import replace

import highdicom
import numpy as np
import pydicom
import pytest
from dicom_factory import Slices, oblique

from app.core.progress import Cancelled, Progress
from app.imaging.reading import load_ct
from app.imaging.results import AttemptFacts, MeasuredValue, ResultsError, write_results
from app.imaging.results.contours import rings
from app.imaging.results.presentation import within
from app.imaging.structures.errors import ExtraMissingError, StructureFileError
from app.imaging.structures.files import read_structures
from app.imaging.structures.structure import Structure, StructureKind, StructureSet

TAGS = {
    "PatientName": "CT-7f3a", "PatientID": "CT-7f3a", "PatientBirthDate": "", "PatientSex": "",
    "StudyDate": "20200105", "StudyTime": "101500", "AccessionNumber": "", "StudyID": "1",
    "ReferringPhysicianName": "", "Manufacturer": "x", "PatientIdentityRemoved": "YES",
    "DeidentificationMethod": "Acus", "PositionReferenceIndicator": "",
}  # fmt: skip


def written(folder, **tags):
    recipe = Slices(oblique(20.0), offsets=tuple(2.0 * k for k in range(12)), shape=(30, 40),
                    tags={k: v for k, v in (TAGS | tags).items() if v is not None})  # fmt: skip
    recipe.write(folder)
    return load_ct(folder)


@pytest.fixture(scope="module")
def volume(tmp_path_factory):
    return written(tmp_path_factory.mktemp("ct"))


@pytest.fixture(scope="module")
def structures(volume):
    k, j, i = np.indices(volume.hu.shape)
    ball = (k - 5) ** 2 * 4 + (j - 14) ** 2 + (i - 17) ** 2 < 81
    hollow = ball & ~((k - 5) ** 2 * 4 + (j - 13) ** 2 + (i - 15) ** 2 < 9)
    hollow &= ~((j - 16) ** 2 + (i - 21) ** 2 < 5)
    two = np.zeros(volume.hu.shape, bool)
    two[8:11, 2:6, 2:9] = two[8:11, 20:27, 30:38] = True
    return StructureSet((
        Structure.of("Leber ¶ “é”", hollow, volume, StructureKind.VESSEL, (255, 10, 20), 4.5),
        Structure.of("lesion", two, volume, StructureKind.TARGET, (20, 200, 90)),
    ))  # fmt: skip


@pytest.fixture(scope="module")
def told(volume):
    at = [tuple(volume.lps_mm(p).tolist()) for p in ([3.2, 4.1, 0.6], [20.25, 15.75, 6.4])]
    tip = tuple(volume.lps_mm([19.0, 16.5, 6.1]).tolist())
    measured = tuple(
        MeasuredValue(*one)
        for one in (
            ("score_total", "Score", 83.25, ""), ("lateral_error", "Off", 2.13, "mm"),
            ("angle_error", "Angle", 1.9, "°"), ("total_time", "Time", 42.5, "s"),
            ("control_scans", "Control scans", 3.0, "scans"),
            ("log_dimensionless_jerk", "Smoothness", -9.5, ""),
        )
    )  # fmt: skip
    return AttemptFacts("20261120-080001-a001", "20261120080001", "Übung: Lunge", at[0], at[1], tip,
                       measured, True)  # fmt: skip


@pytest.fixture(scope="module")
def folder(volume, structures, told, tmp_path_factory):
    place = tmp_path_factory.mktemp("objects")
    files = write_results(place, told, volume, structures)
    assert {path.name for path in files} == {"seg.dcm", "rtstruct.dcm", "gsps.dcm", "sr.dcm"}
    return place


def validated(path):
    """The errors of dciodvfy."""
    if shutil.which("dciodvfy") is None:
        why = "dciodvfy is not installed: apt-get install dicom3tools"
        (pytest.fail if os.environ.get("CI") else pytest.skip)(why)
    said = subprocess.run(["dciodvfy", "-new", path], capture_output=True, text=True, check=False,
                          errors="replace")  # fmt: skip
    return [line for line in said.stderr.splitlines() if line.startswith("Error")]


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", ["seg.dcm", "rtstruct.dcm", "gsps.dcm", "sr.dcm"])
def test_another_validator_finds_no_error(folder, name):
    assert validated(folder / name) == []


@pytest.mark.long("journey")
def test_the_validator_finds_what_is_wrong(folder, tmp_path):
    broken = pydicom.dcmread(folder / "rtstruct.dcm")
    del broken.StructureSetLabel
    broken.save_as(tmp_path / "broken.dcm")
    assert any("StructureSetLabel" in line for line in validated(tmp_path / "broken.dcm"))


@pytest.mark.long("journey")
def test_all_belong_to_the_study_and_the_patient_of_the_ct_and_name_nobody(folder, volume):
    source = pydicom.dcmread(volume.series.slices[0].path)
    found = [pydicom.dcmread(path) for path in sorted(folder.iterdir())]
    assert len({one.SeriesInstanceUID for one in found}) == len(found)
    assert len({one.SOPInstanceUID for one in found}) == len(found)
    for one in found:
        assert one.StudyInstanceUID == source.StudyInstanceUID
        assert (one.PatientID, one.PatientName) == ("CT-7f3a", "CT-7f3a")
        assert (one.PatientIdentityRemoved, one.SpecificCharacterSet) == ("YES", "ISO_IR 192")
        assert one.SeriesDescription == "Acus: Übung: Lunge"
        names = [e for e in one.iterall() if e.VR == "PN" and e.value and e.tag != 0x00100010]
        assert names == []
        named = {str(e.value) for e in one.iterall() if e.keyword == "ReferencedSOPInstanceUID"}
        of_ct = {header.identity.sop_uid for header in volume.series.slices}
        assert named & of_ct


def place(path, row, column):
    """LPS of a pixel by the file's own IPP, IOP and PixelSpacing."""
    file = pydicom.dcmread(path)
    across, down = np.array(file.ImageOrientationPatient).reshape(2, 3)
    between_rows, between_columns = file.PixelSpacing
    return file.ImagePositionPatient + across * between_columns * column + down * between_rows * row


@pytest.mark.long("journey")
def test_the_segmentation_is_the_masks_by_highdicoms_reader(folder, volume, structures):
    found = highdicom.seg.segread(folder / "seg.dcm")
    assert [s.SegmentLabel for s in found.SegmentSequence] == [s.name for s in structures]
    uids = [header.identity.sop_uid for header in volume.series.slices]
    for number, one in enumerate(structures, start=1):
        pixels = found.get_pixels_by_source_instance(
            uids, segment_numbers=[number], assert_missing_frames_are_empty=True
        )
        assert np.array_equal(pixels[..., 0].astype(bool), one.full(volume.hu.shape))


def contours(folder, number):
    """Of a region of the structure set, by pydicom: named picture, type, points (n, 3)."""
    found = pydicom.dcmread(folder / "rtstruct.dcm")
    for item in found.ROIContourSequence[number].ContourSequence:
        images = item.get("ContourImageSequence", [])
        points = np.array(item.ContourData, float).reshape(-1, 3)
        assert len(points) == item.NumberOfContourPoints
        yield [i.ReferencedSOPInstanceUID for i in images], item.ContourGeometricType, points


@pytest.mark.long("journey")
@pytest.mark.parametrize("number", [0, 1])
def test_contours_run_within_half_a_voxel_of_the_labels_boundary(
    folder, volume, structures, number
):
    by_uid = {h.identity.sop_uid: (k, h.path) for k, h in enumerate(volume.series.slices)}
    mask, seen = list(structures)[number].full(volume.hu.shape), set()
    for (uid,), kind, points in contours(folder, number):
        k, path = by_uid[uid]
        seen.add(k)
        assert kind == "CLOSED_PLANAR"
        origin, right, down = place(path, 0, 0), place(path, 0, 1), place(path, 1, 0)
        steps = np.column_stack([right - origin, down - origin])
        pixel, *_ = np.linalg.lstsq(steps, (points - origin).T, rcond=None)
        assert np.abs(steps @ pixel - (points - origin).T).max() < 1e-5  # in the picture's plane
        for i, j in pixel.T:
            rows, columns = (
                slice(max(0, int(np.ceil(at - 0.5001))), int(np.floor(at + 0.5001)) + 1)
                for at in (j, i)
            )
            near = mask[k, rows, columns]
            assert near.any()
            assert not near.all()
    assert seen == set(np.flatnonzero(mask.any(axis=(1, 2))).tolist())


@pytest.mark.long("journey")
def test_contours_filled_are_the_labels_again(folder, volume, structures):
    found = read_structures(folder / "rtstruct.dcm", volume)
    assert [one.name for one in found] == [one.name for one in structures]
    for one, other in zip(found, structures, strict=True):
        assert np.array_equal(one.full(volume.hu.shape), other.full(volume.hu.shape))


def test_the_area_of_a_line_with_keyholes_is_that_of_the_label_without_its_holes():
    layer = np.ones((30, 40), bool)
    layer[3:9, 4:12] = layer[3:9, 20:30] = layer[15:25, 5:35] = False
    layer[18:21, 10:20] = True  # a part within a hole
    areas = []
    for line in rings(layer):
        x, y = line.T
        areas.append(abs(0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))))
    # A square of n x m voxels has cut corners of 1/8 each, and so has a hole.
    holes = 6 * 8 + 6 * 10 + 10 * 30
    assert areas == pytest.approx([30 * 40 - 0.5 - holes + 3 * 0.5, 3 * 10 - 0.5])


@pytest.mark.long("journey")
def test_points_of_plan_and_tip_are_the_attempts_in_each_object(folder, told, volume):
    found = pydicom.dcmread(folder / "rtstruct.dcm")
    names = [one.ROIName for one in found.StructureSetROISequence]
    for name, point in told.points.items():
        ((images, kind, points),) = contours(folder, names.index(name))
        assert (images, kind) == ([], "POINT")
        assert np.abs(points[0] - point).max() < 1e-5
    report = highdicom.sr.srread(folder / "sr.dcm")
    groups = report.content.get_planar_roi_measurement_groups(
        graphic_type=highdicom.sr.GraphicTypeValues3D.POINT
    )
    assert {g.tracking_identifier for g in groups} == {"Entry", "Target", "Tip"}
    for group in groups:
        assert np.abs(group.roi.value[0] - told.points[group.tracking_identifier]).max() < 1e-3
        assert group.roi.frame_of_reference_uid == "2.25.2"
    drawn = pydicom.dcmread(folder / "gsps.dcm")
    for annotation in drawn.GraphicAnnotationSequence:
        (image,) = annotation.ReferencedImageSequence
        for text in annotation.get("TextObjectSequence", []):
            column, row = np.array(text.AnchorPoint) - 0.5
            header = next(
                h for h in volume.series.slices
                if h.identity.sop_uid == image.ReferencedSOPInstanceUID
            )  # fmt: skip
            off = place(header.path, row, column) - told.points[text.UnformattedTextValue]
            normal = np.cross(*np.array(pydicom.dcmread(header.path).ImageOrientationPatient)
                              .reshape(2, 3))  # fmt: skip
            assert np.linalg.norm(off - normal * (off @ normal)) < 1e-3
            assert abs(off @ normal) <= 1.0 + 1e-6  # half of the slices' distance


@pytest.mark.long("journey")
def test_the_path_is_drawn_whole_across_its_slices(folder, told, volume):
    drawn = pydicom.dcmread(folder / "gsps.dcm")
    lines = [
        np.array(graphic.GraphicData).reshape(-1, 2)
        for annotation in drawn.GraphicAnnotationSequence
        for graphic in annotation.GraphicObjectSequence
        if graphic.GraphicType == "POLYLINE"
    ]
    start, end = (volume.voxel(p)[:2] for p in (told.entry_mm, told.target_mm))
    length = sum(np.linalg.norm(line[1] - line[0]) for line in lines)
    assert length == pytest.approx(np.linalg.norm(end - start), abs=1e-3)


@pytest.mark.parametrize("k", [0, 1, 2, 3])
def test_a_path_in_one_slice_stands_on_that_slice_alone(k):
    part = within(np.array([1.0, 2.0, 2.0]), np.array([9.0, 4.0, 2.0]), k)
    assert (part is not None) == (k == 2)


@pytest.mark.long("journey")
def test_the_report_holds_values_units_and_verdict_by_code(folder, told):
    report = highdicom.sr.srread(folder / "sr.dcm")
    template = pydicom.dcmread(folder / "sr.dcm").ContentTemplateSequence[0]
    assert template.TemplateIdentifier == "1500"
    (group,) = [
        g for g in report.content.get_image_measurement_groups()
        if g.tracking_identifier == "Attempt"
    ]  # fmt: skip
    values = {m.name.value: (m.value, m.unit.value, m.name.scheme_designator)
              for m in group.get_measurements()}  # fmt: skip
    assert values == {
        "246262008": (83.25, "1", "SCT"), "762636008": (42.5, "s", "SCT"),
        "lateral_error": (2.13, "mm", "99ACUS"), "angle_error": (1.9, "deg", "99ACUS"),
        "control_scans": (3.0, "{scans}", "99ACUS"),
        "log_dimensionless_jerk": (-9.5, "1", "99ACUS"),
    }  # fmt: skip
    (verdict,) = group.get_qualitative_evaluations()
    assert (verdict.name.value, verdict.value.value) == ("verdict", "passed")
    assert report.CodingSchemeIdentificationSequence[0].CodingSchemeDesignator == "99ACUS"


@pytest.mark.long("journey")
def test_written_twice_they_are_the_same_and_another_attempt_is_another(
    folder, volume, structures, told, tmp_path
):
    again = write_results(tmp_path / "again", told, volume, structures)
    for path in again:
        assert path.read_bytes() == (folder / path.name).read_bytes()
    other = write_results(tmp_path / "other", replace(told, id="b"), volume, StructureSet())
    assert {path.name for path in other} == {"rtstruct.dcm", "gsps.dcm", "sr.dcm"}
    uids = [pydicom.dcmread(path).SOPInstanceUID for path in (*again, *other)]
    assert len(set(uids)) == 7


@pytest.mark.long("journey")
def test_without_a_tip_without_a_score_and_off_the_ct(volume, told, tmp_path):
    bare = replace(told, tip_mm=None, measured=(), passed=None)
    for path in write_results(tmp_path / "bare", bare, volume, StructureSet()):
        assert validated(path) == []
    away = replace(told, entry_mm=(900.0, 0.0, 0.0), target_mm=(901.0, 0.0, 0.0), tip_mm=None)
    with pytest.raises(ResultsError, match="meets no slice of this CT"):
        write_results(tmp_path / "away", away, volume, StructureSet())
    assert not (tmp_path / "away").exists()


@pytest.mark.long("journey")
def test_a_ct_that_may_name_its_patient_is_refused(told, tmp_path):
    named = written(tmp_path / "named", PatientIdentityRemoved=None)
    with pytest.raises(ResultsError, match="was not de-identified"):
        write_results(tmp_path / "out", told, named, StructureSet())
    assert not [path for path in tmp_path.iterdir() if "out" in path.name]


@pytest.mark.long("journey")
def test_a_ct_that_lacks_a_tag_has_gone_or_is_no_files_is_refused(told, tmp_path, volume):
    lacking = written(tmp_path / "lacking", StudyID=None)
    with pytest.raises(ResultsError, match=r"lacks what (gsps|sr)\.dcm has to repeat"):
        write_results(tmp_path / "out", told, lacking, StructureSet())
    gone = written(tmp_path / "gone")
    gone.series.slices[3].path.unlink()
    with pytest.raises(StructureFileError, match="file 4 of this CT is gone or damaged"):
        write_results(tmp_path / "out", told, gone, StructureSet())
    other = replace(volume, series=replace(volume.series, slices=volume.series.slices[1:]))
    with pytest.raises(ResultsError, match="not slice for slice"):
        write_results(tmp_path / "out", told, other, StructureSet())
    (tmp_path / "file").touch()
    with pytest.raises(ResultsError, match="cannot be written"):
        write_results(tmp_path / "file" / "out", told, volume, StructureSet())
    assert not (tmp_path / "out").exists()


@pytest.mark.long("journey")
def test_a_cancel_leaves_nothing(told, volume, structures, tmp_path):
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        write_results(tmp_path / "out", told, volume, structures, progress)
    assert not [path for path in tmp_path.iterdir() if "out" in path.name]


@pytest.mark.long("journey")
def test_without_the_extra_its_name_is_told(told, volume, tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "highdicom", None)
    from app.imaging.results.files import write_objects

    with pytest.raises(ExtraMissingError, match="structures"):
        write_objects(tmp_path, (), told, (), (1, 1, 1), (0.0,) * 16, Progress())
