"""Two bands on the shaft: told apart, the axis and the tip from both, and one of them hidden."""

from dataclasses import replace

import numpy as np
import pytest

from app.core.clock import VirtualClock
from app.tracking.cameras.camera import CameraFrame
from app.tracking.discrepancy import DiscrepancyCause
from app.tracking.fix import FixStatus
from app.tracking.health import FixHealth
from app.tracking.markers.extractor import Miss, MissReason
from app.tracking.optics.rig import RigProfile
from app.tracking.simulated.cameras import NeedleRenderer, simulated_cameras
from app.tracking.simulated.picture_effects import NoiseTile, noise
from app.tracking.simulated.scene import MarkerScene
from app.tracking.tracker import Tracker
from app.tracking.two_bands import fits, shaft_axis, tell_apart

DOWN = np.array([0.0, 0.0, -1.0])
OFFSET, DISTANCE = 0.010, 0.030


FULCRUM = np.array([0.0, 0.16056, 0.090])
AXIS = np.array([0.2, 0.15, -0.97]) / np.linalg.norm([0.2, 0.15, -0.97])
TIP = FULCRUM + 0.06 * AXIS


@pytest.fixture(scope="module")
def rig(wide):
    """Rig `wide` with a second band 30 mm behind the first."""
    document = wide.model_dump()
    document["needle"] |= {"second_marker_offset_mm": 1e3 * (OFFSET + DISTANCE)}
    return RigProfile.model_validate(document)


@pytest.fixture(scope="module")
def renderers(rig):
    return [NeedleRenderer(m, rig.needle, rig.blur_px, i) for i, m in enumerate(rig.models)]


@pytest.fixture(scope="module")
def pictures(rig, renderers):
    """Noisy pictures of the needle at rest, both cameras, as often as asked."""
    tile, rng = NoiseTile.make((640, 480), rig.noise_grey, 3), np.random.default_rng(8)
    clean = [r.render(MarkerScene.from_tip(TIP, AXIS, OFFSET)) for r in renderers]

    def make(time=0.0, cover=None):
        images = [one.copy() for one in clean]
        if cover is not None:  # a grey finger before one band
            for image, model in zip(images, rig.models, strict=True):
                u, v = np.rint(model.pixel(cover)).astype(int)
                image[v - 16 : v + 17, u - 16 : u + 17] = 120
        return [CameraFrame(noise(image, tile, rng), time) for image in images]

    return make


def _tracker(rig, axis):
    cameras = simulated_cameras(
        rig, lambda t: MarkerScene.from_tip(TIP, AXIS, OFFSET), VirtualClock()
    )
    return Tracker(cameras, rig, VirtualClock(), lambda t: axis, FULCRUM)


def _angle(a, b):
    return np.linalg.norm(np.cross(a, b))


def _spread(rng, size, sigma):
    a = rng.normal(size=(size, size))
    return sigma**2 * (a @ a.T + np.eye(size)) / size


@pytest.mark.long("statistics")
def test_axis_and_tip_of_two_bands_have_the_covariance_that_monte_carlo_finds():
    rng = np.random.default_rng(1)
    axis = np.array([0.3, -0.2, -0.9]) / np.linalg.norm([0.3, -0.2, -0.9])
    points = np.stack([0.1 * np.ones(3), 0.1 * np.ones(3) - DISTANCE * axis])
    joint = _spread(rng, 6, 0.1e-3)  # both points' errors hang together, as a calibration's do
    exact = shaft_axis(points, joint, OFFSET)
    assert exact.axis == pytest.approx(axis)
    assert exact.p_tip == pytest.approx(points[0] + OFFSET * axis)
    drawn = rng.multivariate_normal(points.ravel(), joint, size=20000).reshape(-1, 2, 3)
    found = [shaft_axis(one, joint, OFFSET) for one in drawn]
    axes, tips = (
        np.cov([f.axis for f in found], rowvar=0),
        np.cov([f.p_tip for f in found], rowvar=0),
    )
    assert np.abs(axes - exact.axis_covariance).max() < 0.04 * np.abs(axes).max()
    assert np.abs(tips - exact.tip_covariance).max() < 0.04 * np.abs(tips).max()
    assert axis @ exact.axis_covariance @ axis == pytest.approx(0.0, abs=1e-18)


def test_points_with_one_sigma_turn_the_axis_by_root_two_sigma_over_their_distance():
    sigma = 0.05e-3
    points = np.stack([np.zeros(3), -DISTANCE * DOWN])
    found = shaft_axis(points, sigma**2 * np.eye(6), OFFSET)
    angle = np.sqrt(found.axis_covariance[0, 0])
    assert angle == pytest.approx(np.sqrt(2.0) * sigma / DISTANCE)
    across = np.sqrt(found.tip_covariance[0, 0])
    o = OFFSET / DISTANCE
    assert across == pytest.approx(sigma * np.sqrt((1.0 + o) ** 2 + o**2))


