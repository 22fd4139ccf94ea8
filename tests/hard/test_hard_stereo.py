"""Stereo and marker where there is no answer, or nearly none: a status, never NaN, never a jump."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.transform import RigidTransform
from app.tracking.cameras.camera import CameraFrame
from app.tracking.errors import CameraError
from app.tracking.fix import FixStatus
from app.tracking.markers.extractor import Hint, MarkerFix, Miss
from app.tracking.markers.outline_centroid import OutlineCentroid
from app.tracking.markers.thesis import ThesisMarker
from app.tracking.optics.distortion import distort_point, fold_radius, undistort_point
from app.tracking.optics.rig import load_rig
from app.tracking.solver import FixSolver, SeenMarker
from app.tracking.stereo.triangulation import StereoStatus, Way, triangulate

THESIS = np.array([-0.091006, 2.735876, -0.001135, -0.004749, -20.789586])
SIGMA = np.array([np.eye(2) * 1e-8, np.eye(2) * 1e-8])
FULCRUM = np.array([0.0, 0.16056, 0.090])
SIDE = RigidTransform.from_translation([-0.2, 0.0, 0.0])  # the second camera 0.2 m to the right


def _pair(second: RigidTransform) -> tuple[RigidTransform, RigidTransform]:
    return RigidTransform.identity(), second


@pytest.mark.parametrize("way", list(Way))
@pytest.mark.parametrize(
    ("second", "observations", "status"),
    [
        (RigidTransform.identity(), [[0.1, 0.0], [0.1, 0.0]], StereoStatus.DEGENERATE),
        (RigidTransform.identity(), [[0.1, 0.0], [0.2, 0.0]], StereoStatus.DEGENERATE),
        (SIDE, [[0.1, 0.2], [0.1, 0.2]], StereoStatus.AT_INFINITY),
        (SIDE, [[0.0, 0.0], [0.1, 0.0]], StereoStatus.BEHIND),
        (SIDE, [[np.nan, 0.0], [0.1, 0.0]], StereoStatus.NOT_FINITE),
        (SIDE, [[0.0, 0.0], [0.1, np.inf]], StereoStatus.NOT_FINITE),
        (  # one camera before the other, both points at the epipoles: rank 2
            RigidTransform.from_translation([0.0, 0.0, 0.2]),
            [[0.0, 0.0], [0.0, 0.0]],
            StereoStatus.DEGENERATE,
        ),
    ],
)
def test_hopeless_observations_have_a_name_and_no_numbers(second, observations, status, way):
    found = triangulate(_pair(second), np.array(observations), SIGMA, way)
    assert found.status is status
    assert np.isfinite(found.p_world).all()
    assert np.isfinite(found.covariance).all()


@settings(derandomize=True, deadline=None, max_examples=200)
@given(
    *[st.floats(-3.0, 3.0)] * 4,
    st.floats(-0.3, 0.3),
    st.floats(-3.0, 3.0),
    st.sampled_from(list(Way)),
)
def test_whatever_is_observed_the_answer_is_finite(a, b, c, d, shift, turn, way):
    second = RigidTransform.exp([shift, 0.1 * shift, 0.0, 0.0, turn, 0.0])
    found = triangulate(_pair(second), np.array([[a, b], [c, d]]), SIGMA, way)
    assert np.isfinite(found.p_world).all()
    assert np.isfinite(found.covariance).all()
    assert np.isfinite(found.chi_square)


def test_far_points_grow_uncertain_with_the_square_of_the_distance():
    spread = []
    for z in (1.0, 10.0, 100.0):
        observations = np.array([[0.0, 0.0], [-0.2 / z, 0.0]])
        found = triangulate(_pair(SIDE), observations, SIGMA)
        assert found.status is StereoStatus.FOUND
        assert found.p_world[2] == pytest.approx(z, rel=1e-9)
        spread.append(np.sqrt(found.covariance[2, 2]))
    assert spread[1] / spread[0] == pytest.approx(100.0, rel=0.05)
    assert spread[2] / spread[1] == pytest.approx(100.0, rel=0.05)


def test_no_ray_belongs_to_a_pixel_beyond_the_fold():
    fold = fold_radius(THESIS)
    edge, _ = distort_point(fold, 0.0, THESIS)
    for x_d in (edge + 0.01, 2.0 * edge, 1e3, np.nan, np.inf):
        x, y, found = undistort_point(x_d, 0.0, THESIS, fold)
        assert not found
        assert np.isfinite([x, y]).all()


def test_just_inside_the_fold_the_ray_is_found_and_does_not_jump():
    fold = fold_radius(THESIS)
    radii = np.linspace(0.40, 0.465, 40)
    for r in radii:
        x, y, found = undistort_point(*distort_point(r * 0.8, r * 0.6, THESIS), THESIS, fold)
        assert found
        assert np.hypot(x - 0.8 * r, y - 0.6 * r) < 1e-9


def best(extractor, image):
    """The best find in the whole picture, or None."""
    found = extractor.search(image)
    return found[0] if found and isinstance(found[0], MarkerFix) else None


def _picture(colour):
    return np.full((480, 640, 3), colour, dtype=np.uint8)


def _with_band(image, u, v, half_width=5, half_height=10):
    image[max(0, v - half_height) : v + half_height, max(0, u - half_width) : u + half_width] = (
        40,
        25,
        190,
    )
    return image


@pytest.mark.parametrize("extractor", [OutlineCentroid(), ThesisMarker(area_min=100)])
@pytest.mark.parametrize("colour", [(0, 0, 0), (255, 255, 255), (0, 0, 255), (30, 20, 180)])
def test_a_picture_of_one_colour_holds_no_marker(extractor, colour):
    assert best(extractor, _picture(colour)) is None
    assert not any(isinstance(found, MarkerFix) for found in extractor.search(_picture(colour)))


def test_pure_noise_holds_no_marker():
    noise = np.random.default_rng(0).integers(0, 256, (480, 640, 3)).astype(np.uint8)
    for marker in OutlineCentroid().search(noise):
        if isinstance(marker, Miss):
            continue
        assert np.isfinite(marker.uv).all()
        assert marker.area >= OutlineCentroid().area_min


@pytest.mark.parametrize(("u", "v"), [(3, 200), (320, 6), (637, 200), (320, 474)])
def test_a_marker_cut_by_the_border_is_refused(u, v):
    assert best(OutlineCentroid(), _with_band(_picture(110), u, v)) is None


def test_a_marker_of_the_wrong_size_is_refused():
    image = _with_band(_picture(110), 320, 240, 2, 2)
    assert best(OutlineCentroid(), image) is None
    image = _with_band(_picture(110), 320, 240, 60, 60)
    assert best(OutlineCentroid(area_max=2000.0), image) is None


def test_an_overexposed_marker_is_refused():
    image = _picture(110)
    image[230:250, 310:320] = (160, 150, 255)
    assert best(OutlineCentroid(), image) is None


def test_of_two_red_things_the_one_where_the_marker_was_is_followed():
    image = _with_band(_with_band(_picture(110), 200, 240), 230, 240)
    found = OutlineCentroid().find(image, Hint(np.array([201.0, 239.0])))
    assert isinstance(found, MarkerFix)
    assert found.uv == pytest.approx([199.5, 239.5], abs=0.1)
    assert len(OutlineCentroid().search(image)) == 2


@pytest.mark.parametrize("predicted", [[np.nan, 3.0], [1e9, -1e9], [-500.0, 200.0]])
def test_a_senseless_prediction_finds_nothing_and_raises_nothing(predicted):
    image = _with_band(_picture(110), 320, 240)
    assert isinstance(OutlineCentroid().find(image, Hint(np.array(predicted))), Miss)


@pytest.mark.parametrize("axis", [None, np.zeros(3), np.full(3, np.nan)])
def test_without_an_axis_the_fix_says_so(axis):
    rig = load_rig("wide")
    sighting = SeenMarker(np.array([320.0, 240.0]), np.eye(2) * 1e-3)
    fix = FixSolver(rig, FULCRUM).solve((sighting, sighting), axis, 1.0)
    assert fix.status is FixStatus.NO_ORIENTATION
    assert not fix.has_point


@settings(derandomize=True, deadline=None, max_examples=60)
@given(*[st.floats(-2000.0, 3000.0)] * 4, st.sampled_from(["wide", "thesis"]))
def test_any_pair_of_pixels_gives_a_finite_fix_with_a_status(u1, v1, u2, v2, name):
    rig = load_rig(name)
    pair = tuple(SeenMarker(np.array(uv), np.eye(2) * 1e-3) for uv in ((u1, v1), (u2, v2)))
    fix = FixSolver(rig, FULCRUM).solve(pair, np.array([0.0, 0.0, -1.0]), 0.0)
    assert np.isfinite(fix.p_tip_world).all()
    assert np.isfinite(fix.covariance).all()
    assert fix.status in FixStatus
    assert (fix.status is FixStatus.VALID) == (fix.reason == "")


def test_a_picture_of_the_wrong_kind_is_refused_with_what_is_needed():
    with pytest.raises(CameraError, match="uint8"):
        CameraFrame(np.zeros((480, 640), dtype=np.float64), 0.0)
