"""What a control scan can show beside plain slices: gaps, a tilt, drawn ends, and noise."""

import hashlib

import numpy as np
import pytest
from test_imaging_scanned import flat, metal_mm3, volume_of

from app.core.errors import NumericalError
from app.imaging import scanned
from app.imaging.errors import ScanOrderError
from app.imaging.scan_look import BreathPicture, NeedleEnds, ScanLook, look_of
from app.imaging.scan_order import ScanNeedle, ScanOrder, ScanTip, Seen, seen
from app.imaging.scanned import scan_image

RADIUS = 0.9
DRAWN = ScanLook(ends=NeedleEnds.DRAWN)


@pytest.fixture
def endless(monkeypatch: pytest.MonkeyPatch) -> None:
    """A scale that does not end below steel, so that brightness measures metal."""
    monkeypatch.setattr(scanned, "LAST_HU", 32000.0)


def test_plain_pictures_are_what_they_were_to_the_last_bit() -> None:
    source = volume_of(np.random.default_rng(3).integers(-500, 500, (60, 65, 65)).astype(np.int16))
    corners = np.array([[-3.0, -20.0, 131.0], [-2.0, -5.0, 131.5], [0.0, 6.0, 132.5]])
    made = []
    for bent in (None, corners):
        needle = ScanNeedle(corners[0], corners[-1], corners_mm=bent)
        picture = scan_image(source, ScanOrder(130.3, 4, 4.0), needle, True, (1.0, -2.0, 3.0))
        content = picture.hu.tobytes() + picture.affine_mm.tobytes()
        made.append(hashlib.sha256(content).hexdigest()[:16])
    assert made == ["ff1a528dcb09b114", "c7b5966796fae3d9"]  # of the program before the looks


# --- gaps -----------------------------------------------------------------------------------------


def test_slices_with_gaps_stand_as_far_apart_as_is_said() -> None:
    order = ScanOrder(100.0, 3, 3.0, 8.0)
    np.testing.assert_allclose(order.middles_mm, [92.0, 100.0, 108.0])
    assert order.range_mm == (90.5, 109.5)
    picture = scan_image(flat(), ScanOrder(130.0, 3, 3.0, 8.0))
    np.testing.assert_allclose(np.diff([picture.lps_mm((0, 0, k))[2] for k in range(3)]), 8.0)


def test_a_tip_between_two_slices_is_seen_in_none_of_them() -> None:
    order = ScanOrder(130.0, 3, 3.0, 8.0)
    needle = ScanNeedle(np.array([0.0, -20.0, 120.0]), np.array([0.0, 5.0, 126.0]), RADIUS)
    assert seen(order, needle) is Seen.BETWEEN
    assert seen(ScanOrder(130.0, 3, 8.0), needle) is Seen.TIP
    changed = np.argwhere(scan_image(flat(), order, needle).hu != 40)
    assert set(changed[:, 0].tolist()) == {0}


def test_a_needle_in_a_gap_alone_is_not_seen() -> None:
    order = ScanOrder(130.0, 3, 3.0, 8.0)
    needle = ScanNeedle(np.array([0.0, -20.0, 126.0]), np.array([0.0, 5.0, 111.0]), RADIUS)
    beside = ScanNeedle(np.array([0.0, -20.0, 125.0]), np.array([0.0, 5.0, 126.5]), RADIUS)
    assert seen(order, needle) is Seen.SHAFT
    np.testing.assert_array_equal(
        scan_image(flat(), order, beside).hu, scan_image(flat(), order).hu
    )


@pytest.mark.parametrize(
    ("values", "words"),
    [((100.0, 3, 5.0, 4.0), "gap of -1 mm: 0 mm"), ((100.0, 3, 5.0, 90.0), "50 mm"),
     ((100.0, 3, 5.0, float("nan")), "gap of nan"), ((100.0, 3, 5.0, None, 31.0), "-30° to 30°"),
     ((100.0, 3, 5.0, None, float("nan")), "-30° to 30°"),
     ((100.0, 3, 5.0, None, 5.0, float("inf")), "not a number")],
)  # fmt: skip
def test_what_no_scanner_does_is_refused_in_one_line(values: tuple[float, ...], words: str) -> None:
    with pytest.raises(ScanOrderError, match=words) as refused:
        ScanOrder(*values)  # type: ignore[arg-type]
    assert "\n" not in str(refused.value)


