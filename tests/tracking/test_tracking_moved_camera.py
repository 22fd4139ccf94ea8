"""A camera that was moved, or two cables exchanged, while the marker is in full view: said so."""

import numpy as np
import pytest

from app.core.clock import VirtualClock
from app.tracking.cameras.camera import CameraFrame
from app.tracking.discrepancy import DiscrepancyCause
from app.tracking.fix import FixStatus
from app.tracking.simulated.obstacles import Patch, patch
from app.tracking.tracker import Tracker
from tests.tracking.camera_fakes import NoCamera

FULCRUM = np.array([0.0, 0.16056, 0.090])
FRAMES = 52


def _run(wide, renderers, scene_at, spoil, start=0, frames=FRAMES):
    """Fixes of a needle pushed and leaned while `spoil` changes the pictures from `start` on."""
    axis = [None]
    tracker = Tracker((NoCamera(), NoCamera()), wide, VirtualClock(), lambda _: axis[0], FULCRUM)
    fixes = []
    for k in range(frames):
        scene = scene_at(0.03 + 0.0008 * k, 14.0, 30.0 + 0.5 * k)
        axis[0] = scene.axis_world
        pictures = [renderer.render(scene) for renderer in renderers]
        if k >= start:
            pictures = spoil(pictures)
        fixes.append(tracker.process(*(CameraFrame(one, k / 30.0) for one in pictures)))
    return fixes, [event.message for event in tracker.events.drain()]


def _rolled(pixels, axis):
    return lambda pictures: [pictures[0], np.roll(pictures[1], pixels, axis)]


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    ("pixels", "axis", "start"), [(20, 0, 0), (-60, 0, 5), (-20, 1, 5), (60, 1, 0)]
)
def test_a_camera_that_was_bumped_by_more_than_a_marker_s_width_is_named(
    wide, wide_renderers, scene_at, pixels, axis, start
):
    fixes, said = _run(wide, wide_renderers, scene_at, _rolled(pixels, axis), start)
    assert all(fix.usable for fix in fixes[:start])
    assert not any(fix.usable for fix in fixes[start:])
    assert {fix.status for fix in fixes[start + 1 :]} == {FixStatus.INCONSISTENT}
    assert fixes[-1].discrepancy.cause is DiscrepancyCause.BUMPED_CAMERA
    assert "a camera was moved" in said[-1]
    assert "daily check, then calibrate" in said[-1]


@pytest.mark.long("statistics")
def test_cameras_that_are_exchanged_while_they_run_are_named(wide, wide_renderers, scene_at):
    start = 5
    fixes, _ = _run(wide, wide_renderers, scene_at, lambda pictures: pictures[::-1], start, 66)
    assert not any(fix.usable for fix in fixes[start:])
    assert {fix.status for fix in fixes[start + 1 :]} == {FixStatus.INCONSISTENT}
    assert "swapped" in fixes[-1].reason


@pytest.mark.long("statistics")
def test_cameras_that_are_exchanged_while_they_run_are_the_cause(wide, wide_renderers, scene_at):
    fixes, said = _run(wide, wide_renderers, scene_at, lambda pictures: pictures[::-1], 5, 66)
    assert fixes[-1].discrepancy.cause is DiscrepancyCause.SWAPPED_CAMERAS
    assert "swapped" in said[-1]


@pytest.mark.long("statistics")
def test_a_red_thing_in_one_picture_while_the_other_shows_the_marker_gives_no_fix(
    wide, wide_renderers, scene_at
):
    rng = np.random.default_rng(2)

    def hostile(pictures):
        red = patch(np.full_like(pictures[1], 115), Patch(np.array([250.0, 180.0]),
                    np.array([5.0, 11.0]), 12.0), rng)  # fmt: skip
        return [pictures[0], red]

    fixes, said = _run(wide, wide_renderers, scene_at, hostile, frames=20)
    assert not any(fix.usable for fix in fixes)
    assert fixes[-1].discrepancy.cause is DiscrepancyCause.NONE
    assert said == []


@pytest.mark.long("statistics")
def test_a_bumped_camera_put_back_is_believed_again(wide, wide_renderers, scene_at):
    fixes, _ = _run(
        wide, wide_renderers, scene_at,
        lambda pictures: pictures, frames=3,
    )  # fmt: skip
    assert fixes[-1].usable
    calls = iter(range(1000))
    spoil = _rolled(60, 0)
    fixes, _ = _run(
        wide, wide_renderers, scene_at,
        lambda pictures: spoil(pictures) if next(calls) < 10 else pictures, frames=16,
    )  # fmt: skip
    assert not any(fix.usable for fix in fixes[:10])
    assert fixes[-1].usable
