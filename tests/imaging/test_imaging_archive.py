"""Files as archives hold them: mislabelled, cut, padded, without what must be there; read rightly
or refused for a reason that is true."""

import numpy as np
import pydicom
import pytest
from pydicom.uid import (
    DeflatedExplicitVRLittleEndian,
    ExplicitVRBigEndian,
    ExplicitVRLittleEndian,
    ImplicitVRLittleEndian,
    JPEG2000Lossless,
    JPEGLSLossless,
    RLELossless,
)

from app.imaging.body import body_mask
from app.imaging.errors import SeriesRefusedError
from app.imaging.library import CtLibrary
from app.imaging.reading import load_ct
from app.imaging.scanning import scan_folder
from tests.imaging import archive_series as archive
from tests.imaging.archive_series import NATIVE, Archived

LITTLE = (ImplicitVRLittleEndian, ExplicitVRLittleEndian)


def reason(folder):
    """Why the only series, or the first file, is not used."""
    listing = scan_folder(folder)
    if not listing.series:
        return listing.ignored[0].reason
    (series,) = listing.series
    assert not series.usable
    return series.reason


# --- where the pixels are


@pytest.mark.parametrize("syntax", NATIVE)
@pytest.mark.parametrize("items", [True, False])
def test_pixels_of_undefined_length_in_a_native_syntax_are_refused(tmp_path, syntax, items):
    def spoil(whole):
        inside = archive.in_items(whole) if items else archive.pixels(whole)
        return archive.with_pixels(whole, inside, -1)

    Archived(syntax=syntax).write(tmp_path, spoil)
    assert "its pixels are of undefined length, as only compressed ones may be" in reason(tmp_path)
    assert "Endian" in reason(tmp_path)


def test_pixels_of_undefined_length_in_a_deflated_file_are_refused(tmp_path):
    import zlib

    for path in Archived().write(tmp_path):
        whole = path.read_bytes()
        spoilt = archive.with_pixels(whole, archive.in_items(whole), -1)
        said = archive.relabelled(spoilt, DeflatedExplicitVRLittleEndian)
        start = (
            said.index(b"\x08\x00\x05\x00")
            if b"\x08\x00\x05\x00" in said
            else said.index(b"\x08\x00\x08\x00")
        )
        engine = zlib.compressobj(wbits=-zlib.MAX_WBITS)
        path.write_bytes(said[:start] + engine.compress(said[start:]) + engine.flush())
    assert "undefined length" in reason(tmp_path)
    assert "Deflated" in reason(tmp_path)


@pytest.mark.parametrize("syntax", NATIVE)
def test_compressed_pixels_under_a_native_label_are_refused(tmp_path, syntax):
    Archived(syntax=syntax).write(
        tmp_path, lambda whole: archive.with_pixels(whole, archive.in_items(whole))
    )
    assert "its pixels are compressed, and its transfer syntax is" in reason(tmp_path)


@pytest.mark.parametrize("syntax", LITTLE)
@pytest.mark.parametrize("said", [RLELossless, JPEGLSLossless, JPEG2000Lossless])
def test_native_pixels_under_a_compressed_label_are_refused(tmp_path, syntax, said):
    Archived(syntax=syntax).write(tmp_path, lambda whole: archive.relabelled(whole, said))
    assert "960 bytes of pixels are not compressed" in reason(tmp_path)


@pytest.mark.parametrize("said", [RLELossless, JPEGLSLossless, JPEG2000Lossless])
@pytest.mark.parametrize("written", [RLELossless, JPEGLSLossless, JPEG2000Lossless])
def test_one_compression_under_the_label_of_another_is_refused(tmp_path, written, said):
    series = Archived(shape=(40, 56))
    for path in series.write(tmp_path):
        file = pydicom.dcmread(path)
        file.compress(written, generate_instance_uid=False)
        file.save_as(path)
        path.write_bytes(archive.relabelled(path.read_bytes(), said))
    if written == said:
        np.testing.assert_array_equal(load_ct(tmp_path).hu, series.hu())
    elif written == RLELossless:
        assert "its compressed pixels are damaged (no frame header)" in reason(tmp_path)
    else:
        assert "its pixels are compressed as JPEG" in reason(tmp_path)


@pytest.mark.parametrize("shape", [(20, 24), (3, 5), (40, 56)])
@pytest.mark.parametrize(("written", "said"), [LITTLE, LITTLE[::-1]])
def test_explicit_and_implicit_taken_for_each_other_are_read_rightly(
    tmp_path, written, said, shape
):
    series = Archived(syntax=written, shape=shape)
    series.write(tmp_path, lambda whole: archive.relabelled(whole, said))
    np.testing.assert_array_equal(load_ct(tmp_path).hu, series.hu())


