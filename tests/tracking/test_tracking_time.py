"""Cameras that are not synchronised, capture times that run backwards, and filters of the depth."""

import numpy as np
import pytest

from app.core.clock import VirtualClock
from app.studies.depth_motion import Hold, OneEuro
from app.tracking.agreement import EpipolarGate
from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import FixStatus
from app.tracking.follower import MarkerFollower
from app.tracking.markers.extractor import Centre, Extractor, MarkerFix
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.motion.depth_filter import ConstantVelocity
from app.tracking.solver import FixSolver
from app.tracking.track import PixelTrack
from app.tracking.tracker import Tracker

FULCRUM = np.array([0.0, 0.16056, 0.090])
PERIOD = 1.0 / 30.0
BLANK = np.zeros((480, 640, 3), dtype=np.uint8)


def _axis(t):
    tilt, azimuth = 0.3 + 0.02 * np.sin(2.0 * t), 0.8
    across = np.sin(tilt)
    return np.array([across * np.cos(azimuth), across * np.sin(azimuth), -np.cos(tilt)])


def _constant(t):
    return 0.02 + 0.05 * t


def _back_and_forth(t):
    """50 mm/s at the fastest, 0.31 m/s² of acceleration."""
    return 0.05 + 0.008 * np.sin(2.0 * np.pi * t)


class _Exact(Extractor):
    """Knows where the band is in a picture taken at `time`."""

    def __init__(self, rig, camera, depth):
        self.rig, self.model, self.depth, self.time = rig, rig.models[camera], depth, 0.0

    def find(self, image, hint):
        axis = _axis(self.time)
        band = FULCRUM + (self.depth(self.time) - self.rig.needle.marker_offset) * axis
        uv = self.model.pixel(band) + centroid_shift(self.model, self.rig.needle.shape, band, axis)
        return MarkerFix(uv, 1e-4 * np.eye(2), 400.0, 1.0)

    def search(self, image):
        return (self.find(image, None),)

    def mask(self, image):
        return image[..., 0]


def _errors(rig, depth, skew, interpolate=True):
    """Distances [m] between fixes and truth over one second; the first pair has no past."""
    extractors = tuple(_Exact(rig, i, depth) for i in (0, 1))
    solver = FixSolver(rig, FULCRUM)
    follower, errors = MarkerFollower(extractors, solver, EpipolarGate(rig)), []
    for k in range(31):
        times = (k * PERIOD, k * PERIOD + skew)
        for extractor, time in zip(extractors, times, strict=True):
            extractor.time = time
        frames = tuple(CameraFrame(BLANK, time) for time in times)
        now = times[0]
        markers = follower.find(frames, _axis(now), now)
        frames = frames if interpolate else (frames[0], CameraFrame(BLANK, now))
        sightings = follower.sightings(frames, markers, now)
        fix = solver.solve(sightings, _axis(now), now)
        if k:
            assert fix.has_point
            errors.append(np.linalg.norm(fix.p_tip_world - FULCRUM - depth(now) * _axis(now)))
    return np.array(errors)


@pytest.mark.parametrize("depth", [_constant, _back_and_forth])
def test_at_50_mm_per_second_skewed_cameras_add_less_than_150_micrometres(wide, depth):
    skews = np.linspace(0.0, 0.033, 12)
    added = np.concatenate([_errors(wide, depth, skew) for skew in skews])
    assert np.sqrt(np.mean(added**2)) < 0.15e-3
    assert added.max() < 0.3e-3


def test_without_interpolation_the_same_motion_is_off_by_more_than_half_a_millimetre(wide):
    skews = np.linspace(0.0, 0.033, 12)
    raw = np.concatenate([_errors(wide, _constant, skew, interpolate=False) for skew in skews])
    assert 0.5e-3 < np.sqrt(np.mean(raw**2)) < 1.2e-3


def test_a_find_that_cannot_be_brought_to_the_time_says_how_unsure_it_is():
    track, spread = PixelTrack(), 1e-4 * np.eye(2)
    marker = MarkerFix(np.array([100.0, 50.0]), spread, 400.0, 1.0, Centre.BAND)
    track.add(1.0, marker)
    for dt in (0.0, 0.01, 0.03):
        seen = track.at(1.0 - dt)
        assert np.sqrt(seen.covariance[0, 0]) == pytest.approx(np.hypot(0.01, 150.0 * dt))
    track.add(1.0, marker)  # a repeated picture begins anew: no speed of 0 / 0
    assert np.isfinite(track.predict(1.02)).all()
    track.add(0.5, marker)
    np.testing.assert_array_equal(track.predict(0.52), marker.uv)


