"""What Acus tells as ROS 2 messages: the laboratory's topics and types, metres, quaternions xyzw.

Frames: `world` (the robot's base), `patient` (DICOM LPS), `needle_tip_marker` (origin at the tip,
+z out of it), `P_u` (the end in the hand). A message is a mapping, as its fields are named in ROS.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.exchange.moment import (
    LiveEvent,
    LiveMoment,
    LivePlan,
    LivePose,
    Validity,
    needle_rotation,
)

Body = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Told:
    """A message, and by what it is told from the one before.

    Attributes:
        key: another one where the message is a new one.
        body: its fields.
    """

    key: object
    body: Body


@dataclass(frozen=True, slots=True)
class RosTopic:
    """A topic.

    Attributes:
        type: of its messages, as ROS 2 writes it.
        of: makes the message of a moment; None where there is nothing to tell.
    """

    type: str
    of: Callable[[LiveMoment], Told | None]

    def is_of(self, given: str) -> bool:
        """Return whether a type is this one, in the spelling of ROS 2 or ROS 1."""
        return given.replace("/msg/", "/") == self.type.replace("/msg/", "/")


def stamp(wall: float) -> dict[str, int]:
    """Return a time [s since 1970] as ROS has it."""
    whole = int(wall // 1.0)
    return {"sec": whole, "nanosec": min(999_999_999, int((wall - whole) * 1e9))}


def quaternion(rotation: FloatArray) -> dict[str, float]:
    """Return a rotation, shape (3, 3), as unit quaternion, w not negative.

    The largest of the four is taken by its square root, so that none loses digits (Shepperd 1978).
    """
    m, trace = rotation, float(np.trace(rotation))
    squares = np.array([trace, m[0, 0], m[1, 1], m[2, 2]])
    k = int(np.argmax(squares))
    if k == 0:
        q = np.array([1 + trace, m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    elif k == 1:
        q = np.array(
            [m[2, 1] - m[1, 2], 1 + 2 * m[0, 0] - trace, m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]]
        )
    elif k == 2:
        q = np.array(
            [m[0, 2] - m[2, 0], m[0, 1] + m[1, 0], 1 + 2 * m[1, 1] - trace, m[1, 2] + m[2, 1]]
        )
    else:
        q = np.array(
            [m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], 1 + 2 * m[2, 2] - trace]
        )
    q = q / np.linalg.norm(q)
    w, x, y, z = (q if q[0] >= 0.0 else -q).tolist()
    return {"x": x, "y": y, "z": z, "w": w}


def xyz(vector: FloatArray) -> dict[str, float]:
    """Return a vector, shape (3,)."""
    x, y, z = (float(one) for one in vector)
    return {"x": x, "y": y, "z": z}


def header(wall: float, frame: str = "world") -> dict[str, Any]:
    """Return a std_msgs/Header."""
    return {"stamp": stamp(wall), "frame_id": frame}


def tip_pose(needle: LivePose, plan: LivePlan) -> RigidTransform:
    """Return T_world_needle at the tip, of a bent needle as it goes on there."""
    return RigidTransform(rotation_along(needle.tip_axis, plan), needle.p_tip)


def rotation_along(axis: FloatArray, plan: LivePlan) -> FloatArray:
    """Return the rotation of a frame in world whose z is `axis`, x towards the patient's head."""
    axis_patient = plan.T_world_patient.rotation.T @ axis
    rotation = needle_rotation(axis_patient / np.linalg.norm(axis_patient))
    turned: FloatArray = plan.T_world_patient.rotation @ rotation
    return turned


def _frame(wall: float, child: str, pose: RigidTransform) -> dict[str, Any]:
    return {
        "header": header(wall),
        "child_frame_id": child,
        "transform": {
            "translation": xyz(pose.translation),
            "rotation": quaternion(pose.rotation),
        },
    }


def _known(moment: LiveMoment) -> tuple[LivePose, LivePlan] | None:
    """Return needle and plan where the needle may be used."""
    needle, plan = moment.needle, moment.plan
    if needle is None or plan is None or needle.validity is not Validity.OK:
        return None
    return needle, plan


def _tf(moment: LiveMoment) -> Told | None:
    if moment.plan is None:
        return None
    frames, key, wall = [], 0.0, moment.wall
    if (known := _known(moment)) is not None:
        needle, plan = known
        key = wall = needle.wall
        shaft = rotation_along(needle.axis, plan)
        frames = [
            _frame(wall, "needle_tip_marker", tip_pose(needle, plan)),
            _frame(wall, "P_u", RigidTransform(shaft, needle.p_hub)),
        ]
    frames.insert(0, _frame(wall, "patient", moment.plan.T_world_patient))
    return Told((key, id(moment.plan), int(moment.wall)), {"transforms": frames})


