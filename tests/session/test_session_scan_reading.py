"""What a hand reads off a scan's picture: the rim of air, and blood about the needle."""

from dataclasses import replace

import numpy as np
import pytest
from chest import DOWN, ENTRY, TARGET, chest, ct_of

from app.imaging.fallen_lung import changed_ct
from app.imaging.inside import Inside, lung_shape
from app.imaging.scan_look import ScanLook
from app.imaging.scan_order import ScanNeedle, ScanOrder
from app.imaging.scanned import scan_image
from app.session.scan_reading import air_rim_mm, blood_radius_mm

FIELD = chest()
CT = ct_of(FIELD)
SHAPE = lung_shape(FIELD, TARGET, DOWN)
ORDER = ScanOrder(0.0, 3, 3.0)
NEEDLE = ScanNeedle(ENTRY - [0.0, 80.0, 0.0], TARGET + [0.0, 4.0, 0.0])
ENDS = NEEDLE.hub_mm, NEEDLE.tip_mm
UP = -DOWN


def picture(share=0.0, blood=0.0, noise_hu=0.0, needle=NEEDLE):
    way = np.array([ENTRY, NEEDLE.tip_mm]) if blood else None
    now = Inside(share, SHAPE.centre_mm, TARGET, SHAPE.is_left, blood, way, True)
    volume = changed_ct(CT, FIELD, now)
    look = replace(ScanLook(True), noise_hu=noise_hu, noise_seed=3)
    return scan_image(volume, ORDER, needle, True, look=look)


@pytest.mark.parametrize("share", [0.1, 0.25, 0.5])
@pytest.mark.parametrize("noise_hu", [0.0, 12.0])
def test_the_rim_is_as_deep_in_the_picture_as_the_lung_has_fallen(share, noise_hu) -> None:
    measured = air_rim_mm(picture(share, noise_hu=noise_hu), TARGET, UP, *ENDS)
    assert measured == pytest.approx(SHAPE.rim_mm(share), abs=3.0)


def test_without_air_there_is_no_rim_whatever_the_noise() -> None:
    assert air_rim_mm(picture(noise_hu=12.0), TARGET, UP, *ENDS) == 0.0


def test_the_other_lung_has_none_and_another_side_less() -> None:
    fallen = picture(0.4)
    assert air_rim_mm(fallen, TARGET * [-1.0, 1.0, 1.0], UP, *ENDS) == 0.0
    assert air_rim_mm(fallen, TARGET, DOWN, *ENDS) < 0.8 * air_rim_mm(fallen, TARGET, UP, *ENDS)


@pytest.mark.parametrize("radius_mm", [8.0, 14.0, 22.0])
def test_blood_is_as_wide_in_the_picture_as_it_is(radius_mm) -> None:
    before = picture(needle=None)
    measured = blood_radius_mm(picture(blood=radius_mm), before, NEEDLE.hub_mm, NEEDLE.tip_mm)
    assert 0.65 * radius_mm - 2.0 <= measured <= radius_mm + 2.0


def test_a_needle_alone_is_no_blood() -> None:
    before = picture(needle=None)
    assert blood_radius_mm(picture(), before, NEEDLE.hub_mm, NEEDLE.tip_mm) <= 2.0
