"""Padding is no measurement and never tissue, and slices that jump sideways are no gantry tilt."""

import numpy as np
import pytest

from app.imaging.body import body_mask
from app.imaging.reading import load_ct, pixel_lps_mm, read_with
from app.imaging.scanning import scan_folder
from app.imaging.thumbnails import thumbnail
from tests.imaging.archive_series import NATIVE, Archived

# --- padding


def padded(series, value, where, **tags):
    """Return tags of each slice with padding of one value outside of the field of view."""

    def of(k):
        stored = np.where(where, value, series.hu()[k] + 1024) & 0xFFFF
        return {**tags, "PixelData": stored.astype("<u2").tobytes()}

    return of


def corners(series):
    j, i = np.ogrid[: series.shape[0], : series.shape[1]]
    return (j - series.shape[0] / 2) ** 2 + (i - series.shape[1] / 2) ** 2 > 81.0


STANDS_OUT = [
    (63536, {"PixelPaddingValue": 63536}),
    (63536, {"PixelPaddingValue": 63536, "BitsStored": 12, "HighBit": 11}),
    (4095, {"PixelPaddingValue": 4095, "BitsStored": 12, "HighBit": 11}),
    (32767, {"PixelRepresentation": 1, "PixelPaddingValue": 32767}),
    (2000, {"PixelPaddingValue": 2000}),
    (61000, {"PixelPaddingValue": 63536, "PixelPaddingRangeLimit": 60000}),
    (61000, {"PixelPaddingValue": 60000, "PixelPaddingRangeLimit": 63536}),
    (1500, {"PixelPaddingValue": 1500, "RescaleIntercept": "-1024.5"}),
]


@pytest.mark.parametrize("syntax", NATIVE)
@pytest.mark.parametrize(("value", "tags"), STANDS_OUT)
def test_padding_above_all_values_is_air_and_no_measurement(tmp_path, value, tags, syntax):
    series = Archived(syntax=syntax)
    outside = corners(series)
    per_slice = padded(series, value, outside, **tags)
    for k in range(series.count):
        (tmp_path / f"{k}").write_bytes(series.encoded(k, **per_slice(k)))
    volume = load_ct(tmp_path)
    offset = float(tags.get("RescaleIntercept", -1024)) + 1024
    assert (volume.hu[:, outside] == -1024).all()
    np.testing.assert_array_equal(volume.hu[:, ~outside], series.hu()[:, ~outside] + offset)
    header = volume.series.slices[3]
    assert pixel_lps_mm(tmp_path, header.identity.sop_uid, 0, 0)[1] is None
    assert pixel_lps_mm(tmp_path, header.identity.sop_uid, 12, 10)[1] == volume.hu[3, 10, 12]
    assert body_mask(volume)[:, outside].mean() < 0.01
    assert int(thumbnail(volume.series, 48)[0, 0]) == 0


def test_padding_below_all_values_stays_what_it_was(tmp_path):
    series = Archived()
    outside = corners(series)
    tags = {"PixelRepresentation": 1, "PixelPaddingValue": -2000}
    per_slice = padded(series, -2000, outside, **tags)
    for k in range(series.count):
        (tmp_path / f"{k}").write_bytes(series.encoded(k, **per_slice(k)))
    np.testing.assert_array_equal(load_ct(tmp_path).hu, np.where(outside, -3024, series.hu()))


@pytest.mark.parametrize(("value", "signed"), [(63536, 0), (-2000, 1), (3000, 0)])
@pytest.mark.parametrize("remedy", ["straighten", "resample", "halve"])
def test_no_remedy_mixes_padding_with_what_was_measured(tmp_path, value, signed, remedy):
    series = Archived(shape=(21, 25))
    outside = corners(series)
    flat = np.where(outside, value, 1064) & 0xFFFF
    for k in range(series.count):
        shift = (0.0, 0.7 * k, 2.0 * k) if remedy == "straighten" else (0.0, 0.0, 2.0 * k)
        if remedy == "resample" and k == 2:
            shift = (0.3, 0.2, 4.4)
        whole = series.encoded(
            k,
            PixelRepresentation=signed,
            PixelPaddingValue=value,
            PixelData=flat.astype("<u2").tobytes(),
            ImagePositionPatient=list(shift),
        )
        (tmp_path / f"{k}").write_bytes(whole)
    volume = read_with(scan_folder(tmp_path).series[0], remedy)
    assert set(np.unique(volume.hu)) <= {40, -1024, -3024}
    share = (volume.hu == 40).mean() / (~outside).mean()
    assert 0.75 < share < 1.3


# --- tilt


@pytest.mark.parametrize("seed", range(8))
def test_slices_that_jump_sideways_are_no_gantry_tilt(tmp_path, seed):
    rng = np.random.default_rng(seed)
    series = Archived(count=int(rng.integers(5, 12)))
    jumps = rng.choice([-0.03, 0.0, 0.03], (series.count, 2))
    jumps[0], jumps[-1] = -0.03, 0.03
    jumps[1], jumps[-2] = 0.03, -0.03
    for k in range(series.count):
        at = [round(float(v), 3) for v in (*jumps[k], 2.0 * k)]
        (tmp_path / f"{k}").write_bytes(series.encoded(k, ImagePositionPatient=at))
    (found,) = scan_folder(tmp_path).series
    assert found.tilt_deg == 0.0
    assert not any("tilt" in note for note in found.notes)
    assert found.reason.startswith("slices shifted sideways against each other")
    assert found.remedy == "resample"
    assert not any("tilt" in words for words in read_with(found, "resample").made)


@pytest.mark.parametrize("angle_deg", [0.3, 1.0, 14.0, 30.0])
@pytest.mark.parametrize("rounding_mm", [0.0, 0.004])
def test_a_tilt_is_said_though_its_positions_are_rounded(tmp_path, angle_deg, rounding_mm):
    rng = np.random.default_rng(3)
    series = Archived(count=10, step_mm=2.5)
    for k in range(series.count):
        drift = 2.5 * k * np.tan(np.radians(angle_deg)) + rng.uniform(-rounding_mm, rounding_mm)
        at = [0.0, round(float(drift), 5), 2.5 * k]
        (tmp_path / f"{k}").write_bytes(series.encoded(k, ImagePositionPatient=at))
    (found,) = scan_folder(tmp_path).usable
    assert found.tilt_deg == pytest.approx(angle_deg, abs=0.03)
    assert any(f"gantry tilt {angle_deg:.1f}°" in note for note in found.notes)
