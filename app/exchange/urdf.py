"""A device profile as URDF, and its lengths from one.

Links and joints are named as in the laboratory's public description.

URDF holds trees only, so the loop is cut as there: the left arm (`panto_a1`, `panto_a2`) carries
the tool (`panto_a3`, `panto_tool0`), the right arm (`panto_a5`, `panto_a4`) ends in a frame of its
own (`panto_right_end`, ours) that must be brought to the tool. The needle stands on the tool, tip
at P3 (`tool_theta_joint` turns it about z, `tool_phi_joint` tilts it from the vertical), and its
end in the hand slides along it (`needle_interaction_joint`: L_in + L_out).

The frame of `panto_base` is the laboratory's: its origin is the *left motor axis*, so x is greater
than in Acus' world, which starts midway between the motors, by half the base. `Origin` says where
the root link `world` stands.

What is read from a URDF, or from the text of a xacro with literal numbers (names as above):

| value | from |
|---|---|
| base | `panto_a5` less `panto_a1`, x of the origins |
| proximal | `panto_a2` and `panto_a4`, x: both arms must agree |
| distal | `panto_a3`, x, and `panto_right_link2_to_end` where the file has it |
| fulcrum | `panto_base_to_fulcrum`, x from midway between the motors |
| needle length | the cylinder of the link `tool_phi_link` |

The file may come from anywhere: a document type declaration (and with it every entity) is refused.
"""

import xml.etree.ElementTree as ET
from enum import StrEnum
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from app.core.configuration import parse
from app.core.errors import reading
from app.core.files import read_at_most
from app.core.messages import sentence
from app.exchange.errors import UrdfError
from app.mechanisms.errors import MechanismError
from app.mechanisms.pantograph import inverse, passive_angles
from app.mechanisms.pantograph.profile import GeometrySection, PantographProfile
from app.mechanisms.profile import Provenance, parse_profile

_LARGEST = 5_000_000
"""Size above which a file is no robot description [bytes]."""

_SAME = 1e-6
"""Difference of the two arms that is taken for rounding [m]."""

_DIGITS = 12
"""Decimals that are kept of a difference of two lengths [m]."""


def read_geometry(path: Path) -> GeometrySection:
    """Read the lengths; each is marked as imported: the file does not say where it has them.

    Raises:
        UrdfError: if the file cannot be read, is no XML, has a document type, lacks a joint, has
            an expression instead of a number, or its arms differ.
        ConfigurationError: if the lengths make no needle pantograph.
    """
    root = _root(path)
    joints = _Joints(path, root)
    left, right = joints.origin("panto_a1"), joints.origin("panto_a5")
    middle = 0.5 * (left[0] + right[0])
    if left[1:] != (0.0, 0.0) or right[1:] != (0.0, 0.0):
        raise UrdfError(
            sentence(
                "{path}: panto_a1 {left} and panto_a5 {right} must lie on the x axis",
                path=path,
                left=left,
                right=right,
            )
        )
    proximal = _equal(path, joints, "panto_a2", "panto_a4")
    distal = joints.length("panto_a3")
    if joints.has("panto_right_link2_to_end"):
        distal = _equal(path, joints, "panto_a3", "panto_right_link2_to_end")
    x, y, z = joints.origin("panto_base_to_fulcrum")
    values: dict[str, Any] = {
        "proximal": proximal,
        "distal": distal,
        "base": round(right[0] - left[0], _DIGITS),
        "fulcrum": (round(x - middle, _DIGITS), y, z),
        "needle_length": _needle_length(path, root),
    }
    provenance = dict.fromkeys(values, Provenance.IMPORTED)
    return parse(values | {"provenance": provenance}, GeometrySection, str(path))


def profile_like(model: PantographProfile, geometry: GeometrySection, name: str) -> dict[str, Any]:
    """Return a profile document (for YAML) with the geometry read and all else from `model`.

    What was measured or published of the model is an estimate of another robot, and marked so.

    Raises:
        ConfigurationError: if the two do not fit together.
    """
    document = model.model_dump(mode="json", exclude_none=True)
    document["name"] = name
    document["description"] = f"lengths from a URDF, all else from {model.name}"
    for section in document.values():
        if isinstance(section, dict):
            section["provenance"] = dict.fromkeys(section["provenance"], "estimated")
    document["geometry"] = geometry.model_dump(mode="json")
    parse_profile(document, f"profile {name}")
    return document


