"""Series to volume: order, geometry and values."""

import hashlib
import json
import sys

import numpy as np
import pytest

from app.core.progress import Cancelled, Progress
from app.imaging import codecs
from app.imaging.errors import SeriesAmbiguousError, SeriesUnknownError
from app.imaging.pixel_data import PixelFormat
from app.imaging.reading import load_ct, pixel_lps_mm, read_series
from app.imaging.scanning import scan_folder
from tests.imaging import dicom_factory as factory
from tests.imaging.dicom_factory import Slices

ORIENTATIONS = {
    "transverse": factory.TRANSVERSE,
    "sagittal": factory.SAGITTAL,
    "coronal": factory.CORONAL,
    "reversed": factory.REVERSED,
    "feet first prone": factory.FEET_FIRST_PRONE,
    "oblique": factory.oblique(),
    "oblique the other way": factory.oblique(-50.0),
}


@pytest.mark.parametrize("orientation", ORIENTATIONS.values(), ids=ORIENTATIONS)
def test_every_voxel_lies_where_its_own_file_says(tmp_path, orientation):
    slices = Slices(orientation)
    slices.write(tmp_path)
    volume = load_ct(tmp_path)
    i, j = 13, 7
    for k, offset in enumerate(slices.offsets):
        expected = (
            slices.position(offset)
            + i * slices.spacing[1] * np.array(orientation[:3])
            + j * slices.spacing[0] * np.array(orientation[3:])
        )
        np.testing.assert_allclose(volume.lps_mm((i, j, k)), expected, atol=1e-8)
        assert volume.hu[k, j, i] == slices.stored(k)[j, i] - 1024
    assert volume.size == (16, 12, 5)
    np.testing.assert_allclose(volume.spacing_mm, (0.5, 0.8, 2.0), atol=1e-9)


def test_file_order_instance_number_and_slice_thickness_do_not_matter(tmp_path):
    forwards = Slices().write(tmp_path / "a")
    volume = load_ct(tmp_path / "a")
    names = [path.name for path in forwards]
    (tmp_path / "b" / "deep" / "er").mkdir(parents=True)
    for n, path in enumerate(reversed(forwards)):
        path.rename(tmp_path / "b" / ("deep/er" if n % 2 else ".") / f"x{names[n]}.txt")
    again = load_ct(tmp_path / "b")
    np.testing.assert_array_equal(again.hu, volume.hu)
    np.testing.assert_array_equal(again.affine_mm, volume.affine_mm)


def test_a_file_without_the_preamble_is_still_found(tmp_path):
    for path in Slices().write(tmp_path):
        raw = path.read_bytes()
        path.write_bytes(raw[132:])  # meta information first, but no preamble
    assert load_ct(tmp_path).size == (16, 12, 5)


def test_each_slice_has_its_own_rescale(tmp_path):
    slices = Slices()
    for k, offset in enumerate(slices.offsets):
        slices.write_one(
            tmp_path / f"f{k}", k, offset, RescaleSlope=str(k + 1), RescaleIntercept=str(-10 * k)
        )
    volume = load_ct(tmp_path)
    assert volume.hu.dtype == np.int16
    for k in range(5):
        np.testing.assert_array_equal(volume.hu[k], (k + 1) * slices.stored(k) - 10 * k)


def test_values_beyond_16_bits_become_float_and_never_wrap(tmp_path):
    slices = Slices()
    big = np.full(slices.shape, 40000, "<u2").tobytes()
    for k, offset in enumerate(slices.offsets):
        slices.write_one(tmp_path / f"f{k}", k, offset, **({"PixelData": big} if k == 3 else {}))
    volume = load_ct(tmp_path)
    assert volume.hu.dtype == np.float32
    assert volume.hu[3, 0, 0] == 38976.0
    np.testing.assert_array_equal(volume.hu[1], slices.stored(1) - 1024)


def test_a_fractional_slope_gives_float(tmp_path):
    slices = Slices(tags={"RescaleSlope": "0.5"})
    slices.write(tmp_path)
    volume = load_ct(tmp_path)
    assert volume.hu.dtype == np.float32
    np.testing.assert_allclose(volume.hu[2], 0.5 * slices.stored(2) - 1024)


def test_padding_may_saturate_where_measured_values_fit(tmp_path):
    slices = Slices(signed=True, tags={"PixelPaddingValue": -32768})
    stored = slices.stored(0).astype("<i2")
    stored[0, 0] = -32768
    for k, offset in enumerate(slices.offsets):
        slices.write_one(tmp_path / f"f{k}", k, offset, PixelData=stored.tobytes())
    volume = load_ct(tmp_path)
    assert volume.hu.dtype == np.int16
    assert volume.hu[0, 0, 0] == -32768
    np.testing.assert_array_equal(volume.hu[0, 1:], stored[1:] - 1024)


