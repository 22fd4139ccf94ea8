"""From tray to trocar: approach, grasp, lift, bring; what was thought, what became of it.

What the eyes say of tool and trocar is all that this knows of them; the truth only measures. Motion
is simple: straight lines in the joints between postures that are asked whether they are free. A
plan's own motion comes as postures too, through `RunningScene.follow`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, angle_between, frozen, read_only, unit
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.mechanisms.arm import ArmProfile, solve
from app.mechanisms.errors import MechanismError
from app.mechanisms.hand import ToolShaft, approach
from app.simulation.arm.running import RunningScene, SceneClearance
from app.simulation.arm.scene import ArmScene
from app.simulation.errors import SimulationError

SLIP: Final = 1.0 * MILLIMETRE
"""Distance by which the tool may move in the hand while it is lifted [m]."""

SLIP_TURN: Final = np.radians(3.0)
"""Angle by which it may turn there [rad]."""

_UP: Final = read_only(np.array([0.0, 0.0, 1.0]))
_ABOVE: Final = 0.10  # height above the tool from which the hand comes straight down [m]
_DOWN: Final = 8  # postures of a straight way of the hand
_TURNS: Final = 36  # turns of the tool about its axis that are tried above the trocar
_MARGIN: Final = 0.002  # distance kept from everything [m]
_CAREFUL: Final = 0.15  # share of the largest joint speed with a tool in the hand


class CarryFailure(StrEnum):
    """Why the tool was not brought."""

    NOT_SEEN = "not_seen"  # no tool or no trocar in the pictures, or no telling its tip
    UNREACHABLE = "unreachable"  # no posture within the limits for a pose on the way
    COLLIDES = "collides"  # something stands in the straight way
    CANNOT_CLOSE = "cannot_close"  # the fingers do not meet on a tool there
    NOT_HELD = "not_held"  # the forces did not come
    SLIPPED = "slipped"  # it moved in the hand
    DROPPED = "dropped"  # no finger touches it any more


class CarryError(SimulationError):
    """The tool was not brought; the message says why and what to do.

    Attributes:
        failure: the cause.
        could_stand_deg: turn of the arm's place about the vertical through the entry from which it
            could be [°]; None if none is known.
    """

    def __init__(
        self, failure: CarryFailure, message: str, could_stand_deg: float | None = None
    ) -> None:
        super().__init__(message)
        self.failure = failure
        self.could_stand_deg = could_stand_deg


@dataclass(frozen=True, slots=True, eq=False)
class SeenTool:
    """Where the tool is thought to lie.

    Attributes:
        p_grip: where it is to be taken, on its axis [m], shape (3,).
        axis_world: unit vector from the handle to the tip, shape (3,).
    """

    p_grip: FloatArray
    axis_world: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_grip", frozen(self.p_grip, (3,), "p_grip"))
        axis = frozen(unit(self.axis_world), (3,), "axis_world")
        object.__setattr__(self, "axis_world", axis)


@dataclass(frozen=True, slots=True)
class CarryPhase:
    """One phase that is done.

    Attributes:
        name: `approach`, `grasp`, `lift` or `bring`.
        time: of the simulation at its end [s].
        errors: name with unit -> value, measured against the truth.
    """

    name: str
    time: float
    errors: dict[str, float]


def true_tool(running: RunningScene) -> SeenTool:
    """Return where the tool really lies: what perfect eyes would say."""
    place = running.state.T_world_tool
    return SeenTool(place @ [0.0, 0.0, running.scene.tool.grip], place.rotate([0.0, 0.0, 1.0]))


def carry(
    running: RunningScene,
    tool: SeenTool,
    fulcrum: FloatArray,
    normal: FloatArray,
    lift: float = 0.05,
    above: float = 0.03,
    force: float = 5.0,
) -> Iterator[CarryPhase]:
    """Fetch the tool and bring its tip over the trocar, one phase per answer.

    Args:
        running: an open scene.
        tool: where it is thought to lie.
        fulcrum: thought centre of the trocar [m], shape (3,).
        normal: thought direction out of the body, shape (3,).
        lift: height to lift it [m].
        above: of the tip over the trocar at the end [m].
        force: of the grasp [N], as `RunningScene.grasp`.

    Raises:
        CarryError: names the cause.
    """
    scene = running.scene
    clearance = running.clearance(_lying(scene, tool))
    grasped, postures = _reach_down(scene, clearance, tool, running.reference)
    running.move(postures[0])
    running.follow(_through(running, postures))
    running.stay(0.2)
    state = running.state
    truth = true_tool(running)
    yield CarryPhase(
        "approach",
        state.time,
        {
            "hand_mm": _millimetres(state.T_world_hand.translation - grasped.translation),
            "tool_touched_mm": _millimetres(truth.p_grip - _on(truth, tool)),
        },
    )

    shaft = ToolShaft(tool.p_grip, tool.axis_world, scene.tool.shaft_diameter)
    try:
        running.grasp(shaft.seen_from(grasped.inverse()), force)
    except MechanismError as error:
        raise CarryError(CarryFailure.CANNOT_CLOSE, str(error)) from error
    except SimulationError as error:
        raise CarryError(CarryFailure.NOT_HELD, str(error)) from error
    state = running.state
    held = state.T_hand_tool
    # The fingers put it between their tips: so it is thought to lie in the hand.
    thought = grasped.inverse() @ _lying(scene, tool)
    yield CarryPhase(
        "grasp",
        state.time,
        {
            "force_N": float(state.forces[2]) - force,
            **_apart(held, thought, scene.tool.grip),
        },
    )

    begin = state.T_world_tool @ [0.0, 0.0, scene.tool.grip]
    lifted = RigidTransform(grasped.rotation, grasped.translation + lift * _UP)
    running.follow(_through(running, _straight(scene.arm, grasped, lifted, running.reference)))
    running.stay(0.3)
    state = running.state
    raised = state.T_world_tool @ [0.0, 0.0, scene.tool.grip] - begin
    slip = _slipped(running, held)
    yield CarryPhase("lift", state.time, {"height_mm": 1e3 * (float(raised[2]) - lift), **slip})

    tip = fulcrum + above * unit(normal)
    carried = running.clearance(T_hand_tool=thought)
    goal = _over(running, carried, thought, tip, -unit(normal))
    running.move(goal, _CAREFUL)
    state = running.state
    slip = _slipped(running, held)
    axis = state.T_world_tool.rotate([0.0, 0.0, 1.0])
    off = state.T_world_tool @ [0.0, 0.0, scene.tool.length] - scene.trocar.p_world
    aside = off - axis * (off @ axis)
    yield CarryPhase(
        "bring",
        state.time,
        {
            "axis_from_fulcrum_mm": _millimetres(aside),
            "tip_mm": _millimetres(off - above * scene.trocar.normal_world),
            "axis_deg": float(np.degrees(angle_between(axis, -scene.trocar.normal_world))),
            **slip,
        },
    )


def _reach_down(
    scene: ArmScene, clearance: SceneClearance, tool: SeenTool, near: FloatArray
) -> tuple[RigidTransform, FloatArray]:
    """Pose of the hand at the tool, and postures from above it down to there."""
    failures: list[CarryError] = []
    for sign in (1.0, -1.0):  # the hand may come with either side first
        shaft = ToolShaft(tool.p_grip, sign * tool.axis_world, scene.tool.shaft_diameter)
        try:
            grasped = approach(scene.hand.hand, shaft, (0.0, 0.0, -1.0))
        except MechanismError as error:
            raise CarryError(CarryFailure.CANNOT_CLOSE, str(error)) from error
        high = RigidTransform(grasped.rotation, grasped.translation + _ABOVE * _UP)
        try:
            postures = _straight(scene.arm, high, grasped, near)
            _free(clearance, np.vstack([_between(near, postures[0]), postures]))
        except CarryError as error:
            failures.append(error)
            continue
        return grasped, postures
    raise failures[0]


def _over(
    running: RunningScene,
    clearance: SceneClearance,
    T_hand_tool: RigidTransform,
    tip: FloatArray,
    axis: FloatArray,
) -> FloatArray:
    """Posture that holds the tool's tip there: of all turns about its axis the nearest free one."""
    scene, near = running.scene, running.reference
    across = unit(np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]))
    found: list[tuple[float, FloatArray]] = []
    for angle in 2.0 * np.pi * np.arange(_TURNS) / _TURNS:
        x = np.cos(angle) * across + np.sin(angle) * np.cross(axis, across)
        rotation = np.column_stack([x, np.cross(axis, x), axis])
        T_world_tool = RigidTransform(rotation, tip - scene.tool.length * axis)
        hand = T_world_tool @ T_hand_tool.inverse()
        try:
            q = solve(scene.arm, scene.arm.wrist_pose(hand), near).q
        except MechanismError:
            continue
        found.append((float(np.abs(q - near).max()), q))
    if not found:
        x, y, z = (1e3 * tip).round(1).tolist()
        raise CarryError(
            CarryFailure.UNREACHABLE,
            f"no posture holds the tool's tip at ({x}, {y}, {z}) mm above the trocar; place the"
            " trocar nearer to the arm, or further from it",
        )
    blocked = ""
    for _, q in sorted(found, key=lambda one: one[0]):
        what = clearance.blocked(_between(near, q), _MARGIN)
        if what is None:
            return q
        blocked = blocked or what
    raise CarryError(
        CarryFailure.COLLIDES,
        f"no straight way to the trocar is free: {blocked}; a planner may find another",
    )


