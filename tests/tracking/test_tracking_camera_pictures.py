"""The test renderer itself, against OpenCV's projection, published numbers and others' pictures."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from app.core import paths
from tests.tracking.camera_pictures import (
    FULL_WELL,
    KINDS,
    CameraPictures,
    Eye,
    Look,
    PicturePair,
    cover,
    delivered_as,
    disc,
)
from tests.tracking.ray_traced_needle import Gloss

CAMERAS = paths.resources() / "cameras"
PLAIN = Look(
    np.array([[0.4, 0.4, 0.4], [0.03, 0.02, 0.6]]),
    Gloss(0.1, 0.0, 20.0),
    np.array([0.0, 0.0, 1.0]),
    np.array([0.5, 0.3]),
    np.ones(3),
)


@pytest.fixture(scope="module")
def wide_pictures() -> CameraPictures:
    return CameraPictures(CAMERAS / "wide.yaml")


@pytest.fixture(scope="module")
def cases(shared_data: Path) -> Path:
    folder = shared_data / "marker_cases"
    if not folder.is_dir():
        pytest.skip(f"no pictures in {folder}: set ACUS_TEST_DATA")
    return folder


def middle(weight: np.ndarray) -> np.ndarray:
    v, u = np.mgrid[: weight.shape[0], : weight.shape[1]]
    return np.array([(u * weight).sum(), (v * weight).sum()]) / weight.sum()


def outline_middle(
    eye: Eye, tip: np.ndarray, axis: np.ndarray, pictures: CameraPictures
) -> np.ndarray:
    """Centroid of the front of the band: arcs of both ends and lines between, projected by OpenCV.

    What shows of a piece of a cylinder lies where its normal n has n · (camera - axis) > radius.
    """
    first, second = np.linalg.svd(axis[None])[2][1:]
    away = -eye.rotation.T @ eye.translation - tip
    a, b = away @ first, away @ second
    half = np.arccos(pictures.needle.band_radius / np.hypot(a, b))
    turn = np.arctan2(b, a) + np.linspace(-half, half, 2000)
    arc = pictures.needle.band_radius * (
        np.outer(np.cos(turn), first) + np.outer(np.sin(turn), second)
    )
    near, far = (tip - behind * axis for behind in pictures.needle[-2:])
    sides = np.linspace(0.0, 1.0, 200)[:, None] * (far - near)
    line = [near + arc, near + arc[-1] + sides, far + arc[::-1], far + arc[0] - sides]
    x, y = eye.project(np.concatenate(line)).T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    sums = [((p + np.roll(p, -1)) * cross).sum() for p in (x, y)]
    return np.array(sums) / (3.0 * cross.sum())


@pytest.mark.long("statistics")
@pytest.mark.parametrize("rig", ["wide", "thesis"])
def test_the_rendered_band_lies_where_opencv_projects_its_outline(rig: str) -> None:
    pictures, rng = CameraPictures(CAMERAS / f"{rig}.yaml"), np.random.default_rng(5)
    for _ in range(6):
        tip, axis = pictures.place(rng)
        for number, eye in enumerate(pictures.eyes):
            share = pictures.traced(number, tip, axis, PLAIN)[..., 4]
            expected = outline_middle(eye, tip, axis, pictures)
            assert middle(share) == pytest.approx(expected, abs=0.01)


def test_rays_of_the_pixels_return_to_them(wide_pictures: CameraPictures) -> None:
    for pictures in (wide_pictures, CameraPictures(CAMERAS / "thesis.yaml")):
        for eye, corners in zip(pictures.eyes, pictures._corners, strict=True):
            rays = np.dstack([corners, np.ones(corners.shape[:2])])[::16, ::16].reshape(-1, 3)
            uv = eye.project((rays - eye.translation) @ eye.rotation)
            v, u = np.mgrid[0:481:16, 0:641:16] - 0.5
            assert np.abs(uv - np.column_stack([u.ravel(), v.ravel()])).max() < 1e-4


def test_cameras_and_truth_are_those_of_the_shared_cases(
    cases: Path, wide_pictures: CameraPictures
) -> None:
    truth = json.loads((cases / "truth.json").read_text())
    for eye, theirs in zip(wide_pictures.eyes, truth["rig"]["cameras"], strict=True):
        assert eye.rotation == pytest.approx(np.array(theirs["R"]), abs=1e-12)
        assert eye.translation == pytest.approx(np.array(theirs["t"]), abs=1e-12)
    half = wide_pictures.half
    for pair in truth["pairs"]:
        centre, axis = np.array(pair["marker_centre_m"]), np.array(pair["axis"])
        for eye, side in zip(wide_pictures.eyes, ("left", "right"), strict=True):
            theirs = pair["marker_px"][side]
            ends = np.array([theirs["centre"], *theirs["ends"]])
            uv = eye.project(centre + np.outer([0.0, half, -half], axis))
            assert uv == pytest.approx(ends, abs=0.001)  # written with three decimals


def red_area(picture: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Pixels near the band at least half as saturated as it is, in linear light: bright or dark."""
    values = picture.astype(float) / 255.0
    light = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    red = (light[..., 2] - light[..., :2].max(axis=2)) / (light.sum(axis=2) + 1e-3)
    inside = cv2.erode(near, np.ones((7, 7))) > 0
    return ((red > 0.5 * np.median(red[inside])) & (near > 0)).astype(float)


