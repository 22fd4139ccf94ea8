"""A band of which something in front hides a part: measured where it can be.

Pictures by a renderer that takes nothing from the program but the rig's numbers.
"""

import numpy as np
import pytest

from app.core import paths
from app.core.clock import VirtualClock
from app.tracking.band.outline import strips, trace
from app.tracking.cameras.camera import CameraFrame
from app.tracking.fix import FixStatus
from app.tracking.markers.choice import extractors
from app.tracking.markers.colour import RED
from app.tracking.markers.extractor import Hint, MarkerFix, Miss, MissReason
from app.tracking.markers.occlusion import OccludedSide, occlusions, paint_patches
from app.tracking.solver import FixSolver
from app.tracking.tracker import Tracker
from tests.tracking.camera_fakes import NoCamera
from tests.tracking.camera_pictures import FULCRUM, CameraPictures

PAIRS, SEED = 16, 502
GATE = 16.27
"""0.1 % point of chi-square with three degrees of freedom."""


@pytest.fixture(scope="module")
def pairs():
    maker = CameraPictures(paths.resources() / "cameras" / "wide.yaml")
    return list(maker.pairs(PAIRS, SEED, ("occlude",)))


def _fix(rig, pair, name=None):
    cameras = (NoCamera(), NoCamera())
    tracker = Tracker(
        cameras,
        rig,
        VirtualClock(),
        lambda _t: pair.axis,
        FULCRUM,
        extractors=extractors(rig, name),
    )
    return tracker.process(*(CameraFrame(image.copy(), 0.0) for image in (pair.left, pair.right)))


@pytest.mark.long("statistics")
def test_a_band_behind_a_finger_or_a_tool_is_measured_within_what_it_states(wide, pairs):
    fixes = [(_fix(wide, pair), pair) for pair in pairs]
    valid = [(fix, pair) for fix, pair in fixes if fix.status is FixStatus.VALID]
    assert len(valid) >= 0.6 * len(pairs)
    for fix, pair in valid:
        error = fix.p_tip_world - pair.tip
        assert np.linalg.norm(error) < 1e-3, pair.disturbance
        assert error @ np.linalg.solve(fix.covariance, error) < GATE, pair.disturbance


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", ["outline_centroid", "ellipse"])
def test_an_outline_that_shows_less_than_the_band_is_refused(wide, pairs, name):
    assert all(_fix(wide, pair, name).status is not FixStatus.VALID for pair in pairs)


def test_an_outline_of_a_whole_band_says_what_may_be_hidden_of_it(wide):
    maker = CameraPictures(paths.resources() / "cameras" / "wide.yaml")
    pair = next(iter(maker.pairs(1, 7, ("clean",))))
    outline = extractors(wide, "outline_centroid")[0]
    middle = wide.models[0].pixel(pair.marker_centre)
    known = outline.find(pair.left, Hint(middle, pair.marker_centre, pair.axis))
    unknown = outline.find(pair.left, Hint(middle))
    assert np.array_equal(known.uv, unknown.uv)
    assert np.trace(known.covariance) > np.trace(unknown.covariance)


def _outline(rig, pair):
    model, shape = rig.models[0], rig.needle.shape
    centre = model.T_camera_world @ pair.marker_centre
    axis = model.T_camera_world.rotation @ pair.axis
    count = strips(centre, shape, model.intrinsics, 0.7)
    return trace(centre, axis, shape, model.intrinsics, model.distortion, count)[1]


def _painted_over(image, outline, side, depth_px, colour):
    """Lay a half plane before the band, from a side, as far as `depth_px` into it."""
    v, u = np.mgrid[: image.shape[0], : image.shape[1]]
    e = (u - outline.u) * outline.eu + (v - outline.v) * outline.ev
    n = (v - outline.v) * outline.eu - (u - outline.u) * outline.ev
    limits = {
        OccludedSide.HUB: outline.arcs[0].mean() + depth_px - e,
        OccludedSide.TIP: e - outline.arcs[1].mean() + depth_px,
        OccludedSide.LEFT: outline.left + depth_px - n,
        OccludedSide.RIGHT: n - outline.right + depth_px,
    }
    image = image.copy()
    image[limits[side] > 0.0] = colour
    return image


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    "side", [side for side in OccludedSide if side is not OccludedSide.NOWHERE]
)
@pytest.mark.parametrize("colour", [(128, 128, 128), (110, 140, 220)])
def test_what_stands_before_the_band_is_told_by_its_side(wide, side, colour):
    maker = CameraPictures(paths.resources() / "cameras" / "wide.yaml")
    pair = next(iter(maker.pairs(1, 7, ("clean",))))
    outline = _outline(wide, pair)
    assert [occlusion.side for occlusion in occlusions(pair.left, outline, RED)] == [
        OccludedSide.NOWHERE
    ]
    depth = 5.0 if side in (OccludedSide.HUB, OccludedSide.TIP) else 3.0
    image = _painted_over(pair.left, outline, side, depth, colour)
    best = min(occlusions(image, outline, RED), key=lambda occlusion: occlusion.mixed)
    # of an end the colour alone does not tell which: the bare shaft beyond the other one does
    same = (
        {OccludedSide.HUB, OccludedSide.TIP}
        if side in (OccludedSide.HUB, OccludedSide.TIP)
        else {side}
    )
    assert best.side in same
    occlusion = next(one for one in occlusions(image, outline, RED) if one.side is side)
    assert np.abs(occlusion.shift).max() < 1.0
    assert occlusion.pixels[np.all(image == colour, axis=2) & _near(outline, image)].mean() > 0.95


def _near(outline, image):
    v, u = np.mgrid[: image.shape[0], : image.shape[1]]
    return np.hypot(u - outline.u, v - outline.v) < 8.0


def test_a_red_thing_without_a_shaft_is_no_hidden_band(wide):
    image = np.full((480, 640, 3), 120, np.uint8)
    image[230:250, 310:321] = (40, 30, 190)
    image[242:, 290:350] = (110, 140, 220)
    solver, axis = FixSolver(wide, FULCRUM), np.array([0.0, 0.0, -1.0])
    for camera, extractor in enumerate(extractors(wide)):
        assert paint_patches(image, RED, 6000.0)

        def nearest(uv, camera=camera):
            return solver.nearest(camera, uv, axis)

        assert isinstance(extractor.find_occluded(image, axis, nearest), Miss)


@pytest.mark.parametrize("level", [0, 128, 255])
def test_a_picture_of_one_colour_hides_nothing(wide, level):
    image, axis = np.full((480, 640, 3), level, np.uint8), np.array([0.0, 0.0, -1.0])
    miss = extractors(wide)[0].find_occluded(image, axis, lambda _uv: None)
    assert isinstance(miss, Miss)
    assert miss.reason is MissReason.PARTLY_HIDDEN


@pytest.mark.long("statistics")
def test_a_hidden_band_alone_proves_nothing(wide, pairs):
    solver, seen = FixSolver(wide, FULCRUM), []
    for pair in pairs[:6]:
        for camera, (extractor, image) in enumerate(
            zip(extractors(wide), (pair.left, pair.right), strict=True)
        ):

            def nearest(uv, camera=camera, axis=pair.axis):
                return solver.nearest(camera, uv, axis)

            fix = extractor.find_occluded(image, pair.axis, nearest)
            if isinstance(fix, MarkerFix):
                seen.append(fix)
    assert seen
    assert all(fix.occluded and not fix.alone for fix in seen)