def _straight(
    arm: ArmProfile, start: RigidTransform, end: RigidTransform, near: FloatArray
) -> FloatArray:
    """Postures of the hand's straight way between two poses of one orientation, both included."""
    postures = []
    for share in np.linspace(0.0, 1.0, _DOWN + 1):
        between = start.translation + share * (end.translation - start.translation)
        hand = RigidTransform(end.rotation, between)
        try:
            near = solve(arm, arm.wrist_pose(hand), near).q
        except MechanismError as error:
            raise CarryError(CarryFailure.UNREACHABLE, str(error)) from error
        postures.append(near)
    return np.array(postures)


def _through(running: RunningScene, postures: FloatArray) -> FloatArray:
    """One posture per step through some, from rest to rest along all of them."""
    count = len(running.line(postures[0], postures[-1], 0.15))
    s = np.arange(1, count + 1) / count
    s = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
    at = np.linspace(0.0, 1.0, len(postures))
    return np.column_stack([np.interp(s, at, column) for column in postures.T])


def _between(start: FloatArray, goal: FloatArray) -> FloatArray:
    """Postures of a straight line, at most 1.5° apart."""
    count = max(int(np.ceil(float(np.abs(goal - start).max()) / np.radians(1.5))), 1)
    return np.asarray(start + np.linspace(0.0, 1.0, count + 1)[:, None] * (goal - start))