class _NoDoctype(ET.TreeBuilder):
    """Builder that ends at a document type declaration: entities could be anything, and huge."""

    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        raise UrdfError(
            sentence("has a document type declaration (DOCTYPE), which a URDF never needs")
        )


class _Joints:
    """Origins of the joints of a file, by name."""

    def __init__(self, path: Path, root: ET.Element) -> None:
        self.path = path
        self.found: dict[str, ET.Element] = {}
        for joint in root.iter("joint"):
            name = joint.get("name", "")
            if name in self.found and joint.find("origin") is not None:
                raise UrdfError(
                    sentence("{path}: joint {name!r} is there twice", path=path, name=name)
                )
            if joint.find("parent") is not None:  # not those of ros2_control
                self.found[name] = joint

    def has(self, name: str) -> bool:
        return name in self.found

    def origin(self, name: str) -> tuple[float, float, float]:
        if name not in self.found:
            there = ", ".join(sorted(self.found)) or "no joints"
            raise UrdfError(
                sentence(
                    "{path}: joint {name!r} is missing; there are: {there}",
                    path=self.path,
                    name=name,
                    there=there,
                )
            )
        origin = self.found[name].find("origin")
        if origin is None:
            return 0.0, 0.0, 0.0  # URDF's own default
        what = f"{self.path}: joint {name!r}, origin"
        if any(_numbers(origin.get("rpy", "0 0 0"), what)):
            turned = origin.get("rpy")
            raise UrdfError(
                sentence(
                    "{place}: rpy is {turned!r}; turned joints are not supported",
                    place=what,
                    turned=turned,
                )
            )
        return _numbers(origin.get("xyz", "0 0 0"), what)

    def length(self, name: str) -> float:
        x, y, z = self.origin(name)
        if (y, z) != (0.0, 0.0) or not x > 0.0:
            raise UrdfError(
                sentence(
                    "{path}: joint {name!r} stands at ({x}, {y}, {z}) m; a link of the arms goes"
                    " along +x",
                    path=self.path,
                    name=name,
                    x=x,
                    y=y,
                    z=z,
                )
            )
        return x


def _equal(path: Path, joints: _Joints, left: str, right: str) -> float:
    one, other = joints.length(left), joints.length(right)
    if abs(one - other) > _SAME:
        raise UrdfError(
            sentence(
                "{path}: the arms differ: {left} at {left_m} m, {right} at {right_m} m; Acus' "
                "pantograph is symmetric",
                path=path,
                left=left,
                left_m=one,
                right=right,
                right_m=other,
            )
        )
    return one


def _needle_length(path: Path, root: ET.Element) -> float:
    for link in root.iter("link"):
        if link.get("name") == "tool_phi_link":
            for cylinder in link.iter("cylinder"):
                text = cylinder.get("length", "")
                return _number(text, f"{path}: link 'tool_phi_link', cylinder length")
            raise UrdfError(
                sentence(
                    "{path}: link 'tool_phi_link' has no cylinder, which is the needle", path=path
                )
            )
    raise UrdfError(
        sentence("{path}: link 'tool_phi_link' is missing; the needle is its cylinder", path=path)
    )


def _numbers(text: str, place: str) -> tuple[float, float, float]:
    parts = text.split()
    if len(parts) != 3:
        raise UrdfError(
            sentence("{place}: {coordinates!r} is not three numbers", place=place, coordinates=text)
        )
    x, y, z = (_number(part, place) for part in parts)
    return x, y, z


def _number(text: str, place: str) -> float:
    if "$" in text:
        raise UrdfError(
            sentence(
                "{place}: {expression!r} is a xacro expression; expand the file first"
                " (xacro FILE > out.urdf)",
                place=place,
                expression=text,
            )
        )
    try:
        value = float(text)
    except ValueError:
        raise UrdfError(
            sentence("{place}: {coordinate!r} is not a number", place=place, coordinate=text)
        ) from None
    if not isfinite(value):
        raise UrdfError(
            sentence("{place}: {coordinate!r} is not finite", place=place, coordinate=text)
        )
    return value