def test_a_mislabelled_series_is_right_in_the_library_too(tmp_path):
    series = Archived(syntax=ExplicitVRLittleEndian)
    series.write(tmp_path / "in", lambda w: archive.relabelled(w, ImplicitVRLittleEndian))
    library = CtLibrary(tmp_path / "library")
    entry = library.import_series(scan_folder(tmp_path / "in").series[0]).entry
    np.testing.assert_array_equal(load_ct(entry.folder).hu, series.hu())


@pytest.mark.parametrize(
    ("written", "said"),
    [
        (ExplicitVRBigEndian, ExplicitVRLittleEndian),
        (ExplicitVRBigEndian, ImplicitVRLittleEndian),
        (ExplicitVRBigEndian, RLELossless),
        (ExplicitVRLittleEndian, ExplicitVRBigEndian),
        (ImplicitVRLittleEndian, ExplicitVRBigEndian),
    ],
)
def test_the_other_byte_order_than_the_label_says_is_named(tmp_path, written, said):
    Archived(syntax=written).write(tmp_path, lambda whole: archive.relabelled(whole, said))
    little = said != ExplicitVRBigEndian
    words = ("little", "big") if little else ("big", "little")
    assert f"says {words[0]} endian, and its header is {words[1]} endian" in reason(tmp_path)


@pytest.mark.parametrize("syntax", NATIVE)
def test_what_is_not_deflated_as_its_label_says_is_named(tmp_path, syntax):
    Archived(syntax=syntax).write(
        tmp_path, lambda w: archive.relabelled(w, DeflatedExplicitVRLittleEndian)
    )
    assert "is not deflated as its transfer syntax says" in reason(tmp_path)


@pytest.mark.parametrize("name", [b"OB", b"UN"])
@pytest.mark.parametrize("syntax", NATIVE)
def test_the_representation_of_the_pixel_element_does_not_shift_the_pixels(tmp_path, syntax, name):
    series = Archived(syntax=syntax)
    tag = archive.PIXELS_BE if syntax == ExplicitVRBigEndian else archive.PIXELS_LE
    series.write(tmp_path, lambda whole: whole.replace(tag + b"OW", tag + name))
    np.testing.assert_array_equal(load_ct(tmp_path).hu, series.hu())


@pytest.mark.parametrize("syntax", NATIVE)
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda pixels: pixels[:-2], "958 bytes of pixels where 960 are needed"),
        (lambda pixels: b"", "0 bytes of pixels where 960 are needed"),
        (lambda pixels: 2 * pixels, "2 times as many: NumberOfFrames or BitsAllocated"),
        (lambda pixels: 3 * pixels, "3 times as many"),
        (lambda pixels: pixels + b"a", ""),
        (lambda pixels: pixels + 300 * b"a", ""),
    ],
)
def test_pixels_of_another_length_are_refused_or_what_is_behind_them_is_said(
    tmp_path, syntax, change, words
):
    series = Archived(syntax=syntax)
    series.write(tmp_path, lambda whole: archive.with_pixels(whole, change(archive.pixels(whole))))
    if words:
        assert words in reason(tmp_path)
        return
    volume = load_ct(tmp_path)
    np.testing.assert_array_equal(volume.hu, series.hu())
    assert "6 files hold bytes behind the pixels, which are left out" in volume.series.notes


def test_the_padding_byte_of_an_odd_picture_is_no_extra(tmp_path):
    series = Archived(shape=(3, 5))
    eight = {"BitsAllocated": 8, "BitsStored": 8, "HighBit": 7}
    stored = [np.arange(15, dtype="u1") + k for k in range(series.count)]
    for k, pixels in enumerate(stored):
        whole = series.encoded(k, PixelData=pixels.tobytes() + b"\0", **eight)
        (tmp_path / f"{k}").write_bytes(whole)
    volume = load_ct(tmp_path)
    assert volume.series.notes == ()
    np.testing.assert_array_equal(volume.hu.reshape(6, 15), np.stack(stored).astype(int) - 1024)


