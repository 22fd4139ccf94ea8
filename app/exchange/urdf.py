"""A device profile as URDF, links and joints named as in the laboratory's public description.

URDF holds trees only, so the loop is cut as there: the left arm (`panto_a1`, `panto_a2`) carries
the tool (`panto_a3`, `panto_tool0`), the right arm (`panto_a5`, `panto_a4`) ends in a frame of its
own (`panto_right_end`, ours) that must be brought to the tool. The needle stands on the tool, tip
at P3 (`tool_theta_joint` turns it about z, `tool_phi_joint` tilts it from the vertical).

The frame of `panto_base` is the laboratory's: its origin is the *left motor axis*, so x is greater
than in Acus' world, which starts midway between the motors, by half the base. `Origin` says where
the root link `world` stands.
"""

import xml.etree.ElementTree as ET
from enum import StrEnum

import numpy as np

from app.mechanisms.errors import MechanismError
from app.mechanisms.pantograph import inverse, passive_angles
from app.mechanisms.profile import DeviceProfile

_TURN = 3.141592653589793
_SPEED = 10.0
"""Speed limit of the joints [rad/s]: URDF demands one, the profile has none."""

_NOTHING = 1e-9
"""Mass [kg] and inertia [kg·m²] of what has none in our mechanics; simulators refuse zero."""

_RINGS, _SPOKES = 8, 72


class Origin(StrEnum):
    """Where the root link stands: on the left motor axis, or midway between the motors (Acus)."""

    LEFT_MOTOR = "left-motor"
    MIDPOINT = "midpoint"


def write_urdf(profile: DeviceProfile, origin: Origin = Origin.LEFT_MOTOR) -> str:
    """Return the profile as URDF text.

    Effort limits are the profile's torque limit, angle limits what its tilt limit needs; passive
    joints have no effort.

    Raises:
        MechanismError: if the robot does not reach all of its tilt limit.
    """
    lengths, part = profile.geometry, profile.inertia
    half = 0.5 * lengths.base
    robot = ET.Element("robot", name=profile.name)
    ET.SubElement(robot, "link", name="world")
    _link(robot, "panto_base")
    shift = 0.0 if origin is Origin.LEFT_MOTOR else -half
    _fixed(robot, "panto_root_joint", "world", "panto_base", (shift, 0.0, 0.0))
    _link(robot, "panto_link_fulcrum")
    x, y, z = lengths.fulcrum
    _fixed(robot, "panto_base_to_fulcrum", "panto_base", "panto_link_fulcrum", (x + half, y, z))
    ranges = _joint_ranges(profile)
    _arm(robot, profile, "left", ("panto_a1", "panto_a2"), 0.0, ranges)
    ball = part.tool_mass or _NOTHING, (0.0, 0.0, 0.0), (_NOTHING, _NOTHING)
    _link(robot, "panto_tool0", ball)
    along = lengths.distal, 0.0, 0.0
    _hinge(robot, "panto_a3", "panto_left_link2", "panto_tool0", along, (-_TURN, _TURN))
    _arm(robot, profile, "right", ("panto_a5", "panto_a4"), lengths.base, ranges)
    _link(robot, "panto_right_end")
    _fixed(robot, "panto_right_link2_to_end", "panto_right_link2", "panto_right_end", along)
    _needle(robot, profile)
    ET.indent(robot)
    return f"{ET.tostring(robot, encoding='unicode', xml_declaration=True)}\n"


def _arm(
    robot: ET.Element,
    profile: DeviceProfile,
    side: str,
    joints: tuple[str, str],
    x: float,
    ranges: dict[str, tuple[float, float]],
) -> None:
    lengths, part, (driven, passive) = profile.geometry, profile.inertia, joints
    names = [f"panto_{side}_{name}" for name in ("motor", "link1", "link2")]
    motor, link1, link2 = names
    rotor = part.reflected_rotor or _NOTHING
    _link(robot, motor, (_NOTHING, (0.0, 0.0, 0.0), (rotor, rotor)))
    joint = _hinge(robot, driven, "panto_base", motor, (x, 0.0, 0.0), ranges[driven])
    joint.find("limit").set("effort", _text(profile.limits.joint_torque))  # type: ignore[union-attr]
    friction = profile.friction
    ET.SubElement(
        joint, "dynamics", damping=_text(friction.viscous), friction=_text(friction.coulomb)
    )
    mass, inertia = part.proximal_mass, part.proximal_inertia
    body = mass, (part.proximal_centre, 0.0, 0.0), (0.01 * inertia, inertia)
    _link(robot, link1, body, lengths.proximal)
    _fixed(robot, f"{motor}_to_link1", motor, link1, (0.0, 0.0, 0.0))
    mass, inertia = part.distal_mass, part.distal_inertia
    body = mass, (part.distal_centre, 0.0, 0.0), (0.01 * inertia, inertia)
    _link(robot, link2, body, lengths.distal)
    _hinge(robot, passive, link1, link2, (lengths.proximal, 0.0, 0.0), ranges[passive])


