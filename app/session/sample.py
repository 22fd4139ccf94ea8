"""One moment of the attempt, and how it stands in the record's JSON channels.

A value that is not finite is written as null where our own schema allows it; a Foxglove message
that could not be written without one is left out. NaN never stands in JSON.
"""

from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.events import Event
from app.core.json_values import compact
from app.core.transform import FrameName, RigidTransform, rotation_between
from app.device.state import DeviceState
from app.session.felt import felt_force
from app.session.machine import State
from app.session.needle import DOWN, NeedlePose
from app.tracking.motion.depth_filter import HAND_SPEED

_FLIP: Final = np.diag([1.0, -1.0, -1.0])
_LEVELS: Final = {
    "fault": 4,
    "abort": 4,
    "recorder": 3,
    "slept": 4,
    "camera": 3,
    "depth": 3,
    "pause": 3,
}
_INFO: Final = 2
JOINTS: Final = ("panto_a1", "panto_a5")
"""Names of the two motor joints in the published robot description: left, right."""


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """What the trainer hands to the recorder once per tick.

    Attributes:
        time: moment [s].
        state: the attempt's state.
        pose: fused pose.
        device: newest state of the loop, or None if there is none.
        p_target: target now, with its motion [m], shape (3,).
        fix_status: the tracker's newest status; empty before the first fix.
        residual_px: its residual.
        assistance: dial, -1...1.
        enabled: whether forces are armed.
    """

    time: float
    state: State
    pose: NeedlePose
    device: DeviceState | None
    p_target: FloatArray
    fix_status: str = ""
    residual_px: float = 0.0
    assistance: float = 0.0
    enabled: bool = False

    @property
    def pose_valid(self) -> bool:
        """Return whether direction and depth are measured and finite; a depth of the model's never
        is.
        """
        pose = self.pose
        numbers = (pose.depth, *pose.p_tip)
        return pose.measured and self.axis_valid and all(map(isfinite, numbers))

    @property
    def axis_valid(self) -> bool:
        """Return whether the direction is measured and finite."""
        return self.pose.valid and all(map(isfinite, self.pose.axis))


def encode(document: Any) -> bytes:
    """JSON without NaN or infinity; such a number becomes null."""
    return compact(document).encode()


def messages(sample: Sample, stamp: dict[str, int]) -> list[tuple[str, bytes]]:
    """Topic and JSON of every channel that this sample fills."""
    documents: list[tuple[str, dict[str, Any]]] = [
        ("/attempt", _attempt(sample, stamp)),
        ("/tracking/quality", _quality(sample, stamp)),
    ]
    if sample.pose_valid:
        transform = _needle_tf(sample.pose, stamp)
        documents += [("/tf", transform), ("/needle/tip", _tip(transform))]
    if sample.device is not None:
        documents += [
            ("/haptic/joints", _joints(sample.device, stamp)),
            ("/haptic/wrench", _wrench(sample, sample.device, stamp)),
        ]
    return [(topic, encode(document)) for topic, document in documents]


def patient_transform(T_world_patient: RigidTransform, stamp: dict[str, int]) -> bytes:
    """Return the registration as a FrameTransform world → patient."""
    return encode(_transform(FrameName.PATIENT, T_world_patient, stamp))


def log(event: Event, stamp: dict[str, int]) -> bytes:
    """Return an event as a foxglove.Log with its kind and data."""
    return encode(
        {
            "timestamp": stamp,
            "level": _LEVELS.get(event.kind, _INFO),
            "message": event.message,
            "name": "acus",
            "file": "",
            "line": 0,
            "kind": event.kind,
            "data": {**event.data, "time": event.time},
        }
    )


def timestamp(nanoseconds: int) -> dict[str, int]:
    """Foxglove timestamp."""
    return {"sec": nanoseconds // 1_000_000_000, "nsec": nanoseconds % 1_000_000_000}


def needle_rotation(axis: FloatArray) -> FloatArray:
    """Rotation needle → world, shape (3, 3): +z out of the tip.

    The shaft has no roll; it is chosen as the smallest turn from the needle that hangs straight
    down, which is smooth everywhere but for a needle that points straight up.
    """
    return rotation_between(DOWN, axis) @ _FLIP


def quaternion(rotation: FloatArray) -> dict[str, float]:
    """Return the unit quaternion (w ≥ 0) of a rotation matrix, by its largest component."""
    r = rotation
    squares = 1.0 + np.array([[1, -1, -1], [-1, 1, -1], [-1, -1, 1], [1, 1, 1]]) @ np.diag(r)
    k = int(np.argmax(squares))
    x, y, z, w = _quaternion_column(r, k, float(squares[k]))
    sign = (-1.0 if w < 0.0 else 1.0) / sqrt(x * x + y * y + z * z + w * w)
    return {"x": sign * x, "y": sign * y, "z": sign * z, "w": sign * w}


def _quaternion_column(r: FloatArray, k: int, square: float) -> tuple[float, float, float, float]:
    if k == 3:
        return r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], square
    column = r[:, k] + r[k, :]
    column[k] = square
    i, j = (k + 1) % 3, (k + 2) % 3
    return float(column[0]), float(column[1]), float(column[2]), float(r[j, i] - r[i, j])


