"""DICOM SEG as others write it: every frame where it says itself, whatever else the file says."""

from pathlib import Path

import numpy as np
import pytest
from dicom_factory import Slices, oblique
from pydicom import dcmread
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.uid import ExplicitVRLittleEndian, RLELossless

from app.core import paths
from app.core.progress import Progress
from app.imaging.library import CtLibrary
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from app.imaging.structures.errors import (
    FrameOfReferenceError,
    StructureError,
    StructureFileError,
)
from app.imaging.structures.files import read_structures, write_structures
from app.imaging.structures.parsing import parse_structures
from app.imaging.structures.structure import PlacedStructures, Structure, StructureSet
from app.imaging.volume import Volume

SEG, LABELS = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.66.7"
PATIENT = {"PatientBirthDate": "", "PatientSex": "", "StudyDate": "", "StudyTime": "",
           "AccessionNumber": "", "StudyID": "", "ReferringPhysicianName": "",
           "Manufacturer": "x"}  # fmt: skip
SHAPE = (24, 30)


def ct(folder: Path, shear: float = 0.0, angle: float = 0.0, step: float = 2.0) -> Volume:
    orientation = oblique(angle) if angle else (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    offsets = tuple(step * k for k in range(12))
    Slices(orientation, offsets=offsets, shape=SHAPE, shear=shear, tags=PATIENT).write(folder)
    return load_ct(folder)


@pytest.fixture
def volume(tmp_path: Path) -> Volume:
    return ct(tmp_path / "ct")


def blob(volume: Volume, slices=(3, 4, 5, 6, 7)) -> np.ndarray:
    """Some voxels, another pattern on every slice."""
    mask = np.zeros(volume.hu.shape, bool)
    for k in slices:
        mask[k, 4 + k % 3 : 15, 6:20] = True
        mask[k, 8, 9] = k % 2
    return mask


def seg(path: Path, volume: Volume, frames, kind="BINARY", **more) -> Path:
    """Write a file of frames (segment, position [mm], picture), with pydicom alone.

    Args:
        path: to write.
        volume: gives orientation and pixel spacing, unless `more` does.
        frames: in the order of the file.
        kind: SegmentationType.
        more: `measures` of every frame, `turn`, `segments`, `frame`, `series`.
    """
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = LABELS if kind == "LABELMAP" else SEG
    meta.MediaStorageSOPInstanceUID, meta.TransferSyntaxUID = "2.25.8", ExplicitVRLittleEndian
    file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    file.SOPClassUID, file.SOPInstanceUID = meta.MediaStorageSOPClassUID, "2.25.8"
    file.Modality, file.SegmentationType = "SEG", kind
    file.FrameOfReferenceUID = more.get("frame", volume.series.frame_of_reference)
    referenced = Dataset()
    referenced.SeriesInstanceUID = more.get("series", volume.series.uid)
    file.ReferencedSeriesSequence = [referenced]
    file.Rows, file.Columns = frames[0][2].shape
    file.NumberOfFrames, file.SamplesPerPixel = len(frames), 1
    file.PhotometricInterpretation, file.PixelRepresentation = "MONOCHROME2", 0
    bits = 1 if kind == "BINARY" else 8
    file.BitsAllocated, file.BitsStored, file.HighBit = bits, bits, bits - 1
    if kind == "FRACTIONAL":
        file.SegmentationFractionalType = "PROBABILITY"
        file.MaximumFractionalValue = more.get("most", 255)
    file.SegmentSequence = []
    for number, name in more.get("segments", {1: "A"}).items():
        item = Dataset()
        item.SegmentNumber, item.SegmentLabel = number, name
        file.SegmentSequence.append(item)
    shared = Dataset()
    turn = Dataset()
    i, j = volume.affine_mm[:3, 0], volume.affine_mm[:3, 1]
    cosines = [*(i / np.linalg.norm(i)), *(j / np.linalg.norm(j))]
    turn.ImageOrientationPatient = [round(v, 10) for v in more.get("turn", cosines)]
    shared.PlaneOrientationSequence = [turn]
    measures = Dataset()
    measures.PixelSpacing = [np.linalg.norm(j), np.linalg.norm(i)]
    for keyword, value in more.get("measures", {"SliceThickness": 2.0}).items():
        setattr(measures, keyword, value)
    shared.PixelMeasuresSequence = [measures]
    file.SharedFunctionalGroupsSequence = [shared]
    file.PerFrameFunctionalGroupsSequence = []
    for segment, position, _ in frames:
        item = Dataset()
        if position is not None:
            place = Dataset()
            place.ImagePositionPatient = [round(float(v), 9) for v in position]
            item.PlanePositionSequence = [place]
        if segment is not None:
            identity = Dataset()
            identity.ReferencedSegmentNumber = segment
            item.SegmentIdentificationSequence = [identity]
        file.PerFrameFunctionalGroupsSequence.append(item)
    pictures = np.stack([np.asarray(picture) for _, _, picture in frames])
    if bits == 1:
        raw = np.packbits(pictures.ravel().astype(bool), bitorder="little").tobytes()
    else:
        raw = pictures.astype(np.uint8).tobytes()
    file.PixelData = raw + b"\0" * (len(raw) % 2)
    file["PixelData"].VR = "OB"
    file.save_as(path, enforce_file_format=True)
    return path


def on(volume: Volume, mask: np.ndarray, slices=None, segment=1):
    """Frames of the slices of a mask."""
    numbers = np.flatnonzero(mask.any(axis=(1, 2))) if slices is None else slices
    return [(segment, volume.lps_mm([[0.0, 0.0, float(k)]])[0], mask[k]) for k in numbers]


def read(path: Path, volume: Volume) -> PlacedStructures:
    numbers = tuple(float(v) for v in volume.affine_mm.ravel())
    uids = (volume.series.uid, *(h.identity.sop_uid for h in volume.series.slices))
    frame = volume.series.frame_of_reference
    settings = paths.settings()
    return parse_structures(path, volume.size, numbers, frame, uids, settings, Progress())


def full(found: PlacedStructures, volume: Volume, name="A") -> np.ndarray:
    (one,) = [s for s in found.structures if s.name == name]
    mask = np.zeros(volume.hu.shape, bool)
    i, j, k = one.corner
    depth, height, width = one.mask.shape
    mask[k : k + depth, j : j + height, i : i + width] = one.mask
    return mask


MEASURES = [
    {"SliceThickness": 2.0},
    {"SliceThickness": 2.0, "SpacingBetweenSlices": 2.0},
    {"SliceThickness": 2.0, "SpacingBetweenSlices": 0.0},
    {"SliceThickness": 2.0, "SpacingBetweenSlices": -2.0},
    {"SliceThickness": 2.0, "SpacingBetweenSlices": 5.0},
    {"SliceThickness": 2.0, "SpacingBetweenSlices": 0.7},
    {"SpacingBetweenSlices": 100.0},
    {"SliceThickness": 0.0},
    {},
]


@pytest.mark.parametrize("slices", [(3, 4, 5, 6, 7), (2, 9), (5,), (1, 2, 6, 7, 11), (3, 5, 7, 9)])
@pytest.mark.parametrize("measures", MEASURES)
@pytest.mark.parametrize(("shear", "angle"), [(0.0, 0.0), (0.3, 0.0), (0.0, 25.0), (-0.4, 15.0)])
def test_frames_on_slices_are_these_slices_whatever_the_spacing_says(
    tmp_path, slices, measures, shear, angle
):
    volume = ct(tmp_path / "ct", shear, angle)
    mask = blob(volume, slices)
    frames = on(volume, mask)
    np.random.default_rng(1).shuffle(frames)
    path = seg(tmp_path / "x.dcm", volume, frames, measures=measures)
    found = read(path, volume)
    assert np.array_equal(full(found, volume), mask)


def test_a_spacing_that_contradicts_the_frames_is_told(tmp_path, volume):
    frames = on(volume, blob(volume))
    path = seg(tmp_path / "x.dcm", volume, frames, measures={"SpacingBetweenSlices": 5.0})
    assert any("SpacingBetweenSlices (5 mm)" in note for note in read(path, volume).notes)
    path = seg(tmp_path / "x.dcm", volume, frames, measures={"SpacingBetweenSlices": 2.0})
    assert read(path, volume).notes == ()


@pytest.mark.long("statistics")
@pytest.mark.parametrize(("shear", "angle"), [(0.25, 0.0), (0.3, 20.0), (-0.5, 0.0)])
def test_what_is_written_for_a_tilted_ct_comes_back(tmp_path, shear, angle):
    volume = ct(tmp_path / "ct", shear, angle)
    mask, other = blob(volume), blob(volume, (1, 9))
    structures = StructureSet((Structure.of("A", mask, volume), Structure.of("B", other, volume)))
    write_structures(tmp_path / "x.dcm", structures, volume)
    found = read_structures(tmp_path / "x.dcm", volume)
    for one, expected in zip(found, (mask, other), strict=True):
        assert np.array_equal(one.full(volume.hu.shape), expected)


def test_overlapping_segments_and_several_frames_at_one_place_are_each_taken(tmp_path, volume):
    mask, other = blob(volume), blob(volume, (5, 6, 7, 8))
    halves = mask.copy(), mask.copy()
    halves[0][:, :10], halves[1][:, 10:] = False, False
    frames = on(volume, halves[0]) + on(volume, other, segment=7) + on(volume, halves[1])
    path = seg(tmp_path / "x.dcm", volume, frames, segments={1: "A", 7: "B"})
    found = read(path, volume)
    assert np.array_equal(full(found, volume), mask)
    assert np.array_equal(full(found, volume, "B"), other)


@pytest.mark.parametrize("most", [255, 200, 100])
def test_a_voxel_of_a_fractional_segment_counts_from_one_half(tmp_path, volume, most):
    rng = np.random.default_rng(3)
    values = np.where(blob(volume), rng.integers(1, most + 1, volume.hu.shape), 0)
    frames = on(volume, values)
    path = seg(tmp_path / "x.dcm", volume, frames, "FRACTIONAL", most=most)
    found = read(path, volume)
    assert np.array_equal(full(found, volume), values >= most / 2)


@pytest.mark.parametrize("syntax", [ExplicitVRLittleEndian, RLELossless])
def test_a_label_map_gives_each_label_and_names_those_that_it_does_not_describe(
    tmp_path, volume, syntax
):
    labels = np.where(blob(volume), 3, 0)
    labels[4:6, 10:14, 8:12] = 9
    labels[5, 2, 2] = 200
    path = seg(tmp_path / "x.dcm", volume, on(volume, labels, segment=None), "LABELMAP",
               segments={0: "Background", 3: "A", 9: "B"})  # fmt: skip
    if syntax != ExplicitVRLittleEndian:
        dataset = dcmread(path)
        dataset.compress(syntax, generate_instance_uid=False)
        dataset.save_as(path)
    found = read(path, volume)
    assert np.array_equal(full(found, volume), labels == 3)
    assert np.array_equal(full(found, volume, "B"), labels == 9)
    (note,) = found.notes
    assert "200" in note
    assert "does not describe" in note


def test_bad_frames_are_named_and_the_good_ones_kept(tmp_path, volume):
    mask = blob(volume)
    frames = on(volume, mask)
    frames += [(1, None, mask[3]), (5, frames[0][1], mask[3]), (1, [np.nan, 0, 0], mask[3])]
    path = seg(tmp_path / "x.dcm", volume, frames[:-1])
    dataset = dcmread(path)
    dataset.NumberOfFrames = 9  # of which the last two have neither place nor pixels
    dataset.save_as(path)
    found = read(path, volume)
    assert np.array_equal(full(found, volume), mask)
    said = "\n".join(found.notes)
    assert "3 frames without a place left out" in said
    assert "segment 5" in said


def test_a_file_whose_pixels_are_cut_short_gives_the_frames_that_are_whole(tmp_path, volume):
    mask = blob(volume, (2, 3, 4, 5))
    path = seg(tmp_path / "x.dcm", volume, on(volume, mask))
    dataset = dcmread(path)
    dataset.PixelData = dataset.PixelData[: 2 * (3 * SHAPE[0] * SHAPE[1] // 16)]
    dataset.save_as(path)
    found = read(path, volume)
    mask[5] = False
    assert np.array_equal(full(found, volume), mask)
    assert any("1 frame without pixels that can be read" in note for note in found.notes)
    del dataset.PixelData
    dataset.save_as(path)
    with pytest.raises(StructureFileError, match="holds no pixels"):
        read(path, volume)


def ball(volume: Volume, radius: float, centre=None) -> np.ndarray:
    k, j, i = np.indices(volume.hu.shape)
    at = volume.lps_mm(np.stack([i, j, k], axis=-1).reshape(-1, 3))
    middle = volume.lps_mm((np.array([volume.size]) - 1) / 2.0)[0] if centre is None else centre
    return (np.linalg.norm(at - middle, axis=1) <= radius).reshape(volume.hu.shape)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("step", [0.5, 1.0, 3.0, 4.0])
@pytest.mark.parametrize("off", [0.0, 0.5, 0.37])
@pytest.mark.parametrize("measures", [{"SliceThickness": 9.0}, {"SpacingBetweenSlices": 0.0}])
def test_frames_of_another_series_keep_place_and_volume(tmp_path, step, off, measures):
    volume = ct(tmp_path / "ct")
    other = ct(tmp_path / "other", step=step)
    middle = volume.lps_mm((np.array([volume.size]) - 1) / 2.0)[0]
    heights = np.arange(-12.0 + off * step, 12.0, step)
    frames = []
    row, column = np.indices(SHAPE)
    plane = volume.affine_mm[:3, 0] * column[..., None] + volume.affine_mm[:3, 1] * row[..., None]
    radius = 5.0
    for height in heights:
        position = volume.origin_mm.copy()
        position[2] = middle[2] + height
        inside = np.linalg.norm(plane + position - middle, axis=2) <= radius
        if inside.any():
            frames.append((1, position, inside))
    if len(frames) == 2:  # one distance alone does not tell how thick a frame is
        measures = measures | {"SliceThickness": step}
    path = seg(tmp_path / "x.dcm", volume, frames[::-1], series=other.series.uid, measures=measures)
    mask = full(read(path, volume), volume)
    assert mask.sum() == pytest.approx(sum(f[2].sum() for f in frames) * step / 2.0, rel=0.12)
    if step < 2.0:
        truth = ball(volume, radius)
        assert (mask ^ truth).sum() <= 0.16 * truth.sum()
    else:  # every slice is like the nearest frame, or one of two that are as near
        places = np.array([position[2] for _, position, _ in frames])
        for k, z in enumerate(volume.origin_mm[2] + 2.0 * np.arange(volume.size[2])):
            away = np.abs(places - z)
            near = [frames[n][2] for n in np.flatnonzero(away <= away.min() + 1e-6)]
            if away.min() < step / 2.0 - 1e-6:
                assert any(np.array_equal(mask[k], picture) for picture in near)
            elif away.min() > step / 2.0 + 1e-6:
                assert not mask[k].any()


def test_a_frame_missing_in_a_stack_of_another_series_leaves_its_slice_empty(tmp_path, volume):
    picture = np.zeros(SHAPE, bool)
    picture[5:15, 5:15] = True
    heights = [0.5, 1.5, 2.5, 4.5, 5.5]
    frames = [(1, volume.lps_mm([[0.0, 0.0, h]])[0], picture) for h in heights]
    path = seg(tmp_path / "x.dcm", volume, frames, series="2.25.77", measures={})
    filled = full(read(path, volume), volume)[:, 10, 10]
    assert filled.sum() == 5
    assert filled[1:3].all()
    assert not filled[7:].any()


def test_frames_of_another_turn_and_pixel_spacing_lie_where_they_say(tmp_path, volume):
    """A ball drawn on sagittal frames of 0.4 mm pixels, 1 mm apart."""
    middle = volume.lps_mm((np.array([volume.size]) - 1) / 2.0)[0]
    row, column = np.indices((60, 60))
    frames = []
    for x in np.arange(-6.0, 6.5, 1.0):
        position = middle + [x, -12.0, 12.0]
        at = position + 0.4 * (
            column[..., None] * np.array([0.0, 1.0, 0.0]) + row[..., None] * np.array([0, 0, -1.0])
        )
        frames.append((1, position, np.linalg.norm(at - middle, axis=2) <= 5.0))
    measures = {"PixelSpacing": [0.4, 0.4], "SliceThickness": 1.0}
    path = seg(tmp_path / "x.dcm", volume, frames, turn=[0, 1, 0, 0, 0, -1], measures=measures)
    mask = full(read(path, volume), volume)
    truth = ball(volume, 5.0)
    assert (mask ^ truth).sum() <= 0.15 * truth.sum()
    assert mask.sum() == pytest.approx(truth.sum(), rel=0.08)


def test_frames_that_lie_on_no_straight_line_are_each_put_where_they_say(tmp_path, volume):
    mask = blob(volume, (3, 4, 5, 6))
    frames = []
    for number, (segment, position, picture) in enumerate(on(volume, mask)):
        shift = np.array([0.21, -0.33, 0.0]) * (number % 2)
        frames.append((segment, position + shift, picture))
    path = seg(tmp_path / "x.dcm", volume, frames)
    found = full(read(path, volume), volume)
    assert np.array_equal(found.any(axis=(1, 2)), mask.any(axis=(1, 2)))
    assert (found ^ mask).sum() <= 0.1 * mask.sum()


def test_another_frame_of_reference_is_taken_only_where_the_file_names_this_very_series(
    tmp_path, volume
):
    mask = blob(volume)
    path = seg(tmp_path / "x.dcm", volume, on(volume, mask), frame="2.25.4711")
    found = read(path, volume)
    assert np.array_equal(full(found, volume), mask)
    assert any("very series" in note and "check" in note for note in found.notes)
    path = seg(tmp_path / "x.dcm", volume, on(volume, mask), frame="2.25.4711", series="2.25.5")
    with pytest.raises(FrameOfReferenceError, match="does not name this series"):
        read(path, volume)


def test_a_file_without_any_place_is_refused_by_name(tmp_path, volume):
    mask = blob(volume)
    path = seg(tmp_path / "x.dcm", volume, [(1, None, mask[3])])
    with pytest.raises(StructureFileError, match="no frame that says where it lies"):
        read(path, volume)
    path = seg(tmp_path / "x.dcm", volume, on(volume, mask), "PROBABLY")
    with pytest.raises(StructureFileError, match=r"no SegmentationType that is read.*LABELMAP"):
        read(path, volume)


def test_a_file_of_the_original_lies_on_the_de_identified_copy_of_its_ct(tmp_path, volume):
    mask = blob(volume)
    path = seg(tmp_path / "x.dcm", volume, on(volume, mask))
    entry = CtLibrary().import_series(scan_folder(tmp_path / "ct").series[0]).entry
    copy = load_ct(entry.folder)
    assert copy.series.frame_of_reference != volume.series.frame_of_reference
    found = read_structures(path, copy)
    assert np.array_equal(found.find("A").full(copy.hu.shape), mask)
    assert found.notes == ()


def test_empty_segments_are_called_empty_and_not_of_another_patient(tmp_path, volume):
    path = seg(tmp_path / "x.dcm", volume, on(volume, np.zeros(volume.hu.shape, bool), (3, 4)))
    with pytest.raises(StructureError, match="are empty"):
        read(path, volume)
