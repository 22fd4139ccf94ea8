"""The scene as MuJoCo reads it.

The arm comes from its published description (origins, masses, inertias, limits); the hand's fingers
from the geometry of `arm.hand`, so that a finger's grasp point is where `forward` says.
Shapes are simple: capsules, cylinders and boxes.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from math import cos, pi, sin
from typing import Final

import numpy as np

from app.arm.hand import HandFinger, HandGeometry
from app.arm.laparoscopy import (
    RING_HALF,
    TOOL_GREEN,
    TROCAR_BLUE,
    SceneBox,
    ToolBody,
    TrocarRing,
)
from app.arm.mechanics import PublishedArm
from app.arm.scene.layout import ArmScene
from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.simulation.mjcf import line, text

RING: Final = 24
"""Boxes of which the trocar is made."""

# Who touches whom: the world everything but itself, arm and hand also themselves.
_WORLD: Final = {"contype": "1", "conaffinity": "0"}
_ARM: Final = {"contype": "2", "conaffinity": "3"}
_TOOL: Final = {"contype": "4", "conaffinity": "3"}

ARM_RADIUS: Final = 0.062
"""Of the arm's links [m]."""

_SLIM: Final = 0.048  # beyond the wrist [m]
_FINGER_MASS: Final = 0.04  # of each of a finger's two links, an estimate [kg]
_ROTOR: Final = 1.6e-3  # of a finger's motor, as its joint feels it [kg·m²], an estimate


def write_scene(scene: ArmScene) -> str:
    """Return the scene as MJCF text.

    Joints are `joint_1` … `joint_7`, the tool's free joint `tool`, and `one_2`, `one_3` … of the
    fingers; sites `flange`, `hand` and `tip`.
    """
    root = ET.Element("mujoco", model=scene.arm.name)
    ET.SubElement(root, "compiler", angle="radian", autolimits="true")
    option = ET.SubElement(
        root,
        "option",
        timestep=text(scene.step),
        gravity="0 0 -9.80665",
        integrator="implicitfast",
        cone="elliptic",
        impratio="20",
        noslip_iterations="3",
    )
    ET.SubElement(option, "flag", multiccd="enable")
    visual = ET.SubElement(root, "visual")
    ET.SubElement(visual, "global", offwidth="1280", offheight="960")
    ET.SubElement(visual, "headlight", ambient="0.35 0.35 0.35", diffuse="0.45 0.45 0.45")
    sky = {"type": "skybox", "builtin": "gradient", "width": "64", "height": "384"}
    ET.SubElement(
        ET.SubElement(root, "asset"), "texture", sky, rgb1="0.86 0.88 0.92", rgb2="0.55 0.58 0.64"
    )
    world = ET.SubElement(root, "worldbody")
    ET.SubElement(world, "light", pos="0.3 -0.8 1.6", dir="-0.2 0.5 -1", diffuse="0.5 0.5 0.5")
    for box in scene.boxes:
        _box(world, box, scene.trocar)
    _ring(world, scene.trocar)
    _tool(world, scene.tool, scene.T_world_tool)
    last = _arm(world, scene)
    hand = scene.hand.hand
    _hand(last, scene, hand)
    contact = ET.SubElement(root, "contact")
    for first, second in _neighbours(scene.published):
        ET.SubElement(contact, "exclude", body1=first, body2=second)
    actuators = ET.SubElement(root, "actuator")
    for finger in HandFinger:
        for joint in (2, 3):
            ET.SubElement(
                actuators,
                "position",
                name=finger_joint(finger, joint),
                joint=finger_joint(finger, joint),
                kp=text(scene.finger_stiffness),
                dampratio="1",
            )
    ET.indent(root)
    return ET.tostring(root, encoding="unicode")


def finger_joint(finger: HandFinger, joint: int) -> str:
    """Name of joint 2 or 3 of a finger."""
    return f"{finger.name.lower()}_{joint}"


def _placed(place: RigidTransform) -> dict[str, str]:
    return {
        "pos": text(*place.translation),
        "xyaxes": text(*place.rotation[:, 0], *place.rotation[:, 1]),
    }


def _coloured(colour: tuple[float, float, float]) -> str:
    blue, green, red = colour
    return text(red / 255.0, green / 255.0, blue / 255.0, 1.0)


