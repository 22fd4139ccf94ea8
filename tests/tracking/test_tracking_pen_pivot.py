"""The pen's tip by pivoting, and its direction by the mount or by rolling."""

import numpy as np
import pytest

from app.core.arrays import unit
from app.core.transform import RigidTransform
from app.tracking.confidence import chi_square_quantile
from app.tracking.pen.calibrating import axis_by_mount, axis_by_rolling
from app.tracking.pen.errors import PenError
from app.tracking.pen.pivot import MeasuredPose, pivot

TIP = np.array([0.001, -0.002, 0.176])
DIMPLE = np.array([0.02, 0.16, 0.09])
UPRIGHT = np.diag([1.0, -1.0, -1.0])
SPREAD = np.diag([2e-3] * 3 + [1e-3] * 3) ** 2


def circling(s):
    return 0.5 * np.sqrt(s) * np.array([np.cos(12 * s), np.sin(12 * s), 0.0]) + [0, 0, 2 * s]


def rocked(motion, rng, n=50, tip=TIP):
    poses = []
    for k in range(n):
        turn = RigidTransform.exp([0.0, 0.0, 0.0, *motion(k / n)]).rotation @ UPRIGHT
        error = RigidTransform.exp(np.sqrt(np.diag(SPREAD)) * rng.normal(size=6))
        true = RigidTransform(turn, DIMPLE - turn @ tip)
        poses.append(MeasuredPose(error @ true, SPREAD))
    return poses


@pytest.mark.long("statistics")
def test_the_tip_is_found_and_its_covariance_holds_in_trials():
    rng, distances = np.random.default_rng(2), []
    for _ in range(60):
        found = pivot(rocked(circling, rng))
        error = found.p_tip - TIP
        distances.append(error @ np.linalg.solve(found.covariance, error))
    assert 0.90 <= np.mean(np.array(distances) < chi_square_quantile(0.95, 3)) <= 0.99
    np.testing.assert_allclose(found.p_dimple, DIMPLE, atol=3e-3)
    assert found.poses + found.left_out == 50


def test_a_tip_that_slipped_for_a_moment_is_left_out():
    rng = np.random.default_rng(3)
    poses = rocked(circling, rng)
    for k in (10, 11, 12):
        shifted = RigidTransform.from_translation([0.05, 0.0, 0.0]) @ poses[k].T
        poses[k] = MeasuredPose(shifted, SPREAD)
    found = pivot(poses)
    assert 3 <= found.left_out <= 5
    assert np.linalg.norm(found.p_tip - TIP) < 3e-3


@pytest.mark.parametrize(
    ("motion", "words"),
    [
        (lambda s: np.zeros(3), "held still"),
        (lambda s: np.array([0.0, 0.0, 3.0 * s]), "only rolled"),
        (lambda s: np.array([0.5 * np.sin(7 * s), 0.0, 0.0]), "one plane only"),
    ],
)
def test_a_motion_that_leaves_the_tip_open_is_named(motion, words):
    with pytest.raises(PenError, match=words):
        pivot(rocked(motion, np.random.default_rng(1)))


def test_too_few_poses_and_a_slipping_tip_are_refused():
    rng = np.random.default_rng(4)
    with pytest.raises(PenError, match="too few"):
        pivot(rocked(circling, rng, n=5))
    slipping = [
        MeasuredPose(RigidTransform.from_translation([0.04 * (k % 2), 0, 0.0]) @ p.T, SPREAD)
        for k, p in enumerate(rocked(circling, rng))
    ]
    with pytest.raises(PenError, match=r"slipped|known to"):
        pivot(slipping)


def test_the_mount_gives_the_direction_and_says_how_well():
    tip = pivot(rocked(circling, np.random.default_rng(5)))
    axis = axis_by_mount(tip)
    assert np.linalg.norm(np.cross(axis.axis, unit(TIP))) < 0.02
    assert 0.2 < axis.sd_deg < 1.0
    np.testing.assert_allclose(axis.covariance @ axis.axis, 0.0, atol=1e-12)


@pytest.mark.long("statistics")
def test_rolling_gives_the_direction_and_its_covariance_holds_in_trials():
    rng, axis, distances = np.random.default_rng(6), unit([0.02, -0.01, 1.0]), []
    for _ in range(40):
        poses = []
        for k in range(40):
            turn = UPRIGHT @ RigidTransform.exp([0, 0, 0, *(2.5 * k / 40 * axis)]).rotation
            error = RigidTransform.exp(1e-3 * rng.normal(size=6))
            poses.append(MeasuredPose(error @ RigidTransform(turn, DIMPLE), 1e-6 * np.eye(6)))
        found = axis_by_rolling(poses, np.array([0.0, 0.0, 1.0]))
        error = found.axis - axis
        distances.append(error @ np.linalg.pinv(found.covariance, rcond=1e-6) @ error)
    assert np.mean(np.array(distances) < chi_square_quantile(0.95, 2)) >= 0.9
    assert np.linalg.norm(found.axis - axis) < 2e-3


def test_a_pen_that_was_hardly_rolled_or_swung_about_is_refused():
    rng = np.random.default_rng(7)
    with pytest.raises(PenError, match="too little"):
        axis_by_rolling(rocked(lambda s: np.array([0, 0, 0.3 * s]), rng), np.array([0, 0, 1.0]))
    swung = rocked(lambda s: np.array([np.sin(9 * s), 0, 2.5 * s]), rng)
    with pytest.raises(PenError, match="did not keep"):
        axis_by_rolling(swung, np.array([0, 0, 1.0]))
