"""The arm as URDF: the published links and joints, the profile's limits, and what it holds.

Links are `link_0` (the base) to `link_7`, then `flange` and `tool`; joints `joint_1` to `joint_7`
turn about their own z. `world` carries the base where the profile places it.
"""

import xml.etree.ElementTree as ET

import numpy as np

from app.arm.mechanics.profile import ArmProfile
from app.arm.mechanics.published import PublishedArm, PublishedLink
from app.core.arrays import FloatArray
from app.core.transform import RigidTransform


def write_arm_urdf(arm: ArmProfile, published: PublishedArm) -> str:
    """Return an arm as URDF text; it has no shapes, which the published description keeps apart."""
    robot = ET.Element("robot", name=arm.name)
    ET.SubElement(robot, "link", name="world")
    _link(robot, "link_0", published.base)
    _joint(robot, "base", "fixed", "world", "link_0", arm.T_world_base)
    for number, joint in enumerate(published.joints, 1):
        name = f"link_{number}"
        _link(robot, name, joint)
        turn = _joint(
            robot, f"joint_{number}", "revolute", f"link_{number - 1}", name, joint.transform
        )
        ET.SubElement(turn, "axis", xyz="0 0 1")
        k = number - 1
        ET.SubElement(
            turn,
            "limit",
            lower=_text(arm.lower[k]),
            upper=_text(arm.upper[k]),
            velocity=_text(arm.speed[k]),
            effort=_text(arm.torque[k]),
        )
    places = (("flange", published.flange.transform), ("tool", arm.T_flange_tool))
    before = f"link_{len(published.joints)}"
    for name, place in places:
        ET.SubElement(robot, "link", name=name)
        _joint(robot, f"{before}_to_{name}", "fixed", before, name, place)
        before = name
    ET.indent(robot)
    return f"{ET.tostring(robot, encoding='unicode', xml_declaration=True)}\n"


def _link(robot: ET.Element, name: str, body: PublishedLink) -> None:
    inertial = ET.SubElement(ET.SubElement(robot, "link", name=name), "inertial")
    ET.SubElement(inertial, "origin", xyz=_text(*body.centre), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=_text(body.mass))
    moments = dict(zip(("ixx", "iyy", "izz"), map(_text, body.inertia), strict=True))
    ET.SubElement(inertial, "inertia", moments | {"ixy": "0", "ixz": "0", "iyz": "0"})


def _joint(
    robot: ET.Element, name: str, kind: str, parent: str, child: str, place: RigidTransform
) -> ET.Element:
    joint = ET.SubElement(robot, "joint", name=name, type=kind)
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)
    angles = _roll_pitch_yaw(np.asarray(place.rotation))
    ET.SubElement(joint, "origin", xyz=_text(*place.translation), rpy=_text(*angles))
    return joint


def _roll_pitch_yaw(rotation: FloatArray) -> tuple[float, float, float]:
    """Angles about the fixed axes x, y, z in this order [rad], as URDF has them."""
    flat = float(np.hypot(rotation[0, 0], rotation[1, 0]))
    pitch = float(np.arctan2(-rotation[2, 0], flat))
    if flat < 1e-9:  # roll and yaw turn about one line: yaw takes none of it
        return float(np.arctan2(-rotation[1, 2], rotation[1, 1])), pitch, 0.0
    roll = float(np.arctan2(rotation[2, 1], rotation[2, 2]))
    return roll, pitch, float(np.arctan2(rotation[1, 0], rotation[0, 0]))


def _text(*numbers: float) -> str:
    return " ".join(repr(float(number)) for number in numbers)
