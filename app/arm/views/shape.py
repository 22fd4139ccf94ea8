"""Where the simulated arm's parts are at one moment, in patient LPS millimetres, as it is drawn."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.units import MILLIMETRE
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.scene.shape import Hoop, ScenePiece, SceneShape

if TYPE_CHECKING:
    from app.arm.scene.layout import ArmScene
    from app.arm.scene.performance import ArmMoment, ArmPerformance
    from app.core.transform import RigidTransform


class ArmPart(Enum):
    """What a piece is; its colour: neighbours differ in lightness, so that everybody tells them."""

    LINK = Mark("#b3bfca")
    JOINT = Mark("#4a5663")
    FINGER = Mark("#94a3b2")
    TOOL = Mark("#f7f3e4")
    RAIL = Mark("#7d8791")


def arm_shape(performance: ArmPerformance, t: float, T_patient_world: RigidTransform) -> SceneShape:
    """Return arm, hand, tool, the tray's rails and the trocar at a time [s] of a performance.

    Args:
        performance: what the arm did, over the bench.
        t: time in it [s].
        T_patient_world: where the bench is.
    """
    scene = performance.scene
    T = T_patient_world @ performance.T_scene_world.inverse()
    moment = performance.timeline.at(t)
    parts = (*_arm(scene, moment), *_tool(scene, moment), *_surroundings(scene))
    pieces = tuple(
        ScenePiece((T @ np.asarray(ends)) / MILLIMETRE, radius / MILLIMETRE, part.value, rounded)
        for ends, radius, part, rounded in parts
    )
    ring = scene.trocar
    trocar = Hoop(
        frozen((T @ ring.p_world) / MILLIMETRE),
        frozen(T.rotate(ring.normal_world)),
        (ring.inner / MILLIMETRE, ring.outer / MILLIMETRE),
        theme.ENTRY,
    )
    return SceneShape(pieces, (trocar,))


_Found = tuple[tuple[FloatArray, FloatArray], float, ArmPart, bool]

_WIDE, _SLIM = 0.058, 0.046  # radii of upper arm and forearm, and beyond the wrist [m]
_STAND: Final = 0.30  # height of what it stands on, as far as it is drawn [m]
_RIM: Final = 0.004  # radius of the tray's rim [m]
_BAND: Final = 0.012  # half the height of a joint's band [m]


def _arm(scene: ArmScene, moment: ArmMoment) -> list[_Found]:
    """Return links with a band at each joint that turns about them, the hand, its fingers."""
    from app.arm.mechanics import link_frames  # compiled: only for who watches an arm

    base, frames = scene.arm.T_world_base, link_frames(scene.arm, moment.q)
    foot, shoulder, elbow, wrist = (
        base @ point for point in (np.zeros(3), *(frames[k, :3, 3] for k in (1, 3, 5)))
    )
    along = base.rotate(frames[6, :3, 2])
    flange = wrist + scene.arm.flange * along
    links: list[_Found] = [
        ((foot, shoulder), _WIDE, ArmPart.LINK, True),
        ((shoulder, elbow), _WIDE, ArmPart.LINK, True),
        ((elbow, wrist), _WIDE, ArmPart.LINK, True),
        ((wrist, flange), _SLIM, ArmPart.LINK, False),
    ]
    bands: list[_Found] = []
    for start, end in ((foot, shoulder), (shoulder, elbow), (elbow, wrist)):
        way, middle = (end - start) / np.linalg.norm(end - start), 0.5 * (start + end)
        ends = middle - _BAND * way, middle + _BAND * way
        bands.append((ends, 1.06 * _WIDE, ArmPart.JOINT, False))
    return [*links, *bands, *_hand(scene, moment, flange, along)]


def _hand(
    scene: ArmScene, moment: ArmMoment, flange: FloatArray, along: FloatArray
) -> list[_Found]:
    from app.arm.hand import HandFinger
    from app.arm.mechanics import forward

    hand = scene.hand.hand
    T_scene_hand = scene.arm.tool_pose(forward(scene.arm, moment.q))
    palm = T_scene_hand @ np.array([0.0, 0.0, -hand.joint_height])
    found: list[_Found] = [((flange, palm), hand.palm_radius, ArmPart.JOINT, False)]
    for finger, (second, third) in zip(HandFinger, moment.fingers, strict=True):
        T = T_scene_hand @ finger.placed(hand)
        tip, last = hand.distal - hand.pad, second + third + hand.bend
        first = np.array([hand.knuckle, 0.0, 0.0])
        middle = first + hand.proximal * np.array([np.cos(second), 0.0, np.sin(second)])
        end = middle + tip * np.array([np.cos(last), 0.0, np.sin(last)])
        foot, first, middle, end = (
            T @ point for point in (np.array([0.0, 0.0, -hand.joint_height]), first, middle, end)
        )
        found += [
            ((foot, first), hand.pad, ArmPart.JOINT, True),
            ((first, middle), hand.pad, ArmPart.FINGER, True),
            ((middle, end), hand.pad, ArmPart.FINGER, True),
        ]
    return found


def _tool(scene: ArmScene, moment: ArmMoment) -> list[_Found]:
    tool, T = scene.tool, moment.T_scene_tool
    neck = tool.length - tool.point_length
    start, handle, taper, tip = (
        T @ np.array([0.0, 0.0, along]) for along in (0.0, tool.handle_length, neck, tool.length)
    )
    return [
        ((start, handle), 0.5 * tool.handle_diameter, ArmPart.TOOL, False),
        ((handle, taper), 0.5 * tool.shaft_diameter, ArmPart.TOOL, False),
        ((taper, tip), 0.2 * tool.shaft_diameter, ArmPart.TOOL, False),
    ]


def _surroundings(scene: ArmScene) -> list[_Found]:
    """Return what the arm stands on, the tray's rim, and its rails, each along its longest side."""
    foot = scene.arm.T_world_base.translation
    below = foot - [0.0, 0.0, _STAND]
    found: list[_Found] = [((below, foot), 1.3 * _WIDE, ArmPart.RAIL, False)]
    for box in scene.boxes:
        low, high = np.array(box.low), np.array(box.high)
        if box.name == "tray":
            corners = [
                np.array([x, y, high[2]])
                for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]))
            ]
            corners.append(np.array([low[0], high[1], high[2]]))
            found += [((corners[k - 1], corners[k]), _RIM, ArmPart.RAIL, True) for k in range(4)]
        elif box.name.endswith("rail"):
            side = high - low
            longest = int(np.argmax(side))
            middle, half = 0.5 * (low + high), np.zeros(3)
            half[longest] = 0.5 * side[longest]
            thick = 0.5 * float(np.delete(side, longest).min())
            found.append(((middle - half, middle + half), thick, ArmPart.RAIL, False))
    return found