def _needle(robot: ET.Element, profile: DeviceProfile) -> None:
    part, length = profile.inertia, profile.geometry.needle_length
    nowhere = 0.0, 0.0, 0.0
    _link(robot, "tool_theta_link", (_NOTHING, nowhere, (_NOTHING, _NOTHING)))
    _hinge(robot, "tool_theta_joint", "panto_tool0", "tool_theta_link", nowhere, (-_TURN, _TURN))
    link = ET.SubElement(robot, "link", name="tool_phi_link")
    across = part.needle_inertia or _NOTHING
    centre = 0.0, 0.0, length - part.needle_centre
    _inertial(link, part.needle_mass or _NOTHING, centre, (across, across, _NOTHING))
    visual = ET.SubElement(link, "visual")
    ET.SubElement(visual, "origin", xyz=_text(0.0, 0.0, 0.5 * length), rpy="0 0 0")
    cylinder = ET.SubElement(visual, "geometry")
    ET.SubElement(cylinder, "cylinder", length=_text(length), radius="0.0025")
    tilt = profile.tilt_limit
    _hinge(
        robot, "tool_phi_joint", "tool_theta_link", "tool_phi_link", nowhere, (-tilt, tilt), "0 1 0"
    )


_Body = tuple[float, tuple[float, float, float], tuple[float, float]]
"""Mass, centre of mass, inertia along the link and across it."""


def _link(
    robot: ET.Element, name: str, body: _Body | None = None, length: float | None = None
) -> None:
    link = ET.SubElement(robot, "link", name=name)
    if body is not None:
        mass, centre, (along, across) = body
        _inertial(link, mass, centre, (along, across, across))
    if length is not None:
        visual = ET.SubElement(link, "visual")
        ET.SubElement(visual, "origin", xyz=_text(0.5 * length, 0.0, 0.0), rpy="0 0 0")
        box = ET.SubElement(visual, "geometry")
        ET.SubElement(box, "box", size=_text(length, 0.012, 0.008))


def _inertial(
    link: ET.Element,
    mass: float,
    centre: tuple[float, float, float],
    inertia: tuple[float, float, float],
) -> None:
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=_text(*centre), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=_text(mass))
    moments = dict(zip(("ixx", "iyy", "izz"), map(_text, inertia), strict=True))
    ET.SubElement(inertial, "inertia", moments | {"ixy": "0", "ixz": "0", "iyz": "0"})


def _joint(
    robot: ET.Element,
    name: str,
    kind: str,
    parent: str,
    child: str,
    xyz: tuple[float, float, float],
) -> ET.Element:
    joint = ET.SubElement(robot, "joint", name=name, type=kind)
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)
    ET.SubElement(joint, "origin", xyz=_text(*xyz), rpy="0 0 0")
    return joint


def _fixed(
    robot: ET.Element, name: str, parent: str, child: str, xyz: tuple[float, float, float]
) -> None:
    _joint(robot, name, "fixed", parent, child, xyz)


def _hinge(
    robot: ET.Element,
    name: str,
    parent: str,
    child: str,
    xyz: tuple[float, float, float],
    limits: tuple[float, float],
    axis: str = "0 0 1",
) -> ET.Element:
    joint = _joint(robot, name, "revolute", parent, child, xyz)
    ET.SubElement(joint, "axis", xyz=axis)
    low, high = map(_text, limits)
    ET.SubElement(joint, "limit", effort="0", lower=low, upper=high, velocity=_text(_SPEED))
    return joint


def _joint_ranges(profile: DeviceProfile) -> dict[str, tuple[float, float]]:
    """Smallest and largest angle of each joint over the cone of the tilt limit [rad]."""
    geometry = profile.pantograph
    rows = []
    for tilt in np.linspace(0.0, profile.tilt_limit, _RINGS):
        for turn in np.linspace(0.0, 2.0 * np.pi, _SPOKES, endpoint=False):
            lean = geometry.fulcrum[2] * np.tan(tilt) * np.array([np.cos(turn), np.sin(turn)])
            try:
                q = inverse(geometry, geometry.fulcrum[:2] + lean)
            except MechanismError as error:
                raise MechanismError(
                    f"device {profile.name} does not reach all of its tilt limit of"
                    f" {profile.tilt_limit_deg:g}°: {error}"
                ) from error
            passive = passive_angles(geometry, q)
            rows.append([*q, passive.left_relative, passive.right_relative])
    low, high = np.min(rows, axis=0), np.max(rows, axis=0)
    names = "panto_a1", "panto_a5", "panto_a2", "panto_a4"
    return {name: (float(low[k]), float(high[k])) for k, name in enumerate(names)}


def _text(*numbers: float) -> str:
    return " ".join(repr(float(number)) for number in numbers)