@pytest.mark.long("statistics")
def test_a_band_drawn_by_the_shared_cases_renderer_has_the_same_middle(
    cases: Path, wide_pictures: CameraPictures
) -> None:
    truth, gaps = json.loads((cases / "truth.json").read_text()), []
    for pair in truth["pairs"]:
        if pair["kind"] != "clean":
            continue
        tip, axis = np.array(pair["tip_m"]), np.array(pair["axis"])
        for number, side in enumerate(("left", "right")):
            needle = wide_pictures.traced(number, tip, axis, PLAIN)
            light = needle[..., :3] + 0.2 * (1.0 - needle[..., 3:4])
            light = cv2.GaussianBlur(light, (0, 0), 0.6)
            mine = wide_pictures.exposed(light, PLAIN, np.random.default_rng(1))
            near = cv2.dilate((needle[..., 4] > 0.0).astype(np.uint8), np.ones((7, 7)))
            theirs = cv2.imread(str(cases / pair[side]))
            gaps.append(middle(red_area(theirs, near)) - middle(red_area(mine, near)))
    # two lamps, two backgrounds and two lots of noise lie between them
    assert np.abs(np.median(gaps, axis=0)).max() < 0.04
    assert np.abs(gaps).max() < 0.8


def test_the_tone_curve_is_that_of_the_standard(wide_pictures: CameraPictures) -> None:
    """IEC 61966-2-1: black, the knee, 18 % grey and white, and what lies half way."""
    light = np.array([0.0, 0.0031308, 0.18, 0.216, 0.5, 1.0])
    grey = wide_pictures._tone[np.rint(65535.0 * light).astype(int)]
    assert grey.tolist() == [0, 10, 118, 128, 188, 255]


def test_noise_is_that_of_counted_photons(wide_pictures: CameraPictures) -> None:
    linear = CameraPictures(CAMERAS / "wide.yaml", tone="linear")
    for level, stops in ((0.5, 0.0), (0.2, 0.0), (0.3, 3.0)):
        look = Look(**{**PLAIN.__dict__, "stops": stops})
        seen = linear.exposed(np.full((200, 200, 3), level), look, np.random.default_rng(2))
        well = FULL_WELL * 2.0**-stops
        expected = 255.0 * np.sqrt(level * well + 64.0) / well
        assert seen.mean() == pytest.approx(255.0 * level, abs=0.2)
        assert seen.std() == pytest.approx(np.hypot(expected, 12**-0.5), rel=0.02)


@pytest.mark.long("statistics")
def test_defocus_and_motion_spread_a_point_as_they_say() -> None:
    kernel = disc(1.5)
    at = np.arange(len(kernel)) - len(kernel) // 2
    assert (kernel.sum(axis=0) * at**2).sum() == pytest.approx(1.5**2 / 4.0, abs=0.03)
    pictures, rng = CameraPictures(CAMERAS / "wide.yaml"), np.random.default_rng(3)
    tip, axis = pictures.place(rng)
    still = pictures.traced(0, tip, axis, PLAIN)[..., 4]
    for shift in ([3.0, 0.0], [0.0, 3.0]):
        look = Look(**{**PLAIN.__dict__, "shift": np.array(shift)})
        moved = pictures.traced(0, tip, axis, look)[..., 4]
        assert middle(moved) == pytest.approx(middle(still), abs=0.02)
        grown = spread(moved) - spread(still)
        assert grown == pytest.approx(np.array(shift) ** 2 / 12.0, abs=0.06)


def spread(weight: np.ndarray) -> np.ndarray:
    v, u = np.mgrid[: weight.shape[0], : weight.shape[1]]
    about = middle(weight)
    squares = [((a - m) ** 2 * weight).sum() for a, m in ((u, about[0]), (v, about[1]))]
    return np.array(squares) / weight.sum()


@pytest.mark.long("statistics")
def test_as_much_of_the_band_is_covered_as_is_asked(wide_pictures: CameraPictures) -> None:
    for seed in range(6):
        rng = np.random.default_rng(seed)
        tip, axis = wide_pictures.place(rng)
        band = wide_pictures.traced(0, tip, axis, PLAIN)[..., 4]
        share, side = rng.uniform(0.1, 0.3), ("an end", "a side")[seed % 2]
        along = wide_pictures.eyes[0].project(np.stack([tip - 0.01 * axis, tip]))
        through = []
        for behind in (0.0, 1.0):
            light, again = np.full((*band.shape, 3), behind), np.random.default_rng(seed)
            cover(light, band, along[1] - along[0], share, side, again)
            through.append(light[..., 0])
        left = ((through[1] - through[0]) * band).sum() / band.sum()
        assert 1.0 - left == pytest.approx(share, abs=0.002)


@pytest.mark.long("statistics")
def test_a_pair_is_the_same_by_its_seed_and_number(wide_pictures: CameraPictures) -> None:
    def made(count: int, seed: int) -> PicturePair:
        return list(wide_pictures.pairs(count, seed, ("clean", "occlude")))[1]

    first, second, other = made(2, 7), made(3, 7), made(2, 8)
    assert np.array_equal(first.left, second.left)
    assert np.array_equal(first.tip, second.tip)
    assert not np.array_equal(first.left, other.left)
    assert set(KINDS) >= {first.kind}


def test_jpeg_halves_the_chroma_it_is_asked_to() -> None:
    picture = np.zeros((64, 64, 3), np.uint8)
    picture[:, ::2] = (40, 40, 200)
    picture[:, 1::2] = (200, 40, 40)
    full, across, both = (delivered_as(picture, f"q100-{c}") for c in ("444", "422", "420"))
    gaps = [np.abs(one.astype(int) - picture).mean() for one in (full, across, both)]
    assert gaps[0] < 2.0 < 20.0 < gaps[1]  # columns of colour survive in 4:4:4 alone
    turned = np.ascontiguousarray(picture.transpose(1, 0, 2))
    rows = np.abs(delivered_as(turned, "q100-422").astype(int) - turned).mean()
    assert rows < 2.0 < 20.0 < gaps[2]  # rows of colour survive in 4:2:2 too