# --- the gantry -----------------------------------------------------------------------------------


def test_a_tilted_slice_lies_where_the_gantry_has_it() -> None:
    k, j, i = np.mgrid[0:60, 0:65, 0:65]
    y, z = -25.6 + 0.8 * j, 100.0 + k
    source = volume_of(np.rint(100 + 10 * y + 3 * (z - 130.0) + 0 * i).astype(np.int16))
    order = ScanOrder(130.0, 3, 2.0, None, 12.0, 4.0)
    picture = scan_image(source, order)
    inside = picture.hu > -1000
    voxels = np.argwhere(inside)[:, ::-1].astype(float)
    places = picture.lps_mm(voxels)
    wanted = 100 + 10 * places[:, 1] + 3 * (places[:, 2] - 130.0)
    assert np.median(np.abs(picture.hu[inside] - wanted)) < 1.0
    middle = picture.lps_mm((30, 0, 1)), picture.lps_mm((30, 60, 1))
    lean = (middle[0][2] - middle[1][2]) / (middle[1][1] - middle[0][1])
    assert lean == pytest.approx(np.tan(np.radians(12.0)))  # the front is nearer to the head
    pivot = order.in_patient(np.array([0.0, 4.0, 130.0]))
    np.testing.assert_allclose(pivot, [0.0, 4.0, 130.0])


def test_a_tilt_along_the_needle_shows_it_whole_in_one_slice() -> None:
    lean = np.radians(15.0)
    way = np.array([0.0, np.cos(lean), -np.sin(lean)])
    middle = np.array([0.0, 2.0, 130.0])
    needle = ScanNeedle(middle - 14.0 * way, middle + 14.0 * way, RADIUS)
    straight = ScanOrder(130.0, 3, 2.0)
    tilted = ScanOrder(130.0, 3, 2.0, None, 15.0, 2.0)
    assert seen(straight, needle) is Seen.SHAFT
    assert seen(tilted, needle) is Seen.TIP
    picture = scan_image(flat(), tilted, needle)
    assert set(np.argwhere(picture.hu != 40)[:, 0].tolist()) == {1}
    bright = picture.lps_mm(np.argwhere(picture.hu == picture.hu.max())[:, ::-1].astype(float))
    along = (bright - middle) @ way
    assert np.linalg.norm(bright - middle - along[:, None] * way, axis=1).max() < 1.5


# --- the needle's ends ----------------------------------------------------------------------------


def needle_with(tip: ScanTip, **more: float) -> ScanNeedle:
    start, end = np.array([0.3, -15.0, 130.1]), np.array([0.3, 8.0, 130.1])
    return ScanNeedle(start, end, RADIUS, tip=tip, hollow=bool(more), **more)


@pytest.mark.usefixtures("endless")
@pytest.mark.parametrize(
    ("tip", "missing"), [(ScanTip.FLAT, 0.0), (ScanTip.CONE, 2 / 3), (ScanTip.BEVEL, 1 / 2)]
)
def test_a_ground_tip_lacks_what_was_ground_off(tip: ScanTip, missing: float) -> None:
    needle = needle_with(tip)
    picture = scan_image(flat(), ScanOrder(130.0, 3, 5.0), needle, look=DRAWN)
    whole = np.pi * RADIUS**2 * (23.0 - missing * needle.tip_length_mm)
    assert metal_mm3(picture) == pytest.approx(whole, rel=0.02)


