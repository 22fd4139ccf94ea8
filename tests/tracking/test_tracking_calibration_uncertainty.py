"""What an uncertain calibration does to a point, against finite differences and Monte Carlo."""

from datetime import UTC, datetime

import numpy as np
import pytest

from app.core.transform import RigidTransform
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.optics.calibration import (
    PARAMETERS,
    CameraCalibration,
    PoseCalibration,
    StereoCalibration,
)
from app.tracking.solver import FixSolver, SeenMarker
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty, pixel_by_parameters
from app.tracking.stereo.epipolar import normalised
from app.tracking.stereo.triangulation import triangulate

FULCRUM = np.array([0.0, 0.16056, 0.090])
INTRINSICS_SD = np.array([1.0, 1.0, 1.5, 1.5, 0.01, 0.1, 3e-4, 3e-4, 0.0])
POSE_SD = np.array([1e-4, 1e-4, 2e-4, 3e-4, 3e-4, 2e-4])
WORLD_SD = np.array([2e-4, 1e-4, 1e-4, 4e-4, 2e-4, 3e-4])
PIXELS = 0.1**2 * np.eye(2)


def _calibration(rig, scale=1.0):
    left, right = rig.models
    cameras = tuple(
        CameraCalibration(
            name=m.name,
            image_size=m.image_size,
            focal_px=tuple(m.intrinsics[:2].tolist()),
            centre_px=tuple(m.intrinsics[2:].tolist()),
            distortion=tuple(m.distortion.tolist()),
            covariance=tuple(map(tuple, np.diag((scale * INTRINSICS_SD) ** 2).tolist())),
        )
        for m in (left, right)
    )
    return StereoCalibration(
        id="test-error",
        created=datetime(2026, 1, 1, tzinfo=UTC),
        cameras=cameras,
        pose=PoseCalibration.of(
            right.T_camera_world @ left.T_world_camera, np.diag((scale * POSE_SD) ** 2)
        ),
        world=PoseCalibration.of(left.T_world_camera, np.diag((scale * WORLD_SD) ** 2)),
    )


def _perturbed(calibration, rng):
    """A calibration that the stated covariances might have given instead."""
    cameras = []
    for camera in calibration.cameras:
        change = rng.normal(0.0, INTRINSICS_SD)
        cameras.append(
            camera.model_copy(
                update={
                    "focal_px": tuple((np.array(camera.focal_px) + change[:2]).tolist()),
                    "centre_px": tuple((np.array(camera.centre_px) + change[2:4]).tolist()),
                    "distortion": tuple((np.array(camera.distortion) + change[4:]).tolist()),
                }
            )
        )
    poses = {
        name: PoseCalibration.of(RigidTransform.exp(rng.normal(0.0, sd)) @ pose.transform)
        for name, pose, sd in (
            ("pose", calibration.pose, POSE_SD),
            ("world", calibration.world, WORLD_SD),
        )
    }
    return calibration.model_copy(update={"cameras": tuple(cameras)} | poses)


def _found(calibration, pixels):
    models = calibration.models()
    seen = [normalised(m, uv, PIXELS) for m, uv in zip(models, pixels, strict=True)]
    poses = tuple(m.T_camera_world for m in models)
    covariances = np.array([s[1] for s in seen])
    return triangulate(poses, np.array([s[0] for s in seen]), covariances), covariances


def test_the_pixel_changes_with_the_parameters_as_finite_differences_say(thesis):
    model = thesis.models[0]
    ray = np.array([0.11, -0.17])
    parameters = np.concatenate([model.intrinsics, model.distortion])

    def pixel(theta):
        changed = type(model)("x", theta[:4], theta[4:], (640, 480), RigidTransform.identity())
        return changed.project_camera(np.array([[*ray, 1.0]]))[0][0]

    steps = np.maximum(1e-5, 1e-7 * np.abs(parameters))
    numeric = np.column_stack(
        [
            (pixel(parameters + h * e) - pixel(parameters - h * e)) / (2.0 * h)
            for h, e in zip(steps, np.eye(len(PARAMETERS)), strict=True)
        ]
    )
    analytic = pixel_by_parameters(model.intrinsics, model.distortion, ray)
    np.testing.assert_allclose(analytic, numeric, rtol=1e-6, atol=1e-7)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("place", [(0.0, 0.0, -0.06), (0.04, -0.03, -0.02), (-0.03, 0.02, -0.1)])