class _Still:
    def __init__(self):
        self.may_repeat = True


def _tracker(rig):
    extractors = tuple(_Exact(rig, i, lambda t: 0.05) for i in (0, 1))
    tracker = Tracker([_Still(), _Still()], rig, VirtualClock(), _axis, FULCRUM,
                      extractors=extractors)  # fmt: skip
    return tracker, lambda t: tracker.process(CameraFrame(BLANK, t), CameraFrame(BLANK, t))


def test_pictures_whose_times_run_backwards_are_left_out_and_told_once(wide):
    tracker, step = _tracker(wide)
    assert step(1.0).status is not FixStatus.NO_PICTURE
    for _ in range(5):
        fix = step(0.9)
        assert fix.status is FixStatus.NO_PICTURE
        assert fix.time == 1.0
        assert "backwards" in fix.reason
    told = [event.message for event in tracker.events.drain()]
    assert len(told) == 2
    assert all("left out" in message for message in told)
    assert step(1.1).status is not FixStatus.NO_PICTURE


def test_a_clock_that_was_set_back_is_followed_after_half_a_second(wide):
    _, step = _tracker(wide)
    step(1000.0)
    statuses = [step(5.0 + k * PERIOD).status for k in range(20)]
    assert statuses[0] is FixStatus.NO_PICTURE
    assert statuses[-1] is not FixStatus.NO_PICTURE


# --- filters --------------------------------------------------------------------------------------
FILTERS = (Hold, ConstantVelocity, OneEuro)


def _fed(kind, depth, noise=0.0, n=90):
    rng, filter_ = np.random.default_rng(4), kind()
    for k in range(n):
        filter_.take(k * PERIOD, depth(k * PERIOD) + rng.normal(0.0, noise), 2.5e-9)
    return filter_, (n - 1) * PERIOD


@pytest.mark.parametrize("kind", FILTERS)
def test_the_stated_lag_is_the_one_behind_a_steady_motion(kind):
    filter_, now = _fed(kind, _constant)
    behind = (_constant(now) - filter_.at(now).depth) / 0.05
    assert behind == pytest.approx(filter_.lag, abs=1e-4)
    assert filter_.lag < 0.02


@pytest.mark.parametrize("kind", FILTERS)
def test_a_resting_depth_is_not_made_worse_than_it_was_measured(kind):
    filter_, now = _fed(kind, lambda t: 0.05, noise=5e-5)
    assert abs(filter_.at(now).depth - 0.05) < 3 * 5e-5


@pytest.mark.long("statistics")
def test_the_kalman_filters_variance_holds_its_own_error_and_grows_with_the_time_ahead():
    rng, ahead, errors, variances = np.random.default_rng(8), 0.08, [], []
    for _ in range(300):
        filter_, depth, rate = ConstantVelocity(), 0.05, 0.02
        for k in range(40):
            filter_.take(k * PERIOD, depth + rng.normal(0.0, 5e-5), 2.5e-9)
            kick = rng.normal(0.0, np.sqrt(2e-4 * PERIOD))  # white noise in the acceleration
            depth, rate = depth + rate * PERIOD + 0.5 * kick * PERIOD, rate + kick
            true = depth
        seen = filter_.at(39 * PERIOD + PERIOD)
        errors.append(seen.depth - true)
        variances.append(seen.variance)
    assert (
        0.3 < np.mean(np.square(errors)) / np.mean(variances) < 1.0
    )  # surprises count for a while
    assert filter_.at(39 * PERIOD + ahead).variance > 2.0 * filter_.at(39 * PERIOD).variance


@pytest.mark.parametrize("kind", FILTERS)
def test_a_filter_survives_whatever_comes_and_forgets_after_a_gap(kind):
    filter_ = kind()
    assert filter_.at(1.0) is None
    for time, depth, variance in (
        (1.0, 0.05, 1e-9), (0.9, 0.9, 1e-9), (np.nan, 0.1, 1e-9), (1.1, np.inf, 1e-9),
        (1.1, 0.05, -1.0), (1.1, 0.05, 0.0), (1.1 + 1e-12, 0.06, 0.0),
    ):  # fmt: skip
        filter_.take(time, depth, variance)
        seen = filter_.at(1.2)
        assert np.isfinite([seen.depth, seen.rate, seen.variance]).all()
        assert abs(seen.rate) <= 0.5
    filter_.take(5.0, 0.02, 1e-9)
    assert filter_.at(5.1).depth == pytest.approx(0.02)
    assert filter_.at(5.0).rate == 0.0