def _pieces(box: SceneBox, at: FloatArray) -> Iterator[SceneBox]:
    """Yield the box without its hole below a point: itself, or four round it."""
    if not box.hole:
        yield box
        return
    (x0, y0, z0), (x1, y1, z1) = box.low, box.high
    west, east = max(x0, at[0] - box.hole), min(x1, at[0] + box.hole)
    south, north = max(y0, at[1] - box.hole), min(y1, at[1] + box.hole)
    for low, high in (
        ((x0, y0, z0), (west, y1, z1)),
        ((east, y0, z0), (x1, y1, z1)),
        ((west, y0, z0), (east, south, z1)),
        ((west, north, z0), (east, y1, z1)),
    ):
        if low[0] < high[0] and low[1] < high[1]:
            yield replace(box, low=low, high=high, hole=0.0)


def _box(world: ET.Element, box: SceneBox, trocar: TrocarRing) -> None:
    for k, piece in enumerate(_pieces(box, trocar.p_world)):
        low, high = np.array(piece.low), np.array(piece.high)
        ET.SubElement(
            world,
            "geom",
            _WORLD,
            name=f"{box.name}:{k}:{low[0]:.3f},{low[1]:.3f}",
            type="box",
            pos=text(*(0.5 * (low + high))),
            size=text(*(0.5 * (high - low))),
            rgba=_coloured(box.colour),
            condim="6",
            friction="0.8 0.005 0.0005",
        )


def _ring(world: ET.Element, trocar: TrocarRing) -> None:
    normal = trocar.normal_world
    first = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    radial = 0.5 * (trocar.outer - trocar.inner)
    for k in range(RING):
        angle = 2.0 * pi * k / RING
        out = cos(angle) * first + sin(angle) * second
        along = cos(angle) * second - sin(angle) * first
        # below and above the plane of the centre; the sides inscribe the hole's circle
        ET.SubElement(
            world,
            "geom",
            _WORLD,
            name=f"trocar:{k}",
            type="box",
            pos=text(*(trocar.p_world + (trocar.inner + radial) * out)),
            xyaxes=text(*out, *along),
            size=text(radial, trocar.outer * np.tan(pi / RING), RING_HALF),
            rgba=_coloured(TROCAR_BLUE),
        )


def _tool(world: ET.Element, tool: ToolBody, place: RigidTransform) -> None:
    body = ET.SubElement(world, "body", _placed(place), name="tool")
    ET.SubElement(body, "freejoint", name="tool")
    shaft, thick = 0.5 * tool.shaft_diameter, 0.5 * tool.handle_diameter
    neck = tool.length - tool.point_length
    volumes = np.array([thick**2 * tool.handle_length, shaft**2 * (neck - tool.handle_length)])
    common = {"rgba": _coloured(TOOL_GREEN), "condim": "6", **_TOOL}
    for name, start, end, radius, mass in (
        ("handle", 0.0, tool.handle_length, thick, volumes[0]),
        ("shaft", tool.handle_length, neck, shaft, volumes[1]),
    ):
        ET.SubElement(
            body,
            "geom",
            common,
            name=name,
            type="cylinder",
            fromto=text(0.0, 0.0, start, 0.0, 0.0, end),
            size=text(radius),
            mass=text(tool.mass * mass / volumes.sum()),
            friction="0.8 0.005 0.0005",
        )
    # The taper, as a slim rod on its middle's radius; it weighs nothing.
    ET.SubElement(
        body,
        "geom",
        common,
        name="point",
        type="capsule",
        fromto=text(0.0, 0.0, neck, 0.0, 0.0, tool.length - 0.25 * shaft),
        size=text(0.25 * shaft),
        mass="0",
    )
    ET.SubElement(body, "site", name="tip", pos=text(0.0, 0.0, tool.length), size="0.002")