@pytest.mark.usefixtures("endless")
def test_a_hollow_needle_shows_its_wall_alone() -> None:
    needle = needle_with(ScanTip.FLAT, inner_radius_mm=0.6)
    picture = scan_image(flat(), ScanOrder(130.0, 3, 5.0), needle, look=DRAWN)
    assert metal_mm3(picture) == pytest.approx(np.pi * (RADIUS**2 - 0.6**2) * 23.0, rel=0.03)


@pytest.mark.usefixtures("endless")
def test_a_tip_ends_within_a_pixel_and_a_leaving_shaft_tapers_over_its_thickness_by_the_sine() -> (
    None
):
    def taper(needle: ScanNeedle) -> float:
        """Length over which the brightness along y falls from 90 to 10 % [mm]."""
        picture = scan_image(flat(), ScanOrder(130.0, 3, 5.0), needle, look=DRAWN)
        profile = picture.hu[1].astype(float).sum(axis=1) - 40.0 * 65
        profile = profile[: 1 + int(np.flatnonzero(profile > 1.0)[-1])] / profile.max()
        y = 0.8 * np.arange(len(profile))
        falling = profile[np.argmax(profile) :]
        return float(np.interp(-0.1, -falling, y[: len(falling)]) -
                     np.interp(-0.9, -falling, y[: len(falling)]))  # fmt: skip

    tip = ScanNeedle(np.array([0.0, -24.0, 130.0]), np.array([0.0, 8.0, 130.0]), RADIUS)
    slope = np.tan(np.radians(8.0))
    shaft = ScanNeedle(np.array([0.0, -24.0, 132.5 - 30.0 * slope]),
                       np.array([0.0, 24.0, 132.5 + 18.0 * slope]), RADIUS)  # fmt: skip
    assert taper(tip) < 1.6
    thickness = 2.0 * RADIUS / np.sin(np.radians(8.0))
    assert 0.5 * thickness < taper(shaft) < thickness


def test_bands_are_drawn_at_both_ends_and_in_slices_with_metal_alone() -> None:
    needle = ScanNeedle(np.array([0.0, -8.0, 130.0]), np.array([0.0, 6.0, 130.0]), RADIUS)
    order = ScanOrder(130.0, 3, 5.0)
    look = ScanLook(True, NeedleEnds.DRAWN)
    plain, dark = (scan_image(flat(), order, needle, look=one).hu for one in (DRAWN, look))
    for y in (-14.0, 12.0):
        assert dark[1, round((y + 25.6) / 0.8), 32] < plain[1, round((y + 25.6) / 0.8), 32] - 100
    np.testing.assert_array_equal(dark[[0, 2]], plain[[0, 2]])


def test_a_bore_as_wide_as_the_needle_is_refused() -> None:
    with pytest.raises(NumericalError, match="bore"):
        ScanNeedle(np.zeros(3), np.ones(3), 0.6, hollow=True, inner_radius_mm=0.6)


# --- noise ----------------------------------------------------------------------------------------


def test_noise_has_the_deviation_that_is_asked_for_and_is_the_same_again() -> None:
    order, look = ScanOrder(130.0, 3, 5.0), ScanLook(noise_hu=12.0, noise_seed=4)
    first, again = (scan_image(flat(), order, look=look).hu for _ in range(2))
    other = scan_image(flat(), order, look=ScanLook(noise_hu=12.0, noise_seed=5)).hu
    np.testing.assert_array_equal(first, again)
    assert (first != other).mean() > 0.9
    assert float(first.astype(float).std()) == pytest.approx(12.0, rel=0.05)
    left, right = first[:, :, :-1].astype(float) - 40.0, first[:, :, 1:].astype(float) - 40.0
    assert 0.3 < float((left * right).mean()) / 144.0 < 0.8  # neighbours are joined


def test_a_look_is_read_back_as_it_was() -> None:
    looks = (
        ScanLook(),
        ScanLook(True),
        ScanLook(True, NeedleEnds.DRAWN, BreathPicture.LAYERS, (1.0, -2.0, 3.5), 7.25, 3),
    )
    for look in looks:
        assert look_of(look.streak, look.document()) == look
    assert ScanLook(True).document() == {}
