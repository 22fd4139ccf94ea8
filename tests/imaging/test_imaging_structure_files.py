"""Structures in and out of files: SEG, RTSTRUCT, .seg.nrrd and NIfTI."""

import os
import subprocess
import sys
from pathlib import Path

import nibabel
import nrrd
import numpy as np
import pytest
from pydicom import dcmread
from pydicom.data import get_testdata_file
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.uid import ExplicitVRLittleEndian

from app.imaging.reading import load_ct
from app.imaging.series import Series
from app.imaging.structures.errors import (
    ExtraMissingError,
    FrameOfReferenceError,
    StructureError,
    StructureFileError,
)
from app.imaging.structures.files import read_structures, write_structures
from app.imaging.structures.seg_nrrd import read_nrrd
from app.imaging.structures.structure import Structure, StructureKind, StructureSet
from app.imaging.volume import Volume
from tests.imaging.dicom_factory import Slices, oblique

RTSTRUCT = "1.2.840.10008.5.1.4.1.1.481.3"


@pytest.fixture
def volume(tmp_path: Path) -> Volume:
    recipe = Slices(oblique(20.0), offsets=tuple(2.0 * k for k in range(12)), shape=(30, 40),
                    tags={"PatientBirthDate": "", "PatientSex": "", "StudyDate": "",
                          "StudyTime": "", "AccessionNumber": "", "StudyID": "",
                          "ReferringPhysicianName": "", "Manufacturer": "x"})  # fmt: skip
    recipe.write(tmp_path / "ct")
    return load_ct(tmp_path / "ct")


def two(volume: Volume) -> StructureSet:
    first, second = np.zeros((2, *volume.hu.shape), bool)
    first[2:7, 5:20, 6:30] = True
    first[3:5, 9:12, 10:20] = False
    second[5:9, 10:25, 20:36] = True  # overlaps the first
    return StructureSet((
        Structure.of("aorta", first, volume, StructureKind.VESSEL, (255, 10, 20), 4.5),
        Structure.of("lesion", second, volume, StructureKind.TARGET, (20, 200, 90)),
    ))  # fmt: skip


def same(one: StructureSet, other: StructureSet) -> None:
    assert [s.name for s in one] == [s.name for s in other]
    for a, b in zip(one, other, strict=True):
        assert a.kind is b.kind
        assert a.corner == b.corner
        assert np.array_equal(a.mask, b.mask)
        assert np.abs(np.subtract(a.colour, b.colour)).max() <= 2


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", ["x.seg.nrrd", "x.dcm"])
def test_structures_come_back_from_a_file_as_they_went_in(volume, tmp_path, name):
    structures = two(volume)
    write_structures(tmp_path / name, structures, volume)
    back = read_structures(tmp_path / name, volume)
    same(structures, back)
    assert [p for p in tmp_path.iterdir() if p.name.startswith(".")] == []


def test_a_file_of_our_own_is_known_on_its_own_ct_and_on_no_other(volume, tmp_path):
    write_structures(tmp_path / "x.seg.nrrd", two(volume), volume)
    assert read_structures(tmp_path / "x.seg.nrrd", volume).notes == ()
    other = Volume(volume.hu + np.int16(1), volume.affine_mm, volume.series)
    (note,) = read_structures(tmp_path / "x.seg.nrrd", other).notes
    assert "no frame of reference" in note


def test_slicer_finds_its_keys_in_a_written_segmentation(volume, tmp_path):
    path = tmp_path / "x.seg.nrrd"
    write_structures(path, two(volume), volume)
    header = nrrd.read_header(str(path))
    assert header["Segment0_Name"] == "aorta"
    assert header["Segment1_Layer"] == "1"
    assert header["space"] == "left-posterior-superior"
    assert header["kinds"][0] == "list"
    assert header["Segmentation_ContainedRepresentationNames"] == "Binary labelmap|"
    assert read_structures(path, volume).find("aorta").warn_mm == 4.5