@pytest.mark.parametrize("syntax", NATIVE)
def test_a_file_cut_anywhere_is_called_truncated_and_never_something_else(tmp_path, syntax):
    series = Archived(syntax=syntax)
    paths = series.write(tmp_path)
    whole = paths[3].read_bytes()
    order = ">" if syntax == ExplicitVRBigEndian else "<"
    uid = np.array([0x0020, 0x000E], f"{order}u2").tobytes()
    begin = whole.index(uid) + 24  # before that nothing says which series it is of
    for cut in (*np.linspace(begin, len(whole) - 1, 12).astype(int), len(whole) - 2):
        paths[3].write_bytes(whole[:cut])
        found = scan_folder(tmp_path)
        assert [s.usable for s in found.series] == [False], cut
        assert found.series[0].reason.startswith("003.dcm is truncated"), found.series[0].reason
        assert found.series[0].notes == ()


def test_compressed_pixels_cut_anywhere_are_called_truncated(tmp_path):
    for path in Archived().write(tmp_path):
        file = pydicom.dcmread(path)
        file.compress(RLELossless, generate_instance_uid=False)
        file.save_as(path)
    path = tmp_path / "002.dcm"
    whole = path.read_bytes()
    for cut in (8, 20, 100, 300):
        path.write_bytes(whole[:-cut])
        assert reason(tmp_path).startswith("002.dcm is truncated")


# --- what the pixels are

TYPE_1 = ("PhotometricInterpretation", "Rows", "Columns", "BitsAllocated", "PixelRepresentation")


@pytest.mark.parametrize("syntax", NATIVE)
@pytest.mark.parametrize("name", TYPE_1)
def test_what_must_be_known_of_pixels_is_asked_for_by_name(tmp_path, name, syntax):
    Archived(syntax=syntax).write(tmp_path, **{name: None})
    assert f"{name} is missing" in reason(tmp_path)


@pytest.mark.parametrize("name", TYPE_1[1:])
def test_an_empty_attribute_of_the_pixels_is_a_missing_one(tmp_path, name):
    paths = Archived().write(tmp_path)
    for path in paths:
        file = pydicom.dcmread(path)
        file[name].value = None
        file.save_as(path)
    assert f"{name} is missing" in reason(tmp_path)


def test_one_slice_without_its_representation_is_named(tmp_path):
    series = Archived()
    paths = series.write(tmp_path)
    paths[3].write_bytes(series.encoded(3, PixelRepresentation=None))
    assert "PixelRepresentation is missing" in reason(tmp_path)
    assert "003.dcm" in reason(tmp_path)


@pytest.mark.parametrize("name", ["SamplesPerPixel", "BitsStored", "HighBit"])
def test_what_can_have_one_value_only_is_taken_as_that(tmp_path, name):
    series = Archived()
    series.write(tmp_path, **{name: None})
    np.testing.assert_array_equal(load_ct(tmp_path).hu, series.hu())


@pytest.mark.parametrize(
    ("tags", "words"),
    [
        ({"BitsStored": None, "HighBit": None}, "BitsStored and HighBit are missing"),
        ({"PixelRepresentation": 2}, "PixelRepresentation is 2; it must be 0 or 1"),
        ({"BitsStored": 17}, "contradict"),
        ({"BitsStored": 12, "HighBit": 10}, "contradict"),
        ({"BitsStored": 12, "HighBit": 15}, "HighBit must be 11"),
        ({"BitsAllocated": 8, "BitsStored": 8, "HighBit": 7}, "2 times as many"),
    ],
)
def test_bits_that_contradict_each_other_or_the_pixels_are_refused(tmp_path, tags, words):
    Archived().write(tmp_path, **tags)
    assert words in reason(tmp_path)


@pytest.mark.parametrize("syntax", NATIVE)
def test_pixels_in_the_high_bits_are_read_where_the_low_ones_are_empty(tmp_path, syntax):
    series = Archived(syntax=syntax)
    for k in range(series.count):
        shifted = ((series.hu()[k] + 1024) << 4).astype("<u2").tobytes()
        whole = series.encoded(k, BitsStored=12, HighBit=15, PixelData=shifted)
        (tmp_path / f"{k}").write_bytes(whole)
    np.testing.assert_array_equal(load_ct(tmp_path).hu, series.hu())


ORIGINAL, COMPUTED = ["ORIGINAL", "PRIMARY", "AXIAL"], ["DERIVED", "SECONDARY", "AXIAL"]
ENERGIES = {"MultienergyCTAcquisition": "YES"}


