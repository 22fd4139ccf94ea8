"""The tracker: accuracy of the tip, pairing, and cameras that fail."""

import threading
import time as real_time

import numpy as np
import pytest

from app.core.clock import SystemClock, VirtualClock
from app.tracking.agreement import SIGMAS, EpipolarGate
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.errors import CameraError, TrackingError
from app.tracking.fix import FixStatus
from app.tracking.follower import MarkerFollower
from app.tracking.markers.choice import extractors
from app.tracking.markers.extractor import Centre, MarkerFix, MissReason
from app.tracking.simulated.cameras import NeedleRenderer, SimulatedCamera
from app.tracking.simulated.picture_effects import NoiseTile, noise
from app.tracking.simulated.scene import MarkerScene
from app.tracking.solver import FixSolver
from app.tracking.tracker import Tracker

FULCRUM = np.array([0.0, 0.16056, 0.090])


def _axis(tilt, azimuth):
    across = np.sin(tilt)
    return np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])


class _Needle:
    """A needle that moves; `at(t)` its scene."""

    def __init__(self, offset, depth=0.05, speed=0.0, tilt=0.3, azimuth=0.8):
        self.offset, self.depth, self.speed = offset, depth, speed
        self.axis = _axis(tilt, azimuth)
        self.visible = True

    def tip(self, t):
        return FULCRUM + (self.depth + self.speed * t) * self.axis

    def at(self, t):
        scene = MarkerScene.from_tip(self.tip(t), self.axis, self.offset)
        return MarkerScene(scene.p_world, scene.axis_world, self.visible)


def _cameras(renderers, rig, scene, clock, skew=0.0):
    cameras = []
    for i, renderer in enumerate(renderers):
        tile = NoiseTile.make((640, 480), rig.noise_grey, 50 + i)
        cameras.append(
            SimulatedCamera(
                renderer, scene, clock, rig.rate_hz, 0.0, i * skew, [(noise, tile)], seed=i
            )
        )
    return cameras


@pytest.fixture
def needle(wide):
    return _Needle(wide.needle.marker_offset)


def _stepped(wide, renderers, needle, skew=0.0, **options):
    clock = VirtualClock()
    cameras = _cameras(renderers, wide, needle.at, clock, skew)
    for camera in cameras:
        camera.open()
    tracker = Tracker(
        cameras, wide, clock, options.pop("axis", lambda t: needle.axis), FULCRUM, **options
    )
    return tracker, cameras


@pytest.mark.long("statistics")
def test_the_tip_is_within_its_figure_over_the_whole_range(wide, wide_renderers):
    rng = np.random.default_rng(6)
    tile = NoiseTile.make((640, 480), wide.noise_grey, 1)
    errors, valid = [], 0
    for _ in range(40):
        needle = _Needle(
            wide.needle.marker_offset,
            rng.uniform(-0.03, 0.12),
            0.0,
            np.deg2rad(rng.uniform(0, 39)),
            rng.uniform(0, 6.28),
        )
        tracker, _ = _stepped(wide, wide_renderers, needle)
        frames = [
            CameraFrame(noise(r.render(needle.at(0.0)), tile, rng), 0.0) for r in wide_renderers
        ]
        fix = tracker.process(*frames)
        valid += fix.status is FixStatus.VALID
        errors.append(np.linalg.norm(fix.p_tip_world - needle.tip(0.0)))
        assert abs(fix.depth - needle.depth) < 0.5e-3
    assert np.sqrt(np.mean(np.square(errors))) < 0.15e-3
    assert valid >= 38


@pytest.mark.long("statistics")
def test_a_search_fits_the_band_whose_outlines_lie_off_each_others_epipolar_line(wide):
    # where the needle leans, outlines of large pictures miss the line by more than the gate allows
    larger = [
        camera.model_dump()
        | {
            "image_size": (1280, 720),
            "focal_px": tuple(1.5 * focal for focal in camera.focal_px),
            "centre_px": (639.5, 359.5),
        }
        for camera in wide.cameras
    ]
    rig = type(wide).model_validate(wide.model_dump() | {"cameras": larger})
    renderers = [NeedleRenderer(m, rig.needle, rig.blur_px, i) for i, m in enumerate(rig.models)]
    rng, tile = np.random.default_rng(4), NoiseTile.make((1280, 720), rig.noise_grey, 3)
    gate, outlines, apart = EpipolarGate(rig), extractors(rig), []
    for azimuth in np.linspace(0.0, 5.0, 6):
        needle = _Needle(rig.needle.marker_offset, 0.06, 0.0, 0.6, azimuth)
        tracker, _ = _stepped(rig, renderers, needle)
        frames = [CameraFrame(noise(r.render(needle.at(0.0)), tile, rng), 0.0) for r in renderers]
        left, right = (o.search(f.image)[:1] for o, f in zip(outlines, frames, strict=True))
        apart.append(gate.pairings([*left], [*right], 0.0)[0].apart)
        fix = tracker.process(*frames)
        assert fix.status is FixStatus.VALID
        assert all(picture.found.centre is Centre.BAND for picture in tracker.pictures())
    assert max(apart) > SIGMAS