def test_bits_above_the_stored_ones_are_dropped_and_signs_kept(tmp_path):
    slices = Slices(signed=True, tags={"BitsStored": 12, "HighBit": 11})
    stored = np.arange(-96, 96).reshape(slices.shape)
    dirty = (stored & 0x0FFF | 0x7000).astype("<u2").tobytes()
    for k, offset in enumerate(slices.offsets):
        slices.write_one(tmp_path / f"f{k}", k, offset, PixelData=dirty)
    np.testing.assert_array_equal(load_ct(tmp_path).hu[0], stored - 1024)


def test_two_series_must_be_told_apart_by_name(tmp_path):
    Slices().write(tmp_path)
    Slices(series="2.25.2000", offsets=(0.0, 1.0, 2.0)).write(tmp_path, "t")
    with pytest.raises(SeriesAmbiguousError, match=r"2 usable CT series.*2\.25\.2000") as caught:
        load_ct(tmp_path)
    assert [series.uid for series in caught.value.series] == ["2.25.1000", "2.25.2000"]
    assert load_ct(tmp_path, "2.25.2000").size[2] == 3
    with pytest.raises(SeriesUnknownError, match=r"holds 2\.25\.1000, 2\.25\.2000"):
        load_ct(tmp_path, "2.25.3")


def test_a_pixel_of_a_tilted_file_lies_where_its_file_says(tmp_path):
    slices = Slices(shear=0.25)
    slices.write(tmp_path)
    lps_mm, hu = pixel_lps_mm(tmp_path, "2.25.1000.3", 5, 2)
    np.testing.assert_allclose(lps_mm, slices.position(4.0) + np.array([2.5, 1.6, 0.0]))
    assert hu == slices.stored(2)[2, 5] - 1024


def test_reading_reports_progress_and_can_be_cancelled(tmp_path):
    Slices().write(tmp_path)
    told: list[float] = []
    load_ct(tmp_path, progress=Progress(lambda fraction, text: told.append(fraction)))
    assert told == sorted(told)
    assert told[-1] == 1.0
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        scan_folder(tmp_path, progress)
    with pytest.raises(Cancelled):
        read_series(scan_folder(tmp_path).series[0], progress)


def test_the_volume_is_read_only_and_carries_no_name(tmp_path):
    Slices().write(tmp_path)
    volume = load_ct(tmp_path)
    with pytest.raises(ValueError, match="read-only"):
        volume.hu[0, 0, 0] = 1
    assert "Secret" not in repr(volume.series)
    assert "SECRET" not in repr(volume.series)
    assert volume.series.pseudonym.startswith("CT-")


REFERENCES = ["ct_chest_lidc0314", "ct_phantom_study/S2010"]


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", REFERENCES)
def test_real_series_agree_with_the_reference_bit_by_bit(shared_data, name):
    reference = json.loads((shared_data / "reference.json").read_text())[name]
    volume = load_ct(shared_data / name)
    assert (
        hashlib.sha256(volume.hu.astype("<i2").tobytes()).hexdigest() == reference["sha256_int16"]
    )
    assert list(volume.size) == reference["size"]
    np.testing.assert_allclose(volume.spacing_mm, reference["spacing"], rtol=1e-12)
    np.testing.assert_array_equal(volume.origin_mm, reference["origin"])
    np.testing.assert_array_equal(volume.direction.ravel(), reference["direction"])


@pytest.mark.long("journey")
def test_lossless_encodings_decode_to_one_array(shared_data, tmp_path):
    lossless = ["BigEndianExplicit", "Deflated", "JPEG2000LosslessOnly", "JPEGLSLossless",
                "JPEGProcess14SV1", "JPEGProcess14T", "LittleEndianExplicit",
                "LittleEndianImplicit", "RLE"]  # fmt: skip
    listing = scan_folder(shared_data / "ct_transfer_syntaxes")
    headers = [header for series in listing.series for header in series.slices]
    values = {}
    for word in lossless:
        (header,) = [h for h in headers if f"dcm_{word}" in h.path.name and not h.damage]
        folder = tmp_path / word
        folder.mkdir()
        (folder / "one").write_bytes(header.path.read_bytes())
        spots = [(0, 0), (256, 256), (300, 200), (411, 123)]
        values[word] = [pixel_lps_mm(folder, header.identity.sop_uid, *at)[1] for at in spots]
    first = values["LittleEndianImplicit"]
    assert all(value == first for value in values.values())


@pytest.mark.parametrize("bits", [8, 12, 16])
def test_jpeg_ls_is_decoded_to_the_same_where_pyjpegls_is_missing(monkeypatch, bits):
    from jpeg_ls import encode_buffer

    width = 1 if bits == 8 else 2
    values = np.random.default_rng(bits).integers(0, 1 << bits, (40, 30)).astype(f"<u{width}")
    frame = bytes(encode_buffer(values.tobytes(), 40, 30, 1, bits))
    form = PixelFormat(40, 30, 1, 1, 8 * width, bits, bits - 1, False, "MONOCHROME2", None)
    monkeypatch.setitem(sys.modules, "jpeg_ls", None)  # as under Python 3.14
    found = np.zeros_like(values)
    codecs.decode(frame, "1.2.840.10008.1.2.4.80", form, found)
    np.testing.assert_array_equal(found, values)
