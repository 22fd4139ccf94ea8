"""Sharpness and noise of pictures as cameras deliver them: PNG or JPEG, by another renderer."""

import numpy as np
import pytest

from app.core import paths
from app.tracking.picture_quality import noise_level, picture_quality
from tests.tracking.camera_pictures import DELIVERIES, CameraPictures


@pytest.fixture(scope="module")
def maker() -> CameraPictures:
    return CameraPictures(paths.resources() / "cameras" / "wide.yaml")


def edges(maker: CameraPictures, kind: str, seed: int) -> list[float]:
    found = []
    for number, delivered in enumerate(DELIVERIES):
        pair = maker.pair(kind, delivered, np.random.default_rng([seed, number]))
        for image, marker in zip((pair.left, pair.right), pair.marker_px, strict=True):
            width = picture_quality(image, marker[0]).edge_width
            assert width is not None
            found.append(width)
    return found


@pytest.mark.long("statistics")
def test_an_edge_is_as_sharp_through_jpeg_and_wider_out_of_focus(maker: CameraPictures) -> None:
    sharp, soft = edges(maker, "clean", 9), edges(maker, "defocus", 22)
    # A lens of 0.6 px, a pixel's own width and the operator: 2.5 px.
    assert 2.2 < np.median(sharp) < 3.1
    assert max(sharp) < 4.2  # the check calls 5 px unsharp
    assert np.median(soft) - np.median(sharp) == pytest.approx(0.6, abs=0.3)
    assert np.quantile(sharp, 0.75) < np.quantile(soft, 0.25)


@pytest.mark.parametrize("sd", [1.0, 3.0, 9.0])
def test_the_noise_of_an_even_picture_is_its_standard_deviation(sd: float) -> None:
    rng = np.random.default_rng(3)
    slope = np.linspace(60.0, 180.0, 320)[None, :, None] * np.ones((240, 1, 3))
    slope[100:140, 80:200] += 50.0
    picture = np.clip(np.rint(slope + sd * rng.standard_normal(slope.shape)), 0, 255)
    assert noise_level(picture.astype(np.uint8)) == pytest.approx(sd, rel=0.1)


@pytest.mark.long("statistics")
def test_a_picture_in_low_light_is_noisier_than_a_well_lit_one(maker: CameraPictures) -> None:
    lit, dim = [], []
    for seed in range(4):
        for kind, found in (("clean", lit), ("lowlight", dim)):
            pair = maker.pair(kind, "png", np.random.default_rng(seed))
            found += [noise_level(pair.left), noise_level(pair.right)]
    assert max(lit) < 4.5 < np.median(dim)
