"""A calibration as a value: what it hands out, and what it refuses."""

from datetime import UTC, datetime

import numpy as np
import pytest

from app.core.configuration import parse
from app.core.errors import ConfigurationError
from app.core.transform import RigidTransform
from app.tracking.errors import RigError
from app.tracking.optics.calibration import (
    CameraCalibration,
    PoseCalibration,
    StereoCalibration,
)
from app.tracking.optics.rig import RigProfile, load_rig


def calibration_of(rig: RigProfile, world: bool = True) -> StereoCalibration:
    left, right = rig.models
    cameras = [
        CameraCalibration(
            name=model.name,
            image_size=model.image_size,
            focal_px=tuple(model.intrinsics[:2].tolist()),
            centre_px=tuple(model.intrinsics[2:].tolist()),
            distortion=tuple(model.distortion.tolist()),
        )
        for model in (left, right)
    ]
    return StereoCalibration(
        id="test-1",
        created=datetime(2026, 1, 1, tzinfo=UTC),
        cameras=(cameras[0], cameras[1]),
        pose=PoseCalibration.of(right.T_camera_world @ left.T_world_camera),
        world=PoseCalibration.of(left.T_world_camera) if world else None,
    )


def test_a_calibrated_rig_sees_points_where_the_calibration_says() -> None:
    rig = load_rig("thesis")
    calibrated = rig.calibrated(calibration_of(rig))
    points = np.array([[0.0, 0.16, 0.03], [0.01, 0.15, 0.05]])
    for model, other in zip(rig.models, calibrated.models, strict=True):
        np.testing.assert_allclose(model.project(points)[0], other.project(points)[0], atol=1e-9)


def test_a_calibrated_rig_survives_being_written_and_read() -> None:
    rig = load_rig("wide")
    calibrated = rig.calibrated(calibration_of(rig))
    again = parse(calibrated.model_dump(mode="json"), RigProfile, "record")
    assert again == calibrated
    assert again.calibration is not None
    assert again.calibration.baseline == pytest.approx(0.54)


def test_a_calibration_without_world_or_of_other_cameras_is_refused() -> None:
    rig = load_rig("wide")
    with pytest.raises(RigError, match="acus calibrate world"):
        rig.calibrated(calibration_of(rig, world=False))
    swapped = calibration_of(rig)
    swapped = swapped.model_copy(update={"cameras": swapped.cameras[::-1]})
    with pytest.raises(RigError, match="right, left"):
        rig.calibrated(swapped)


def test_a_covariance_of_another_size_is_refused() -> None:
    document = calibration_of(load_rig("wide")).model_dump(mode="json")
    document["cameras"][0]["covariance"] = [[0.0]]
    with pytest.raises(ConfigurationError, match="9 rows of 9"):
        parse(document, StereoCalibration, "file.yaml")


def test_a_pose_goes_in_and_out_unchanged() -> None:
    pose = RigidTransform.exp([0.1, -0.2, 0.3, 0.4, -0.5, 0.6])
    again = PoseCalibration.of(pose).transform
    np.testing.assert_allclose(again.matrix(), pose.matrix(), atol=1e-15)
