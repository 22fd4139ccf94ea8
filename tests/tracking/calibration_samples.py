"""Calibrations for tests: of a rig, with numbers in every field."""

from datetime import UTC, datetime

import numpy as np

from app.tracking.optics.calibration import (
    CameraCalibration,
    PoseCalibration,
    StereoCalibration,
    Validation,
)
from app.tracking.optics.rig import RigProfile


def sample(rig: RigProfile, calibration_id: str = "20260101-000000-abcd") -> StereoCalibration:
    """Calibration that says what the rig's profile says, with covariances and a validation."""
    rng = np.random.default_rng(7)
    left, right = rig.models
    cameras = [
        CameraCalibration(
            name=model.name,
            image_size=model.image_size,
            focal_px=tuple(model.intrinsics[:2].tolist()),
            centre_px=tuple(model.intrinsics[2:].tolist()),
            distortion=tuple(model.distortion.tolist()),
            covariance=_spread(rng, 9),
            rms_px=0.2,
            views=12,
        )
        for model in (left, right)
    ]
    return StereoCalibration(
        id=calibration_id,
        created=datetime(2026, 1, 1, tzinfo=UTC),
        board="charuco:9x6:20mm:15mm:DICT_5X5_100",
        cameras=(cameras[0], cameras[1]),
        pose=PoseCalibration.of(
            right.T_camera_world @ left.T_world_camera, np.array(_spread(rng, 6))
        ),
        rms_px=0.25,
        world=PoseCalibration.of(left.T_world_camera, np.array(_spread(rng, 6))),
        validation=Validation(
            views=3, points=120, rms_mm=0.05, max_mm=0.2, scale=1.0001, scale_sd=0.0004,
            epipolar_px=0.2, distance_mm=300.0,
        ),
        notes=("k3 dropped: -20.8 ± 58.3",),
    )  # fmt: skip


def _spread(rng: np.random.Generator, size: int) -> tuple[tuple[float, ...], ...]:
    a = rng.normal(size=(size, size)) * 1e-4
    return tuple(tuple(row) for row in (a @ a.T).tolist())