@pytest.mark.long("statistics")
def test_the_stated_radius_is_of_the_size_of_the_error(wide, wide_renderers):
    # over places: what the background does to the fit is the same in all pictures of one place
    rng, tile = np.random.default_rng(6), NoiseTile.make((640, 480), 4.0, 9)
    errors, radii = [], []
    for _ in range(40):
        tilt, azimuth = np.deg2rad(rng.uniform(0, 39)), rng.uniform(0, 6.28)
        depth = rng.uniform(-0.03, 0.12)
        needle = _Needle(wide.needle.marker_offset, depth, 0.0, tilt, azimuth)
        tracker, _ = _stepped(wide, wide_renderers, needle)
        frames = [
            CameraFrame(noise(r.render(needle.at(0.0)), tile, rng), 0.0) for r in wide_renderers
        ]
        fix = tracker.process(*frames)
        if fix.status is FixStatus.VALID:
            errors.append(np.linalg.norm(fix.p_tip_world - needle.tip(0.0)))
            radii.append(fix.radius())
    assert len(errors) >= 38
    assert (np.array(errors) < radii).mean() >= 0.9
    assert np.median(radii) < 0.1e-3


@pytest.mark.long("statistics")
def test_skewed_cameras_are_brought_to_one_time(wide, wide_renderers):
    needle = _Needle(wide.needle.marker_offset, depth=0.01, speed=0.08)
    tracker, cameras = _stepped(wide, wide_renderers, needle, skew=0.015)
    fixes = [tracker.process(cameras[0].read(), cameras[1].read()) for _ in range(12)]
    errors = [np.linalg.norm(fix.p_tip_world - needle.tip(fix.time)) for fix in fixes[2:]]
    assert max(errors) < 0.3e-3  # 0.015 s at 0.08 m/s would be 1.2 mm
    assert all(fix.status is FixStatus.VALID for fix in fixes[2:])


def test_a_needle_out_of_view_is_reported_with_the_camera_that_misses_it(
    wide, wide_renderers, needle
):
    tracker, cameras = _stepped(wide, wide_renderers, needle)
    left, right = cameras[0].read(), cameras[1].read()
    assert tracker.process(left, right).status is FixStatus.VALID
    needle.visible = False
    gone_left, gone_right = cameras[0].read(), cameras[1].read()
    fix = tracker.process(gone_left, gone_right)
    assert fix.status is FixStatus.OUT_OF_VIEW
    assert fix.missing == ("left", "right")
    left, right = (CameraFrame(f.image, gone_right.time) for f in (left, right))
    fix = tracker.process(left, gone_right)
    assert fix.status is FixStatus.ONE_CAMERA
    assert fix.missing == ("right",)
    assert "right" in fix.reason
    assert fix.usable
    assert abs(fix.depth - needle.depth) < 4.0 * np.sqrt(fix.depth_variance)
    assert tracker.process(left, right).status is FixStatus.VALID


@pytest.mark.long("statistics")
@pytest.mark.promise("docs/tracking.md: *inconsistent*, never a fix")
def test_a_wrong_axis_makes_the_fix_inconsistent(wide, wide_renderers, needle):
    tracker, cameras = _stepped(wide, wide_renderers, needle, axis=lambda t: _axis(0.5, 2.0))
    fix = tracker.process(cameras[0].read(), cameras[1].read())
    assert fix.status is FixStatus.INCONSISTENT
    assert "beside" in fix.reason


def test_without_an_axis_there_is_no_tip(wide, wide_renderers, needle):
    tracker, cameras = _stepped(wide, wide_renderers, needle, axis=lambda t: None)
    assert tracker.process(cameras[0].read(), cameras[1].read()).status is FixStatus.NO_ORIENTATION


def test_of_two_red_things_the_one_on_the_needle_is_taken(wide, wide_renderers, needle):
    tracker, _ = _stepped(wide, wide_renderers, needle)
    images = [renderer.render(needle.at(0.0)) for renderer in wide_renderers]
    for image in images:
        image[60:85, 500:512] = (40, 25, 190)
    fix = tracker.process(*(CameraFrame(image, 0.0) for image in images))
    assert fix.status is FixStatus.VALID
    assert np.linalg.norm(fix.p_tip_world - needle.tip(0.0)) < 0.3e-3


def _red(image, top, left):
    image[top : top + 25, left : left + 12] = (40, 25, 190)