def test_a_written_dicom_segmentation_refers_to_the_files_of_its_ct(volume, tmp_path):
    write_structures(tmp_path / "x.dcm", two(volume), volume)
    written = dcmread(tmp_path / "x.dcm")
    assert written.FrameOfReferenceUID == volume.series.frame_of_reference
    assert written.SegmentationType == "BINARY"
    assert written.SeriesInstanceUID != volume.series.uid
    assert written.ReferencedSeriesSequence[0].SeriesInstanceUID == volume.series.uid


def test_a_dicom_segmentation_of_no_files_is_refused_with_the_way_out(volume, tmp_path):
    series = Series("1", "CT", "", volume.size, None, None, None, True, "", (), "", "", ())
    bare = Volume(volume.hu, volume.affine_mm, series)
    with pytest.raises(StructureFileError, match=r"\.seg\.nrrd"):
        write_structures(tmp_path / "x.dcm", two(bare), bare)
    with pytest.raises(StructureFileError, match=r"seg\.nrrd.*\.dcm"):
        write_structures(tmp_path / "x.nii", two(bare), bare)
    with pytest.raises(StructureFileError, match="no structures"):
        write_structures(tmp_path / "x.seg.nrrd", StructureSet(), bare)
    with pytest.raises(StructureFileError, match="cannot be written"):
        write_structures(tmp_path / "none" / "x.seg.nrrd", two(bare), bare)


def test_a_segmentation_in_ras_and_with_flipped_axes_lies_where_it_says(volume, tmp_path):
    structures = two(volume)
    mask = structures.find("aorta").full(volume.hu.shape)
    flip = np.diag([-1.0, -1.0, 1.0])
    directions = flip @ volume.affine_mm[:3, :3]
    origin = flip @ (volume.origin_mm + volume.affine_mm[:3, 2] * (volume.size[2] - 1))
    directions[:, 2] *= -1.0
    nrrd.write(str(tmp_path / "x.nrrd"), mask[::-1].T.astype(np.uint8) * 3, {
        "space": "right-anterior-superior", "space directions": directions.T,
        "space origin": origin,
    })  # fmt: skip
    one = read_structures(tmp_path / "x.nrrd", volume).structures[0]
    assert one.name == "label 3"
    assert np.array_equal(one.full(volume.hu.shape), mask)


@pytest.mark.parametrize("form", ["sform", "qform"])
def test_nifti_labels_are_placed_by_their_form(volume, tmp_path, form):
    structures = two(volume)
    values = np.zeros(volume.hu.shape, np.int16)
    for label, one in enumerate(structures, start=1):
        values[one.full(volume.hu.shape)] = label
    image = nibabel.Nifti1Image(values.T, None)
    affine = np.diag([-1.0, -1.0, 1.0, 1.0]) @ volume.affine_mm
    getattr(image, f"set_{form}")(affine, code=1)
    nibabel.save(image, tmp_path / "organs.nii.gz")
    back = read_structures(tmp_path / "organs.nii.gz", volume)
    assert [s.name for s in back] == ["organs 1", "organs 2"]
    second = back.find("organs 2")
    assert np.array_equal(second.mask, structures.find("lesion").mask)
    assert second.corner == structures.find("lesion").corner


def test_nifti_without_a_place_or_with_fractions_is_refused(volume, tmp_path):
    image = nibabel.Nifti1Image(np.ones((4, 4, 4), np.uint8), None)
    nibabel.save(image, tmp_path / "a.nii")
    with pytest.raises(StructureFileError, match="where it lies"):
        read_structures(tmp_path / "a.nii", volume)
    image = nibabel.Nifti1Image(np.full((4, 4, 4), 0.5, np.float32), np.eye(4))
    nibabel.save(image, tmp_path / "b.nii")
    with pytest.raises(StructureFileError, match="fractions"):
        read_structures(tmp_path / "b.nii", volume)