@pytest.mark.parametrize(
    ("image_type", "tags", "words"),
    [
        ([*ORIGINAL, "EFF_ATOMIC_NUM"], ENERGIES, "effective atomic number map"),
        ([*COMPUTED, "EFF_ATOMIC_NUM"], {}, "effective atomic number map"),
        ([*COMPUTED, "Z_EFF"], {}, "effective atomic number map"),
        ([*COMPUTED, "ELECTRON_DENSITY"], ENERGIES, "electron density map"),
        ([*COMPUTED, "MAT_SPECIFIC"], ENERGIES, "map of one material"),
        ([*COMPUTED, "MAT_FRACTIONAL"], {}, "map of one material"),
        ([*COMPUTED, "IODINE MAP"], {}, "map of one material"),
        ([*COMPUTED, "CBF"], {}, "perfusion map (CBF)"),
        ([*COMPUTED, "PERFUSION", "MTT"], {}, "perfusion map (MTT)"),
        ([*COMPUTED, "PERFUSION"], {}, "perfusion map"),
        ([*COMPUTED, "TMAX"], {"RescaleType": "HU"}, "perfusion map (TMAX)"),
        (ORIGINAL, ENERGIES, "RescaleType must say what the values are"),
        (ORIGINAL, {"RescaleType": "MGML"}, "RescaleType is MGML (mg/ml)"),
        (ORIGINAL, {"RescaleType": "Doe^Ann"}, "RescaleType is another unit"),
        (ORIGINAL, {"RescaleType": "HU_MOD", **ENERGIES}, "RescaleType is HU_MOD"),
    ],
)
def test_a_map_of_other_values_is_refused_by_its_name(tmp_path, image_type, tags, words):
    Archived().write(tmp_path, ImageType=image_type, **tags)
    assert words in reason(tmp_path)
    assert "no Hounsfield units" in reason(tmp_path)
    assert "Doe" not in reason(tmp_path)


@pytest.mark.parametrize(
    ("image_type", "tags", "note"),
    [
        (ORIGINAL, {}, ""),
        (COMPUTED, {}, ""),
        ([*ORIGINAL, "PERFUSION"], {}, ""),
        ([*COMPUTED, "CT_SOM5 MPR"], {}, ""),
        ([*COMPUTED, "VMI"], ENERGIES, ""),
        ([*COMPUTED, "VMI"], {**ENERGIES, "RescaleType": "HU"}, ""),
        ([*COMPUTED, "MAT_REMOVED"], {**ENERGIES, "RescaleType": "HU"}, ""),
        (ORIGINAL, {**ENERGIES, "RescaleType": "HU"}, ""),
        (ORIGINAL, {"MultienergyCTAcquisition": "NO"}, ""),
        ([*COMPUTED, "MAT_SPECIFIC"], {**ENERGIES, "RescaleType": "HU"}, "one material only"),
        ([*COMPUTED, "MAT_MODIFIED"], {**ENERGIES, "RescaleType": "HU"}, "a material stand out"),
    ],
)
def test_what_is_in_hounsfield_units_is_read(tmp_path, image_type, tags, note):
    series = Archived()
    series.write(tmp_path, ImageType=image_type, **tags)
    volume = load_ct(tmp_path)
    np.testing.assert_array_equal(volume.hu, series.hu())
    assert [note in found for found in volume.series.notes] == [True] * bool(note)


# --- the cases as they were found

CASES = {
    "01_undefined_length_in_a_native_syntax": "undefined length",
    "08_effective_atomic_number_without_rescale_type": "effective atomic number map",
    "10_pixel_representation_missing": "PixelRepresentation is missing",
    "12_last_file_cut_in_its_header": "007.dcm is truncated",
    "25_jitter_is_called_a_gantry_tilt": "shifted sideways",
}


@pytest.mark.parametrize("name", CASES)
def test_what_was_read_wrongly_is_refused_for_a_true_reason(shared_data, name):
    folder = shared_data / "ct_cases" / name
    assert CASES[name] in reason(folder)
    assert scan_folder(folder).series[0].notes == ()
    with pytest.raises(SeriesRefusedError, match=CASES[name]):
        load_ct(folder)


def test_what_was_read_wrongly_is_read_rightly(shared_data):
    cases = shared_data / "ct_cases"
    assert load_ct(cases / "03_explicit_labelled_implicit_small_image").hu[2, 20, 20] == 1
    for name, sizes in (
        ("04_two_patients_in_one_series_uid", [6, 6]),
        ("06_two_acquisitions_interleaved_to_an_even_stack", [6, 6]),
        ("26_scout_without_LOCALIZER_in_the_series", [10]),
    ):
        assert [s.size[2] for s in scan_folder(cases / name).usable] == sizes
    padded_ct = load_ct(cases / "28_padding_above_all_values")
    assert padded_ct.hu[3, 0, 0] == -1024
    assert body_mask(padded_ct).mean() == pytest.approx(0.249, abs=0.01)
