"""The cameras of a trainer: simulated ones, or two sources on the rig with its calibration."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.core.messages import sentence
from app.tracking.calibration.applies import require_cameras
from app.tracking.calibration.formats.own import load_calibration
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.calibration.history_file import rejected_ids
from app.tracking.cameras.camera import Camera
from app.tracking.cameras.checked import CheckedCamera
from app.tracking.cameras.factory import make_camera
from app.tracking.cameras.settings import CameraSettings
from app.tracking.errors import CalibrationError, RigError
from app.tracking.markers.colour import RED, ColourModel
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import simulated_cameras
from app.tracking.simulated.picture_effects import picture_effects
from app.tracking.simulated.scene import Scene


@dataclass(frozen=True, slots=True, eq=False)
class AttachedCameras:
    """Two cameras, not open yet, and the rig they belong to.

    Attributes:
        cameras: left, right.
        rig: with its calibration, if there is one.
        metadata: for the record of an attempt.
        colour: of the marker: learned earlier by these cameras, or the usual red.
    """

    cameras: tuple[Camera, Camera]
    rig: RigProfile
    metadata: dict[str, str]
    colour: ColourModel = RED


def real_cameras(settings: CameraSettings, clock: Clock | None = None) -> AttachedCameras:
    """Return the cameras of the settings on the calibrated rig; opens none.

    Raises:
        CameraError: if the sources do not go together.
        CalibrationError: if the calibration is of other cameras or another size, or was found bad.
        RigError: if there is no calibration, or it has no world frame.
    """
    settings.check()
    calibration = calibration_of(settings)
    if calibration is None:
        raise RigError(
            sentence(
                "the cameras are not calibrated: run `acus calibrate stereo` and `acus calibrate "
                "world`, or choose the calibration in the window's menu Cameras"
            )
        )
    _require_good(calibration)
    rig = load_rig(settings.rig)
    names = [camera.name for camera in rig.cameras]
    require_cameras(calibration, names, [settings.size] * 2)
    rig = at_rate(rig, settings.rate_hz).calibrated(calibration)
    left, right = checked_cameras(settings, clock or SystemClock(), f"calibration {calibration.id}")
    metadata = {
        "name": rig.name,
        "simulated": "no",
        "left": settings.left.origin.kind.value,
        "right": settings.right.origin.kind.value,
    }
    record = metadata | calibration_record(rig)
    return AttachedCameras((left, right), rig, record, settings.marker_colour or RED)


def simulated_on(
    rig: RigProfile,
    scene_of: Callable[[float], Scene],
    clock: Clock,
    seed: int,
    effects: Mapping[str, FloatArray] | None = None,
) -> AttachedCameras:
    """Return the simulated cameras of a rig.

    Args:
        rig: whose pictures are drawn.
        scene_of: gives the scene for the band's distance from the tip [m].
        clock: of the pictures.
        seed: of their noise.
        effects: of the exercise on pictures (`simulation.plan.SimulationPlan.pictures`).
    """
    chain = picture_effects(effects or {})
    pair = simulated_cameras(rig, scene_of(rig.needle.marker_offset), clock, seed, chain)
    metadata = {"name": rig.name, "simulated": "yes"}
    return AttachedCameras(pair, rig, metadata | calibration_record(rig))


def calibration_record(rig: RigProfile) -> dict[str, str]:
    """Id of the calibration that the fixes rest on: an attempt made with a bad one is flagged."""
    return {"calibration": rig.calibration.id} if rig.calibration is not None else {}


def checked_cameras(
    settings: CameraSettings, clock: Clock, reason: str, sides: Sequence[int] = (0, 1)
) -> tuple[CheckedCamera, ...]:
    """Cameras whose pictures are held to the settings' size; `reason` says why that one.

    Args:
        settings: sources and size.
        clock: of the pictures.
        reason: whose size it is, for the message.
        sides: 0 left, 1 right.
    """
    names = [camera.name for camera in load_rig(settings.rig).cameras]
    chosen = [(names[side], settings.cameras[side]) for side in sides]
    return tuple(
        CheckedCamera(
            make_camera(settings, camera, clock), name, camera.source, settings.size, reason
        )
        for name, camera in chosen
    )


def calibration_of(settings: CameraSettings) -> StereoCalibration | None:
    """Return the calibration that the settings name, else the active one; None without one.

    Raises:
        CalibrationError: if its file cannot be read.
    """
    if settings.calibration is not None:
        return load_calibration(settings.calibration)
    return CalibrationHistory().active()


def _require_good(calibration: StereoCalibration) -> None:
    """Refuse one that was found bad: the settings may name its file all the same."""
    reason = rejected_ids().get(calibration.id)
    if reason is not None:
        raise CalibrationError(
            sentence(
                "calibration {calibration_id} was found bad ({reason}); calibrate again, or "
                "choose another one in the camera settings",
                calibration_id=calibration.id,
                reason=reason,
            )
        )


def at_rate(rig: RigProfile, rate_hz: float) -> RigProfile:
    """Return a rig whose cameras free-run at this rate."""
    return RigProfile.model_validate(rig.model_dump() | {"rate_hz": rate_hz, "skew_ms": 0.0})
