"""RT Structure Sets as others write them: the good is kept, the rest named, volumes stay."""

from pathlib import Path

import numpy as np
import pytest
from pydicom import dcmread
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.uid import ExplicitVRLittleEndian
from test_imaging_seg_frames import ball, ct, full, read

from app.imaging.structures.errors import FrameOfReferenceError, StructureFileError
from app.imaging.volume import Volume

RTSTRUCT = "1.2.840.10008.5.1.4.1.1.481.3"


@pytest.fixture
def volume(tmp_path: Path) -> Volume:
    return ct(tmp_path / "ct")


def rt(path: Path, volume: Volume, regions, **more) -> Path:
    """Write regions with pydicom: name -> lines (n, 3) in LPS [mm], or (type, numbers) pairs.

    Args:
        path: to write.
        volume: gives the UIDs, unless `more` does.
        regions: what to write.
        more: `digits` of coordinates, `frame`, `series`.
    """
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = RTSTRUCT, "2.25.9"
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    file = FileDataset(str(path), {}, file_meta=meta, preamble=b"\0" * 128)
    file.SOPClassUID, file.SOPInstanceUID, file.Modality = RTSTRUCT, "2.25.9", "RTSTRUCT"
    frame = more.get("frame", volume.series.frame_of_reference)
    referenced, study, series = Dataset(), Dataset(), Dataset()
    series.SeriesInstanceUID = more.get("series", volume.series.uid)
    study.RTReferencedSeriesSequence = [series]
    referenced.FrameOfReferenceUID, referenced.RTReferencedStudySequence = frame, [study]
    file.ReferencedFrameOfReferenceSequence = [referenced]
    file.StructureSetROISequence, file.ROIContourSequence = [], []
    for number, (name, contours) in enumerate(regions.items(), start=1):
        roi, item = Dataset(), Dataset()
        roi.ROINumber, roi.ROIName, roi.ReferencedFrameOfReferenceUID = number, name, frame
        item.ReferencedROINumber, item.ContourSequence = number, []
        for contour in contours:
            kind, numbers = contour if isinstance(contour, tuple) else ("CLOSED_PLANAR", contour)
            one = Dataset()
            one.ContourGeometricType = kind
            digits = more.get("digits", 6)
            one.ContourData = [
                v if isinstance(v, str) else f"{v:.{digits}f}" for v in np.ravel(numbers).tolist()
            ]
            item.ContourSequence.append(one)
        file.StructureSetROISequence.append(roi)
        file.ROIContourSequence.append(item)
    file.save_as(path, enforce_file_format=True)
    return path


def at(volume: Volume, k: float, points) -> np.ndarray:
    """Points (column, row) of a slice in LPS [mm]."""
    points = np.asarray(points, float)
    return volume.lps_mm(np.column_stack([points, np.full(len(points), k)]))


def square(low: float, high: float) -> np.ndarray:
    return np.array([[low, low], [high, low], [high, high], [low, high]], float)


def circle(centre, radius: float, count: int = 60) -> np.ndarray:
    turn = 2.0 * np.pi * np.arange(count) / count
    return np.asarray(centre) + radius * np.column_stack([np.cos(turn), np.sin(turn)])


def boxed(volume: Volume, slices, low=5, high=15) -> np.ndarray:
    mask = np.zeros(volume.hu.shape, bool)
    for k in slices:
        mask[k, low:high, low:high] = True
    return mask