# --- RTSTRUCT ----------------------------------------------------------------------------------
def rtstruct(path: Path, volume: Volume, regions: dict, frame: str | None = None, **more) -> Path:
    """Write contours given as voxels (i, j) by slice k."""
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = RTSTRUCT, "2.25.9"
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    file.SOPClassUID, file.SOPInstanceUID, file.Modality = RTSTRUCT, "2.25.9", "RTSTRUCT"
    file.StructureSetROISequence, file.ROIContourSequence = [], []
    for number, (name, lines) in enumerate(regions.items(), start=1):
        roi = Dataset()
        roi.ROINumber, roi.ROIName = number, name
        roi.ReferencedFrameOfReferenceUID = frame or volume.series.frame_of_reference
        file.StructureSetROISequence.append(roi)
        item = Dataset()
        item.ReferencedROINumber, item.ROIDisplayColor = number, [10, 200, 30]
        item.ContourSequence = []
        for k, line in lines:
            contour = Dataset()
            contour.ContourGeometricType = more.get("kind", "CLOSED_PLANAR")
            points = volume.lps_mm(np.column_stack([line, np.full(len(line), float(k))]))
            contour.NumberOfContourPoints = len(points)
            contour.ContourData = [f"{v:.10g}"[:16] for v in points.ravel()]
            item.ContourSequence.append(contour)
        file.ROIContourSequence.append(item)
    file.save_as(path, enforce_file_format=True)
    return path


def square(low, high):
    return np.array([[low, low], [high, low], [high, high], [low, high]], float)


def test_contours_with_a_hole_and_with_a_keyhole_give_the_same_voxels(volume, tmp_path):
    outer, inner = square(4.5, 20.5), square(8.5, 12.5)
    keyhole = np.vstack([outer, outer[:1], inner[::-1], inner[-1:]])
    path = rtstruct(tmp_path / "rt.dcm", volume, {
        "hole": [(k, line) for k in range(3, 8) for line in (outer, inner)],
        "keyhole": [(k, keyhole) for k in range(3, 8)],
    })  # fmt: skip
    back = read_structures(path, volume)
    expected = np.zeros(volume.hu.shape, bool)
    expected[3:8, 5:21, 5:21] = True
    expected[3:8, 9:13, 9:13] = False
    assert np.array_equal(back.find("hole").full(volume.hu.shape), expected)
    assert np.array_equal(back.find("keyhole").full(volume.hu.shape), expected)
    assert back.find("hole").colour == (10, 200, 30)


def test_contours_on_every_second_slice_fill_those_between_but_no_gap(volume, tmp_path):
    line = square(4.5, 10.5)
    path = rtstruct(tmp_path / "rt.dcm", volume, {"x": [(k, line) for k in (1, 3, 5, 9, 11)]})
    filled = read_structures(path, volume).find("x").full(volume.hu.shape)[:, 7, 7]
    assert filled.tolist() == [True] * 6 + [False] * 2 + [True] * 4


def test_oblique_contours_are_placed_by_their_points(volume, tmp_path):
    # a box whose contours run along j and k, on planes of constant i
    lines = []
    for i in range(10, 21):
        corners = [[i, 5.5, 2.5], [i, 20.5, 2.5], [i, 20.5, 8.5], [i, 5.5, 8.5]]
        lines.append(volume.lps_mm(np.array(corners)))
    path = rtstruct(tmp_path / "rt.dcm", volume, {"x": []})
    file = dcmread(path)
    for line in lines:
        contour = Dataset()
        contour.ContourGeometricType = "CLOSED_PLANAR"
        contour.ContourData = [f"{v:.10g}"[:16] for v in line.ravel()]
        file.ROIContourSequence[0].ContourSequence.append(contour)
    file.save_as(path)
    one = read_structures(path, volume).find("x")
    expected = np.zeros(volume.hu.shape, bool)
    expected[3:9, 6:21, 10:21] = True
    found = one.full(volume.hu.shape)
    assert (found ^ expected).sum() < 0.12 * expected.sum()
    assert np.allclose(one.centre_mm, Structure.of("y", expected, volume).centre_mm, atol=0.5)


