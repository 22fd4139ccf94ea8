"""Following the pen: what is kept from picture to picture changes the time, never the answer."""

import numpy as np
import pytest

from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import FixStatus
from app.tracking.pen.step import FULL_EVERY, STILL_PX, Stillness
from tests.tracking.pen_rig import camera, picture, renderer, scene, step

MODEL = camera()
RATE = 15.0


@pytest.fixture(scope="module")
def draw():
    return renderer(MODEL)


def frames(draw, scenes, start=1.0):
    return [
        picture(draw, what, seed=i, time=start + i / RATE) for i, (what, _) in enumerate(scenes)
    ]


def moving(count=14):
    turns = np.linspace(0.0, 1.0, count)
    return [scene((0.15 + 0.1 * s, 0.1), depth=0.06 * s, roll=0.4 + 0.3 * s) for s in turns]


def searches(known):
    """Whether each picture was searched as a whole, as it goes on."""
    told, detector = [], known._detector
    find = detector.find

    def counted(*values, region=None, **others):
        told.append(region is None)
        return find(*values, region=region, **others)

    detector.find = counted
    return told


@pytest.mark.long("statistics")
def test_a_followed_pen_is_found_as_one_that_is_searched_for_in_every_picture(draw):
    known = step(MODEL)
    told = searches(known)
    for frame, (what, _) in zip(frames(draw, moving()), moving(), strict=True):
        followed, alone = known.observe(frame).needle, step(MODEL).observe(frame).needle
        assert np.linalg.norm(followed.p_tip - alone.p_tip) < 0.5 * alone.tip_radius()
        assert np.linalg.norm(followed.p_tip - what.p_tip) < followed.tip_radius()
        np.testing.assert_allclose(followed.covariance, alone.covariance, rtol=0.2, atol=1e-8)
    assert sum(told) <= 1 + len(told) // FULL_EVERY + 1


def test_a_pen_that_jumps_out_of_the_region_is_found_in_the_same_picture(draw):
    here, there = scene((0.15, 0.1), roll=0.4), scene((-0.3, -0.2), depth=-0.05, roll=1.9)
    known = step(MODEL)
    for frame, (what, _) in zip(
        frames(draw, [here, here, there]), [here, here, there], strict=True
    ):
        seen = known.observe(frame)
        assert seen.fix.status is FixStatus.VALID
        assert np.linalg.norm(seen.needle.p_tip - what.p_tip) < seen.needle.tip_radius()


def test_a_webcam_that_is_pushed_is_noticed_in_the_next_picture(draw):
    what, _ = scene()
    pushed = camera(position_mm=(62, 560, 380))
    first, second = frames(draw, [scene()] * 2)
    third = picture(renderer(pushed), what, seed=7, time=1.0 + 2 / RATE)
    known = step(MODEL)
    told = searches(known)
    for frame in (first, second, third):
        seen = known.observe(frame)
        assert np.linalg.norm(seen.needle.p_tip - what.p_tip) < seen.needle.tip_radius()
    assert told == [True, False, True]


def test_a_second_cube_is_named_within_a_third_of_a_second(draw):
    known, what = step(MODEL), scene()
    for number, frame in enumerate(frames(draw, [what] * (FULL_EVERY + 3))):
        image = frame.image.copy()
        if number >= 2:
            image[20:120, 20:140] = image[75:175, 280:400]
        seen = known.observe(CameraFrame(image, frame.time))
        if seen.fix.status is not FixStatus.VALID:
            break
    assert "twice" in seen.fix.reason
    assert number <= FULL_EVERY


@pytest.mark.parametrize("times", [(1.0, 1.0), (1.0, 0.9), (1.0, 2.0)])
def test_what_was_seen_at_another_time_is_not_used(draw, times):
    known = step(MODEL)
    told = searches(known)
    for seed, time in enumerate(times):
        known.observe(picture(draw, scene()[0], seed, time=time))
    assert told == [True, True]


@pytest.mark.parametrize("shift", [0.0, 0.1, 0.4])
def test_the_shift_of_a_picture_is_told_to_a_fifth_or_to_what_counts_as_still(draw, shift):
    what, _ = scene()
    here, there = camera(), camera()
    there = type(there)(
        "x", there.intrinsics + [0, 0, shift, 0], there.distortion, there.image_size,
        there.T_world_camera,
    )  # fmt: skip
    first = picture(draw, what, 1).image[..., 0]
    second = picture(renderer(there), what, 2).image[..., 0]
    corners = np.concatenate(
        [
            m.corners
            for m in step(here).observe(picture(draw, what, 1)).sightings.markers
            if m.id >= 20
        ]
    )
    assert Stillness(first, corners).moved(second) == pytest.approx(
        shift, abs=0.4 * STILL_PX, rel=0.25
    )


def test_without_enough_patches_the_webcam_counts_as_moved():
    grey = np.full((480, 640), 120, np.uint8)
    assert Stillness(grey, np.array([[100.0, 100.0]] * 8)).moved(grey) == np.inf
    assert Stillness(grey, np.array([[-5.0, 700.0]])).moved(grey) == np.inf
