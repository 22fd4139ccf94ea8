"""Enhanced multi-frame files: a slice for each frame, each where its functional groups put it."""

import warnings

import numpy as np
import pydicom
import pytest
from pydicom.dataset import Dataset
from pydicom.sequence import Sequence
from pydicom.uid import RLELossless

from app.imaging.errors import SeriesAmbiguousError, SeriesUnknownError
from app.imaging.reading import load_ct, pixel_lps_mm
from app.imaging.scanning import scan_folder
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices

ENHANCED_CT = "1.2.840.10008.5.1.4.1.1.2.1"
ENHANCED_MR = "1.2.840.10008.5.1.4.1.1.4.1"


def item(**tags) -> Sequence:
    group = Dataset()
    for name, value in tags.items():
        setattr(group, name, value)
    return Sequence([group])


def write_enhanced(path, slices, kind=ENHANCED_CT, shared_too=True, times=1, **tags):
    """One file of all slices, the last first; shared groups where they are the same for all."""
    folder = path.parent / "single"
    pixels, groups = [], []
    for time in range(times):
        for k in reversed(range(len(slices.offsets))):
            single = pydicom.dcmread(
                slices.write_one(folder_made(folder) / "s", k, slices.offsets[k])
            )
            group = Dataset()
            group.PlanePositionSequence = item(ImagePositionPatient=single.ImagePositionPatient)
            group.FrameContentSequence = item(TemporalPositionIndex=time + 1)
            group.PixelValueTransformationSequence = item(
                RescaleSlope="1", RescaleIntercept=str(-1024 - k), RescaleType="HU"
            )
            groups.append(group)
            pixels.append(single.pixel_array + time)
    (folder / "s").unlink()
    shared = Dataset()
    shared.PixelMeasuresSequence = item(PixelSpacing=list(slices.spacing), SliceThickness="2")
    shared.PlaneOrientationSequence = item(
        ImageOrientationPatient=[round(v, 12) for v in slices.orientation]
    )
    shared.FrameVOILUTSequence = item(WindowWidth="300", WindowCenter="30")
    if shared_too:
        single.SharedFunctionalGroupsSequence = Sequence([shared])
    else:
        for group in groups:
            group.update(shared)
    for name in ("ImagePositionPatient", "ImageOrientationPatient", "PixelSpacing", "RescaleSlope",
                 "RescaleIntercept", "WindowWidth", "WindowCenter"):  # fmt: skip
        delattr(single, name)
    single.PerFrameFunctionalGroupsSequence = Sequence(groups)
    single.SOPClassUID = single.file_meta.MediaStorageSOPClassUID = kind
    single.Modality = "MR" if kind == ENHANCED_MR else "CT"
    single.NumberOfFrames = len(groups)
    single.PixelData = np.stack(pixels).astype("<u2").tobytes()
    for name, value in tags.items():
        setattr(single, name, value)
    single.save_as(path)
    return path


def folder_made(folder):
    folder.mkdir(exist_ok=True)
    return folder


@pytest.mark.parametrize("shared_too", [True, False])
@pytest.mark.parametrize("orientation", [factory.TRANSVERSE, factory.oblique()])
def test_every_frame_lies_where_its_groups_say_with_its_own_rescale(
    tmp_path, orientation, shared_too
):
    slices = Slices(orientation)
    write_enhanced(tmp_path / "e", slices, shared_too=shared_too)
    volume = load_ct(tmp_path)
    for k, offset in enumerate(slices.offsets):
        np.testing.assert_allclose(volume.lps_mm((0, 0, k)), slices.position(offset), atol=1e-8)
        np.testing.assert_array_equal(volume.hu[k], slices.stored(k) - 1024 - k)
    assert len(volume.series.files) == 1
    assert volume.series.windows == ((300.0, 30.0),)


def test_encapsulated_frames_are_found_in_their_file(tmp_path):
    slices = Slices()
    path = write_enhanced(tmp_path / "e", slices)
    file = pydicom.dcmread(path)
    file.compress(RLELossless)
    file.save_as(path)
    volume = load_ct(tmp_path)
    for k in range(5):
        np.testing.assert_array_equal(volume.hu[k], slices.stored(k) - 1024 - k)


def test_a_frame_whose_number_is_beyond_any_scanner_is_refused_by_name_and_value(tmp_path):
    path = write_enhanced(tmp_path / "e", Slices())
    file = pydicom.dcmread(path)
    group = file.PerFrameFunctionalGroupsSequence[2]
    group.PixelValueTransformationSequence[0].RescaleSlope = "1e308"
    file.save_as(path)
    (series,) = scan_folder(tmp_path / "e").series
    assert not series.usable
    assert "RescaleSlope is 1e+308; its size must lie between 1e-09 and 1e+06" in series.reason


def test_a_pixel_of_a_frame_is_found_by_its_number(tmp_path):
    slices = Slices()
    write_enhanced(tmp_path / "e", slices)
    uid = scan_folder(tmp_path).series[0].slices[0].identity.sop_uid
    lps_mm, hu = pixel_lps_mm(tmp_path, uid, 3, 2, frame=1)  # written from the last slice
    np.testing.assert_allclose(lps_mm, slices.position(6.0) + (1.5, 1.6, 0.0))
    assert hu == slices.stored(3)[2, 3] - 1024 - 3
    with pytest.raises(SeriesUnknownError, match="frame 6"):
        pixel_lps_mm(tmp_path, uid, 3, 2, frame=5)