def test_a_damaged_structure_set_is_refused_by_name(volume, tmp_path):
    line = square(4.5, 10.5)
    path = rtstruct(tmp_path / "rt.dcm", volume, {"x": [(2, line)]}, kind="POINT")
    with pytest.raises(StructureFileError, match="no closed contour"):
        read_structures(path, volume)
    path = rtstruct(tmp_path / "rt.dcm", volume, {"x": [(2, line[:2])]})
    with pytest.raises(StructureFileError, match="of 2 points"):
        read_structures(path, volume)
    path = rtstruct(tmp_path / "rt.dcm", volume, {"x": [(2, line)]}, frame="2.25.4711")
    with pytest.raises(FrameOfReferenceError, match="another frame"):
        read_structures(path, volume)
    path = rtstruct(tmp_path / "rt.dcm", volume, {"x": [(2, line * [[1, 0]])]})
    with pytest.raises(StructureFileError, match="enclose no area"):
        read_structures(path, volume)
    file = dcmread(rtstruct(tmp_path / "rt.dcm", volume, {"x": [(2, line)]}))
    del file.StructureSetROISequence
    file.save_as(path)
    with pytest.raises(StructureFileError, match="no whole RT Structure Set"):
        read_structures(path, volume)
    bent = np.array(line)
    file = dcmread(rtstruct(tmp_path / "rt.dcm", volume, {"x": [(2, bent)]}))
    data = list(file.ROIContourSequence[0].ContourSequence[0].ContourData)
    data[2] = float(data[2]) + 9.0
    file.ROIContourSequence[0].ContourSequence[0].ContourData = data
    file.save_as(path)
    with pytest.raises(StructureFileError, match="not flat"):
        read_structures(path, volume)


def test_the_structure_set_that_comes_with_pydicom_is_read_or_refused_by_name(volume):
    with pytest.raises(StructureError):
        read_structures(Path(get_testdata_file("rtstruct.dcm")), volume)


# --- SEG of others ------------------------------------------------------------------------------
def liver_volume(path: Path) -> Volume:
    """A CT on which the liver of pydicom's data was drawn: its frames' own geometry."""
    import highdicom

    seg = highdicom.seg.segread(path)
    found = seg.get_volume()
    affine = np.array(found.affine)[:, [2, 1, 0, 3]]
    frame = str(seg.FrameOfReferenceUID)
    shape = found.array.shape[:3]
    if shape[0] == 1:
        shape = (3, *shape[1:])
    series = Series("2.25.5", "CT", "", shape[::-1], None, None, None, True, "", (), "", frame, ())
    return Volume(np.zeros(shape, np.int16), affine, series)


@pytest.mark.parametrize("name", ["liver.dcm", "liver_1frame.dcm"])
def test_a_segmentation_of_somebody_else_lies_on_its_frames(name):
    path = Path(get_testdata_file(name))
    ct = liver_volume(path)
    structures = read_structures(path, ct)
    file = dcmread(path)
    one = structures.structures[0]
    assert int(one.mask.sum()) == int(file.pixel_array.sum())
    frame = file.PerFrameFunctionalGroupsSequence[0]
    position = np.array(frame.PlanePositionSequence[0].ImagePositionPatient, float)
    picture = np.atleast_3d(file.pixel_array)
    first = file.pixel_array[0] if file.pixel_array.ndim == 3 else picture[..., 0]
    row, column = np.argwhere(first)[0]
    shared = file.SharedFunctionalGroupsSequence[0]
    orientation = np.array(shared.PlaneOrientationSequence[0].ImageOrientationPatient, float)
    spacing = np.array(shared.PixelMeasuresSequence[0].PixelSpacing, float)
    at = position + column * spacing[1] * orientation[:3] + row * spacing[0] * orientation[3:]
    assert one.holds(at[None]).all()
    off = np.argwhere(~first.astype(bool))[0]
    away = position + off[1] * spacing[1] * orientation[:3] + off[0] * spacing[0] * orientation[3:]
    assert not one.holds(away[None]).any()


