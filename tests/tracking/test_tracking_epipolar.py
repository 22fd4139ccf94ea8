"""Epipolar curves through the cameras with their distortion, and what people look at."""

import numpy as np
import pytest
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.transform import RigidTransform
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.errors import TrackingError
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import RigProfile
from app.tracking.stereo.epipolar import epipolar_curve
from app.tracking.tracker import Tracker


def distance_to_curve(pixel: ArrayLike, curve: FloatArray) -> float | None:
    """Distance [px] of a pixel from a curve of points, shape (n, 2); None for fewer than two."""
    if len(curve) < 2:
        return None
    point, steps = np.asarray(pixel, dtype=np.float64), np.diff(curve, axis=0)
    lengths = np.maximum(np.sum(steps**2, axis=1), 1e-12)
    share = np.clip(np.sum((point - curve[:-1]) * steps, axis=1) / lengths, 0.0, 1.0)
    nearest = curve[:-1] + share[:, None] * steps
    return float(np.min(np.linalg.norm(point - nearest, axis=1)))


def test_every_point_lies_on_the_curve_of_its_pixel(wide: RigProfile, thesis: RigProfile) -> None:
    rng = np.random.default_rng(2)
    seen = 0
    for rig in (wide, thesis):
        left, right = rig.models
        for point in np.array([0.0, 0.16, 0.03]) + rng.uniform(-0.05, 0.05, (40, 3)):
            pixels = left.pixel(point), right.pixel(point)
            if pixels[0] is None or pixels[1] is None:
                continue
            for one, other, a, b in (
                (left, right, pixels[0], pixels[1]),
                (right, left, pixels[1], pixels[0]),
            ):
                if not other.sees(point[None])[0] or not one.sees(point[None])[0]:
                    continue
                distance = distance_to_curve(b, epipolar_curve(one, a, other))
                assert distance is not None
                assert distance < 0.02
                seen += 1
    assert seen > 60


def test_strong_distortion_bends_the_curve() -> None:
    pose = RigidTransform.from_translation([0.2, 0.0, 0.0])
    intrinsics, flat = np.array([600.0, 600.0, 319.5, 239.5]), np.zeros(5)
    bent = np.array([-0.35, 0.1, 0.0, 0.0, 0.0])
    here = CameraModel("a", intrinsics, flat, (640, 480), RigidTransform.identity())
    for distortion, straight in ((flat, True), (bent, False)):
        there = CameraModel("b", intrinsics, distortion, (640, 480), pose)
        curve = epipolar_curve(here, [320.0, 60.0], there)
        sag = distance_to_curve(curve[len(curve) // 2], curve[[0, -1]])
        assert sag is not None
        assert (sag < 1e-6) == straight


def test_the_curve_stays_inside_the_picture(wide: RigProfile) -> None:
    left, right = wide.models
    curve = epipolar_curve(left, [320.0, 240.0], right)
    assert len(curve) > 30
    assert (curve >= -0.5).all()
    assert (curve <= np.array(right.image_size) - 0.5).all()
    assert np.linalg.norm(np.diff(curve, axis=0), axis=1).max() < 25.0


@pytest.mark.parametrize("pixel", [(np.nan, 0.0), (np.inf, 0.0), (1e9, 1e9)])
def test_a_pixel_without_a_ray_has_no_curve(wide: RigProfile, pixel: tuple[float, float]) -> None:
    left, right = wide.models
    assert epipolar_curve(left, pixel, right).shape[1] == 2


def test_cameras_in_one_place_have_no_curve(wide: RigProfile) -> None:
    left = wide.models[0]
    assert len(epipolar_curve(left, [300.0, 200.0], left)) == 0


class _Still(Camera):
    """Gives nothing; the tracker is stepped by hand."""

    def open(self) -> None:
        pass

    def read(self) -> CameraFrame:
        raise AssertionError

    def close(self) -> None:
        pass


def test_an_inspection_shows_marker_curve_mask_and_region(wide, wide_renderers, scene_at) -> None:
    scene = scene_at(0.06, 10.0, 40.0)
    tracker = Tracker(
        [_Still(), _Still()], wide, VirtualClock(), lambda _: scene.axis_world,
        np.array([0.0, 0.16056, 0.090]),
    )  # fmt: skip
    frames = [CameraFrame(renderer.render(scene), 0.0) for renderer in wide_renderers]
    fix = tracker.process(frames[0], frames[1])
    tracker.latest.publish(fix, 0.0)
    plain, full = tracker.inspect(), tracker.inspect(masks=True)
    assert full.radius == pytest.approx(fix.radius())
    assert [one.mask is None for one in plain.pictures] == [True, True]
    for one in full.pictures:
        assert one.why == ""
        pixel = one.picture.pixel
        assert pixel is not None
        # The outline's centroid is not the band's centre: a pixel at most.
        assert distance_to_curve(pixel, one.epipolar) < 1.5
        assert one.mask is not None
        column, row = np.rint(pixel).astype(int)
        assert one.mask[row, column] == 1
        assert one.region is not None
        assert one.region[0] < pixel[0] < one.region[2]


def test_a_click_teaches_the_marker_s_colour_and_one_beside_it_is_refused(
    wide, wide_renderers, scene_at
) -> None:
    scene = scene_at(0.06, 10.0, 40.0)
    tracker = Tracker(
        [_Still(), _Still()], wide, VirtualClock(), lambda _: scene.axis_world,
        np.array([0.0, 0.16056, 0.090]),
    )  # fmt: skip
    with pytest.raises(TrackingError, match="has given no picture"):
        tracker.learn_colour("left", np.zeros(2))
    frames = [CameraFrame(renderer.render(scene), 0.0) for renderer in wide_renderers]
    tracker.process(*frames)
    before, pixel = tracker.extractors, tracker.pictures()[0].pixel
    with pytest.raises(TrackingError, match="grey"):
        tracker.learn_colour("left", pixel + [120.0, 0.0])
    assert tracker.extractors is before
    tracker.learn_colour("left", pixel)
    assert tracker.extractors is not before
    later = [CameraFrame(renderer.render(scene), 0.1) for renderer in wide_renderers]
    assert tracker.process(*later).usable


def test_an_inspection_says_why_there_is_no_marker(wide) -> None:
    tracker = Tracker([_Still(), _Still()], wide, VirtualClock(), lambda _: None, np.zeros(3))
    assert tracker.inspect().pictures == ()
    dark = np.zeros((480, 640, 3), dtype=np.uint8)
    tracker.process(CameraFrame(dark, 0.0), CameraFrame(dark, 0.0))
    found = tracker.inspect(masks=True)
    assert found.radius is None
    assert [one.why for one in found.pictures] == ["nothing in the marker's colour"] * 2
    assert all(len(one.epipolar) == 0 and one.region is None for one in found.pictures)