def test_times_in_one_file_are_passes(tmp_path):
    write_enhanced(tmp_path / "e", Slices(), times=2)
    series = scan_folder(tmp_path).series
    assert [s.part for s in series] == ["time-position-1", "time-position-2"]
    with pytest.raises(SeriesAmbiguousError, match="2 usable"):
        load_ct(tmp_path)
    later = load_ct(tmp_path, series[1].key)
    np.testing.assert_array_equal(later.hu, load_ct(tmp_path, series[0].key).hu + 1)


def test_enhanced_mr_is_usable_for_practice_without_a_unit(tmp_path):
    write_enhanced(tmp_path / "e", Slices(), kind=ENHANCED_MR)
    volume = load_ct(tmp_path)
    assert volume.unit == ""
    assert any("practice" in note for note in volume.series.notes)


@pytest.mark.parametrize(
    ("tags", "words"),
    [
        ({"NumberOfFrames": 4}, "NumberOfFrames is 4, and 5 frames are described"),
        ({"PerFrameFunctionalGroupsSequence": Sequence([])}, "0 frames are described"),
        ({"SharedFunctionalGroupsSequence": Sequence([])}, "PixelSpacing missing"),
        ({"ImageType": ["DERIVED", "PRIMARY", "PERFUSION", "RCBV"]}, "perfusion map (RCBV)"),
        ({"PixelData": bytes(100)}, "bytes of pixels"),
    ],
)
def test_what_is_wrong_with_a_multi_frame_file_is_said(tmp_path, tags, words):
    write_enhanced(tmp_path / "e", Slices(), **tags)
    (series,) = scan_folder(tmp_path).series
    assert not series.usable
    assert words in series.reason


def test_a_legacy_converted_enhanced_ct_equals_its_single_files(tmp_path):
    slices = Slices(factory.oblique(), tags={"PatientBirthDate": "", "PatientSex": "O",
        "StudyDate": "", "StudyTime": "", "AccessionNumber": "", "StudyID": "",
        "ReferringPhysicianName": "", "Manufacturer": "M", "PatientPosition": "HFS",
        "PositionReferenceIndicator": "", "AcquisitionNumber": 1, "KVP": "120"})  # fmt: skip
    paths = slices.write(tmp_path / "single")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from highdicom.legacy import LegacyConvertedEnhancedCTImage

        converted = LegacyConvertedEnhancedCTImage(
            [pydicom.dcmread(path) for path in paths], "2.25.5", 1, "2.25.6", 1
        )
        (tmp_path / "legacy").mkdir()
        converted.save_as(tmp_path / "legacy" / "one")
    whole, single = load_ct(tmp_path / "legacy"), load_ct(tmp_path / "single")
    np.testing.assert_array_equal(whole.hu, single.hu)
    np.testing.assert_allclose(whole.affine_mm, single.affine_mm, atol=1e-9)


def _each(**macros):
    """Give every other frame one of two values of its functional groups."""

    def change(file):
        for n, group in enumerate(file.PerFrameFunctionalGroupsSequence):
            for macro, (name, values) in macros.items():
                held = group[macro].value[0] if macro in group else Dataset()
                setattr(held, name, values[n % 2])
                setattr(group, macro, Sequence([held]))

    return change


def _written(tmp_path, change, count=8):
    slices = Slices(offsets=tuple(2.0 * k for k in range(count)))
    path = write_enhanced(tmp_path / "e", slices)
    file = pydicom.dcmread(path)
    change(file)
    file.save_as(path)
    return slices


@pytest.mark.parametrize(
    "macros",
    [
        {"CTReconstructionSequence": ("ConvolutionKernel", ("B30f", "B70f"))},
        {"FrameContentSequence": ("StackID", ("1", "2"))},
        {"FrameContentSequence": ("FrameAcquisitionNumber", (1, 2))},
    ],
)
def test_frames_of_two_passes_that_mesh_are_read_apart(tmp_path, macros):
    _written(tmp_path, _each(**macros))
    assert [(s.size[2], s.usable) for s in scan_folder(tmp_path).series] == [(4, True)] * 2


@pytest.mark.parametrize(
    ("words", "energies", "reason"),
    [
        (("EFF_ATOMIC_NUM",), True, "effective atomic number map"),
        (("MAT_SPECIFIC",), True, "map of one material"),
        ((), True, "RescaleType must say what the values are"),
        (("VMI",), True, ""),
        ((), False, ""),
    ],
)
def test_frames_without_rescale_type_are_read_only_if_they_can_be_nothing_else(
    tmp_path, words, energies, reason
):
    kind = ["DERIVED", "PRIMARY", "VOLUME", *words]

    def change(file):
        _each(CTImageFrameTypeSequence=("FrameType", (kind, kind)))(file)
        for group in file.PerFrameFunctionalGroupsSequence:
            del group.PixelValueTransformationSequence[0].RescaleType
        if energies:
            file.MultienergyCTAcquisition = "YES"

    _written(tmp_path, change)
    (series,) = scan_folder(tmp_path).series
    assert (reason in series.reason, series.usable) == (True, not reason)