def _find(wide, tracker, images, times=(0.0, 0.0), axis=None):
    gate = EpipolarGate(wide)
    follower = MarkerFollower(tracker.extractors, FixSolver(wide, FULCRUM), gate)
    frames = tuple(CameraFrame(image, time) for image, time in zip(images, times, strict=True))
    return follower.find(frames, axis, min(times))


def test_of_two_red_things_the_one_on_the_epipolar_line_is_taken_even_without_an_axis(
    wide, wide_renderers, needle
):
    tracker, _ = _stepped(wide, wide_renderers, needle)
    scene = needle.at(0.0)
    images = [renderer.render(scene) for renderer in wide_renderers]
    for i, (top, left) in enumerate([(60, 500), (400, 80)]):
        _red(images[i], top, left)
    searched = tracker.extractors[0].search(images[0])
    assert sum(isinstance(one, MarkerFix) for one in searched) == 2
    found = _find(wide, tracker, images)
    for marker, model in zip(found, wide.models, strict=True):
        assert isinstance(marker, MarkerFix)
        assert np.linalg.norm(marker.uv - model.pixel(scene.p_world)) < 1.5


def test_red_things_off_each_others_epipolar_line_are_no_marker_and_it_is_said(
    wide, wide_renderers, needle
):
    needle.visible = False
    tracker, _ = _stepped(wide, wide_renderers, needle)
    images = [renderer.render(needle.at(0.0)) for renderer in wide_renderers]
    _red(images[0], 60, 500)
    _red(images[1], 400, 80)
    fix = tracker.process(*(CameraFrame(image, 0.0) for image in images))
    assert fix.status is FixStatus.OUT_OF_VIEW
    for picture in tracker.pictures():
        assert picture.found.reason is MissReason.OFF_EPIPOLAR
    shown = tracker.inspect()
    assert [one.why for one in shown.pictures] == [MissReason.OFF_EPIPOLAR.words] * 2


def test_a_followed_marker_goes_on_when_the_other_picture_shows_only_something_else_red(
    wide, wide_renderers, needle
):
    tracker, _ = _stepped(wide, wide_renderers, needle)
    images = [renderer.render(needle.at(0.0)) for renderer in wide_renderers]
    assert tracker.process(*(CameraFrame(image, 0.0) for image in images)).status is FixStatus.VALID
    needle.visible = False
    images[1] = wide_renderers[1].render(needle.at(0.0))
    _red(images[1], 400, 80)
    fix = tracker.process(*(CameraFrame(image, 0.033) for image in images))
    assert fix.status is FixStatus.ONE_CAMERA
    assert fix.usable
    assert tracker.pictures()[1].found.reason is MissReason.OFF_EPIPOLAR


def test_a_marker_that_moves_between_the_captures_is_not_taken_for_two_things(wide, wide_renderers):
    needle = _Needle(wide.needle.marker_offset, speed=0.2, tilt=0.6, azimuth=1.5)
    tracker, _ = _stepped(wide, wide_renderers, needle)
    times = (0.0, 0.033)
    images = [r.render(needle.at(t)) for r, t in zip(wide_renderers, times, strict=True)]
    found = _find(wide, tracker, images, times)
    assert all(isinstance(one, MarkerFix) for one in found)
    gate = EpipolarGate(wide)
    (moved,) = gate.pairings([found[0]], [found[1]], 0.033)
    (still,) = gate.pairings([found[0]], [found[1]], 0.0)
    assert moved.agrees
    assert still.apart > moved.apart


def test_noise_is_refused_by_the_epipolar_gate_as_seldom_as_its_sigma_says(wide, scene_at):
    gate, rng = EpipolarGate(wide), np.random.default_rng(4)
    scene, apart = scene_at(0.06, 20.0, 30.0), []
    for _ in range(1500):
        fixes = []
        for model in wide.models:
            spread = np.array([[0.2, 0.05], [0.05, 0.1]])
            total = spread + wide.systematic_px**2 * np.eye(2)
            uv = rng.multivariate_normal(model.pixel(scene.p_world), total)
            fixes.append(MarkerFix(uv, spread, 400.0, 1.0, Centre.BAND))
        apart.append(gate.pairings([fixes[0]], [fixes[1]], 0.0)[0].apart)
    assert np.mean(np.square(apart)) == pytest.approx(1.0, abs=0.12)


def test_a_step_without_any_picture_is_an_error(wide, wide_renderers, needle):
    tracker, cameras = _stepped(wide, wide_renderers, needle)
    with pytest.raises(TrackingError):
        tracker.process(None, None)
    with pytest.raises(TrackingError, match="two cameras"):
        Tracker(cameras[:1], wide, VirtualClock(), lambda t: None, FULCRUM)