def _vector(values: FloatArray) -> dict[str, float]:
    x, y, z = np.asarray(values, dtype=np.float64).tolist()
    return {"x": x, "y": y, "z": z}


def _transform(
    child: FrameName, T_world_child: RigidTransform, stamp: dict[str, int]
) -> dict[str, Any]:
    return {
        "timestamp": stamp,
        "parent_frame_id": FrameName.WORLD.value,
        "child_frame_id": child.value,
        "translation": _vector(T_world_child.translation),
        "rotation": quaternion(T_world_child.rotation),
    }


def _needle_tf(pose: NeedlePose, stamp: dict[str, int]) -> dict[str, Any]:
    T_world_needle = RigidTransform(needle_rotation(pose.axis), pose.p_tip)
    return _transform(FrameName.NEEDLE, T_world_needle, stamp)


def _tip(transform: dict[str, Any]) -> dict[str, Any]:
    """Return the needle's transform as the pose of its tip."""
    return {
        "timestamp": transform["timestamp"],
        "frame_id": transform["parent_frame_id"],
        "pose": {"position": transform["translation"], "orientation": transform["rotation"]},
    }


def _attempt(sample: Sample, stamp: dict[str, int]) -> dict[str, Any]:
    pose, valid = sample.pose, sample.pose_valid
    bent = {} if pose.bend is None or not valid else {"bend": pose.bend.numbers().tolist()}
    return {
        "timestamp": stamp,
        "time": sample.time,
        "state": sample.state.value,
        "valid": valid,
        "depth_source": pose.depth_source.value,
        "depth": pose.depth if valid else None,
        "tip": _vector(pose.p_tip) if valid else None,
        "axis": _vector(pose.axis) if sample.axis_valid else None,
        "hub": _vector(sample.device.hub) if sample.device else None,
        "target": _vector(sample.p_target),
    } | bent


def _quality(sample: Sample, stamp: dict[str, int]) -> dict[str, Any]:
    pose = sample.pose
    variance = float(pose.axis @ pose.covariance @ pose.axis)
    return {
        "timestamp": stamp,
        "status": sample.fix_status,
        "residual_px": sample.residual_px,
        "orientation_age": pose.orientation_age,
        "depth_age": pose.depth_age,
        "sigma_along": sqrt(variance) if variance >= 0.0 else None,
        "radius_95": radius_95(sample),
        "deflection": pose.deflection if pose.deflection_sigma > 0.0 else None,
    } | ({} if (known := spread(sample)) is None else {"spread": list(known)})


def radius_95(sample: Sample) -> float | None:
    """Radius round the tip that holds the true one with 95 % [m], while cameras vouch for it."""
    return sample.pose.radius if sample.pose_valid else None


def spread(sample: Sample) -> tuple[float, float, float] | None:
    """Say what the cameras leave unsure of the tip: along and across the needle [m], and since [s].

    Standard deviations, across for each of two directions, of where the tip was when the picture
    was taken: what a hand may have moved it since, which the pose allows for, is no part of them.
    None while no camera vouches for the tip.
    """
    pose = sample.pose
    if not sample.pose_valid:
        return None
    along = float(pose.axis @ pose.covariance @ pose.axis)
    across = max(0.0, 0.5 * (float(np.trace(pose.covariance)) - along))
    fixed = max(0.0, along - (HAND_SPEED * pose.depth_age) ** 2)
    numbers = sqrt(fixed), sqrt(across), pose.depth_age
    return numbers if all(map(isfinite, numbers)) else None


def _joints(device: DeviceState, stamp: dict[str, int]) -> dict[str, Any]:
    """Joint states; a value that is not finite is left out, as the schema allows."""
    columns = {"position": device.q, "velocity": device.qd, "effort": device.torque}
    joints = [
        {"name": name} | {key: float(v[i]) for key, v in columns.items() if isfinite(v[i])}
        for i, name in enumerate(JOINTS)
    ]
    return {"timestamp": stamp, "joints": joints}


def _wrench(sample: Sample, device: DeviceState, stamp: dict[str, int]) -> dict[str, Any]:
    felt = felt_force(device, sample.pose)
    return {
        "timestamp": stamp,
        "wanted": _vector(device.force),
        "guide": _vector(device.guide),
        "felt": _vector(felt.force),
        "felt_least": felt.least,
        "felt_most": felt.most,
        "felt_source": "measured" if device.force_measured else "estimated",
        "measured": float(device.measured_force) if device.force_measured else None,
        "along": float(device.axial_force),
        "clamped": bool(device.limit_scale < 1.0),
        "enabled": sample.enabled,
        "assistance": sample.assistance,
        "fault": int(device.fault),
    }