def _joints(moment: LiveMoment) -> Told | None:
    device = moment.device
    if device is None:
        return None
    body = {
        "header": header(device.wall, ""),
        "name": list(device.names),
        "position": np.array(device.q),
        "velocity": np.array(device.qd),
        "effort": np.array(device.torque),
    }
    return Told(device.wall, body)


def _array(values: FloatArray) -> dict[str, Any]:
    return {"layout": {"dim": [], "data_offset": 0}, "data": np.array(values, dtype=np.float64)}


def _image_points(moment: LiveMoment) -> Told | None:
    plan = moment.plan
    if plan is None:
        return None
    return Told(id(plan), _array(np.concatenate([plan.p_entry, plan.p_target])))


def _marker(moment: LiveMoment) -> Told | None:
    plan = moment.plan
    if plan is None:
        return None
    ends = plan.T_world_patient @ np.vstack([plan.p_entry, plan.p_target])
    body = {
        "header": header(moment.wall),
        "ns": "plan",
        "id": 0,
        "type": 4,  # LINE_STRIP
        "action": 0,  # ADD
        "pose": {"position": xyz(np.zeros(3)), "orientation": quaternion(np.eye(3))},
        "scale": {"x": 0.001, "y": 0.0, "z": 0.0},
        "color": {"r": 0.0, "g": 1.0, "b": 0.0, "a": 1.0},
        "lifetime": {"sec": 0, "nanosec": 0},
        "frame_locked": True,
        "points": [xyz(one) for one in ends],
        "colors": [],
        "texture_resource": "",
        "texture": {"header": header(0.0, ""), "format": "", "data": []},
        "uv_coordinates": [],
        "text": "",
        "mesh_resource": "",
        "mesh_file": {"filename": "", "data": []},
        "mesh_use_embedded_materials": False,
    }
    return Told(id(plan), body)


def _angle_error(moment: LiveMoment) -> Told | None:
    device = moment.device
    return None if device is None else Told(device.wall, {"data": device.angle_error})


def _wrench(moment: LiveMoment) -> Told | None:
    device = moment.device
    if device is None:
        return None
    wrench = {"force": xyz(device.felt), "torque": xyz(np.zeros(3))}
    return Told(device.wall, {"header": header(device.wall), "wrench": wrench})


def _commands(moment: LiveMoment) -> Told | None:
    device = moment.device
    return None if device is None else Told(device.wall, _array(device.torque))


def _pose(moment: LiveMoment) -> Told | None:
    if (known := _known(moment)) is None:
        return None
    needle, plan = known
    tip, spread = tip_pose(needle, plan), np.zeros((6, 6))
    spread[:3, :3] = needle.covariance
    pose = {"position": xyz(tip.translation), "orientation": quaternion(tip.rotation)}
    body = {
        "header": header(needle.wall),
        "pose": {"pose": pose, "covariance": spread.ravel()},
    }
    return Told(needle.wall, body)


def _validity(moment: LiveMoment) -> Told | None:
    said = "MISSING" if moment.needle is None else moment.needle.validity.value
    return Told(said, {"data": said})


def _state(moment: LiveMoment) -> Told | None:
    return Told(moment.state, {"data": moment.state})


EVENTS: Final = "/acus/events"
IMAGE_POINTS: Final = "/image_points"

TOPICS: Final[Mapping[str, RosTopic]] = {
    "/tf": RosTopic("tf2_msgs/msg/TFMessage", _tf),
    "/joint_states": RosTopic("sensor_msgs/msg/JointState", _joints),
    IMAGE_POINTS: RosTopic("std_msgs/msg/Float64MultiArray", _image_points),
    "/visualization_marker": RosTopic("visualization_msgs/msg/Marker", _marker),
    "/angle_error": RosTopic("std_msgs/msg/Float64", _angle_error),
    "/hub_wrench": RosTopic("geometry_msgs/msg/WrenchStamped", _wrench),
    "/forward_effort_controller/commands": RosTopic("std_msgs/msg/Float64MultiArray", _commands),
    "/needle_pose": RosTopic("geometry_msgs/msg/PoseWithCovarianceStamped", _pose),
    "/acus/needle_validity": RosTopic("std_msgs/msg/String", _validity),
    "/acus/state": RosTopic("std_msgs/msg/String", _state),
    EVENTS: RosTopic("std_msgs/msg/String", lambda _: None),  # one by one, by `event`
}
"""Topic -> what is told there."""


def event(happened: LiveEvent) -> Body:
    """Return an event."""
    return {"data": f"{happened.kind}: {happened.message}"}