def test_a_simulated_camera_must_be_open_and_repeats_its_pictures(wide, wide_renderers, needle):
    def first_pictures():
        camera = _cameras(wide_renderers, wide, needle.at, VirtualClock())[0]
        with pytest.raises(CameraError, match="open"):
            camera.read()
        camera.open()
        return camera.read(), camera.read()

    one, two = first_pictures(), first_pictures()
    assert one[1].time - one[0].time == pytest.approx(1.0 / 30.0)
    assert not one[0].image.flags.writeable
    for first, second in zip(one, two, strict=True):
        assert np.array_equal(first.image, second.image)
    assert not np.array_equal(one[0].image, one[1].image)


class _StillCamera(Camera):
    """Hands out prepared pictures at 30 Hz, and can be told to misbehave."""

    def __init__(self, picture):
        self.picture, self.mode = picture, "live"
        self.opened = self.closed = 0
        self._rng = np.random.default_rng(0)
        self._last = None
        self.released = threading.Event()

    def open(self):
        self.opened += 1
        if self.mode == "missing":
            raise CameraError("camera is not there")

    def read(self):
        real_time.sleep(0.033)
        if self.mode == "hang":
            self.released.wait(3.0)
            raise CameraError("no picture came")
        if self.mode == "error":
            raise OSError("unplugged")
        if self.mode == "live" or self._last is None:
            self._last = self.picture.copy()
            self._last[::16, ::16, 0] ^= self._rng.integers(0, 4, (30, 40)).astype(np.uint8)
        return CameraFrame(self._last.copy(), real_time.monotonic())

    def close(self):
        self.closed += 1
        self.released.set()


@pytest.fixture
def running(wide, wide_renderers, needle):
    cameras = [_StillCamera(renderer.render(needle.at(0.0))) for renderer in wide_renderers]
    fixes = []
    tracker = Tracker(
        cameras, wide, SystemClock(), lambda t: needle.axis, FULCRUM, on_fix=fixes.append
    )
    yield tracker, cameras, fixes
    tracker.close()


def _until(condition, seconds=30.0):
    end = real_time.monotonic() + seconds
    while not condition():
        assert real_time.monotonic() < end, "it did not happen"
        real_time.sleep(0.01)


def _faults(tracker, text, found):
    found.extend(
        event.message for event in tracker.events.drain() if event.kind in ("camera", "fault")
    )
    return any(text in message for message in found)


def test_the_thread_publishes_fixes_pictures_and_figures_and_closes_twice(running):
    tracker, cameras, fixes = running
    tracker.open()
    tracker.open()
    _until(lambda: len(fixes) >= 5)
    latest = tracker.latest.read()
    assert latest.value.status is FixStatus.VALID
    assert latest.time == latest.value.time
    figures = tracker.statistics()
    assert figures.counts["valid"] >= 5
    assert figures.valid_share > 0.5
    assert figures.status is FixStatus.VALID
    pictures = tracker.pictures()
    assert [picture.name for picture in pictures] == ["left", "right"]
    assert not pictures[0].image.flags.writeable
    assert pictures[0].pixel is not None
    tracker.close()
    tracker.close()
    count = len(fixes)
    real_time.sleep(0.1)
    assert len(fixes) == count
    assert all(camera.closed for camera in cameras)


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("mode", "text"), [("hang", "no picture"), ("frozen", "change"), ("error", "unplugged")]
)
def test_a_camera_that_hangs_freezes_or_fails_is_noticed_and_the_other_goes_on(running, mode, text):
    tracker, cameras, fixes = running
    tracker.open()
    _until(lambda: len(fixes) >= 3)
    cameras[1].mode = mode
    found = []
    _until(lambda: _faults(tracker, text, found))
    _until(lambda: fixes[-1].status is FixStatus.ONE_CAMERA)
    assert fixes[-1].usable
    assert fixes[-1].missing == ("right",)
    assert text in tracker.statistics().reason
    if mode == "frozen":
        cameras[1].mode = "live"
        _until(lambda: fixes[-1].status is FixStatus.VALID)


def test_a_camera_that_is_not_there_is_an_error_and_the_other_is_closed(running):
    tracker, cameras, _ = running
    cameras[1].mode = "missing"
    with pytest.raises(CameraError, match="not there"):
        tracker.open()
    assert cameras[0].closed == 1


def test_an_error_in_the_thread_becomes_a_fault_and_the_tracker_goes_on(
    wide, wide_renderers, needle
):
    cameras = [_StillCamera(renderer.render(needle.at(0.0))) for renderer in wide_renderers]
    fixes = []

    def axis(t):
        if len(fixes) == 2 and not found:
            raise ValueError("encoder table lost")
        return needle.axis

    found = []
    tracker = Tracker(cameras, wide, SystemClock(), axis, FULCRUM, on_fix=fixes.append)
    tracker.open()
    try:
        _until(lambda: _faults(tracker, "encoder table lost", found))
        _until(lambda: len(fixes) > 3)
        assert tracker.statistics().fault == ""
    finally:
        tracker.close()
