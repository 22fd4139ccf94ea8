"""Rational, thin-prism and fisheye lenses against OpenCV's own projection."""

import cv2
import numpy as np
import pytest

from app.core.errors import NumericalError
from app.core.transform import RigidTransform
from app.tracking.calibration.sightings import project_with_derivatives
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.distortion import distort_point, fold_radius, undistort_point
from app.tracking.optics.lens import LensModel
from app.tracking.optics.packed import normalise, packed, project_point
from app.tracking.stereo.calibration_uncertainty import pixel_by_parameters

SIZE = (640, 480)
LENSES = {
    "five": (LensModel.BROWN, (-0.2, 0.1, 1e-3, -1e-3, 0.02), 700.0),
    "rational": (
        LensModel.RATIONAL,
        (0.9, 0.12, 2e-4, -1e-4, 0.004, 1.25, 0.35, 0.02, 0.0, 0.0, 0.0, 0.0),
        420.0,
    ),
    "rational of a depth camera": (
        LensModel.RATIONAL,
        (5.1, 2.2, 1e-4, -1e-4, 0.1, 5.4, 3.5, 0.5, 0.0, 0.0, 0.0, 0.0),
        400.0,
    ),
    "rational of a published camera_info": (  # an OAK-D's, 250x250 with a focal length of 202.6 px
        LensModel.RATIONAL,
        (
            *(-3.4751670360565186, -38.5734748840332, 3.4309603506699204e-4),
            *(-9.377215610584244e-5, 286.4400939941406, -3.6408045291900635),
            *(-36.68898010253906, 279.0523681640625, 0.0, 0.0, 0.0, 0.0),
        ),
        518.7,
    ),
    "rational that folds": (
        LensModel.RATIONAL,
        (-0.4, 0.2, 0.0, 0.0, 0.1, -0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        400.0,
    ),
    "thin prism": (
        LensModel.RATIONAL,
        (-0.2, 0.05, 1e-3, -1e-3, 0.0, 0.0, 0.0, 0.0, 3e-3, -1e-3, 2e-3, 1e-3),
        500.0,
    ),
    "thin prism that folds": (
        LensModel.RATIONAL,
        (-0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.3, 0.4, 0.2, -0.3),
        400.0,
    ),
    "fisheye": (LensModel.FISHEYE, (-0.02, 0.004, -0.003, 0.0005), 300.0),
    "fisheye that folds": (LensModel.FISHEYE, (0.1, -0.1, 0.05, -0.02), 200.0),
}


def camera(name: str) -> CameraModel:
    lens, coefficients, focal = LENSES[name]
    intrinsics = np.array([focal, 1.002 * focal, 322.1, 239.7])
    still = RigidTransform.identity()
    return CameraModel(name, intrinsics, np.array(coefficients), SIZE, still, lens)


def by_opencv(model: CameraModel, points: np.ndarray) -> np.ndarray:
    nothing, d = np.zeros(3), np.array(model.distortion)
    if model.lens is LensModel.FISHEYE:
        found = cv2.fisheye.projectPoints(points[:, None], nothing, nothing, model.matrix, d)
    else:
        found = cv2.projectPoints(points, nothing, nothing, model.matrix, d)
    return np.asarray(found[0]).reshape(-1, 2)


@pytest.mark.parametrize("name", LENSES)
def test_every_lens_projects_as_opencv_does(name: str) -> None:
    model = camera(name)
    rng = np.random.default_rng(1)
    reach = min(4.0, 0.95 * model.fold / np.sqrt(2.0))
    rays = np.column_stack([rng.uniform(-reach, reach, (2000, 2)), np.ones(2000)])
    points = rays * rng.uniform(0.1, 2.0, (2000, 1))
    pixels, ok = model.project_camera(points)
    assert ok.mean() > 0.9
    theirs = by_opencv(model, points)
    scale = np.maximum(1.0, np.abs(theirs[ok]) / 1e3)  # double precision far outside the picture
    assert (np.abs(pixels - theirs)[ok] / scale).max() < 1e-9
    row = packed(model)
    compiled = [project_point(row, *point) for point in points[:200]]
    assert [(u, v) for u, v, _ in compiled] == [tuple(uv) for uv in pixels[:200].tolist()]


@pytest.mark.parametrize("name", LENSES)
def test_every_pixel_of_the_picture_has_one_ray_or_none(name: str) -> None:
    model = camera(name)
    u, v = np.meshgrid(np.arange(0.0, 640.0, 8.0), np.arange(0.0, 480.0, 8.0))
    pixels = np.column_stack([u.ravel(), v.ravel()])
    rays, found = model.undistort(pixels)
    assert np.isfinite(rays).all()
    assert found.mean() > 0.5
    assert found.all() or "folds" in name
    again, ok = model.project_camera(np.column_stack([rays[found], np.ones(found.sum())]))
    assert ok.all()
    assert np.abs(again - pixels[found]).max() < 1e-8
    for pixel, ray, exists in zip(pixels[::97], rays[::97], found[::97], strict=True):
        alone = model.ray(pixel)
        assert (alone is not None) == exists
        assert alone is None or alone == tuple(ray)


@pytest.mark.parametrize("name", LENSES)
def test_every_lens_tells_its_derivatives(name: str) -> None:
    model = camera(name)
    p = np.concatenate([model.intrinsics, model.distortion])
    rng = np.random.default_rng(2)
    reach = min(2.0, 0.6 * model.fold)
    rays = np.concatenate([rng.uniform(-reach, reach, (40, 2)), np.zeros((1, 2))])
    points = np.column_stack([rays, np.ones(41)]) * rng.uniform(0.2, 1.0, (41, 1))
    pixels, by_point, by_parameter = project_with_derivatives(points, p)
    np.testing.assert_allclose(pixels, by_opencv(model, points), atol=1e-8)
    for k in range(3):
        h = 1e-6 * np.eye(3)[k]
        ends = [project_with_derivatives(points + s * h, p)[0] for s in (1, -1)]
        slope = (ends[0] - ends[1]) / 2e-6
        np.testing.assert_allclose(by_point[:, :, k], slope, atol=1e-5 * np.abs(slope).max())
    for k in range(p.size):
        h = 1e-6 * max(1.0, abs(p[k])) * np.eye(p.size)[k]
        ends = [project_with_derivatives(points, p + s * h)[0] for s in (1, -1)]
        slope = (ends[0] - ends[1]) / (2.0 * h[k])
        np.testing.assert_allclose(
            by_parameter[:, :, k], slope, atol=1e-5 * max(1e-3, np.abs(slope).max())
        )
    ray = points[0, :2] / points[0, 2]
    here = pixel_by_parameters(model.intrinsics, model.distortion, ray)
    np.testing.assert_allclose(here, by_parameter[0], atol=1e-9 * np.abs(here).max())


@pytest.mark.parametrize("name", LENSES)
def test_the_covariance_of_a_ray_follows_the_lens(name: str) -> None:
    model = camera(name)
    pixel, spread = np.array([400.0, 180.0]), np.array([[0.04, 0.01], [0.01, 0.09]])
    ray, covariance = np.empty(2), np.empty((2, 2))
    assert normalise(packed(model), *pixel, spread, ray, covariance)
    change = model.ray_jacobian(ray)
    np.testing.assert_allclose(covariance, change @ spread @ change.T, rtol=1e-12)
    step = 1e-4
    numeric = np.column_stack(
        [
            (np.array(model.ray(pixel + h)) - np.array(model.ray(pixel - h))) / (2.0 * step)
            for h in step * np.eye(2)
        ]
    )
    np.testing.assert_allclose(change, numeric, atol=1e-6 * np.abs(numeric).max())
    area = model.pixel_areas(ray[None])[0]
    assert area == pytest.approx(float(np.linalg.det(change)), rel=1e-9)


def test_a_rational_lens_ends_at_its_pole() -> None:
    lens = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -0.25, *np.zeros(6)])
    assert fold_radius(lens) == pytest.approx(2.0)  # 1 - r²/4
    assert undistort_point(5.0, 0.0, lens, fold_radius(lens))[2]
    assert np.isfinite(distort_point(1.999, 0.0, lens)[0])


@pytest.mark.parametrize("count", [0, 4, 6, 8, 12, 14])
def test_a_lens_with_another_number_of_coefficients_is_refused(count: int) -> None:
    still = RigidTransform.identity()
    with pytest.raises(NumericalError, match=r"\(5,\) is needed"):
        CameraModel("c", np.array([500.0, 500, 320, 240]), np.zeros(count), SIZE, still)