def _free(clearance: SceneClearance, postures: FloatArray) -> None:
    what = clearance.blocked(postures, _MARGIN)
    if what is not None:
        raise CarryError(
            CarryFailure.COLLIDES, f"the way to the tool is not free: {what}; place it elsewhere"
        )


def _lying(scene: ArmScene, tool: SeenTool) -> RigidTransform:
    """T_world_tool of a tool as seen, turned about its axis in any way: it is round."""
    z = tool.axis_world
    x = unit(np.cross(z, np.eye(3)[int(np.argmin(np.abs(z)))]))
    rotation = np.column_stack([x, np.cross(z, x), z])
    return RigidTransform(rotation, tool.p_grip - scene.tool.grip * z)


def _apart(first: RigidTransform, second: RigidTransform, grip: float) -> dict[str, float]:
    """How far two poses of the tool are apart at its grip, and by their axes."""
    at = first @ [0.0, 0.0, grip] - second @ [0.0, 0.0, grip]
    turn = angle_between(first.rotation[:, 2], second.rotation[:, 2])
    return {"in_hand_mm": _millimetres(at), "in_hand_deg": float(np.degrees(turn))}


def _slipped(running: RunningScene, held: RigidTransform) -> dict[str, float]:
    """How far the tool has moved in the hand since it was taken.

    Raises:
        CarryError: if that is too much, or it is lost.
    """
    state = running.state
    if not state.forces.any():
        raise CarryError(
            CarryFailure.DROPPED, "the tool has fallen: no finger touches it; grasp more firmly"
        )
    now, grip = state.T_hand_tool, running.scene.tool.grip
    moved = float(np.linalg.norm((now @ [0.0, 0.0, grip]) - (held @ [0.0, 0.0, grip])))
    turned = angle_between(now.rotation[:, 2], held.rotation[:, 2])
    if moved > SLIP or turned > SLIP_TURN:
        raise CarryError(
            CarryFailure.SLIPPED,
            f"the tool moved by {moved / MILLIMETRE:.2g} mm and {np.degrees(turned):.2g}° in the"
            f" hand; up to {SLIP / MILLIMETRE:g} mm and {np.degrees(SLIP_TURN):g}° are allowed:"
            " grasp more firmly",
        )
    return {"slip_mm": moved / MILLIMETRE, "slip_deg": float(np.degrees(turned))}


def _on(truth: SeenTool, tool: SeenTool) -> FloatArray:
    """Point of the seen axis nearest to the true grip [m], shape (3,)."""
    along = (truth.p_grip - tool.p_grip) @ tool.axis_world
    return np.asarray(tool.p_grip + along * tool.axis_world)


def _millimetres(vector: FloatArray) -> float:
    return float(np.linalg.norm(vector)) / MILLIMETRE