def test_a_big_endian_segmentation_is_refused_by_name(volume):
    with pytest.raises(StructureFileError, match="little endian"):
        read_structures(Path(get_testdata_file("liver_expb.dcm")), volume)


# --- bad input -----------------------------------------------------------------------------------
def test_what_is_no_file_of_structures_is_refused_by_name(volume, tmp_path):
    (tmp_path / "a.txt").write_text("not a structure")
    (tmp_path / "empty").write_bytes(b"")
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(StructureFileError, match="not a regular file"):
        read_structures(tmp_path / "pipe", volume)
    for name in ("a.txt", "empty"):
        with pytest.raises(StructureFileError, match="SEG, RTSTRUCT"):
            read_structures(tmp_path / name, volume)
    with pytest.raises(StructureFileError, match="cannot be read"):
        read_structures(tmp_path / "absent", volume)
    with pytest.raises(StructureFileError, match="modality CT"):
        read_structures(next((tmp_path / "ct").iterdir()), volume)


@pytest.mark.parametrize("name", ["x.seg.nrrd", "x.dcm", "rt.dcm", "x.nii"])
def test_a_file_cut_or_changed_anywhere_gives_structures_or_a_named_error(volume, tmp_path, name):
    path = tmp_path / name
    if name == "rt.dcm":
        rtstruct(path, volume, {"x": [(k, square(4.5, 10.5)) for k in range(3)]})
    elif name == "x.nii":
        values = two(volume).find("aorta").full(volume.hu.shape).astype(np.uint8)
        affine = np.diag([-1.0, -1.0, 1.0, 1.0]) @ volume.affine_mm
        nibabel.save(nibabel.Nifti1Image(values.T, affine), path)
    else:
        write_structures(path, two(volume), volume)
    whole = path.read_bytes()
    rng = np.random.default_rng(5)
    refused = 0
    for trial in range(30):
        raw = bytearray(whole)
        if trial % 2:
            raw = raw[: int(rng.integers(1, len(whole)))]
        else:
            for at in rng.integers(0, min(len(raw), 3000), 3):
                raw[at] = int(rng.integers(256))
        (tmp_path / "bad").write_bytes(raw)
        try:
            read_structures(tmp_path / "bad", volume)
        except StructureError:
            refused += 1
    assert refused > 5


def test_without_the_extra_its_name_is_told(volume, tmp_path, monkeypatch):
    write_structures(tmp_path / "x.seg.nrrd", two(volume), volume)
    monkeypatch.setitem(__import__("sys").modules, "nrrd", None)
    with pytest.raises(ExtraMissingError, match="make extra NAME=structures"):
        read_nrrd(tmp_path / "x.seg.nrrd")


@pytest.mark.long("journey")
def test_a_file_of_structures_is_read_in_the_worker_and_loads_nothing_here(volume, tmp_path):
    write_structures(tmp_path / "x.seg.nrrd", two(volume), volume)
    program = (
        "import sys, numpy as np; from pathlib import Path; from app.imaging.series import Series;"
        "from app.imaging.structures.files import read_structures;"
        "from app.imaging.volume import Volume; "
        "affine = np.array(eval(sys.argv[2]), float); size = eval(sys.argv[3]);"
        "series = Series('', 'CT', '', size, None, None, None, True, '', (), '', '', ());"
        "found = read_structures(Path(sys.argv[1]),"
        " Volume(np.zeros(size[::-1], np.int16), affine, series));"
        "print(len(found), [n for n in ('nrrd', 'pydicom', 'highdicom') if n in sys.modules])"
    )
    root = Path(__file__).resolve().parents[2]
    arguments = [tmp_path / "x.seg.nrrd", volume.affine_mm.tolist(), volume.size]
    done = subprocess.run(
        [sys.executable, "-c", program, *map(str, arguments)],
        capture_output=True, cwd=root, text=True,
    )  # fmt: skip
    assert done.stdout.strip() == "2 []", done.stderr