def test_the_spread_of_points_over_possible_calibrations_is_the_stated_one(wide, place):
    calibration = _calibration(wide)
    point = FULCRUM + np.array(place)
    pixels = [model.pixel(point) for model in calibration.models()]
    found, covariances = _found(calibration, pixels)
    predicted = CalibrationUncertainty(calibration).covariance(found.p_world, covariances)
    rng = np.random.default_rng(7)
    points = [_found(_perturbed(calibration, rng), pixels)[0].p_world for _ in range(1500)]
    errors = np.array(points) - point
    sample = errors.T @ errors / len(errors)
    assert np.linalg.norm(sample - predicted) < 0.1 * np.linalg.norm(predicted)


def _sightings(rig, band, axis):
    return tuple(
        SeenMarker(m.pixel(band) + centroid_shift(m, rig.needle.shape, band, axis), PIXELS)
        for m in rig.models
    )


@pytest.mark.long("statistics")
def test_a_fix_carries_the_calibrations_error_beside_its_noise(wide):
    axis = np.array([0.2, 0.1, -np.sqrt(1.0 - 0.05)])
    band = FULCRUM + 0.06 * axis
    exact = FixSolver(wide, FULCRUM).solve(_sightings(wide, band, axis), axis, 0.0)
    rig = wide.calibrated(_calibration(wide))
    fix = FixSolver(rig, FULCRUM).solve(_sightings(rig, band, axis), axis, 0.0)
    np.testing.assert_allclose(fix.noise_covariance, exact.covariance, rtol=1e-6)
    assert np.linalg.eigvalsh(fix.covariance - fix.noise_covariance)[0] > 0.0
    assert fix.radius() > 1.5 * exact.radius()
    one = FixSolver(rig, FULCRUM).solve((_sightings(rig, band, axis)[0], None), axis, 0.0)
    assert np.linalg.eigvalsh(one.covariance - one.noise_covariance)[0] > -1e-18
    assert np.trace(one.covariance) > np.trace(one.noise_covariance)


def test_a_calibration_without_uncertainty_adds_nothing(wide):
    error = CalibrationUncertainty(_calibration(wide, scale=0.0))
    added = error.covariance(FULCRUM, np.array([1e-8 * np.eye(2)] * 2))
    np.testing.assert_array_equal(added, np.zeros((3, 3)))


def test_the_world_frame_alone_moves_the_point_as_a_rigid_body(wide):
    calibration = _calibration(wide, scale=0.0)
    twist = np.diag(WORLD_SD**2)
    world = PoseCalibration.of(calibration.world.transform, twist)
    error = CalibrationUncertainty(calibration.model_copy(update={"world": world}))
    point = FULCRUM + np.array([0.01, 0.02, -0.03])
    lever = np.hstack([np.eye(3), np.cross(np.eye(3), point)])
    np.testing.assert_allclose(
        error.covariance(point, np.array([1e-8 * np.eye(2)] * 2)),
        lever @ twist @ lever.T,
        rtol=1e-9,
        atol=1e-18,
    )


def test_what_is_remembered_of_a_place_serves_no_other_weights(wide):
    """A pixel of one camera that is far less certain changes whose calibration error counts."""
    calibration = _calibration(wide)
    p_world = np.array([0.02, 0.16, 0.05])
    error = CalibrationUncertainty(calibration)
    even = np.stack([1e-8 * np.eye(2)] * 2)
    error.covariance(p_world, even)
    for share in (1.0, 1.05, 1.5, 4.0, 100.0):
        seen = even * np.array([1.0, share])[:, None, None]
        fresh = CalibrationUncertainty(calibration).covariance(p_world, seen)
        kept = error.covariance(p_world + 1e-3, seen)
        assert np.linalg.norm(kept - fresh) < 0.05 * np.linalg.norm(fresh)


def test_the_markers_place_on_the_shaft_is_uncertain_along_it_and_nowhere_else(wide):
    axis = np.array([0.2, 0.1, -np.sqrt(1.0 - 0.05)])
    seen = _sightings(wide, FULCRUM + 0.06 * axis, axis)
    needle = wide.needle.model_copy(update={"marker_offset_sd_mm": 0.5})
    stated = type(wide).model_validate(wide.model_dump() | {"needle": needle.model_dump()})
    before, after = (FixSolver(rig, FULCRUM).solve(seen, axis, 0.0) for rig in (wide, stated))
    added = after.covariance - before.covariance
    np.testing.assert_allclose(added, 0.5e-3**2 * np.outer(axis, axis), atol=1e-15)
    np.testing.assert_allclose(after.noise_covariance, before.noise_covariance)
    assert after.depth_variance == pytest.approx(before.depth_variance + 0.5e-3**2)


def test_only_calibrated_cameras_take_the_markers_place_for_measured(wide):
    assert wide.marker_offset_variance == 0.0
    assert wide.calibrated(_calibration(wide)).marker_offset_variance == pytest.approx(1e-8)