def _arm(world: ET.Element, scene: ArmScene) -> ET.Element:
    arm = scene.published
    grey = "0.78 0.78 0.80 1"
    body = ET.SubElement(world, "body", _placed(scene.arm.T_world_base), name="base")
    _inertial(body, arm.base.mass, arm.base.centre, arm.base.inertia)
    line(body, (0, 0, 0.07), arm.joints[0].xyz, 0.07, grey, name="base", **_ARM)
    ends = [joint.xyz for joint in arm.joints[1:]] + [arm.flange.xyz]
    for k, (joint, end) in enumerate(zip(arm.joints, ends, strict=True)):
        body = ET.SubElement(body, "body", _placed(joint.transform), name=joint.name)
        limit = joint.limit_deg * pi / 180.0
        ET.SubElement(body, "joint", name=joint.name, axis="0 0 1", range=text(-limit, limit))
        _inertial(body, joint.mass, joint.centre, joint.inertia)
        radius = ARM_RADIUS if k < 5 else _SLIM
        stop = np.array(end)
        if k == 6:  # its round end stays behind the flange's plate
            stop = stop - [0.0, 0.0, radius]
        line(body, (0, 0, 0), stop, radius, grey, name=joint.name, **_ARM)
    return body


def _inertial(
    body: ET.Element,
    mass: float,
    centre: tuple[float, float, float],
    inertia: tuple[float, float, float],
) -> None:
    ET.SubElement(body, "inertial", pos=text(*centre), mass=text(mass), diaginertia=text(*inertia))


def _hand(last: ET.Element, scene: ArmScene, hand: HandGeometry) -> None:
    flange = scene.published.flange.transform
    ET.SubElement(last, "site", _placed(flange), name="flange", size="0.002")
    body = ET.SubElement(last, "body", _placed(flange @ scene.arm.T_flange_tool), name="hand")
    ET.SubElement(body, "site", name="hand", size="0.002")
    height = float(scene.arm.T_flange_tool.translation[2])
    ET.SubElement(
        body,
        "geom",
        _ARM,
        name="palm",
        type="cylinder",
        fromto=text(0.0, 0.0, -height, 0.0, 0.0, -hand.joint_height),
        size=text(hand.palm_radius),
        mass=text(scene.hand_mass - 6 * _FINGER_MASS),
        rgba="0.25 0.25 0.28 1",
    )
    tip = hand.distal - hand.pad
    for finger in HandFinger:
        name = finger.name.lower()
        base = ET.SubElement(body, "body", _placed(finger.placed(hand)), name=name)
        line(base, (0, 0, -hand.joint_height), (hand.knuckle, 0, 0), hand.pad, "0.25 0.25 0.28 1")
        link = ET.SubElement(base, "body", name=f"{name}_proximal", pos=text(hand.knuckle, 0, 0))
        _finger_link(link, finger, 2, hand.most_proximal, (hand.proximal, 0.0, 0.0), hand, scene)
        link = ET.SubElement(link, "body", name=f"{name}_distal", pos=text(hand.proximal, 0, 0))
        end = (tip * cos(hand.bend), 0.0, tip * sin(hand.bend))
        _finger_link(link, finger, 3, hand.most_distal, end, hand, scene)


def _finger_link(
    body: ET.Element,
    finger: HandFinger,
    joint: int,
    most: float,
    end: tuple[float, float, float],
    hand: HandGeometry,
    scene: ArmScene,
) -> None:
    # Closing bends away from the palm: about -y, as x turns towards z.
    ET.SubElement(
        body,
        "joint",
        name=finger_joint(finger, joint),
        axis="0 -1 0",
        range=text(-0.02, most + 0.02),
        armature=text(_ROTOR),
    )
    ET.SubElement(
        body,
        "geom",
        _ARM,
        name=finger_joint(finger, joint),
        type="capsule",
        fromto=text(0.0, 0.0, 0.0, *end),
        size=text(hand.pad),
        mass=text(_FINGER_MASS),
        rgba="0.35 0.36 0.40 1",
        condim="4",
        friction=text(scene.friction, 0.005, 0.0005),
        priority="1",
        solref=text(2.0 * scene.step, 1.0),  # the shortest that MuJoCo takes: least drift
    )


def _neighbours(arm: PublishedArm) -> Iterator[tuple[str, str]]:
    """Yield the bodies that never part: links with the next but one, the wrist with the hand."""
    names = ["base", *(joint.name for joint in arm.joints)]
    yield names[0], names[1]
    for k in range(len(names) - 2):
        yield names[k], names[k + 2]
    fingers = [f"{f.name.lower()}_{link}" for f in HandFinger for link in ("proximal", "distal")]
    for part in ("hand", *fingers):
        yield names[-2], part
    for part in fingers:
        yield names[-1], part
    yield names[-3], "hand"