def _root(path: Path) -> ET.Element:
    with reading(path, UrdfError):
        content = read_at_most(path, _LARGEST)
    parser = ET.XMLParser(target=_NoDoctype())
    try:
        parser.feed(content)
        root: ET.Element = parser.close()
    except UrdfError as error:
        raise UrdfError(sentence("{path} {error}", path=path, error=error)) from None
    except (ET.ParseError, ValueError, LookupError) as error:
        raise UrdfError(sentence("{path} is not XML: {error}", path=path, error=error)) from error
    return root


_TURN = 3.141592653589793
_SPEED = 10.0
"""Speed limit of the joints [rad/s]: URDF demands one, the profile has none."""

_SLIDE = 0.5
"""How far the hand's end of the needle may be from the tool [m]: the laboratory's limits, which
stand the wrong way round there."""

_NOTHING = 1e-9
"""Mass [kg] and inertia [kg·m²] of what has none in our mechanics; simulators refuse zero."""

_RINGS, _SPOKES = 8, 72


_PARTS = {
    "panto_base": "base",
    **{f"panto_{side}_{part}": part for side in ("left", "right") for part in ("link1", "link2")},
    **{f"panto_{side}_motor": "motor" for side in ("left", "right")},
    "needle_interaction_link": "hub",
}
"""Which mesh a link has; the needle stays the cylinder that its length is read from."""


class Origin(StrEnum):
    """Where the root link stands: on the left motor axis, or midway between the motors (Acus)."""

    LEFT_MOTOR = "left-motor"
    MIDPOINT = "midpoint"


def write_urdf(
    profile: PantographProfile, origin: Origin = Origin.LEFT_MOTOR, meshes: str | None = None
) -> str:
    """Return the profile as URDF text.

    Effort limits are the profile's torque limit, angle limits what its tilt limit needs; passive
    joints have no effort.

    Args:
        profile: to write.
        origin: where the root link stands.
        meshes: stem of the files of `urdf_meshes`, which lie beside it; None draws boxes.

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
    if meshes is not None:
        _with_meshes(robot, meshes)
    ET.indent(robot)
    return f"{ET.tostring(robot, encoding='unicode', xml_declaration=True)}\n"


def _with_meshes(robot: ET.Element, stem: str) -> None:
    """Put the meshes in the place of the boxes, and to the links that have none."""
    for link in robot.iter("link"):
        part = _PARTS.get(link.get("name", ""))
        if part is None:
            continue
        box = link.find("visual")
        if box is not None:
            link.remove(box)
        visual = ET.SubElement(link, "visual")
        ET.SubElement(visual, "origin", xyz="0 0 0", rpy="0 0 0")
        geometry = ET.SubElement(visual, "geometry")
        ET.SubElement(geometry, "mesh", filename=f"{stem}-{part}.stl")


def _arm(
    robot: ET.Element,
    profile: PantographProfile,
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


def _needle(robot: ET.Element, profile: PantographProfile) -> None:
    part, length = profile.inertia, profile.needle_length
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
    slides = "needle_interaction_joint"
    _link(robot, "needle_interaction_link", (_NOTHING, nowhere, (_NOTHING, _NOTHING)))
    joint = _joint(robot, slides, "prismatic", "tool_phi_link", "needle_interaction_link", nowhere)
    ET.SubElement(joint, "axis", xyz="0 0 1")
    low, high = map(_text, (-_SLIDE, _SLIDE))
    ET.SubElement(joint, "limit", effort="0", lower=low, upper=high, velocity=_text(_SPEED))


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


def _joint_ranges(profile: PantographProfile) -> dict[str, tuple[float, float]]:
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
                    sentence(
                        "device {profile_name} does not reach all of its tilt limit of"
                        " {profile_tilt_limit_deg:g}°: {error}",
                        profile_name=profile.name,
                        profile_tilt_limit_deg=profile.tilt_limit_deg,
                        error=error,
                    )
                ) from error
            passive = passive_angles(geometry, q)
            rows.append([*q, passive.left_relative, passive.right_relative])
    low, high = np.min(rows, axis=0), np.max(rows, axis=0)
    names = "panto_a1", "panto_a5", "panto_a2", "panto_a4"
    return {name: (float(low[k]), float(high[k])) for k, name in enumerate(names)}


def _text(*numbers: float) -> str:
    return " ".join(repr(float(number)) for number in numbers)