BAD = {
    "of 2 points": lambda line: line[:2],
    "of 1 point left out": lambda line: line[:1],
    "of 0 points": lambda line: line[:0],
    "of 11 numbers": lambda line: line.ravel()[:11],
    "no places": lambda line: ["nan", *map(str, line.ravel().round(3).tolist()[1:])],
    "no places ": lambda line: ["1e300", *map(str, line.ravel().round(3).tolist()[1:])],
    "cannot be read": lambda line: ["7.77777", *map(str, line.ravel().round(3).tolist()[1:])],
    "enclose no area": lambda line: np.repeat(line[:2], 3, axis=0),
    "enclose no area ": lambda line: np.stack([line[0], line[1], line[0]]),
    "not flat": lambda line: line + np.outer([0, 0, 0, 1], [0.0, 0.0, 7.0]),
    "of type POINT": lambda line: ("POINT", line[:1]),
    "of type OPEN_PLANAR": lambda line: ("OPEN_PLANAR", line),
    "of type OPEN_NONPLANAR": lambda line: ("OPEN_NONPLANAR", line),
    "of an unknown type": lambda line: ("SQUARE", line),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("bad", BAD)
def test_a_bad_contour_is_named_and_everything_else_kept(tmp_path, volume, bad):
    lines = [at(volume, k, square(4.5, 14.5)) for k in (3, 4, 5, 6)]
    spoilt = BAD[bad](at(volume, 8, square(4.5, 14.5)))
    path = rt(tmp_path / "rt.dcm", volume, {"A": [*lines, spoilt], "B": lines[:2]})
    path.write_bytes(path.read_bytes().replace(b"7.77777", b"sesqui."))
    found = read(path, volume)
    assert np.array_equal(full(found, volume), boxed(volume, (3, 4, 5, 6)))
    assert np.array_equal(full(found, volume, "B"), boxed(volume, (3, 4)))
    (note,) = found.notes
    assert note.startswith("A: 1 contour ")
    assert bad.strip() in note


def test_bad_regions_are_named_and_the_others_kept(tmp_path, volume):
    lines = [at(volume, k, square(4.5, 14.5)) for k in (3, 4)]
    path = rt(tmp_path / "rt.dcm", volume, dict.fromkeys("ABCDEF", lines))
    file = dcmread(path)
    file.ROIContourSequence[1].ReferencedROINumber = 77
    del file.ROIContourSequence[2].ReferencedROINumber
    file.StructureSetROISequence[3].ROINumber = 1
    file.StructureSetROISequence[4].ReferencedFrameOfReferenceUID = "2.25.99"
    del file.ROIContourSequence[5].ContourSequence
    file.save_as(path)
    found = read(path, volume)
    assert [one.name for one in found.structures] == ["A"]
    said = "\n".join(found.notes)
    for words in ("1 region number 77", "without a number", "D has the number 1 of another one",
                  "another frame of reference, left out: E", "without contours: B, C"):  # fmt: skip
        assert words in said
    assert np.array_equal(full(found, volume), boxed(volume, (3, 4)))


def test_a_file_of_nothing_but_bad_contours_says_what_they_are(tmp_path, volume):
    path = rt(tmp_path / "rt.dcm", volume, {"A": [("POINT", [[1.0, 2.0, 3.0]])]})
    with pytest.raises(StructureFileError, match=r"A: 1 contour of type POINT left out"):
        read(path, volume)


AGAIN = {
    "the same": lambda line: line,
    "backwards": lambda line: line[::-1],
    "from another corner": lambda line: np.roll(line, 2, axis=0),
    "closed": lambda line: np.vstack([line, line[:1]]),
    "rounded": lambda line: np.round(line, 1),
    "with more points": lambda line: np.stack(
        [line, (line + np.roll(line, -1, axis=0)) / 2], axis=1
    ).reshape(-1, 3),
}


@pytest.mark.parametrize("way", AGAIN)
@pytest.mark.parametrize("times", [1, 2])
def test_a_contour_that_is_there_again_is_no_hole(tmp_path, volume, way, times):
    lines = [at(volume, k, square(4.5, 14.5)) for k in (3, 4, 5)]
    more = [AGAIN[way](lines[1])] * times
    found = read(rt(tmp_path / "rt.dcm", volume, {"A": lines + more}), volume)
    assert np.array_equal(full(found, volume), boxed(volume, (3, 4, 5)))
    assert f"{times} contour" in found.notes[0]


@pytest.mark.parametrize("wall", [0.4, 1.0, 3.0])
def test_a_hole_stays_a_hole_however_thin_its_wall(tmp_path, volume, wall):
    outer, inner = circle([14.2, 12.3], 9.0), circle([14.2, 12.3], 9.0 - wall)
    lines = [at(volume, 4, outer), at(volume, 4, inner), at(volume, 4, circle([14.2, 12.3], 2.0))]
    mask = full(read(rt(tmp_path / "rt.dcm", volume, {"A": lines}), volume), volume)
    row, column = np.indices(mask.shape[1:])
    away = np.hypot(column - 14.2, row - 12.3)
    expected = ((away <= 9.0) & (away > 9.0 - wall)) | (away <= 2.0)
    assert (mask[4] ^ expected).sum() <= 4
    assert not mask[4, 12, 17 if wall < 5 else 0]


def test_contours_that_cross_are_joined_and_exclusive_ones_are_not(tmp_path, volume):
    one, other = square(3.5, 12.5), square(8.5, 18.5)
    lines = [at(volume, 4, one), at(volume, 4, other)]
    found = read(rt(tmp_path / "rt.dcm", volume, {"A": lines}), volume)
    both = boxed(volume, (4,), 4, 13) | boxed(volume, (4,), 9, 19)
    assert np.array_equal(full(found, volume), both)
    assert any("cross" in note for note in found.notes)
    exclusive = [("CLOSEDPLANAR_XOR", line) for line in lines]
    found = read(rt(tmp_path / "rt.dcm", volume, {"A": exclusive}), volume)
    overlap = boxed(volume, (4,), 9, 13)
    assert np.array_equal(full(found, volume), both & ~overlap)


@pytest.mark.parametrize("count", [1, 2, 3, 6, 8])
@pytest.mark.parametrize("off", [0.0, 0.25, 0.5, 0.75])
@pytest.mark.parametrize("digits", [1, 6])
def test_planes_between_slices_keep_the_volume(tmp_path, volume, count, off, digits):
    lines = [at(volume, 1 + n + off, square(4.5, 14.5)) for n in range(count)]
    mask = full(read(rt(tmp_path / "rt.dcm", volume, {"A": lines}, digits=digits), volume), volume)
    assert mask.sum() == count * 100


@pytest.mark.parametrize("gap", [2, 3, 4])
@pytest.mark.parametrize("count", [3, 4])
def test_planes_on_every_second_or_third_slice_keep_the_volume(tmp_path, volume, gap, count):
    slices = [0.5 + gap / 2 + gap * n for n in range(count) if 0.5 + gap * (n + 1) <= 11.5]
    lines = [at(volume, k, square(4.5, 14.5)) for k in slices]
    mask = full(read(rt(tmp_path / "rt.dcm", volume, {"A": lines}), volume), volume)
    assert mask.sum() == gap * len(slices) * 100


@pytest.mark.parametrize("step", [0.5, 1.0, 2.0, 3.0, 4.0])
@pytest.mark.parametrize("off", [0.0, 0.5])
def test_a_ball_is_a_ball_from_planes_of_any_distance(tmp_path, step, off):
    volume = ct(tmp_path / "ct")
    middle = volume.lps_mm((np.array([volume.size]) - 1) / 2.0)[0]
    radius, lines = 5.6, []
    for height in np.arange(-12.0 + off * step, 12.0, step):
        if abs(height) < radius:
            ring = circle([0.0, 0.0], np.sqrt(radius**2 - height**2))
            lines.append(np.column_stack([ring, np.full(len(ring), height)]) + middle)
    mask = full(read(rt(tmp_path / "rt.dcm", volume, {"A": lines}), volume), volume)
    truth = ball(volume, radius)
    ml = 4.0 / 3.0 * np.pi * radius**3 / abs(np.linalg.det(volume.affine_mm[:3, :3]))
    assert mask.sum() == pytest.approx(ml, rel=0.15)
    assert (mask ^ truth).sum() <= (0.12 if step < 2.0 else 0.3) * truth.sum()


def test_two_lesions_far_apart_in_one_region_are_not_joined(tmp_path, volume):
    lines = [at(volume, 2, square(4.5, 14.5)), at(volume, 9, square(4.5, 14.5))]
    mask = full(read(rt(tmp_path / "rt.dcm", volume, {"A": lines}), volume), volume)
    assert np.array_equal(mask, boxed(volume, (2, 9)))
    aside = [at(volume, 2, square(1.5, 6.5)), at(volume, 5, square(12.5, 18.5))]
    mask = full(read(rt(tmp_path / "rt.dcm", volume, {"A": aside}), volume), volume)
    assert mask.any(axis=(1, 2)).tolist() == [k in (2, 5) for k in range(12)]


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize(("shear", "angle"), [(0.3, 0.0), (0.36, 20.0), (0.0, 33.0), (-0.4, 9.0)])
def test_rounding_to_a_tenth_of_a_millimetre_moves_next_to_nothing(tmp_path, seed, shear, angle):
    volume = ct(tmp_path / "ct", shear, angle)
    rng = np.random.default_rng(seed)
    centre, radius = rng.uniform(8.0, 14.0, 2), rng.uniform(2.5, 3.5)
    lines = [at(volume, k, circle(centre, radius, 11)) for k in rng.integers(1, 11, 1)]
    exact = full(read(rt(tmp_path / "a.dcm", volume, {"A": lines}), volume), volume)
    rounded = full(read(rt(tmp_path / "b.dcm", volume, {"A": lines}, digits=1), volume), volume)
    assert exact.any(axis=(1, 2)).sum() == 1
    assert (exact ^ rounded).sum() <= 3
    assert np.array_equal(exact.any(axis=(1, 2)), rounded.any(axis=(1, 2)))


def test_a_region_smaller_than_a_voxel_is_its_nearest_voxel(tmp_path, volume):
    line = at(volume, 4, circle([8.4, 9.4], 0.05))
    found = read(rt(tmp_path / "rt.dcm", volume, {"A": [line]}), volume)
    assert np.argwhere(full(found, volume)).tolist() == [[4, 9, 8]]
    assert any("smaller than a voxel" in note for note in found.notes)


def test_another_frame_of_reference_is_taken_only_where_the_file_names_this_series_or_its_images(
    tmp_path, volume
):
    lines = [at(volume, k, square(4.5, 14.5)) for k in (3, 4)]
    path = rt(tmp_path / "rt.dcm", volume, {"A": lines}, frame="2.25.4711")
    found = read(path, volume)
    assert np.array_equal(full(found, volume), boxed(volume, (3, 4)))
    assert any("very series" in note for note in found.notes)
    path = rt(tmp_path / "rt.dcm", volume, {"A": lines}, frame="2.25.4711", series="2.25.5")
    with pytest.raises(FrameOfReferenceError, match="does not name this series"):
        read(path, volume)
    file = dcmread(path)
    image = Dataset()
    image.ReferencedSOPInstanceUID = volume.series.slices[3].identity.sop_uid
    file.ROIContourSequence[0].ContourSequence[0].ContourImageSequence = [image]
    file.save_as(path)
    assert np.array_equal(full(read(path, volume), volume), boxed(volume, (3, 4)))