def test_bands_are_told_apart_by_their_distance_and_their_order():
    first, second = np.array([0.0, 0.1, 0.0]), np.array([0.0, 0.1, DISTANCE])
    other = np.array([0.05, 0.1, 0.07])
    assert tell_apart([other, second, first], 1e-4, DISTANCE, DOWN) == (2, 1)
    assert tell_apart([first, second], 1e-4, DISTANCE, -DOWN) == (1, 0)
    assert tell_apart([first, other], 1e-4, DISTANCE, DOWN) is None
    assert tell_apart([first], 1e-4, DISTANCE, DOWN) is None
    third = second + DISTANCE * np.array([0.0, 0.0, 1.0])
    assert tell_apart([first, second, third], 1e-4, DISTANCE, DOWN) is None  # which two?
    one = np.stack([first, first])
    assert not fits(one, 1e-8 * np.eye(6), DISTANCE)
    assert shaft_axis(one, 1e-8 * np.eye(6), OFFSET) is None


def test_a_second_band_must_leave_bare_shaft_between(rig):
    document = rig.model_dump()
    document["needle"] |= {"second_marker_offset_mm": 15.0}
    with pytest.raises(ValueError, match="must lie between"):
        RigProfile.model_validate(document)
    assert rig.needle.band_distance == pytest.approx(DISTANCE)


def test_the_first_band_is_followed_and_both_give_the_axis_with_its_error(rig, pictures):
    tracker = _tracker(rig, AXIS)
    turned = []
    for k in range(12):
        fix = tracker.process(*pictures(k / 30.0))
        assert fix.status is FixStatus.VALID
        assert np.linalg.norm(fix.p_tip_world - TIP) < 0.3e-3
        turned.append(_angle(fix.axis_world, AXIS))
    sigma = np.sqrt(0.5 * np.trace(fix.axis_covariance))
    assert np.max(turned) < 4.5 * sigma
    assert sigma < np.deg2rad(0.3)


@pytest.mark.long("statistics")
def test_without_the_robots_direction_both_bands_give_axis_and_tip(rig, pictures):
    tracker = _tracker(rig, None)
    errors = []
    for k in range(12):
        fix = tracker.process(*pictures(k / 30.0))
        assert fix.status is FixStatus.VALID
        errors.append(np.linalg.norm(fix.p_tip_world - TIP))
        assert _angle(fix.axis_world, AXIS) < np.deg2rad(1.0)
        assert fix.depth == pytest.approx(0.06, abs=0.5e-3)
    assert max(errors) < 1.3 * fix.radius(0.999)


@pytest.mark.long("statistics")
def test_with_one_band_hidden_the_robots_direction_serves_and_without_it_there_is_no_tip(
    rig, pictures
):
    first, second = TIP - OFFSET * AXIS, TIP - (OFFSET + DISTANCE) * AXIS
    tracker = _tracker(rig, AXIS)
    assert tracker.process(*pictures(0.0)).axis_world is not None
    fix = tracker.process(*pictures(0.033, cover=second))
    assert fix.status is FixStatus.VALID
    assert fix.axis_world is None
    for hidden in (first, second):
        fix = _tracker(rig, None).process(*pictures(cover=hidden))
        assert fix.status is FixStatus.NO_ORIENTATION
        assert "both bands" in fix.reason


def test_one_band_alone_is_not_taken_for_either(rig, pictures):
    first, second = TIP - OFFSET * AXIS, TIP - (OFFSET + DISTANCE) * AXIS
    for hidden in (first, second):
        tracker = _tracker(rig, AXIS)
        fix = tracker.process(*pictures(cover=hidden))
        assert not fix.usable
        found = tracker.pictures()[0].found
        assert isinstance(found, Miss)
        assert found.reason is MissReason.ONE_OF_TWO


def test_an_axis_that_is_not_the_robots_is_told(rig, pictures):
    fix = _tracker(rig, AXIS).process(*pictures())
    sigma = np.sqrt(0.5 * np.trace(fix.axis_covariance))
    normal = np.cross(AXIS, [1.0, 0.0, 0.0])
    for turn, cause in (
        (0.5 * sigma, DiscrepancyCause.NONE),
        (6.0 * sigma, DiscrepancyCause.TURNED),
    ):
        told = []
        health = FixHealth(
            OFFSET, lambda t: None, lambda kind, words, told=told: told.append(words)
        )
        lean = AXIS + turn * normal / np.linalg.norm(normal)
        seen = replace(fix, axis_world=lean / np.linalg.norm(lean), beside=np.zeros(3))
        for _ in range(60):
            found = health.judge(seen, AXIS).discrepancy
        assert found.cause is cause
        assert found.turn == pytest.approx(turn, rel=1e-3)
        assert len(told) == (cause is DiscrepancyCause.TURNED)
