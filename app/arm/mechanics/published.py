"""The arm as its published description has it: joints by origin and axis, masses of the links.

Numbers of others, kept with source and licence (`profiles/arms/published`), that share nothing
with the profile's table: what other programs are built from, to check Acus' kinematics against.
"""

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Annotated, Final

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field

from app.arm.mechanics.profile import ArmProfile
from app.core.arrays import FloatArray, cross, frozen
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform

_PUBLISHED: Final = Path(__file__).resolve().parents[1] / "profiles" / "arms" / "published"

_Number = Annotated[float, Field(ge=-200.0, le=200.0)]
_Triple = tuple[_Number, _Number, _Number]


class PublishedPlace(Strict):
    """Where a frame stands in the link before it.

    Attributes:
        xyz: its origin [m].
        rpy: roll, pitch, yaw about the fixed axes x, y, z [half turns].
    """

    xyz: _Triple
    rpy: _Triple

    @property
    def transform(self) -> RigidTransform:
        """The same as a transform; quarter turns are exact."""
        roll, pitch, yaw = (_turn(k, angle) for k, angle in enumerate(self.rpy))
        return RigidTransform(yaw @ pitch @ roll, np.array(self.xyz))


class PublishedLink(Strict):
    """A link: mass [kg], centre of mass [m], principal moments along its own axes [kg·m²]."""

    mass: _Number
    centre: _Triple
    inertia: _Triple


class PublishedJoint(PublishedPlace, PublishedLink):
    """A joint that turns about its own z, either way as far as `limit_deg`; the link it carries."""

    name: str
    limit_deg: _Number


class PublishedArm(Strict):
    """All of it, from the base outwards."""

    name: str
    joints: tuple[PublishedJoint, ...]
    flange: PublishedPlace
    base: PublishedLink

    def weight_torques(
        self,
        q: ArrayLike,
        g_base: ArrayLike,
        carried: float = 0.0,
        carried_at: ArrayLike = (0.0, 0.0, 0.0),
    ) -> FloatArray:
        """Torques by which the joints hold up the links and what the flange carries [N·m], (7,).

        Args:
            q: joint angles [rad], shape (7,).
            g_base: acceleration of gravity in the base's frame [m/s²], shape (3,).
            carried: mass on the flange [kg].
            carried_at: its centre in the flange's frame [m], shape (3,).
        """
        angles = frozen(q, (len(self.joints),), "q")
        gravity = frozen(g_base, (3,), "g_base")
        here = RigidTransform.identity()
        axes, origins, weights = [], [], []
        for joint, angle in zip(self.joints, angles, strict=True):
            turned = RigidTransform.from_rotation(rotation_exp([0.0, 0.0, angle]))
            here = here @ joint.transform @ turned
            axes.append(here.rotation[:, 2])
            origins.append(here.translation)
            weights.append((joint.mass, here @ np.array(joint.centre)))
        at = here @ self.flange.transform @ frozen(carried_at, (3,), "carried_at")
        beyond = [*weights, (carried, at)]
        return np.array(
            [
                -sum(mass * axis @ cross(p - origin, gravity) for mass, p in beyond[k:])
                for k, (axis, origin) in enumerate(zip(axes, origins, strict=True))
            ]
        )


def published_arm(name: str = "iiwa14") -> PublishedArm:
    """Read a published description that ships.

    Raises:
        ConfigurationError: if there is none of that name, or its file is wrong.
    """
    path = _PUBLISHED / f"{name}.yaml"
    if not path.is_file():
        raise ConfigurationError(
            sentence("no published description of arm {name!r}; there is iiwa14", name=name)
        )
    return load(path, PublishedArm)


def _turn(axis: int, half_turns: float) -> FloatArray:
    i, j = (axis + 1) % 3, (axis + 2) % 3
    # sinpi and cospi, so that a quarter turn has exact zeros
    quarters = 2.0 * half_turns
    exact = quarters == round(quarters)
    c, s = (
        ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters) % 4]
        if exact
        else (np.cos(np.pi * half_turns), np.sin(np.pi * half_turns))
    )
    turned = np.eye(3)
    turned[i, i], turned[i, j], turned[j, i], turned[j, j] = c, -s, s, c
    return turned


def write_arm_urdf(arm: ArmProfile, published: PublishedArm) -> str:
    """Return an arm as URDF text; it has no shapes, which the published description keeps apart.

    Links are `link_0` (the base) to `link_7`, then `flange` and `tool`; joints `joint_1` to
    `joint_7` turn about their own z. `world` carries the base where the profile places it.
    """
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
